//! Colours and numbers with textures.

use glam::{DAffine3, DVec3};

use super::transforms::placed;
use super::{element, open, rgb, value, word};
use scene::{Pattern, Rgb, Scene, Side, Texture};

/// The deepest checkerboards in checkerboards that are written.
const DEEPEST: usize = 32;

/// Writes a colour with a texture, which only colours other than black have.
pub(super) fn tinted(
    text: &mut String,
    at: (usize, &str),
    (colour, texture): (Rgb, Option<u32>),
    scene: &Scene,
) {
    let texture = texture.filter(|_| colour != Rgb::ZERO);
    with(text, at, |text| rgb(text, colour), texture, scene);
}

/// Writes an element with a texture.
pub(super) fn with(
    text: &mut String,
    (indent, name): (usize, &str),
    attributes: impl FnOnce(&mut String),
    texture: Option<u32>,
    scene: &Scene,
) {
    let texture = texture.and_then(|texture| scene.textures.get(texture as usize));
    let Some(texture) = texture.filter(|_| indent < 2 * DEEPEST) else {
        element(text, indent, name, attributes);
        return;
    };
    open(text, indent, name);
    attributes(text);
    inside(text, indent, texture, scene);
    text.push_str(&" ".repeat(indent));
    text.push_str("</");
    text.push_str(name);
    text.push_str(">\n");
}

/// The rest of a tag and the content of an element with a texture.
fn inside(text: &mut String, indent: usize, texture: &Texture, scene: &Scene) {
    let mut inverse = texture.inverse;
    match &texture.pattern {
        Pattern::Image(path) | Pattern::Clamped(path) => {
            word(text, "texture", path.as_str());
            text.push_str(">\n");
        }
        Pattern::Checker { squares, side } => {
            word(text, "texture", "checkerboard");
            text.push_str(">\n");
            for (name, square) in ["color1", "color2"].into_iter().zip(squares) {
                let tint = (square.colour, square.texture);
                tinted(text, (indent + 2, name), tint, scene);
            }
            if *side == Side::One {
                inverse = DAffine3::from_scale(DVec3::new(0.5, 0.5, 1.0)) * inverse;
            }
        }
    }
    let scale = DVec3::new(inverse.x_axis.x, inverse.y_axis.y, inverse.z_axis.z);
    if inverse == DAffine3::from_scale(scale) && scale.abs().min_element() != 0.0 {
        let scale = DVec3::ONE / scale;
        if scale != DVec3::ONE {
            element(text, indent + 2, "scale", |text| super::xyz(text, scale));
        }
        return;
    }
    let transform = inverse.inverse();
    if transform.is_finite() {
        let columns = [transform.x_axis, transform.y_axis, transform.z_axis];
        placed(text, indent + 2, (columns, transform.translation));
    }
}

/// Writes a number with a texture.
pub(super) fn number(
    text: &mut String,
    at: (usize, &str),
    (number, texture): (f64, Option<u32>),
    scene: &Scene,
) {
    with(text, at, |text| value(text, number), texture, scene);
}
