//! Reads the tokens of one record according to the table of fields.

use std::borrow::Cow;

use super::Lowering;
use crate::dat::table::{Part, RecordKind};
use crate::record::{Record, what};
use crate::report::{Name, did_you_mean, number_of, quoted};
use crate::slot::At;
use crate::table::{Field, Kind, Range};
use crate::words::Words;
use text::{Diagnostic, Span, counted, nearest_word};

/// The content of a record.
pub(super) struct RecordContent<'a> {
    /// The record's name in messages.
    pub(super) name: Name,
    /// Its ID, and the place of that.
    pub(super) id: Option<(i64, Span)>,
    /// The IDs it refers to, each with the index of its number and its place.
    references: Vec<(usize, i64, Span)>,
    /// A free word.
    pub(super) word: Option<Span>,
    /// The numbers of its fields; NaN where malformed.
    values: Vec<f64>,
    /// The token of each number.
    pub(super) spans: Vec<Span>,
    /// The tokens after the parts in the table.
    pub(super) rest: Words<'a>,
    kind: RecordKind,
    /// Whether all parts in the table are there, valid or not.
    pub(super) is_complete: bool,
    /// Whether all parts are there and valid.
    pub(super) is_valid: bool,
}

impl RecordContent<'_> {
    /// Its numbers, if it is valid.
    pub(super) fn numbers(&self) -> Option<&[f64]> {
        self.is_valid.then_some(&*self.values)
    }

    /// The text of an object's shape, after its material.
    pub(super) fn span_after_material(&self) -> Span {
        let material = self.spans.first().copied().unwrap_or_default();
        let shape = self.spans.iter().skip(1).copied();
        shape.reduce(Span::to).unwrap_or(material)
    }

    /// Its numbers if it is valid, otherwise zeros.
    pub(super) fn numbers_or_zeros(&self) -> Cow<'_, [f64]> {
        match self.numbers() {
            Some(numbers) => Cow::Borrowed(numbers),
            None => Cow::Owned(vec![0.0; self.kind.numbers()]),
        }
    }

    /// The ID of the node that a field refers to; `None` if it is missing or malformed.
    pub(super) fn reference(&self, field: At<1>) -> Option<(i64, Span)> {
        let mut references = self.references.iter();
        let found = references.find(|(index, ..)| *index == field.index());
        found.map(|&(_, id, span)| (id, span))
    }

    pub(super) fn as_record(&self) -> Record<'_> {
        Record {
            name: self.name,
            values: &self.values,
            spans: &self.spans,
        }
    }
}

