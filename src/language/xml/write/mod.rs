//! Writes any scene as an `.xml` text.

mod lights;
mod materials;
mod objects;
mod textures;
mod transforms;

use std::fmt::Write;

use glam::DVec3;

use super::tree::escaped;
use crate::losses::Losses;
use crate::rendering::spelled;
use crate::spelling;
use crate::surroundings::angle;
use scene::{Camera, Focus, Rgb, Scene, Size};

/// Writes a scene and reports what it loses.
pub(crate) fn write(scene: &Scene, losses: &mut Losses<'_>) -> String {
    let mut text = "<xml>\n  <scene>\n".to_owned();
    let setting = &scene.setting;
    let surroundings = [
        ("background", setting.background),
        ("environment", setting.environment),
    ];
    for (word, around) in surroundings {
        if around.colour != Rgb::ZERO {
            let tint = (around.colour, around.texture);
            textures::tinted(&mut text, (4, word), tint, scene);
        }
    }
    let is_baked = materials::is_baked(scene, losses);
    let names = materials::names(scene, losses);
    objects::write(&mut text, scene, &names, losses);
    materials::write(&mut text, scene, (&names, is_baked), losses);
    lights::write(&mut text, scene, is_baked, losses);
    text.push_str("  </scene>\n\n");
    camera(&mut text, &scene.camera, angle(scene, losses));
    let settings = spelled(&scene.setting.rendering);
    if !settings.is_empty() {
        element(&mut text, 2, "render", |text| {
            for (key, value) in &settings {
                word(text, key, value.as_str());
            }
        });
    }
    text.push_str("</xml>\n");
    text
}

/// Writes a camera with this angle of view.
pub(super) fn camera(text: &mut String, camera: &Camera, angle: f64) {
    text.push_str("  <camera>\n");
    let Camera {
        eye,
        target,
        up,
        focus,
        size: Size { width, height },
        ..
    } = *camera;
    for (word, vector) in [("position", eye), ("target", target), ("up", up)] {
        element(text, 4, word, |text| xyz(text, vector));
    }
    element(text, 4, "fov", |text| value(text, angle));
    if focus != Focus::PINHOLE {
        element(text, 4, "focaldist", |text| value(text, focus.distance));
        element(text, 4, "dof", |text| value(text, focus.lens_radius));
    }
    element(text, 4, "width", |text| value(text, width.into()));
    element(text, 4, "height", |text| value(text, height.into()));
    text.push_str("  </camera>\n");
}

/// Writes an empty element, indented by so many blanks.
pub(super) fn element(
    text: &mut String,
    indent: usize,
    word: &str,
    attributes: impl FnOnce(&mut String),
) {
    open(text, indent, word);
    attributes(text);
    text.push_str("/>\n");
}

/// Begins an element of a kind, with a name if it has one.
fn begin(text: &mut String, element: &str, kind: &str, name: Option<&str>) {
    open(text, 4, element);
    word(text, "type", kind);
    word(text, "name", name);
    text.push_str(">\n");
}

/// Begins a light.
pub(super) fn light(text: &mut String, kind: &str, name: Option<&str>, colour: Rgb) {
    begin(text, "light", kind, name);
    element(text, 6, "intensity", |text| rgb(text, colour));
}

/// Begins the tag of an element.
fn open(text: &mut String, indent: usize, word: &str) {
    // Writing to a string cannot fail.
    let _ = write!(text, "{:indent$}<{word}", "");
}

/// Writes the attribute `value`.
pub(super) fn value(text: &mut String, number: f64) {
    attribute(text, "value", number);
}

fn attribute(text: &mut String, name: &str, number: f64) {
    text.push(' ');
    text.push_str(name);
    text.push_str("=\"");
    spelling::number(text, number);
    text.push('"');
}

/// Writes an attribute, if it has a value. What XML cannot hold becomes a blank.
pub(super) fn word<'w>(text: &mut String, name: &str, word: impl Into<Option<&'w str>>) {
    let Some(word) = word.into() else {
        return;
    };
    let is_foreign = |c: char| match c {
        '\t' | '\n' | '\r' => false,
        '\u{FFFE}' | '\u{FFFF}' => true,
        c => c.is_ascii_control(),
    };
    let word = word.replace(is_foreign, " ");
    // Writing to a string cannot fail.
    let _ = write!(text, " {name}=\"{}\"", escaped(&word, '"'));
}

pub(super) fn xyz(text: &mut String, vector: DVec3) {
    for (name, number) in ["x", "y", "z"].into_iter().zip(vector.to_array()) {
        attribute(text, name, number);
    }
}

/// Writes a colour, a grey as one number.
fn rgb(text: &mut String, colour: Rgb) {
    if colour == Rgb::splat(colour.x) {
        value(text, colour.x);
    } else {
        for (name, number) in ["r", "g", "b"].into_iter().zip(colour.to_array()) {
            attribute(text, name, number);
        }
    }
}
