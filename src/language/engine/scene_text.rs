//! What a text of records says: its [`SceneText`].

use std::collections::BTreeSet;

use super::lines::leaves;
use super::motion::Moves;
use super::places::{Place, fields};
use super::reader::name;
use super::{Language, Source};
use crate::field_spans::{self, Wanted};
use crate::memory_estimate::scene_fits;
use crate::node::{FileKind, object_at, place_of};
use crate::rendering::{self, Around};
use crate::schema::{Category, Field, Kind, Makes, Record, Schema};
use crate::view::Numbers;
use crate::{FieldSpans, Lowered, NamedFile, Node, Nodes, SceneText, Visibility};
use geometry::{Affine, Shape};
use memory::OutOfMemory;
use scene::{Camera, Material, Meshes};
use text::{Edit, Span};

/// Estimate of the bytes of a record: itself, its place and its name, in several lists.
const RECORD: usize = 2 * size_of::<Shape>() + 2 * size_of::<Affine>() + size_of::<Material>();

impl<L: Language> SceneText for Source<L>
where
    Self: Moves,
{
    fn lower(&mut self, _: &Meshes) -> Result<Lowered, OutOfMemory> {
        let fits = scene_fits(self.tree.records.len(), "record", RECORD);
        let found = fits.map(|()| L::lower(&self.text, &self.tree));
        self.store(found)
    }

    fn records(&self) -> Option<&'static Schema> {
        Some(L::SCHEMA)
    }

    fn leaves(&self) -> Vec<Span> {
        leaves::<L>(&self.text)
    }

    fn edits(&self, wanted: &[Wanted<'_>]) -> Vec<Edit> {
        let mut edits = field_spans::edits(self, wanted);
        edits.extend(L::insertions(&self.text, wanted));
        Edit::sort(&mut edits);
        edits
    }

    fn nodes(&self) -> Nodes {
        let [lights, materials, textures, objects] =
            Category::ALL.map(|category| self.origins.of(category).len());
        Nodes {
            view: true,
            lights,
            materials,
            textures,
            objects,
            ..Nodes::default()
        }
    }

    fn name(&self, node: Node) -> String {
        match (self.origins.get(node), node.category()) {
            (Some(place), Some((category, index))) => {
                name(place.record, category, (place.id, index)).to_string()
            }
            _ => node.to_string(),
        }
    }

    fn fields(&self, node: Node) -> Vec<FieldSpans> {
        let settings = self.origins.settings.as_ref();
        match node {
            Node::View => self.view_places(),
            Node::Render => {
                let insertion = rendering::insertion(&self.text, settings, "# render:");
                rendering::fields(settings, &L::defaults(&self.origins.own), &insertion, None)
            }
            _ => {
                // An object of many commands has no fields of its own.
                let has_fields = |record: &Record| {
                    record.makes != Makes::State || !matches!(node, Node::Object(_))
                };
                let records = self.origins.records::<L>(node);
                let records = records.filter(|(_, record)| has_fields(record));
                let own = records.flat_map(|record| fields(&self.text, &self.tree, record));
                L::fields(self, node, own.collect())
            }
        }
    }

    fn span(&self, node: Node) -> Span {
        if node == Node::Render {
            return self.origins.settings.unwrap_or_default().whole;
        }
        let first = self.origins.records::<L>(node).next();
        first.map_or_else(|| Span::at(0), |(record, _)| self.tree.span(record))
    }

    fn comment(&self, node: Node) -> Option<&str> {
        self.comment_on(node)
    }

    fn node_at(&self, span: Span) -> Option<Node> {
        let settings = self.origins.settings;
        if settings.is_some_and(|settings| settings.whole.touches(span)) {
            return Some(Node::Render);
        }
        self.tree.at(span).find_map(|at| self.origins.node_of(at))
    }

    fn nodes_in(&self, span: Span) -> Vec<Node> {
        let covers = |part: Span| part.start() < span.end() && span.start() < part.end();
        let settings = self
            .origins
            .settings
            .filter(|settings| covers(settings.whole));
        let records = self.tree.at(span).filter(|&at| covers(self.tree.span(at)));
        let records = records.filter_map(|at| self.origins.node_of(at));
        let mut nodes: Vec<_> = settings
            .map(|_| Node::Render)
            .into_iter()
            .chain(records)
            .collect();
        nodes.dedup();
        nodes
    }

    fn parts(&self, object: usize, limit: usize) -> Vec<(usize, Node)> {
        let mut parts = Vec::new();
        let mut pending = vec![(0, object)];
        while let Some((depth, object)) = pending.pop()
            && parts.len() < limit
        {
            if 0 < depth {
                parts.push((depth, Node::Object(object)));
            }
            let operands: Vec<_> = self.operands(object).collect();
            pending.extend(operands.into_iter().rev().map(|part| (depth + 1, part)));
        }
        parts
    }

    fn operation(&self, object: usize) -> Option<&str> {
        let node = Node::Object(object);
        if !self.origins.get(node)?.record.combines() {
            return None;
        }
        let fields = self.fields(node);
        let is_operator = |placed: &&FieldSpans| matches!(placed.field.kind, Kind::Choice(_));
        let operator = fields.iter().find(is_operator)?;
        Some(operator.spans.first()?.of(&self.text))
    }

    fn group_of(&self, object: usize) -> Option<usize> {
        // Operands precede their use.
        let mut users = object + 1..self.origins.objects().len();
        users.find(|&user| self.operands(user).any(|part| part == object))
    }

    fn unfolded(&self, folded: &BTreeSet<usize>) -> Vec<usize> {
        let count = self.origins.objects().len();
        // Whether it is listed whatever is folded: nothing combines it, or it is drawn by itself.
        let mut is_listed = vec![true; count];
        let parts = (0..count).flat_map(|object| self.operands(object));
        parts.for_each(|part| is_listed[part] = self.drawn(part).is_some());
        for object in (0..count).rev() {
            let shows = is_listed[object] && !folded.contains(&object);
            self.operands(object)
                .for_each(|part| is_listed[part] |= shows);
        }
        (0..count).filter(|&at| is_listed[at]).collect()
    }

    fn references(&self, node: Node, category: Category) -> Vec<(String, Node)> {
        let Some(last) = self.origins.records::<L>(node).map(|(at, _)| at).max() else {
            return Vec::new();
        };
        let given = self.origins.of(category).iter().enumerate();
        let before = given.filter(|(_, place)| place.at < last);
        let mut known: Vec<_> = before.map(|(index, place)| (place.id, index)).collect();
        known.sort_unstable();
        let literal = |(id, index): (i64, usize)| (id.to_string(), Node::of(category, index));
        known.into_iter().map(literal).collect()
    }

    fn files(&self) -> Vec<NamedFile> {
        let textures = 0..self.origins.of(Category::Texture).len();
        let file = |index| {
            let node = Node::Texture(index);
            let fields = self.fields(node);
            let word = fields
                .iter()
                .find(|placed| placed.field.kind == Kind::Word)?;
            let span = *word.spans.first()?;
            Some(NamedFile {
                path: span.of(&self.text).to_owned(),
                kind: FileKind::Picture,
                span,
                what: format!("{} {}", self.name(node), word.field.key),
            })
        };
        textures.filter_map(file).collect()
    }

    fn users(&self, node: Node) -> usize {
        let uses = |place: &&Place| place.references().any(|used| used == node);
        let users = self
            .origins
            .uses
            .iter()
            .filter(uses)
            .filter_map(Place::user);
        let users: BTreeSet<_> = users.filter(|user| *user != node).collect();
        let own = match node {
            Node::Material(_) => self.origins.objects().iter().filter(uses).count(),
            _ => 0,
        };
        own + users
            .into_iter()
            .map(|user| self.users(user))
            .sum::<usize>()
    }

    fn drawn(&self, object: usize) -> Option<u32> {
        place_of(&self.origins.drawn, object)
    }

    fn object(&self, drawn: u32) -> usize {
        object_at(&self.origins.drawn, drawn)
    }

    fn material(&self, object: usize) -> Option<usize> {
        let place = self.origins.objects().get(object)?;
        place.of(Category::Material).next()
    }

    fn is_comment(&self, leaf: Span) -> bool {
        self.tree.at(leaf).is_empty()
    }

    fn comment_marks(&self) -> [&'static str; 2] {
        [L::COMMENTS[0], ""]
    }

    fn visibility_edits(
        &self,
        objects: &[usize],
        wanted: Visibility,
    ) -> Result<Vec<Edit>, &'static str> {
        self.shown_or_hidden(objects, wanted)
    }

    fn render_removal(&self, key: &str) -> Vec<Edit> {
        let settings = self.origins.settings.as_ref();
        let removed = settings.and_then(|place| place.removal(&self.text, key, Around::Line));
        removed.into_iter().collect()
    }

    fn view_fields(&self) -> Vec<&'static Field> {
        L::SCHEMA.view().flat_map(Record::fields).collect()
    }

    fn view_numbers(&self, camera: &Camera) -> Numbers {
        L::view_numbers(self, camera)
    }

    fn view_camera(&self, numbers: &Numbers, base: &Camera) -> Camera {
        L::view_camera(self, numbers, base)
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        self.camera_edits(before, camera)
    }
}

impl<L: Language> Source<L> {
    /// The objects that an object combines.
    pub(crate) fn operands(&self, object: usize) -> impl Iterator<Item = usize> + use<L> {
        let place = self.origins.objects().get(object).copied();
        place
            .into_iter()
            .flat_map(|place| place.of(Category::Object))
    }
}
