//! Scene languages: one folder each, and the interface they share.
//!
//! A language parses text into a tree, lowers the tree to a [`Scene`], knows the place of each
//! field in the text, and makes edits that change a field there. [`Source`] holds the text, tree
//! and places of one scene together. The rest of the program uses it through [`SceneText`] and never
//! learns which language it is.

mod approximations;
mod camera;
pub mod coefficients;
mod convert;
mod cse167;
mod dat;
mod engine;
mod field_spans;
mod form;
mod frame;
mod listed;
mod losses;
mod memory_estimate;
mod node;
mod partition;
mod picture_lint;
mod ray;
mod record;
mod rendering;
mod report;
mod roles;
mod saved;
pub mod schema;
mod spelling;
mod starter;
mod structure;
mod surroundings;
#[cfg(test)]
mod tests;
mod verify_conversion;
mod view;
mod whitted;
mod words;
mod written;
pub mod xml;

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fmt::Debug;
use std::ops::{Deref, DerefMut};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use losses::Losses;
use memory::OutOfMemory;
use memory_estimate::Counts;
use scene::{Camera, Meshes, Scene};
use schema::{Category, Field, Schema};
use text::{Diagnostic, Edit, Findings, Span, alternatives};
use view::Numbers;

pub use convert::{Converted, convert};
pub use field_spans::{FieldSpans, Wanted};
pub use form::{Along, Motion};
pub use listed::Visibility;
pub use memory_estimate::fits;
pub use node::{FileKind, NamedFile, Node, Nodes};
pub use picture_lint::{Outlook, Prospect, outlook};
pub use rendering::{parts_of_comment, settings};
pub use roles::{Role, Roles};
pub use saved::{SavedView, view_name};
pub use structure::{
    Addition, Neighbour, NewNode, Placement, Pose, StructureEdits, StructureError,
};

/// Declares the languages, one per line, by folder name and file extension. A folder
/// provides `Source`, `errors_of_beginning`, `tree_bytes`, `write`, `LEAVES_KEEP_TO_LINES`,
/// `LOWERS_CHANGES`, `VERTICAL`, `TEMPLATE` and `SKELETON`.
macro_rules! languages {
    ($($(#[$doc:meta])* $name:ident in $folder:ident as $extension:literal,)+) => {
        /// The supported scene languages.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Language {
            $($(#[$doc])* $name,)+
        }

        impl Language {
            /// All languages.
            pub const ALL: [Self; [$(stringify!($name)),+].len()] = [$(Self::$name),+];

            /// The file extension, without the dot.
            pub const fn extension(self) -> &'static str {
                match self {
                    $(Self::$name => $extension,)+
                }
            }

            /// A small valid scene to begin with: a ground, a solid, lights and a view.
            pub const fn template(self) -> &'static str {
                match self {
                    $(Self::$name => $folder::TEMPLATE,)+
                }
            }

            /// A minimal valid scene to put a first thing into.
            const fn skeleton(self) -> &'static str {
                match self {
                    $(Self::$name => $folder::SKELETON,)+
                }
            }

            /// Whether no leaf crosses a line end, and lines are read regardless of their position.
            pub const fn leaves_keep_to_lines(self) -> bool {
                match self {
                    $(Self::$name => $folder::LEAVES_KEEP_TO_LINES,)+
                }
            }

            /// The axis that points up in most of its scenes: y or z.
            pub const fn vertical(self) -> DVec3 {
                match self {
                    $(Self::$name => $folder::VERTICAL,)+
                }
            }

            /// Whether [`SceneText::lower_change`] may succeed.
            pub const fn lowers_changes(self) -> bool {
                match self {
                    $(Self::$name => $folder::LOWERS_CHANGES,)+
                }
            }

            /// Writes a scene of any language, and reports what it loses.
            fn write(self, scene: &Scene, losses: &mut Losses<'_>) -> String {
                match self {
                    $(Self::$name => $folder::write(scene, losses),)+
                }
            }

            /// Estimates the bytes needed to build a tree with these counts. Growing lists have up
            /// to twice the capacity they need.
            fn tree_bytes(self, counts: &Counts) -> u64 {
                match self {
                    $(Self::$name => $folder::tree_bytes(counts),)+
                }
            }
        }

        /// Returns the errors of every text with this beginning, with the warnings so far; empty if
        /// what follows could still complete a valid scene.
        pub fn errors_of_beginning(language: Language, beginning: &str) -> Findings {
            let findings = match language {
                $(Language::$name => $folder::errors_of_beginning(beginning),)+
            };
            findings.sorted()
        }

        /// A text in one of the languages.
        #[derive(Clone, Debug)]
        enum OneOf {
            $($name(Box<$folder::Source>),)+
        }

        impl Source {
            /// Parses a text. Never fails: every part of the text has a place in the tree. Nodes
            /// have places only after lowering.
            pub fn new(language: Language, text: Arc<String>) -> Self {
                Self(match language {
                    $(Language::$name => OneOf::$name(Box::new($folder::Source::new(text))),)+
                })
            }

            /// The language of the text.
            pub fn language(&self) -> Language {
                match self.0 {
                    $(OneOf::$name(_) => Language::$name,)+
                }
            }
        }

        impl Deref for Source {
            type Target = dyn SceneText;

            fn deref(&self) -> &Self::Target {
                match &self.0 {
                    $(OneOf::$name(source) => &**source,)+
                }
            }
        }

        impl DerefMut for Source {
            fn deref_mut(&mut self) -> &mut Self::Target {
                match &mut self.0 {
                    $(OneOf::$name(source) => &mut **source,)+
                }
            }
        }
    };
}

