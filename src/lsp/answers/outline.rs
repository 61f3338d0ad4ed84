//! The nodes of a text as symbols and folds.

use std::collections::HashMap;

use language::schema::{Category, Kind};
use language::{Language, Node};
use serde_json::{Value, json};
use text::Span;

use crate::document::Document;

/// The maximum number of symbols and of folds.
const MOST: usize = 10_000;

/// The maximum depth of symbols; deeper ones are not listed.
const MOST_LEVELS: usize = 64;

/// Symbols in the order of the text, and those directly below each.
struct Outline<'d> {
    document: &'d Document,
    nodes: Vec<(Span, Node)>,
    below: HashMap<usize, Vec<usize>>,
}

/// The answer to `textDocument/documentSymbol`: in the order of the text, objects below those that hold or
/// combine them.
pub(crate) fn symbols(document: &Document) -> Value {
    let source = &document.source;
    let nodes = source.nodes().iter().map(|node| (source.span(node), node));
    let nodes = nodes.filter(|(span, _)| !span.is_empty());
    let mut nodes: Vec<_> = nodes.take(MOST).collect();
    // What holds others comes before them.
    nodes.sort_unstable_by_key(|(span, node)| (span.start(), usize::MAX - span.end(), *node));
    let combining = combining(document);
    let indices = nodes.iter().enumerate();
    let index: HashMap<_, _> = indices.map(|(index, (_, node))| (*node, index)).collect();
    let mut outline = Outline {
        document,
        nodes,
        below: HashMap::new(),
    };
    let mut top = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    for (own, (span, node)) in outline.nodes.iter().enumerate() {
        let holds = |outer: usize| {
            let outer = outline.nodes[outer].0;
            span.end() <= outer.end() && outer != *span
        };
        while open.pop_if(|outer| !holds(*outer)).is_some() {}
        let user = combining.get(node).and_then(|user| index.get(user));
        match user.or_else(|| open.last()) {
            Some(outer) => outline.below.entry(*outer).or_default().push(own),
            None => top.push(own),
        }
        open.push(own);
    }
    outline.listed(&top, 1)
}

/// The first object that combines an object, by the latter.
fn combining(document: &Document) -> HashMap<Node, Node> {
    let source = &document.source;
    let objects = 0..source.nodes().objects().min(MOST);
    let id = |node| source.called(node)?.parse::<i64>().ok();
    let ids: HashMap<_, _> = objects
        .clone()
        .map(Node::Object)
        .filter_map(|node| Some((id(node)?, node)))
        .collect();
    let combining = objects.filter(|object| source.operation(*object).is_some());
    let mut users = HashMap::new();
    for user in combining.map(Node::Object) {
        let fields = source.fields(user).into_iter();
        let parts = fields.filter(|placed| placed.field.kind == Kind::Reference(Category::Object));
        for span in parts.flat_map(|placed| placed.spans) {
            let part = source.leaf_text(span).parse().ok();
            if let Some(part) = part.and_then(|id: i64| ids.get(&id)) {
                users.entry(*part).or_insert(user);
            }
        }
    }
    users
}

impl Outline<'_> {
    fn listed(&self, indices: &[usize], level: usize) -> Value {
        let symbol = |index: &usize| {
            let (span, node) = self.nodes[*index];
            let source = &self.document.source;
            let mut symbol = json!({
                "name": source.name(node),
                "detail": source.comment(node).unwrap_or_default(),
                "kind": kind(node),
                "range": self.document.range(span),
                "selectionRange": self.document.range(name_of(self.document, node, span)),
            });
            let below = self.below.get(index).filter(|_| level < MOST_LEVELS);
            if let Some(below) = below {
                symbol["children"] = self.listed(below, level + 1);
            }
            symbol
        };
        indices.iter().map(symbol).collect()
    }
}

/// The name or ID in the first line of a node; without one, the first word.
fn name_of(document: &Document, node: Node, span: Span) -> Span {
    /// Longer beginnings hold no name that anybody finds.
    const NEAR: usize = 400;
    let text = span.of(document.text());
    let near = text
        .char_indices()
        .map_while(|(at, c)| (at < NEAR).then_some(at + c.len_utf8()));
    let text = &text[..near.last().unwrap_or(0)];
    let line = text.lines().next().unwrap_or_default();
    let is_xml = document.source.language() == Language::Xml;
    let start = usize::from(is_xml);
    let first = line[start..].find([' ', '\t', '/', '>']);
    let first = (start, first.map_or(line.len(), |len| start + len));
    let called = document.source.called(node).filter(|name| !name.is_empty());
    let is_name = |(at, name): &(usize, &str)| {
        let (before, behind) = (&line[..*at], &line[at + name.len()..]);
        if is_xml {
            return before.ends_with(['"', '\'']) && before[..at - 1].ends_with("name=");
        }
        before.ends_with([' ', '\t']) && (behind.is_empty() || behind.starts_with([' ', '\t']))
    };
    let found = called.and_then(|called| line.match_indices(called).find(is_name));
    let (from, to) = found.map_or(first, |(at, name)| (at, at + name.len()));
    Span::new(span.start() + from, span.start() + to)
}

/// The nearest of the protocol's kinds, which editors show as icons.
fn kind(node: Node) -> u8 {
    match node {
        // Namespace.
        Node::Render => 3,
        // Interface.
        Node::View => 11,
        // Constant.
        Node::Ambient | Node::Background | Node::Environment => 14,
        // Event.
        Node::Light(_) => 24,
        // Property.
        Node::Material(_) | Node::Texture(_) => 7,
        // Object.
        Node::Object(_) => 19,
    }
}

/// The answer to `textDocument/foldingRange`: nodes of several lines.
pub(crate) fn folds(document: &Document) -> Value {
    let source = &document.source;
    let lines = source.nodes().iter().map(|node| {
        let span = source.span(node);
        [span.start(), span.end()].map(|at| document.line(at))
    });
    let folds = lines.filter(|[start, end]| start < end).take(MOST);
    folds
        .map(|[start, end]| json!({ "startLine": start, "endLine": end }))
        .collect()
}
