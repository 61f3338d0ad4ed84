//! Where the things of a `.ray` text stand.
//!
//! A million objects cost eight bytes each: their place is the index of a token, and spans are
//! looked up in the tree when asked for.

use std::sync::Arc;

use super::table::{AMBIENT, LIGHT, ShapeKind, VIEW};
use super::tree::Tree;
use crate::language::node::{Node, Nodes};
use crate::language::placed::Placed;
use crate::language::report::Name;
use crate::language::table::{self, Field};
use crate::text::Span;

/// Where everything that was lowered stands. It holds token indices: ask it only with the tree it
/// was made from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    pub(super) view: Option<ViewPlace>,
    /// How many of the first tokens are ambient light's numbers.
    pub(super) ambient: usize,
    /// The first token of the lights, and how many of their numbers follow.
    pub(super) lights: (usize, usize),
    pub(super) objects: Arc<Vec<ObjectPlace>>,
    /// How many tokens and comments the text has.
    pub(super) tokens: usize,
    pub(super) comments: usize,
}

/// Where a view comment's parts stand.
#[derive(Clone, Copy, Debug)]
pub(super) struct ViewPlace {
    /// The whole comment.
    pub(super) comment: Span,
    /// In the order of [`VIEW`]: as many spans as the field has components, or `None` if missing.
    pub(super) parts: [Option<[Span; 3]>; VIEW.len()],
}

/// Where an object stands.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectPlace {
    /// Index of the token that is its keyword.
    pub(super) token: u32,
    /// What it is.
    pub(super) kind: ShapeKind,
    /// How many numbers follow the keyword: fewer than its kind takes where the text breaks off.
    pub(super) numbers: u8,
}

impl Origins {
    pub(super) fn nodes(&self) -> Nodes {
        Nodes {
            view: true,
            ambient: self.ambient == table::numbers(AMBIENT),
            lights: self.light_count(),
            objects: self.objects.len(),
            ..Nodes::default()
        }
    }

    pub(super) fn name(&self, node: Node) -> String {
        match node {
            Node::View => Name::View.to_string(),
            Node::Ambient => Name::Ambient.to_string(),
            Node::Light(index) => Name::Light(index).to_string(),
            Node::Object(index) => self.object_name(index),
            Node::Material(index) => format!("material {}", index + 1),
            Node::Texture(index) => format!("texture {}", index + 1),
            Node::Background => "background".to_owned(),
            Node::Environment => "environment".to_owned(),
        }
    }

    /// What an object is called.
    pub(super) fn object_name(&self, index: usize) -> String {
        match self.objects.get(index) {
            Some(object) => Name::Object(index, object.kind.keyword()).to_string(),
            None => format!("object {}", index + 1),
        }
    }

    pub(super) fn fields(&self, tree: &Tree, node: Node) -> Vec<Placed> {
        let tokens = &self.numbers(tree, node);
        match node {
            Node::View => self.view_fields(),
            Node::Ambient => hand_out(tokens, AMBIENT.iter()),
            Node::Light(_) => hand_out(tokens, LIGHT.iter()),
            Node::Object(index) => self
                .objects
                .get(index)
                .map(|object| hand_out(tokens, object.kind.fields()))
                .unwrap_or_default(),
            Node::Material(_) | Node::Texture(_) | Node::Background | Node::Environment => {
                Vec::new()
            }
        }
    }

    pub(super) fn span(&self, tree: &Tree, node: Node) -> Span {
        let keyword = match node {
            Node::View => self.view.map(|view| view.comment),
            Node::Object(index) => self
                .objects
                .get(index)
                .and_then(|object| tree.tokens.get(object.token as usize)),
            _ => None,
        };
        let numbers = self.numbers(tree, node);
        let first = keyword.or_else(|| numbers.first().copied());
        first.map_or_else(
            || Span::at(0),
            |first| numbers.last().map_or(first, |&last| first.to(last)),
        )
    }

