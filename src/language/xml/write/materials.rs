//! Materials.

use std::collections::HashSet;

use super::textures::{number, tinted, with};
use super::{attribute, begin, element, rgb, value};
use crate::losses::{Loss, Losses, Of};
use scene::{Faces, Gloss, Highlight, Material, Pattern, Reflectance, Rgb, Scene, Shadow, Side};

const AMBIENT: Loss = Loss {
    keys: &["ka", "Ka"],
    lost: "an ambient colour other than the diffuse one",
    instead: "written as emission, which looks the same but lights the scene in path tracing; there \
              is no ambient light any more",
};

const PHONG: Loss = Loss {
    keys: &["ks", "Ks"],
    lost: "a highlight that is as strong at grazing angles",
    instead: "written as a phong highlight of the same exponent, which is weaker there",
};

const BLINN: Loss = Loss {
    keys: &["specular"],
    lost: "a highlight that is as strong at grazing angles",
    instead: "written as a blinn highlight of the same exponent that is weaker there",
};

const MIRROR: Loss = Loss {
    keys: &["kr", "Kr"],
    lost: "a mirror on both faces",
    instead: "written as one on front faces",
};

const CLEAR: Loss = Loss {
    keys: &["kt", "Kt"],
    lost: "transparency without Fresnel reflection, for shadows too",
    instead: "written as refraction by Schlick's approximation, with full shadows",
};

const BUMP: Loss = Loss {
    keys: &[],
    lost: "a bump map",
    instead: "written as a smooth surface",
};

const LINES: Loss = Loss {
    keys: &[],
    lost: "the squares that the lines of a checkerboard belong to",
    instead: "written as the same squares, whose lines belong to others",
};

/// Whether ambient light is written as emission: if materials reflect it by colours of their own.
pub(super) fn is_baked(scene: &Scene, losses: &mut Losses<'_>) -> bool {
    let light = scene.ambient_light();
    if light == Rgb::ZERO {
        return false;
    }
    let materials = (0..).zip(scene.materials.iter());
    let used: Vec<_> = materials
        .filter(|(index, _)| losses.is_used(*index as usize))
        .collect();
    let reflected = |of: &Material| light * of.ambient.unwrap_or(of.diffuse);
    let is_emission = used
        .iter()
        .any(|(_, material)| reflected(material) != Rgb::ZERO);
    let has_own = |of: &Material| of.ambient.is_some_and(|ambient| ambient != of.diffuse);
    let mut own = used
        .iter()
        .filter(|(_, material)| has_own(material))
        .peekable();
    let is_baked = own.peek().is_some();
    for (index, _) in own.filter(|_| is_emission) {
        losses.add(Of::Material(*index), &AMBIENT);
    }
    is_baked
}

/// The names of the materials, each of its own.
pub(super) fn names(scene: &Scene, losses: &Losses<'_>) -> Vec<String> {
    let mut taken = HashSet::new();
    let mut names = Vec::with_capacity(scene.materials.len());
    for index in 0..scene.materials.len() {
        let label = losses.label(Of::Material(index as u32));
        let label = label.map(|label| label.trim().to_owned());
        let free = label.filter(|label| !taken.contains(label));
        let mut name = free.unwrap_or_else(|| format!("material {}", index + 1));
        while !taken.insert(name.clone()) {
            name.push('\'');
        }
        names.push(name);
    }
    names
}

/// Writes the materials of a scene with these names.
pub(super) fn write(
    text: &mut String,
    scene: &Scene,
    (names, is_baked): (&[String], bool),
    losses: &mut Losses<'_>,
) {
    let ambient = scene.ambient_light();
    for ((index, material), name) in (0..).zip(scene.materials.iter()).zip(names) {
        report(Of::Material(index), material, scene, losses);
        let maps = material.maps.as_deref();
        let (mut emission, mut map) = (material.emission, maps.and_then(|maps| maps.emission));
        if is_baked {
            emission += ambient * material.ambient.unwrap_or(material.diffuse);
            map = maps.and_then(|maps| maps.ambient);
        }
        one(text, material, name, (emission, map), scene);
    }
}

