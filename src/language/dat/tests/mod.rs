//! Tests of the meaning of `.dat` texts.

mod cameras;
mod errors;
mod limits;
mod meaning;
mod pictures;
mod properties;
mod records;
mod solids;
mod views;
mod visibility;
mod written;

use crate::tests::{read_as, shown};
use crate::{Language, Lowered, Source};
use scene::{Meshes, Scene};

/// The three records of a view.
const VIEW: &str = "camera perspective 0 0 5  0 0 0  0 1 0  1 0 100
resolution 0.01 0.01
viewport 80 60
";

/// The numbers of a material.
const MAT: &str = "1 1 1  0.1 0.8 0.1 5  0 0 1";

/// A text with `VIEW` replaced by the records above, `MAT` by a material after its ID, `BALL` by a
/// sphere up to its radius and `AXES` by the directions of a right-handed frame.
fn spelled(text: &str) -> String {
    text.replace("VIEW\n", VIEW)
        .replace("MAT", MAT)
        .replace("BALL", "mat ID 0  0 0 0")
        .replace("AXES", "1 0 0  0 1 0  0 0 1")
}

fn read(text: &str) -> (Source, Lowered) {
    read_as(Language::Dat, text, &Meshes::default())
}

/// The scene of a text without errors and warnings.
fn scene(text: &str) -> Scene {
    let (_, lowered) = read(text);
    assert_eq!(shown(text, &lowered), [""; 0], "{text}");
    lowered.scene.expect("there are no errors")
}