    pub(super) fn comment<'t>(&self, text: &'t str, tree: &Tree, node: Node) -> Option<&'t str> {
        let own = self.span(tree, node);
        if node == Node::View || own.is_empty() {
            return None;
        }
        let behind = |from: usize| {
            let next = tree.comments.partition_point(|c| c.span.start() < from);
            let comment = tree.comments.get(next)?.span;
            let before = tree
                .tokens
                .partition_point(|token| token.end() <= comment.start());
            let token = tree.tokens.get(before.checked_sub(1)?)?;
            let follows = own.start() <= token.start() && token.end() <= own.end();
            let in_line = follows && !text[from..comment.start()].contains(['\n', '\r']);
            let is_view = self.view.is_some_and(|view| view.comment == comment);
            in_line
                .then(|| comment.of(text)[2..].trim())
                .filter(|said| !said.is_empty() && !is_view)
        };
        behind(own.start()).or_else(|| behind(own.end()))
    }

    pub(super) fn node_at(&self, tree: &Tree, span: Span) -> Option<Node> {
        let comment = self.view.map(|view| view.comment);
        let holds = |comment: Span| comment.start() < span.end() && span.start() < comment.end();
        if comment.is_some_and(holds) {
            return Some(Node::View);
        }
        let from = tree
            .tokens
            .partition_point(|token| token.end() < span.start());
        let touches = |&at: &usize| {
            let token = tree.tokens.get(at);
            token.is_some_and(|token| token.touches(span))
        };
        let mut touched = (from..).take_while(touches);
        touched
            .find_map(|at| self.node_of_token(at))
            .or_else(|| comment?.touches(span).then_some(Node::View))
            .or_else(|| {
                // Between two tokens, and so in a node's text only if both are that node's.
                let before = self.node_of_token(from.checked_sub(1)?)?;
                (self.node_of_token(from) == Some(before)).then_some(before)
            })
    }

    pub(super) fn nodes_in(&self, tree: &Tree, span: Span) -> Vec<Node> {
        let nodes = self.nodes();
        // The view's comment may stand anywhere.
        let is_view = |node| node == Node::View;
        let ends_before = |node| is_view(node) || self.span(tree, node).end() <= span.start();
        let begins_before = |node| is_view(node) || self.span(tree, node).start() < span.end();
        let rows = nodes.partition_point(ends_before)..nodes.partition_point(begins_before);
        rows.filter_map(|row| nodes.get(row)).collect()
    }

    /// How many lights have at least their position.
    fn light_count(&self) -> usize {
        let position = LIGHT[0].kind.components();
        let each = table::numbers(LIGHT);
        (self.lights.1 + each - position) / each
    }

    /// The tokens that are a node's numbers; none for the view, whose numbers are not tokens.
    fn numbers(&self, tree: &Tree, node: Node) -> Vec<Span> {
        let (start, len) = match node {
            Node::View
            | Node::Material(_)
            | Node::Texture(_)
            | Node::Background
            | Node::Environment => (0, 0),
            Node::Ambient => (0, self.ambient),
            Node::Light(index) => {
                let each = table::numbers(LIGHT);
                let offset = index.saturating_mul(each);
                let left = self.lights.1.saturating_sub(offset);
                (self.lights.0.saturating_add(offset), left.min(each))
            }
            Node::Object(index) => self.objects.get(index).map_or((0, 0), |object| {
                (object.token as usize + 1, usize::from(object.numbers))
            }),
        };
        tree.tokens.range(start..start.saturating_add(len))
    }

    fn view_fields(&self) -> Vec<Placed> {
        let parts = self.view.map_or([None; VIEW.len()], |view| view.parts);
        VIEW.iter()
            .zip(parts)
            .map(|(field, part)| {
                let spans = part.map(|spans| spans[..field.kind.components()].to_vec());
                Placed::said(field, spans.unwrap_or_default())
            })
            .collect()
    }

    /// The node a token belongs to; counts and surplus tokens belong to none.
    pub(super) fn node_of_token(&self, token: usize) -> Option<Node> {
        if token < self.ambient {
            return Some(Node::Ambient);
        }
        if let Some(offset) = token.checked_sub(self.lights.0)
            && offset < self.lights.1
        {
            return Some(Node::Light(offset / table::numbers(LIGHT)));
        }
        let after = self
            .objects
            .partition_point(|object| object.token as usize <= token);
        let index = after.checked_sub(1)?;
        let object = &self.objects[index];
        let offset = token - object.token as usize;
        (offset <= usize::from(object.numbers)).then_some(Node::Object(index))
    }
}

/// Hands out `tokens` to the fields in order, until one is not complete.
fn hand_out(tokens: &[Span], fields: impl Iterator<Item = &'static Field>) -> Vec<Placed> {
    let mut rest = tokens;
    fields
        .map_while(|field| {
            let (spans, after) = rest.split_at_checked(field.kind.components())?;
            rest = after;
            Some(Placed::said(field, spans.to_vec()))
        })
        .collect()
}
