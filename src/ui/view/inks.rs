//! Inks: how the pixels of pictures become coloured cells.

use ratatui::style::Color;

use super::few_colours::Palette;
use super::mosaic::Mosaic;
use crate::ui::terminal::ColourDepth;
use crate::ui::theme::Theme;

/// The cells that pixels are drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Glyphs {
    /// Two pixels per cell in true colour.
    HalfBlocks,
    /// Two pixels per cell, dithered to the 256 colours.
    HalfBlocksOf256,
    /// Two pixels per cell, dithered to the sixteen colours.
    HalfBlocksOf16,
    /// One character per cell, by brightness, for terminals without colours.
    Characters,
}

impl Glyphs {
    /// The name of the colours used.
    pub(super) fn name(self) -> &'static str {
        let depth = match self {
            Self::HalfBlocks => ColourDepth::TrueColour,
            Self::HalfBlocksOf256 => ColourDepth::Palette256,
            Self::HalfBlocksOf16 => ColourDepth::Palette16,
            Self::Characters => ColourDepth::Mono,
        };
        depth.name()
    }

    fn for_depth(depth: ColourDepth) -> Self {
        match depth {
            ColourDepth::Mono => Self::Characters,
            ColourDepth::Palette16 => Self::HalfBlocksOf16,
            ColourDepth::Palette256 => Self::HalfBlocksOf256,
            ColourDepth::TrueColour => Self::HalfBlocks,
        }
    }
}

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

/// The glyphs of pictures, and a cache of their colour mixes.
#[derive(Debug)]
pub struct Inks {
    pub(super) glyphs: Glyphs,
    /// What fills the cells of pictures.
    pub drawing: Drawing,
    palette: Option<Palette>,
}

impl Inks {
    /// The inks for a colour depth.
    pub fn for_depth(depth: ColourDepth) -> Self {
        Self::new(Glyphs::for_depth(depth))
    }

    /// Whether pixels have colours.
    pub fn have_colours(&self) -> bool {
        self.glyphs != Glyphs::Characters
    }

    pub(super) fn new(glyphs: Glyphs) -> Self {
        let palette = match glyphs {
            Glyphs::HalfBlocksOf256 => Some(Palette::of_256()),
            Glyphs::HalfBlocksOf16 => Some(Palette::of_16()),
            Glyphs::HalfBlocks | Glyphs::Characters => None,
        };
        Self {
            glyphs,
            drawing: Drawing::HalfBlocks,
            palette,
        }
    }

    /// The theme to use when this one is wanted: without colours, attributes take their place.
    pub(super) fn theme(&self, wanted: Theme) -> Theme {
        match self.glyphs {
            Glyphs::Characters => Theme::Mono,
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
