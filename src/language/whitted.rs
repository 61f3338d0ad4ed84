//! Materials of any scene as the coefficients that `.ray` and `.dat` have, with what gets lost.

use super::coefficients::Coefficients;
use super::losses::{Loss, Losses, Of};
use scene::{Faces, Highlight, Material, Reflectance, Rgb, Scene, Shadow};

/// The exponent of a Phong highlight that is about as wide as one around the half vector: the angle
/// between the mirrored light and the viewer is twice that between normal and half vector.
const NARROWER: f64 = 0.25;

/// The largest exponent written: that of a highlight too small to be seen.
const MOST: f64 = 1e6;

const MODIFIED: Loss = Loss {
    keys: &["specular"],
    lost: "a phong highlight that is weaker at grazing angles",
    instead: "written as a highlight of the same exponent that is not",
};

const BLINN: Loss = Loss {
    keys: &["specular"],
    lost: "a blinn highlight",
    instead: "written as a Phong highlight of a quarter of its exponent, which is about as wide",
};

const MICROFACET: Loss = Loss {
    keys: &["roughness", "color"],
    lost: "microfacets",
    instead: "written as their Whitted shading: a diffuse colour, a Phong highlight and a mirror",
};

const EMISSION: Loss = Loss {
    keys: &["emission"],
    lost: "emitted light",
    instead: "written as ambient reflection, which looks the same but lights nothing in path tracing; \
              ambient light becomes white and is multiplied into the materials",
};

const FRONT_MIRROR: Loss = Loss {
    keys: &["reflection"],
    lost: "a mirror on front faces only",
    instead: "written as a mirror on both faces",
};

const COLOURED_MIRROR: Loss = Loss {
    keys: &["reflection"],
    lost: "a coloured mirror",
    instead: "written as a grey one of the same mean",
};

const GLASS: Loss = Loss {
    keys: &["refraction", "transmittance"],
    lost: "glass that reflects by Fresnel's equations and casts full shadows",
    instead: "written as transparency without either, of the same mean and index of refraction",
};

const SPREAD: Loss = Loss {
    keys: &["reflection", "refraction"],
    lost: "blurred reflection or refraction",
    instead: "written as sharp",
};

const ABSORPTION: Loss = Loss {
    keys: &["absorption"],
    lost: "absorption inside",
    instead: "written without it",
};

/// A scene's materials, and the ambient light that they reflect.
pub(super) struct Whitted {
    /// Ambient light.
    pub(super) ambient: Rgb,
    /// Whether the scene's own ambient light is multiplied into the materials.
    pub(super) is_baked: bool,
    /// The coefficients of each material of the scene.
    pub(super) materials: Vec<Coefficients>,
}

/// Reduces the materials of a scene.
pub(super) fn whitted(scene: &Scene, losses: &mut Losses<'_>) -> Whitted {
    let ambient = scene.ambient_light();
    let emits = |(index, material): (usize, &Material)| {
        losses.is_used(index) && material.emission != Rgb::ZERO
    };
    let glows = scene.materials.iter().enumerate().any(emits);
    let mut materials = Vec::with_capacity(scene.materials.len());
    for (index, material) in (0..).zip(scene.materials.iter()) {
        let mut reduced = coefficients(Of::Material(index), material, losses);
        if glows {
            let reflected = ambient * material.ambient.unwrap_or(reduced.diffuse);
            reduced.ambient = material.emission + reflected;
        }
        materials.push(reduced);
    }
    Whitted {
        ambient: if glows { Rgb::ONE } else { ambient },
        is_baked: glows,
        materials,
    }
}

fn coefficients(of: Of, material: &Material, losses: &mut Losses<'_>) -> Coefficients {
    let mut found = Coefficients {
        diffuse: material.diffuse,
        reflection: mean(material.mirror.tint),
        index: material.dielectric.index,
        ..Coefficients::default()
    };
    let mut lose = |loss: &Loss| losses.add(of, loss);
    match material.highlight {
        Highlight::None => {}
        Highlight::Phong(gloss) => {
            (found.specular, found.exponent) = (gloss.specular, gloss.exponent);
        }
        Highlight::ModifiedPhong(gloss) => {
            (found.specular, found.exponent) = (gloss.specular, gloss.exponent);
            if gloss.specular != Rgb::ZERO {
                lose(&MODIFIED);
            }
        }
        Highlight::Blinn(gloss) | Highlight::PlainBlinn(gloss) => {
            found.specular = gloss.specular;
            found.exponent = NARROWER * gloss.exponent;
            if gloss.specular != Rgb::ZERO {
                lose(&BLINN);
            }
        }
        Highlight::Microfacet {
            roughness,
            metallic,
        } => {
            lose(&MICROFACET);
            let normal = (found.index - 1.0) / (found.index + 1.0);
            let facets =
                (1.0 - metallic) * Rgb::splat(normal * normal) + metallic * material.diffuse;
            let alpha = roughness * roughness;
            let exponent = NARROWER * (2.0 / (alpha * alpha) - 2.0);
            found.diffuse = (1.0 - metallic) * material.diffuse;
            found.specular = facets;
            found.exponent = exponent.min(MOST);
            found.reflection = mean(facets);
        }
    }
    if material.emission != Rgb::ZERO {
        lose(&EMISSION);
    }
    let mirror = material.mirror;
    if mirror.tint != Rgb::ZERO {
        if mirror.faces == Faces::Front {
            lose(&FRONT_MIRROR);
        }
        if Rgb::splat(found.reflection) != mirror.tint {
            lose(&COLOURED_MIRROR);
        }
    }
    let glass = material.dielectric;
    if glass.tint != Rgb::ZERO {
        found.transmission = mean(glass.tint);
        let is_plain = glass.reflectance == Reflectance::TotalOnly
            && glass.tint == Rgb::splat(found.transmission)
            && material.shadow == Shadow::passing(found.transmission)
            && material.lit == Faces::Both;
        if !is_plain {
            lose(&GLASS);
        }
        if glass.absorption != Rgb::ZERO {
            lose(&ABSORPTION);
        }
    }
    let mirrors = mirror.tint != Rgb::ZERO && mirror.spread != 0.0;
    let refracts = glass.tint != Rgb::ZERO && glass.spread != 0.0;
    if mirrors || refracts {
        lose(&SPREAD);
    }
    if found.transmission == 0.0 && found.index <= 0.0 {
        // It counts as 1, and is warned of.
        found.index = 1.0;
    }
    found.ambient = material.ambient.unwrap_or(found.diffuse);
    found
}

/// The mean of a colour's components: the component itself for a grey.
fn mean(colour: Rgb) -> f64 {
    if colour == Rgb::splat(colour.x) {
        colour.x
    } else {
        colour.element_sum() / 3.0
    }
}
