//! Surroundings and output settings.

use super::Tinted;

/// The surroundings of a scene and the output settings its text asks for.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Setting {
    /// The background of camera rays, stretched over the whole picture.
    pub background: Tinted,
    /// The radiance of all other rays that hit nothing.
    pub environment: Tinted,
    /// The integrator.
    pub integrator: Integrator,
    /// The transfer function of colours.
    pub transfer: Transfer,
}

/// The integrator that computes radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Whitted ray tracing.
    #[default]
    Whitted,
    /// Path tracing.
    Path,
}

impl Integrator {
    /// All integrators.
    pub const ALL: [Self; 2] = [Self::Whitted, Self::Path];

    /// The name, such as `path`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whitted => "whitted",
            Self::Path => "path",
        }
    }
}

/// The transfer function applied before quantisation to bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transfer {
    /// Linear.
    #[default]
    Linear,
    /// The sRGB curve.
    Srgb,
}

impl Transfer {
    /// All transfer functions.
    pub const ALL: [Self; 2] = [Self::Linear, Self::Srgb];

    /// The name, such as `srgb`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "linear",
            Self::Srgb => "srgb",
        }
    }
}
