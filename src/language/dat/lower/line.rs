//! One record's tokens, read as the table of fields says.

use super::Reader;
use crate::language::dat::table::{Part, RecordKind};
use crate::language::record::{Gathered, Record, what};
use crate::language::report::Name;
use crate::language::report::{nearest_word, no_number, number, quoted};
use crate::language::table::{Field, Kind, Range, place_of};
use crate::text::{Diagnostic, Severity, Span, counted, parse_number};

/// What a record says.
pub(super) struct Line<'a> {
    /// What it is called.
    pub(super) name: Name,
    /// The number by which it is known, and where that stands.
    pub(super) id: Option<(i64, Span)>,
    /// The things it names, in order.
    pub(super) references: Vec<Option<(i64, Span)>>,
    /// A word of the user's own.
    pub(super) word: Option<Span>,
    /// The numbers of its fields: NaN for what is not a number.
    values: Vec<f64>,
    /// The token of each.
    pub(super) spans: Vec<Span>,
    /// What follows all that the table lists.
    pub(super) rest: &'a [Span],
    kind: RecordKind,
    /// Whether what the table lists is all there, right or not.
    pub(super) is_complete: bool,
    /// Whether all of it is there and right.
    pub(super) is_sound: bool,
}

impl Line<'_> {
    /// Its numbers by what they are, if it is sound.
    pub(super) fn gather(&self) -> Option<Gathered> {
        self.is_sound
            .then(|| self.as_record().gather(self.kind.fields()))
    }

    pub(super) fn as_record(&self) -> Record<'_> {
        Record {
            name: self.name,
            values: &self.values,
            spans: &self.spans,
        }
    }
}

impl<'a> Reader<'a> {
    /// Reads the tokens of a record, which `tokens` are all of, and checks them. `call` names the
    /// record by its number.
    pub(super) fn line(
        &mut self,
        kind: RecordKind,
        tokens: &'a [Span],
        call: impl Fn(i64) -> Name,
    ) -> Line<'a> {
        let errors = self.report.errors();
        let word = tokens[0].of(self.text);
        let mut line = Line {
            name: Name::Record(known_word(word)),
            id: None,
            references: Vec::new(),
            word: None,
            values: Vec::with_capacity(tokens.len()),
            spans: Vec::with_capacity(tokens.len()),
            rest: tokens.get(kind.heads()..).unwrap_or_default(),
            kind,
            is_complete: false,
            is_sound: false,
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
        line.is_sound = errors == self.report.errors();
        line
    }

    /// Warns of tokens after the end of a record.
    pub(super) fn surplus(&mut self, line: &Line<'_>) {
        if line.is_complete {
            self.left_over(line.name, line.rest);
        }
    }

    /// Warns of tokens that nothing asks for.
    pub(super) fn left_over(&mut self, name: Name, rest: &[Span]) {
        if let [first, ..] = rest {
            let span = first.to(rest[rest.len() - 1]);
            self.report.warning(|| {
                let message = format!("{name}: {} too many", counted(rest.len(), "token"));
                Diagnostic::warning(span, message, "the end of the line")
                    .with_hint("what is too much is ignored")
            });
        }
    }

    /// Reads one part; whether the line goes on as it should.
    fn part(
        &mut self,
        part: &'static Part,
        line: &mut Line<'a>,
        call: &impl Fn(i64) -> Name,
    ) -> bool {
        let Some((&token, after)) = line.rest.split_first() else {
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

    fn field(&mut self, field: &'static Field, line: &mut Line<'a>) -> bool {
        for component in field.kind.component_names() {
            let Some((&token, after)) = line.rest.split_first() else {
                return false;
            };
            let word = token.of(self.text);
            let value = match field.kind {
                Kind::Choice(words) => {
                    if let Some(place) = place_of(words, word) {
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
                    line.references.push(reference);
                    reference.map_or(f64::NAN, |(id, _)| id as f64)
                }
                Kind::Word => {
                    line.word = Some(token);
                    0.0
                }
                _ => {
                    let what = || what(line.name, field, component);
                    let read = if field.kind.is_size() {
                        parse_number(word)
                    } else {
                        number(token, word, &mut self.report, what)
                    };
                    read.unwrap_or_else(|error| {
                        let expected = field.allowed.words();
                        self.report.error(|| {
                            no_number(Severity::Error, token, word, &what(), &expected, error)
                        });
                        f64::NAN
                    })
                }
            };
            line.values.push(value);
            line.spans.push(token);
            line.rest = after;
        }
        true
    }

    /// A whole number that names something; `None`, and an error, if it is none.
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
    fn short(&mut self, kind: RecordKind, tokens: &[Span], line: &Line<'_>) {
        let due: usize = kind.heads() + kind.parts().iter().map(Part::tokens).sum::<usize>();
        let missing = due - tokens.len().min(due);
        let next = missing_part(kind, tokens.len() - kind.heads());
        let end = Span::at(tokens[tokens.len() - 1].end());
        self.report.error(|| {
            let more = counted(missing, "more token");
            let message = format!("{}: the line ends where {next} is due; {more}", line.name);
            Diagnostic::error(end, message, next.clone())
        });
    }
}

/// What is due after some tokens of a record.
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
    let message = format!("{name}: {expected} is due, not {}", quoted(word));
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
    let same = words
        .iter()
        .copied()
        .find(|known| known.eq_ignore_ascii_case(word));
    match same.or_else(|| nearest_word(word, words.iter().copied())) {
        Some(near) => diagnostic.with_hint(format!("did you mean `{near}`?")),
        None => diagnostic,
    }
}

/// The word of a record as a name that lives as long as the program.
fn known_word(word: &str) -> &'static str {
    use crate::language::dat::table::RECORDS;
    let known = RECORDS.iter().find(|(known, _)| *known == word);
    known.map_or("record", |(known, _)| known)
}
