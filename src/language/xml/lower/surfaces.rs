//! Materials and lights.

use std::f64::consts::PI;

use glam::DVec3;

use super::Lowering;
use crate::xml::table::materials::{
    ABSORPTION, COLOUR, DIFFUSE, EMISSION, GLOSSINESS, INDEX, METALLIC, REFLECTION, REFRACTION,
    REFRACTION_INDEX, ROUGHNESS, SPECULAR, SPREAD, TRANSMITTANCE,
};
use crate::xml::table::{LightKind, MaterialKind, lights};
use geometry::normalise;
use scene::{
    Dielectric, Emitter, Faces, Falloff, Gloss, Highlight, Light, Maps, Material, Mirror,
    Reflectance, Rgb, Shadows, Transfer,
};

impl Lowering<'_> {
    pub(super) fn material(&mut self, index: usize) {
        let (kind, element) = {
            let place = &self.origins.materials[index];
            (place.kind, place.element as usize)
        };
        let material = match kind {
            MaterialKind::Blinn => self.glossy(element, Highlight::Blinn),
            MaterialKind::Phong => self.glossy(element, Highlight::ModifiedPhong),
            MaterialKind::Microfacet => self.microfacet(element),
        };
        self.materials.push(material);
    }

    fn glossy(&mut self, element: usize, highlight: fn(Gloss) -> Highlight) -> Material {
        let diffuse = self.tinted(element, &DIFFUSE);
        let specular = self.tinted(element, &SPECULAR);
        let (exponent, exponent_map) = self.textured(element, &GLOSSINESS);
        let mirror = self.tinted(element, &REFLECTION);
        let mirror_spread = self.extra(element, &REFLECTION, &SPREAD);
        let dielectric = self.tinted(element, &REFRACTION);
        let dielectric_spread = self.extra(element, &REFRACTION, &SPREAD);
        let index = self.extra(element, &REFRACTION, &REFRACTION_INDEX);
        let absorption = self.vector(Some(element), &ABSORPTION);
        let emission = self.tinted(element, &EMISSION);
        let maps = Maps {
            diffuse: diffuse.texture,
            specular: specular.texture,
            exponent: exponent_map,
            mirror: mirror.texture,
            dielectric: dielectric.texture,
            emission: emission.texture,
            ..Maps::default()
        };
        Material {
            diffuse: diffuse.colour,
            highlight: highlight(Gloss {
                specular: specular.colour,
                exponent,
            }),
            mirror: Mirror {
                tint: mirror.colour,
                spread: mirror_spread,
                faces: Faces::Front,
            },
            dielectric: Dielectric {
                tint: dielectric.colour,
                index,
                spread: dielectric_spread,
                absorption,
                reflectance: Reflectance::Schlick,
            },
            emission: emission.colour,
            lit: lit(dielectric.colour),
            maps: maps.boxed(),
            ..Material::BLACK
        }
    }

    fn microfacet(&mut self, element: usize) -> Material {
        let colour = self.tinted(element, &COLOUR);
        let (roughness, roughness_map) = self.textured(element, &ROUGHNESS);
        let (metallic, metallic_map) = self.textured(element, &METALLIC);
        let dielectric = self.tinted(element, &TRANSMITTANCE);
        let index = self.number(Some(element), &INDEX);
        let absorption = self.vector(Some(element), &ABSORPTION);
        let emission = self.tinted(element, &EMISSION);
        let maps = Maps {
            diffuse: colour.texture,
            roughness: roughness_map,
            metallic: metallic_map,
            dielectric: dielectric.texture,
            emission: emission.texture,
            ..Maps::default()
        };
        Material {
            diffuse: colour.colour,
            highlight: Highlight::Microfacet {
                roughness,
                metallic,
            },
            dielectric: Dielectric {
                tint: dielectric.colour,
                index,
                absorption,
                ..Dielectric::OPAQUE
            },
            emission: emission.colour,
            lit: lit(dielectric.colour),
            maps: maps.boxed(),
            ..Material::BLACK
        }
    }

    pub(super) fn light(&mut self, index: usize) {
        let (kind, element) = {
            let place = &self.origins.lights[index];
            (place.kind, place.element as usize)
        };
        let dark = Light {
            emitter: Emitter::Ambient,
            colour: Rgb::ZERO,
            // Path tracing must not darken a scene that is not made for it.
            scale: match self.origins.transfer {
                Transfer::Srgb => 1.0,
                Transfer::Linear => PI,
            },
            shadows: Shadows::Cast,
        };
        let light = match kind {
            LightKind::Ambient => Light {
                colour: self.vector(Some(element), &lights::INTENSITY),
                ..dark
            },
            LightKind::Direct => {
                let colour = self.vector(Some(element), &lights::INTENSITY);
                let emitter = Emitter::Distant(self.toward(element));
                Light {
                    emitter,
                    colour,
                    ..dark
                }
            }
            LightKind::Point => self.point(element, dark),
        };
        self.lights.push(light);
    }

    /// The unit vector toward a light, opposite to its direction.
    fn toward(&mut self, element: usize) -> DVec3 {
        let direction = self.vector(Some(element), &lights::DIRECTION);
        if let Some(direction) = normalise(direction) {
            return -direction;
        }
        // Malformed numbers were already reported.
        if let Some(element) = self
            .element_of(Some(element), &lights::DIRECTION)
            .filter(|_| direction == DVec3::ZERO)
        {
            self.zero(element);
        }
        DVec3::Z
    }

    fn point(&mut self, element: usize, dark: Light) -> Light {
        let colour = self.vector(Some(element), &lights::INTENSITY);
        let position = self.vector(Some(element), &lights::POSITION);
        let radius = self.number(Some(element), &lights::RADIUS);
        let attenuation = self.number(Some(element), &lights::ATTENUATION);
        let falloff = if 0.0 < attenuation {
            Falloff {
                radial: [0.0, 0.0, attenuation * attenuation],
                spot: None,
            }
        } else {
            Falloff::NONE
        };
        Light {
            emitter: Emitter::Point {
                position,
                radius,
                falloff,
            },
            colour,
            ..dark
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
