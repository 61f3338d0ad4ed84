//! The places of the nodes of a `.ray` text.
//!
//! Each of a million objects costs eight bytes: it is stored as a token index, and spans are looked
//! up in the tree on demand.

use std::ops::Range;
use std::sync::Arc;

use super::schema::{LIGHT, ShapeKind};
use super::view_comment::ViewComment;
use crate::field_spans::FieldSpans;
use crate::node::Node;
use crate::rendering::RenderPlace;
use crate::schema::Field;
use text::Span;

/// The places of everything lowered, as token indices: valid only with the tree they were made
/// from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Origins {
    pub(super) view: ViewComment,
    pub(super) render: Option<RenderPlace>,
    /// Number of tokens, at the start, that are ambient light's numbers.
    pub(super) ambient: usize,
    /// Index of the first token of the lights, and how many of their numbers follow.
    pub(super) lights: (usize, usize),
    pub(super) objects: Arc<Vec<ObjectPlace>>,
    /// Number of tokens in the text.
    pub(super) tokens: usize,
}

/// The place of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ObjectPlace {
    /// Index of the keyword's token.
    pub(super) token: u32,
    /// The kind of object.
    pub(super) kind: ShapeKind,
    /// Number of numbers after the keyword: fewer than the kind takes if the text breaks off.
    pub(super) numbers: u8,
}

impl Origins {
    /// The number of lights that have at least their first field.
    pub(super) fn light_count(&self) -> usize {
        let each = LIGHT.numbers();
        (self.lights.1 + each - LIGHT.field(0).kind.components()) / each
    }

    /// The kind of an object.
    pub(super) fn kind(&self, node: Node) -> Option<ShapeKind> {
        match node {
            Node::Object(index) => Some(self.objects.get(index)?.kind),
            _ => None,
        }
    }

    /// The tokens of a node, an object's keyword included; none for what is stated in comments.
    pub(super) fn tokens(&self, node: Node) -> Range<usize> {
        match node {
            Node::Ambient => 0..self.ambient,
            Node::Light(index) => {
                let (first, count) = self.lights;
                let each = LIGHT.numbers();
                let offset = count.min(index.saturating_mul(each));
                first + offset..first + count.min(offset + each)
            }
            Node::Object(index) => self.objects.get(index).map_or(0..0, |object| {
                let keyword = object.token as usize;
                keyword..keyword + 1 + usize::from(object.numbers)
            }),
            _ => 0..0,
        }
    }

    /// The comments of the view and of the render settings.
    pub(super) fn comments(&self) -> impl Iterator<Item = (Node, Span)> + use<> {
        let view = self.view.comment.map(|comment| (Node::View, comment));
        let render = self.render.map(|render| (Node::Render, render.whole));
        view.into_iter().chain(render)
    }

    /// The node that a token belongs to; `None` for counts and surplus tokens.
    pub(super) fn node_of_token(&self, token: usize) -> Option<Node> {
        if token < self.ambient {
            return Some(Node::Ambient);
        }
        if let Some(offset) = token.checked_sub(self.lights.0)
            && offset < self.lights.1
        {
            return Some(Node::Light(offset / LIGHT.numbers()));
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

/// Distributes `tokens` to the fields in order, until one is incomplete.
pub(super) fn distribute(
    tokens: &[Span],
    fields: impl Iterator<Item = &'static Field>,
) -> Vec<FieldSpans> {
    let mut rest = tokens;
    fields
        .map_while(|field| {
            let (spans, after) = rest.split_at_checked(field.kind.components())?;
            rest = after;
            Some(FieldSpans::explicit(field, spans.to_vec()))
        })
        .collect()
}
