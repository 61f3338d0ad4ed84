//! Where the things of a `.dat` text stand: each in a record of its own, and what textures do to a
//! material in further ones.

use super::table::{HALF_SPACE, ObjectKind, Part, RecordKind};
use super::tree::Tree;
use crate::language::node::{FileKind, NamedFile};
use crate::language::node::{Node, Nodes};
use crate::language::placed::Placed;
use crate::language::table::{Category, Kind, numbers};
use crate::text::{Span, is_one_line_end};

/// Where everything that was lowered stands. It holds indices of records: ask it only with the tree
/// it was made from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    /// The records that say the view: camera, resolution, viewport.
    pub(super) view: [Option<usize>; 3],
    pub(super) lights: Vec<Place>,
    pub(super) materials: Vec<Place>,
    pub(super) textures: Vec<Place>,
    pub(super) objects: Vec<ObjectPlace>,
    /// What textures do to materials, each place once.
    pub(super) uses: Vec<UsePlace>,
    /// The record that lists what is drawn.
    pub(super) render: Option<usize>,
    /// The objects that are drawn, ascending: those of the scene.
    pub(super) drawn: Vec<usize>,
    /// World units per pixel, across and up, as said or by default.
    pub(super) resolution: [f64; 2],
    /// From the eye to the image plane, as said or by default.
    pub(super) focal: f64,
}

/// Where a light, a material or a texture stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    /// Index of its record.
    pub(super) record: usize,
    pub(super) kind: RecordKind,
    pub(super) id: i64,
}

/// Where an object stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectPlace {
    /// Index of its record.
    pub(super) record: usize,
    pub(super) kind: ObjectKind,
    pub(super) id: i64,
    /// The objects it combines, by index, which are below its own.
    pub(super) operands: Option<[usize; 2]>,
    /// Its material, by index.
    pub(super) material: Option<usize>,
    /// How many half-spaces cut it.
    pub(super) cuts: usize,
}

/// A record that says what a texture does to a material.
#[derive(Clone, Copy, Debug)]
pub(super) struct UsePlace {
    pub(super) record: usize,
    pub(super) kind: RecordKind,
    /// By index.
    pub(super) material: usize,
    /// By index.
    pub(super) texture: usize,
}

/// The kinds of record that say the view, in the order of [`Origins::view`].
pub(super) const VIEW: [RecordKind; 3] = [
    RecordKind::Camera,
    RecordKind::Resolution,
    RecordKind::Viewport,
];

impl Origins {
    pub(super) fn nodes(&self) -> Nodes {
        Nodes {
            view: true,
            lights: self.lights.len(),
            materials: self.materials.len(),
            textures: self.textures.len(),
            objects: self.objects.len(),
            ..Nodes::default()
        }
    }

    pub(super) fn name(&self, node: Node) -> String {
        let id = |places: &[Place], index: usize| {
            places
                .get(index)
                .map_or_else(|| "?".to_owned(), |at| at.id.to_string())
        };
        match node {
            Node::View => "view".to_owned(),
            Node::Ambient => "ambient".to_owned(),
            Node::Background => "background".to_owned(),
            Node::Environment => "environment".to_owned(),
            Node::Light(index) => format!("light {}", id(&self.lights, index)),
            Node::Material(index) => format!("material {}", id(&self.materials, index)),
            Node::Texture(index) => format!("texture {}", id(&self.textures, index)),
            Node::Object(index) => match self.objects.get(index) {
                Some(object) => format!("object {} ({})", object.id, object.kind.keyword()),
                None => "object ?".to_owned(),
            },
        }
    }

    pub(super) fn fields(&self, tree: &Tree, node: Node) -> Vec<Placed> {
        if node == Node::View {
            return self.view_fields(tree);
        }
        let cuts = match node {
            Node::Object(index) => self.objects.get(index).map_or(0, |object| object.cuts),
            _ => 0,
        };
        self.records(node)
            .flat_map(|(record, kind)| {
                let tokens = tree.tokens_of(record).get(kind.heads()..);
                place(tokens.unwrap_or_default(), kind, cuts)
            })
            .collect()
    }

    pub(super) fn span(&self, tree: &Tree, node: Node) -> Span {
        let first = self.records(node).next();
        first.map_or_else(|| Span::at(0), |(record, _)| tree.span_of(record))
    }

