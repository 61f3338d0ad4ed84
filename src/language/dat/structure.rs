//! What deleting, copying and moving mean in a `.dat` text: `render` and `use` follow, and copies
//! get IDs of their own.

use std::collections::HashSet;

use super::copies::{Copies, Identity};
use super::origins::Place;
use super::table::{ObjectKind, SOURCES};
use super::tree::is_comment;
use super::visibility::Listing;
use super::{Source, add, clashing_ids, roles};
use crate::structure::{
    Block, adapted, deletions, follows, line_before, lines, lines_after, pair, uncreatable,
};
use crate::table::Category;
use crate::view::line_ending;
use crate::{
    Addition, Motion, Neighbour, NewNode, Node, Placement, Pose, Roles, SceneText, StructureEdits,
    StructureError, structure,
};
use text::{Edit, Span, counted, parse_number};

impl StructureEdits for Source {
    fn consequence(&self, nodes: &[Node]) -> Option<String> {
        let users = match self.dependents(nodes).as_slice() {
            [] => None,
            [one] => Some(format!(
                "{} uses it and will be deleted too",
                self.name(*one)
            )),
            many => Some(format!(
                "{} use it and will be deleted too",
                counted(many.len(), "object")
            )),
        };
        let textured = match self.textured(nodes).as_slice() {
            [] => None,
            [one] => Some(format!("{} uses it and will lose it", self.name(*one))),
            many => Some(format!(
                "{} use it and will lose it",
                counted(many.len(), "material")
            )),
        };
        let both: Vec<_> = users.into_iter().chain(textured).collect();
        (!both.is_empty()).then(|| both.join("; "))
    }

    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError> {
        let origins = &self.origins;
        let mut nodes = nodes.to_vec();
        nodes.extend(self.dependents(&nodes));
        nodes.sort_unstable();
        nodes.dedup();
        let gone = |node| nodes.binary_search(&node).is_ok();
        let records: Result<Vec<_>, _> = nodes.iter().map(|&node| self.record(node)).collect();
        let uses = origins.uses.iter();
        let uses =
            uses.filter(|at| gone(Node::Material(at.material)) || gone(Node::Texture(at.texture)));
        let records = records?.into_iter().chain(uses.map(|at| at.record));
        let mut edits = deletions(&self.text, records.map(|record| self.block(record)));
        if let Some(listing) = Listing::of(&self.text, &self.tree, origins) {
            let objects = nodes.iter().filter_map(|&node| match node {
                Node::Object(index) => Some(origins.objects.get(index)?.id),
                _ => None,
            });
            let ids: HashSet<_> = objects.collect();
            let without = listing.without(&self.text, |id| ids.contains(&id));
            edits.extend(without.ok_or(StructureError::Last {
                noun: "drawn object",
                reason: "`render` would list none, which draws all",
            })?);
        }
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError> {
        let mut records = Vec::new();
        for &node in nodes {
            records.push(self.record(node)?);
            if let Node::Object(object) = node {
                for (_, part) in self.parts(object, usize::MAX) {
                    records.push(self.record(part)?);
                }
            }
            let uses = self.origins.uses.iter();
            let uses = uses.filter(|at| node == Node::Material(at.material));
            records.extend(uses.map(|at| at.record));
        }
        records.sort_unstable();
        records.dedup();
        let copies = records
            .iter()
            .map(|&record| self.block(record).span().of(&self.text));
        let copies: Vec<_> = copies.collect();
        Ok(copies.join(line_ending(&self.text)))
    }

    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError> {
        self.inserted(text, after, &[])
    }

    fn exchange(&self, node: Node, neighbour: Neighbour) -> Result<Placement, StructureError> {
        type OfIndex = fn(usize) -> Node;
        let origins = &self.origins;
        let (of_index, index, count): (OfIndex, _, _) = match node {
            Node::Light(index) => (Node::Light, index, origins.lights.len()),
            Node::Material(index) => (Node::Material, index, origins.materials.len()),
            Node::Texture(index) => (Node::Texture, index, origins.textures.len()),
            Node::Object(index) => (Node::Object, index, origins.objects.len()),
            _ => return Err(StructureError::Fixed(self.name(node))),
        };
        let pair = pair(index, count, neighbour)
            .ok_or_else(|| StructureError::at_end(self.name(node), neighbour, ""))?;
        let nodes = pair.map(of_index);
        if let Node::Object(user) = nodes[1]
            && let Some(operands) = origins.objects.get(user).and_then(|object| object.operands)
            && operands.contains(&pair[0])
        {
            return Err(StructureError::Order {
                user: self.name(nodes[1]),
                used: self.name(nodes[0]),
            });
        }
        let records = [self.record(nodes[0])?, self.record(nodes[1])?];
        Ok(structure::exchange(
            &self.text,
            records.map(|record| self.block(record)),
            records.map(|record| self.tree.span_of(record)),
            neighbour,
        ))
    }

    fn recount(&self) -> Vec<Edit> {
        clashing_ids::recount(&self.text, &self.tree)
    }

    fn set_apart(&self, base: &str, theirs: &str) -> Vec<Edit> {
        clashing_ids::set_apart(&self.text, &self.tree, base, theirs)
    }

    fn roles(&self, leaves: &[Span], _: [bool; 2]) -> Roles {
        roles::roles(&self.text, leaves)
    }

    fn called(&self, node: Node) -> Option<&str> {
        let record = self.record(node).ok()?;
        let identities = Identity::all(&self.text, self.tree.tokens_of(&self.text, record));
        let own = identities.iter().find(|identity| identity.is_definition)?;
        Some(own.span.of(&self.text))
    }

    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError> {
        let refused = |reason: String| Err(StructureError::Name(reason));
        let (Some(category), Some(old)) = (category(node), self.called(node)) else {
            return refused(format!("{} has no ID", self.name(node)));
        };
        let Ok(old) = old.parse::<i64>() else {
            return refused(format!("{} has no ID", self.name(node)));
        };
        let id = match whole(name)? {
            id if id == old => id,
            _ => self.unused_id(category, name)?,
        };
        let records = 0..self.tree.records.len();
        let all = records
            .flat_map(|record| Identity::all(&self.text, self.tree.tokens_of(&self.text, record)));
        let same = all.filter(|identity| identity.category == category && identity.id == old);
        let edit = |identity: Identity| Edit {
            span: identity.span,
            text: id.to_string(),
        };
        Ok(same.map(edit).collect())
    }

    fn additions(&self) -> &'static [Addition] {
        add::ADDITIONS
    }

