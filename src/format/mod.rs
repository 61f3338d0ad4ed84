//! Text ⇄ tree, one language a file. Knows how a language is written, not what a scene is.

pub mod ray;

use std::path::{Path, PathBuf};

use crate::text::Span;

/// The languages Halflight reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Rice University's `.ray`: a stream of tokens.
    Ray,
}

/// A file whose name does not say which language it is written in.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: not a scene: scenes end in .ray", path = .0.display())]
pub struct UnknownLanguage(pub PathBuf);

impl Format {
    /// The format a file name's extension says, in any case.
    pub fn of_path(path: &Path) -> Result<Self, UnknownLanguage> {
        let extension = path.extension().unwrap_or_default();
        if extension.eq_ignore_ascii_case("ray") {
            Ok(Self::Ray)
        } else {
            Err(UnknownLanguage(path.to_owned()))
        }
    }
}

/// The syntax of one text.
#[derive(Clone, Debug)]
pub enum Tree {
    /// Tokens and comments.
    Ray(ray::Tree),
}

/// Reads a text's syntax. Never fails: whatever stands in the text has a place in the tree.
pub fn parse(format: Format, text: &str) -> Tree {
    match format {
        Format::Ray => Tree::Ray(ray::parse(text)),
    }
}

impl Tree {
    /// The parts of the text that carry meaning, in order: tokens, and comments whole. What lies
    /// between them is white space.
    pub fn leaves(&self) -> Vec<Span> {
        let Self::Ray(tree) = self;
        let comments = tree.comments.iter().map(|comment| comment.span);
        let mut leaves: Vec<_> = tree.tokens.iter().copied().chain(comments).collect();
        leaves.sort_unstable();
        leaves
    }
}
