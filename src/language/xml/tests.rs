//! What `.xml` texts mean, as data.

mod edits;
mod errors;
mod meaning;
mod meshes;
mod properties;

use crate::language::tests::{read_as, shown};
use crate::language::{Language, Lowered, Source};
use crate::scene::{Meshes, Scene};

/// The course's own example.
const EXAMPLE: &str = include_str!("../../../scenes/spheres.xml");

/// A camera that stands somewhere.
const CAMERA: &str = "<camera><position z='5'/><target/></camera>";

/// A text of what is in the scene.
fn around(scene: &str) -> String {
    format!("<xml><scene>{scene}</scene>{CAMERA}</xml>")
}

fn read(text: &str) -> (Source, Lowered) {
    read_with(text, &Meshes::default())
}

fn read_with(text: &str, meshes: &Meshes) -> (Source, Lowered) {
    read_as(Language::Xml, text, meshes)
}

/// The meaning of a text that must be free of errors.
fn scene(text: &str) -> Scene {
    let (_, lowered) = read(text);
    let said = shown(text, &lowered);
    lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"))
}
