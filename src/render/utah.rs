//! What a surface of `.xml` does with light at a point, as SPEC of that language has it.

use glam::{DVec2, DVec3};

use super::mapped::MappedTextures;
use super::optics::{index, normal_reflectance, power};
use crate::scene::{self, Finish, Rgb, Tinted, Utah};

/// A material of `.xml` at a point, with its textures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Shading {
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
    /// The tangent of half the angle that refracted rays are spread over.
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

/// What is lost per unit of length on two ways.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Losses {
    pub(crate) refracted: Rgb,
    pub(crate) mirrored: Rgb,
}

impl Shading {
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
        let glossy = |gloss: &scene::Gloss, kind: fn(Rgb, f64) -> Gloss| Self {
            diffuse: colour(gloss.diffuse),
            gloss: kind(
                colour(gloss.specular),
                textures.number(gloss.glossiness, place),
            ),
            ..plain
        };
        match &material.finish {
            Finish::Blinn(gloss) => glossy(gloss, Gloss::Blinn),
            Finish::Phong(gloss) => glossy(gloss, Gloss::Phong),
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

    /// What is mirrored without paths, of light from outside: by little mirrors what they reflect
    /// straight on.
    pub(crate) fn mirror(&self) -> Rgb {
        match self.gloss {
            Gloss::Blinn(..) | Gloss::Phong(..) => self.reflection,
            Gloss::Microfacet(straight, _) => straight,
        }
    }

    /// Whether what it sends back and emits is seen: not on the back, where light from inside goes on
    /// through.
    pub(crate) fn is_lit(&self, front: bool) -> bool {
        front || !self.is_transparent
    }

    /// The indices of refraction that a ray comes from and goes to.
    pub(crate) fn indices(&self, front: bool) -> [f64; 2] {
        if front {
            [1.0, self.index]
        } else {
            [self.index, 1.0]
        }
    }

    /// What is lost on the ways that go on from it: inside only.
    pub(crate) fn losses(&self, front: bool) -> Losses {
        let [inside, outside] = [self.absorption, Rgb::ZERO];
        if front {
            Losses {
                refracted: inside,
                mirrored: outside,
            }
        } else {
            Losses {
                refracted: outside,
                mirrored: inside,
            }
        }
    }

    /// Without paths: the part of light from the direction `toward` that it sends to `view`, apart
    /// from the cosine to the normal.
    pub(crate) fn reflected(&self, normal: DVec3, view: DVec3, toward: DVec3) -> Rgb {
        let blinn = |exponent| power(normal.dot((toward + view).normalize()).min(1.0), exponent);
        let (specular, highlight) = match self.gloss {
            Gloss::Blinn(specular, exponent) => (specular, blinn(exponent)),
            // The exponent whose highlight is about as wide.
            Gloss::Microfacet(straight, alpha) => (straight, blinn(2.0 / (alpha * alpha) - 2.0)),
            Gloss::Phong(specular, exponent) => {
                let mirrored = 2.0 * normal.dot(toward) * normal - toward;
                (specular, power(mirrored.dot(view).min(1.0), exponent))
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
