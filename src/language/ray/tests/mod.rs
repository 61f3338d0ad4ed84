//! Tests of the meaning of `.ray` texts.

mod blocks;
mod errors;
mod kinds;
mod meaning;
pub(crate) mod properties;
mod views;
mod written;

use crate::tests::{read_as, shown};
use crate::{Language, Lowered, Source};
use scene::{Meshes, Scene};

/// Ambient light and one light.
const HEAD: &str = "1 1 1  1  0 5 5  1 1 1";

/// The numbers of a material.
const MAT: &str = "0.1 0.1 0.1  0.5 0.5 0.5  0.2 0.2 0.2  5 0 0 1";

/// The directions of a right-handed frame.
const AXES: &str = "1 0 0  0 1 0  0 0 1";

/// A text with `HEAD`, `MAT` and `AXES` replaced by the numbers above.
fn spelled(text: &str) -> String {
    text.replace("HEAD", HEAD)
        .replace("MAT", MAT)
        .replace("AXES", AXES)
}

fn read(text: &str) -> (Source, Lowered) {
    read_as(Language::Ray, text, &Meshes::default())
}

/// The scene of an error-free text.
fn scene(text: &str) -> Scene {
    let (_, lowered) = read(text);
    let said = shown(text, &lowered);
    lowered.scene.unwrap_or_else(|| panic!("{text}\n{said:#?}"))
}
