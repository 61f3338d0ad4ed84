//! Evaluation of materials at a point, for both integrators.

use glam::DVec3;

use super::optics;
use super::optics::{normal_reflectance, power};
use crate::scene::{Faces, GlossRule, Highlight, Material, Rgb};

/// The side of a surface that a ray hits, by the geometric normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The side that the outward normal points to.
    Front,
    /// The inside of a solid.
    Back,
}

/// Absorption per unit of length along the rays that leave a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Losses {
    pub(crate) refracted: Rgb,
    pub(crate) mirrored: Rgb,
}

impl Material {
    /// Diffuse reflectance.
    #[inline]
    pub(crate) fn diffuse(&self) -> Rgb {
        match self.highlight {
            Highlight::Microfacet { metallic, .. } => (1.0 - metallic) * self.diffuse,
            _ => self.diffuse,
        }
    }

    /// The colour shown without lighting.
    pub(crate) fn albedo(&self) -> Rgb {
        if self.is_unlit() {
            self.emission
        } else {
            self.diffuse()
        }
    }

    /// The exponent by which the facets of mirrors and glass are spread; `None` if cones spread them.
    #[inline]
    pub(crate) fn facets(&self, rule: GlossRule) -> Option<f64> {
        match (rule, self.highlight) {
            (GlossRule::Exponent, Highlight::Blinn(gloss)) => Some(gloss.exponent),
            _ => None,
        }
    }

    /// Radiance under ambient light alone.
    #[inline]
    pub(crate) fn glow(&self, ambient: Rgb) -> Rgb {
        self.emission + self.ambience(ambient)
    }

    /// Reflected ambient light.
    #[inline]
    pub(crate) fn ambience(&self, ambient: Rgb) -> Rgb {
        ambient * self.ambient.unwrap_or_else(|| self.diffuse())
    }

    /// Reflectance of microfacets at normal incidence, for a metallic fraction.
    pub(crate) fn facets_reflectance(&self, metallic: f64) -> Rgb {
        (1.0 - metallic) * normal_reflectance(self.index(), 1.0) + metallic * self.diffuse
    }

    /// The reflected fraction of a light's light in Whitted ray tracing, from the cosine of
    /// incidence, that between view and mirrored light, and that of the half vector.
    #[inline(always)]
    pub(crate) fn reflected(
        &self,
        cosine: f64,
        mirrored: f64,
        halfway: impl FnOnce() -> f64,
    ) -> Rgb {
        match self.highlight {
            Highlight::None => self.diffuse * cosine,
            Highlight::Phong(gloss) => {
                self.diffuse * cosine + gloss.specular * power(mirrored, gloss.exponent)
            }
            Highlight::ModifiedPhong(gloss) => {
                let highlight = power(mirrored.min(1.0), gloss.exponent);
                cosine * (self.diffuse + gloss.specular * highlight)
            }
            Highlight::Blinn(gloss) => {
                let highlight = power(halfway().min(1.0), gloss.exponent);
                cosine * (self.diffuse + gloss.specular * highlight)
            }
            Highlight::Microfacet {
                roughness,
                metallic,
            } => {
                let alpha = roughness * roughness;
                // The exponent of a highlight of about the same width.
                let highlight = power(halfway().min(1.0), 2.0 / (alpha * alpha) - 2.0);
                cosine * (self.diffuse() + self.facets_reflectance(metallic) * highlight)
            }
        }
    }

    /// Weight of a reflected ray in Whitted ray tracing, microfacets' normal reflectance included.
    #[inline]
    pub(crate) fn mirrored(&self, side: Side) -> Rgb {
        let tint = self.mirror_tint(side);
        match self.highlight {
            Highlight::Microfacet { metallic, .. } if side == Side::Front => {
                tint + self.facets_reflectance(metallic)
            }
            _ => tint,
        }
    }

    /// Weight of mirror reflection.
    #[inline]
    pub(crate) fn mirror_tint(&self, side: Side) -> Rgb {
        if self.mirror.faces.include(side) {
            self.mirror.tint
        } else {
            Rgb::ZERO
        }
    }

    /// Whether a side emits light and reflects that of lights.
    #[inline]
    pub(crate) fn is_lit(&self, side: Side) -> bool {
        self.lit.include(side)
    }

    /// Effective index of refraction, above 0.
    #[inline]
    pub(crate) fn index(&self) -> f64 {
        optics::index(self.dielectric.index)
    }

    /// Indices of refraction on the incident and the transmitted side.
    #[inline]
    pub(crate) fn indices(&self, side: Side) -> [f64; 2] {
        match side {
            Side::Front => [1.0, self.index()],
            Side::Back => [self.index(), 1.0],
        }
    }

    /// Absorption along the rays that leave the surface; only inside the solid.
    #[inline]
    pub(crate) fn losses(&self, side: Side) -> Losses {
        let [inside, outside] = [self.dielectric.absorption, Rgb::ZERO];
        let [refracted, mirrored] = match side {
            Side::Front => [inside, outside],
            Side::Back => [outside, inside],
        };
        Losses {
            refracted,
            mirrored,
        }
    }
}

impl Side {
    /// The side of a surface with outward `normal` that a ray in `direction` hits.
    #[inline]
    pub(crate) fn hit(direction: DVec3, normal: DVec3) -> Self {
        if direction.dot(normal) < 0.0 {
            Self::Front
        } else {
            Self::Back
        }
    }

    /// Turns an outward normal to this side.
    #[inline]
    pub(crate) fn turn(self, normal: DVec3) -> DVec3 {
        match self {
            Self::Front => normal,
            Self::Back => -normal,
        }
    }
}

impl Faces {
    /// Whether a side is included.
    #[inline]
    pub(crate) fn include(self, side: Side) -> bool {
        side == Side::Front || self == Self::Both
    }
}
