//! Materials as the coefficients of Whitted's model ("An Improved Illumination Model for Shaded
//! Display", 1980), shared by more than one language.

use scene::{Dielectric, Gloss, Highlight, Material, Mirror, Reflectance, Rgb, Shadow};

/// The coefficients of a material. They alone weight the rays, and light passes where refracted
/// rays do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Coefficients {
    /// Fraction of ambient light reflected.
    pub ambient: Rgb,
    /// Fraction of light reflected diffusely.
    pub diffuse: Rgb,
    /// Strength of the Phong highlight.
    pub specular: Rgb,
    /// Phong exponent.
    pub exponent: f64,
    /// Weight of reflected rays.
    pub reflection: f64,
    /// Weight of refracted rays and of light that passes through.
    pub transmission: f64,
    /// Index of refraction.
    pub index: f64,
}

impl From<Coefficients> for Material {
    fn from(given: Coefficients) -> Self {
        Self {
            ambient: Some(given.ambient),
            diffuse: given.diffuse,
            highlight: Highlight::Phong(Gloss {
                specular: given.specular,
                exponent: given.exponent,
            }),
            mirror: Mirror {
                tint: Rgb::splat(given.reflection),
                ..Mirror::default()
            },
            dielectric: Dielectric {
                tint: Rgb::splat(given.transmission),
                index: given.index,
                reflectance: Reflectance::TotalOnly,
                ..Dielectric::OPAQUE
            },
            shadow: Shadow::passing(given.transmission),
            ..Self::BLACK
        }
    }
}
