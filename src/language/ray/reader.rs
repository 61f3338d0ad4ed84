//! The grammar of `.ray`: ambient light, lights, objects, according to the table of fields.
//!
//! After an error the reader resumes where the text makes sense again: after a malformed number at
//! the next token, otherwise at the next object keyword.

use std::ops::Range;

use super::origins::{ObjectPlace, Origins};
use super::schema::{AMBIENT, LIGHT, ShapeKind};
use super::tree::{Tokens, Window};
use crate::record::{Record, what};
use crate::report::{Name, no_number, number_of, quoted};
use crate::schema;
use crate::schema::Field;
use scene::{Light, Material, Object, Rgb};
use text::{Diagnostic, Findings, Severity, Span, counted, is_integer, parse_number};

/// The number of numbers of the longest objects: those with three directions.
pub(super) const LONGEST: usize = ShapeKind::Box.numbers();

/// Number of numbers of the smallest object: a word with fewer after it does not begin an object.
pub(super) const LEAST_NUMBERS: usize = ShapeKind::Sphere.numbers();

/// A declared count. Nothing is ever allocated by it.
#[derive(Clone, Copy)]
pub(super) struct Count {
    pub(super) token: Span,
    pub(super) declared: usize,
}

/// A buffer for the numbers of a record and their tokens.
#[derive(Default)]
pub(super) struct Numbers {
    values: [f64; LONGEST],
    spans: [Span; LONGEST],
    len: usize,
}

/// The tokens before the first object.
struct Run {
    len: usize,
    /// The object's token; `None` if the text ends first.
    object: Option<Span>,
}

/// A reader with its results so far.
pub(super) struct Reader<'a> {
    pub(super) text: &'a str,
    pub(super) tokens: Window<'a>,
    /// Whether the text is only a beginning, so that the end of the tokens is not an error.
    pub(super) is_beginning: bool,
    /// Index of the next token.
    pub(super) at: usize,
    pub(super) report: Findings,
    pub(super) origins: Origins,
    /// The declared number of objects, if it is readable.
    pub(super) declared: Option<Count>,
    /// The places of the objects.
    pub(super) places: Vec<ObjectPlace>,
    /// Number of objects before these tokens.
    pub(super) before: usize,
    pub(super) ambient: Rgb,
    pub(super) lights: Vec<Light>,
    /// Number of blocks of objects before these tokens.
    pub(super) blocks_before: usize,
    /// The materials of each block of objects.
    pub(super) materials: Vec<Vec<Material>>,
    /// The texts of the last few materials of the block without findings, and their numbers.
    pub(super) spellings: Vec<(&'a str, u32)>,
    /// Complete up to the first error.
    pub(super) objects: Vec<Object>,
}

impl<'a> Reader<'a> {
    /// A reader for a range of a text's tokens.
    pub(super) fn new(text: &'a str, tokens: &'a Tokens, range: Range<usize>) -> Self {
        Self {
            text,
            at: range.start,
            tokens: Window::new(tokens, range),
            is_beginning: false,
            report: Findings::default(),
            origins: Origins::default(),
            declared: None,
            places: Vec::new(),
            before: 0,
            ambient: Rgb::ZERO,
            lights: Vec::new(),
            blocks_before: 0,
            materials: Vec::new(),
            spellings: Vec::new(),
            objects: Vec::new(),
        }
    }

    /// Reads everything.
    pub(super) fn read(&mut self) {
        if self.at == self.tokens.end() && !self.is_beginning {
            self.report.error(|| {
                Diagnostic::error(
                    Span::at(0),
                    "the text contains no scene",
                    "ambient light: red, green and blue",
                )
                .with_hint(
                    "a scene is ambient light, the number of lights, lights, \
                     the number of objects, objects",
                )
            });
            return;
        }
        self.header();
        self.objects();
    }

    /// Reads ambient light, lights and the number of objects. Stops at the first object.
    pub(super) fn header(&mut self) {
        let mut numbers = Numbers::default();
        let ambient = self.record(Name::Ambient, AMBIENT.fields(), &mut numbers);
        self.origins.ambient = ambient.values.len();
        if ambient.values.len() < AMBIENT.numbers() {
            self.short(&ambient, AMBIENT.fields());
            self.at += self.run(None).len;
            return;
        }
        self.ambient = const { AMBIENT.at("colour") }.vector(ambient.values);
        let lights = self.count("nLights");
        let at_end = self.at == self.tokens.end();
        let lights_known = self.lights(lights);
        if lights_known && !(lights.is_none() && at_end) {
            self.declared = self.count("nObjects");
        }
    }

