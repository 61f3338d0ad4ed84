//! What kind of record a line is, which of its tokens fill which slot, and the IDs among them.

use super::Language;
use super::lines::Lines;
use crate::schema::{Category, Kind, Makes, Record, Schema, Slot};
use crate::words::Words;
use text::{Edit, Span};

/// Why a line is of no known kind.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Unknown {
    /// No record begins with this word.
    First(Span),
    /// None that begins with the first word goes on with the second, if there is one.
    Second(Span, Option<Span>),
}

/// The kind of record with these tokens. Of those that begin alike, the one with the most of its
/// words in their places.
pub(crate) fn kind(
    schema: &Schema,
    text: &str,
    tokens: &Words<'_>,
) -> Result<&'static Record, Unknown> {
    let mut rest = tokens.clone();
    let first = rest.next().unwrap_or_default();
    let word = first.of(text);
    let is_head = |record: &&Record| {
        let head = record.heads[0];
        head.len() == word.len()
            && (head == word || (schema.any_case && head.eq_ignore_ascii_case(word)))
    };
    let mut alike = schema.records.iter().copied().filter(is_head);
    let mut others = alike.clone();
    let found = others.next().ok_or(Unknown::First(first))?;
    if 1 < found.heads.len() {
        let second = rest.next();
        let is_kind =
            |record: &&Record| second.is_some_and(|second| second.of(text) == record.heads[1]);
        return alike.find(is_kind).ok_or(Unknown::Second(first, second));
    }
    if others.next().is_none() {
        return Ok(found);
    }
    let words: Vec<_> = rest.map(|token| token.of(text)).collect();
    let known = |record: &&Record| {
        let mut at = 0;
        let fits = |slot: &&Slot| {
            at += slot.tokens();
            matches!(slot, Slot::Word(due) if words.get(at - 1) == Some(due))
        };
        record.slots.iter().filter(fits).count()
    };
    // Of equal ones, the first.
    let alike: Vec<_> = alike.collect();
    Ok(alike.into_iter().rev().max_by_key(known).unwrap_or(found))
}

/// The tokens of each slot of a record, until one is incomplete. `tokens` are all of the record's.
pub(super) fn slots(
    record: &'static Record,
    text: &str,
    tokens: Words<'_>,
) -> Vec<(&'static Slot, Vec<Span>)> {
    let mut rest = tokens.skip(record.heads.len());
    let mut filled = Vec::new();
    let mut fill = |rest: &mut dyn Iterator<Item = Span>, slot: &'static Slot| {
        let spans: Vec<_> = rest.take(slot.tokens()).collect();
        let is_whole = spans.len() == slot.tokens();
        if is_whole {
            filled.push((slot, spans));
        }
        is_whole
    };
    if record.slots.iter().all(|slot| fill(&mut rest, slot))
        && let Some(repeat) = &record.repeat
    {
        let stated = rest.next().and_then(|count| count.of(text).parse().ok());
        let each: usize = repeat.slots.iter().map(Slot::tokens).sum();
        let left: Vec<_> = rest.collect();
        let have = left.len() / each;
        let count = match record.makes {
            // Its count may be wrong after a merge.
            Makes::List => have,
            _ => stated
                .filter(|&count| count <= repeat.most.min(have))
                .unwrap_or(0),
        };
        let mut left = left.into_iter();
        for slot in std::iter::repeat_n(repeat.slots, count).flatten() {
            fill(&mut left, slot);
        }
    }
    filled
}

/// An ID in a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Identity {
    /// Its token.
    pub(super) span: Span,
    pub(super) category: Category,
    pub(super) id: i64,
    /// Whether the record defines it, rather than referring to it.
    pub(super) is_definition: bool,
}

impl Identity {
    /// The category and the ID.
    pub(super) fn key(&self) -> (Category, i64) {
        (self.category, self.id)
    }

    /// The edit that replaces it.
    pub(super) fn renamed(&self, id: i64) -> Edit {
        Edit {
            span: self.span,
            text: id.to_string(),
        }
    }
}

/// The IDs in a record, in text order; none in one of no known kind.
pub(super) fn identities(schema: &Schema, text: &str, tokens: Words<'_>) -> Vec<Identity> {
    let Ok(record) = kind(schema, text, &tokens) else {
        return Vec::new();
    };
    let identity = |(slot, spans): (&Slot, Vec<Span>)| {
        let (category, is_definition) = match slot {
            Slot::Id => (record.category()?, true),
            Slot::Field(field) => match field.kind {
                Kind::Reference(category) => (category, false),
                _ => return None,
            },
            Slot::Word(_) => return None,
        };
        Some(Identity {
            span: spans[0],
            category,
            id: spans[0].of(text).parse().ok()?,
            is_definition,
        })
    };
    let slots = slots(record, text, tokens).into_iter();
    slots.filter_map(identity).collect()
}

/// The IDs in all records of a text, each with the index of its record.
pub(super) fn all<L: Language>(text: &str, lines: &Lines<L>) -> Vec<(usize, Identity)> {
    let of = |at| {
        let own = identities(L::SCHEMA, text, lines.tokens(text, at)).into_iter();
        own.map(move |identity| (at, identity))
    };
    (0..lines.records.len()).flat_map(of).collect()
}