    pub(super) fn comment<'t>(&self, text: &'t str, tree: &Tree, node: Node) -> Option<&'t str> {
        let own = self.span(tree, node);
        let next = tree.comments.partition_point(|c| c.start() < own.start());
        let comment = tree.comments.get(next.checked_sub(1)?)?;
        let between = text[comment.end()..own.start()].trim_matches([' ', '\t']);
        let said = comment.of(text).trim_start_matches(['#', '/']).trim();
        (is_one_line_end(between) && !said.is_empty() && node != Node::View).then_some(said)
    }

    pub(super) fn node_at(&self, tree: &Tree, span: Span) -> Option<Node> {
        tree.records_at(span).find_map(|at| self.node_of(at))
    }

    pub(super) fn nodes_in(&self, tree: &Tree, span: Span) -> Vec<Node> {
        let covered = |&at: &usize| {
            let record = tree.span_of(at);
            record.start() < span.end() && span.start() < record.end()
        };
        let records = tree.records_at(span).filter(covered);
        let mut nodes: Vec<_> = records.filter_map(|at| self.node_of(at)).collect();
        nodes.dedup();
        nodes
    }

    pub(super) fn parts(&self, object: usize, limit: usize) -> Vec<(usize, Node)> {
        let mut parts = Vec::new();
        let mut pending = vec![(0, object)];
        while let Some((depth, object)) = pending.pop() {
            if parts.len() == limit {
                break;
            }
            parts.push((depth, Node::Object(object)));
            let operands = self.objects.get(object).and_then(|object| object.operands);
            if let Some([first, second]) = operands {
                pending.extend([(depth + 1, second), (depth + 1, first)]);
            }
        }
        parts
    }

    /// The word by which an object combines others.
    pub(super) fn operation(&self, tree: &Tree, object: usize) -> Option<Span> {
        let kind = self.objects.get(object)?.kind;
        let fields = self.fields(tree, Node::Object(object));
        let word = fields.first().filter(|_| kind == ObjectKind::Csg)?;
        word.spans.first().copied()
    }

    pub(super) fn identities(&self, node: Node, category: Category) -> Vec<i64> {
        let records = self.records(node).map(|(record, _)| record);
        let Some(record) = records.max() else {
            return Vec::new();
        };
        let of = |places: &[Place]| places.iter().map(|at| (at.record, at.id)).collect();
        let given: Vec<_> = match category {
            Category::Light => of(&self.lights),
            Category::Material => of(&self.materials),
            Category::Texture => of(&self.textures),
            Category::Object => self.objects.iter().map(|at| (at.record, at.id)).collect(),
        };
        let before = given.into_iter().filter(|&(at, _)| at < record);
        let mut identities: Vec<_> = before.map(|(_, id)| id).collect();
        identities.sort_unstable();
        identities
    }

    pub(super) fn files(&self, text: &str, tree: &Tree) -> Vec<NamedFile> {
        let places = self.textures.iter().enumerate();
        let file = |(index, at): (usize, &Place)| {
            let tokens = tree.tokens_of(at.record).get(at.kind.heads()..)?;
            let fields = place(tokens, at.kind, 0);
            let word = fields.iter().find(|said| said.field.kind == Kind::Word)?;
            let span = *word.spans.first()?;
            Some(NamedFile {
                path: span.of(text).to_owned(),
                kind: FileKind::Picture,
                span,
                what: format!("{} {}", self.name(Node::Texture(index)), word.field.key),
            })
        };
        places.filter_map(file).collect()
    }

    pub(super) fn users(&self, node: Node) -> usize {
        let of_material = |material: usize| {
            let uses = |object: &&ObjectPlace| object.material == Some(material);
            self.objects.iter().filter(uses).count()
        };
        match node {
            Node::Material(material) => of_material(material),
            Node::Texture(texture) => {
                let uses = self.uses.iter().filter(|at| at.texture == texture);
                let mut materials: Vec<_> = uses.map(|at| at.material).collect();
                materials.sort_unstable();
                materials.dedup();
                materials.into_iter().map(of_material).sum()
            }
            _ => 0,
        }
    }

    /// The records of a node, with what they are.
    fn records(&self, node: Node) -> impl Iterator<Item = (usize, RecordKind)> + '_ {
        let own = |places: &[Place], index: usize| {
            places.get(index).map(|place| (place.record, place.kind))
        };
        let first = match node {
            Node::View | Node::Ambient | Node::Background | Node::Environment => None,
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

    /// All fields of the view, without places where their record is missing.
    fn view_fields(&self, tree: &Tree) -> Vec<Placed> {
        self.view
            .iter()
            .zip(VIEW)
            .flat_map(|(record, kind)| match record {
                Some(record) => {
                    let tokens = tree.tokens_of(*record).get(1..);
                    place(tokens.unwrap_or_default(), kind, 0)
                }
                None => kind
                    .fields()
                    .map(|field| Placed::said(field, Vec::new()))
                    .collect(),
            })
            .collect()
    }

    fn node_of(&self, record: usize) -> Option<Node> {
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

/// Hands out the tokens of a record to its fields, until one is not complete. A quadric has `cuts`
/// half-spaces.
fn place(tokens: &[Span], kind: RecordKind, cuts: usize) -> Vec<Placed> {
    let mut rest = tokens;
    let mut placed = Vec::new();
    for part in kind.parts() {
        let Some((spans, after)) = rest.split_at_checked(part.tokens()) else {
            return placed;
        };
        rest = after;
        if let Part::Field(field) = part {
            placed.push(Placed::said(field, spans.to_vec()));
        }
    }
    if kind == RecordKind::Object(ObjectKind::Quadric) {
        // The number of half-spaces stands before them.
        let each = numbers(&[*HALF_SPACE]);
        let spans = rest.get(1..).unwrap_or_default().chunks_exact(each);
        placed.extend(
            spans
                .take(cuts)
                .map(|spans| Placed::said(HALF_SPACE, spans.to_vec())),
        );
    }
    placed
}
