//! What `.xml` texts mean, as data.

mod edits;
mod errors;
mod meaning;
mod meshes;
mod properties;

use super::shown;
use crate::format::{Format, Tree, parse};
use crate::scene::lower::{Lowered, lower};
use crate::scene::{Meshes, Scene};

/// The course's own example.
const EXAMPLE: &str = include_str!("../../../../../scenes/spheres.xml");

/// A camera that stands somewhere.
const CAMERA: &str = "<camera><position z='5'/><target/></camera>";

/// A text of what is in the scene.
fn around(scene: &str) -> String {
    format!("<xml><scene>{scene}</scene>{CAMERA}</xml>")
}

fn read(text: &str) -> (Tree, Lowered) {
    read_with(text, &Meshes::default())
}

fn read_with(text: &str, meshes: &Meshes) -> (Tree, Lowered) {
    let tree = parse(Format::Xml, text);
    let lowered = lower(text, &tree, meshes);
    (tree, lowered)
}

/// The meaning of a text that must be free of errors.
fn scene(text: &str) -> Scene {
    let (_, lowered) = read(text);
    let said = shown(text, &lowered);
    lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"))
}
