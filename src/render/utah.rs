//! What a surface of `.xml` does with light at a point, as SPEC of that language has it.

use glam::{DVec2, DVec3};

use super::lights;
use super::mapped::MappedTextures;
use super::optics::{index, normal_reflectance};
use super::phong::power;
use super::sampler::{Sampler, Use};
use super::tracer::{Point, Tracer};
use crate::scene::{Finish, Light, Rgb, Tinted, Utah};

/// A material of `.xml` at a point, with its textures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Answer {
    pub(crate) emission: Rgb,
    /// What it sends back evenly.
    pub(crate) diffuse: Rgb,
    pub(crate) gloss: Gloss,
    /// What is mirrored, of light from outside.
    pub(crate) reflection: Rgb,
    /// The tangent of half the angle that mirrored rays are spread over.
    pub(crate) reflection_spread: f64,
    pub(crate) refraction: Rgb,
    /// Whether it lets anything through anywhere.
    is_transparent: bool,
    /// The same of refracted rays.
    pub(crate) refraction_spread: f64,
    /// Index of refraction, above 0.
    pub(crate) index: f64,
    /// What is lost inside, per unit of length.
    pub(crate) absorption: Rgb,
}

/// What it sends back around one direction more than others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Gloss {
    /// Around the normal as seen halfway between eye and light: colour and exponent.
    Blinn(Rgb, f64),
    /// Around the mirrored direction: colour and exponent.
    Phong(Rgb, f64),
    /// Of small mirrors: what they reflect straight on, and α.
    Microfacet(Rgb, f64),
}

impl Answer {
    /// What a material is where `place` says.
    pub(crate) fn at(
        material: &Utah,
        textures: &MappedTextures,
        place: impl FnOnce() -> DVec2,
    ) -> Self {
        let place = if material.is_textured() {
            place()
        } else {
            DVec2::ZERO
        };
        let colour = |tinted: Tinted| textures.colour(tinted, place);
        let index = index(material.index);
        let plain = Self {
            emission: colour(material.emission),
            diffuse: Rgb::ZERO,
            gloss: Gloss::Blinn(Rgb::ZERO, 0.0),
            reflection: colour(material.reflection),
            reflection_spread: material.reflection_spread,
            refraction: colour(material.refraction),
            is_transparent: material.refraction.colour != Rgb::ZERO,
            refraction_spread: material.refraction_spread,
            index,
            absorption: material.absorption,
        };
        match &material.finish {
            Finish::Blinn(gloss) => Self {
                diffuse: colour(gloss.diffuse),
                gloss: Gloss::Blinn(
                    colour(gloss.specular),
                    textures.number(gloss.glossiness, place),
                ),
                ..plain
            },
            Finish::Phong(gloss) => Self {
                diffuse: colour(gloss.diffuse),
                gloss: Gloss::Phong(
                    colour(gloss.specular),
                    textures.number(gloss.glossiness, place),
                ),
                ..plain
            },
            Finish::Microfacet {
                colour: base,
                roughness,
                metallic,
            } => {
                let base = colour(*base);
                let metallic = textures.number(*metallic, place);
                let roughness = textures.number(*roughness, place);
                let straight = (1.0 - metallic) * normal_reflectance(index, 1.0) + metallic * base;
                Self {
                    diffuse: (1.0 - metallic) * base,
                    gloss: Gloss::Microfacet(straight, roughness * roughness),
                    ..plain
                }
            }
        }
    }

    /// The same as Whitted's rays see it: little mirrors are a highlight and a mirror.
    pub(crate) fn for_whitted(self) -> Self {
        match self.gloss {
            Gloss::Blinn(..) | Gloss::Phong(..) => self,
            Gloss::Microfacet(straight, alpha) => Self {
                gloss: Gloss::Blinn(straight, 2.0 / (alpha * alpha) - 2.0),
                reflection: straight,
                ..self
            },
        }
    }

    /// Whether what it sends back and emits is seen at a point: not where light from inside goes on
    /// through.
    pub(crate) fn is_lit(&self, point: &Point) -> bool {
        point.front || !self.is_transparent
    }

    /// What it sends back toward the eye of light from a direction at an angle of some cosine above 0
    /// to the normal, apart from that cosine, without paths.
    fn sends_back(&self, point: &Point, toward: DVec3, cosine: f64) -> Rgb {
        let (specular, highlight) = match self.gloss {
            Gloss::Blinn(specular, exponent) | Gloss::Microfacet(specular, exponent) => {
                let halfway = (toward + point.view).normalize();
                (
                    specular,
                    power(point.normal.dot(halfway).min(1.0), exponent),
                )
            }
            Gloss::Phong(specular, exponent) => {
                let mirrored = 2.0 * cosine * point.normal - toward;
                (specular, power(mirrored.dot(point.view).min(1.0), exponent))
            }
        };
        self.diffuse + specular * highlight
    }
}

impl Utah {
    fn is_textured(&self) -> bool {
        let of_finish = match &self.finish {
            Finish::Blinn(gloss) | Finish::Phong(gloss) => [
                gloss.diffuse.texture,
                gloss.specular.texture,
                gloss.glossiness.texture,
            ],
            Finish::Microfacet {
                colour,
                roughness,
                metallic,
            } => [colour.texture, roughness.texture, metallic.texture],
        };
        let others = [&self.reflection, &self.refraction, &self.emission];
        let others = others.map(|tinted| tinted.texture);
        of_finish.iter().chain(&others).any(Option::is_some)
    }
}

impl Tracer<'_> {
    /// Without paths: what a surface emits and sends back of ambient light and that of all lights, in
    /// file order.
    pub(crate) fn light_on_utah(
        &mut self,
        point: &Point,
        answer: &Answer,
        sampler: Sampler,
        node: u32,
    ) -> Rgb {
        let world = self.world;
        let mut radiance = answer.emission + world.scene.ambient * answer.diffuse;
        for (number, light) in world.scene.lights.iter().enumerate() {
            let place = (0.0 < light.radius)
                .then(|| sampler.pair(node, Use::Light(number as u32)))
                .flatten();
            radiance += self.on_utah(point, answer, light, place);
        }
        radiance
    }

    fn on_utah(
        &mut self,
        point: &Point,
        answer: &Answer,
        light: &Light,
        place: Option<[f64; 2]>,
    ) -> Rgb {
        let Some(incoming) = lights::incoming(light, point.surface.point, place) else {
            return Rgb::ZERO;
        };
        let toward = incoming.toward;
        let cosine = point.normal.dot(toward);
        // It is NaN where the light stands at the point itself.
        if cosine <= 0.0 || cosine.is_nan() {
            return Rgb::ZERO;
        }
        let reflected = cosine * answer.sends_back(point, toward, cosine);
        if reflected == Rgb::ZERO {
            return Rgb::ZERO;
        }
        let share = lights::share(light, point.surface.point, toward);
        self.visibility(&point.surface, light, incoming) * (reflected * (share * light.colour))
    }
}
