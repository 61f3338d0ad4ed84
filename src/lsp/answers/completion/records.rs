//! What may stand in a record or in the comment for settings, by the tables of the language.

use std::collections::BTreeSet;

use language::schema::{Category, Field, Kind, Makes, Named, Record, Schema, Slot};
use language::{FileKind, Language, settings};
use text::{Span, line_end, line_start, parse_number};

use super::{Choices, Icon, Item, files, ids, values};
use crate::document::Document;

/// A place in a line.
#[derive(Clone, Copy)]
struct Place<'d> {
    document: &'d Document,
    schema: &'static Schema,
    /// The word there, which may be empty.
    word: Span,
    at: usize,
    /// The line before that word.
    before: &'d str,
}

/// What may stand at an offset.
pub(super) fn at(document: &Document, schema: &'static Schema, at: usize) -> Option<Choices> {
    let text = document.text();
    let start = line_start(text, at);
    let word = word_at(text, Span::new(start, line_end(text, at)), at);
    let place = Place {
        document,
        schema,
        word,
        at,
        before: &text[start..word.start()],
    };
    let is_comment = begins_comment(document, word.of(text));
    let comment = comment(document, place.before);
    match (comment, document.source.language()) {
        _ if is_comment => None,
        (Some(comment), _) => Some(place.listing(place.in_comment(comment))),
        (None, Language::Ray) => Some(place.listing(place.of_object())),
        (None, _) => Some(place.in_record()),
    }
}

/// The word at an offset of a line.
fn word_at(text: &str, line: Span, at: usize) -> Span {
    let is_blank = |c: char| c.is_whitespace() || c == '\u{FEFF}';
    let before = &text[line.start()..at];
    let blank = before.char_indices().rfind(|(_, c)| is_blank(*c));
    let start = blank.map_or(0, |(blank, c)| blank + c.len_utf8());
    let behind = text[at..line.end()].find(is_blank);
    let end = behind.map_or_else(|| line.end(), |len| at + len);
    Span::new(line.start() + start, end)
}

/// Whether a word begins a comment.
fn begins_comment(document: &Document, word: &str) -> bool {
    let marks: &[&str] = match document.source.language() {
        Language::Ray => &["//", r"\\"],
        Language::Dat => &["#", "//"],
        _ => &["#"],
    };
    marks.iter().any(|mark| word.starts_with(mark))
}

/// The comment in which a part of a line ends.
fn comment<'t>(document: &Document, before: &'t str) -> Option<&'t str> {
    let start = before.len() - before.trim_start().len();
    let mut starts = before.char_indices().map(|(at, _)| at);
    let begins = |at: &usize| {
        let may_begin = match document.source.language() {
            Language::Ray => true,
            Language::Dat => *at == start,
            _ => *at == start || before[..*at].ends_with([' ', '\t']),
        };
        may_begin && begins_comment(document, &before[*at..])
    };
    Some(&before[starts.find(begins)?..])
}

