//! The grammar of `.ray`: ambient light, lights, objects, as the table of fields lists them.
//!
//! After an error the reader goes on where the text makes sense again: after a token that is not a
//! number at the next token, everywhere else at the next object keyword.

use std::sync::Arc;

use super::blocks;
use super::objects::nearest_kind;
use super::origins::{ObjectPlace, Origins};
use super::table::{AMBIENT, LIGHT, ShapeKind};
use super::tree::Tree;
use super::view_comment::{View, camera, find};
use crate::language::Lowered;
use crate::language::record::{Record, what};
use crate::language::report::Name;
use crate::language::report::{no_number, number, quoted};
use crate::language::table;
use crate::language::table::{Field, Range};
use crate::scene::{Light, Material, Object, Objects, Rgb, Scene, Setting, bounds};
use crate::text::{Diagnostic, Findings, Severity, Span, counted, is_integer, parse_number};

/// The most numbers that any record holds.
pub(super) const LONGEST: usize = {
    let (mut longest, mut at) = (0, 0);
    while at < ShapeKind::ALL.len() {
        let numbers = ShapeKind::ALL[at].numbers();
        if longest < numbers {
            longest = numbers;
        }
        at += 1;
    }
    longest
};

/// Numbers of the smallest object: where fewer follow a word, it does not begin an object.
pub(super) const LEAST_NUMBERS: usize = ShapeKind::Sphere.numbers();

/// Reads a scene.
pub(super) fn lower(text: &str, tree: &Tree) -> (Origins, Lowered) {
    let blocks = |report| blocks::read(text, &tree.tokens, report);
    lower_by(text, tree, blocks)
}

/// Reads a scene whose text need not be regular.
#[cfg(test)]
pub(super) fn lower_in_order(text: &str, tree: &Tree) -> (Origins, Lowered) {
    lower_by(text, tree, Err)
}

/// The errors of a text that begins with these tokens, whatever follows them.
pub(super) fn errors_of_beginning(text: &str, tree: &Tree) -> Findings {
    /// No word of the language is longer.
    const LONGEST_WORD: usize = 1 << 10;
    let mut tokens = tree.tokens.all();
    // The last one may be cut; a long one that begins with a letter is wrong whatever follows.
    let is_hopeless = |last: &mut Span| {
        LONGEST_WORD < last.len() && last.of(text).starts_with(|c: char| c.is_ascii_alphabetic())
    };
    if tokens.pop_if(|last| !is_hopeless(last)).is_none()
        && let Some(&last) = tokens.last()
    {
        let mut report = Findings::default();
        report.error(|| {
            let message = format!("a word of more than {LONGEST_WORD} bytes");
            Diagnostic::error(last, message, "a number or the type of an object")
        });
        return report;
    }
    let mut reader = Reader::new(text, &tokens, Findings::default());
    reader.is_beginning = true;
    reader.read();
    reader.report
}

/// Reads a scene by blocks, or else in order.
fn lower_by<'a>(
    text: &'a str,
    tree: &Tree,
    blocks: impl FnOnce(Findings) -> Result<(Reader<'a>, Objects, Span), Findings>,
) -> (Origins, Lowered) {
    let mut report = Findings::default();
    let view = find(text, &tree.comments, &mut report);
    let tokens: Vec<Span>;
    let (mut reader, objects, count) = match blocks(report) {
        Ok(read) => read,
        Err(report) => {
            tokens = tree.tokens.all();
            let mut reader = Reader::new(text, &tokens, report);
            let count = reader.read();
            let objects = std::mem::take(&mut reader.objects);
            (reader, objects.into_iter().collect(), count)
        }
    };
    reader.origins.view = view.as_ref().map(View::place);
    reader.origins.objects = Arc::new(std::mem::take(&mut reader.places));
    reader.origins.tokens = tree.tokens.len();
    reader.origins.comments = tree.comments.len();
    // A view that says both eye and target can be judged though the objects are not all known.
    let judged = reader.report.errors() == 0 || view.as_ref().is_some_and(View::is_placed);
    let camera = judged.then(|| {
        let bounds = || bounds(objects.iter());
        camera(view.as_ref(), bounds, count, &mut reader.report)
    });
    let camera = camera.filter(|_| reader.report.errors() == 0);
    let lowered = Lowered {
        scene: camera.map(|camera| Scene {
            camera,
            ambient: reader.ambient,
            lights: reader.lights,
            materials: reader.materials,
            textures: Vec::new(),
            objects,
            setting: Setting::default(),
        }),
        diagnostics: reader.report.sorted(),
    };
    (reader.origins, lowered)
}

