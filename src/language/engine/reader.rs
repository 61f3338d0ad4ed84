//! Reads records according to the table, and reports what is wrong with them. Invalid records do not
//! affect others.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::Language;
use super::identities::{self, Unknown, kind};
use super::lines::{Lines, render_comment};
use super::places::{Place, Places};
use super::wording::{
    miscounted, missing, no_choice, no_word, other_case, unknown_kind, unknown_record,
};
use crate::node::Node;
use crate::record;
use crate::record::what;
use crate::rendering::first_comment;
use crate::report::{Name, number_of, quoted};
use crate::schema::{Category, Field, Kind, Makes, Range, Record, Repeat, Slot, fields};
use crate::words::Words;
use text::{Diagnostic, Findings, Position, Span, counted};

/// Maximum number of IDs listed in a message.
const NAMED: usize = 8;

/// A reader of the records of a text, with what it found so far.
pub(crate) struct Reader<'a, L: Language> {
    pub(crate) text: &'a str,
    pub(crate) lines: &'a Lines<L>,
    pub(crate) report: Findings,
    pub(crate) places: Places<L::Own>,
    /// The index of each node with an ID.
    ids: HashMap<(Category, i64), usize>,
    /// The smallest IDs of each category, ascending, at most [`NAMED`].
    smallest: [Vec<i64>; 4],
    /// The last record that defines each ID; computed when a message first needs it.
    definitions: OnceCell<HashMap<(Category, i64), usize>>,
    /// The uses by each node, by their records' names: indices in the places.
    used: HashMap<(usize, &'static str), usize>,
}

/// A record that was read.
pub(crate) struct Reading<'a> {
    pub(crate) record: &'static Record,
    /// Its name in messages.
    pub(crate) name: Name,
    id: Option<(i64, Span)>,
    /// The numbers of its fields, then of the repeated ones; NaN where malformed.
    values: Vec<f64>,
    /// The token of each number.
    pub(crate) spans: Vec<Span>,
    /// The count of what is repeated.
    pub(crate) count: Option<Span>,
    /// The tokens behind what was read.
    rest: Words<'a>,
    /// The indices of the nodes that it refers to.
    pub(crate) refers: [Option<usize>; 2],
    /// Whether all is there and valid.
    is_valid: bool,
}

impl Reading<'_> {
    /// Its numbers, if it is valid.
    pub(crate) fn numbers(&self) -> Option<&[f64]> {
        self.is_valid.then_some(&*self.values)
    }

    /// Its numbers if it is valid, otherwise zeros.
    pub(crate) fn numbers_or_zeros(&self) -> Cow<'_, [f64]> {
        match self.numbers() {
            Some(numbers) => Cow::Borrowed(numbers),
            None => Cow::Owned(vec![0.0; self.record.numbers()]),
        }
    }

    fn as_record(&self) -> record::Record<'_> {
        record::Record {
            name: self.name,
            values: &self.values,
            spans: &self.spans,
        }
    }
}

impl<'a, L: Language> Reader<'a, L> {
    /// A reader that has read nothing yet.
    pub(crate) fn new(text: &'a str, lines: &'a Lines<L>) -> Self {
        let mut places = Places::default();
        places.view.resize(L::SCHEMA.view().count(), None);
        Self {
            text,
            lines,
            report: Findings::default(),
            places,
            ids: HashMap::new(),
            smallest: Default::default(),
            definitions: OnceCell::new(),
            used: HashMap::new(),
        }
    }

    /// Reads the first comment with render settings; warns of those after it.
    pub(crate) fn settings(&mut self) {
        let comments = self.lines.renders.iter();
        let comments = comments.filter_map(|&line| Some((line, render_comment(self.text, line)?)));
        self.places.settings = first_comment(self.text, comments, &mut self.report);
    }

