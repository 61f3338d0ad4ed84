//! Where in the text each field of a scene stands.
//!
//! A million objects cost eight bytes each: their place is the index of a token, and spans are
//! looked up in the tree when asked for.

use std::fmt;

use super::fields::{self, AMBIENT, Field, LIGHT, ShapeKind, VIEW};
use crate::format::Tree;
use crate::text::Span;

/// A thing that has fields, in the order in which the interface lists them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Node {
    /// The camera.
    View,
    /// Ambient light.
    Ambient,
    /// A light, by index.
    Light(usize),
    /// An object, by index.
    Object(usize),
}

/// A field and where its numbers stand.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed {
    /// The field.
    pub field: &'static Field,
    /// One span a component; empty where the text does not say it (a view's missing part).
    pub spans: Vec<Span>,
}

/// Where everything that was lowered stands. It holds token indices: ask it only with the tree it
/// was made from.
#[derive(Clone, Debug, Default)]
pub struct Origins {
    pub(super) view: Option<ViewPlace>,
    /// How many of the first tokens are ambient light's numbers.
    pub(super) ambient: usize,
    /// The first token of the lights, and how many of their numbers follow.
    pub(super) lights: (usize, usize),
    pub(super) objects: Vec<ObjectPlace>,
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
    /// The view, ambient light, lights, objects: as far as the text could be understood.
    pub fn nodes(&self) -> Vec<Node> {
        let ambient = (self.ambient == fields::numbers(AMBIENT)).then_some(Node::Ambient);
        std::iter::once(Node::View)
            .chain(ambient)
            .chain((0..self.light_count()).map(Node::Light))
            .chain((0..self.objects.len()).map(Node::Object))
            .collect()
    }

    /// What a node is called: `view`, `ambient`, `light 2`, `object 3 (box)`.
    pub fn name(&self, node: Node) -> String {
        match node {
            Node::View => Name::View.to_string(),
            Node::Ambient => Name::Ambient.to_string(),
            Node::Light(index) => Name::Light(index).to_string(),
            Node::Object(index) => match self.objects.get(index) {
                Some(object) => Name::Object(index, object.kind).to_string(),
                None => format!("object {}", index + 1),
            },
        }
    }

    /// A node's fields with their places. A node whose text breaks off has only those fields whose
    /// numbers are all there.
    pub fn fields(&self, tree: &Tree, node: Node) -> Vec<Placed> {
        let tokens = self.numbers(tree, node);
        match node {
            Node::View => self.view_fields(),
            Node::Ambient => place(tokens, AMBIENT.iter()),
            Node::Light(_) => place(tokens, LIGHT.iter()),
            Node::Object(index) => self
                .objects
                .get(index)
                .map(|object| place(tokens, object.kind.fields()))
                .unwrap_or_default(),
        }
    }

    /// The whole of a node's text, from its first token to its last; empty for a missing view.
    pub fn span(&self, tree: &Tree, node: Node) -> Span {
        let Tree::Ray(ray) = tree;
        let keyword = match node {
            Node::View => self.view.map(|view| view.comment),
            Node::Object(index) => self
                .objects
                .get(index)
                .and_then(|object| ray.tokens.get(object.token as usize).copied()),
            Node::Ambient | Node::Light(_) => None,
        };
        let numbers = self.numbers(tree, node);
        let first = keyword.or_else(|| numbers.first().copied());
        first.map_or_else(
            || Span::at(0),
            |first| numbers.last().map_or(first, |&last| first.to(last)),
        )
    }

