//! Materials of surfaces.

use geometry::Side;

use super::{GlossRule, Rgb};

/// The optical properties of a surface.
///
/// A map multiplies its value by the colour of its texture.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Reflectance of ambient light; `None` if it equals the diffuse reflectance.
    pub ambient: Option<Rgb>,
    /// Diffuse reflectance; for [`Highlight::Microfacet`] the base colour of both the dielectric
    /// and the metal.
    pub diffuse: Rgb,
    /// The glossy lobe.
    pub highlight: Highlight,
    /// Mirror reflection.
    pub mirror: Mirror,
    /// Transmission.
    pub dielectric: Dielectric,
    /// Emitted radiance.
    pub emission: Rgb,
    /// The effect on shadow rays.
    pub shadow: Shadow,
    /// The faces that emit light and reflect the light of lights, as diffuse and highlight.
    pub lit: Faces,
    /// The textures of its slots, if any.
    pub maps: Option<Box<Maps>>,
}

/// The glossy lobe of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Highlight {
    /// No lobe.
    #[default]
    None,
    /// Around the mirror direction, regardless of the angle of incidence (Phong, "Illumination for
    /// Computer Generated Pictures", 1975). Not a BRDF: only sampling of lights shows it.
    Phong(Gloss),
    /// Around the mirror direction, times the cosine of incidence; normalised in path tracing
    /// (Lafortune and Willems, "Using the Modified Phong Reflectance Model for Physically Based
    /// Rendering", 1994).
    ModifiedPhong(Gloss),
    /// Around the normal, by the half vector of view and light (Blinn, "Models of light reflection
    /// for computer synthesized pictures", 1977), times the cosine of incidence; normalised in path
    /// tracing.
    Blinn(Gloss),
    /// As [`Highlight::Blinn`], but regardless of the angle of incidence in Whitted ray tracing.
    PlainBlinn(Gloss),
    /// Mirror-like microfacets (Walter and others, "Microfacet models for refraction through rough
    /// surfaces", 2007) with the material's colour and index of refraction.
    Microfacet {
        /// Square root of α; 0 is a perfect mirror.
        roughness: f64,
        /// Metallic fraction, 0 to 1.
        metallic: f64,
    },
}

/// A highlight with an exponent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Gloss {
    /// Colour and strength.
    pub specular: Rgb,
    /// Exponent; negative values count as 0.
    pub exponent: f64,
}

/// Mirror reflection of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mirror {
    /// Weight of reflected rays.
    pub tint: Rgb,
    /// Spread of reflected rays: the tangent of the half angle of their cone.
    pub spread: f64,
    /// The faces that reflect.
    pub faces: Faces,
}

/// The boundary of a transparent solid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Weight of both the refracted and the reflected light; 0 is opaque.
    pub tint: Rgb,
    /// Index of refraction; values of 0 or less count as 1.
    pub index: f64,
    /// The Fresnel model.
    pub reflectance: Reflectance,
    /// Spread of refracted and reflected rays: the tangent of the half angle of their cone.
    pub spread: f64,
    /// Absorption inside the solid, per unit of length.
    pub absorption: Rgb,
}

/// How much light the boundary of a transparent solid reflects.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reflectance {
    /// Schlick's approximation of the Fresnel equations.
    #[default]
    Schlick,
    /// Total internal reflection only.
    TotalOnly,
}

/// The effect of a surface on shadow rays.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Shadow {
    /// Light is blocked.
    #[default]
    Blocks,
    /// A solid with such a surface transmits this nonzero fraction.
    Filters(f64),
}

/// Sides of a surface.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Faces {
    /// Front and back faces.
    #[default]
    Both,
    /// Front faces only.
    Front,
}

/// The textures of a material's slots, as indices in [`super::Scene::textures`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Maps {
    /// Map of [`Material::ambient`], if that is `Some`.
    pub ambient: Option<u32>,
    /// Map of [`Material::diffuse`].
    pub diffuse: Option<u32>,
    /// Map of [`Gloss::specular`].
    pub specular: Option<u32>,
    /// Map of [`Gloss::exponent`], red channel.
    pub exponent: Option<u32>,
    /// Map of a microfacet's roughness, red channel.
    pub roughness: Option<u32>,
    /// Map of a microfacet's metallic fraction, red channel.
    pub metallic: Option<u32>,
    /// Map of [`Mirror::tint`].
    pub mirror: Option<u32>,
    /// Map of [`Dielectric::tint`].
    pub dielectric: Option<u32>,
    /// Map of [`Material::emission`].
    pub emission: Option<u32>,
    /// Bump map.
    pub bump: Option<Bump>,
}

/// A bump map.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bump {
    /// Index in [`super::Scene::textures`]; bright texels are high.
    pub texture: u32,
    /// Height of white, in world units.
    pub height: f64,
}

/// Absorption per unit of length along the rays that leave a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Losses {
    /// Along the ray that passes through.
    pub refracted: Rgb,
    /// Along the ray that is thrown back.
    pub mirrored: Rgb,
}