fn report(of: Of, material: &Material, scene: &Scene, losses: &mut Losses<'_>) {
    let mut lose = |loss: &Loss| losses.add(of, loss);
    match material.highlight {
        Highlight::Phong(gloss) if gloss.specular != Rgb::ZERO => lose(&PHONG),
        Highlight::PlainBlinn(gloss) if gloss.specular != Rgb::ZERO => lose(&BLINN),
        _ => {}
    }
    if material.mirror.tint != Rgb::ZERO && material.mirror.faces == Faces::Both {
        lose(&MIRROR);
    }
    let glass = &material.dielectric;
    let is_clear = glass.reflectance == Reflectance::TotalOnly || material.shadow != Shadow::Blocks;
    if glass.tint != Rgb::ZERO && is_clear {
        lose(&CLEAR);
    }
    let Some(maps) = &material.maps else {
        return;
    };
    if maps.bump.is_some() {
        lose(&BUMP);
    }
    let texture = maps.diffuse.and_then(|at| scene.textures.get(at as usize));
    let pattern = texture.map(|texture| &texture.pattern);
    if matches!(pattern, Some(Pattern::Checker { side, .. }) if *side == Side::One) {
        lose(&LINES);
    }
}

fn one(
    text: &mut String,
    material: &Material,
    name: &str,
    emission: (Rgb, Option<u32>),
    scene: &Scene,
) {
    let maps = material.maps.as_deref().copied().unwrap_or_default();
    let (kind, gloss) = match material.highlight {
        Highlight::Phong(gloss) | Highlight::ModifiedPhong(gloss) => ("phong", gloss),
        Highlight::Blinn(gloss) | Highlight::PlainBlinn(gloss) => ("blinn", gloss),
        Highlight::None => ("blinn", Gloss::default()),
        Highlight::Microfacet { .. } => ("microfacet", Gloss::default()),
    };
    begin(text, "material", kind, Some(name));
    let (mirror, glass) = (material.mirror, material.dielectric);
    let diffuse = (material.diffuse, maps.diffuse);
    if let Highlight::Microfacet {
        roughness,
        metallic,
    } = material.highlight
    {
        tinted(text, (6, "color"), diffuse, scene);
        number(text, (6, "roughness"), (roughness, maps.roughness), scene);
        number(text, (6, "metallic"), (metallic, maps.metallic), scene);
        element(text, 6, "ior", |text| value(text, glass.index));
        let transmittance = (glass.tint, maps.dielectric);
        tinted(text, (6, "transmittance"), transmittance, scene);
    } else {
        tinted(text, (6, "diffuse"), diffuse, scene);
        let specular = (gloss.specular, maps.specular);
        tinted(text, (6, "specular"), specular, scene);
        let exponent = (gloss.exponent.max(0.0), maps.exponent);
        number(text, (6, "glossiness"), exponent, scene);
        let reflected = (mirror.tint, maps.mirror);
        rays(text, "reflection", reflected, (None, mirror.spread), scene);
        let (refracted, index) = ((glass.tint, maps.dielectric), Some(glass.index));
        rays(text, "refraction", refracted, (index, glass.spread), scene);
    }
    if glass.absorption != Rgb::ZERO {
        tinted(text, (6, "absorption"), (glass.absorption, None), scene);
    }
    if emission.0 != Rgb::ZERO {
        tinted(text, (6, "emission"), emission, scene);
    }
    text.push_str("    </material>\n");
}

/// Writes what of reflected or refracted rays is seen, with their index of refraction and spread.
fn rays(
    text: &mut String,
    name: &str,
    (tint, map): (Rgb, Option<u32>),
    (index, spread): (Option<f64>, f64),
    scene: &Scene,
) {
    if tint == Rgb::ZERO {
        return;
    }
    let attributes = |text: &mut String| {
        rgb(text, tint);
        if let Some(index) = index {
            attribute(text, "index", index);
        }
        if spread != 0.0 {
            attribute(text, "glossiness", spread);
        }
    };
    with(text, (6, name), attributes, map, scene);
}
