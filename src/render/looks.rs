//! Materials as the tracer shades them.

use crate::scene::{Finish, Gloss, Material, Phong, Rgb, Utah};

/// How a surface looks.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Look {
    /// It answers light, and shines by itself.
    Lit(Phong, Rgb),
    /// It has one colour, whatever light there is.
    Flat(Rgb),
}

impl Look {
    /// How a material looks.
    pub(crate) fn of(material: &Material) -> Self {
        match material {
            Material::Phong(phong) => Self::Lit(*phong, Rgb::ZERO),
            Material::Flat(colour) => Self::Flat(*colour),
            // Lowering warns that this is not the material's own model.
            Material::Utah(utah) => Self::Lit(nearest(utah), utah.emission.colour),
        }
    }

    /// The part of light that goes through.
    pub(crate) fn transmission(&self) -> f64 {
        match self {
            Self::Lit(phong, _) => phong.transmission,
            Self::Flat(_) => 0.0,
        }
    }
}

/// The Phong material that a material of `.xml` is most like.
fn nearest(utah: &Utah) -> Phong {
    let mean = |colour: Rgb| colour.element_sum() / 3.0;
    let plain = Phong {
        transmission: mean(utah.refraction.colour),
        index: utah.index,
        ..Phong::default()
    };
    let shiny = |gloss: &Gloss, exponent: f64| Phong {
        ambient: gloss.diffuse.colour,
        diffuse: gloss.diffuse.colour,
        specular: gloss.specular.colour,
        exponent,
        reflection: mean(utah.reflection.colour),
        ..plain
    };
    match &utah.finish {
        // Its angle is about half of Phong's.
        Finish::Blinn(gloss) => shiny(gloss, 0.25 * gloss.glossiness.value),
        Finish::Phong(gloss) => shiny(gloss, gloss.glossiness.value),
        Finish::Microfacet {
            colour,
            roughness,
            metallic,
        } => {
            let (colour, metallic) = (colour.colour, metallic.value);
            let diffuse = (1.0 - metallic) * colour;
            let index = if 0.0 < utah.index { utah.index } else { 1.0 };
            let ratio = (index - 1.0) / (index + 1.0);
            let mirrored = (1.0 - metallic) * ratio * ratio + metallic * colour;
            let alpha = (roughness.value * roughness.value).max(1e-3);
            Phong {
                ambient: diffuse,
                diffuse,
                specular: mirrored,
                exponent: 0.25 * (2.0 / (alpha * alpha) - 2.0),
                reflection: mean(mirrored),
                ..plain
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Textured, Tinted};

    /// A metal of some colour, or what is none.
    fn microfacet(metallic: f64, index: f64) -> Phong {
        let number = |value| Textured {
            value,
            texture: None,
        };
        let finish = Finish::Microfacet {
            colour: Tinted {
                colour: Rgb::new(1.0, 0.5, 0.0),
                texture: None,
            },
            roughness: number(0.0),
            metallic: number(metallic),
        };
        nearest(&Utah {
            finish,
            reflection: Tinted::default(),
            reflection_spread: 0.0,
            refraction: Tinted::default(),
            refraction_spread: 0.0,
            index,
            absorption: Rgb::ZERO,
            emission: Tinted::default(),
        })
    }

    #[test]
    fn metal_mirrors_in_its_colour_and_all_else_by_its_index() {
        let gold = microfacet(1.0, 1.5);
        assert_eq!(
            (gold.diffuse, gold.specular),
            (Rgb::ZERO, Rgb::new(1.0, 0.5, 0.0))
        );
        let glaze = microfacet(0.0, 3.0);
        assert_eq!((glaze.specular, glaze.reflection), (Rgb::splat(0.25), 0.25));
        assert_eq!(microfacet(0.0, -1.0).specular, Rgb::ZERO);
        assert!(glaze.exponent.is_finite());
    }
}