/// A count as the text declares it. Nothing is ever allocated by it.
#[derive(Clone, Copy)]
pub(super) struct Count {
    pub(super) token: Span,
    pub(super) declared: u64,
}

/// The tokens before the first object.
struct Run {
    len: usize,
    /// The object's token, or `None` where the text ends first.
    object: Option<Span>,
}

/// What was read so far.
pub(super) struct Reader<'a> {
    pub(super) text: &'a str,
    pub(super) tokens: &'a [Span],
    /// Whether others follow that are not known: that the tokens end is not an error then.
    pub(super) is_beginning: bool,
    /// Index of the next token.
    pub(super) at: usize,
    pub(super) report: Findings,
    pub(super) origins: Origins,
    /// Where the objects stand.
    pub(super) places: Vec<ObjectPlace>,
    /// How many objects there are before the tokens.
    pub(super) before: usize,
    pub(super) ambient: Rgb,
    pub(super) lights: Vec<Light>,
    pub(super) materials: Vec<Material>,
    /// The first material of the present block of objects.
    pub(super) of_block: usize,
    /// How the last few materials are spelled that have nothing wrong.
    pub(super) spellings: Vec<(&'a str, u32)>,
    /// Complete up to the first error.
    pub(super) objects: Vec<Object>,
}

impl<'a> Reader<'a> {
    /// A reader of tokens.
    pub(super) fn new(text: &'a str, tokens: &'a [Span], report: Findings) -> Self {
        Self {
            text,
            tokens,
            is_beginning: false,
            at: 0,
            report,
            origins: Origins::default(),
            places: Vec::new(),
            before: 0,
            ambient: Rgb::ZERO,
            lights: Vec::new(),
            materials: Vec::new(),
            of_block: 0,
            spellings: Vec::new(),
            objects: Vec::new(),
        }
    }

    /// Reads everything; returns where the number of objects stands.
    fn read(&mut self) -> Span {
        if self.is_at_end() {
            self.report.error(|| {
                Diagnostic::error(
                    Span::at(0),
                    "the text holds no scene",
                    "ambient light: red, green and blue",
                )
                .with_hint(
                    "a scene is ambient light, the number of lights, lights, \
                     the number of objects, objects",
                )
            });
            return Span::at(0);
        }
        let count = self.header();
        self.objects(count);
        count.map_or_else(|| Span::at(0), |count| count.token)
    }

    /// Reads ambient light and lights; returns the number of objects, if it could be read. Stops
    /// at the first object.
    pub(super) fn header(&mut self) -> Option<Count> {
        let mut values = [0.0; LONGEST];
        let ambient = self.record(Name::Ambient, AMBIENT.iter(), &mut values);
        self.origins.ambient = ambient.values.len();
        if ambient.values.len() < table::numbers(AMBIENT) {
            self.short(&ambient, AMBIENT.iter());
            self.at += self.run(None).len;
            return None;
        }
        self.ambient = ambient.gather(AMBIENT.iter()).colours[0];
        let lights = self.count("nLights");
        let at_end = self.at == self.tokens.len();
        let lights_known = self.lights(lights);
        if !lights_known || (lights.is_none() && at_end) {
            return None;
        }
        self.count("nObjects")
    }

