//! Render settings, as a text or a user asks for them.

use std::ops::RangeInclusive;

/// Default samples per pixel of full-size pictures.
pub const DEFAULT_SPP: u32 = 16;

/// Default maximum of samples per pixel with adaptive sampling.
const DEFAULT_ADAPTIVE_SPP: u32 = 4096;

/// The number of samples after which adaptive sampling may first stop a pixel.
pub const LEAST_ADAPTIVE_SPP: u32 = 16;

/// Maximum samples per pixel: the length of the sample sequence.
pub const MAX_SPP: u32 = 65_536;

/// Default depth of Whitted ray tracing.
pub const DEFAULT_DEPTH: u32 = 8;

/// Default depth of path tracing; most paths end earlier.
const DEFAULT_PATH_DEPTH: u32 = 64;

/// The highest number of bounces; see the renderer's ray budget.
pub const MAX_DEPTH: u32 = 4096;

/// The exposures that can be asked for, in stops: beyond, single precision overflows soon.
pub const EXPOSURES: RangeInclusive<f64> = -100.0..=100.0;

/// Render settings that are asked for; `None` leaves the choice to whoever asks with less
/// precedence, in the end to the defaults.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rendering {
    /// The integrator.
    pub integrator: Option<Integrator>,
    /// Maximum number of bounces, 0 to [`MAX_DEPTH`].
    pub depth: Option<u32>,
    /// Samples per pixel, 1 to [`MAX_SPP`].
    pub spp: Option<u32>,
    /// The pixel reconstruction filter.
    pub filter: Option<Filter>,
    /// The transfer function to 8-bit values.
    pub transfer: Option<Transfer>,
    /// Exposure in stops, one of [`EXPOSURES`].
    pub exposure: Option<f64>,
    /// How lights fade whose own falloff does not say so.
    pub falloff: Option<FalloffRule>,
    /// What spreads mirrors and glass.
    pub gloss: Option<GlossRule>,
    /// The noise below which pixels take no more samples, in displayed values, 0 to less than 1; 0
    /// turns adaptive sampling off.
    pub noise: Option<f64>,
    /// What the largest channel of each sample is limited to, 0 or more; 0 turns the limit off. No text
    /// states it.
    pub clamp: Option<f64>,
}

impl Rendering {
    /// These settings, completed by others.
    #[must_use]
    pub fn or(self, others: Self) -> Self {
        Self {
            integrator: self.integrator.or(others.integrator),
            depth: self.depth.or(others.depth),
            spp: self.spp.or(others.spp),
            filter: self.filter.or(others.filter),
            transfer: self.transfer.or(others.transfer),
            exposure: self.exposure.or(others.exposure),
            falloff: self.falloff.or(others.falloff),
            gloss: self.gloss.or(others.gloss),
            noise: self.noise.or(others.noise),
            clamp: self.clamp.or(others.clamp),
        }
    }

    /// The integrator asked for, or the default.
    pub fn integrator(&self) -> Integrator {
        self.integrator.unwrap_or_default()
    }

    /// The depth asked for, or the integrator's default.
    pub fn depth(&self) -> u32 {
        self.depth
            .unwrap_or_else(|| self.integrator().default_depth())
    }

    /// The samples per pixel asked for, or the default of full-size pictures; at most, with adaptive
    /// sampling.
    pub fn spp(&self) -> u32 {
        let default = match self.noise() {
            None => DEFAULT_SPP,
            Some(_) => DEFAULT_ADAPTIVE_SPP,
        };
        self.spp.unwrap_or(default)
    }

    /// What the largest channel of each sample is limited to, above 0; `None` if it is not.
    pub fn clamp(&self) -> Option<f64> {
        self.clamp.filter(|&most| 0.0 < most)
    }

    /// The noise below which pixels take no more samples, above 0; `None` if all take as many.
    pub fn noise(&self) -> Option<f64> {
        self.noise.filter(|&noise| 0.0 < noise)
    }
}

/// The integrator that computes radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Integrator {
    /// Whitted ray tracing.
    #[default]
    Whitted,
    /// Path tracing.
    Path,
    /// Path tracing with a photon map for caustics.
    Photon,
}

impl Integrator {
    /// All integrators.
    pub const ALL: [Self; 3] = [Self::Whitted, Self::Path, Self::Photon];

    /// The name, such as `path`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Whitted => "whitted",
            Self::Path => "path",
            Self::Photon => "photon",
        }
    }

    /// The maximum number of bounces if no other is asked for.
    pub const fn default_depth(self) -> u32 {
        match self {
            Self::Whitted => DEFAULT_DEPTH,
            Self::Path | Self::Photon => DEFAULT_PATH_DEPTH,
        }
    }

    /// Whether it traces paths, which scatter at random.
    pub const fn traces_paths(self) -> bool {
        matches!(self, Self::Path | Self::Photon)
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

/// The reconstruction filter of a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The area of the pixel.
    #[default]
    Box,
    /// A Gaussian with a standard deviation of half a pixel, three pixels wide.
    Gaussian,
    /// The four-term Blackman-Harris window, three pixels wide.
    BlackmanHarris,
}

impl Filter {
    /// All filters.
    pub const ALL: [Self; 3] = [Self::Box, Self::Gaussian, Self::BlackmanHarris];

    /// The name, such as `blackman-harris`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Box => "box",
            Self::Gaussian => "gaussian",
            Self::BlackmanHarris => "blackman-harris",
        }
    }
}

/// How a point light fades with the distance if its own falloff does not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FalloffRule {
    /// It does not fade.
    #[default]
    None,
    /// By the square of the distance.
    Square,
}

impl FalloffRule {
    /// All rules.
    pub const ALL: [Self; 2] = [Self::None, Self::Square];

    /// The name, such as `square`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Square => "square",
        }
    }
}

/// What spreads the rays of mirrors and glass.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GlossRule {
    /// Their own cones.
    #[default]
    None,
    /// The exponent of the highlight, if that is [`Highlight::Blinn`](super::Highlight::Blinn).
    Exponent,
}

impl GlossRule {
    /// All rules.
    pub const ALL: [Self; 2] = [Self::None, Self::Exponent];

    /// The name, such as `exponent`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Exponent => "exponent",
        }
    }
}