    fn addition(&self, name: &str, wish: &NewNode<'_>) -> Result<Placement, StructureError> {
        add::addition(self, name, wish)
    }

    fn creation(
        &self,
        category: Category,
        name: &str,
        user: Node,
    ) -> Result<Placement, StructureError> {
        let id = self.unused_id(category, name)?;
        let text = add::plain(category, id).ok_or_else(|| uncreatable(category))?;
        let before = self.references(user, category).into_iter();
        let last = before.map(|(_, node)| node).max();
        self.insertion(&text, last.unwrap_or(Node::View))
    }

    fn kinds(&self, node: Node) -> Vec<&'static str> {
        match node {
            Node::Object(object) if self.operation(object).is_none() => {
                add::SOLIDS.map(ObjectKind::keyword).into()
            }
            Node::Light(_) => SOURCES.map(|(word, _)| word).into(),
            _ => Vec::new(),
        }
    }

    fn retyping(&self, node: Node, kind: &str) -> Result<Vec<Edit>, StructureError> {
        add::retyping(self, node, kind)
    }

    fn pose(&self, node: Node) -> Option<Pose> {
        self.pose_of(node)
    }

    fn orthonormalised(&self, node: Node) -> Result<Vec<Edit>, StructureError> {
        self.straightened(node)
    }

    fn motion(
        &self,
        nodes: &[Node],
        motion: &Motion,
        decimals: usize,
    ) -> Result<Vec<Edit>, StructureError> {
        // A combination moves with what it combines.
        let mut solids = Vec::new();
        for &node in nodes {
            match node {
                Node::Object(object) if self.operation(object).is_some() => {
                    let parts = self.parts(object, usize::MAX).into_iter();
                    let is_solid = |&(_, part): &(usize, Node)| matches!(part, Node::Object(part) if self.operation(part).is_none());
                    solids.extend(parts.filter(is_solid).map(|(_, part)| part));
                }
                _ => solids.push(node),
            }
        }
        solids.sort_unstable();
        solids.dedup();
        let moved = solids.into_iter().map(|node| {
            // Of the solids, only a quadric can be an ellipsoid in any direction.
            if let Node::Object(index) = node
                && let Some(turned) = self.turned_ellipsoid(index, motion)
            {
                return add::respelled(self, index, ObjectKind::Quadric, &turned);
            }
            self.moved(node, motion, decimals)
        });
        let mut edits = moved.collect::<Result<Vec<_>, _>>()?.concat();
        Edit::sort(&mut edits);
        Ok(edits)
    }
}

