//! Tree → scene, one language a file. Never panics, never loops, never allocates by a number that
//! the text merely declares, and takes time linear in the text.

mod dat;
mod objects;
mod ray;
mod record;
mod report;
#[cfg(test)]
mod tests;
mod view;

use super::{Origins, Scene};
use crate::format::Tree;
use crate::text::Findings;

/// What a tree means.
#[derive(Debug)]
pub struct Lowered {
    /// The scene; `None` where there are errors.
    pub scene: Option<Scene>,
    /// Where its fields stand; complete up to where the text could be understood.
    pub origins: Origins,
    /// Errors and warnings, in text order.
    pub diagnostics: Findings,
}

/// Reads the meaning of a tree. All errors that can be told apart are reported at once.
pub fn lower(text: &str, tree: &Tree) -> Lowered {
    match tree {
        Tree::Ray(tree) => ray::lower(text, tree),
        Tree::Dat(tree) => dat::lower(text, tree),
    }
}