    /// What a comment says of a node: one that follows its text in the line where that begins, or
    /// else where it ends.
    pub fn comment<'t>(&self, text: &'t str, tree: &Tree, node: Node) -> Option<&'t str> {
        let Tree::Ray(ray) = tree;
        let own = self.span(tree, node);
        if node == Node::View || own.is_empty() {
            return None;
        }
        let behind = |from: usize| {
            let next = ray.comments.partition_point(|c| c.span.start() < from);
            let comment = ray.comments.get(next)?.span;
            let before = ray
                .tokens
                .partition_point(|token| token.end() <= comment.start());
            let token = ray.tokens[before.checked_sub(1)?];
            let follows = own.start() <= token.start() && token.end() <= own.end();
            let in_line = follows && !text[from..comment.start()].contains('\n');
            let is_view = self.view.is_some_and(|view| view.comment == comment);
            in_line
                .then(|| comment.of(text)[2..].trim())
                .filter(|said| !said.is_empty() && !is_view)
        };
        behind(own.start()).or_else(|| behind(own.end()))
    }

    /// The node whose text holds or touches `span`. A view comment inside another node's text
    /// counts as the view; where it ends at that node's token, the token counts.
    pub fn node_at(&self, tree: &Tree, span: Span) -> Option<Node> {
        let comment = self.view.map(|view| view.comment);
        let holds = |comment: Span| comment.start() < span.end() && span.start() < comment.end();
        if comment.is_some_and(holds) {
            return Some(Node::View);
        }
        let Tree::Ray(ray) = tree;
        let from = ray
            .tokens
            .partition_point(|token| token.end() < span.start());
        let mut touched = (from..ray.tokens.len()).take_while(|&at| ray.tokens[at].touches(span));
        touched
            .find_map(|at| self.node_of_token(at))
            .or_else(|| comment?.touches(span).then_some(Node::View))
            .or_else(|| {
                // Between two tokens, and so in a node's text only if both are that node's.
                let before = self.node_of_token(from.checked_sub(1)?)?;
                (self.node_of_token(from) == Some(before)).then_some(before)
            })
    }

    /// How many lights have at least their position.
    fn light_count(&self) -> usize {
        let position = LIGHT[0].kind.components();
        let each = fields::numbers(LIGHT);
        (self.lights.1 + each - position) / each
    }

    /// The tokens that are a node's numbers; none for the view, whose numbers are no tokens.
    fn numbers<'a>(&self, tree: &'a Tree, node: Node) -> &'a [Span] {
        let Tree::Ray(ray) = tree;
        let (start, len) = match node {
            Node::View => (0, 0),
            Node::Ambient => (0, self.ambient),
            Node::Light(index) => {
                let each = fields::numbers(LIGHT);
                let offset = index.saturating_mul(each);
                let left = self.lights.1.saturating_sub(offset);
                (self.lights.0.saturating_add(offset), left.min(each))
            }
            Node::Object(index) => self.objects.get(index).map_or((0, 0), |object| {
                (object.token as usize + 1, usize::from(object.numbers))
            }),
        };
        ray.tokens
            .get(start..start.saturating_add(len))
            .unwrap_or_default()
    }

    fn view_fields(&self) -> Vec<Placed> {
        let parts = self.view.map_or([None; VIEW.len()], |view| view.parts);
        VIEW.iter()
            .zip(parts)
            .map(|(field, part)| Placed {
                field,
                spans: part
                    .map_or_else(Vec::new, |spans| spans[..field.kind.components()].to_vec()),
            })
            .collect()
    }

    /// The node a token belongs to; counts and surplus tokens belong to none.
    fn node_of_token(&self, token: usize) -> Option<Node> {
        if token < self.ambient {
            return Some(Node::Ambient);
        }
        if let Some(offset) = token.checked_sub(self.lights.0)
            && offset < self.lights.1
        {
            return Some(Node::Light(offset / fields::numbers(LIGHT)));
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
fn place(tokens: &[Span], fields: impl Iterator<Item = &'static Field>) -> Vec<Placed> {
    let mut rest = tokens;
    fields
        .map_while(|field| {
            let (spans, after) = rest.split_at_checked(field.kind.components())?;
            rest = after;
            Some(Placed {
                field,
                spans: spans.to_vec(),
            })
        })
        .collect()
}

/// A node's name, spelled out only where a message needs it.
#[derive(Clone, Copy, Debug)]
pub(super) enum Name {
    View,
    Ambient,
    Light(usize),
    Object(usize, ShapeKind),
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::View => f.write_str("view"),
            Self::Ambient => f.write_str("ambient"),
            Self::Light(index) => write!(f, "light {}", index + 1),
            Self::Object(index, kind) => write!(f, "object {} ({})", index + 1, kind.keyword()),
        }
    }
}
