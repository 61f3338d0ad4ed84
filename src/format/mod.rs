//! Text ⇄ tree, one language a file. Knows how a language is written, not what a scene is.

pub mod dat;
pub mod ray;
mod room;
pub mod xml;

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use crate::text::Span;

pub use room::fits;

/// The languages Halflight reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Rice University's `.ray`: a stream of tokens.
    Ray,
    /// Boston University's `.dat`: one record a line.
    Dat,
    /// The University of Utah's `.xml`: elements with attributes.
    Xml,
}

/// A file whose name does not say which language it is written in.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: not a scene: scenes end in .ray, .dat or .xml", path = .0.display())]
pub struct UnknownLanguage(pub PathBuf);

impl Format {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Ray, Self::Dat, Self::Xml];

    /// The extension of its files' names.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Ray => "ray",
            Self::Dat => "dat",
            Self::Xml => "xml",
        }
    }

    /// Whether no leaf crosses the end of a line, and each line is read alike wherever it stands.
    pub const fn leaves_keep_to_lines(self) -> bool {
        match self {
            Self::Ray | Self::Dat => true,
            Self::Xml => false,
        }
    }

    /// The format a file name's extension says, in any case.
    pub fn of_path(path: &Path) -> Result<Self, UnknownLanguage> {
        let extension = path.extension().unwrap_or_default();
        let is = |known: &Self| extension.eq_ignore_ascii_case(known.extension());
        let known = Self::ALL.into_iter().find(is);
        known.ok_or_else(|| UnknownLanguage(path.to_owned()))
    }
}

/// The syntax of one text.
#[derive(Clone, Debug)]
pub enum Tree {
    /// Tokens and comments.
    Ray(ray::Tree),
    /// Records and comments.
    Dat(dat::Tree),
    /// Elements and comments.
    Xml(xml::Tree),
}

/// Reads a text's syntax. Never fails: whatever stands in the text has a place in the tree.
pub fn parse(format: Format, text: &str) -> Tree {
    match format {
        Format::Ray => Tree::Ray(ray::parse(text)),
        Format::Dat => Tree::Dat(dat::parse(text)),
        Format::Xml => Tree::Xml(xml::parse(text)),
    }
}

impl Tree {
    /// Becomes the tree of the text after an edit, of which `changed` is what it put in the place of
    /// the bytes `old`: that of [`parse`], sooner in long texts.
    pub fn follow(&mut self, text: &str, old: Span, changed: Span) {
        match self {
            Self::Ray(tree) => tree.follow(text, old, changed),
            Self::Dat(tree) => *tree = dat::parse(text),
            Self::Xml(tree) => *tree = xml::parse(text),
        }
    }

    /// What a leaf says.
    pub fn said<'t>(&'t self, text: &'t str, leaf: Span) -> &'t str {
        match self {
            Self::Ray(_) | Self::Dat(_) => leaf.of(text),
            Self::Xml(tree) => tree.said(text, leaf),
        }
    }

    /// How a leaf is written to say something.
    pub fn spelled<'v>(&self, text: &str, leaf: Span, value: &'v str) -> Cow<'v, str> {
        match self {
            Self::Ray(_) | Self::Dat(_) => Cow::Borrowed(value),
            Self::Xml(_) => xml::spelled(value, xml::quote(text, leaf)),
        }
    }

    /// The parts of the text that carry meaning, in order: tokens, and comments whole. What lies
    /// between them is white space.
    pub fn leaves(&self) -> Vec<Span> {
        let mut leaves: Vec<_> = match self {
            Self::Ray(tree) => {
                let comments = tree.comments.iter().map(|comment| comment.span);
                tree.tokens.all().into_iter().chain(comments).collect()
            }
            Self::Dat(tree) => tree.tokens.iter().chain(&tree.comments).copied().collect(),
            Self::Xml(tree) => tree.leaves(),
        };
        leaves.sort_unstable();
        leaves
    }
}

/// The width in bytes of the white-space character that `bytes` begin with.
fn white_space(bytes: &[u8]) -> Option<usize> {
    match bytes {
        [b' ' | b'\t' | b'\n' | b'\r' | 0x0B | 0x0C, ..] => Some(1),
        [0xC2, 0xA0, ..] => Some(2),
        [0xEF, 0xBB, 0xBF, ..] => Some(3),
        _ => None,
    }
}

/// The span without white space at its end.
fn trim_end(text: &str, span: Span) -> Span {
    let kept = span
        .of(text)
        .trim_end_matches([' ', '\t', '\r', '\n', '\x0B', '\x0C', '\u{A0}', '\u{FEFF}']);
    Span::new(span.start(), span.start() + kept.len())
}
