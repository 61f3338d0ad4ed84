//! What a `.ray` text says: its [`SceneText`].

use super::origins::distribute;
use super::schema::{AMBIENT, LIGHT, SCHEMA, VIEW};
use super::tree::{begins_comment, comment_of_line};
use super::view_comment::PLACES;
use super::{Source, incremental, lower, memory_estimate, view};
use crate::rendering::{self, Around};
use crate::schema::{Field, Schema};
use crate::view::Numbers;
use crate::written::Since;
use crate::{Before, FieldSpans, Lowered, Node, Nodes, SceneText, Visibility};
use memory::OutOfMemory;
use scene::{Camera, Meshes, Rendering};
use text::{Edit, Span};

impl SceneText for Source {
    fn lower(&mut self, _: &Meshes) -> Result<Lowered, OutOfMemory> {
        let fits = memory_estimate::fits(&self.text, &self.tree);
        let found = fits.map(|()| lower::lower(&self.text, &self.tree));
        self.store(found)
    }

    fn lower_change(&mut self, before: Before<'_>) -> Option<Lowered> {
        let edits = match &self.since {
            Since::Unchanged => &[],
            Since::Edited(edits) => &edits[..],
            Since::Unknown => return None,
        };
        let found = incremental::lower(&self.text, &self.tree, &self.origins, &before, edits);
        let (origins, lowered) = found?;
        self.place(origins);
        Some(lowered)
    }

    fn records(&self) -> Option<&'static Schema> {
        Some(&SCHEMA)
    }

    fn leaves(&self) -> Vec<Span> {
        self.tree.leaves(&self.text)
    }

    fn nodes(&self) -> Nodes {
        let origins = &self.origins;
        Nodes {
            view: true,
            ambient: origins.ambient == AMBIENT.numbers(),
            lights: origins.light_count(),
            objects: origins.objects.len(),
            ..Nodes::default()
        }
    }

    fn name(&self, node: Node) -> String {
        match self.origins.kind(node) {
            Some(kind) => format!("{node} ({})", kind.keyword()),
            None => node.to_string(),
        }
    }

    fn fields(&self, node: Node) -> Vec<FieldSpans> {
        let origins = &self.origins;
        let tokens = &*self.tree.range(origins.tokens(node));
        match node {
            Node::View => origins.view.fields(),
            Node::Render => {
                let render = origins.render.as_ref();
                let insertion = rendering::insertion(&self.text, render, "// render:");
                rendering::fields(render, &Rendering::default(), &insertion, None)
            }
            Node::Ambient => distribute(tokens, AMBIENT.fields()),
            Node::Light(_) => distribute(tokens, LIGHT.fields()),
            _ => match (origins.kind(node), tokens) {
                (Some(kind), [_, numbers @ ..]) => distribute(numbers, kind.fields()),
                _ => Vec::new(),
            },
        }
    }

    fn span(&self, node: Node) -> Span {
        let comment = self.origins.comments().find(|(of, _)| *of == node);
        let tokens = self.tree.range(self.origins.tokens(node));
        match (comment, tokens.first(), tokens.last()) {
            (Some((_, comment)), ..) => comment,
            (None, Some(first), Some(last)) => first.to(*last),
            _ => Span::at(0),
        }
    }

    fn comment(&self, node: Node) -> Option<&str> {
        Some(self.label(node)?.of(&self.text))
    }

    fn node_at(&self, span: Span) -> Option<Node> {
        let (origins, tree) = (&self.origins, &self.tree);
        let comment = |is: &dyn Fn(Span) -> bool| {
            let mut comments = origins.comments();
            comments.find_map(|(node, comment)| is(comment).then_some(node))
        };
        let holds = |comment: Span| comment.start() < span.end() && span.start() < comment.end();
        if let Some(node) = comment(&holds) {
            return Some(node);
        }
        let from = tree.partition_point(|token| token.end() < span.start());
        let touches = |&at: &usize| tree.get(at).is_some_and(|token| token.touches(span));
        let mut touched = (from..).take_while(touches);
        touched
            .find_map(|at| origins.node_of_token(at))
            .or_else(|| comment(&|comment| comment.touches(span)))
            .or_else(|| {
                // Between two tokens, it is in a node's text only if both belong to that node.
                let before = origins.node_of_token(from.checked_sub(1)?)?;
                (origins.node_of_token(from) == Some(before)).then_some(before)
            })
    }

    fn nodes_in(&self, span: Span) -> Vec<Node> {
        let nodes = self.nodes();
        // Comments may be anywhere.
        let is_comment = |node| matches!(node, Node::View | Node::Render);
        let ends_before = |node| is_comment(node) || self.span(node).end() <= span.start();
        let begins_before = |node| is_comment(node) || self.span(node).start() < span.end();
        let rows = nodes.partition_point(ends_before)..nodes.partition_point(begins_before);
        rows.filter_map(|row| nodes.get(row)).collect()
    }

    fn render_removal(&self, key: &str) -> Vec<Edit> {
        let render = self.origins.render.as_ref();
        let removed = render.and_then(|render| render.removal(&self.text, key, Around::Line));
        removed.into_iter().collect()
    }

    fn view_fields(&self) -> Vec<&'static Field> {
        VIEW.fields().collect()
    }

    fn drawn(&self, object: usize) -> Option<u32> {
        u32::try_from(object).ok()
    }

    fn object(&self, drawn: u32) -> usize {
        drawn as usize
    }

    fn view_numbers(&self, camera: &Camera) -> Numbers {
        view::numbers(camera)
    }

    fn view_camera(&self, numbers: &Numbers, _: &Camera) -> Camera {
        PLACES.camera(numbers)
    }

    fn view_edits(&self, before: &Camera, camera: &Camera) -> Vec<Edit> {
        view::edits(&self.text, &self.origins.view, before, camera)
    }

    fn is_comment(&self, leaf: Span) -> bool {
        begins_comment(leaf.of(&self.text).as_bytes())
    }

    fn comment_marks(&self) -> [&'static str; 2] {
        ["//", ""]
    }

    fn visibility_edits(&self, _: &[usize], _: Visibility) -> Result<Vec<Edit>, &'static str> {
        Err(".ray cannot hide objects")
    }
}