    /// Reads the lights; returns whether the number of objects follows where it should.
    fn lights(&mut self, count: Option<Count>) -> bool {
        let each = LIGHT.numbers();
        let due = count.map(|count| count.declared.saturating_mul(each));
        let run = self.run(due.map(|due| due.saturating_add(1)));
        // The last number before the first object is their count, the others belong to lights.
        let whole = run.object.is_some() && run.len % each == 1;
        let (take, known) = match due {
            Some(due) if whole && run.len - 1 != due => (run.len - 1, true),
            Some(due) if run.len < due => (run.len, false),
            Some(due) => (due, true),
            None if whole => (run.len - 1, true),
            None => (0, false),
        };
        if let (Some(count), Some(due)) = (count, due)
            && take != due
            && (run.object.is_some() || !self.is_beginning)
        {
            self.wrong_lights(count, take, &run);
        }
        let (first, end) = (self.at, self.at + take);
        while self.at < end {
            let mut numbers = Numbers::default();
            let name = Name::Light((self.at - first) / each);
            let light = self.record(name, LIGHT.fields(), &mut numbers);
            // Without objects there is no scene for them.
            if run.object.is_some() && light.values.len() == each {
                let position = const { LIGHT.at("position") }.vector(light.values);
                let colour = const { LIGHT.at("colour") }.vector(light.values);
                self.lights.push(Light::point(position, colour));
            }
        }
        self.origins.lights = (first, take);
        if !known {
            self.at = first + run.len;
        }
        known
    }

    /// Reports a declared number of lights that differs from the lights that follow.
    fn wrong_lights(&mut self, count: Count, numbers: usize, run: &Run) {
        let each = LIGHT.numbers();
        let (whole, rest) = (numbers / each, numbers % each);
        let place = before(self.text, run.object);
        let rest = match rest {
            0 => String::new(),
            rest => format!(" and {}", counted(rest, "number")),
        };
        let declared = quoted(count.token.of(self.text));
        let follow = format!("{}{rest}", counted(whole, "light"));
        self.report.error(|| {
            let message = format!("nLights is {declared}, but the text has {follow} {place}");
            let expected = "as many as there are lights";
            Diagnostic::error(count.token, message, expected).with_hint(format!(
                "a light takes {each} numbers: position x y z, colour red green blue"
            ))
        });
    }

    /// The tokens from here to the first object. A word that is not a keyword counts as an object
    /// at `due`, where one should begin; elsewhere it counts as a number.
    fn run(&self, due: Option<usize>) -> Run {
        let mut words = self.tokens.words_from(self.at);
        let begins = |&(at, token): &(usize, Span)| self.begins_object(at, token);
        let due = due.and_then(|due| {
            let at = self.at.checked_add(due)?;
            let token = self.tokens.get(at)?;
            is_word(token.of(self.text)).then_some((at, token))
        });
        let first = words.find(begins).into_iter().chain(due).min();
        Run {
            len: first.map_or_else(|| self.tokens.end(), |(at, _)| at) - self.at,
            object: first.map(|(_, token)| token),
        }
    }

    /// Reads a declared count; `None`, with an error, if there is none.
    fn count(&mut self, key: &str) -> Option<Count> {
        let expected = schema::Range::Count.words();
        let next = self.token();
        let Some(token) = next.filter(|&token| !self.begins_object(self.at, token)) else {
            let end = self.end();
            if !self.is_cut() {
                self.report.error(|| {
                    let place = match next {
                        Some(token) => format!(" before {}", quoted(token.of(self.text))),
                        None => ", the text ends here".to_owned(),
                    };
                    let message = format!("{key}: missing{place}");
                    Diagnostic::error(next.unwrap_or(end), message, expected)
                });
            }
            return None;
        };
        let word = token.of(self.text);
        self.at += 1;
        let problem = match parse_number(word) {
            Ok(value) if schema::Range::Count.contains(value) && is_integer(word) => {
                // A count beyond the integers saturates: no text holds that many.
                let declared = value as usize;
                return Some(Count { token, declared });
            }
            Ok(_) => {
                let message = format!("{key}: must be {expected}, not {}", quoted(word));
                Diagnostic::error(token, message, expected)
            }
            Err(error) => no_number(Severity::Error, token, word, key, &expected, error),
        };
        self.report.error(|| problem);
        None
    }