languages! {
    /// Rice University's `.ray`: a stream of tokens.
    Ray in ray as "ray",
    /// Boston University's `.dat`: one record per line.
    Dat in dat as "dat",
    /// The University of Utah's `.xml`: elements with attributes.
    Xml in xml as "xml",
    /// `.test` of UCSD CSE 167, Berkeley CS 184 and edX: a command a line, which changes a state.
    Cse167 in cse167 as "test",
}

/// A scene's text in one language, with its tree and the places of its nodes.
#[derive(Clone, Debug)]
pub struct Source(OneOf);

/// The error for a file name without the extension of a known language.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: not a scene: scenes end in {}", extensions(), path = .0.display())]
pub struct UnknownLanguage(pub PathBuf);

impl Language {
    /// The language with this extension, given without the dot, ignoring case.
    pub fn of_extension(extension: impl AsRef<OsStr>) -> Option<Self> {
        let extension = extension.as_ref();
        let is = |known: &Self| extension.eq_ignore_ascii_case(known.extension());
        Self::ALL.into_iter().find(is)
    }

    /// Returns the language for a file name's extension, ignoring case.
    pub fn of_path(path: &Path) -> Result<Self, UnknownLanguage> {
        let known = Self::of_extension(path.extension().unwrap_or_default());
        known.ok_or_else(|| UnknownLanguage(path.to_owned()))
    }
}

/// The extensions of all languages, as a list for a message.
pub fn extensions() -> String {
    alternatives(Language::ALL.map(|language| format!(".{}", language.extension())))
}

/// The result of lowering a text.
#[derive(Debug)]
pub struct Lowered {
    /// The scene; `None` if there are errors.
    pub scene: Option<Scene>,
    /// Findings, in text order.
    pub diagnostics: Findings,
}

impl Lowered {
    /// The result for a text that does not fit into memory: no scene, and `reason` as the error.
    pub fn refused(reason: &OutOfMemory) -> Self {
        let mut diagnostics = Findings::default();
        diagnostics.error(|| {
            let start = Span::at(0);
            Diagnostic::error(start, reason.to_string(), "a scene that fits into memory")
        });
        let scene = None;
        Self { scene, diagnostics }
    }
}

/// The result of lowering an error-free text before an edit.
#[derive(Clone, Copy, Debug)]
pub struct Before<'a> {
    /// The scene before the edit.
    pub scene: &'a Scene,
    /// The findings before the edit.
    pub diagnostics: &'a Findings,
}

