//! What deleting, copying and moving mean in a `.ray` text: its counts follow.

use super::schema::{AMBIENT, LIGHT, SCHEMA, ShapeKind};
use super::tree::{self, comment_of_line};
use rayon::iter::ParallelIterator;

use super::{Source, add, roles};
use crate::engine::motion::Moves;
use crate::form::Form;
use crate::schema::{Record, Schema};
use crate::structure::{Block, adapted, deletions, follows, line_before, lines, lines_after, pair};
use crate::view::{line_ending, line_from};
use crate::{
    Addition, Motion, Neighbour, NewNode, Node, Placement, Pose, Roles, SceneText, StructureEdits,
    StructureError, structure,
};
use text::{Edit, Span, counted, line_end};

/// The kinds of nodes of which a text states the number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Counted {
    Lights,
    Objects,
}

impl StructureEdits for Source {
    fn consequence(&self, _: &[Node]) -> Option<String> {
        None
    }

    fn removal(&self, nodes: &[Node]) -> Result<Vec<Edit>, StructureError> {
        let nodes = ordered(nodes);
        let mut counts = Vec::new();
        for kind in [Counted::Lights, Counted::Objects] {
            let mut removed = 0;
            for &node in &nodes {
                removed += usize::from(Counted::of(self, node)?.0 == kind);
            }
            match kind.number(self).checked_sub(removed) {
                _ if removed == 0 => {}
                None | Some(0) => return Err(kind.last()),
                Some(left) => counts.push(kind.edit(self, left)),
            }
        }
        let blocks = nodes.iter().map(|&node| block(self, node));
        let mut edits = deletions(&self.text, blocks);
        for edit in &mut edits {
            let comments = self.origins.comments().map(|(_, comment)| comment);
            let held = comments.filter(|comment| edit.span.range().contains(&comment.start()));
            let mut held: Vec<_> = held.collect();
            held.sort_unstable();
            let Some(last) = held.pop() else {
                continue;
            };
            // What follows on the line must not become part of the comment.
            let end = edit.span.end();
            let behind = &self.text[end..line_end(&self.text, end)];
            let is_last = behind.trim().is_empty() && !edit.span.of(&self.text).ends_with('\n');
            let line_ending = line_ending(&self.text);
            for comment in held {
                edit.text.push_str(comment.of(&self.text));
                edit.text.push_str(line_ending);
            }
            edit.text.push_str(last.of(&self.text));
            edit.text.push_str(if is_last { "" } else { line_ending });
        }
        edits.extend(counts);
        Edit::sort(&mut edits);
        Ok(edits)
    }

    fn copied(&self, nodes: &[Node]) -> Result<String, StructureError> {
        let mut copies = Vec::new();
        for node in ordered(nodes) {
            Counted::of(self, node)?;
            let block = block(self, node).span();
            copies.push(self.without_settings(block));
        }
        Ok(copies.join(line_ending(&self.text)))
    }

    fn insertion(&self, text: &str, after: Node) -> Result<Placement, StructureError> {
        let [lights, objects] = split(text)?;
        let mut edits = Vec::new();
        let mut at = 0;
        for (kind, (copies, number)) in [(Counted::Lights, lights), (Counted::Objects, objects)] {
            if number == 0 {
                continue;
            }
            edits.push(kind.edit(self, kind.number(self) + number));
            at = edits.len();
            edits.push(kind.insertion(self, &copies, after));
        }
        Ok(Placement { edits, at })
    }

    fn exchange(&self, node: Node, neighbour: Neighbour) -> Result<Placement, StructureError> {
        let (kind, index) = Counted::of(self, node)?;
        let pair = pair(index, kind.number(self), neighbour)
            .ok_or_else(|| StructureError::at_end(self.name(node), neighbour, ""))?;
        let nodes = pair.map(|index| kind.node(index));
        Ok(structure::exchange(
            &self.text,
            nodes.map(|node| block(self, node)),
            nodes.map(|node| self.span(node)),
            neighbour,
        ))
    }

