//! The objects of a `.ray` text, and whether they are as many as it says.

use super::lower::LONGEST;
use super::lower::{Count, LEAST_NUMBERS, Reader, component, is_word};
use glam::DVec3;

use super::origins::ObjectPlace;
use super::table::{MATERIAL, ShapeKind};
use crate::geometry::{Affine, Cone, Cuboid, Cylinder, Ellipsoid, Shape, Sphere};
use crate::language::record::{Gathered, Record};
use crate::language::report::Name;
use crate::language::report::{nearest_word, quoted};
use crate::language::table;
use crate::scene::objects::BLOCK;
use crate::scene::{Material, Object};
use crate::text::{Diagnostic, Span, counted};

/// The most materials that one is compared with. Colours come from short lists, or are all different.
const MOST_COMPARED: usize = 32;

/// The most spellings of materials that one is compared with.
const SPELLINGS: usize = 8;

/// The words an object may begin with.
const TYPES: &str = "sphere, ellipsoid, box, cylinder or cone";

impl<'a> Reader<'a> {
    /// Reads objects to the end of the text, and compares their number with the declared one.
    pub(super) fn objects(&mut self, count: Option<Count>) {
        let left = self.tokens.len() - self.at;
        let declared = count.map_or(u64::MAX, |count| count.declared);
        let holds = left / (1 + LEAST_NUMBERS);
        self.objects.reserve(holds.min(declared as usize));
        let mut seen = 0;
        // Where the text made no sense for a while, the number of objects says nothing.
        let mut lost = false;
        while let Some(&token) = self.tokens.get(self.at) {
            let word = token.of(self.text);
            let kind = ShapeKind::of_word(word);
            if kind.is_none() && seen == declared {
                self.left_over(token);
                break;
            }
            if let Some(kind) = kind {
                seen += 1;
                let complete = self.object(kind, count.filter(|count| seen <= count.declared));
                lost |= !complete && self.at == self.tokens.len();
                continue;
            }
            lost = true;
            if is_word(word) {
                seen += u64::from(self.unknown_type(token));
            } else {
                self.surplus(token);
            }
        }
        let found = self.places.len() as u64;
        if let Some(count) = count.filter(|count| count.declared < found) {
            let more = match found - count.declared {
                _ if self.is_beginning => "more objects follow".to_owned(),
                1 => "1 more object follows".to_owned(),
                more => format!("{more} more objects follow"),
            };
            self.miscounted(count, &more);
        } else if let Some(count) =
            count.filter(|count| found < count.declared && !lost && !self.is_cut())
        {
            let after = match self.places.len().checked_sub(1) {
                Some(last) => format!("after {}", object_name(&self.places, last)),
                None => "before any object".to_owned(),
            };
            self.miscounted(count, &format!("the text ends {after}"));
        }
    }

    /// Reports a number of objects that is not the one that was found.
    fn miscounted(&mut self, count: Count, truth: &str) {
        let found = self.places.len();
        let says = quoted(count.token.of(self.text));
        let message = format!("nObjects: says {says}, but {truth}");
        self.report.error(|| {
            let hint = match found {
                _ if self.is_beginning => "it counts the objects".to_owned(),
                0 => format!("an object begins with {TYPES}"),
                found => format!("there are {found}: write {found}"),
            };
            Diagnostic::error(count.token, message, "as many as there are objects").with_hint(hint)
        });
    }

