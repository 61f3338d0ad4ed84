//! `.test` of UCSD CSE 167, Berkeley CS 184 and edX: a command a line, which changes a state that
//! spheres, triangles and lights catch.

mod add;
mod lower;
mod material;
mod motion;
// One slot per row.
#[rustfmt::skip]
mod schema;
#[cfg(test)]
mod tests;
mod view;
mod write;

use crate::engine::lines::Lines;
use crate::engine::places::Places;
use crate::engine::{self, Language};
use crate::field_spans::{FieldSpans, Wanted};
use crate::memory_estimate::{Counts, each};
use crate::schema::{Category, Record, Schema};
use crate::structure::{Addition, NewNode, Placement};
use crate::view::{Numbers, line_ending};
use crate::written::Parse;
use crate::{Lowered, Node, StructureError};
use glam::DVec3;
use lower::Own;
use scene::{Camera, Rendering};
use schema::SCHEMA;
use text::{Edit, Findings, Span};

pub(super) use write::write;

/// A `.test` text.
pub(super) type Source = engine::Source<Cse167>;

/// Whether no leaf crosses a line end.
pub(super) const LEAVES_KEEP_TO_LINES: bool = true;

/// Whether changed objects can be lowered alone.
pub(super) const LOWERS_CHANGES: bool = false;

/// The axis that points up in most of its scenes.
pub(super) const VERTICAL: DVec3 = DVec3::Y;

/// A small valid scene to begin with.
pub(super) const TEMPLATE: &str = include_str!("template.test");

/// A minimal valid scene to put a first thing into.
pub(super) const SKELETON: &str = include_str!("skeleton.test");

/// Returns the errors of every text with this beginning.
pub(super) fn errors_of_beginning(beginning: &str) -> Findings {
    lower::errors_of_beginning(beginning, &Lines::parse(beginning))
}

/// Estimates the bytes needed to build a tree with these counts.
pub(super) fn tree_bytes(counts: &Counts) -> u64 {
    each(counts.lines + 1, 2 * size_of::<Span>())
}

/// The language.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Cse167;

impl Language for Cse167 {
    const SCHEMA: &'static Schema = &SCHEMA;
    const COMMENTS: &'static [&'static str] = &["#"];
    const COMMENTS_BEHIND: bool = true;
    const ADDITIONS: &'static [Addition] = add::ADDITIONS;
    type Own = Own;

    fn defaults(own: &Own) -> Rendering {
        own.rendering
    }

    fn lower(text: &str, lines: &Lines<Self>) -> (Places<Own>, Lowered) {
        lower::lower(text, lines)
    }

    fn fields(source: &Source, node: Node, own: Vec<FieldSpans>) -> Vec<FieldSpans> {
        source.with_inherited(node, own)
    }

    fn insertions(text: &str, wanted: &[Wanted<'_>]) -> Vec<Edit> {
        material::insertions(text, wanted)
    }

    fn view_numbers(_: &Source, camera: &Camera) -> Numbers {
        view::VIEW.numbers(camera, &view::DEFAULT)
    }

    fn view_camera(_: &Source, numbers: &Numbers, _: &Camera) -> Camera {
        view::VIEW.camera(numbers)
    }

    fn follows_lens(record: &Record) -> bool {
        *record == schema::CAMERA
    }

    fn addition(
        source: &Source,
        name: &str,
        wish: &NewNode<'_>,
    ) -> Result<Placement, StructureError> {
        add::addition(source, name, wish)
    }

    fn plain(_: Category, _: i64) -> Option<String> {
        None
    }

    fn is_movable(node: Node) -> bool {
        // A state line may be part of several materials.
        !matches!(node, Node::Material(_))
    }

    fn records_of(source: &Source, object: usize) -> Vec<usize> {
        source.commands(object)
    }

    fn as_copy(text: String) -> String {
        let is_triangle = |line: &str| {
            let word = line.split_whitespace().next().unwrap_or_default();
            word.to_ascii_lowercase().starts_with("tri")
        };
        if !text.lines().next().is_some_and(is_triangle) {
            return text;
        }
        // Otherwise they would join the mesh before them.
        let end = line_ending(&text);
        let indent = &text[..text.len() - text.trim_start().len()];
        format!(
            "{indent}{}{end}{text}{end}{indent}{}",
            schema::PUSH.name,
            schema::POP.name
        )
    }

    fn goes_with(source: &Source, object: usize) -> Vec<usize> {
        source.own_values(object)
    }

    fn check_exchange(source: &Source, nodes: [Node; 2]) -> Result<(), StructureError> {
        source.check_exchange(nodes)
    }

    fn kinds(_: &Source, node: Node) -> Vec<&'static str> {
        match node {
            Node::Light(_) => vec![schema::POINT.name, schema::DIRECTIONAL.name],
            _ => Vec::new(),
        }
    }

    fn light_as(source: &Source, light: Node, kind: &str) -> Vec<Edit> {
        source.light_as(light, kind)
    }
}
