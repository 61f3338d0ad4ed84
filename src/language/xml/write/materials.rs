//! Materials.

use std::collections::HashSet;

use super::textures::{number, tinted, with};
use super::{attribute, element, open, plain, rgb, word};
use crate::losses::{Loss, Losses, Of};
use scene::{
    Dielectric, Faces, Gloss, Highlight, Maps, Material, Mirror, Pattern, Reflectance, Rgb, Scene,
    Shadow, Side, Tinted,
};

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
        let mut emission = Tinted {
            colour: material.emission,
            texture: material.maps.as_ref().and_then(|maps| maps.emission),
        };
        if is_baked {
            emission.colour += ambient * material.ambient.unwrap_or(material.diffuse);
            emission.texture = material.maps.as_ref().and_then(|maps| maps.ambient);
        }
        one(text, material, name, emission, scene);
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
    let texture = maps
        .diffuse
        .and_then(|texture| scene.textures.get(texture as usize));
    if let Some(Pattern::Checker {
        side: Side::One, ..
    }) = texture.map(|texture| &texture.pattern)
    {
        lose(&LINES);
    }
}

fn one(text: &mut String, material: &Material, name: &str, emission: Tinted, scene: &Scene) {
    let maps = material.maps.as_deref().copied().unwrap_or_default();
    let (kind, gloss) = match material.highlight {
        Highlight::Phong(gloss) | Highlight::ModifiedPhong(gloss) => ("phong", gloss),
        Highlight::Blinn(gloss) | Highlight::PlainBlinn(gloss) => ("blinn", gloss),
        Highlight::None | Highlight::Microfacet { .. } => ("blinn", Gloss::default()),
    };
    let is_facets = matches!(material.highlight, Highlight::Microfacet { .. });
    open(text, 4, "material");
    word(text, "type", if is_facets { "microfacet" } else { kind });
    word(text, "name", name);
    text.push_str(">\n");
    if let Highlight::Microfacet {
        roughness,
        metallic,
    } = material.highlight
    {
        microfacet(text, material, [roughness, metallic], &maps, scene);
    } else {
        let diffuse = Tinted {
            colour: material.diffuse,
            texture: maps.diffuse,
        };
        let specular = Tinted {
            colour: gloss.specular,
            texture: maps.specular,
        };
        tinted(text, 6, "diffuse", diffuse, scene);
        tinted(text, 6, "specular", specular, scene);
        let exponent = (gloss.exponent.max(0.0), maps.exponent);
        number(text, (6, "glossiness"), exponent, scene);
        mirror(text, &material.mirror, maps.mirror, scene);
        glass(text, &material.dielectric, maps.dielectric, scene);
    }
    if material.dielectric.absorption != Rgb::ZERO {
        let absorption = plain(material.dielectric.absorption);
        tinted(text, 6, "absorption", absorption, scene);
    }
    if emission.colour != Rgb::ZERO {
        tinted(text, 6, "emission", emission, scene);
    }
    text.push_str("    </material>\n");
}

fn mirror(text: &mut String, mirror: &Mirror, map: Option<u32>, scene: &Scene) {
    if mirror.tint == Rgb::ZERO {
        return;
    }
    let attributes = |text: &mut String| {
        rgb(text, mirror.tint);
        if mirror.spread != 0.0 {
            attribute(text, "glossiness", mirror.spread);
        }
    };
    with(text, (6, "reflection"), attributes, map, scene);
}

fn glass(text: &mut String, glass: &Dielectric, map: Option<u32>, scene: &Scene) {
    if glass.tint == Rgb::ZERO {
        return;
    }
    let attributes = |text: &mut String| {
        rgb(text, glass.tint);
        attribute(text, "index", glass.index);
        if glass.spread != 0.0 {
            attribute(text, "glossiness", glass.spread);
        }
    };
    with(text, (6, "refraction"), attributes, map, scene);
}

fn microfacet(
    text: &mut String,
    material: &Material,
    [roughness, metallic]: [f64; 2],
    maps: &Maps,
    scene: &Scene,
) {
    let colour = Tinted {
        colour: material.diffuse,
        texture: maps.diffuse,
    };
    let transmittance = Tinted {
        colour: material.dielectric.tint,
        texture: maps.dielectric,
    };
    tinted(text, 6, "color", colour, scene);
    number(text, (6, "roughness"), (roughness, maps.roughness), scene);
    number(text, (6, "metallic"), (metallic, maps.metallic), scene);
    element(text, 6, "ior", |text| {
        super::value(text, material.dielectric.index);
    });
    tinted(text, 6, "transmittance", transmittance, scene);
}