    /// Reads and checks the numbers of `fields`; NaN stands for a malformed number. Stops early
    /// where an object begins or the text ends.
    pub(super) fn record<'n>(
        &mut self,
        name: Name,
        fields: impl Iterator<Item = &'static Field> + Clone,
        numbers: &'n mut Numbers,
    ) -> Record<'n> {
        let due = fields.clone().map(|field| field.kind.components()).sum();
        if self.numbers(due, numbers) {
            self.at += due;
        } else {
            self.numbers_one_by_one(name, fields.clone(), numbers);
        }
        let record = Record {
            name,
            values: &numbers.values[..numbers.len],
            spans: &numbers.spans[..numbers.len],
        };
        record.check(fields, &mut self.report);
        record
    }

    /// Reads `due` numbers from here without advancing; returns whether all are well-formed.
    fn numbers(&mut self, due: usize, numbers: &mut Numbers) -> bool {
        self.tokens.slide(self.at);
        let Some(tokens) = self.tokens.ahead(self.at, due) else {
            return false;
        };
        for (value, token) in numbers.values.iter_mut().zip(tokens) {
            match parse_number(token.of(self.text)) {
                Ok(number) => *value = number,
                Err(_) => return false,
            }
        }
        numbers.spans[..due].copy_from_slice(tokens);
        numbers.len = due;
        true
    }

    /// Reads numbers one of which is malformed or missing.
    fn numbers_one_by_one(
        &mut self,
        name: Name,
        fields: impl Iterator<Item = &'static Field>,
        numbers: &mut Numbers,
    ) {
        for field in fields {
            for component in field.kind.component_names() {
                let Some(token) = self.token() else {
                    return;
                };
                if self.begins_object(self.at, token) {
                    return;
                }
                let what = || what(name, field, component);
                let value = number_of(field, token, token.of(self.text), &mut self.report, what);
                numbers.values[numbers.len] = value;
                numbers.spans[numbers.len] = token;
                numbers.len += 1;
                self.at += 1;
            }
        }
    }

    /// Reports a record that breaks off here, before an object or the end of the text.
    pub(super) fn short(
        &mut self,
        record: &Record,
        fields: impl Iterator<Item = &'static Field> + Clone,
    ) {
        let have = record.values.len();
        let Some((field, component)) = component(fields.clone(), have) else {
            return;
        };
        if self.is_cut() {
            return;
        }
        let due: usize = fields.map(|field| field.kind.components()).sum();
        let next = self.token();
        let end = self.end();
        self.report.error(|| {
            let what = what(record.name, field, component);
            let more = counted(due - have, "more number");
            let place = before(self.text, next);
            let message = format!("{what}: missing; {more} expected {place}");
            Diagnostic::error(next.unwrap_or(end), message, field.allowed.words())
        });
    }

    /// Whether an object begins at a token: a keyword, or a similar word followed by an object's
    /// numbers.
    pub(super) fn begins_object(&self, at: usize, token: Span) -> bool {
        let word = token.of(self.text);
        ShapeKind::of_word(word).is_some()
            || (is_word(word) && self.numbers_follow(at) && ShapeKind::nearest(word).is_some())
    }

    /// Whether enough tokens for the smallest object follow that could be numbers.
    pub(super) fn numbers_follow(&self, at: usize) -> bool {
        let is_number = |token: Span| !is_word(token.of(self.text));
        (at + 1..=at + LEAST_NUMBERS).all(|at| self.tokens.get(at).is_some_and(is_number))
    }

    /// The next token.
    pub(super) fn token(&mut self) -> Option<Span> {
        self.tokens.slide(self.at);
        self.tokens.get(self.at)
    }

    /// Whether the tokens end here but the text goes on.
    pub(super) fn is_cut(&self) -> bool {
        self.at == self.tokens.end() && self.is_beginning
    }

    /// The empty span after the last token.
    fn end(&self) -> Span {
        let last = self.tokens.end().checked_sub(1);
        let last = last.and_then(|last| self.tokens.get(last));
        Span::at(last.map_or(0, Span::end))
    }
}

/// Says before what something ends.
fn before(text: &str, token: Option<Span>) -> String {
    match token {
        Some(token) => format!("before {}", quoted(token.of(text))),
        None => "before the text ends".to_owned(),
    }
}

/// Whether a token is a word rather than a malformed number.
pub(super) fn is_word(token: &str) -> bool {
    token.chars().next().is_some_and(char::is_alphabetic)
}

/// The field and the component name of the number at `index`.
pub(super) fn component(
    fields: impl Iterator<Item = &'static Field>,
    index: usize,
) -> Option<(&'static Field, &'static str)> {
    let mut components = fields.flat_map(|field| {
        let names = field.kind.component_names().iter();
        names.map(move |&name| (field, name))
    });
    components.nth(index)
}
