//! What is written once for all languages of records, from their tables: reading with its diagnostics,
//! the places of fields, and every edit.
//!
//! The engine stores no tree of its own. It asks where the records of a node begin and where their
//! slots are; [`Source`] answers for languages with one record a line.

pub(crate) mod comments;
mod copies;
pub(crate) mod identities;
pub(crate) mod lines;
pub(crate) mod listing;
pub(crate) mod motion;
pub(crate) mod places;
pub(crate) mod reader;
mod scene_text;
mod structure;
pub(crate) mod view;
mod wording;

use std::fmt::Debug;

use crate::field_spans::{FieldSpans, Wanted};
use crate::node::Node;
use crate::rendering;
use crate::schema::{Category, Record, Schema};
use crate::structure::{Addition, NewNode, Placement};
use crate::view::Numbers;
use crate::written::Written;
use crate::{Lowered, StructureError};
use lines::Lines;
use places::Places;
use scene::{Camera, Rendering};
use text::Edit;

/// A text with one record a line.
pub(crate) type Source<L> = Written<Lines<L>, Places<<L as Language>::Own>>;

/// A language with one record a line: what the engine cannot know from its table.
pub(crate) trait Language: Clone + Copy + Debug + Default + Send + Sync + 'static {
    /// Its records.
    const SCHEMA: &'static Schema;

    /// What begins a comment, the usual mark first.
    const COMMENTS: &'static [&'static str];

    /// Whether a comment can begin behind a record.
    const COMMENTS_BEHIND: bool;

    /// The kinds of things that can be added.
    const ADDITIONS: &'static [Addition];

    /// What a text says besides its nodes.
    type Own: Clone + Debug + Default + Send + Sync;

    /// The render settings that hold where the text's own say nothing.
    fn defaults(own: &Self::Own) -> Rendering {
        let _ = own;
        Rendering::default()
    }

    /// The fields of a node, given those in its own records.
    fn fields(source: &Source<Self>, node: Node, own: Vec<FieldSpans>) -> Vec<FieldSpans> {
        let _ = (source, node);
        own
    }

    /// Returns the edits that insert these values where the text omits them.
    fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
        rendering::insertions(text, wanted)
    }

    /// Lowers a text and finds the places of its nodes.
    fn lower(text: &str, lines: &Lines<Self>) -> (Places<Self::Own>, Lowered);

    /// The values of the view's fields that describe a camera.
    fn view_numbers(source: &Source<Self>, camera: &Camera) -> Numbers;

    /// The camera described by these numbers; `base` is a camera of the same text.
    fn view_camera(source: &Source<Self>, numbers: &Numbers, base: &Camera) -> Camera;

    /// Whether the default of a missing record of the view moves with the lens, so that it must be written
    /// with that.
    fn follows_lens(record: &Record) -> bool;

    /// Returns the edits that add a thing.
    fn addition(
        source: &Source<Self>,
        name: &str,
        wish: &NewNode<'_>,
    ) -> Result<Placement, StructureError>;

    /// Whether a node can be deleted, copied and moved.
    fn is_movable(node: Node) -> bool {
        let _ = node;
        true
    }

    /// The records of an object, in order.
    fn records_of(source: &Source<Self>, object: usize) -> Vec<usize> {
        let place = source.origins.objects().get(object);
        place.map(|place| place.at).into_iter().collect()
    }

    /// The records that affect an object alone, and are deleted with it.
    fn goes_with(source: &Source<Self>, object: usize) -> Vec<usize> {
        let _ = (source, object);
        Vec::new()
    }

    /// A copied text as it is to be inserted.
    fn as_copy(text: String) -> String {
        text
    }

    /// Fails if two nodes cannot exchange places, the first of which precedes the second.
    fn check_exchange(source: &Source<Self>, nodes: [Node; 2]) -> Result<(), StructureError> {
        let _ = (source, nodes);
        Ok(())
    }

    /// The record of a plain node with an ID; `None` if a category has none.
    fn plain(category: Category, id: i64) -> Option<String>;

    /// The words for the kinds that a node can be changed to; empty if there is no choice.
    fn kinds(source: &Source<Self>, node: Node) -> Vec<&'static str>;

    /// Returns the edits that change a light to another kind.
    fn light_as(source: &Source<Self>, light: Node, kind: &str) -> Vec<Edit>;
}
