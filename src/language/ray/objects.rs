//! Reads the objects of a `.ray` text and checks their declared number.

use std::borrow::Cow;

use super::origins::ObjectPlace;
use super::reader::{Count, LEAST_NUMBERS, Numbers, Reader, component, is_word};
use super::schema::{MATERIAL, ShapeKind};
use crate::coefficients::Coefficients;
use crate::record::{Record, what};
use crate::report::{Name, quoted};
use geometry::Shape;
use scene::blocks::BLOCK;
use scene::{Material, Object};
use text::{Diagnostic, Span, alternatives, counted, did_you_mean};

/// Number of materials a new one is compared with. Colours come from short lists, or all differ.
const MOST_COMPARED: usize = 32;

/// Number of material texts a new one is compared with.
const SPELLINGS: usize = 8;

/// The keywords of objects, for messages.
fn keywords() -> String {
    alternatives(ShapeKind::ALL.map(ShapeKind::keyword))
}

impl<'a> Reader<'a> {
    /// Reads objects to the end of the text and compares their number with the declared one.
    pub(super) fn objects(&mut self) {
        let count = self.declared;
        let left = self.tokens.end() - self.at;
        let declared = count.map_or(usize::MAX, |count| count.declared);
        let holds = left / (1 + LEAST_NUMBERS);
        self.objects.reserve(holds.min(declared));
        let mut seen = 0;
        // After text that made no sense, the number of objects cannot be checked.
        let mut lost = false;
        while let Some(token) = self.token() {
            let word = token.of(self.text);
            let kind = ShapeKind::of_word(word);
            if kind.is_none() && seen == declared {
                self.left_over(token);
                break;
            }
            if let Some(kind) = kind {
                seen += 1;
                let complete =
                    self.object(token, kind, count.filter(|count| seen <= count.declared));
                lost |= !complete && self.at == self.tokens.end();
                continue;
            }
            lost = true;
            if is_word(word) {
                seen += usize::from(self.unknown_type(token));
            } else {
                self.surplus(token);
            }
        }
        let Some(count) = count else {
            return;
        };
        let found = self.places.len();
        let truth = if count.declared < found {
            match found - count.declared {
                _ if self.is_beginning => "more objects follow".to_owned(),
                1 => "1 more object follows".to_owned(),
                more => format!("{more} more objects follow"),
            }
        } else if found < count.declared && !lost && !self.is_cut() {
            let after = self.last().map(|last| format!("after {last}"));
            let after = after.unwrap_or_else(|| "before any object".to_owned());
            format!("the text ends {after}")
        } else {
            return;
        };
        let hint = match found {
            _ if self.is_beginning => "it counts the objects".to_owned(),
            0 => format!("an object begins with {}", keywords()),
            found => format!("there are {found}: write {found}"),
        };
        self.miscounted(count, &truth, hint);
    }

    /// Reports a declared number of objects that is not true.
    fn miscounted(&mut self, count: Count, truth: &str, hint: String) {
        let declared = quoted(count.token.of(self.text));
        let message = format!("nObjects is {declared}, but {truth}");
        self.report.error(|| {
            Diagnostic::error(count.token, message, "as many as there are objects").with_hint(hint)
        });
    }

