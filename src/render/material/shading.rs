//! Evaluation of materials at a point, for all integrators.

use geometry::Side;
use scene::{Highlight, Material, Rgb};

use super::optics;
use super::optics::{normal_reflectance, power};

/// Reflectance of microfacets at normal incidence, for a metallic fraction.
pub(crate) fn facets_reflectance(material: &Material, metallic: f64) -> Rgb {
    (1.0 - metallic) * normal_reflectance(index(material), 1.0) + metallic * material.diffuse
}

/// The reflected fraction of a light's light in Whitted ray tracing, from the cosine of
/// incidence, that between view and mirrored light, and that of the half vector.
#[inline(always)]
pub(crate) fn reflectance(
    material: &Material,
    cosine: f64,
    mirrored: f64,
    halfway: impl FnOnce() -> f64,
) -> Rgb {
    match material.highlight {
        Highlight::None => material.diffuse * cosine,
        Highlight::Phong(gloss) => {
            material.diffuse * cosine + gloss.specular * power(mirrored, gloss.exponent)
        }
        Highlight::ModifiedPhong(gloss) => {
            let highlight = power(mirrored.min(1.0), gloss.exponent);
            cosine * (material.diffuse + gloss.specular * highlight)
        }
        Highlight::Blinn(gloss) => {
            let highlight = power(halfway().min(1.0), gloss.exponent);
            cosine * (material.diffuse + gloss.specular * highlight)
        }
        Highlight::PlainBlinn(gloss) => {
            let highlight = power(halfway().min(1.0), gloss.exponent);
            material.diffuse * cosine + gloss.specular * highlight
        }
        Highlight::Microfacet {
            roughness,
            metallic,
        } => {
            let alpha = roughness * roughness;
            // The exponent of a highlight of about the same width.
            let highlight = power(halfway().min(1.0), 2.0 / (alpha * alpha) - 2.0);
            cosine * (material.diffuse() + facets_reflectance(material, metallic) * highlight)
        }
    }
}

/// Weight of a reflected ray in Whitted ray tracing, microfacets' normal reflectance included.
#[inline]
pub(crate) fn mirror_weight(material: &Material, side: Side) -> Rgb {
    let tint = material.mirror_tint(side);
    match material.highlight {
        Highlight::Microfacet { metallic, .. } if side == Side::Front => {
            tint + facets_reflectance(material, metallic)
        }
        _ => tint,
    }
}

/// Effective index of refraction, above 0.
#[inline]
pub(crate) fn index(material: &Material) -> f64 {
    optics::index(material.dielectric.index)
}

/// Indices of refraction on the incident and the transmitted side.
#[inline]
pub(crate) fn refraction_indices(material: &Material, side: Side) -> [f64; 2] {
    match side {
        Side::Front => [1.0, index(material)],
        Side::Back => [index(material), 1.0],
    }
}