impl<'a> Lowering<'a> {
    /// Reads a record from all its tokens and checks it. `call` makes its name from its ID.
    pub(super) fn line(
        &mut self,
        kind: RecordKind,
        tokens: &Words<'a>,
        call: impl Fn(i64) -> Name,
    ) -> RecordContent<'a> {
        let errors = self.report.errors();
        let mut rest = tokens.clone();
        let word = rest.next().map_or("", |token| token.of(self.text));
        rest.by_ref().take(kind.heads() - 1).for_each(drop);
        let mut line = RecordContent {
            name: Name::Record(known_word(word)),
            id: None,
            references: Vec::new(),
            word: None,
            values: Vec::with_capacity(kind.numbers()),
            spans: Vec::with_capacity(kind.numbers()),
            rest,
            kind,
            is_complete: false,
            is_valid: false,
        };
        line.is_complete = kind
            .parts()
            .iter()
            .all(|part| self.part(part, &mut line, &call));
        let record = line.as_record();
        record.check(kind.fields(), &mut self.report);
        if !line.is_complete && errors == self.report.errors() {
            self.short(kind, tokens, &line);
        }
        line.is_valid = errors == self.report.errors();
        line
    }

    /// Warns of tokens after the end of a record.
    pub(super) fn surplus(&mut self, line: &RecordContent<'_>) {
        if line.is_complete {
            self.left_over(line.name, &line.rest);
        }
    }

    /// Warns of surplus tokens.
    pub(super) fn left_over(&mut self, name: Name, rest: &Words<'_>) {
        if let Some(first) = rest.clone().next() {
            self.report.warning(|| {
                let message = format!(
                    "{name}: {} too many",
                    counted(rest.clone().count(), "token")
                );
                let span = rest.clone().last().map_or(first, |last| first.to(last));
                Diagnostic::warning(span, message, "the end of the line")
                    .with_hint("the rest is ignored")
            });
        }
    }

    /// Reads one part; returns whether the line continues as expected.
    fn part(
        &mut self,
        part: &'static Part,
        line: &mut RecordContent<'a>,
        call: &impl Fn(i64) -> Name,
    ) -> bool {
        let mut after = line.rest.clone();
        let Some(token) = after.next() else {
            return false;
        };
        match part {
            Part::Word(due) => {
                let word = token.of(self.text);
                if word != *due {
                    let name = line.name;
                    self.report
                        .error(|| no_word(name, line.kind, due, token, word));
                    return false;
                }
                line.rest = after;
                true
            }
            Part::Id => {
                line.id = self.identity(token, || format!("{} ID", line.name));
                if let Some((id, _)) = line.id {
                    line.name = call(id);
                }
                line.rest = after;
                true
            }
            Part::Field(field) => self.field(field, line),
        }
    }

    fn field(&mut self, field: &'static Field, line: &mut RecordContent<'a>) -> bool {
        for component in field.kind.component_names() {
            let Some(token) = line.rest.next() else {
                return false;
            };
            let word = token.of(self.text);
            let value = match field.kind {
                Kind::Choice(words) => {
                    if let Some((place, _)) = field.chosen(word) {
                        place as f64
                    } else {
                        let name = line.name;
                        self.report
                            .error(|| no_choice(name, field, words, token, word));
                        f64::NAN
                    }
                }
                Kind::Reference(_) => {
                    let name = line.name;
                    let reference = self.identity(token, || format!("{name} {}", field.key));
                    let index = line.values.len();
                    reference.map_or(f64::NAN, |(id, span)| {
                        line.references.push((index, id, span));
                        id as f64
                    })
                }
                Kind::Word => {
                    line.word = Some(token);
                    0.0
                }
                _ => {
                    let what = || what(line.name, field, component);
                    number_of(field, token, word, &mut self.report, what)
                }
            };
            line.values.push(value);
            line.spans.push(token);
        }
        true
    }

    /// Reads an integer ID; `None`, with an error, if it is not one.
    pub(super) fn identity(
        &mut self,
        token: Span,
        what: impl Fn() -> String,
    ) -> Option<(i64, Span)> {
        let word = token.of(self.text);
        if let Ok(id) = word.parse::<i64>() {
            return Some((id, token));
        }
        self.report.error(|| {
            let expected = Range::Identity.words();
            let message = format!("{}: must be {expected}, not {}", what(), quoted(word));
            Diagnostic::error(token, message, expected)
        });
        None
    }

    /// Reports a record that breaks off before its end.
    fn short(&mut self, kind: RecordKind, tokens: &Words<'_>, line: &RecordContent<'_>) {
        self.report.error(|| {
            let due: usize = kind.heads() + kind.parts().iter().map(Part::tokens).sum::<usize>();
            let found = tokens.clone().count();
            let missing = due - found.min(due);
            let next = missing_part(kind, found - kind.heads());
            let end = Span::at(tokens.clone().last().map_or(0, Span::end));
            let more = counted(missing, "more token");
            let message = format!(
                "{}: the line ends where {next} is expected; {more}",
                line.name
            );
            Diagnostic::error(end, message, next.clone())
        });
    }
}

/// The part expected after a number of tokens of a record.
fn missing_part(kind: RecordKind, tokens: usize) -> String {
    let mut left = tokens;
    for part in kind.parts() {
        if left < part.tokens() {
            return match part {
                Part::Word(word) => format!("`{word}`"),
                Part::Id => "a number for ID".to_owned(),
                Part::Field(field) => match field.kind.component_names()[left] {
                    "" => field.key.to_owned(),
                    component => format!("{} {component}", field.key),
                },
            };
        }
        left -= part.tokens();
    }
    "the end".to_owned()
}

fn no_word(name: Name, kind: RecordKind, due: &str, token: Span, word: &str) -> Diagnostic {
    let is_pattern = matches!(kind, RecordKind::Texture(_)) && due != "ID";
    let dues: &[&str] = if is_pattern {
        &["checker", "image"]
    } else {
        &[due]
    };
    let expected: Vec<_> = dues.iter().map(|due| format!("`{due}`")).collect();
    let expected = expected.join(" or ");
    let message = format!("{name}: expected {expected}, not {}", quoted(word));
    let diagnostic = Diagnostic::error(token, message, expected);
    if dues.iter().any(|due| word.eq_ignore_ascii_case(due)) {
        diagnostic.with_hint("words are case-sensitive")
    } else {
        diagnostic
    }
}

fn no_choice(
    name: Name,
    field: &Field,
    words: &[&'static str],
    token: Span,
    word: &str,
) -> Diagnostic {
    let message = format!("{name} {}: unknown word {}", field.key, quoted(word));
    let diagnostic = Diagnostic::error(token, message, field.expected());
    did_you_mean(diagnostic, nearest_word(word, words.iter().copied()), None)
}

/// The first word of a record, as a name with static lifetime.
fn known_word(word: &str) -> &'static str {
    use crate::dat::table::RECORDS;
    let known = RECORDS.iter().find(|(known, _)| *known == word);
    known.map_or("record", |(known, _)| known)
}
