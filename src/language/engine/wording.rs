//! What is wrong with records, in words.

use super::Language;
use crate::record::what;
use crate::report::{Name, quoted};
use crate::schema::{Field, Record, Repeat, Slot};
use text::{Diagnostic, Span, counted, did_you_mean, nearest_word};

/// The most words listed as what a line may begin with.
const LISTED: usize = 12;

/// The warning for a line that begins with an unknown word.
pub(super) fn unknown_record<L: Language>(text: &str, first: Span) -> Diagnostic {
    let words = L::SCHEMA.first_words();
    let word = first.of(text);
    let noun = L::SCHEMA.noun;
    let message = format!("unknown {noun} {}: the line is skipped", quoted(word));
    let expected = if words.len() <= LISTED {
        words.join(", ")
    } else {
        format!("a known {noun}")
    };
    let diagnostic = Diagnostic::warning(first, message, expected);
    let marks = L::COMMENTS.iter().rev().map(|mark| format!("`{mark}`"));
    let marks: Vec<_> = marks.collect();
    let otherwise = format!("{} begins a comment line", marks.join(" or "));
    did_you_mean(diagnostic, nearest_word(word, words), Some(&otherwise))
}

/// The warning for a word in another case.
pub(super) fn other_case(first: Span, word: &str, head: &str) -> Diagnostic {
    let message = format!("{} should be `{head}`", quoted(word));
    Diagnostic::warning(first, message, format!("`{head}`"))
        .with_hint("other readers of the format may refuse it")
        .with_fix(first, head)
}

/// The error for a line whose second word is unknown or missing.
pub(super) fn unknown_kind<L: Language>(
    text: &str,
    first: Span,
    second: Option<Span>,
) -> Diagnostic {
    let (first_word, word) = (first.of(text), second.map_or("", |second| second.of(text)));
    let records = L::SCHEMA.records.iter();
    let alike = records.filter(|record| record.heads[0] == first_word);
    let words = alike.filter_map(|record| record.heads.get(1).copied());
    let words: Vec<_> = words.collect();
    let message = match second {
        Some(_) => format!("{first_word}: unknown kind {}", quoted(word)),
        None => format!("{first_word}: the line ends before its kind"),
    };
    let place = second.unwrap_or_else(|| Span::at(first.end()));
    let diagnostic = Diagnostic::error(place, message, words.join(", "));
    did_you_mean(diagnostic, nearest_word(word, words), None)
}

/// What is expected after a number of tokens of a record.
pub(super) fn missing(record: &Record, tokens: usize) -> String {
    let mut left = tokens;
    for slot in record.slots {
        if left < slot.tokens() {
            return match slot {
                Slot::Word(word) => format!("`{word}`"),
                Slot::Id => "a number for ID".to_owned(),
                Slot::Field(field) => match field.kind.component_names()[left] {
                    "" => field.key.to_owned(),
                    component => format!("{} {component}", field.key),
                },
            };
        }
        left -= slot.tokens();
    }
    "the end".to_owned()
}

/// The error for another word than the one that is due, or that of a record that begins alike.
pub(super) fn no_word<L: Language>(
    name: Name,
    record: &Record,
    due: &'static str,
    token: Span,
    word: &str,
) -> Diagnostic {
    let place = |slot: &Slot| matches!(slot, Slot::Word(word) if *word == due);
    let place = record.slots.iter().position(place);
    let records = L::SCHEMA.records.iter();
    let alike = records.filter(|other| other.heads == record.heads);
    let dues = alike.filter_map(|other| match other.slots.get(place?)? {
        Slot::Word(word) => Some(*word),
        _ => None,
    });
    let mut dues: Vec<_> = dues.collect();
    dues.dedup();
    if dues.is_empty() {
        dues.push(due);
    }
    let expected: Vec<_> = dues.iter().map(|due| format!("`{due}`")).collect();
    let expected = expected.join(" or ");
    let message = format!("{name}: expected {expected}, not {}", quoted(word));
    let diagnostic = Diagnostic::error(token, message, expected);
    match dues.iter().find(|due| word.eq_ignore_ascii_case(due)) {
        Some(due) => diagnostic
            .with_hint("words are case-sensitive")
            .with_fix(token, *due),
        None => diagnostic,
    }
}

/// The error for a count that is not the number of what follows.
pub(super) fn miscounted(
    name: Name,
    repeat: &Repeat,
    token: Span,
    word: &str,
    have: usize,
) -> Diagnostic {
    let Repeat {
        noun, most, none, ..
    } = repeat;
    let shown = quoted(word);
    if word.starts_with('-') {
        let message = format!("{name}: the number of {noun}s must be 0 or more");
        return Diagnostic::error(token, message, format!("a whole number, 0 for {none}"));
    }
    if *most <= have {
        let message = format!("{name}: declares {shown} {noun}s");
        return Diagnostic::error(token, message, format!("{most} at most"));
    }
    let verb = if have == 1 { "follows" } else { "follow" };
    let follow = format!("{} {verb}", counted(have, noun));
    let message = format!("{name}: declares {shown}, but {follow}");
    Diagnostic::error(token, message, "as many as there are").with_fix(token, have.to_string())
}

pub(super) fn no_choice(
    name: Name,
    field: &Field,
    words: &[&'static str],
    token: Span,
    word: &str,
) -> Diagnostic {
    let message = format!("{}: unknown word {}", what(name, field, ""), quoted(word));
    let diagnostic = Diagnostic::error(token, message, field.expected());
    did_you_mean(diagnostic, nearest_word(word, words.iter().copied()), None)
}
