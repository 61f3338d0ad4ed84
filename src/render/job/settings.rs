//! Render settings.

use super::aov::Aov;
use super::region::Region;
use scene::{Rendering, Size, render_settings};

macro_rules! settings {
    ($($(#[$doc:meta])* $key:ident: $type:ty = $default:expr, $setting:expr;)+) => {
        /// Render settings; with scene, images and camera they determine every pixel.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct Settings {
            /// Resolution of the whole picture; does not affect the framing.
            pub size: Size,
            /// The only part of the picture to trace, if not all of it. Its pixels are the same as in
            /// the whole picture, except that the 8-bit values of depth span the distances in the
            /// region.
            pub region: Option<Region>,
            /// Random seed.
            pub seed: u32,
            /// The AOV to render instead of light.
            pub aov: Option<Aov>,
            $($(#[$doc])* pub $key: $type,)+
        }

        impl Settings {
            /// The settings of a whole picture of light, with defaults for what is not asked for.
            pub fn new(size: Size, asked: &Rendering) -> Self {
                Self {
                    size,
                    region: None,
                    seed: 0,
                    aov: None,
                    $($key: asked.$key(),)+
                }
            }

            /// What asks for these settings.
            pub(crate) fn asked(&self) -> Rendering {
                Rendering {
                    $($key: Some(self.$key),)+
                    default_depths: None,
                }
            }
        }
    };
}

render_settings!(settings);

impl Settings {
    /// What is traced: the region, or the whole picture.
    pub fn traced(&self) -> Region {
        self.region.unwrap_or_else(|| Region::whole(self.size))
    }

    /// The number of passes to all samples: 1, 1, 2, 4 …
    pub fn passes(&self) -> u32 {
        1 + self.spp.next_power_of_two().ilog2()
    }

    /// The AOV of the surfaces to trace instead of light.
    pub(crate) fn surface(&self) -> Option<Aov> {
        self.aov.filter(|aov| !aov.is_of_light() && !aov.is_share())
    }

    /// The noise below which pixels take no more samples: AOVs of surfaces have none, and shares of the
    /// light must add up.
    pub(crate) fn adaptive(&self) -> Option<f64> {
        let is_light = self.aov.is_none_or(Aov::is_of_light);
        (is_light && 0.0 < self.noise).then_some(self.noise)
    }

    /// The settings that a film depends on, apart from the samples, which are 1: what is known from
    /// tracing light is shown of the film of light.
    #[must_use]
    pub fn of_film(&self) -> Self {
        Self {
            aov: self.aov.filter(|aov| !aov.is_of_light()),
            spp: 1,
            ..*self
        }
    }

    /// Whether a film traced with these settings holds what others show, or the first samples of
    /// it.
    pub(crate) fn trace_alike(&self, other: &Self) -> bool {
        self.of_film() == other.of_film()
    }
}
