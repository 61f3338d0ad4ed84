//! The picture on the screen: where it is, and what must be sent to change it.

use std::borrow::Cow;
use std::io;

use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::{Position, Rect};
use ratatui::style::Color;

use super::graphics::{Means, Pixmap, Protocol, Turn, name};

/// Keeps account of the picture on the screen.
#[derive(Debug, Default)]
pub(super) struct Canvas {
    /// How pictures are sent; `None` if none are.
    pub(super) means: Option<Means>,
    shown: Option<Placed>,
    /// Which of two alternating pictures was sent last.
    turn: Turn,
    /// Whether a picture that erasing cells does not erase may still be on the screen.
    lingers: bool,
}

/// A picture in its cells.
#[derive(Debug, PartialEq, Eq)]
struct Placed {
    place: Rect,
    pixmap: Pixmap,
    /// Cells in which text has replaced the picture.
    text: Vec<Position>,
}

/// What to do about the picture before a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Removal {
    /// Nothing: there is none, or it stays where it is.
    None,
    /// Send these bytes.
    Bytes(Cow<'static, str>),
    /// Erase the screen and draw all of it: the cells of the picture are unknown to the drawing.
    Repaint,
}

/// A picture to be sent, and the cells to be drawn over it afterwards.
pub(super) struct Sending {
    /// Where the cursor must be; `None` if the picture precedes the text that names it.
    pub(super) at: Option<Position>,
    pub(super) bytes: Vec<u8>,
    pub(super) over: Vec<(Position, Cell)>,
}

impl Canvas {
    /// Forgets what is on the screen, after it was erased.
    pub(super) fn forget(&mut self) {
        let is_content = self.means.is_none_or(Means::is_content);
        self.lingers |= self.shown.take().is_some() && !is_content;
    }

    /// What must be done before the picture is at `place`, or nowhere.
    pub(super) fn removal(&mut self, place: Option<Rect>) -> Removal {
        let is_elsewhere = |shown: &Placed| Some(shown.place) != place;
        let Some(means) = self.means else {
            return Removal::None;
        };
        let leaves = self.shown.as_ref().is_some_and(is_elsewhere);
        if means.is_content() {
            if leaves {
                self.shown = None;
                return Removal::Repaint;
            }
        } else if place.is_none() && (leaves || self.lingers) {
            // A picture that moves is replaced.
            self.shown = None;
            self.lingers = false;
            return Removal::Bytes(means.ending());
        }
        Removal::None
    }

    /// Makes the blank cells of a place name their parts of a picture, if that is how it is shown.
    pub(super) fn fill(&self, place: Rect, pixmap: &Pixmap, frame: &mut Buffer) {
        let Some(Protocol::Placeholders { pane }) = self.means.map(|means| means.protocol) else {
            return;
        };
        let is_shown = self.shown(place, pixmap).is_some();
        let turn = if is_shown {
            self.turn
        } else {
            self.turn.other()
        };
        for at in place.intersection(frame.area).positions() {
            if !is_text(&frame[at]) {
                name(
                    &mut frame[at],
                    (pane, turn),
                    (at.y - place.y, at.x - place.x),
                );
            }
        }
    }

    /// The picture on the screen if it is this one.
    fn shown(&self, place: Rect, pixmap: &Pixmap) -> Option<&Placed> {
        let shown = self.shown.as_ref();
        shown.filter(|shown| shown.place == place && shown.pixmap == *pixmap)
    }

    /// What must be sent so that `pixmap` is in the cells of `place`, with the text `over` it; `None`
    /// if it is there.
    pub(super) fn sending(
        &mut self,
        place: Rect,
        pixmap: &Pixmap,
        mut over: Vec<(Position, Cell)>,
    ) -> io::Result<Option<Sending>> {
        let Some(means) = self.means else {
            return Ok(None);
        };
        if !means.is_content() {
            over.clear();
        }
        let text = || over.iter().map(|(position, _)| *position);
        let shown = self.shown(place, pixmap);
        if shown.is_some_and(|shown| text().eq(shown.text.iter().copied())) {
            return Ok(None);
        }
        self.turn = self.turn.other();
        let mut bytes = Vec::new();
        means.encode(pixmap, self.turn, place, &mut bytes)?;
        self.lingers = false;
        self.shown = Some(Placed {
            place,
            pixmap: pixmap.clone(),
            text: text().collect(),
        });
        Ok(Some(Sending {
            at: (!means.is_named()).then(|| place.as_position()),
            bytes,
            over,
        }))
    }
}

/// The cells of a place that are not blank.
pub(super) fn text_over(place: Rect, frame: &Buffer) -> Vec<(Position, Cell)> {
    let cells = place.intersection(frame.area).positions();
    let cells = cells.filter(|&position| is_text(&frame[position]));
    let text = cells.map(|position| (position, frame[position].clone()));
    text.collect()
}