impl Place<'_> {
    fn listing(self, items: Vec<Item>) -> Choices {
        Choices {
            span: self.word,
            items,
            is_cut: false,
        }
    }

    /// The part of the word that is before the place.
    fn typed(self) -> Span {
        Span::new(self.word.start(), self.at)
    }

    fn is_begun(self) -> bool {
        !self.word.is_empty()
    }

    /// The keys and values of settings and, in `.ray`, the keys of the view.
    fn in_comment(self, comment: &str) -> Vec<Item> {
        let source = &self.document.source;
        let is_alone = comment.len() == self.before.trim_start().len();
        let is_read = is_alone || source.language() == Language::Ray;
        let content = comment.strip_prefix(source.comment_marks()[0]);
        let Some(comment) = content.filter(|_| is_read).map(str::trim_start) else {
            return Vec::new();
        };
        let views = self.schema.records.iter();
        let mut views =
            views.filter(|record| record.makes == Makes::View && record.heads.is_empty());
        let view = views.next();
        if let Some(stated) = comment.strip_prefix("render:") {
            return self.in_settings(stated);
        }
        let in_view = comment.strip_prefix("view:").zip(view);
        if let Some((stated, view)) = in_view {
            return in_view_comment(stated, view);
        }
        if !(comment.is_empty() && self.is_begun()) {
            return Vec::new();
        }
        let keys = [
            ("render:", Some("render settings")),
            ("view:", view.map(|_| "the camera")),
        ];
        let keys = keys
            .into_iter()
            .filter_map(|(key, what)| Some((key, what?)));
        keys.map(|(key, what)| Item::keyword(key, what.to_owned()))
            .collect()
    }

    fn in_settings(self, stated: &str) -> Vec<Item> {
        let all = settings();
        let words: Vec<_> = stated.split_whitespace().collect();
        let key = words
            .last()
            .and_then(|last| all.iter().find(|known| known.name == *last));
        if let Some(key) = key {
            return values(self.document, key, self.typed());
        }
        let left = all.iter().filter(|key| !words.contains(&key.name));
        left.map(Item::named).collect()
    }

    /// The words that begin an object: where a word is begun, or one may stand alone on its line.
    fn of_object(self) -> Vec<Item> {
        let is_word = parse_number(self.word.of(self.document.text())).is_err();
        let is_inside = self.document.source.node_at(self.word).is_some();
        let is_free = self.before.trim().is_empty() && !is_inside;
        let may_begin = is_free || (self.is_begun() && is_word);
        let records = self.schema.records.iter().filter(|_| may_begin);
        let solids = records.filter(|record| matches!(record.makes, Makes::Solid(_)));
        solids
            .map(|record| Item::keyword(record.heads[0], keys(record)))
            .collect()
    }

    /// The words that begin a record, or what is due in one of those that begin like this one.
    fn in_record(self) -> Choices {
        let before: Vec<_> = self.before.split_whitespace().collect();
        let is_same = |one: &str, other: &str| {
            one == other || (self.schema.any_case && one.eq_ignore_ascii_case(other))
        };
        let alike = self.schema.records.iter().copied().filter(|record| {
            let heads = record.heads.iter().zip(&before);
            heads.clone().all(|(head, word)| is_same(head, word))
        });
        let mut choices = self.listing(Vec::new());
        for record in alike {
            match record.heads.get(before.len()) {
                Some(head) => choices.items.push(Item::keyword(head, keys(record))),
                None => self.in_slots(record, &before[record.heads.len()..], &mut choices),
            }
        }
        let mut known = BTreeSet::new();
        choices.items.retain(|item| known.insert(item.word.clone()));
        choices
    }

    /// Adds what is due in a record behind the words that begin it and these others.
    fn in_slots(self, record: &'static Record, others: &[&str], choices: &mut Choices) {
        let mut left = others;
        let mut slots = record.slots.iter();
        let due = loop {
            let Some(slot) = slots.next() else {
                break repeated(record, left.len());
            };
            if left.len() < slot.tokens() {
                break Some((slot, left.len()));
            }
            if let Slot::Word(word) = slot
                && left[0] != *word
            {
                return;
            }
            left = &left[slot.tokens()..];
        };
        let is_texture = record.category() == Some(Category::Texture);
        match due {
            None => {}
            Some((Slot::Word(word), _)) => choices.items.push(Item::keyword(word, keys(record))),
            Some((Slot::Id, _)) => choices.items.extend(self.unused(record.category())),
            Some((Slot::Field(field), _)) if field.kind == Kind::Word && is_texture => {
                let place = (self.word, self.at);
                *choices = files::choices(self.document, place, FileKind::Picture);
            }
            Some((Slot::Field(field), component)) => {
                let (name, default) = (field.key, String::new());
                let named = Named {
                    name,
                    field,
                    component,
                    default,
                };
                choices
                    .items
                    .extend(values(self.document, &named, self.typed()));
            }
        }
    }

    /// An ID that nothing has.
    fn unused(self, category: Option<Category>) -> Option<Item> {
        let last = ids(self.document, category?).map(|(id, _)| id).max();
        Some(Item {
            word: last.unwrap_or(0).checked_add(1)?.to_string(),
            icon: Icon::Value,
            detail: "an unused ID".to_owned(),
            doc: "",
        })
    }
}

/// What is due in the repeated slots of a record behind so many tokens, of which the first is their count.
fn repeated(record: &'static Record, tokens: usize) -> Option<(&'static Slot, usize)> {
    let slots = record.repeat?.slots;
    let each: usize = slots.iter().map(Slot::tokens).sum();
    let mut left = tokens.checked_sub(1)? % each;
    slots.iter().find_map(|slot| {
        let own = left < slot.tokens();
        let due = own.then_some((slot, left));
        left = left.saturating_sub(slot.tokens());
        due
    })
}

/// The keys of the view that a comment does not state yet; none within the numbers of one.
fn in_view_comment(stated: &str, view: &'static Record) -> Vec<Item> {
    let words: Vec<_> = stated.split_whitespace().collect();
    let last = words
        .iter()
        .rposition(|word| view.fields().any(|field| field.key == *word));
    let is_within = last.is_some_and(|last| {
        let mut fields = view.fields();
        let field = fields.find(|field| field.key == words[last]);
        field.is_some_and(|field| words.len() - last <= field.kind.components())
    });
    let left = view
        .fields()
        .filter(|field| !is_within && !words.contains(&field.key));
    let named = |field: &'static Field| Named {
        name: field.key,
        field,
        component: 0,
        default: String::new(),
    };
    left.map(|field| Item::named(&named(field))).collect()
}

/// What follows the words that begin a record.
fn keys(record: &Record) -> String {
    let keys = record.fields().map(|field| field.key);
    keys.collect::<Vec<_>>().join(" ")
}
