//! What a `.dat` text says: its [`SceneText`].

use std::collections::BTreeSet;

use super::origins::{ObjectPlace, Place, place};
use super::table::OPERATIONS;
use super::tree::{is_comment, leaves};
use super::{Source, lower, memory_estimate, view, visibility};
use crate::node::{FileKind, object_at, place_of};
use crate::rendering::Around;
use crate::report::Name;
use crate::slot::words;
use crate::table::{Category, Field, Kind};
use crate::view::Numbers;
use crate::words::skip_white_space;
use crate::{FieldSpans, Lowered, NamedFile, Node, Nodes, SceneText, Visibility};
use memory::OutOfMemory;
use scene::{Camera, Meshes};
use text::{Edit, Span, line_start};

impl SceneText for Source {
    fn lower(&mut self, _: &Meshes) -> Result<Lowered, OutOfMemory> {
        let fits = memory_estimate::fits(&self.tree);
        let found = fits.map(|()| lower::lower(&self.text, &self.tree));
        self.store(found)
    }

    fn leaves(&self) -> Vec<Span> {
        leaves(&self.text)
    }

    fn nodes(&self) -> Nodes {
        Nodes {
            view: true,
            lights: self.origins.lights.len(),
            materials: self.origins.materials.len(),
            textures: self.origins.textures.len(),
            objects: self.origins.objects.len(),
            ..Nodes::default()
        }
    }

    fn name(&self, node: Node) -> String {
        let named = |category: Category, places: &[Place], index: usize| {
            let id = places.get(index)?.id;
            Some(Name::Known(category.word(), id, ""))
        };
        let name = match node {
            Node::Light(index) => named(Category::Light, &self.origins.lights, index),
            Node::Material(index) => named(Category::Material, &self.origins.materials, index),
            Node::Texture(index) => named(Category::Texture, &self.origins.textures, index),
            Node::Object(index) => self.origins.objects.get(index).map(|object| {
                let kind = object.kind.keyword();
                Name::Known(Category::Object.word(), object.id, kind)
            }),
            Node::View | Node::Render | Node::Ambient | Node::Background | Node::Environment => {
                None
            }
        };
        name.map_or_else(|| node.to_string(), |name| name.to_string())
    }

    fn fields(&self, node: Node) -> Vec<FieldSpans> {
        match node {
            Node::View => return self.origins.view_fields(&self.text, &self.tree),
            Node::Render => return self.origins.render_fields(&self.text),
            _ => {}
        }
        let cuts = match node {
            Node::Object(index) => self
                .origins
                .objects
                .get(index)
                .map_or(0, |object| object.cuts),
            _ => 0,
        };
        self.origins
            .records(node)
            .flat_map(|(record, kind)| place(self.tree.tokens_of(&self.text, record), kind, cuts))
            .collect()
    }

    fn span(&self, node: Node) -> Span {
        if node == Node::Render {
            let settings = self.origins.settings.as_ref();
            return settings.map_or_else(|| Span::at(0), |settings| settings.whole);
        }
        let first = self.origins.records(node).next();
        first.map_or_else(|| Span::at(0), |(record, _)| self.tree.span_of(record))
    }

    fn comment(&self, node: Node) -> Option<&str> {
        let own = self.span(node);
        let before = self.text[..own.start()].trim_end_matches([' ', '\t']);
        let line = line_start(before, before.len().checked_sub(1)?);
        let start = skip_white_space(before.as_bytes(), line);
        let line = before[start..].trim_end();
        let content = line.trim_start_matches(['#', '/']).trim();
        let is_label = is_comment(line) && !content.is_empty();
        let has_label = is_label && !self.is_settings(start);
        (has_label && !matches!(node, Node::View | Node::Render)).then_some(content)
    }

    fn node_at(&self, span: Span) -> Option<Node> {
        let settings = self.origins.settings.as_ref();
        if settings.is_some_and(|settings| settings.whole.touches(span)) {
            return Some(Node::Render);
        }
        self.tree
            .records_at(span)
            .find_map(|at| self.origins.node_of(at))
    }

