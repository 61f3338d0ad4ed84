//! What may stand at a place, in texts that are still being written.

mod elements;
mod files;
mod records;

use language::schema::{Category, Field, Kind, Named};
use language::{Language, Node};
use serde_json::{Value, json};
use text::{Edit, Span};

use crate::document::Document;

/// The maximum number of names; more are narrowed down by what is typed.
const MOST: usize = 1_000;

/// What may stand in a span.
#[derive(Default)]
struct Choices {
    span: Span,
    items: Vec<Item>,
    /// Whether there may be more.
    is_cut: bool,
}

/// A word to choose.
struct Item {
    word: String,
    icon: Icon,
    /// What it is, in a phrase.
    detail: String,
    /// More about it.
    doc: &'static str,
}

/// The protocol's kinds of items, which editors show as icons.
#[derive(Clone, Copy)]
enum Icon {
    Property = 10,
    Value = 12,
    Keyword = 14,
    File = 17,
    Reference = 18,
    Folder = 19,
    EnumMember = 20,
}

/// The answer to `textDocument/completion`.
pub(crate) fn at(document: &Document, at: usize) -> Value {
    let found = match document.source.records() {
        Some(schema) => records::at(document, schema, at),
        None => elements::at(document, at),
    };
    let Choices {
        span,
        items,
        is_cut,
    } = found.unwrap_or_default();
    let item = |item: Item| {
        let text = document.source.spelled(span, &item.word).into_owned();
        let mut shown = json!({
            "label": item.word,
            "kind": item.icon as u8,
            "textEdit": document.text_edit(&Edit { span, text }),
        });
        for (key, words) in [("detail", &*item.detail), ("documentation", item.doc)] {
            if !words.is_empty() {
                shown[key] = words.into();
            }
        }
        shown
    };
    let items: Vec<_> = items.into_iter().map(item).collect();
    if is_cut || MOST <= items.len() {
        json!({ "isIncomplete": true, "items": items })
    } else {
        json!(items)
    }
}

impl Item {
    fn keyword(word: &str, detail: String) -> Self {
        Self {
            word: word.to_owned(),
            icon: Icon::Keyword,
            detail,
            doc: "",
        }
    }

    /// The name of a value.
    fn named(named: &Named) -> Self {
        Self {
            word: named.name.to_owned(),
            icon: Icon::Property,
            detail: described(named.field, named.component, &named.default),
            doc: named.field.doc,
        }
    }
}

/// A component of a field: its name, its range, its unit and its default.
fn described(field: &Field, component: usize, default: &str) -> String {
    let part = field.kind.component_names()[component];
    let name = format!("{} {part}", field.key);
    let range = match field.kind {
        Kind::Choice(words) => words.join(" or "),
        _ => field.expected(),
    };
    let mut said = format!("{}: {range}", name.trim_end());
    if !field.unit.is_empty() {
        said.extend([", ", field.unit]);
    }
    if !default.is_empty() {
        said.extend(["; default ", default]);
    }
    said
}

/// The values that a field may have, as far as they can be listed. `typed` is the part of one that is there.
fn values(document: &Document, named: &Named, typed: Span) -> Vec<Item> {
    let Named { field, default, .. } = named;
    let item = |(word, icon, detail): (String, Icon, String)| Item {
        word,
        icon,
        detail,
        doc: field.doc,
    };
    match field.kind {
        Kind::Choice(words) => {
            let detail = described(field, named.component, default);
            let words = words.iter();
            let words = words.map(|word| ((*word).to_owned(), Icon::EnumMember, detail.clone()));
            words.map(item).collect()
        }
        Kind::Reference(category) | Kind::Name(category) => {
            let mut known = names(document, category, typed.start());
            if MOST < known.len() {
                let typed = typed.of(document.text());
                known.retain(|(name, _)| name.starts_with(typed));
                known.truncate(MOST);
            }
            let named = |(word, node)| {
                let comment = document.source.comment(node).unwrap_or_default();
                let detail = format!("{} {comment}", document.source.name(node));
                (word, Icon::Reference, detail.trim_end().to_owned())
            };
            known.into_iter().map(named).map(item).collect()
        }
        _ if field.kind.is_numeric() && !default.is_empty() => {
            let detail = described(field, named.component, default);
            vec![item((default.clone(), Icon::Value, detail))]
        }
        _ => Vec::new(),
    }
}

/// The names that can be used, or the IDs defined before a place.
fn names(document: &Document, category: Category, before: usize) -> Vec<(String, Node)> {
    let source = &document.source;
    if source.language() == Language::Xml {
        return source.references(Node::View, category);
    }
    let known = ids(document, category);
    let known = known.filter(|(_, node)| source.span(*node).end() <= before);
    let mut known: Vec<_> = known.collect();
    known.sort_by_key(|(id, _)| *id);
    let literal = |(id, node): (i64, Node)| (id.to_string(), node);
    known.into_iter().map(literal).collect()
}

/// The IDs of a category.
fn ids(document: &Document, category: Category) -> impl Iterator<Item = (i64, Node)> {
    let nodes = document.source.nodes().iter();
    let own = nodes.filter(move |node| match node {
        Node::Light(_) => category == Category::Light,
        Node::Material(_) => category == Category::Material,
        Node::Texture(_) => category == Category::Texture,
        Node::Object(_) => category == Category::Object,
        _ => false,
    });
    own.filter_map(|node| Some((document.source.called(node)?.parse().ok()?, node)))
}
