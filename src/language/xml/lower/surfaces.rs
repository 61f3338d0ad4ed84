//! Materials and lights.

use glam::DVec3;

use super::Reader;
use crate::geometry::normalise;
use crate::language::xml::table::{
    AMBIENT, DIRECT, LightKind, MATERIAL, MICROFACET, MaterialKind, POINT, Parameter,
};
use crate::scene::{Falloff, Finish, Gloss, Light, Material, Rgb, Shadows, Source, Tinted, Utah};

/// The parameter of a list with a name.
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
        let utah = match kind {
            MaterialKind::Blinn | MaterialKind::Phong => self.glossy(element, kind),
            MaterialKind::Microfacet => self.microfacet(element),
        };
        self.materials.push(Material::Utah(Box::new(utah)));
    }

    fn glossy(&mut self, element: usize, kind: MaterialKind) -> Utah {
        let of = |name| called(&MATERIAL, name);
        let gloss = Gloss {
            diffuse: self.tinted(element, of("diffuse")),
            specular: self.tinted(element, of("specular")),
            glossiness: self.textured(element, of("glossiness")),
        };
        let [reflection, refraction] = ["reflection", "refraction"].map(of);
        let mirrored = self.element_of(Some(element), reflection);
        let refracted = self.element_of(Some(element), refraction);
        let spread = |reader: &mut Self, element: Option<usize>, parameter| {
            element.map_or(0.0, |element| {
                reader.extra(element, parameter, "glossiness")
            })
        };
        Utah {
            finish: match kind {
                MaterialKind::Phong => Finish::Phong(gloss),
                _ => Finish::Blinn(gloss),
            },
            reflection: self.tinted(element, reflection),
            reflection_spread: spread(self, mirrored, reflection),
            refraction: self.tinted(element, refraction),
            refraction_spread: spread(self, refracted, refraction),
            index: refracted.map_or(1.0, |at| self.extra(at, refraction, "index")),
            absorption: self.vector(Some(element), of("absorption")),
            emission: self.tinted(element, of("emission")),
        }
    }

    fn microfacet(&mut self, element: usize) -> Utah {
        let of = |name| called(&MICROFACET, name);
        Utah {
            finish: Finish::Microfacet {
                colour: self.tinted(element, of("color")),
                roughness: self.textured(element, of("roughness")),
                metallic: self.textured(element, of("metallic")),
            },
            // It follows from the colour, the index and how much of it is metal.
            reflection: Tinted::default(),
            reflection_spread: 0.0,
            refraction: self.tinted(element, of("transmittance")),
            refraction_spread: 0.0,
            index: self.number(Some(element), of("ior")),
            absorption: self.vector(Some(element), of("absorption")),
            emission: self.tinted(element, of("emission")),
        }
    }

    pub(super) fn light(&mut self, index: usize) {
        let (kind, element) = {
            let place = &self.origins.lights[index];
            (place.kind, place.element as usize)
        };
        let dark = Light {
            source: Source::Everywhere,
            colour: Rgb::ZERO,
            shadows: Shadows::Cast,
            radius: 0.0,
        };
        let light = match kind {
            LightKind::Ambient => Light {
                colour: self.vector(Some(element), called(&AMBIENT, "intensity")),
                ..dark
            },
            LightKind::Direct => {
                let colour = self.vector(Some(element), called(&DIRECT, "intensity"));
                let source = Source::Distant(self.toward(element));
                Light {
                    source,
                    colour,
                    ..dark
                }
            }
            LightKind::Point => self.point(element, dark),
        };
        self.lights.push(light);
    }

    /// The unit vector toward a light that goes in a direction.
    fn toward(&mut self, element: usize) -> DVec3 {
        let parameter = called(&DIRECT, "direction");
        let direction = self.vector(Some(element), parameter);
        if let Some(direction) = normalise(direction) {
            return -direction;
        }
        // What is not a number was reported.
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
            source: Source::Point { position, falloff },
            colour,
            radius,
            ..dark
        }
    }
}
