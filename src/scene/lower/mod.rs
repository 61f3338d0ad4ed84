//! Tree → scene, one language a file. Never panics, never loops, never allocates by a number that
//! the text merely declares, and takes time linear in the text.

mod again;
mod beginning;
mod blocks;
mod dat;
mod objects;
mod ray;
mod record;
mod report;
mod room;
#[cfg(test)]
mod tests;
mod view;
mod xml;

pub use beginning::errors_of_beginning;
pub use room::fits;

use super::{Meshes, Origins, Scene};
use crate::format::Tree;
use crate::text::{Findings, Span};

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

/// Reads the meaning of a tree, with the meshes that are read so far. All errors that can be told
/// apart are reported at once.
pub fn lower(text: &str, tree: &Tree, meshes: &Meshes) -> Lowered {
    match tree {
        Tree::Ray(tree) => ray::lower(text, tree),
        Tree::Dat(tree) => dat::lower(text, tree),
        Tree::Xml(tree) => xml::lower(text, tree, meshes),
    }
}

/// What a text without errors meant before an edit.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Where its fields stood.
    pub origins: &'a Origins,
    /// Warnings.
    pub diagnostics: &'a Findings,
}

/// Reads the meaning of a tree after an edit, of which `changed` is what it put in the place of the
/// bytes `old`: that of [`lower`], sooner for a number of an object among very many.
pub fn lower_again(
    text: &str,
    tree: &Tree,
    meshes: &Meshes,
    before: Before<'_>,
    [old, changed]: [Span; 2],
) -> Lowered {
    let again = match tree {
        Tree::Ray(tree) => again::lower(text, tree, &before, old, changed),
        Tree::Dat(_) | Tree::Xml(_) => None,
    };
    again.unwrap_or_else(|| lower(text, tree, meshes))
}