    /// Reads and checks a record and notes its place. `None` if it is of no known kind, or dropped
    /// because its ID is malformed or taken, or it uses what is not there.
    pub(crate) fn read(&mut self, at: usize) -> Option<Reading<'a>> {
        let tokens = self.lines.tokens(self.text, at);
        let record = match kind(L::SCHEMA, self.text, &tokens) {
            Ok(record) => record,
            Err(unknown) => {
                match unknown {
                    Unknown::First(first) => {
                        (self.report).warning(|| unknown_record::<L>(self.text, first));
                    }
                    Unknown::Second(first, second) => {
                        (self.report).error(|| unknown_kind::<L>(self.text, first, second));
                    }
                }
                return None;
            }
        };
        let mut rest = tokens.clone();
        let first = rest.next().unwrap_or_default();
        let others = rest.by_ref().take(record.heads.len() - 1);
        let last_head = others.last().unwrap_or(first);
        let before = match record.makes {
            Makes::View => {
                let at_view = L::SCHEMA.view().position(|view| view == record);
                at_view.and_then(|view| self.places.view[view].replace(at))
            }
            Makes::List => self.places.list.replace(at),
            _ => None,
        };
        if let Some(before) = before.filter(|_| !record.is_replaced) {
            self.warn_of_repetition(before, last_head);
        }
        let head = record.heads[0];
        let word = first.of(self.text);
        if word != head {
            self.report.warning(|| other_case(first, word, head));
        }
        let errors = self.report.errors();
        let mut read = Reading {
            record,
            name: Name::Record(record.heads[0]),
            id: None,
            values: Vec::with_capacity(record.numbers()),
            spans: Vec::with_capacity(record.numbers()),
            count: None,
            rest,
            refers: [None; 2],
            is_valid: false,
        };
        let is_complete = record.slots.iter().all(|slot| self.slot(slot, &mut read));
        read.as_record().check(record.fields(), &mut self.report);
        if !is_complete && errors == self.report.errors() {
            self.short(&tokens, &read);
        }
        let as_record = read.as_record();
        as_record.check_frame(record.fields(), &mut self.report);
        if is_complete && self.repeated(at, &mut read) {
            self.left_over(read.name, &read.rest);
        }
        self.refer(at, &mut read);
        read.is_valid = errors == self.report.errors();
        self.place(at, last_head, &read)?;
        Some(read)
    }

    /// Warns of a record that replaces the one at index `before`.
    fn warn_of_repetition(&mut self, before: usize, word: Span) {
        self.report.warning(|| {
            let line = Position::of(self.text, self.lines.span(before).start()).line;
            let message = format!("{}: already given in line {line}", word.of(self.text));
            Diagnostic::warning(word, message, "one record of this kind")
                .with_hint("the last one counts")
        });
    }

    /// Reads one slot; returns whether the line continues as expected.
    fn slot(&mut self, slot: &'static Slot, read: &mut Reading<'a>) -> bool {
        let mut after = read.rest.clone();
        let Some(token) = after.next() else {
            return false;
        };
        match slot {
            Slot::Word(due) => {
                let word = token.of(self.text);
                if word != *due {
                    let (name, record) = (read.name, read.record);
                    let error = || no_word::<L>(name, record, due, token, word);
                    self.report.error(error);
                    return false;
                }
                read.rest = after;
                true
            }
            Slot::Id => {
                let id = self.identity(token, || format!("{} ID", read.name));
                if let (Some(id), Some(category)) = (id, read.record.category()) {
                    read.id = Some((id, token));
                    read.name = name(read.record, category, (id, 0));
                }
                read.rest = after;
                true
            }
            Slot::Field(field) => self.field(field, read),
        }
    }

    fn field(&mut self, field: &'static Field, read: &mut Reading<'a>) -> bool {
        let name = read.name;
        for component in field.kind.component_names() {
            let Some(token) = read.rest.next() else {
                return false;
            };
            let word = token.of(self.text);
            let value = match field.kind {
                Kind::Choice(words) => {
                    let chosen = field.chosen(word).map(|(place, _)| place as f64);
                    chosen.unwrap_or_else(|| {
                        let error = || no_choice(name, field, words, token, word);
                        self.report.error(error);
                        f64::NAN
                    })
                }
                Kind::Reference(_) => {
                    let id = self.identity(token, || format!("{name} {}", field.key));
                    id.map_or(f64::NAN, |id| id as f64)
                }
                Kind::Word => 0.0,
                _ => {
                    let what = || what(name, field, component);
                    number_of(field, token, word, &mut self.report, what)
                }
            };
            read.values.push(value);
            read.spans.push(token);
        }
        true
    }

    /// Reads an integer ID; `None`, with an error, if it is not one.
    fn identity(&mut self, token: Span, what: impl Fn() -> String) -> Option<i64> {
        let word = token.of(self.text);
        let id = word.parse().ok();
        if id.is_none() {
            self.report.error(|| {
                let expected = Range::Identity.words();
                let message = format!("{}: must be {expected}, not {}", what(), quoted(word));
                Diagnostic::error(token, message, expected)
            });
        }
        id
    }

    /// Reads what is repeated: its count, then each. Returns whether nothing was wrong.
    fn repeated(&mut self, at: usize, read: &mut Reading<'a>) -> bool {
        let Some(repeat) = &read.record.repeat else {
            return true;
        };
        let Repeat {
            noun,
            slots,
            most,
            none,
            hint,
        } = *repeat;
        let name = read.name;
        let Some(token) = read.rest.next() else {
            self.report.error(|| {
                let message = format!("{name}: the line ends before the number of {noun}s");
                let end = Span::at(self.lines.span(at).end());
                Diagnostic::error(end, message, format!("a whole number, 0 for {none}"))
            });
            return false;
        };
        let Some(count) = self.identity(token, || format!("{name} number of {noun}s")) else {
            return false;
        };
        let each: usize = slots.iter().map(Slot::tokens).sum();
        // Up to the permitted maximum.
        let have = read.rest.clone().take(each.saturating_mul(most)).count() / each;
        let Some(count) = usize::try_from(count)
            .ok()
            .filter(|&count| count <= have.min(most))
        else {
            let shown = token.of(self.text);
            self.report
                .error(|| miscounted(name, repeat, token, shown, have).with_hint(hint));
            return false;
        };
        read.count = Some(token);
        (0..count).all(|_| {
            let first = read.values.len();
            let is_whole = slots.iter().all(|slot| self.slot(slot, read));
            let own = read.as_record().split_at(first).1;
            own.check(fields(slots), &mut self.report);
            is_whole
        })
    }

    /// Warns of surplus tokens.
    fn left_over(&mut self, name: Name, rest: &Words<'_>) {
        if let Some(first) = rest.clone().next() {
            self.report.warning(|| {
                let too_many = counted(rest.clone().count(), "token");
                let span = rest.clone().last().map_or(first, |last| first.to(last));
                let message = format!("{name}: {too_many} too many");
                Diagnostic::warning(span, message, "the end of the line")
                    .with_hint("the rest is ignored")
            });
        }
    }

    /// Reports a record that breaks off before its end.
    fn short(&mut self, tokens: &Words<'_>, read: &Reading<'_>) {
        let record = read.record;
        self.report.error(|| {
            let found = tokens.clone().count() - record.heads.len();
            let next = missing(record, found);
            let end = match tokens.clone().next().filter(|_| L::SCHEMA.is_short_at_head) {
                Some(head) => head,
                None => Span::at(tokens.clone().last().map_or(0, Span::end)),
            };
            let more = counted(record.tokens().saturating_sub(found), "more token");
            let name = read.name;
            let message = format!("{name}: the line ends where {next} is expected; {more}");
            Diagnostic::error(end, message, next)
        });
    }

    /// Finds the nodes that a record refers to.
    fn refer(&mut self, at: usize, read: &mut Reading<'_>) {
        let mut number = 0;
        let mut found = 0;
        for field in read.record.fields() {
            if let Kind::Reference(category) = field.kind {
                let span = read.spans.get(number).copied();
                let id = span.and_then(|span| span.of(self.text).parse().ok().zip(Some(span)));
                read.refers[found] =
                    id.and_then(|(id, span)| self.resolve(category, id, (at, span)));
                found += 1;
            }
            number += field.kind.components();
        }
    }

    /// The node that a reference in a record names; `None`, with an error, if it is not defined above.
    pub(crate) fn resolve(
        &mut self,
        category: Category,
        id: i64,
        (at, span): (usize, Span),
    ) -> Option<usize> {
        let found = self.ids.get(&(category, id)).copied();
        if found.is_none() {
            let (text, lines) = (self.text, self.lines);
            let definitions = &self.definitions;
            self.report.error(|| {
                let all = definitions.get_or_init(|| {
                    let all = identities::all(text, lines).into_iter();
                    let defined = all.filter(|(_, identity)| identity.is_definition);
                    defined.map(|(at, identity)| (identity.key(), at)).collect()
                });
                let is_below = all.get(&(category, id)).is_some_and(|&below| at < below);
                let word = category.word();
                let message = format!("{word} {id} is not defined above");
                let shown = self.smallest[category as usize].iter();
                let shown: Vec<_> = shown.map(ToString::to_string).collect();
                let hint = match shown.len() {
                    _ if is_below => format!("{word} {id} is defined below: it must come first"),
                    0 => format!("no {word} is defined yet: it must come first"),
                    _ => format!("defined so far: {}", shown.join(", ")),
                };
                Diagnostic::error(span, message, "the ID of one defined above").with_hint(hint)
            });
        }
        found
    }

    /// Notes the place of a record; `None` if it is dropped.
    fn place(&mut self, at: usize, word: Span, read: &Reading<'_>) -> Option<()> {
        let record = read.record;
        let mut place = Place {
            record,
            at,
            end: at,
            id: 0,
            refers: [None; 2],
        };
        let known = record.references().zip(read.refers);
        for (refers, (category, index)) in place.refers.iter_mut().zip(known) {
            *refers = index.map(|index| Node::of(category, index));
        }
        let is_whole = place.references().count() == record.references().count();
        if let Some(category) = record.category() {
            if !is_whole {
                place.refers = [None; 2];
            }
            if record.slots.iter().any(|slot| matches!(slot, Slot::Id)) {
                place.id = self.define(category, read.id?)?;
            }
            self.places.push(category, place);
        } else if let Makes::Use(category) = record.makes {
            let user = place.of(category).next()?;
            if !is_whole {
                return None;
            }
            match self.used.entry((user, record.name)) {
                Entry::Vacant(entry) => {
                    entry.insert(self.places.uses.len());
                    self.places.uses.push(place);
                }
                Entry::Occupied(entry) => {
                    let before = std::mem::replace(&mut self.places.uses[*entry.get()], place);
                    self.warn_of_repetition(before.at, word);
                }
            }
        }
        Some(())
    }

    /// Registers an ID. `None`, with a warning, if it is taken; then the record is dropped.
    fn define(&mut self, category: Category, (id, span): (i64, Span)) -> Option<i64> {
        let index = self.places.of(category).len();
        match self.ids.entry((category, id)) {
            Entry::Vacant(entry) => {
                entry.insert(index);
                let smallest = &mut self.smallest[category as usize];
                let at = smallest.partition_point(|&known| known < id);
                if at < NAMED {
                    smallest.truncate(NAMED - 1);
                    smallest.insert(at, id);
                }
                Some(id)
            }
            Entry::Occupied(_) => {
                self.report.warning(|| {
                    let word = category.word();
                    let message = format!("{word} {id}: already defined above");
                    Diagnostic::warning(span, message, "a unique ID")
                        .with_hint("this record is ignored")
                });
                None
            }
        }
    }
}

/// The name of a node, by its ID or, without one, its index: an object's tells its kind.
pub(super) fn name(record: &Record, category: Category, (id, index): (i64, usize)) -> Name {
    let kind = match category {
        // Many commands make it.
        Category::Object if record.makes == Makes::State => "mesh",
        Category::Object => record.name,
        _ => "",
    };
    let has_id = record.slots.iter().any(|slot| matches!(slot, Slot::Id));
    let number = if has_id { id } else { index as i64 + 1 };
    Name::Known(category.word(), number, kind)
}
