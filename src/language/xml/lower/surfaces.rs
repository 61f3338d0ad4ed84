//! Materials and lights.

use std::f64::consts::PI;

use glam::DVec3;

use super::Lowering;
use crate::schema::Category;
use crate::xml::schema::{
    ABSORPTION, ATTENUATION, COLOUR, DIFFUSE, DIRECT, DIRECTION, EMISSION, GLOSSINESS, INDEX,
    INTENSITY, METALLIC, MICROFACET, PHONG, POINT, POSITION, RADIUS, REFLECTION, REFRACTION,
    REFRACTION_INDEX, ROUGHNESS, SPECULAR, SPREAD, TRANSMITTANCE,
};
use geometry::normalise;
use scene::{
    Dielectric, Emitter, Faces, Falloff, Gloss, Highlight, Light, Maps, Material, Mirror,
    Reflectance, Rgb, Shadows, Transfer,
};

impl Lowering<'_> {
    pub(super) fn material(&mut self, index: usize) {
        let place = &self.origins.of(Category::Material)[index];
        let (kind, element) = (place.kind, place.element as usize);
        let (mut material, mut maps) = if *kind == MICROFACET {
            self.microfacet(element)
        } else {
            self.glossy(element, *kind == PHONG)
        };
        material.dielectric.absorption = self.vector(Some(element), &ABSORPTION);
        let emission = self.tinted(element, &EMISSION);
        material.emission = emission.colour;
        maps.emission = emission.texture;
        material.lit = lit(material.dielectric.tint);
        material.maps = maps.boxed();
        self.materials.push(material);
    }

    fn glossy(&mut self, element: usize, is_phong: bool) -> (Material, Maps) {
        let diffuse = self.tinted(element, &DIFFUSE);
        let specular = self.tinted(element, &SPECULAR);
        let (exponent, exponent_map) = self.textured(element, &GLOSSINESS);
        let mirror = self.tinted(element, &REFLECTION);
        let mirror_spread = self.extra(element, &REFLECTION, &SPREAD);
        let dielectric = self.tinted(element, &REFRACTION);
        let dielectric_spread = self.extra(element, &REFRACTION, &SPREAD);
        let index = self.extra(element, &REFRACTION, &REFRACTION_INDEX);
        let gloss = Gloss {
            specular: specular.colour,
            exponent,
        };
        let material = Material {
            diffuse: diffuse.colour,
            highlight: if is_phong {
                Highlight::ModifiedPhong(gloss)
            } else {
                Highlight::Blinn(gloss)
            },
            mirror: Mirror {
                tint: mirror.colour,
                spread: mirror_spread,
                faces: Faces::Front,
            },
            dielectric: Dielectric {
                tint: dielectric.colour,
                index,
                spread: dielectric_spread,
                reflectance: Reflectance::Schlick,
                ..Dielectric::OPAQUE
            },
            ..Material::BLACK
        };
        let maps = Maps {
            diffuse: diffuse.texture,
            specular: specular.texture,
            exponent: exponent_map,
            mirror: mirror.texture,
            dielectric: dielectric.texture,
            ..Maps::default()
        };
        (material, maps)
    }

    fn microfacet(&mut self, element: usize) -> (Material, Maps) {
        let colour = self.tinted(element, &COLOUR);
        let (roughness, roughness_map) = self.textured(element, &ROUGHNESS);
        let (metallic, metallic_map) = self.textured(element, &METALLIC);
        let dielectric = self.tinted(element, &TRANSMITTANCE);
        let index = self.number(Some(element), &INDEX);
        let material = Material {
            diffuse: colour.colour,
            highlight: Highlight::Microfacet {
                roughness,
                metallic,
            },
            dielectric: Dielectric {
                tint: dielectric.colour,
                index,
                ..Dielectric::OPAQUE
            },
            ..Material::BLACK
        };
        let maps = Maps {
            diffuse: colour.texture,
            roughness: roughness_map,
            metallic: metallic_map,
            dielectric: dielectric.texture,
            ..Maps::default()
        };
        (material, maps)
    }

    pub(super) fn light(&mut self, index: usize) {
        let place = &self.origins.of(Category::Light)[index];
        let (kind, element) = (place.kind, place.element as usize);
        let colour = self.vector(Some(element), &INTENSITY);
        let emitter = if *kind == DIRECT {
            Emitter::Distant(self.toward(element))
        } else if *kind == POINT {
            self.point(element)
        } else {
            Emitter::Ambient
        };
        self.lights.push(Light {
            emitter,
            colour,
            // Path tracing must not darken a scene that is not made for it.
            scale: match self.origins.transfer {
                Transfer::Srgb => 1.0,
                Transfer::Linear => PI,
            },
            shadows: Shadows::Cast,
        });
    }

    /// The unit vector toward a light, opposite to its direction.
    fn toward(&mut self, element: usize) -> DVec3 {
        let direction = self.vector(Some(element), &DIRECTION);
        if let Some(direction) = normalise(direction) {
            return -direction;
        }
        // Malformed numbers were already reported.
        let stated = self.element_of(Some(element), &DIRECTION);
        if let Some(element) = stated.filter(|_| direction == DVec3::ZERO) {
            let (name, span) = (self.display_name(element), self.attributes_span(element));
            let message = || format!("{name}: must not be zero");
            self.error(span, message, "a direction");
        }
        DVec3::Z
    }

    fn point(&mut self, element: usize) -> Emitter {
        let position = self.vector(Some(element), &POSITION);
        let radius = self.number(Some(element), &RADIUS);
        let attenuation = self.number(Some(element), &ATTENUATION);
        let falloff = if 0.0 < attenuation {
            Falloff {
                radial: [0.0, 0.0, attenuation * attenuation],
                spot: None,
            }
        } else {
            Falloff::NONE
        };
        Emitter::Point {
            position,
            radius,
            falloff,
        }
    }
}

/// The lit faces of a material: only the front if light passes through it.
pub(super) fn lit(transmittance: Rgb) -> Faces {
    if transmittance == Rgb::ZERO {
        Faces::Both
    } else {
        Faces::Front
    }
}