impl Source {
    /// The edits that insert copied text; the objects with these IDs, which it combines, are no
    /// longer drawn by themselves.
    pub(super) fn inserted(
        &self,
        text: &str,
        after: Node,
        combined: &[i64],
    ) -> Result<Placement, StructureError> {
        let adapted = adapted(text, &self.text);
        let mut copies = Copies::of(&adapted)?;
        for category in [
            Category::Light,
            Category::Material,
            Category::Texture,
            Category::Object,
        ] {
            copies.renumber(category, &self.ids(category));
        }
        let anchor = self.anchor(&copies, after);
        let own = match anchor {
            Some(record) => lines_after(&self.text, self.block(record).span(), &copies.text()),
            None => Edit {
                span: Span::at(0),
                text: format!("{}{}", copies.text(), line_ending(&self.text)),
            },
        };
        let start = own.span.start();
        let mut edits = vec![own];
        if let Some(listing) = Listing::of(&self.text, &self.tree, &self.origins) {
            let goes = |id| combined.contains(&id);
            edits.extend(
                listing
                    .exchanged(&self.text, goes, &copies.results())
                    .unwrap_or_default(),
            );
        }
        Edit::sort(&mut edits);
        let at = edits.iter().position(|edit| edit.span == Span::at(start));
        Ok(Placement {
            at: at.unwrap_or_default(),
            edits,
        })
    }

    /// The objects that cannot stay without these nodes: those that have a material among them, or
    /// combine objects that go.
    fn dependents(&self, nodes: &[Node]) -> Vec<Node> {
        let nodes: HashSet<_> = nodes.iter().copied().collect();
        let objects = self.origins.objects.iter().enumerate();
        let mut goes: Vec<bool> = Vec::new();
        // Operands and materials are defined before their use.
        for (index, object) in objects {
            let material = object.material.map(Node::Material);
            let mut operands = object.operands.iter().flatten();
            let is_gone = nodes.contains(&Node::Object(index))
                || material.is_some_and(|material| nodes.contains(&material))
                || operands.any(|&operand| goes[operand]);
            goes.push(is_gone);
        }
        let objects = goes.iter().enumerate().filter(|(_, goes)| **goes);
        let objects = objects.map(|(index, _)| Node::Object(index));
        objects.filter(|node| !nodes.contains(node)).collect()
    }

    /// The materials that stay and use textures among these nodes.
    fn textured(&self, nodes: &[Node]) -> Vec<Node> {
        let nodes: HashSet<_> = nodes.iter().copied().collect();
        let uses = self.origins.uses.iter();
        let uses = uses.filter(|at| nodes.contains(&Node::Texture(at.texture)));
        let mut users: Vec<_> = uses.map(|at| Node::Material(at.material)).collect();
        users.retain(|user| !nodes.contains(user));
        users.sort_unstable();
        users.dedup();
        users
    }

