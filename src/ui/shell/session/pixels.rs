//! What pixels are drawn with: the user's choice, and what is known of the terminal.

use std::time::Instant;

use crate::pixels::Pixels;
use crate::terminal::tmux::{self, Client};
use crate::terminal::{ColourDepth, Link, MOST_PLACEHOLDERS, Means, Protocol, Reply, Wrapping};
use crate::view::{Drawing, Mosaic, SKETCH};

/// The most pixels of a screen that are traced and sent as pictures: at more, a frame takes longer
/// than it is shown. Over a limited line, about as many as half a second carries.
const MOST: u32 = 640_000;
const MOST_LIMITED: u32 = 100_000;

/// The size of a cell in pixels where nothing is known and pictures are scaled to their cells.
const USUAL_CELL: (u16, u16) = (8, 16);

/// What the terminal has answered about pictures.
#[derive(Clone, Debug, Default)]
pub(super) struct Known {
    /// Until when answers are expected; `None` before a question and after the answers.
    pub(super) until: Option<Instant>,
    /// Whether it was asked.
    pub(super) was_asked: bool,
    /// Whether the process runs in tmux, which must be asked what it passes on.
    is_in_tmux: bool,
    /// The choice of the user that cannot be followed, once its reason was shown.
    pub(super) refused: Option<Pixels>,
    /// Whether all answers have arrived.
    is_complete: bool,
    shows: Vec<Protocol>,
    cell: Option<(u16, u16)>,
    tmux: Option<Client>,
}

impl Known {
    /// Nothing but the environment is known.
    pub(super) fn asked_nothing() -> Self {
        Self {
            is_in_tmux: tmux::is_around(),
            ..Self::default()
        }
    }

    /// Takes a reply of the terminal; those that say nothing about pictures change nothing.
    pub(super) fn take(&mut self, reply: Reply) {
        match reply {
            Reply::Shows(protocol) => self.shows.push(protocol),
            Reply::AttributesWithSixel => self.shows.push(Protocol::Sixel),
            Reply::CellSize { width, height } => self.cell = Some((width, height)),
            Reply::Tmux(client) => self.tmux = Some(client),
            _ => {}
        }
        if reply.is_last() {
            self.is_complete = true;
            self.until = None;
        }
    }

    /// Why a protocol that the user has chosen is not used, once that is known.
    pub(super) fn refusal(&self, choice: Pixels, manner: Manner) -> Option<&'static str> {
        if self.until.is_some() || manner.means().is_some() {
            return None;
        }
        match choice {
            Pixels::Kitty | Pixels::Iterm => {
                Some("tmux passes no pictures on; set -g allow-passthrough on")
            }
            Pixels::Sixel => {
                Some("sixels need the size of a cell, which the terminal does not tell")
            }
            _ => None,
        }
    }

    /// What is on the way to the terminal for a protocol; `None` if it does not pass.
    fn wrapping(&self, protocol: Protocol) -> Option<Wrapping> {
        match self.tmux {
            // tmux understands sixels.
            _ if protocol == Protocol::Sixel || !self.is_in_tmux => Some(Wrapping::Plain),
            Some(Client {
                passes_through: true,
                corner: (left, top),
                ..
            }) => Some(Wrapping::Tmux { left, top }),
            _ => None,
        }
    }

    /// Pictures in place of text, if tmux passes them on to a terminal that knows them.
    fn placeholders(&self) -> Option<Protocol> {
        let client = self.tmux.filter(|client| client.passes_through)?;
        let pane = client.placeholders?;
        Some(Protocol::Placeholders { pane })
    }

    /// The best protocol that the terminal says it shows. tmux draws sixels itself; what it passes
    /// on stays where it is when windows or panes change, so that is only for those who ask.
    fn best(&self) -> Option<Protocol> {
        if !self.is_complete {
            return None;
        }
        if self.is_in_tmux {
            let client = self.tmux?;
            return (self.shows.contains(&Protocol::Sixel) && client.has_sixel)
                .then_some(Protocol::Sixel);
        }
        let mut best_first = [Protocol::Kitty, Protocol::Iterm, Protocol::Sixel].into_iter();
        best_first.find(|protocol| self.shows.contains(protocol))
    }
}

