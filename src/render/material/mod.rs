//! What a surface does with light: textures, Whitted's shading, lobes, mirrors and boundaries. Knows
//! no lights and no other surfaces.

mod bsdf;
mod lobes;
mod microfacet;
mod optics;
mod point;
mod shading;
mod texture;

pub(crate) use bsdf::{Bsdf, BsdfSample, Component, Scattering};
#[cfg(test)]
pub(crate) use lobes::Lobes;
pub(crate) use lobes::{Diffuse, LobeSamples, Scattered};
pub(crate) use microfacet::Microfacets;
#[cfg(test)]
pub(crate) use optics::refract;
pub(crate) use optics::{
    Refraction, facet, folded, fresnel, mirror, power, power_each, reflect, refract_all, spread,
    strength, transmitted,
};
pub(crate) use point::Point;
pub(crate) use shading::{facets_reflectance, mirror_weight, reflectance, refraction_indices};
pub(crate) use texture::{LUMINANCE, Textures, environment_place};
