//! What deleting, copying, moving and naming mean in a text of records: uses and lists follow, and
//! copies get IDs of their own.

use std::collections::{BTreeSet, HashSet};

use super::copies::{Copies, set_apart};
use super::identities::{self, identities};
use super::lines::is_comment;
use super::motion::Moves;
use super::places::Place;
use super::{Language, Source};
use crate::node::Node;
use crate::roles::{ANYWHERE, role};
use crate::schema::{Category, Makes, Slot};
use crate::structure::{adapted, deletions, exchange, lines_after, pair, uncreatable};
use crate::view::line_ending;
use crate::{
    Addition, Motion, Neighbour, NewNode, Placement, Pose, Roles, SceneText, StructureEdits,
    StructureError,
};
use text::{Edit, Span, counted, line_end, parse_number};

impl<L: Language> StructureEdits for Source<L>
where
    Self: Moves,
{
    fn consequence(&self, nodes: &[Node]) -> Option<String> {
        let gone = nodes.iter().copied().filter(|&node| L::is_movable(node));
        let gone: BTreeSet<_> = gone.collect();
        let users = self.users_beside(&gone);
        let said = [
            (self.dependents(&gone), "object", "will be deleted too"),
            (users, "material", "will lose it"),
        ];
        let said = said
            .into_iter()
            .filter_map(|(nodes, noun, what)| match nodes.as_slice() {
                [] => None,
                [one] => Some(format!("{} uses it and {what}", self.name(*one))),
                many => Some(format!("{} use it and {what}", counted(many.len(), noun))),
            });
        let said: Vec<_> = said.collect();
        (!said.is_empty()).then(|| said.join("; "))
    }

    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError> {
        let mut gone: BTreeSet<_> = nodes.iter().copied().collect();
        for &node in nodes {
            self.record(node)?;
        }
        gone.extend(self.dependents(&gone));
        let mut records = BTreeSet::new();
        for &node in &gone {
            records.extend(self.own_records(node)?);
            if let Node::Object(object) = node {
                records.extend(L::goes_with(self, object));
            }
        }
        let uses = self.origins.uses.iter();
        let uses = uses.filter(|place| place.references().any(|node| gone.contains(&node)));
        records.extend(uses.map(|place| place.at));
        let blocks = records.into_iter().map(|record| self.block(record));
        let mut edits = deletions(&self.text, blocks);
        if let Some(listing) = self.listing() {
            let objects = self.origins.objects().iter().enumerate();
            let ids = objects.filter(|(index, _)| gone.contains(&Node::Object(*index)));
            let ids: HashSet<_> = ids.map(|(_, place)| place.id).collect();
            let without = listing.exchanged::<L>(&self.text, |id| ids.contains(&id), &[]);
            edits.extend(without.ok_or(StructureError::Last {
                noun: "drawn object",
                reason: "`render` would list none, which draws all",
            })?);
        }
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError> {
        let mut records = BTreeSet::new();
        for &node in nodes {
            records.extend(self.own_records(node)?);
            if let Node::Object(object) = node {
                for (_, part) in self.parts(object, usize::MAX) {
                    records.extend(self.own_records(part)?);
                }
            }
            records.extend(self.origins.records::<L>(node).map(|(record, _)| record));
        }
        let copies = records
            .iter()
            .map(|&record| self.block_span(record).of(&self.text));
        let copies: Vec<_> = copies.collect();
        Ok(copies.join(line_ending(&self.text)))
    }

    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError> {
        self.inserted(text, after, &[])
    }

    fn exchange(&self, node: Node, neighbour: Neighbour) -> Result<Placement, StructureError> {
        let (category, index) = node
            .category()
            .ok_or_else(|| StructureError::Fixed(self.name(node)))?;
        let count = self.origins.of(category).len();
        let pair = pair(index, count, neighbour)
            .ok_or_else(|| StructureError::at_end(self.name(node), neighbour, ""))?;
        let [used, user] = pair.map(|index| Node::of(category, index));
        let place = self.origins.get(user);
        if place.is_some_and(|place| place.references().any(|node| node == used)) {
            let [user, used] = [user, used].map(|node| self.name(node));
            return Err(StructureError::Order { user, used });
        }
        let records = [self.record(used)?, self.record(user)?];
        L::check_exchange(self, [used, user])?;
        Ok(exchange(
            &self.text,
            records.map(|record| self.block(record)),
            records.map(|record| self.tree.span(record)),
            neighbour,
        ))
    }

    fn recount(&self) -> Vec<Edit> {
        let text = &*self.text;
        let records = 0..self.tree.records.len();
        let counts = records.filter_map(|at| {
            let tokens = self.tree.tokens(text, at);
            let record = identities::kind(L::SCHEMA, text, &tokens).ok()?;
            let repeat = record.repeat.filter(|_| record.makes == Makes::List)?;
            let mut tokens = tokens.skip(record.heads.len());
            let count = tokens.next()?;
            let stated: usize = count.of(text).parse().ok()?;
            let listed: Vec<Span> = tokens.collect();
            let is_list = listed.chunks(repeat.slots.len()).all(|entry| {
                let is_due = |(slot, span): (&Slot, &Span)| match slot {
                    Slot::Word(word) => span.of(text) == *word,
                    Slot::Id | Slot::Field(_) => span.of(text).parse::<i64>().is_ok(),
                };
                entry.len() == repeat.slots.len() && repeat.slots.iter().zip(entry).all(is_due)
            });
            let listed = listed.len() / repeat.slots.len();
            // 0 stands for all objects.
            (is_list && 0 < listed && stated != listed).then(|| Edit {
                span: count,
                text: listed.to_string(),
            })
        });
        counts.collect()
    }

    fn set_apart(&self, base: &str, theirs: &str) -> Vec<Edit> {
        set_apart([&self.text, base, theirs], &self.tree)
    }

    /// A number's role is its distance from the last word before it, in a record of its kind. Lists and
    /// options may be anywhere in a record.
    fn roles(&self, leaves: &[Span], _: [bool; 2]) -> Roles {
        let text = &*self.text;
        let (mut end, mut kind, mut index, mut is_id) = (None, 0, 0, false);
        let roles = leaves.iter().map(|leaf| {
            let word = leaf.of(text);
            if is_comment::<L>(word) {
                return ANYWHERE;
            }
            if end.is_none_or(|end| end <= leaf.start()) {
                end = Some(line_end(text, leaf.start()));
                let records = L::SCHEMA.records.iter();
                let known = records
                    .map(|record| record.heads[0])
                    .position(|head| head == word);
                kind = known.map_or(b' ', |known| b'!' + known as u8);
                (index, is_id) = (0, false);
            }
            if word.starts_with(|first: char| first.is_ascii_alphabetic()) {
                (index, is_id) = (2, word == "ID");
                return role(kind, 0);
            }
            let own = if is_id { 1 } else { index };
            (index, is_id) = (index + 1, false);
            role(kind, own)
        });
        Roles {
            roles: roles.collect(),
            unknown: 0,
        }
    }

    fn called(&self, node: Node) -> Option<&str> {
        let tokens = self.tree.tokens(&self.text, self.record(node).ok()?);
        let identities = identities(L::SCHEMA, &self.text, tokens);
        match identities.iter().find(|identity| identity.is_definition) {
            Some(own) => Some(own.span.of(&self.text)),
            None => self.called_behind(node),
        }
    }

    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError> {
        let nameless = || StructureError::Name(format!("{} has no ID", self.name(node)));
        self.called(node).ok_or_else(nameless)?;
        if L::COMMENTS_BEHIND {
            return Ok(self.named_behind(node, name));
        }
        let (category, _) = node.category().ok_or_else(nameless)?;
        let old = self.origins.get(node).ok_or_else(nameless)?.id;
        let id = match whole(name)? {
            id if id == old => id,
            _ => self.unused_id(category, name)?,
        };
        let all = identities::all(&self.text, &self.tree).into_iter();
        let same = all.filter(|(_, identity)| identity.key() == (category, old));
        Ok(same.map(|(_, identity)| identity.renamed(id)).collect())
    }

    fn additions(&self) -> &'static [Addition] {
        L::ADDITIONS
    }

    fn addition(&self, name: &str, wish: &NewNode<'_>) -> Result<Placement, StructureError> {
        L::addition(self, name, wish)
    }

    fn creation(
        &self,
        category: Category,
        name: &str,
        user: Node,
    ) -> Result<Placement, StructureError> {
        let id = self.unused_id(category, name)?;
        let text = L::plain(category, id).ok_or_else(|| uncreatable(category))?;
        let before = self.references(user, category).into_iter();
        let last = before.map(|(_, node)| node).max();
        self.insertion(&text, last.unwrap_or(Node::View))
    }

    fn kinds(&self, node: Node) -> Vec<&'static str> {
        L::kinds(self, node)
    }

    fn retyping(&self, node: Node, kind: &str) -> Result<Vec<Edit>, StructureError> {
        match node {
            Node::Light(_) => Ok(L::light_as(self, node, kind)),
            Node::Object(object) => self.retyped(object, kind),
            _ => Err(StructureError::Inexpressible(
                "only solids and lights can change their type".to_owned(),
            )),
        }
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
        let moved = nodes.iter().flat_map(|&node| match node {
            Node::Object(object) if self.operands(object).next().is_some() => {
                let parts = self.parts(object, usize::MAX).into_iter();
                let parts = parts.map(|(_, part)| part);
                let is_solid = |part: &Node| matches!(part, Node::Object(part) if self.operands(*part).next().is_none());
                parts.filter(is_solid).collect()
            }
            _ => vec![node],
        });
        self.all_moved(moved, motion, decimals)
    }
}

