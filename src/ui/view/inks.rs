//! Inks: how the pixels of pictures become coloured cells.

use ratatui::style::Color;

use super::few_colours::Palette;
use super::mosaic::Mosaic;
use crate::terminal::ColourDepth;
use crate::theme::Theme;

/// What fills the cells of a picture on a terminal with colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// Half blocks.
    HalfBlocks,
    /// Block characters of more pixels in two colours.
    Mosaic(Mosaic),
    /// A picture in real pixels, which the terminal puts there.
    Picture,
}

/// How pixels are shown on a terminal of a colour depth: in true colour, dithered to fewer colours, or
/// without any by the brightness of characters.
#[derive(Debug)]
pub struct Inks {
    pub(super) depth: ColourDepth,
    /// What fills the cells of pictures.
    pub drawing: Drawing,
    /// A cache of mixes of few colours.
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

    /// The theme to use when this one is wanted: without colours, attributes take their place.
    pub(super) fn theme(&self, wanted: Theme) -> Theme {
        match self.depth {
            ColourDepth::Mono => Theme::Mono,
            _ => wanted,
        }
    }

    /// The terminal colour of a pixel at a position.
    pub(super) fn colour(&mut self, colour: [u8; 3], x: u32, y: u32) -> Color {
        match &mut self.palette {
            Some(palette) => Color::Indexed(palette.at(colour, x, y)),
            None => colour.into(),
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