    /// Reads the lights; whether the number of objects is where it should be after them.
    fn lights(&mut self, count: Option<Count>) -> bool {
        let each = table::numbers(LIGHT);
        let due = count.map(|count| {
            usize::try_from(count.declared).map_or(usize::MAX, |lights| lights.saturating_mul(each))
        });
        let run = self.run(due.map(|due| due.saturating_add(1)));
        // The last number before the first object counts the objects, those before it are lights'.
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
            let mut values = [0.0; LONGEST];
            let name = Name::Light((self.at - first) / each);
            let light = self.record(name, LIGHT.iter(), &mut values);
            let gathered = light.gather(LIGHT.iter());
            // Without objects there is no scene for them.
            if run.object.is_some() {
                self.lights
                    .push(Light::point(gathered.points[0], gathered.colours[0]));
            }
        }
        self.origins.lights = (first, take);
        if !known {
            self.at = first + run.len;
        }
        known
    }

    /// Reports a number of lights that is not the one that follows.
    fn wrong_lights(&mut self, count: Count, numbers: usize, run: &Run) {
        let each = table::numbers(LIGHT);
        let (whole, rest) = (numbers / each, numbers % each);
        let place = match run.object {
            Some(word) => format!("before {}", quoted(word.of(self.text))),
            None => "before the text ends".to_owned(),
        };
        let rest = match rest {
            0 => String::new(),
            rest => format!(" and {}", counted(rest, "number")),
        };
        let says = quoted(count.token.of(self.text));
        let follow = format!("{}{rest}", counted(whole, "light"));
        self.report.error(|| {
            let message = format!("nLights: says {says}, but the text has {follow} {place}");
            let expected = "as many as there are lights";
            Diagnostic::error(count.token, message, expected).with_hint(format!(
                "a light takes {each} numbers: position x y z, colour red green blue"
            ))
        });
    }

    /// The tokens from here to the first object. A word that is not a keyword counts as an object at
    /// `due`, where one should begin; elsewhere it stands for a number.
    fn run(&self, due: Option<usize>) -> Run {
        let rest = &self.tokens[self.at..];
        let begins = |&offset: &usize| {
            let at = self.at + offset;
            self.begins_object(at)
                || (due == Some(offset) && is_word(self.tokens[at].of(self.text)))
        };
        let first = (0..rest.len()).find(begins);
        Run {
            len: first.unwrap_or(rest.len()),
            object: first.map(|offset| rest[offset]),
        }
    }

    /// Reads how many there are of something; `None`, and an error, if that is not said.
    fn count(&mut self, key: &str) -> Option<Count> {
        let expected = Range::Count.words();
        let Some(&token) = self.tokens.get(self.at) else {
            let end = self.end();
            if self.is_at_end() {
                self.report.error(|| {
                    let message = format!("{key}: missing, the text ends here");
                    Diagnostic::error(end, message, expected)
                });
            }
            return None;
        };
        let word = token.of(self.text);
        if self.begins_object(self.at) {
            self.report.error(|| {
                let message = format!("{key}: missing before {}", quoted(word));
                Diagnostic::error(token, message, expected)
            });
            return None;
        }
        self.at += 1;
        let problem = match parse_number(word) {
            Ok(value) if Range::Count.contains(value) && is_integer(word) => {
                // A count beyond all integers saturates: no text holds that many.
                let declared = value as u64;
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

    /// Reads the numbers of `fields` into `values` and checks them; NaN stands for a token that is
    /// no number. Stops early where an object begins or the text ends.
    pub(super) fn record<'v>(
        &mut self,
        name: Name,
        fields: impl Iterator<Item = &'static Field> + Clone,
        values: &'v mut [f64; LONGEST],
    ) -> Record<'v>
    where
        'a: 'v,
    {
        let start = self.at;
        let due = fields.clone().map(|field| field.kind.components()).sum();
        if self.numbers(&mut values[..due]) {
            self.at += due;
            let record = Record {
                name,
                values: &values[..due],
                spans: &self.tokens[start..self.at],
            };
            record.check(fields, &mut self.report);
            return record;
        }
        'fields: for field in fields.clone() {
            for component in field.kind.component_names() {
                let Some(&token) = self.tokens.get(self.at) else {
                    break 'fields;
                };
                let word = token.of(self.text);
                let what = || what(name, field, component);
                values[self.at - start] = match number(token, word, &mut self.report, what) {
                    Ok(value) => value,
                    Err(_) if self.begins_object(self.at) => break 'fields,
                    Err(error) => {
                        self.report.error(|| {
                            let expected = field.allowed.words();
                            no_number(Severity::Error, token, word, &what(), &expected, error)
                        });
                        f64::NAN
                    }
                };
                self.at += 1;
            }
        }
        let record = Record {
            name,
            values: &values[..self.at - start],
            spans: &self.tokens[start..self.at],
        };
        record.check(fields, &mut self.report);
        record
    }

    /// Reads as many numbers from here as are due; whether there are so many. Moves nowhere.
    fn numbers(&self, due: &mut [f64]) -> bool {
        let tokens = self.tokens.get(self.at..self.at + due.len());
        tokens.is_some_and(|tokens| {
            let mut pairs = due.iter_mut().zip(tokens);
            pairs.all(|(value, token)| match parse_number(token.of(self.text)) {
                Ok(number) => {
                    *value = number;
                    true
                }
                Err(_) => false,
            })
        })
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
        let next = self.tokens.get(self.at).copied();
        let end = self.end();
        self.report.error(|| {
            let what = what(record.name, field, component);
            let more = counted(due - have, "more number");
            let place = match next {
                Some(token) => format!("before {}", quoted(token.of(self.text))),
                None => "before the text ends".to_owned(),
            };
            let message = format!("{what}: missing; {more} due {place}");
            Diagnostic::error(next.unwrap_or(end), message, field.allowed.words())
        });
    }

    /// Whether an object begins at a token: at a keyword, or at a word much like one that has an
    /// object's numbers after it.
    pub(super) fn begins_object(&self, at: usize) -> bool {
        let word = self.tokens[at].of(self.text);
        ShapeKind::of_word(word).is_some()
            || (is_word(word) && self.numbers_follow(at) && nearest_kind(word).is_some())
    }

    /// Whether as many tokens follow that could be numbers as the smallest object takes.
    pub(super) fn numbers_follow(&self, at: usize) -> bool {
        self.tokens
            .get(at + 1..=at + LEAST_NUMBERS)
            .is_some_and(|follow| follow.iter().all(|token| !is_word(token.of(self.text))))
    }

    /// Whether the text ends here.
    pub(super) fn is_at_end(&self) -> bool {
        self.at == self.tokens.len() && !self.is_beginning
    }

    /// Whether the tokens end here, but not the text.
    pub(super) fn is_cut(&self) -> bool {
        self.at == self.tokens.len() && self.is_beginning
    }

    /// The empty span behind the last token.
    fn end(&self) -> Span {
        let last = self.tokens.last();
        Span::at(last.map_or(0, |token| token.end()))
    }
}

/// Whether a token is rather a word than a number gone wrong.
pub(super) fn is_word(token: &str) -> bool {
    token.chars().next().is_some_and(char::is_alphabetic)
}

/// The field, and the name of its component, that the number at `index` is.
pub(super) fn component(
    fields: impl Iterator<Item = &'static Field>,
    index: usize,
) -> Option<(&'static Field, &'static str)> {
    fields
        .flat_map(|field| {
            field
                .kind
                .component_names()
                .iter()
                .map(move |&name| (field, name))
        })
        .nth(index)
}
