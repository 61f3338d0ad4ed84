//! Tree → scene, one language a file. Never panics, never loops, never allocates by a number that
//! the text merely declares, and takes time linear in the text.

mod objects;
mod ray;
mod record;
mod report;
#[cfg(test)]
mod tests;
mod view;
mod view_edits;

use super::{Camera, Origins, Scene};
use crate::format::Tree;
use crate::text::{Edit, Findings};

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
    let Tree::Ray(tree) = tree;
    ray::lower(text, tree)
}

/// The edits that make the text say this camera: numbers that the view states differently are
/// replaced, missing parts added to it, a missing view inserted as a comment on the first line.
/// `before` is the camera as lowered; only parts that differ from it are written, and the eye where
/// its default would move with the new angle of view.
pub fn view_edits(
    text: &str,
    tree: &Tree,
    origins: &Origins,
    before: &Camera,
    camera: &Camera,
) -> Vec<Edit> {
    let Tree::Ray(_) = tree;
    view_edits::view_edits(text, origins, before, camera)
}
