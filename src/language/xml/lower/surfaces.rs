//! Materials and lights.

use std::f64::consts::PI;

use glam::DVec3;

use super::Reader;
use crate::geometry::normalise;
use crate::language::xml::table::{
    AMBIENT, DIRECT, LightKind, MATERIAL, MICROFACET, MaterialKind, POINT, Parameter,
};
use crate::scene::{
    Dielectric, Emitter, Faces, Falloff, Gloss, Highlight, Integrator, Light, Maps, Material,
    Mirror, Reflectance, Rgb, Shadows,
};

/// The parameter of a list with this name.
fn called(parameters: &'static [Parameter], element: &str) -> &'static Parameter {
    parameters
        .iter()
        .find(|parameter| parameter.element == element)
        .expect("the table has what is read from it")
}

impl Reader<'_> {
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
        let of = |name| called(&MATERIAL, name);
        let diffuse = self.tinted(element, of("diffuse"));
        let specular = self.tinted(element, of("specular"));
        let (exponent, exponent_map) = self.textured(element, of("glossiness"));
        let [reflection, refraction] = ["reflection", "refraction"].map(of);
        let mirrored = self.element_of(Some(element), reflection);
        let refracted = self.element_of(Some(element), refraction);
        let spread = |reader: &mut Self, element: Option<usize>, parameter| {
            element.map_or(0.0, |element| {
                reader.extra(element, parameter, "glossiness")
            })
        };
        let mirror = self.tinted(element, reflection);
        let mirror_spread = spread(self, mirrored, reflection);
        let dielectric = self.tinted(element, refraction);
        let dielectric_spread = spread(self, refracted, refraction);
        let index = refracted.map_or(1.0, |at| self.extra(at, refraction, "index"));
        let absorption = self.vector(Some(element), of("absorption"));
        let emission = self.tinted(element, of("emission"));
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
        let of = |name| called(&MICROFACET, name);
        let colour = self.tinted(element, of("color"));
        let (roughness, roughness_map) = self.textured(element, of("roughness"));
        let (metallic, metallic_map) = self.textured(element, of("metallic"));
        let dielectric = self.tinted(element, of("transmittance"));
        let index = self.number(Some(element), of("ior"));
        let absorption = self.vector(Some(element), of("absorption"));
        let emission = self.tinted(element, of("emission"));
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
            scale: match self.setting.integrator {
                Integrator::Path => 1.0,
                Integrator::Whitted => PI,
            },
            shadows: Shadows::Cast,
        };
        let light = match kind {
            LightKind::Ambient => Light {
                colour: self.vector(Some(element), called(&AMBIENT, "intensity")),
                ..dark
            },
            LightKind::Direct => {
                let colour = self.vector(Some(element), called(&DIRECT, "intensity"));
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
        let parameter = called(&DIRECT, "direction");
        let direction = self.vector(Some(element), parameter);
        if let Some(direction) = normalise(direction) {
            return -direction;
        }
        // Malformed numbers were already reported.
        if let Some(said) = self
            .element_of(Some(element), parameter)
            .filter(|_| direction == DVec3::ZERO)
        {
            self.zero(said);
        }
        DVec3::Z
    }

    fn point(&mut self, element: usize, dark: Light) -> Light {
        let of = |name| called(&POINT, name);
        let colour = self.vector(Some(element), of("intensity"));
        let position = self.vector(Some(element), of("position"));
        let radius = self.number(Some(element), of("size"));
        let attenuation = self.number(Some(element), of("attenuation"));
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