/// What pixels are drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Manner {
    Half,
    Sketch,
    Mosaic(Mosaic),
    Picture(Means),
}

impl Manner {
    /// What to draw with, at best, on a screen of so many columns and rows. `cell` is the size of a cell
    /// as the system knows it. Sixels cannot be scaled and placeholders not stretched, so they need it.
    pub(super) fn of(
        choice: Pixels,
        depth: ColourDepth,
        known: &Known,
        (columns, rows): (u16, u16),
        cell: Option<(u16, u16)>,
    ) -> Self {
        let cell = cell.or(known.cell);
        let can_name = ColourDepth::Palette256 <= depth
            && columns.max(rows) <= MOST_PLACEHOLDERS
            && cell.is_some();
        let placeholders = known.placeholders().filter(|_| can_name);
        let mosaic = |mosaic| {
            if depth == ColourDepth::Mono {
                Self::Sketch
            } else {
                Self::Mosaic(mosaic)
            }
        };
        let protocol = match choice {
            Pixels::Half => None,
            Pixels::Quadrant => return mosaic(Mosaic::Quadrant),
            Pixels::Sextant => return mosaic(Mosaic::Sextant),
            Pixels::Octant => return mosaic(Mosaic::Octant),
            Pixels::Kitty => placeholders.or(Some(Protocol::Kitty)),
            Pixels::Iterm => Some(Protocol::Iterm),
            Pixels::Sixel => Some(Protocol::Sixel),
            Pixels::Auto => {
                let best = placeholders.or_else(|| known.best());
                best.filter(|_| depth != ColourDepth::Mono)
            }
        };
        let wrapped = protocol.and_then(|protocol| Some((protocol, known.wrapping(protocol)?)));
        match (wrapped, cell) {
            (None, _) | (Some((Protocol::Sixel, _)), None) => Self::blocks(choice, depth),
            (Some((protocol, wrapping)), cell) => Self::Picture(Means {
                protocol,
                wrapping,
                cell: cell.unwrap_or(USUAL_CELL),
            }),
        }
    }

    /// What to draw with where there are only characters.
    fn blocks(choice: Pixels, depth: ColourDepth) -> Self {
        match depth {
            ColourDepth::Mono => Self::Sketch,
            ColourDepth::Palette16 if choice != Pixels::Half => Self::Sketch,
            _ => Self::Half,
        }
    }

    /// How the view draws.
    pub(super) fn drawing(self) -> Drawing {
        match self {
            Self::Half => Drawing::HalfBlocks,
            Self::Sketch => Drawing::Sketch,
            Self::Mosaic(mosaic) => Drawing::Mosaic(mosaic),
            Self::Picture(_) => Drawing::Picture,
        }
    }

    /// How pictures are sent, if they are.
    pub(super) fn means(self) -> Option<Means> {
        match self {
            Self::Picture(means) => Some(means),
            Self::Half | Self::Sketch | Self::Mosaic(_) => None,
        }
    }

    /// Pixels across and down a cell, on a screen of so many columns and rows that may have so many
    /// pixels.
    pub(super) fn grid(self, (columns, rows): (u16, u16), most: u32) -> (u16, u16) {
        let means = match self {
            Self::Half => return (1, 2),
            Self::Sketch => return SKETCH,
            Self::Mosaic(mosaic) => return mosaic.grid(),
            Self::Picture(means) => means,
        };
        let (width, height) = means.cell;
        let at = |divisor: u16| ((width / divisor).max(1), (height / divisor).max(2));
        let fits = |&divisor: &u16| {
            let (across, down) = at(divisor);
            u32::from(columns) * u32::from(across) * u32::from(rows) * u32::from(down) <= most
        };
        let coarsest = height.max(1);
        at((1..height.max(2)).find(fits).unwrap_or(coarsest))
    }
}

