//! Tests of the meaning of `.xml` texts.

mod around_mesh;
mod edits;
mod errors;
mod meaning;
mod meshes;
mod properties;
mod written;

use crate::tests::{read_as, shown};
use crate::{Language, Lowered, Source};
use scene::{Meshes, Scene};

/// The example of the course.
const EXAMPLE: &str = include_str!("../../../../scenes/spheres.xml");

/// A camera with a position.
const CAMERA: &str = "<camera><position z='5'/><target/></camera>";

/// A text with this content of the scene.
fn around(scene: &str) -> String {
    format!("<xml><scene>{scene}</scene>{CAMERA}</xml>")
}

fn read(text: &str) -> (Source, Lowered) {
    read_with(text, &Meshes::default())
}

fn read_with(text: &str, meshes: &Meshes) -> (Source, Lowered) {
    read_as(Language::Xml, text, meshes)
}

/// The scene of an error-free text.
fn scene(text: &str) -> Scene {
    let (_, lowered) = read(text);
    let said = shown(text, &lowered);
    lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"))
}