impl<L: Language> Source<L>
where
    Self: Moves,
{
    /// The edits that insert copied text; the objects with these IDs, which it combines, are no
    /// longer drawn by themselves.
    pub(crate) fn inserted(
        &self,
        text: &str,
        after: Node,
        combined: &[i64],
    ) -> Result<Placement, StructureError> {
        let taken = Category::ALL.into_iter().flat_map(|category| {
            let places = self.origins.of(category).iter();
            places.map(move |place| (category, place.id))
        });
        let copies = Copies::of::<L>(&L::as_copy(adapted(text, &self.text)), taken.collect())?;
        let own = match self.anchor(&copies, after) {
            Some(record) => lines_after(&self.text, self.block_span(record), &copies.text),
            None => Edit {
                span: Span::at(0),
                text: format!("{}{}", copies.text, line_ending(&self.text)),
            },
        };
        let place = own.span;
        let mut edits = vec![own];
        if let Some(listing) = self.listing() {
            let goes = |id| combined.contains(&id);
            let listed = listing.exchanged::<L>(&self.text, goes, &copies.results());
            edits.extend(listed.unwrap_or_default());
        }
        Edit::sort(&mut edits);
        let at = edits.iter().position(|edit| edit.span == place);
        Ok(Placement {
            at: at.unwrap_or_default(),
            edits,
        })
    }

    /// The objects that cannot stay without these nodes, to which they refer.
    fn dependents(&self, nodes: &BTreeSet<Node>) -> Vec<Node> {
        let mut gone = nodes.clone();
        let mut dependents = Vec::new();
        // What an object refers to is defined before it.
        for (index, place) in self.origins.objects().iter().enumerate() {
            let node = Node::Object(index);
            if place.references().any(|used| gone.contains(&used)) && gone.insert(node) {
                dependents.push(node);
            }
        }
        dependents
    }

    /// The nodes that stay and use some of these.
    fn users_beside(&self, nodes: &BTreeSet<Node>) -> Vec<Node> {
        let uses = self.origins.uses.iter();
        let uses = uses.filter(|place| place.references().any(|node| nodes.contains(&node)));
        let users: BTreeSet<_> = uses.filter_map(Place::user).collect();
        users
            .into_iter()
            .filter(|user| !nodes.contains(user))
            .collect()
    }

    /// The record after which copies stand: that of `after` if nothing they use follows it and they
    /// are of its kind, otherwise the last that they may follow. `None` in an empty text.
    fn anchor(&self, copies: &Copies, after: Node) -> Option<usize> {
        let definition = |(category, id)| {
            let mut places = self.origins.of(category).iter();
            Some(places.find(|place| place.id == id)?.at)
        };
        let used = copies.used().filter_map(definition).max();
        let category = after.category().map(|(category, _)| category);
        let is_kind = category.is_some() && category == copies.category();
        let places = self
            .origins
            .of(copies.category().unwrap_or(Category::Object));
        let last = places.len().checked_sub(1);
        let last = last.map(|last| Node::of(copies.category().unwrap_or(Category::Object), last));
        let node = if is_kind { Some(after) } else { last };
        // The records of its uses belong to a node.
        let own = node.and_then(|node| {
            let records = self.origins.records::<L>(node).map(|(at, _)| at);
            records.chain(self.own_records(node).ok()?).max()
        });
        own.or_else(|| self.tree.records.len().checked_sub(1))
            .max(used)
    }

    /// The ID that a text spells, which no node of the category has.
    fn unused_id(&self, category: Category, name: &str) -> Result<i64, StructureError> {
        let id = whole(name)?;
        if self.origins.of(category).iter().any(|place| place.id == id) {
            let reason = format!("{} {id} already exists", category.word());
            return Err(StructureError::Name(reason));
        }
        Ok(id)
    }

    /// The record that defines a node.
    fn record(&self, node: Node) -> Result<usize, StructureError> {
        let place = self.origins.get(node).filter(|_| L::is_movable(node));
        place
            .map(|place| place.at)
            .ok_or_else(|| StructureError::Fixed(self.name(node)))
    }

    /// The records that define a node.
    fn own_records(&self, node: Node) -> Result<Vec<usize>, StructureError> {
        let own = self.record(node)?;
        Ok(match node {
            Node::Object(object) => L::records_of(self, object),
            _ => vec![own],
        })
    }
}

/// The ID that a text spells.
fn whole(name: &str) -> Result<i64, StructureError> {
    let id = parse_number(name).ok().filter(|id| id.fract() == 0.0);
    let id = id.filter(|id| id.abs() < 1e15).map(|id| id as i64);
    id.ok_or_else(|| StructureError::Name("an ID is a whole number".to_owned()))
}
