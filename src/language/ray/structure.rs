//! What deleting, copying and moving mean in a `.ray` text: its counts follow.

use std::collections::BTreeSet;

use rayon::iter::ParallelIterator;

use super::roles::lights_in_head;
use super::schema::{AMBIENT, LIGHT, SCHEMA, ShapeKind};
use super::tree::{self, comment_of_line};
use super::{Source, add, roles};
use crate::engine::motion::Moves;
use crate::form::Form;
use crate::schema::{Category, Record, Schema};
use crate::structure::{Block, adapted, deletions, follows, line_before, lines, lines_after, pair};
use crate::view::{line_ending, line_from};
use crate::{
    Addition, Motion, Neighbour, NewNode, Node, Placement, Pose, Roles, SceneText, StructureEdits,
    StructureError, structure,
};
use text::{Edit, Span, counted, line_end};

/// The categories of nodes of which a text states the number, in its order.
const COUNTED: [Category; 2] = [Category::Light, Category::Object];

impl StructureEdits for Source {
    fn consequence(&self, _: &[Node]) -> Option<String> {
        None
    }

    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError> {
        let nodes = ordered(self, nodes)?;
        let mut counts = Vec::new();
        for category in COUNTED {
            let removed = nodes.iter().filter(|&&node| is_of(node, category)).count();
            match self.number(category).checked_sub(removed) {
                _ if removed == 0 => {}
                None | Some(0) => {
                    return Err(StructureError::Last {
                        noun: category.word(),
                        reason: "a .ray scene needs at least one",
                    });
                }
                Some(left) => counts.push(self.recounted(category, left)),
            }
        }
        let (text, ending) = (&*self.text, line_ending(&self.text));
        let blocks = nodes.iter().map(|&node| self.block(node));
        let mut edits = deletions(text, blocks);
        for edit in &mut edits {
            let held = self.settings_in(edit.span);
            if held.is_empty() {
                continue;
            }
            // What follows on the line must not become part of the comment.
            let end = edit.span.end();
            let is_last = text[end..line_end(text, end)].trim().is_empty()
                && !edit.span.of(text).ends_with('\n');
            let held: Vec<_> = held.iter().map(|comment| comment.of(text)).collect();
            edit.text = held.join(ending) + if is_last { "" } else { ending };
        }
        edits.extend(counts);
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError> {
        let nodes = ordered(self, nodes)?.into_iter();
        let copies: Vec<_> = nodes.map(|node| self.without_settings(node)).collect();
        Ok(copies.join(line_ending(&self.text)))
    }

    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError> {
        let mut edits = Vec::new();
        let mut at = 0;
        for (category, (copies, number)) in COUNTED.into_iter().zip(split(text)?) {
            if number == 0 {
                continue;
            }
            edits.push(self.recounted(category, self.number(category) + number));
            at = edits.len();
            edits.push(self.copies_after(category, &copies, after));
        }
        Ok(Placement { edits, at })
    }

    fn exchange(&self, node: Node, neighbour: Neighbour) -> Result<Placement, StructureError> {
        let (category, index) = counted_of(self, node)?;
        let pair = pair(index, self.number(category), neighbour)
            .ok_or_else(|| StructureError::at_end(self.name(node), neighbour, ""))?;
        let nodes = pair.map(|index| Node::of(category, index));
        Ok(structure::exchange(
            &self.text,
            nodes.map(|node| self.block(node)),
            nodes.map(|node| self.span(node)),
            neighbour,
        ))
    }

    fn recount(&self) -> Vec<Edit> {
        let (text, tokens) = (&*self.text, &self.tree);
        let is_object = |(_, word): &(usize, Span)| ShapeKind::of_word(word.of(text)).is_some();
        let objects: Vec<_> = tokens.words().filter(is_object).collect();
        let first = objects.first().map(|(first, _)| *first);
        let Some((first, lights)) = first.and_then(|first| Some((first, lights_in_head(first)?)))
        else {
            return Vec::new();
        };
        let counts = [(AMBIENT.numbers(), lights), (first - 1, objects.len())];
        let edits = counts.into_iter().filter_map(|(token, count)| {
            let span = tokens.get(token)?;
            let stated: u64 = span.of(text).parse().ok()?;
            (stated != count as u64).then(|| Edit {
                span,
                text: count.to_string(),
            })
        });
        edits.collect()
    }

    fn roles(&self, leaves: &[Span], at_ends: [bool; 2]) -> Roles {
        roles::roles(&self.text, leaves, at_ends)
    }

    fn called(&self, node: Node) -> Option<&str> {
        counted_of(self, node).ok()?;
        Some(self.comment(node).unwrap_or_default())
    }

    /// A name is a comment behind the node, which an empty name removes.
    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError> {
        let refused = |reason: String| Err(StructureError::Name(reason));
        let text = &*self.text;
        if counted_of(self, node).is_err() {
            return refused(format!("{} has no name", self.name(node)));
        }
        for (key, what) in [(tree::VIEW, "the view"), (tree::RENDER, "render settings")] {
            if name.starts_with(key) {
                return refused(format!("a comment that begins with {key} would set {what}"));
            }
        }
        let end = self.span(node).end();
        let (span, text) = match self.label(node) {
            Some(label) if name.is_empty() => {
                let marked = text[..label.start()].trim_end();
                let before = marked[..marked.len() - 2].trim_end();
                (Span::new(before.len(), label.end()), String::new())
            }
            Some(label) => (label, name.to_owned()),
            None if name.is_empty() => return Ok(Vec::new()),
            None if !text[end..line_end(text, end)].trim().is_empty() => {
                return refused("its line has no room for a comment".to_owned());
            }
            None => (Span::at(end), format!(" // {name}")),
        };
        Ok(vec![Edit { span, text }])
    }

    fn additions(&self) -> &'static [Addition] {
        add::ADDITIONS
    }