    fn recount(&self) -> Vec<Edit> {
        let (text, tokens) = (&*self.text, &self.tree.tokens);
        let ambient = AMBIENT.numbers();
        let is_object = |(_, word): &(usize, Span)| ShapeKind::of_word(word.of(text)).is_some();
        let objects: Vec<_> = tokens.words().filter(is_object).collect();
        let Some(&(first, _)) = objects.first() else {
            return Vec::new();
        };
        // Before the first object: ambient light, a count, lights, and another count.
        let each = LIGHT.numbers();
        let numbers = first
            .checked_sub(ambient + 2)
            .filter(|numbers| numbers % each == 0);
        let Some(lights) = numbers.map(|numbers| numbers / each) else {
            return Vec::new();
        };
        let counts = [(ambient, lights), (first - 1, objects.len())];
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
        Counted::of(self, node).ok()?;
        Some(self.comment(node).unwrap_or_default())
    }

    /// A name is a comment behind the node, which an empty name removes.
    fn renaming(&self, node: Node, name: &str) -> Result<Vec<Edit>, StructureError> {
        let refused = |reason: String| Err(StructureError::Name(reason));
        let text = &*self.text;
        if Counted::of(self, node).is_err() {
            return refused(format!("{} has no name", self.name(node)));
        }
        for (key, what) in [(tree::VIEW, "the view"), (tree::RENDER, "render settings")] {
            if name.starts_with(key) {
                return refused(format!("a comment that begins with {key} would set {what}"));
            }
        }
        let edit = |span, text| Ok(vec![Edit { span, text }]);
        let own = self.span(node);
        match self.label(node) {
            Some(label) if name.is_empty() => {
                let marked = text[..label.start()].trim_end();
                let before = marked[..marked.len() - 2].trim_end();
                edit(Span::new(before.len(), label.end()), String::new())
            }
            Some(label) => edit(label, name.to_owned()),
            None if name.is_empty() => Ok(Vec::new()),
            None => {
                let behind = &text[own.end()..line_end(text, own.end())];
                if !behind.trim().is_empty() {
                    return refused("its line has no room for a comment".to_owned());
                }
                edit(Span::at(own.end()), format!(" // {name}"))
            }
        }
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
        let moved = ordered(nodes)
            .into_iter()
            .map(|node| self.moved(node, motion, decimals));
        let mut edits = moved.collect::<Result<Vec<_>, _>>()?.concat();
        Edit::sort(&mut edits);
        Ok(edits)
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

impl Counted {
    fn of(source: &Source, node: Node) -> Result<(Self, usize), StructureError> {
        match node {
            Node::Light(index) => Ok((Self::Lights, index)),
            Node::Object(index) => Ok((Self::Objects, index)),
            _ => Err(StructureError::Fixed(source.name(node))),
        }
    }

    fn node(self, index: usize) -> Node {
        match self {
            Self::Lights => Node::Light(index),
            Self::Objects => Node::Object(index),
        }
    }

    /// The number of such nodes in a text without errors.
    fn number(self, source: &Source) -> usize {
        match self {
            Self::Lights => source.origins.light_count(),
            Self::Objects => source.origins.objects.len(),
        }
    }

    /// The edit that states their number.
    fn edit(self, source: &Source, number: usize) -> Edit {
        let (first, count) = source.origins.lights;
        let token = match self {
            Self::Lights => first.saturating_sub(1),
            Self::Objects => first + count,
        };
        Edit {
            span: source.tree.tokens.get(token).unwrap_or_default(),
            text: number.to_string(),
        }
    }

    /// The edit that writes copies after a node, or after the last of the kind.
    fn insertion(self, source: &Source, copies: &str, after: Node) -> Edit {
        let is_kind = |node| Self::of(source, node).is_ok_and(|(kind, _)| kind == self);
        let last = self.node(self.number(source).saturating_sub(1));
        let text = &*source.text;
        match block(source, if is_kind(after) { after } else { last }) {
            Block::Lines(block) => lines_after(text, block, &adapted(copies, text)),
            // On a shared line, a comment would hide what follows.
            Block::Part(own) => {
                let tokens = tree::parse(copies).tokens;
                let words = tokens.range(0..tokens.len());
                let words: Vec<_> = words.iter().map(|word| word.of(copies)).collect();
                Edit {
                    span: Span::at(own.end()),
                    text: format!(" {}", words.join(" ")),
                }
            }
        }
    }

    /// Why the last of them cannot be deleted.
    fn last(self) -> StructureError {
        let noun = match self {
            Self::Lights => "light",
            Self::Objects => "object",
        };
        let reason = "a .ray scene needs at least one";
        StructureError::Last { noun, reason }
    }
}

impl Source {
    /// The text of a block, without the view comment.
    fn without_settings(&self, block: Span) -> String {
        let mut copy = block.of(&self.text).to_owned();
        let comments = self.origins.comments().map(|(_, comment)| comment);
        let held = comments.filter(|comment| block.range().contains(&comment.start()));
        let mut held: Vec<_> = held.collect();
        held.sort_unstable();
        for comment in held.into_iter().rev() {
            let start = comment.start() - block.start();
            copy.replace_range(start..start + comment.len(), "");
        }
        copy
    }
}

/// These nodes, each once, in text order.
fn ordered(nodes: &[Node]) -> Vec<Node> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}

/// Splits a copied text into lights and objects, each with their number.
fn split(text: &str) -> Result<[(String, usize); 2], StructureError> {
    let tokens = tree::parse(text).tokens;
    let all = tokens.range(0..tokens.len());
    let is_keyword = |token: &&Span| ShapeKind::of_word(token.of(text)).is_some();
    let objects = all.iter().filter(is_keyword).count();
    let first = all.iter().find(is_keyword);
    let numbers = all.iter().take_while(|token| !is_keyword(token));
    let lights = numbers.clone().count();
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
    let border = match (numbers.last(), first) {
        (Some(last), Some(first)) => line_end(text, last.end()).min(first.start()),
        (Some(_), None) => text.len(),
        (None, _) => 0,
    };
    let [before, behind] = [&text[..border], &text[border..]].map(str::to_owned);
    Ok([(before, lights / each), (behind, objects)])
}

/// Whether a comment above a node is a heading of several: one of the same kind follows on the next
/// line.
fn has_heading(source: &Source, node: Node) -> bool {
    let Ok((kind, index)) = Counted::of(source, node) else {
        return false;
    };
    let next = index + 1;
    next < kind.number(source)
        && follows(
            &source.text,
            source.span(node),
            source.span(kind.node(next)),
        )
}

/// The text that moves with a node. The comments of the view and of the render settings move with none.
fn block(source: &Source, node: Node) -> Block {
    let text = &*source.text;
    let own = source.span(node);
    let has_meaning = |comment| source.origins.comments().any(|(_, of)| of == comment);
    let comment_above = |start| {
        let line = line_before(text, start).filter(|_| !has_heading(source, node))?;
        let comment = comment_of_line(text, line.start())?;
        let is_alone = text[line.start()..comment.start()].trim().is_empty();
        (is_alone && !has_meaning(comment)).then_some(line.start())
    };
    let before = Span::new(line_from(text, own.start()), own.start());
    let behind = Span::new(own.end(), line_end(text, own.end()));
    let comment = comment_of_line(text, own.end()).map_or_else(|| behind.end(), Span::start);
    let is_blank = |span: Span| span.of(text).trim().is_empty();
    let is_alone = is_blank(before) && is_blank(Span::new(own.end(), comment));
    let lines = lines(text, own, comment_above);
    let holds = |(_, comment): (Node, Span)| lines.range().contains(&comment.start());
    if is_alone && !source.origins.comments().any(holds) {
        Block::Lines(lines)
    } else {
        Block::Part(own)
    }
}
