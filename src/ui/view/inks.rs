//! Inks: how the pixels of pictures become coloured cells.

use ratatui::style::{Color, Style};

use super::few_colours::Palette;
use super::mosaic::Mosaic;
use crate::terminal::ColourDepth;
use crate::theme::Theme;

/// What fills the cells of a picture on a terminal with colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// Half blocks.
    HalfBlocks,
    /// Characters chosen by shape, for few colours or none.
    Sketch,
    /// Block characters of more pixels in two colours.
    Mosaic(Mosaic),
    /// A picture in real pixels, which the terminal puts there.
    Picture,
}

/// How pixels are shown on a terminal of a colour depth: in true colour, in the nearest of fewer colours,
/// or without any by the brightness of characters.
#[derive(Debug)]
pub struct Inks {
    pub(super) depth: ColourDepth,
    /// What fills the cells of pictures.
    pub drawing: Drawing,
    /// The few colours, if there are any.
    palette: Option<Palette>,
}

impl Inks {
    /// The inks for a colour depth.
    pub fn for_depth(depth: ColourDepth) -> Self {
        let palette = match depth {
            ColourDepth::Palette256 => Some(Palette::of_256()),
            ColourDepth::Palette16 => Some(Palette::of_16()),
            ColourDepth::TrueColour | ColourDepth::Mono => None,
        };
        Self {
            depth,
            drawing: Drawing::HalfBlocks,
            palette,
        }
    }

    /// Whether pixels have colours.
    pub fn have_colours(&self) -> bool {
        self.depth != ColourDepth::Mono
    }

    /// Whether there are only a few.
    pub(super) fn has_few(&self) -> bool {
        self.palette.is_some()
    }

    /// The theme to use when this one is wanted: without colours, attributes take their place.
    pub(super) fn theme(&self, wanted: Theme) -> Theme {
        match self.depth {
            ColourDepth::Mono => Theme::Mono,
            _ => wanted,
        }
    }

    /// The few colours, if there are any.
    pub(super) fn palette(&mut self) -> Option<&mut Palette> {
        self.palette.as_mut()
    }

    /// The terminal colour of a pixel.
    pub(super) fn colour(&mut self, colour: [u8; 3]) -> Color {
        match &mut self.palette {
            Some(palette) => Palette::colour(palette.nearest(colour)),
            None => colour.into(),
        }
    }

    /// The symbol and the style of a cell of one colour.
    pub(super) fn flat(&mut self, colour: [u8; 3]) -> (&'static str, Style) {
        match &mut self.palette {
            Some(palette) => {
                let tint = palette.tint(colour);
                (tint.symbol(), tint.style())
            }
            None => (" ", Style::reset().fg(colour.into()).bg(colour.into())),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn attributes_take_the_place_of_colours_that_cannot_be_shown() {
        let theme = |depth| Inks::for_depth(depth).theme(Theme::Light);
        assert_eq!(theme(ColourDepth::Mono), Theme::Mono);
        assert_eq!(theme(ColourDepth::Palette16), Theme::Light);
    }
}