    fn addition(&self, name: &str, wish: &NewNode<'_>) -> Result<Placement, StructureError> {
        add::addition(self, name, wish)
    }

    fn kinds(&self, node: Node) -> Vec<&'static str> {
        match node {
            Node::Object(_) => ShapeKind::ALL.map(ShapeKind::keyword).into(),
            _ => Vec::new(),
        }
    }

    fn retyping(&self, node: Node, kind: &str) -> Result<Vec<Edit>, StructureError> {
        let Node::Object(object) = node else {
            let reason = format!("{} has only one type", self.name(node));
            return Err(StructureError::Inexpressible(reason));
        };
        self.retyped(object, kind)
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
        self.all_moved(nodes.iter().copied(), motion, decimals)
    }
}

impl Moves for Source {
    fn schema(&self) -> &'static Schema {
        &SCHEMA
    }

    fn object_record(&self, object: usize) -> Option<&'static Record> {
        let place = self.origins.objects.get(object)?;
        let is_whole = usize::from(place.numbers) == place.kind.numbers();
        is_whole.then(|| place.kind.record())
    }

    fn respelled(
        &self,
        object: usize,
        kind: &str,
        form: &Form,
    ) -> Result<Vec<Edit>, StructureError> {
        add::respelled(self, object, kind, form)
    }
}

impl Source {
    /// The number of nodes of a counted category in a text without errors.
    fn number(&self, category: Category) -> usize {
        match category {
            Category::Light => self.origins.light_count(),
            _ => self.origins.objects.len(),
        }
    }

    /// The edit that states the number of nodes of a counted category.
    fn recounted(&self, category: Category, number: usize) -> Edit {
        let (first, count) = self.origins.lights;
        let token = match category {
            Category::Light => first.saturating_sub(1),
            _ => first + count,
        };
        Edit {
            span: self.tree.get(token).unwrap_or_default(),
            text: number.to_string(),
        }
    }

    /// The edit that writes copies after a node, or after the last of their category.
    fn copies_after(&self, category: Category, copies: &str, after: Node) -> Edit {
        let last = Node::of(category, self.number(category).saturating_sub(1));
        let after = if is_of(after, category) { after } else { last };
        match self.block(after) {
            Block::Lines(block) => lines_after(&self.text, block, &adapted(copies, &self.text)),
            // On a shared line, a comment would hide what follows.
            Block::Part(own) => {
                let tokens = tree::parse(copies);
                let words = tokens.range(0..tokens.len());
                let words: Vec<_> = words.iter().map(|word| word.of(copies)).collect();
                Edit {
                    span: Span::at(own.end()),
                    text: format!(" {}", words.join(" ")),
                }
            }
        }
    }

