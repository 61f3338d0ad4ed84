//! What a field is, and what its value means.

use language::Node;
use language::schema::{Category, Field, Kind};
use serde_json::{Value, json};
use text::Span;

use super::colours;
use super::names;
use crate::document::{Document, Place};

/// The answer to `textDocument/hover`.
pub(crate) fn at(document: &Document, at: usize) -> Value {
    let Some(place) = document.place(at) else {
        return of_node(document, at);
    };
    let field = place.field();
    let component = field.kind.component_names()[place.component];
    let space = if component.is_empty() { "" } else { " " };
    let name = called(document, place.node);
    let words = [
        Some(format!("**{name}** · `{}{space}{component}`", field.key)),
        Some(field.doc.to_owned()),
        Some(allowed(field)),
        value(document, &place),
        users(document, &place),
    ];
    let words: Vec<_> = words.into_iter().flatten().collect();
    answer(document, place.span, &words.join("\n\n"))
}

/// A node's name, comment and fields, where none of them is.
fn of_node(document: &Document, at: usize) -> Value {
    let Some(node) = document.source.node_at(Span::at(at)) else {
        return Value::Null;
    };
    let title = format!(
        "**{}**{}\n",
        called(document, node),
        comment(document, node)
    );
    let fields = document.source.fields(node).into_iter();
    let fields = fields.map(|placed| format!("- `{}` {}", placed.field.key, placed.field.doc));
    let said: Vec<_> = std::iter::once(title).chain(fields).collect();
    let span = document.source.span(node);
    let own = Some(span).filter(|span| span.touches(Span::at(at)));
    let own = own.unwrap_or_else(|| Span::at(at));
    answer(document, own, &said.join("\n"))
}

fn answer(document: &Document, span: Span, said: &str) -> Value {
    json!({
        "contents": { "kind": "markdown", "value": said },
        "range": document.range(span),
    })
}

/// The name of a node, as Markdown.
fn called(document: &Document, node: Node) -> String {
    escaped(&document.source.name(node))
}

/// The comment on a node, as Markdown behind its name; empty if there is none.
fn comment(document: &Document, node: Node) -> String {
    let comment = document.source.comment(node);
    comment.map_or_else(String::new, |comment| format!(" · {}", escaped(comment)))
}

/// Words of the text in Markdown that shows them as they are, on one line.
fn escaped(words: &str) -> String {
    let mut escaped = String::with_capacity(words.len());
    for c in words
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .chars()
    {
        // Parentheses mean nothing without brackets.
        if c.is_ascii_punctuation() && !"(),.:;/'?%@".contains(c) {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    escaped
}

/// The permitted values, with their unit.
fn allowed(field: &Field) -> String {
    match field.kind {
        Kind::Choice(words) => words.join(" · "),
        Kind::Reference(Category::Object) => "the ID of an object".to_owned(),
        Kind::Reference(category) => format!("the ID of a {}", category.word()),
        Kind::Name(category) => format!("the name of a {}", category.word()),
        Kind::Word => "a word".to_owned(),
        _ if field.unit.is_empty() => field.allowed.words(),
        _ => format!("{}, {}", field.allowed.words(), field.unit),
    }
}

/// A value in other words: a colour as it is shown, an ID or a name as what it names.
fn value(document: &Document, place: &Place) -> Option<String> {
    match place.field().kind {
        Kind::Colour => {
            let colour = colours::stated(document, &place.placed)?;
            let bytes = colour.map(|part| (part.clamp(0.0, 1.0) * 255.0).round() as u8);
            let [red, green, blue] = bytes;
            Some(format!("`#{red:02x}{green:02x}{blue:02x}`"))
        }
        Kind::Reference(_) | Kind::Name(_) => {
            let node = names::target(document, place)?;
            Some(called(document, node) + &comment(document, node))
        }
        _ => None,
    }
}

/// Who else changes with the value.
fn users(document: &Document, place: &Place) -> Option<String> {
    match document.source.users(place.node) {
        0 | 1 => None,
        count => Some(format!(
            "{} is used {count} times",
            called(document, place.node)
        )),
    }
}