    /// Reads one object from its keyword, which is the next token; returns whether all its numbers
    /// are there. `count` is the declared number of objects, if it includes this one.
    pub(super) fn object(&mut self, token: Span, kind: ShapeKind, count: Option<Count>) -> bool {
        let keyword = self.at;
        let word = token.of(self.text);
        if word != kind.keyword() {
            self.report.warning(|| {
                let message = format!("{} should be in lower case", quoted(word));
                Diagnostic::warning(token, message, format!("`{}`", kind.keyword()))
                    .with_hint("other readers of the format may refuse it")
                    .with_fix(token, kind.keyword())
            });
        }
        self.at += 1;
        if self.materials.len() * BLOCK == self.objects.len() {
            self.materials.push(Vec::new());
            self.spellings.clear();
        }
        let name = Name::Object(self.before + self.places.len(), kind.keyword());
        let findings = self.findings();
        let spelling = self.spelling(kind);
        let known = spelling.and_then(|spelling| self.known(spelling));
        // The numbers of a known material are not read again.
        let due = match known {
            Some(_) => kind.record().slots.len(),
            None => kind.fields().count(),
        };
        let mut numbers = Numbers::default();
        let record = self.record(name, kind.fields().take(due), &mut numbers);
        let mut found = record.values.len();
        if known.is_some() && found == kind.geometry() {
            found = kind.numbers();
            self.at = keyword + 1 + found;
        }
        self.places.push(ObjectPlace {
            token: keyword as u32,
            kind,
            numbers: found as u8,
        });
        record.check_frame(kind.record().fields(), &mut self.report);
        if found < kind.numbers() {
            match count {
                Some(count) if self.at == self.tokens.end() => self.cut(&record, kind, count),
                _ => self.short(&record, kind.fields()),
            }
            return false;
        }
        if self.report.errors() == 0 {
            self.keep(record, kind, known);
            let material = self.objects.last().map(|object| object.material);
            if let (None, Some(spelling), Some(material)) = (known, spelling, material)
                && self.findings() == findings
            {
                self.note(spelling, material);
            }
        }
        true
    }

    /// The name of the last object.
    fn last(&self) -> Option<Name> {
        let last = self.places.last()?;
        Some(Name::Object(self.places.len() - 1, last.kind.keyword()))
    }

    /// The number of findings.
    fn findings(&self) -> usize {
        self.report.errors() + self.report.warnings()
    }

    /// The text of an object's material; `None` if there are too few tokens.
    fn spelling(&self, kind: ShapeKind) -> Option<&'a str> {
        let first = self.at + kind.geometry();
        let last = first + MATERIAL.numbers() - 1;
        let span = self.tokens.get(first)?.to(self.tokens.get(last)?);
        Some(span.of(self.text))
    }

    /// Returns the material with this text, if it is among the last ones of its block: the same
    /// text has the same meaning. This halves the time for a million objects with few materials.
    fn known(&self, spelling: &str) -> Option<u32> {
        let first = first_compared(self.materials.last()?);
        let mut known = self.spellings.iter().rev();
        let known = known.find(|&&(known, _)| known == spelling)?.1;
        (first <= known as usize % BLOCK).then_some(known)
    }

    /// Remembers the text of a material without findings.
    fn note(&mut self, spelling: &'a str, material: u32) {
        if self.spellings.len() == SPELLINGS {
            self.spellings.remove(0);
        }
        self.spellings.push((spelling, material));
    }

    /// Adds an object without errors to the scene. Its material is read unless it is `known`.
    fn keep(&mut self, record: Record, kind: ShapeKind, known: Option<u32>) {
        let (geometry, material) = record.split_at(kind.geometry());
        let Some(solid) = kind.layout().solid(geometry.values) else {
            let span = geometry.spans[0].to(geometry.spans[geometry.spans.len() - 1]);
            self.report.error(|| {
                let message = format!("{}: its directions are linearly dependent", record.name);
                Diagnostic::error(span, message, "three directions at right angles")
            });
            return;
        };
        let material = known.unwrap_or_else(|| {
            let material = coefficients(material.values);
            self.material(material.into())
        });
        let shape = Shape::Solid(solid);
        self.objects.push(Object { shape, material });
    }

    /// Adds a material unless an equal one is among the last ones of its block; returns its number.
    fn material(&mut self, material: Material) -> u32 {
        let before = self.blocks_before + self.materials.len().saturating_sub(1);
        let materials = self.materials.last_mut();
        let at = materials.map_or(0, |materials| numbered(materials, Cow::Owned(material)));
        (before * BLOCK + at) as u32
    }

    /// Reports an object cut short by the end of the text.
    fn cut(&mut self, record: &Record, kind: ShapeKind, count: Count) {
        let Some((field, component)) = component(kind.fields(), record.values.len()) else {
            return;
        };
        if self.is_cut() {
            return;
        }
        let next = what(Name::Record(field.key), field, component);
        let truth = format!("the text ends in {}, where {next} is expected", record.name);
        self.miscounted(count, &truth, takes(kind));
    }

    /// Reports an unknown type and skips what follows it; returns whether that may have been an
    /// object.
    fn unknown_type(&mut self, token: Span) -> bool {
        let word = token.of(self.text);
        self.report.error(|| {
            let object = self.places.len() + 1;
            let message = format!("object {object}: unknown type {}", quoted(word));
            let diagnostic = Diagnostic::error(token, message, keywords());
            did_you_mean(diagnostic, ShapeKind::nearest(word), None)
        });
        self.at += 1;
        let from = self.at;
        while self.token().is_some_and(|token| !self.resumes(token)) {
            self.at += 1;
        }
        from < self.at
    }

    /// Reports and skips numbers where an object should begin.
    fn surplus(&mut self, first: Span) {
        let from = self.at;
        let mut span = first;
        while let Some(token) = self.token().filter(|token| !is_word(token.of(self.text))) {
            span = first.to(token);
            self.at += 1;
        }
        let surplus = self.at - from;
        let previous = self.places.last().map(|object| object.kind);
        let (is_cut, last) = (self.is_cut(), self.last());
        self.report.error(|| {
            let least = if is_cut { "at least " } else { "" };
            let too_many = format!("{least}{} too many", counted(surplus, "number"));
            let message = match last {
                Some(last) => format!("{last}: {too_many}"),
                None => format!("nObjects: {too_many} after it"),
            };
            let hint = match previous {
                _ if LEAST_NUMBERS <= surplus => "is the next object's type missing?".to_owned(),
                Some(kind) => takes(kind),
                None => "the first object's type follows the number of objects".to_owned(),
            };
            Diagnostic::error(span, message, keywords()).with_hint(hint)
        });
    }

    /// Warns of text after the last object.
    fn left_over(&mut self, token: Span) {
        let word = token.of(self.text);
        let ignored = counted(self.tokens.end() - self.at, "token");
        self.report.warning(|| {
            let message = format!("ignored {ignored} after the last object");
            let diagnostic = Diagnostic::warning(token, message, "the end of the text");
            did_you_mean(
                diagnostic,
                ShapeKind::nearest(word),
                Some("`//` begins a comment"),
            )
        });
    }

    /// Whether reading can resume at the next token after text that made no sense: where an object
    /// begins, of a known type or another unknown one.
    fn resumes(&self, token: Span) -> bool {
        self.begins_object(self.at, token)
            || (is_word(token.of(self.text)) && self.numbers_follow(self.at))
    }
}