/// The most pixels of a screen behind a line that are traced and sent as pictures.
pub(super) fn most_pixels(link: &Link) -> u32 {
    if link.is_limited() {
        MOST_LIMITED
    } else {
        MOST
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELL: Option<(u16, u16)> = Some((10, 20));
    const SCREEN: (u16, u16) = (100, 30);

    fn known(replies: &[Reply]) -> Known {
        let mut known = Known {
            is_in_tmux: replies.iter().any(|reply| matches!(reply, Reply::Tmux(_))),
            ..Known::default()
        };
        for &reply in replies {
            known.take(reply);
        }
        known
    }

    fn tmux(has_sixel: bool, passes_through: bool) -> Reply {
        Reply::Tmux(Client {
            has_sixel,
            passes_through,
            ..Client::default()
        })
    }

    fn protocol(choice: Pixels, replies: &[Reply], cell: Option<(u16, u16)>) -> Option<Protocol> {
        let manner = Manner::of(
            choice,
            ColourDepth::TrueColour,
            &known(replies),
            SCREEN,
            cell,
        );
        manner.means().map(|means| means.protocol)
    }

    #[test]
    fn the_best_protocol_that_the_terminal_reports_is_chosen() {
        use Protocol::{Iterm, Kitty, Sixel};
        use Reply::{Attributes, AttributesWithSixel, Shows};
        let tmux = |has_sixel| tmux(has_sixel, true);
        for (replies, expected) in [
            (&[][..], None),
            (&[Attributes], None),
            (&[Shows(Kitty)], None),
            (&[Shows(Kitty), Attributes], Some(Kitty)),
            (&[Shows(Iterm), AttributesWithSixel], Some(Iterm)),
            (&[AttributesWithSixel], Some(Sixel)),
            (&[Shows(Iterm), Shows(Kitty), Attributes], Some(Kitty)),
            (&[tmux(true), AttributesWithSixel], Some(Sixel)),
            (&[tmux(false), AttributesWithSixel], None),
            (&[tmux(true), Attributes], None),
        ] {
            let chosen = protocol(Pixels::Auto, replies, CELL);
            assert_eq!(chosen, expected, "{replies:?}");
        }
    }

    fn through(passes_through: bool) -> Reply {
        tmux(false, passes_through)
    }

    #[test]
    fn a_choice_that_cannot_be_followed_is_explained() {
        for (choice, replies, is_refused) in [
            (Pixels::Sixel, &[][..], true),
            (Pixels::Kitty, &[through(false)], true),
            (Pixels::Kitty, &[through(true)], false),
            (Pixels::Auto, &[Reply::Attributes], false),
            (Pixels::Octant, &[], false),
        ] {
            let known = known(replies);
            let manner = Manner::of(choice, ColourDepth::TrueColour, &known, SCREEN, None);
            let refusal = known.refusal(choice, manner);
            assert_eq!(refusal.is_some(), is_refused, "{choice:?}");
        }
    }

    #[test]
    fn a_choice_needs_no_answer_but_sixels_need_the_size_of_cells() {
        let (width, height) = (9, 18);
        let size = Reply::CellSize { width, height };
        for (choice, replies, cell, expected) in table! {
            Pixels::Kitty, &[][..], None => Some(Protocol::Kitty);
            Pixels::Iterm, &[], None => Some(Protocol::Iterm);
            Pixels::Sixel, &[], None => None;
            Pixels::Sixel, &[], CELL => Some(Protocol::Sixel);
            Pixels::Sixel, &[size], None => Some(Protocol::Sixel);
            Pixels::Octant, &[Reply::AttributesWithSixel], CELL => None;
            Pixels::Kitty, &[through(true)], CELL => Some(Protocol::Kitty);
            Pixels::Iterm, &[through(false)], CELL => None;
            Pixels::Sixel, &[through(false)], CELL => Some(Protocol::Sixel);
        } {
            assert_eq!(protocol(choice, replies, cell), expected, "{choice:?}");
        }
    }

    #[test]
    fn pictures_in_place_of_text_need_their_terminal_through_tmux_and_few_enough_cells() {
        use ColourDepth::{Mono, Palette16, Palette256, TrueColour};
        use Protocol::Kitty;
        let client = |passes_through, placeholders| {
            Reply::Tmux(Client {
                passes_through,
                placeholders,
                ..Client::default()
            })
        };
        let both = client(true, Some(3));
        let named = Some(Protocol::Placeholders { pane: 3 });
        for (choice, reply, depth, screen, cell, expected) in table! {
            Pixels::Auto, both, TrueColour, SCREEN, CELL => named;
            Pixels::Kitty, both, Palette256, (297, 30), CELL => named;
            Pixels::Auto, both, Mono, SCREEN, CELL => None;
            Pixels::Auto, both, Palette16, SCREEN, CELL => None;
            Pixels::Auto, both, TrueColour, (298, 30), CELL => None;
            Pixels::Auto, both, TrueColour, SCREEN, None => None;
            Pixels::Kitty, both, TrueColour, (298, 30), CELL => Some(Kitty);
            Pixels::Kitty, both, Mono, SCREEN, CELL => Some(Kitty);
            Pixels::Auto, client(true, None), TrueColour, SCREEN, CELL => None;
            Pixels::Kitty, client(true, None), TrueColour, SCREEN, CELL => Some(Kitty);
            Pixels::Kitty, client(false, Some(3)), TrueColour, SCREEN, CELL => None;
        } {
            let manner = Manner::of(choice, depth, &known(&[reply]), screen, cell);
            let protocol = manner.means().map(|means| means.protocol);
            assert_eq!(
                protocol, expected,
                "{choice:?} {reply:?} {depth:?} {screen:?}"
            );
        }
    }

    #[test]
    fn without_colours_nothing_but_characters_is_drawn_unless_a_protocol_is_chosen() {
        let known = known(&[Reply::Shows(Protocol::Kitty), Reply::Attributes]);
        for choice in [Pixels::Auto, Pixels::Octant, Pixels::Half] {
            let manner = Manner::of(choice, ColourDepth::Mono, &known, SCREEN, CELL);
            assert_eq!(manner, Manner::Sketch);
        }
    }

    #[test]
    fn sixteen_colours_draw_shapes_unless_half_blocks_are_chosen() {
        let nothing = Known::default();
        for (choice, depth, expected) in table! {
            Pixels::Auto, ColourDepth::Palette16 => Manner::Sketch;
            Pixels::Half, ColourDepth::Palette16 => Manner::Half;
            Pixels::Quadrant, ColourDepth::Palette16 => Manner::Mosaic(Mosaic::Quadrant);
            Pixels::Auto, ColourDepth::Palette256 => Manner::Half;
        } {
            let manner = Manner::of(choice, depth, &nothing, SCREEN, CELL);
            assert_eq!(manner, expected, "{choice:?} {depth:?}");
        }
    }

    #[test]
    fn a_large_screen_has_fewer_pixels_in_a_cell() {
        let means = |cell| Means {
            protocol: Protocol::Kitty,
            wrapping: Wrapping::Plain,
            cell,
        };
        for (cell, screen, most, grid) in [
            ((10, 20), (100, 30), MOST, (10, 20)),
            ((10, 20), (200, 50), MOST, (5, 10)),
            ((10, 20), (100, 30), MOST_LIMITED, (3, 6)),
            ((9, 19), (80, 24), MOST, (9, 19)),
            ((1, 1), (80, 24), MOST, (1, 2)),
            ((10, 20), (2000, 250), MOST, (1, 2)),
        ] {
            let manner = Manner::Picture(means(cell));
            assert_eq!(manner.grid(screen, most), grid, "{cell:?} {screen:?}");
        }
    }
}