    fn nodes_in(&self, span: Span) -> Vec<Node> {
        let covered = |&at: &usize| {
            let record = self.tree.span_of(at);
            record.start() < span.end() && span.start() < record.end()
        };
        let records = self.tree.records_at(span).filter(covered);
        let settings = self.origins.settings.as_ref();
        let settings = settings.filter(|settings| {
            settings.whole.start() < span.end() && span.start() < settings.whole.end()
        });
        let mut nodes: Vec<_> = settings.map(|_| Node::Render).into_iter().collect();
        nodes.extend(records.filter_map(|at| self.origins.node_of(at)));
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
            let operands = self
                .origins
                .objects
                .get(object)
                .and_then(|object| object.operands);
            if let Some([first, second]) = operands {
                pending.extend([(depth + 1, second), (depth + 1, first)]);
            }
        }
        parts
    }

    fn operation(&self, object: usize) -> Option<&str> {
        let fields = self.fields(Node::Object(object));
        let operator = Kind::Choice(const { &words(&OPERATIONS) });
        let is_operator = |placed: &&FieldSpans| placed.field.kind == operator;
        let operator = fields.iter().find(is_operator)?;
        Some(operator.spans.first()?.of(&self.text))
    }

    fn group_of(&self, object: usize) -> Option<usize> {
        let combines = |at: &ObjectPlace| at.operands.is_some_and(|parts| parts.contains(&object));
        let objects = self.origins.objects.iter();
        // Operands precede their use.
        let mut users = objects.enumerate().skip(object + 1);
        users.find_map(|(index, at)| combines(at).then_some(index))
    }

    fn unfolded(&self, folded: &BTreeSet<usize>) -> Vec<usize> {
        let objects = &self.origins.objects;
        // Whether it is listed whatever is folded: nothing combines it, or it is drawn by itself.
        let mut is_listed = vec![true; objects.len()];
        let parts = objects.iter().filter_map(|at| at.operands).flatten();
        parts.for_each(|part| is_listed[part] = self.drawn(part).is_some());
        for (index, at) in objects.iter().enumerate().rev() {
            let shows = is_listed[index] && !folded.contains(&index);
            for part in at.operands.iter().flatten() {
                is_listed[*part] |= shows;
            }
        }
        (0..objects.len()).filter(|&at| is_listed[at]).collect()
    }

    fn references(&self, node: Node, category: Category) -> Vec<(String, Node)> {
        type OfIndex = fn(usize) -> Node;
        let records = self.origins.records(node).map(|(record, _)| record);
        let Some(record) = records.max() else {
            return Vec::new();
        };
        let of = |places: &[Place]| places.iter().map(|at| (at.record, at.id)).collect();
        let (node, given): (OfIndex, Vec<_>) = match category {
            Category::Light => (Node::Light, of(&self.origins.lights)),
            Category::Material => (Node::Material, of(&self.origins.materials)),
            Category::Texture => (Node::Texture, of(&self.origins.textures)),
            Category::Object => {
                let objects = self.origins.objects.iter();
                let objects = objects.map(|at| (at.record, at.id));
                (Node::Object, objects.collect())
            }
        };
        let given = given.into_iter().enumerate();
        let before = given.filter(|&(_, (at, _))| at < record);
        let mut identities: Vec<_> = before.map(|(index, (_, id))| (id, node(index))).collect();
        identities.sort_unstable();
        let literal = |(id, node): (i64, Node)| (id.to_string(), node);
        identities.into_iter().map(literal).collect()
    }

    fn files(&self) -> Vec<NamedFile> {
        let places = self.origins.textures.iter().enumerate();
        let file = |(index, at): (usize, &Place)| {
            let fields = place(self.tree.tokens_of(&self.text, at.record), at.kind, 0);
            let word = fields
                .iter()
                .find(|placed| placed.field.kind == Kind::Word)?;
            let span = *word.spans.first()?;
            Some(NamedFile {
                path: span.of(&self.text).to_owned(),
                kind: FileKind::Picture,
                span,
                what: format!("{} {}", self.name(Node::Texture(index)), word.field.key),
            })
        };
        places.filter_map(file).collect()
    }

    fn users(&self, node: Node) -> usize {
        let of_material = |material: usize| {
            let uses = |object: &&ObjectPlace| object.material == Some(material);
            self.origins.objects.iter().filter(uses).count()
        };
        match node {
            Node::Material(material) => of_material(material),
            Node::Texture(texture) => {
                let uses = self.origins.uses.iter().filter(|at| at.texture == texture);
                let mut materials: Vec<_> = uses.map(|at| at.material).collect();
                materials.sort_unstable();
                materials.dedup();
                materials.into_iter().map(of_material).sum()
            }
            _ => 0,
        }
    }

    fn drawn(&self, object: usize) -> Option<u32> {
        place_of(&self.origins.drawn, object)
    }

    fn object(&self, drawn: u32) -> usize {
        object_at(&self.origins.drawn, drawn)
    }

    fn material(&self, object: usize) -> Option<usize> {
        self.origins.objects.get(object)?.material
    }

    fn comment_marks(&self) -> [&'static str; 2] {
        ["#", ""]
    }

    fn visibility_edits(
        &self,
        objects: &[usize],
        wanted: Visibility,
    ) -> Result<Vec<Edit>, &'static str> {
        visibility::edits(&self.text, &self.tree, &self.origins, objects, wanted)
    }

    fn render_removal(&self, key: &str) -> Vec<Edit> {
        let settings = self.origins.settings.as_ref();
        let removed = settings.and_then(|place| place.removal(&self.text, key, Around::Line));
        removed.into_iter().collect()
    }

    fn view_fields(&self) -> Vec<&'static Field> {
        view::fields().collect()
    }

    fn view_numbers(&self, camera: &Camera) -> Numbers {
        view::numbers(camera, &self.origins)
    }

    fn view_camera(&self, numbers: &Numbers, base: &Camera) -> Camera {
        view::camera(numbers, base, &self.origins)
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        view::edits(&self.text, &self.tree, &self.origins, before, camera)
    }
}

impl Source {
    /// Whether the comment that begins at this offset holds the render settings.
    pub(super) fn is_settings(&self, start: usize) -> bool {
        let settings = self.origins.settings.as_ref();
        settings.is_some_and(|settings| settings.whole.start() == start)
    }
}
