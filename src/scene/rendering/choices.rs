//! What render settings choose from, by words.

use super::{Value, Values};

/// Declares a choice: variants, each with its word and what it means, the default marked.
macro_rules! choice {
    (
        $(#[$doc:meta])* $name:ident:
        $($(#[$default:ident])? $variant:ident $word:literal $meaning:literal,)+
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub enum $name {
            $(#[doc = concat!($meaning, ".")] $(#[$default])? $variant,)+
        }

        impl $name {
            /// All of them.
            pub const ALL: [Self; [$($word),+].len()] = [$(Self::$variant),+];

            /// Their names, in that order.
            pub(super) const VALUES: Values = Values::Words {
                names: &[$($word),+],
                meanings: &[$($meaning),+],
            };

            /// The name, as texts and the command line spell it.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)+
                }
            }
        }

        impl Value for $name {
            fn number(self) -> f64 {
                f64::from(self as u8)
            }

            fn of(number: f64) -> Option<Self> {
                Self::ALL.get(number as usize).copied()
            }
        }
    };
}

choice! {
    /// The integrator that computes radiance.
    Integrator:
    #[default]
    Whitted "whitted" "Whitted ray tracing: rays to the lights, reflected and refracted",
    Path "path" "Path tracing: light on all paths, sampled at random; more samples reduce noise",
    Photon "photon" "Path tracing with photon maps: caustics of lights that fall off with the squared distance",
}

impl Integrator {
    /// The maximum number of bounces if no other is asked for.
    pub const fn default_depth(self) -> u32 {
        match self {
            Self::Whitted => super::DEFAULT_DEPTH,
            Self::Path | Self::Photon => super::DEFAULT_PATH_DEPTH,
        }
    }

    /// Whether it traces paths, which scatter at random.
    pub const fn traces_paths(self) -> bool {
        matches!(self, Self::Path | Self::Photon)
    }
}

choice! {
    /// The transfer function applied before quantisation to bytes.
    Transfer:
    #[default]
    Linear "linear" "Linear, without gamma",
    Srgb "srgb" "The sRGB curve",
}

choice! {
    /// The reconstruction filter of a pixel.
    Filter:
    #[default]
    Box "box" "The pixel's own area",
    Gaussian "gaussian" "A Gaussian three pixels wide, with a standard deviation of half a pixel",
    BlackmanHarris "blackman-harris" "A Blackman-Harris window three pixels wide, sharper than the Gaussian",
}

choice! {
    /// How a point light fades with the distance if its own falloff does not.
    FalloffRule:
    #[default]
    None "none" "No falloff",
    Square "square" "By the square of the distance",
}

choice! {
    /// What spreads the rays of mirrors and glass: their own cones, or the exponent of the highlight
    /// if that is [`Highlight::Blinn`](crate::Highlight::Blinn).
    GlossRule:
    #[default]
    None "none" "The glossiness of reflection and refraction",
    Exponent "exponent" "The glossiness of the material",
}
