//! What may stand in a tag, whatever follows it.

use language::FileKind;
use language::schema::{Category, Kind, Named};
use language::xml::{Tag, tag_at};
use text::Span;

use super::{Choices, Item, files, values};
use crate::document::Document;

/// What may stand at an offset: the name of an element or of an attribute, or its value.
pub(super) fn at(document: &Document, at: usize) -> Option<Choices> {
    let text = document.text();
    let tag = tag_at(text, at)?;
    let is_named = |c: char| c.is_alphanumeric() || "_-.:".contains(c);
    let behind = text[at..].find(|c| !is_named(c));
    let end = behind.map_or(text.len(), |len| at + len);
    let mut choices = Choices::default();
    if at <= tag.name.end() {
        choices.span = Span::new(tag.name.start(), end);
        let elements = tag.elements.iter();
        choices.items = elements
            .map(|(name, doc)| Item::keyword(name, (*doc).to_owned()))
            .collect();
        return Some(choices);
    }
    let inside = &text[tag.name.end()..at];
    if let Some((quote, start)) = open_quote(inside) {
        let start = tag.name.end() + start;
        // The protocol replaces parts of one line.
        if text[start..at].contains(['\n', '\r']) {
            return None;
        }
        let name = text[tag.name.end()..start - 1].trim_end();
        let name = name.strip_suffix('=')?.trim_end();
        let name = name.rsplit(|c| !is_named(c)).next()?;
        let named = tag.attributes.iter().find(|known| known.name == name)?;
        // An unclosed value ends here.
        let close = text[at..]
            .find([quote, '<', '>', '\n', '\r'])
            .map(|len| at + len);
        let close = close.filter(|close| text[*close..].starts_with(quote));
        let value = Span::new(start, close.unwrap_or(at));
        if let Some(kind) = file_kind(document, &tag, named) {
            return Some(files::choices(document, (value, at), kind));
        }
        choices.span = value;
        choices.items = values(document, named, Span::new(start, at));
        return Some(choices);
    }
    let start = inside.rfind(|c| !is_named(c)).map_or(0, |at| at + 1);
    // Behind a value, only white space can precede a name.
    if !inside[..start].ends_with([' ', '\t', '\r', '\n']) {
        return None;
    }
    let whole = Span::new(tag.name.end(), end.max(tag_end(text, at)));
    let stated = attributes(whole.of(text));
    choices.span = Span::new(tag.name.end() + start, end);
    let is_free =
        |known: &&Named| known.name == choices.span.of(text) || !stated.contains(&known.name);
    choices.items = tag
        .attributes
        .iter()
        .filter(is_free)
        .map(Item::named)
        .collect();
    Some(choices)
}

/// The quote that is open at the end of a part of a tag, and where the value begins.
fn open_quote(inside: &str) -> Option<(char, usize)> {
    let mut open = None;
    for (at, c) in inside.char_indices().filter(|(_, c)| "\"'".contains(*c)) {
        open = match open {
            Some((quote, _)) if quote == c => None,
            Some(before) => Some(before),
            None => Some((c, at + 1)),
        };
    }
    open
}

/// The end of what belongs to a tag behind an offset.
fn tag_end(text: &str, at: usize) -> usize {
    text[at..]
        .find(['<', '>'])
        .map_or(text.len(), |len| at + len)
}

/// The names of the attributes in a part of a tag.
fn attributes(inside: &str) -> Vec<&str> {
    let outside = inside.split(['"', '\'']).step_by(2);
    let names = outside.filter_map(|part| part.trim_end().strip_suffix('='));
    names.map(str::trim).collect()
}

/// The kind of file that an attribute names.
fn file_kind(document: &Document, tag: &Tag, named: &Named) -> Option<FileKind> {
    if named.field.kind != Kind::Word {
        return None;
    }
    let text = document.text();
    let own = &text[tag.name.end()..tag_end(text, tag.name.end())];
    let is_mesh = ["'obj'", "\"obj\""].iter().any(|word| own.contains(word));
    match (named.name, tag.name.of(text)) {
        ("texture", _) => Some(FileKind::Picture),
        ("name", name) if is_mesh && name.eq_ignore_ascii_case(Category::Object.word()) => {
            Some(FileKind::Mesh)
        }
        _ => None,
    }
}