fn is_text(cell: &Cell) -> bool {
    cell.symbol() != " " || cell.bg != Color::Reset
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::tests::size;
    use crate::terminal::{Protocol, Wrapping};

    const NAMED: Protocol = Protocol::Placeholders { pane: 0 };
    const PROTOCOLS: [Protocol; 4] = [Protocol::Kitty, NAMED, Protocol::Iterm, Protocol::Sixel];
    const PLACE: Rect = Rect::new(1, 1, 4, 2);
    const ELSEWHERE: Rect = Rect::new(2, 1, 4, 2);

    fn canvas(protocol: Protocol) -> Canvas {
        let means = Means {
            protocol,
            wrapping: Wrapping::Plain,
            cell: (4, 6),
        };
        Canvas {
            means: Some(means),
            ..Canvas::default()
        }
    }

    fn pixmap(light: u8) -> Pixmap {
        Pixmap {
            size: size(4, 4),
            pixels: vec![[light; 3]; 4 * 4],
        }
    }

    fn frame(text: &str) -> Buffer {
        let mut frame = Buffer::empty(Rect::new(0, 0, 8, 4));
        frame.set_string(2, 1, text, Color::Reset);
        frame
    }

    /// Whether a picture is sent, and the number of cells drawn over it.
    fn sent(canvas: &mut Canvas, light: u8, text: &str) -> Option<usize> {
        let over = text_over(PLACE, &frame(text));
        let sending = canvas.sending(PLACE, &pixmap(light), over);
        sending.expect("pixels").map(|sending| sending.over.len())
    }

    #[test]
    fn a_picture_is_sent_when_it_changes_or_text_has_replaced_it() {
        for protocol in PROTOCOLS {
            let mut canvas = canvas(protocol);
            let is_content = canvas_is_content(protocol);
            let over = if is_content { 2 } else { 0 };
            assert_eq!(sent(&mut canvas, 1, ""), Some(0));
            assert_eq!(sent(&mut canvas, 1, ""), None);
            assert_eq!(sent(&mut canvas, 2, "ab"), Some(over));
            assert_eq!(sent(&mut canvas, 2, "cd"), None, "the same cells");
            let again = is_content.then_some(0);
            assert_eq!(sent(&mut canvas, 2, ""), again, "uncovered");
            canvas.forget();
            assert_eq!(sent(&mut canvas, 2, ""), Some(0), "erased");
        }
    }

    fn canvas_is_content(protocol: Protocol) -> bool {
        ![Protocol::Kitty, NAMED].contains(&protocol)
    }

    #[test]
    fn a_picture_that_leaves_is_removed_once() {
        for protocol in PROTOCOLS {
            let mut canvas = canvas(protocol);
            let (gone, moved) = if canvas_is_content(protocol) {
                (Removal::Repaint, Removal::Repaint)
            } else {
                let ending = canvas.means.map(Means::ending).unwrap_or_default();
                (Removal::Bytes(ending), Removal::None)
            };
            assert_eq!(canvas.removal(None), Removal::None, "there is none");
            sent(&mut canvas, 1, "");
            assert_eq!(canvas.removal(Some(PLACE)), Removal::None);
            assert_eq!(canvas.removal(Some(ELSEWHERE)), moved);
            canvas.forget();
            sent(&mut canvas, 1, "");
            assert_eq!(canvas.removal(None), gone);
            assert_eq!(canvas.removal(None), Removal::None);
        }
    }

    /// The symbols and colours of the place, after a picture with this text over it.
    fn filled(canvas: &mut Canvas, light: u8, text: &str) -> Vec<(String, Color)> {
        let mut frame = frame(text);
        canvas.fill(PLACE, &pixmap(light), &mut frame);
        sent(canvas, light, text);
        let cells = PLACE.positions().map(|at| &frame[at]);
        cells
            .map(|cell| (cell.symbol().to_owned(), cell.fg))
            .collect()
    }

    #[test]
    fn blank_cells_name_the_picture_that_is_sent() {
        let mut canvas = canvas(NAMED);
        let first = filled(&mut canvas, 1, "");
        assert_eq!(filled(&mut canvas, 1, ""), first, "the same picture");
        let next = filled(&mut canvas, 2, "");
        for (one, other) in first.iter().zip(&next) {
            assert_eq!(one.0, other.0);
            assert_ne!(one.1, other.1, "the next one has another number");
        }
        assert_eq!(filled(&mut canvas, 3, ""), first, "numbers alternate");
        let covered = filled(&mut canvas, 3, "ab");
        assert_eq!([&covered[1].0, &covered[2].0], ["a", "b"]);
        assert_eq!([&covered[0], &covered[3]], [&first[0], &first[3]]);
        assert_eq!(filled(&mut canvas, 3, ""), first, "uncovered");
        canvas.forget();
        assert_eq!(filled(&mut canvas, 3, ""), next, "erased, so sent again");
    }
}