impl Material {
    /// A black surface that reflects and emits nothing.
    pub const BLACK: Self = Self {
        ambient: None,
        diffuse: Rgb::ZERO,
        highlight: Highlight::None,
        mirror: Mirror {
            tint: Rgb::ZERO,
            spread: 0.0,
            faces: Faces::Both,
        },
        dielectric: Dielectric::OPAQUE,
        emission: Rgb::ZERO,
        shadow: Shadow::Blocks,
        lit: Faces::Both,
        maps: None,
    };

    /// A surface of constant colour, independent of lighting.
    pub const fn unlit(colour: Rgb) -> Self {
        Self {
            emission: colour,
            ..Self::BLACK
        }
    }

    /// A representative colour.
    pub fn colour(&self) -> Rgb {
        if self.is_unlit() {
            self.emission
        } else {
            self.diffuse
        }
    }

    /// The largest share of the light that arrives, by channel, that path tracing sends on: diffuse,
    /// highlight, mirror and transmission together, as if its textures were white. Above 1, pictures grow
    /// brighter with every bounce.
    pub fn sent_on(&self) -> Rgb {
        self.diffuse + self.glossy_albedo() + self.mirror.tint + self.dielectric.tint
    }

    /// The share of the light that arrives that path tracing reflects by the highlight: the mean over
    /// directions of incidence by their cosine. That of microfacets is not counted.
    pub fn glossy_albedo(&self) -> Rgb {
        match self.highlight {
            Highlight::ModifiedPhong(gloss) => 2.0 / 3.0 * gloss.specular,
            Highlight::Blinn(gloss) | Highlight::PlainBlinn(gloss) => {
                let exponent = gloss.exponent.max(0.0);
                0.5 * (exponent + 2.0) / (exponent + 4.0) * gloss.specular
            }
            Highlight::None | Highlight::Phong(_) | Highlight::Microfacet { .. } => Rgb::ZERO,
        }
    }

    /// Whether it reflects no light diffusely or as a highlight.
    pub fn is_unlit(&self) -> bool {
        self.highlight == Highlight::None && self.diffuse == Rgb::ZERO
    }

    /// Diffuse reflectance.
    #[inline]
    pub fn diffuse(&self) -> Rgb {
        match self.highlight {
            Highlight::Microfacet { metallic, .. } => (1.0 - metallic) * self.diffuse,
            _ => self.diffuse,
        }
    }

    /// The colour shown without lighting.
    #[inline]
    pub fn albedo(&self) -> Rgb {
        if self.is_unlit() {
            self.emission
        } else {
            self.diffuse()
        }
    }

    /// The exponent by which the facets of mirrors and glass are spread; `None` if cones spread them.
    #[inline]
    pub fn facets(&self, rule: GlossRule) -> Option<f64> {
        match (rule, self.highlight) {
            (GlossRule::Exponent, Highlight::Blinn(gloss)) => Some(gloss.exponent),
            _ => None,
        }
    }

    /// Radiance under ambient light alone.
    #[inline]
    pub fn glow(&self, ambient: Rgb) -> Rgb {
        self.emission + self.ambience(ambient)
    }

    /// Reflected ambient light.
    #[inline]
    pub fn ambience(&self, ambient: Rgb) -> Rgb {
        ambient * self.ambient.unwrap_or_else(|| self.diffuse())
    }

    /// Weight of mirror reflection.
    #[inline]
    pub fn mirror_tint(&self, side: Side) -> Rgb {
        if self.mirror.faces.include(side) {
            self.mirror.tint
        } else {
            Rgb::ZERO
        }
    }

    /// Whether a side emits light and reflects that of lights.
    #[inline]
    pub fn is_lit(&self, side: Side) -> bool {
        self.lit.include(side)
    }

    /// Absorption along the rays that leave the surface; only inside the solid.
    #[inline]
    pub fn losses(&self, side: Side) -> Losses {
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

impl Default for Material {
    fn default() -> Self {
        Self::BLACK
    }
}

impl Faces {
    /// Whether a side is included.
    #[inline]
    pub fn include(self, side: Side) -> bool {
        side == Side::Front || self == Self::Both
    }
}

impl Dielectric {
    /// An opaque surface.
    pub const OPAQUE: Self = Self {
        tint: Rgb::ZERO,
        index: 1.0,
        reflectance: Reflectance::Schlick,
        spread: 0.0,
        absorption: Rgb::ZERO,
    };
}

impl Shadow {
    /// The fraction of light that passes.
    #[inline]
    pub fn transmittance(self) -> f64 {
        match self {
            Self::Blocks => 0.0,
            Self::Filters(share) => share,
        }
    }

    /// The effect of a solid that transmits this fraction of light.
    pub fn passing(share: f64) -> Self {
        if share == 0.0 {
            Self::Blocks
        } else {
            Self::Filters(share)
        }
    }
}

impl Maps {
    /// Boxes the maps for a material; `None` if all slots are empty.
    pub fn boxed(self) -> Option<Box<Self>> {
        (self != Self::default()).then(|| Box::new(self))
    }
}
