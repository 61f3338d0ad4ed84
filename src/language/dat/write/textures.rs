//! Textures, and the materials that use them.

use std::fmt::Write;

use glam::{DAffine3, DMat3, DVec3};

use crate::losses::{Loss, Losses, Of};
use crate::spelling::{numbers, vector};
use scene::{Highlight, Maps, Material, Pattern, Rgb, Scene, Side, Texture, Tinted};

const APART: Loss = Loss {
    keys: &[
        "diffuse",
        "color",
        "specular",
        "glossiness",
        "reflection",
        "refraction",
        "emission",
    ],
    lost: "textures of single colours or numbers of a material",
    instead: "written with the texture of its diffuse colour on all its colours",
};

const INEXPRESSIBLE: Loss = Loss {
    keys: &["diffuse", "color"],
    lost: "a checkerboard of textures, or a picture that is not repeated or whose path has blanks",
    instead: "written in its plain colour",
};

const TRANSFORMED: Loss = Loss {
    keys: &["diffuse", "color"],
    lost: "a texture that is moved or turned",
    instead: "written as only scaled",
};

const LINES: Loss = Loss {
    keys: &["diffuse", "color"],
    lost: "the squares that the lines of a checkerboard belong to",
    instead: "written as the same squares, whose lines belong to others",
};

/// Writes the textures that materials use.
pub(super) fn write(text: &mut String, scene: &Scene, losses: &mut Losses<'_>) {
    let mut id = 0;
    for (index, material) in (0..).zip(scene.materials.iter()) {
        let Some(maps) = &material.maps else {
            continue;
        };
        let of = Of::Material(index);
        if !is_alike(material, maps) {
            losses.add(of, &APART);
        }
        let colour = maps.diffuse.or(maps.ambient).or(maps.specular);
        let uses = [
            ("colour", colour, None),
            (
                "bump",
                maps.bump.map(|bump| bump.texture),
                maps.bump.map(|bump| bump.height),
            ),
        ];
        for (word, texture, height) in uses {
            let texture = texture.and_then(|texture| scene.textures.get(texture as usize));
            let Some(texture) = texture else {
                continue;
            };
            let Some(record) = record(texture, of, losses) else {
                continue;
            };
            id += 1;
            // Writing to a string cannot fail.
            let _ = write!(
                text,
                "texture ID {id} {record}\nuse {word} ID {id} mat ID {}",
                index + 1
            );
            numbers(text, height);
            text.push('\n');
        }
    }
}

/// Whether one texture multiplies all colours of a material that count, and nothing else.
fn is_alike(material: &Material, maps: &Maps) -> bool {
    let shine = match material.highlight {
        Highlight::Phong(gloss)
        | Highlight::ModifiedPhong(gloss)
        | Highlight::Blinn(gloss)
        | Highlight::PlainBlinn(gloss) => gloss.specular,
        Highlight::None | Highlight::Microfacet { .. } => Rgb::ZERO,
    };
    let dim = material.ambient.unwrap_or(Rgb::ZERO);
    let is_same = |colour: Rgb, map: Option<u32>| colour == Rgb::ZERO || map == maps.diffuse;
    let rest = Maps {
        ambient: None,
        diffuse: None,
        specular: None,
        bump: None,
        ..*maps
    };
    is_same(shine, maps.specular) && is_same(dim, maps.ambient) && rest == Maps::default()
}

/// A texture's record after its ID; `None` if there is none.
fn record(texture: &Texture, of: Of, losses: &mut Losses<'_>) -> Option<String> {
    let DAffine3 {
        matrix3: DMat3 { x_axis, y_axis, .. },
        ..
    } = texture.inverse;
    let scale = DVec3::new(x_axis.x, y_axis.y, 1.0);
    let mut repeat = scale;
    if texture.inverse != DAffine3::from_scale(scale) {
        losses.add(of, &TRANSFORMED);
        repeat = DVec3::new(x_axis.length(), y_axis.length(), 1.0);
    }
    let mut record = String::new();
    match &texture.pattern {
        Pattern::Image(path) if !path.is_empty() && !path.contains(char::is_whitespace) => {
            record.push_str("image");
            numbers(&mut record, [repeat.x, repeat.y]);
            record.push(' ');
            record.push_str(path);
        }
        Pattern::Checker {
            squares: squares @ [Tinted { texture: None, .. }, Tinted { texture: None, .. }],
            side,
        } => {
            if *side == Side::Half {
                losses.add(of, &LINES);
                repeat *= 2.0;
            }
            record.push_str("checker");
            numbers(&mut record, [repeat.x, repeat.y]);
            for square in squares {
                vector(&mut record, square.colour);
            }
        }
        Pattern::Image(_) | Pattern::Clamped(_) | Pattern::Checker { .. } => {
            losses.add(of, &INEXPRESSIBLE);
            return None;
        }
    }
    Some(record)
}