/// The index of an equal material among the last ones of a block, to which it is added if there is
/// none.
pub(super) fn numbered(materials: &mut Vec<Material>, material: Cow<'_, Material>) -> usize {
    let first = first_compared(materials);
    let mut known = materials[first..].iter();
    if let Some(known) = known.rposition(|known| *known == *material) {
        return first + known;
    }
    materials.push(material.into_owned());
    materials.len() - 1
}

/// The first material of a block to compare a new one with.
pub(super) fn first_compared(materials: &[Material]) -> usize {
    materials.len().saturating_sub(MOST_COMPARED)
}

/// The material described by these numbers.
fn coefficients(numbers: &[f64]) -> Coefficients {
    Coefficients {
        ambient: const { MATERIAL.at("ka") }.vector(numbers),
        diffuse: const { MATERIAL.at("kd") }.vector(numbers),
        specular: const { MATERIAL.at("ks") }.vector(numbers),
        exponent: const { MATERIAL.at("ns") }.number(numbers),
        reflection: const { MATERIAL.at("kr") }.number(numbers),
        transmission: const { MATERIAL.at("kt") }.number(numbers),
        index: const { MATERIAL.at("ior") }.number(numbers),
    }
}

/// Describes how many numbers a kind of object takes.
fn takes(kind: ShapeKind) -> String {
    let keyword = kind.keyword();
    let begins_with_vowel = keyword.starts_with(['a', 'e', 'i', 'o', 'u']);
    let article = if begins_with_vowel { "an" } else { "a" };
    let shape = kind.geometry();
    let material = kind.numbers() - shape;
    format!("{article} {keyword} takes {shape} numbers and {material} more for its material")
}
