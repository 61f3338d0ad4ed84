//! Enumerated option values and what they mean.

use clap::ValueEnum;

use batch::ProgressStyle;
use render::Aov;
use ui::terminal::{Choice, ColourDepth};
use ui::{Pixels, Theme};

/// The terminal's colour depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ColourChoice {
    /// As detected.
    Auto,
    /// 24-bit colour.
    #[value(name = "24")]
    True,
    /// 256 indexed colours.
    #[value(name = "256")]
    Indexed,
    /// 16 basic colours.
    #[value(name = "16")]
    Basic,
    /// No colours.
    Mono,
}

impl ColourChoice {
    pub(super) fn value(self) -> Choice {
        Choice::Fixed(match self {
            Self::Auto => return Choice::Auto,
            Self::True => ColourDepth::TrueColour,
            Self::Indexed => ColourDepth::Palette256,
            Self::Basic => ColourDepth::Palette16,
            Self::Mono => ColourDepth::Mono,
        })
    }
}

/// The colours of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum ThemeChoice {
    /// For dark screens.
    Dark,
    /// For light screens.
    Light,
    /// No colours except in pictures.
    Mono,
}

impl ThemeChoice {
    pub(super) fn value(self) -> Theme {
        match self {
            Self::Dark => Theme::Dark,
            Self::Light => Theme::Light,
            Self::Mono => Theme::Mono,
        }
    }
}

/// What pixels of pictures are drawn with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum PixelsChoice {
    /// Real pixels if the terminal reports that it shows them, otherwise half blocks.
    Auto,
    /// Half blocks, two pixels a cell.
    Half,
    /// Quadrants, four pixels a cell in two colours.
    Quadrant,
    /// Sextants, six pixels a cell, for fonts with Unicode 13.
    Sextant,
    /// Octants, eight pixels a cell, for fonts with Unicode 16.
    Octant,
    /// Real pixels in kitty's protocol.
    Kitty,
    /// Real pixels as sixels, in 256 colours.
    Sixel,
    /// Real pixels in iTerm2's protocol.
    Iterm,
}

impl PixelsChoice {
    pub(super) fn value(self) -> Pixels {
        match self {
            Self::Auto => Pixels::Auto,
            Self::Half => Pixels::Half,
            Self::Quadrant => Pixels::Quadrant,
            Self::Sextant => Pixels::Sextant,
            Self::Octant => Pixels::Octant,
            Self::Kitty => Pixels::Kitty,
            Self::Sixel => Pixels::Sixel,
            Self::Iterm => Pixels::Iterm,
        }
    }
}

/// How progress is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum ProgressChoice {
    /// A line, if standard error is a terminal.
    #[default]
    Auto,
    /// An object a line, the last with the event "done", the last of a frame with the event "frame".
    Json,
    /// Not at all.
    None,
}

impl ProgressChoice {
    pub(super) fn value(self) -> ProgressStyle {
        match self {
            Self::Auto => ProgressStyle::Line,
            Self::Json => ProgressStyle::Json,
            Self::None => ProgressStyle::Off,
        }
    }
}

/// What is rendered instead of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AovChoice {
    /// Distance from the eye: nearest white, farthest black.
    Depth,
    /// Surface normal: −1 to 1 as 0 to 255.
    Normal,
    /// A colour for each object; in EXR and HDR its number, from 1.
    Object,
    /// Surface colour, unlit.
    Albedo,
    /// Texture coordinates as red and green.
    Uv,
    /// Side of the surface seen: blue its front, orange its back; in EXR and HDR 1 and −1.
    Side,
    /// Rays per sample of light, with shadow rays (dark = few).
    Cost,
    /// Samples per pixel (dark = few).
    Samples,
    /// Estimated error of the light, 0 to 1 (dark = small).
    Noise,
    /// Emitted, ambient and background light only.
    Emission,
    /// Indirect light only: what arrives by way of other surfaces.
    Indirect,
}

impl AovChoice {
    pub(super) fn value(self) -> Aov {
        match self {
            Self::Depth => Aov::Depth,
            Self::Normal => Aov::Normal,
            Self::Object => Aov::Object,
            Self::Albedo => Aov::Albedo,
            Self::Uv => Aov::Uv,
            Self::Side => Aov::Side,
            Self::Cost => Aov::Cost,
            Self::Samples => Aov::Samples,
            Self::Noise => Aov::Noise,
            Self::Emission => Aov::Emission,
            Self::Indirect => Aov::Indirect,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use config::COLOURS;

    /// Checks that the words of an option mean the same in a configuration.
    fn check<C: ValueEnum, V: PartialEq>(configured: &[(&str, V)], value: fn(C) -> V) {
        assert_eq!(configured.len(), C::value_variants().len());
        for (choice, (word, meant)) in C::value_variants().iter().zip(configured) {
            let name = choice.to_possible_value().expect("it is not hidden");
            assert_eq!(name.get_name(), *word);
            assert!(value(choice.clone()) == *meant, "{word}");
        }
    }

    #[test]
    fn options_and_settings_have_the_same_words() {
        check(&COLOURS, ColourChoice::value);
        let themes = Theme::ALL.map(|theme| (theme.name(), theme));
        check(&themes, ThemeChoice::value);
        let pixels = Pixels::ALL.map(|pixels| (pixels.name(), pixels));
        check(&pixels, PixelsChoice::value);
    }
}