    /// The comments of the view and of the render settings that begin in a span, in text order.
    fn settings_in(&self, span: Span) -> Vec<Span> {
        let comments = self.origins.comments().map(|(_, comment)| comment);
        let held = comments.filter(|comment| span.range().contains(&comment.start()));
        let mut held: Vec<_> = held.collect();
        held.sort_unstable();
        held
    }

    /// The text that moves with a node, without the comments of the view and of the render settings.
    fn without_settings(&self, node: Node) -> String {
        let block = self.block(node).span();
        let mut copy = block.of(&self.text).to_owned();
        for comment in self.settings_in(block).into_iter().rev() {
            let start = comment.start() - block.start();
            copy.replace_range(start..start + comment.len(), "");
        }
        copy
    }

    /// Whether a comment above a node is a heading of several: one of the same category follows on the
    /// next line.
    fn has_heading(&self, node: Node) -> bool {
        let Ok((category, index)) = counted_of(self, node) else {
            return false;
        };
        let next = Node::of(category, index + 1);
        index + 1 < self.number(category) && follows(&self.text, self.span(node), self.span(next))
    }

    /// The text that moves with a node. The comments of the view and of the render settings move with
    /// none.
    fn block(&self, node: Node) -> Block {
        let text = &*self.text;
        let own = self.span(node);
        let is_blank = |start: usize, end: usize| text[start..end].trim().is_empty();
        let comment_above = |start| {
            let line = line_before(text, start).filter(|_| !self.has_heading(node))?;
            let comment = comment_of_line(text, line.start())?;
            let is_alone = is_blank(line.start(), comment.start());
            (is_alone && self.settings_in(comment).is_empty()).then_some(line.start())
        };
        let behind = comment_of_line(text, own.end());
        let behind = behind.map_or_else(|| line_end(text, own.end()), Span::start);
        let is_alone =
            is_blank(line_from(text, own.start()), own.start()) && is_blank(own.end(), behind);
        let lines = lines(text, own, comment_above);
        if is_alone && self.settings_in(lines).is_empty() {
            Block::Lines(lines)
        } else {
            Block::Part(own)
        }
    }
}

/// The category and the index of a node that is counted.
fn counted_of(source: &Source, node: Node) -> Result<(Category, usize), StructureError> {
    let counted = node
        .category()
        .filter(|(category, _)| COUNTED.contains(category));
    counted.ok_or_else(|| StructureError::Fixed(source.name(node)))
}

fn is_of(node: Node, category: Category) -> bool {
    node.category().is_some_and(|(of, _)| of == category)
}

/// These nodes, all of counted categories, each once, in text order.
fn ordered(source: &Source, nodes: &[Node]) -> Result<BTreeSet<Node>, StructureError> {
    let nodes: BTreeSet<_> = nodes.iter().copied().collect();
    for &node in &nodes {
        counted_of(source, node)?;
    }
    Ok(nodes)
}

/// Splits a copied text into lights and objects, each with their number.
fn split(text: &str) -> Result<[(String, usize); 2], StructureError> {
    let tokens = tree::parse(text);
    let all = tokens.range(0..tokens.len());
    let is_keyword = |token: &Span| ShapeKind::of_word(token.of(text)).is_some();
    let objects = all.iter().filter(|token| is_keyword(token)).count();
    let lights = all.iter().position(is_keyword).unwrap_or(all.len());
    let each = LIGHT.numbers();
    if all.is_empty() || lights % each != 0 {
        let reason = match lights {
            0 => "it is empty".to_owned(),
            _ => format!(
                "expected objects, or lights of {}, but it begins with {}",
                counted(each, "number"),
                counted(lights, "word")
            ),
        };
        return Err(StructureError::Foreign { reason });
    }
    // Comments behind a light's last number belong to it.
    let border = match (all[..lights].last(), all.get(lights)) {
        (Some(last), Some(first)) => line_end(text, last.end()).min(first.start()),
        (Some(_), None) => text.len(),
        (None, _) => 0,
    };
    let [before, behind] = [&text[..border], &text[border..]].map(str::to_owned);
    Ok([(before, lights / each), (behind, objects)])
}
