//! Tests of the meaning of `.test` texts.

mod edits;
mod errors;
mod meaning;
mod properties;

use crate::tests::read_as;
use crate::{Language, Lowered, Source};
use scene::Meshes;

fn read(text: &str) -> (Source, Lowered) {
    read_as(Language::Cse167, text, &Meshes::default())
}