/// A text with its tree and places.
pub trait Editable: Debug {
    /// The current text.
    fn text(&self) -> &Arc<String>;

    /// Applies edits, sorted and disjoint, to the text and the tree, which stays equal to a fresh
    /// parse by [`Source::new`]. Returns the inverse edits. Other holders of the text keep the old
    /// version.
    fn change(&mut self, edits: &[Edit]) -> Vec<Edit>;

    /// Replaces the text by the one that an edit turns it into, and returns it; see
    /// [`Editable::change`].
    fn substitute(&mut self, text: Arc<String>, edit: &Edit) -> Arc<String>;

    /// Applies the inverse of the last change, and restores the places of the text before that, even
    /// if the changed text was lowered.
    fn revert(&mut self, inverse: &[Edit]);
}

/// The text of a scene, in whatever language. Places are as of the last lowering, and
/// complete up to where the text could be understood.
pub trait SceneText: Editable + StructureEdits {
    /// Lowers the text, with the meshes read so far, and finds the places of its nodes. Reports all
    /// independent errors at once. Never panics, never loops, never allocates by a number that the
    /// text merely declares, and takes time linear in the text.
    ///
    /// # Errors
    ///
    /// Fails if the scene does not fit into memory; then no node has a place.
    fn lower(&mut self, meshes: &Meshes) -> Result<Lowered, OutOfMemory>;

    /// As [`SceneText::lower`] after the text was changed once, without reading the objects again that
    /// are as before; `None`, without any effect, if that is not possible. `before` is the result that
    /// belongs to the current places.
    fn lower_change(&mut self, before: Before<'_>) -> Option<Lowered> {
        let _ = before;
        None
    }

    /// As [`SceneText::lower`] after an edit, but faster where [`SceneText::lower_change`] is possible.
    ///
    /// # Errors
    ///
    /// As [`SceneText::lower`].
    fn lower_again(&mut self, meshes: &Meshes, before: Before<'_>) -> Result<Lowered, OutOfMemory> {
        match self.lower_change(before) {
            Some(lowered) => Ok(lowered),
            None => self.lower(meshes),
        }
    }

