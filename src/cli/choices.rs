//! Words that are chosen from a few, and what they mean.

use clap::ValueEnum;

use crate::render::{Aov, Filter};
use crate::scene::{Integrator, Transfer};
use crate::ui::terminal::{Choice, ColourDepth};

/// How many colours the terminal is sent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum ColourChoice {
    /// As many as it is found to show.
    #[default]
    Auto,
    /// 24-bit colours.
    #[value(name = "24")]
    True,
    /// The 256 indexed colours.
    #[value(name = "256")]
    Indexed,
    /// The 16 basic colours.
    #[value(name = "16")]
    Basic,
    /// None.
    Mono,
}

impl ColourChoice {
    pub(super) fn meaning(self) -> Choice {
        Choice::Fixed(match self {
            Self::Auto => return Choice::Auto,
            Self::True => ColourDepth::TrueColour,
            Self::Indexed => ColourDepth::Palette256,
            Self::Basic => ColourDepth::Palette16,
            Self::Mono => ColourDepth::Mono,
        })
    }
}

/// What a picture shows instead of light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum AovChoice {
    /// How far it is from the eye: the nearest white, the farthest black.
    Depth,
    /// Its normal: −1 to 1 as 0 to 255.
    Normal,
    /// Which object it is of: a colour each; in EXR and HDR its place, from 1.
    Object,
    /// Its own colour, unlit.
    Albedo,
}

impl AovChoice {
    pub(super) fn meaning(self) -> Aov {
        match self {
            Self::Depth => Aov::Depth,
            Self::Normal => Aov::Normal,
            Self::Object => Aov::Object,
            Self::Albedo => Aov::Albedo,
        }
    }
}

/// How light is gathered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum IntegratorChoice {
    /// By Whitted's rays: to the lights, mirrored and refracted.
    Whitted,
    /// By random paths, which bring light by every way; noise falls with the samples.
    Path,
}

impl IntegratorChoice {
    pub(super) fn meaning(self) -> Integrator {
        match self {
            Self::Whitted => Integrator::Whitted,
            Self::Path => Integrator::Path,
        }
    }
}

/// What of its surroundings a pixel is the mean of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub(super) enum FilterChoice {
    /// The pixel itself.
    #[default]
    Box,
    /// A Gaussian three pixels wide, its deviation half a pixel.
    Gaussian,
    /// The Blackman-Harris window, three pixels wide: sharper than the Gaussian.
    BlackmanHarris,
}

impl FilterChoice {
    pub(super) fn meaning(self) -> Filter {
        match self {
            Self::Box => Filter::Box,
            Self::Gaussian => Filter::Gaussian,
            Self::BlackmanHarris => Filter::BlackmanHarris,
        }
    }
}

/// How colours become 8-bit values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum TransferChoice {
    /// As they are, without gamma.
    Linear,
    /// By the curve of sRGB.
    Srgb,
}

impl TransferChoice {
    pub(super) fn meaning(self) -> Transfer {
        match self {
            Self::Linear => Transfer::Linear,
            Self::Srgb => Transfer::Srgb,
        }
    }
}