    /// Reads one object; whether all its numbers are there. `count` is the number of objects, if
    /// it counts this one.
    pub(super) fn object(&mut self, kind: ShapeKind, count: Option<Count>) -> bool {
        let keyword = self.at;
        let token = self.tokens[keyword];
        let word = token.of(self.text);
        if word != kind.keyword() {
            self.report.warning(|| {
                let message = format!("{} should be in lower case", quoted(word));
                Diagnostic::warning(token, message, format!("`{}`", kind.keyword()))
                    .with_hint("other readers of the format may refuse it")
            });
        }
        self.at += 1;
        if self.objects.len().is_multiple_of(BLOCK) {
            self.of_block = self.materials.len();
        }
        let name = Name::Object(self.before + self.places.len(), kind.keyword());
        let findings = self.findings();
        let spelling = self.spelling(kind);
        let known = spelling.and_then(|spelling| self.known(spelling));
        // The numbers of a material that is known are not read again.
        let due = match known {
            Some(_) => kind.geometry().len(),
            None => kind.fields().count(),
        };
        let mut values = [0.0; LONGEST];
        let record = self.record(name, kind.fields().take(due), &mut values);
        let mut numbers = record.values.len();
        if known.is_some() && numbers == table::numbers(kind.geometry()) {
            numbers = kind.numbers();
            self.at = keyword + 1 + numbers;
        }
        self.places.push(ObjectPlace {
            token: keyword as u32,
            kind,
            numbers: numbers as u8,
        });
        record.check_frame(kind.geometry().iter(), &mut self.report);
        if numbers < kind.numbers() {
            match count {
                Some(count) if self.at == self.tokens.len() => self.cut(&record, kind, count),
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

    /// How many findings there are.
    fn findings(&self) -> usize {
        self.report.errors() + self.report.warnings()
    }

    /// The text where the material of an object has its numbers, if there are so many tokens.
    fn spelling(&self, kind: ShapeKind) -> Option<&'a str> {
        let first = self.at + table::numbers(kind.geometry());
        let last = first + table::numbers(MATERIAL) - 1;
        let span = self.tokens.get(first)?.to(*self.tokens.get(last)?);
        Some(span.of(self.text))
    }

    /// The material that is spelled like that, if it is among the last ones of its block: spelled the
    /// same it means the same. A million objects of few materials are read in half the time.
    fn known(&self, spelling: &str) -> Option<u32> {
        let first = self.first_compared();
        let mut known = self.spellings.iter().rev();
        let known = known.find(|&&(known, _)| known == spelling)?.1;
        (first <= known as usize).then_some(known)
    }

    /// Notes how a material is spelled that has nothing wrong.
    fn note(&mut self, spelling: &'a str, material: u32) {
        if self.spellings.len() == SPELLINGS {
            self.spellings.remove(0);
        }
        self.spellings.push((spelling, material));
    }

    /// Adds an object without errors to the scene. Its material is read unless it is `known`.
    fn keep(&mut self, record: Record, kind: ShapeKind, known: Option<u32>) {
        let (geometry, material) = record.split_at(table::numbers(kind.geometry()));
        let Some(shape) = shape(&geometry.gather(kind.geometry().iter()), kind) else {
            let span = geometry.spans[0].to(geometry.spans[geometry.spans.len() - 1]);
            self.report.error(|| {
                let message = format!("{}: its directions span no volume", record.name);
                Diagnostic::error(span, message, "three directions at right angles")
            });
            return;
        };
        let material = known.unwrap_or_else(|| {
            let material = material.gather(MATERIAL.iter()).material();
            self.material(Material::Phong(material))
        });
        self.objects.push(Object { shape, material });
    }

    /// The index of a material: of an equal one, if that is among the last ones of its block.
    fn material(&mut self, material: Material) -> u32 {
        let first = self.first_compared();
        let known = self.materials[first..]
            .iter()
            .rposition(|known| *known == material);
        let at = known.map_or(self.materials.len(), |known| first + known);
        if at == self.materials.len() {
            self.materials.push(material);
        }
        at as u32
    }

    /// The first of the materials that one is compared with.
    fn first_compared(&self) -> usize {
        let last = self.materials.len().saturating_sub(MOST_COMPARED);
        self.of_block.max(last)
    }

    /// Reports an object that the text's end cuts short.
    fn cut(&mut self, record: &Record, kind: ShapeKind, count: Count) {
        let Some((field, component)) = component(kind.fields(), record.values.len()) else {
            return;
        };
        if self.is_cut() {
            return;
        }
        let says = quoted(count.token.of(self.text));
        let space = if component.is_empty() { "" } else { " " };
        self.report.error(|| {
            let message = format!(
                "nObjects: says {says}, but the text ends in {}, where {}{space}{component} is due",
                record.name, field.key
            );
            Diagnostic::error(count.token, message, "as many as there are objects")
                .with_hint(takes(kind))
        });
    }

    /// Reports a word that names no type and passes over what follows it; whether that may have
    /// been an object.
    fn unknown_type(&mut self, token: Span) -> bool {
        let word = token.of(self.text);
        self.report.error(|| {
            let object = self.places.len() + 1;
            let message = format!("object {object}: unknown type {}", quoted(word));
            let diagnostic = Diagnostic::error(token, message, TYPES);
            match nearest_kind(word) {
                Some(kind) => diagnostic.with_hint(format!("did you mean `{}`?", kind.keyword())),
                None => diagnostic,
            }
        });
        self.at += 1;
        let from = self.at;
        while self.at < self.tokens.len() && !self.resumes(self.at) {
            self.at += 1;
        }
        from < self.at
    }

    /// Reports numbers that stand where an object should begin, and passes over them.
    fn surplus(&mut self, first: Span) {
        let from = self.at;
        while self.at < self.tokens.len() && !is_word(self.tokens[self.at].of(self.text)) {
            self.at += 1;
        }
        let surplus = self.at - from;
        let span = first.to(self.tokens[self.at - 1]);
        let previous = self.places.last().map(|object| object.kind);
        let is_cut = self.is_cut();
        self.report.error(|| {
            let least = if is_cut { "at least " } else { "" };
            let too_many = format!("{least}{} too many", counted(surplus, "number"));
            let message = match self.places.len().checked_sub(1) {
                Some(last) => format!("{}: {too_many}", object_name(&self.places, last)),
                None => format!("nObjects: {too_many} after it"),
            };
            let diagnostic = Diagnostic::error(span, message, TYPES);
            match previous {
                _ if LEAST_NUMBERS <= surplus => {
                    diagnostic.with_hint("is the next object's type missing?")
                }
                Some(kind) => diagnostic.with_hint(takes(kind)),
                None => {
                    diagnostic.with_hint("the first object's type follows the number of objects")
                }
            }
        });
    }

    /// Warns of text after the last object.
    fn left_over(&mut self, token: Span) {
        let word = token.of(self.text);
        let ignored = counted(self.tokens.len() - self.at, "token");
        self.report.warning(|| {
            let message = format!("{ignored} after the last object ignored");
            let diagnostic = Diagnostic::warning(token, message, "the end of the text");
            match nearest_kind(word) {
                Some(kind) => diagnostic.with_hint(format!("did you mean `{}`?", kind.keyword())),
                None => diagnostic.with_hint("`//` begins a comment"),
            }
        });
    }

    /// Whether reading can go on at a token after text that made no sense: where an object
    /// begins, of a known type or of one more that is unknown.
    fn resumes(&self, at: usize) -> bool {
        self.begins_object(at)
            || (is_word(self.tokens[at].of(self.text)) && self.numbers_follow(at))
    }
}

/// What an object is called.
fn object_name(places: &[ObjectPlace], index: usize) -> String {
    Name::Object(index, places[index].kind.keyword()).to_string()
}

/// The kind whose keyword a word is most like, if a slip or two of the hand lie between them.
pub(super) fn nearest_kind(word: &str) -> Option<ShapeKind> {
    const LONGEST: usize = 12;
    if LONGEST < word.len() || !word.is_ascii() {
        return None;
    }
    let word = word.to_ascii_lowercase();
    let keywords = ShapeKind::ALL.iter().map(|kind| kind.keyword());
    nearest_word(&word, keywords).and_then(ShapeKind::of_word)
}

/// The shape these numbers describe, or `None` if its directions span no volume.
fn shape(said: &Gathered, kind: ShapeKind) -> Option<Shape> {
    let [first, second, third, ..] = said.numbers;
    let point = said.points[0];
    let frame = || {
        let lengths = DVec3::new(first, second, third);
        Affine::new(point, said.directions, lengths)
    };
    Some(match kind {
        ShapeKind::Sphere => Shape::Sphere(Sphere {
            centre: point,
            radius: first,
        }),
        ShapeKind::Ellipsoid => Shape::Ellipsoid(Box::new(Ellipsoid(frame()?))),
        ShapeKind::Box => Shape::Cuboid(Box::new(Cuboid(frame()?))),
        ShapeKind::Cylinder => Shape::Cylinder(Box::new(Cylinder(frame()?))),
        ShapeKind::Cone => Shape::Cone(Box::new(Cone(frame()?))),
    })
}

/// How many numbers a kind of object takes, in words.
fn takes(kind: ShapeKind) -> String {
    let article = if kind == ShapeKind::Ellipsoid {
        "an"
    } else {
        "a"
    };
    let keyword = kind.keyword();
    let shape = table::numbers(kind.geometry());
    let material = kind.numbers() - shape;
    format!("{article} {keyword} takes {shape} numbers and {material} more for its material")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_typing_slip_is_known_by_its_keyword() {
        for (word, kind) in [
            ("spere", Some(ShapeKind::Sphere)),
            ("Shpere", Some(ShapeKind::Sphere)),
            ("elipsoid", Some(ShapeKind::Ellipsoid)),
            ("cilinder", Some(ShapeKind::Cylinder)),
            ("boxx", Some(ShapeKind::Box)),
            ("cones", Some(ShapeKind::Cone)),
            ("cube", None),
            ("torus", None),
            ("", None),
            ("sphère", None),
        ] {
            assert_eq!(nearest_kind(word), kind, "{word}");
        }
    }
}