    /// The table of the records of its language; `None` if it consists of elements.
    fn records(&self) -> Option<&'static Schema> {
        None
    }

    /// The tokens and the whole comments of the text, in order. Between them is only white space.
    fn leaves(&self) -> Vec<Span>;

    /// Whether a leaf is a comment.
    fn is_comment(&self, leaf: Span) -> bool;

    /// The text of a leaf.
    fn leaf_text(&self, leaf: Span) -> &str {
        leaf.of(self.text())
    }

    /// Returns the edits that set these components of fields.
    fn edits(&self, wanted: &[Wanted<'_>]) -> Vec<Edit> {
        let mut edits = field_spans::edits(self, wanted);
        edits.extend(rendering::insertions(self.text(), wanted));
        Edit::sort(&mut edits);
        edits
    }

    /// How to spell a value in this leaf's place.
    fn spelled<'v>(&self, leaf: Span, value: &'v str) -> Cow<'v, str> {
        let _ = leaf;
        Cow::Borrowed(value)
    }

    /// The nodes of the text: render settings, view, ambient light or background and environment, lights, materials,
    /// textures, objects.
    fn nodes(&self) -> Nodes;

    /// A node's name: `view`, `ambient`, `light 2`, `object 3 (box)`.
    fn name(&self, node: Node) -> String;

    /// The nesting depth of a node below other listed nodes.
    fn depth(&self, _: Node) -> usize {
        0
    }

    /// A node's fields with their places. If a node's text breaks off, only fields with all
    /// components are included.
    fn fields(&self, node: Node) -> Vec<FieldSpans>;

    /// A node's whole text, from its first token to its last; empty for a missing view. For a node
    /// in several places, the first.
    fn span(&self, node: Node) -> Span;

    /// The comment on a node: behind its text on the line where that begins, otherwise on the line
    /// where it ends; in `.dat` the line before; in `.xml` behind the start tag or on the line before.
    fn comment(&self, node: Node) -> Option<&str>;

    /// The node whose text contains or touches `span`. A view comment inside another node's text
    /// counts as the view; where it ends at that node's token, the token counts.
    fn node_at(&self, span: Span) -> Option<Node>;

    /// The nodes whose text overlaps `span`, in text order.
    fn nodes_in(&self, span: Span) -> Vec<Node>;

    /// The objects that an object combines, each with its depth below it, from 1; at most `limit`.
    fn parts(&self, object: usize, limit: usize) -> Vec<(usize, Node)> {
        let _ = (object, limit);
        Vec::new()
    }

    /// The word for how an object combines others: `union`. `None` if it does not.
    fn operation(&self, object: usize) -> Option<&str> {
        let _ = object;
        None
    }

    /// Maps an object of the text to its object of the scene; `None` if it is not drawn.
    fn drawn(&self, object: usize) -> Option<u32>;

    /// Whether an object of the text only groups the objects in it.
    fn is_group(&self, _: usize) -> bool {
        false
    }

    /// The group that an object is in, or the first object that combines it.
    fn group_of(&self, object: usize) -> Option<usize> {
        let _ = object;
        None
    }

    /// The objects outside folded ones, ascending: what a folded object holds or combines is not
    /// listed, unless it is drawn by itself or an unfolded object combines it, too.
    fn unfolded(&self, folded: &BTreeSet<usize>) -> Vec<usize> {
        listed::unfolded(self, folded)
    }

    /// Maps an object of the scene to its object of the text.
    fn object(&self, drawn: u32) -> usize;

    /// The listed material of an object.
    fn material(&self, object: usize) -> Option<usize> {
        let _ = object;
        None
    }

    /// The values of a field of a node that refers to nodes of a category, each with the node that it
    /// names: the IDs defined before the node's text, ascending, or all names, in text order, without
    /// duplicates.
    fn references(&self, node: Node, category: Category) -> Vec<(String, Node)> {
        let _ = (node, category);
        Vec::new()
    }

    /// The files named by the text, and by its meshes as far as they were read.
    fn files(&self) -> Vec<NamedFile> {
        Vec::new()
    }

    /// The number of objects that use a material or a texture.
    fn users(&self, _: Node) -> usize {
        0
    }

    /// Returns the edits that remove a render setting from the text, and what states them if no other
    /// is left; none if the text does not state it.
    fn render_removal(&self, key: &str) -> Vec<Edit>;

    /// The fields of the view that belong to the camera, the first of [`SceneText::fields`].
    fn view_fields(&self) -> Vec<&'static Field>;

    /// The values of these fields that describe a camera.
    fn view_numbers(&self, camera: &Camera) -> Numbers;

    /// The camera described by these numbers; `base` is a camera of the same text.
    fn view_camera(&self, numbers: &Numbers, base: &Camera) -> Camera;

    /// Returns the edits that make the text describe this camera, replacing numbers and adding
    /// missing parts. `before` is the camera as lowered; only parts that differ from it are
    /// written, and those whose defaults would move with them.
    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit>;

    /// What opens and closes a comment on a line of its own.
    fn comment_marks(&self) -> [&'static str; 2];

    /// The views saved under a name, in the order of the text.
    fn saved_views(&self) -> Vec<SavedView> {
        saved::views(self)
    }

    /// Returns the edits that save a camera under a name accepted by [`view_name`], replacing any
    /// view of that name; without a camera, those that delete it.
    fn saved_view_edits(&self, name: &str, camera: Option<&Camera>) -> Vec<Edit> {
        saved::edits(self, name, camera)
    }

    /// Returns the edits that show or hide objects, by index, and leave all others as they are.
    ///
    /// # Errors
    ///
    /// Fails with the reason if no text can express that.
    fn visibility_edits(
        &self,
        objects: &[usize],
        wanted: Visibility,
    ) -> Result<Vec<Edit>, &'static str>;
}