    /// The record after which copies stand: that of `after` if nothing they use follows it and they
    /// are of its kind, otherwise the last that they may follow. `None` in an empty text.
    fn anchor(&self, copies: &Copies, after: Node) -> Option<usize> {
        let used = copies
            .used()
            .filter_map(|(category, id)| self.definition(category, id));
        let used = used.max();
        let own = self.record(after).ok();
        let is_kind = category(after).is_some() && category(after) == copies.category();
        let own = own.filter(|_| is_kind);
        let last = || {
            let origins = &self.origins;
            let of = |places: &[Place]| places.last().map(|place| place.record);
            let objects = origins.objects.last().map(|object| object.record);
            let same = match copies.category() {
                Some(Category::Light) => of(&origins.lights),
                Some(Category::Material) => of(&origins.materials),
                Some(Category::Texture) => of(&origins.textures),
                Some(Category::Object) | None => objects,
            };
            let any = || self.tree.records.len().checked_sub(1);
            same.or_else(any)
        };
        let uses = || {
            // A `use` record belongs to the material before it.
            let record = own.or_else(last)?;
            let origins = &self.origins;
            let uses = origins.uses.iter().filter(|at| {
                let material = origins.materials.get(at.material);
                material.is_some_and(|material| material.record == record)
            });
            uses.map(|at| at.record).chain([record]).max()
        };
        uses().max(used)
    }

    /// The ID that a text spells, which no node of the category has.
    fn unused_id(&self, category: Category, name: &str) -> Result<i64, StructureError> {
        let id = whole(name)?;
        if self.ids(category).contains(&id) {
            let reason = format!("{} {id} already exists", category.word());
            return Err(StructureError::Name(reason));
        }
        Ok(id)
    }

    /// The IDs in use.
    fn ids(&self, category: Category) -> HashSet<i64> {
        let of = |places: &[Place]| places.iter().map(|place| place.id).collect();
        match category {
            Category::Light => of(&self.origins.lights),
            Category::Material => of(&self.origins.materials),
            Category::Texture => of(&self.origins.textures),
            Category::Object => self.origins.objects.iter().map(|at| at.id).collect(),
        }
    }

    /// The record that defines an ID.
    fn definition(&self, category: Category, id: i64) -> Option<usize> {
        let of = |places: &[Place]| Some(places.iter().find(|place| place.id == id)?.record);
        match category {
            Category::Light => of(&self.origins.lights),
            Category::Material => of(&self.origins.materials),
            Category::Texture => of(&self.origins.textures),
            Category::Object => {
                let mut objects = self.origins.objects.iter();
                Some(objects.find(|object| object.id == id)?.record)
            }
        }
    }

    /// The record that defines a node.
    fn record(&self, node: Node) -> Result<usize, StructureError> {
        let own = match node {
            Node::View | Node::Render => None,
            _ => self.origins.records(node).next(),
        };
        own.map(|(record, _)| record)
            .ok_or_else(|| StructureError::Fixed(self.name(node)))
    }

    /// Whether a comment above a record is a heading of several: one of the same category follows
    /// on the next line.
    fn has_heading(&self, record: usize) -> bool {
        let of = |record| self.origins.node_of(record).and_then(category);
        let next = record + 1;
        of(record).is_some()
            && of(record) == of(next)
            && follows(
                &self.text,
                self.tree.span_of(record),
                self.tree.span_of(next),
            )
    }

    /// The lines that move with a record.
    fn block(&self, record: usize) -> Block {
        let text = &*self.text;
        let comment_above = |start| {
            let line = line_before(text, start).filter(|_| !self.has_heading(record))?;
            let comment = line.of(text).trim();
            let start = line.start() + line.of(text).find(comment).unwrap_or_default();
            (is_comment(comment) && !self.is_settings(start)).then_some(line.start())
        };
        Block::Lines(lines(text, self.tree.span_of(record), comment_above))
    }
}

/// The ID that a text spells.
fn whole(name: &str) -> Result<i64, StructureError> {
    let id = parse_number(name).ok().filter(|id| id.fract() == 0.0);
    let id = id.filter(|id| id.abs() < 1e15).map(|id| id as i64);
    id.ok_or_else(|| StructureError::Name("an ID is a whole number".to_owned()))
}

/// The category of a node with an ID.
fn category(node: Node) -> Option<Category> {
    match node {
        Node::Light(_) => Some(Category::Light),
        Node::Material(_) => Some(Category::Material),
        Node::Texture(_) => Some(Category::Texture),
        Node::Object(_) => Some(Category::Object),
        Node::View | Node::Render | Node::Ambient | Node::Background | Node::Environment => None,
    }
}
