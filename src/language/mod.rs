//! Scenes as text: a folder for each language, and here what all of them answer.
//!
//! A language reads text into a tree, lowers the tree to a [`Scene`], knows where in the text each
//! field stands, and makes edits that say something else there. [`Source`] holds text, tree and places
//! of one language together. The rest of the program asks it by the questions of [`Answers`], and never
//! learns which language it is.

mod camera;
mod dat;
mod node;
mod placed;
mod ray;
mod record;
mod report;
mod room;
pub mod table;
#[cfg(test)]
mod tests;
mod view;
mod written;
mod xml;

use std::borrow::Cow;
use std::fmt::Debug;
use std::ops::{Deref, DerefMut};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::memory::OutOfMemory;
use crate::scene::{Camera, Meshes, Scene};
use crate::text::{Diagnostic, Edit, Findings, Span};
use room::Counts;
use table::Category;

pub use node::{FileKind, NamedFile, Node, Nodes};
pub use placed::{Placed, Unsaid};
pub use room::fits;

/// Declares the languages, one a line: by its folder, which is also the extension of its files' names.
/// A folder provides `Source`, `parse`, `errors_of_beginning`, `tree_bytes` and `LEAVES_KEEP_TO_LINES`.
macro_rules! languages {
    ($($(#[$doc:meta])* $name:ident in $folder:ident,)+) => {
        /// The languages Halflight reads.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Language {
            $($(#[$doc])* $name,)+
        }

        impl Language {
            /// All of them.
            pub const ALL: [Self; [$(stringify!($name)),+].len()] = [$(Self::$name),+];

            /// The extension of its files' names.
            pub const fn extension(self) -> &'static str {
                match self {
                    $(Self::$name => stringify!($folder),)+
                }
            }

            /// Whether no leaf crosses the end of a line, and each line is read alike wherever it
            /// stands.
            pub const fn leaves_keep_to_lines(self) -> bool {
                match self {
                    $(Self::$name => $folder::LEAVES_KEEP_TO_LINES,)+
                }
            }

            /// About how many bytes a tree of so many leaves takes while it is made. Lists that grow
            /// have up to twice the room they need.
            fn tree_bytes(self, counts: &Counts) -> u64 {
                match self {
                    $(Self::$name => $folder::tree_bytes(counts),)+
                }
            }
        }

        /// The errors of every text that begins like this, with the warnings so far; none where what
        /// follows may make a scene of it.
        pub fn errors_of_beginning(language: Language, beginning: &str) -> Findings {
            let findings = match language {
                $(Language::$name => $folder::errors_of_beginning(beginning),)+
            };
            findings.sorted()
        }

        /// A scene's text, its tree, and where its things stand, in one language.
        #[derive(Clone, Debug)]
        pub enum Source {
            $($(#[$doc])* $name(Box<$folder::Source>),)+
        }

        impl Source {
            /// Parses a text. Never fails: whatever stands in the text has a place in the tree. Its
            /// things have places once it is lowered.
            pub fn new(language: Language, text: Arc<String>) -> Self {
                match language {
                    $(Language::$name => Self::$name(Box::new($folder::parse(text))),)+
                }
            }

            /// The language.
            pub fn language(&self) -> Language {
                match self {
                    $(Self::$name(_) => Language::$name,)+
                }
            }
        }

        impl Deref for Source {
            type Target = dyn Answers;

            fn deref(&self) -> &Self::Target {
                match self {
                    $(Self::$name(source) => &**source,)+
                }
            }
        }

        impl DerefMut for Source {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match self {
                    $(Self::$name(source) => &mut **source,)+
                }
            }
        }
    };
}

languages! {
    /// Rice University's `.ray`: a stream of tokens.
    Ray in ray,
    /// Boston University's `.dat`: one record a line.
    Dat in dat,
    /// The University of Utah's `.xml`: elements with attributes.
    Xml in xml,
}

/// A file whose name does not say which language it is written in.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: not a scene: scenes end in {}", extensions(), path = .0.display())]
pub struct UnknownLanguage(pub PathBuf);

impl Language {
    /// The language that a file name's extension says, in any case.
    pub fn of_path(path: &Path) -> Result<Self, UnknownLanguage> {
        let extension = path.extension().unwrap_or_default();
        let is = |known: &Self| extension.eq_ignore_ascii_case(known.extension());
        let known = Self::ALL.into_iter().find(is);
        known.ok_or_else(|| UnknownLanguage(path.to_owned()))
    }
}

/// The extensions of all languages, as a sentence lists them.
fn extensions() -> String {
    let extensions = Language::ALL.map(|language| format!(".{}", language.extension()));
    match &extensions[..] {
        [others @ .., last] => format!("{} or {last}", others.join(", ")),
        [] => String::new(),
    }
}

/// What a text means.
#[derive(Debug)]
pub struct Lowered {
    /// The scene; `None` where there are errors.
    pub scene: Option<Scene>,
    /// Errors and warnings, in text order.
    pub diagnostics: Findings,
}

impl Lowered {
    /// What a text means that is not lowered: nothing, for this reason.
    pub fn refused(reason: &OutOfMemory) -> Self {
        let mut diagnostics = Findings::default();
        diagnostics.error(|| {
            let start = Span::at(0);
            Diagnostic::error(start, reason.to_string(), "a scene that fits into memory")
        });
        Self {
            scene: None,
            diagnostics,
        }
    }
}

/// What a text without errors meant before an edit.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// Warnings.
    pub diagnostics: &'a Findings,
}

/// Whether an object is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Visibility {
    /// It is.
    Shown,
    /// It is not.
    Hidden,
}

/// What every language answers about a scene's text. Where things stand is as of the last lowering,
/// and complete up to where the text could be understood.
pub trait Answers: Debug {
    /// The text.
    fn text(&self) -> &Arc<String>;

    /// Applies edits, sorted and disjoint, to the text and the tree, which stays that of
    /// [`Source::new`]; returns the edits that lead back. What shares the text keeps the old one.
    fn change(&mut self, edits: &[Edit]) -> Vec<Edit>;

    /// Takes back the places of the last lowering, if the text was not changed since: those of the
    /// lowering before stand again.
    fn restore(&mut self);

    /// Finds the meaning of the text, with the meshes that are read so far, and where its things stand.
    /// All errors that can be told apart are reported at once. Never panics, never loops, never
    /// allocates by a number that the text merely declares, and takes time linear in the text.
    ///
    /// # Errors
    ///
    /// Where the scene does not fit into memory; nothing has a place then.
    fn lower(&mut self, meshes: &Meshes) -> Result<Lowered, OutOfMemory>;

    /// As [`Answers::lower`] after an edit, of which `changed` is what it put in the place of the bytes
    /// `old`: sooner for a number of an object among very many. `before` is what was found when things
    /// were placed as they are now.
    ///
    /// # Errors
    ///
    /// As [`Answers::lower`].
    fn lower_again(
        &mut self,
        meshes: &Meshes,
        before: Before<'_>,
        [old, changed]: [Span; 2],
    ) -> Result<Lowered, OutOfMemory> {
        let _ = (before, old, changed);
        self.lower(meshes)
    }

    /// The parts of the text that carry meaning, in order: tokens, and comments whole. What lies
    /// between them is white space.
    fn leaves(&self) -> Vec<Span>;

    /// What a leaf says.
    fn said(&self, leaf: Span) -> &str {
        leaf.of(self.text())
    }

    /// How a leaf is written to say something.
    fn spelled<'v>(&self, leaf: Span, value: &'v str) -> Cow<'v, str> {
        let _ = leaf;
        Cow::Borrowed(value)
    }

    /// The view, ambient light or background and environment, lights, materials, textures, objects: as
    /// far as the text has them.
    fn nodes(&self) -> Nodes;

    /// What a node is called: `view`, `ambient`, `light 2`, `object 3 (box)`.
    fn name(&self, node: Node) -> String;

    /// How many listed things a node is in.
    fn depth(&self, node: Node) -> usize {
        let _ = node;
        0
    }

    /// A node's fields with their places. A node whose text breaks off has only those fields whose
    /// components are all there.
    fn fields(&self, node: Node) -> Vec<Placed>;

    /// The whole of a node's text, from its first token to its last; empty for a missing view. Of a
    /// node that stands in several places, the first.
    fn span(&self, node: Node) -> Span;

    /// What a comment says of a node: one that follows its text in the line where that begins, or
    /// else where it ends; in `.dat` one that takes the line before; in `.xml` one behind the start tag
    /// or in the line before.
    fn comment(&self, node: Node) -> Option<&str>;

    /// The node whose text holds or touches `span`. A view comment inside another node's text
    /// counts as the view; where it ends at that node's token, the token counts.
    fn node_at(&self, span: Span) -> Option<Node>;

    /// The nodes whose text `span` covers in part or lies within, in text order.
    fn nodes_in(&self, span: Span) -> Vec<Node>;

    /// What an object is made of: itself, then the objects it combines, each with how deep it lies
    /// below the first. At most `limit` of them; one alone if it is no combination.
    fn parts(&self, object: usize, limit: usize) -> Vec<(usize, Node)> {
        let _ = limit;
        vec![(0, Node::Object(object))]
    }

    /// The word by which an object combines others: `union`. `None` if it is no combination.
    fn operation(&self, object: usize) -> Option<&str> {
        let _ = object;
        None
    }

    /// The object of the scene that an object of the text is; `None` if it is not drawn.
    fn drawn(&self, object: usize) -> Option<u32> {
        u32::try_from(object).ok()
    }

    /// Whether an object of the text is but what is in it.
    fn is_group(&self, object: usize) -> bool {
        let _ = object;
        false
    }

    /// The object of the text that an object of the scene is.
    fn object(&self, drawn: u32) -> usize {
        drawn as usize
    }

    /// The material of an object that is listed as a thing of its own.
    fn material(&self, object: usize) -> Option<usize> {
        let _ = object;
        None
    }

    /// The numbers that a field of a node may refer to: those of a category that are given before
    /// the node's text, ascending.
    fn identities(&self, node: Node, category: Category) -> Vec<i64> {
        let _ = (node, category);
        Vec::new()
    }

    /// The names that a field may say: those of a category, in text order, each once.
    fn names(&self, category: Category) -> Vec<String> {
        let _ = category;
        Vec::new()
    }

    /// The files that the text names, or that its meshes do, as far as those were read.
    fn files(&self) -> Vec<NamedFile> {
        Vec::new()
    }

    /// How many objects a material or a texture is part of.
    fn users(&self, node: Node) -> usize {
        let _ = node;
        0
    }

    /// What the fields of the view would say of a camera, one literal a component, in the order of
    /// [`Answers::fields`].
    fn view_literals(&self, camera: &Camera) -> Vec<Vec<String>>;

    /// The camera after a component of a field of the view says something else.
    ///
    /// # Errors
    ///
    /// What it must be, if it can't be that.
    fn view_saying(
        &self,
        camera: &Camera,
        at: (usize, usize),
        said: &str,
    ) -> Result<Camera, String>;

    /// The edits that make the text say this camera: numbers that it states differently are replaced,
    /// missing parts are added. `before` is the camera as lowered; only parts that differ from it are
    /// written, and those whose defaults would move with them.
    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit>;

    /// The edits after which the text shows or hides an object, by index, and does with all others as
    /// before.
    ///
    /// # Errors
    ///
    /// Why no text can say that.
    fn visibility_edits(
        &self,
        object: usize,
        wanted: Visibility,
    ) -> Result<Vec<Edit>, &'static str> {
        let _ = (object, wanted);
        Err("in this language every object is drawn")
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
