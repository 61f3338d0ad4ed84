//! Which part of the light is traced: all of it, or the share of one source.
//!
//! The direct light of every light, the emission and the indirect light add up to all light. A
//! share is told by the bounce at which its light enters, so that its samples are those of the
//! whole picture.

use crate::job::Aov;
use scene::Integrator;

/// The part of the light that is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LightComponent {
    /// All of it.
    All,
    /// What the first surface reflects of the light with this index.
    Direct(u32),
    /// What is seen to glow: emission and ambient light of the first surface, the background, and
    /// lights with a size.
    Emission,
    /// What arrives over further surfaces.
    Indirect,
}

impl LightComponent {
    pub(crate) fn of(aov: Option<Aov>) -> Self {
        match aov {
            Some(Aov::Direct(light)) => Self::Direct(light),
            Some(Aov::Emission) => Self::Emission,
            Some(Aov::Indirect) => Self::Indirect,
            _ => Self::All,
        }
    }

    /// The bounce up to which rays matter.
    pub(crate) fn depth(self, integrator: Integrator, depth: u32) -> u32 {
        match (self, integrator) {
            (Self::All | Self::Indirect, _) => depth,
            // Samples of the surface may hit the light.
            (Self::Direct(_), Integrator::Path | Integrator::Photon) => depth.min(1),
            (Self::Direct(_), Integrator::Whitted) | (Self::Emission, _) => 0,
        }
    }

    /// Whether what glows at a bounce counts.
    #[inline]
    pub(crate) fn glow(self, bounce: u32) -> bool {
        match self {
            Self::All => true,
            Self::Direct(_) => false,
            Self::Emission => bounce == 0,
            Self::Indirect => 0 < bounce,
        }
    }

    /// Whether what surfaces at a bounce glow and reflect of the lights counted may count.
    #[inline]
    pub(crate) fn surface(self, bounce: u32) -> bool {
        self != Self::Indirect || 0 < bounce
    }

    /// Whether what surfaces reflect of a light counts at any bounce.
    #[inline]
    pub(crate) fn light_anywhere(self, number: usize) -> bool {
        self.light(number, 0) || self.light(number, 1)
    }

    /// Whether what surfaces reflect of photons, which came over further surfaces, counts.
    #[inline]
    pub(crate) fn caustics(self) -> bool {
        matches!(self, Self::All | Self::Indirect)
    }

    /// Whether what a surface reflects of a light at a bounce counts.
    #[inline]
    pub(crate) fn light(self, number: usize, bounce: u32) -> bool {
        match self {
            Self::All => true,
            Self::Direct(light) => bounce == 0 && light as usize == number,
            Self::Emission => false,
            Self::Indirect => 0 < bounce,
        }
    }
}
