//! Boston University's `.dat`: one record per line, with numeric IDs.

mod add;
mod lower;
mod quadric;
// One slot per row.
#[rustfmt::skip]
mod schema;
#[cfg(test)]
mod tests;
mod view;
mod write;

use crate::engine::lines::Lines;
use crate::engine::motion::Moves;
use crate::engine::places::Places;
use crate::engine::{self, Language};
use crate::form::Form;
use crate::memory_estimate::{Counts, each};
use crate::schema::{Category, Field, Part, Record, Schema};
use crate::structure::{Addition, NewNode, Placement, Pose};
use crate::view::Numbers;
use crate::written::Parse;
use crate::{FieldSpans, Lowered, Motion, Node, SceneText, StructureError};
use glam::DVec3;
use scene::Camera;
use schema::{LightKind, SCHEMA, SOURCES};
use text::{Edit, Findings, Span};

pub(super) use write::write;

/// A `.dat` text.
pub(super) type Source = engine::Source<Dat>;

/// Whether no leaf crosses a line end.
pub(super) const LEAVES_KEEP_TO_LINES: bool = true;

/// Whether changed objects can be lowered alone.
pub(super) const LOWERS_CHANGES: bool = false;

/// The axis that points up in most of its scenes.
pub(super) const VERTICAL: DVec3 = DVec3::Z;

/// A small valid scene to begin with.
pub(super) const TEMPLATE: &str = include_str!("template.dat");

/// A minimal valid scene to put a first thing into.
pub(super) const SKELETON: &str = include_str!("skeleton.dat");

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
pub(crate) struct Dat;

/// The picture in the world: stated or by default.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Film {
    /// World units per pixel, across and up.
    resolution: [f64; 2],
    /// The distance from the eye to the image plane.
    focal: f64,
}

impl Language for Dat {
    const SCHEMA: &'static Schema = &SCHEMA;
    const COMMENTS: &'static [&'static str] = &["#", "//"];
    const COMMENTS_BEHIND: bool = false;
    const ADDITIONS: &'static [Addition] = add::ADDITIONS;
    type Own = Film;

    fn lower(text: &str, lines: &Lines<Self>) -> (Places<Film>, Lowered) {
        lower::lower(text, lines)
    }

    fn view_numbers(source: &Source, camera: &Camera) -> Numbers {
        view::numbers(camera, &source.origins.own)
    }

    fn view_camera(source: &Source, numbers: &Numbers, base: &Camera) -> Camera {
        view::camera(numbers, base, &source.origins.own)
    }

    fn follows_lens(record: &Record) -> bool {
        *record == schema::RESOLUTION
    }

    fn addition(
        source: &Source,
        name: &str,
        wish: &NewNode<'_>,
    ) -> Result<Placement, StructureError> {
        add::addition(source, name, wish)
    }

    fn plain(category: Category, id: i64) -> Option<String> {
        add::plain(category, id)
    }

    fn kinds(source: &Source, node: Node) -> Vec<&'static str> {
        match node {
            Node::Object(object) if source.operation(object).is_none() => {
                let solids = SCHEMA.solids().map(|record| record.name);
                solids.chain([schema::QUADRIC.name]).collect()
            }
            Node::Light(_) => SOURCES.map(|(word, _)| word).into(),
            _ => Vec::new(),
        }
    }

    fn light_as(source: &Source, light: Node, kind: &str) -> Vec<Edit> {
        add::light_as(source, light, kind)
    }
}

impl Moves for Source {
    fn schema(&self) -> &'static Schema {
        &SCHEMA
    }

    fn object_record(&self, object: usize) -> Option<&'static Record> {
        Some(self.origins.objects().get(object)?.record)
    }

    fn general(&self) -> Option<&'static str> {
        Some(schema::QUADRIC.name)
    }

    fn part_of_light(&self, fields: &[FieldSpans], field: &Field) -> Part {
        let word = fields.first().and_then(|placed| placed.spans.first());
        let word = word.map_or("", |word| word.of(&self.text));
        let kind = SOURCES.iter().find(|(known, _)| *known == word);
        let is_zero = |key| {
            let mut placed = fields.iter().filter(|placed| placed.field.key == key);
            placed.all(|placed| self.vector(placed) == Some(DVec3::ZERO))
        };
        match (kind.map(|(_, kind)| *kind), field.key) {
            // Then it shines from its position.
            (Some(LightKind::Distant), "position") if is_zero("direction") => Part::Direction,
            (Some(LightKind::Distant), "position") | (Some(LightKind::Ambient) | None, _) => {
                Part::None
            }
            _ => field.part,
        }
    }

    fn respelled(
        &self,
        object: usize,
        kind: &str,
        form: &Form,
    ) -> Result<Vec<Edit>, StructureError> {
        add::respelled(self, object, kind, form)
    }

    fn other_pose(&self, record: &Record, numbers: &[f64]) -> Option<Pose> {
        if *record != schema::QUADRIC {
            return None;
        }
        quadric::pose(numbers)
    }

    fn other_moved(&self, record: &Record, numbers: &[f64], motion: &Motion) -> Option<Vec<f64>> {
        (*record == schema::QUADRIC).then(|| quadric::moved(numbers, motion))
    }
}