impl Source {
    /// The words of the comment behind a node, on its first or last line.
    pub(super) fn label(&self, node: Node) -> Option<Span> {
        if matches!(node, Node::View | Node::Render) {
            return None;
        }
        let text = &*self.text;
        let own = self.origins.tokens(node);
        let tokens = self.tree.range(own.start..own.end + 1);
        let next = tokens.iter().skip(1).map(|token| token.start());
        let gaps = tokens.iter().zip(next.chain([text.len()]));
        let gaps = gaps.map(|(token, next)| Span::new(token.end(), next));
        let gaps: Vec<_> = gaps.take(own.len()).collect();
        // Other than tokens on the same line.
        let rest = |gap: &Span| gap.of(text).trim_start_matches(BLANKS);
        let behind = |gap: Span| {
            let rest = rest(&gap);
            let start = begins_comment(rest.as_bytes()).then_some(gap.end() - rest.len());
            let comment = comment_of_line(text, start?)?;
            let has_meaning = self.origins.comments().any(|(_, of)| of == comment);
            let content = content_of(text, comment);
            (!content.is_empty() && !has_meaning).then_some(content)
        };
        let first = gaps.iter().find(|gap| !rest(gap).is_empty()).copied();
        first.and_then(behind).or_else(|| behind(*gaps.last()?))
    }
}

/// White space that ends no line.
const BLANKS: [char; 6] = [' ', '\t', '\u{B}', '\u{C}', '\u{A0}', '\u{FEFF}'];

/// The words of a comment.
fn content_of(text: &str, comment: Span) -> Span {
    let marked = &text[comment.start() + 2..comment.end()];
    let start = comment.end() - marked.trim_start().len();
    Span::new(start, start + marked.trim().len())
}
