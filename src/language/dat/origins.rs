//! The places of the nodes of a `.dat` text: each in one record, and further records for the uses
//! of textures by materials.

use super::table::{HALF_SPACE, ObjectKind, Part, RecordKind};
use super::tree::Tree;
use crate::field_spans::FieldSpans;
use crate::node::Node;
use crate::rendering::{self, RenderPlace};
use crate::view::{beginning, line_ending};
use crate::words::Words;
use scene::Rendering;

/// The places of everything lowered, as record indices: valid only with the tree they were made
/// from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// The records of the view: camera, resolution, viewport.
    pub(super) view: [Option<usize>; 3],
    /// The comment of the render settings.
    pub(super) settings: Option<RenderPlace>,
    pub(super) lights: Vec<Place>,
    pub(super) materials: Vec<Place>,
    pub(super) textures: Vec<Place>,
    pub(super) objects: Vec<ObjectPlace>,
    /// The uses of textures by materials, each place once.
    pub(super) uses: Vec<UsePlace>,
    /// The `render` record.
    pub(super) render: Option<usize>,
    /// The drawn objects, ascending: those of the scene.
    pub(super) drawn: Vec<usize>,
    /// World units per pixel, across and up, stated or by default.
    pub(super) resolution: [f64; 2],
    /// The distance from the eye to the image plane, stated or by default.
    pub(super) focal: f64,
}

/// The place of a light, a material or a texture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Index of its record.
    pub(super) record: usize,
    pub(super) kind: RecordKind,
    pub(super) id: i64,
}

/// The place of an object.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectPlace {
    /// Index of its record.
    pub(super) record: usize,
    pub(super) kind: ObjectKind,
    pub(super) id: i64,
    /// Indices of the objects it combines, which precede it.
    pub(super) operands: Option<[usize; 2]>,
    /// Index of its material.
    pub(super) material: Option<usize>,
    /// Number of half-spaces that clip it.
    pub(super) cuts: usize,
}

/// A record by which a material uses a texture.
#[derive(Clone, Copy, Debug)]
pub(super) struct UsePlace {
    pub(super) record: usize,
    pub(super) kind: RecordKind,
    /// Index of the material.
    pub(super) material: usize,
    /// Index of the texture.
    pub(super) texture: usize,
}

/// The kinds of records of the view, in the order of [`Origins::view`].
pub(super) const VIEW: [RecordKind; 3] = [
    RecordKind::Camera,
    RecordKind::Resolution,
    RecordKind::Viewport,
];

impl Origins {
    /// The records of a node, with their kinds.
    pub(super) fn records(&self, node: Node) -> impl Iterator<Item = (usize, RecordKind)> + '_ {
        let own = |places: &[Place], index: usize| {
            places.get(index).map(|place| (place.record, place.kind))
        };
        let first = match node {
            Node::View | Node::Render | Node::Ambient | Node::Background | Node::Environment => {
                None
            }
            Node::Light(index) => own(&self.lights, index),
            Node::Material(index) => own(&self.materials, index),
            Node::Texture(index) => own(&self.textures, index),
            Node::Object(index) => {
                let object = self.objects.get(index);
                object.map(|object| (object.record, RecordKind::Object(object.kind)))
            }
        };
        let view = self.view.iter().zip(VIEW);
        let view = view.filter_map(|(record, kind)| Some(((*record)?, kind)));
        let view = view.filter(move |_| node == Node::View);
        let uses = self.uses.iter();
        let uses = uses.filter(move |at| node == Node::Material(at.material));
        first
            .into_iter()
            .chain(view)
            .chain(uses.map(|at| (at.record, at.kind)))
    }

    /// All fields of the view, without places if their record is missing.
    pub(super) fn view_fields(&self, text: &str, tree: &Tree) -> Vec<FieldSpans> {
        self.view
            .iter()
            .zip(VIEW)
            .flat_map(|(record, kind)| match record {
                Some(record) => place(tree.tokens_of(text, *record), kind, 0),
                None => kind
                    .fields()
                    .map(|field| FieldSpans::explicit(field, Vec::new()))
                    .collect(),
            })
            .collect()
    }

    pub(super) fn render_fields(&self, text: &str) -> Vec<FieldSpans> {
        let settings = self.settings.as_ref();
        let (start, ending) = (beginning(text), line_ending(text));
        let insertion = rendering::insertion(settings, start, "# render:", ending);
        rendering::fields(settings, &Rendering::default(), &insertion, None)
    }

    pub(super) fn node_of(&self, record: usize) -> Option<Node> {
        if self.view.contains(&Some(record)) {
            return Some(Node::View);
        }
        let among = |places: &[Place]| places.binary_search_by_key(&record, |at| at.record).ok();
        let object = || {
            self.objects
                .binary_search_by_key(&record, |at| at.record)
                .ok()
        };
        let used = || {
            let found = self.uses.iter().find(|at| at.record == record);
            found.map(|at| Node::Material(at.material))
        };
        among(&self.lights)
            .map(Node::Light)
            .or_else(|| among(&self.materials).map(Node::Material))
            .or_else(|| among(&self.textures).map(Node::Texture))
            .or_else(|| object().map(Node::Object))
            .or_else(used)
    }
}

/// Distributes the tokens of a record to its fields, until one is incomplete. A quadric has `cuts`
/// half-spaces.
pub(super) fn place(tokens: Words<'_>, kind: RecordKind, cuts: usize) -> Vec<FieldSpans> {
    let mut rest = tokens.skip(kind.heads());
    let mut placed = Vec::new();
    for part in kind.parts() {
        let spans: Vec<_> = rest.by_ref().take(part.tokens()).collect();
        if spans.len() < part.tokens() {
            return placed;
        }
        if let Part::Field(field) = part {
            placed.push(FieldSpans::explicit(field, spans));
        }
    }
    if kind == RecordKind::Object(ObjectKind::Quadric) {
        // The half-spaces follow their count.
        let mut rest = rest.skip(1);
        let cuts = (0..cuts).map(|_| rest.by_ref().take(HALF_SPACE.kind.components()).collect());
        placed.extend(cuts.map(|spans| FieldSpans::explicit(HALF_SPACE, spans)));
    }
    placed
}
