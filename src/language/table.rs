//! What the tables of fields are made of: kinds, ranges, steps and units.
//!
//! Each language has one table of what can be said of each thing, in which order, within which range.
//! Lowering reads its grammar from it, the editor its names, ranges and steps: there is no second list
//! of what an object holds. A table knows neither text nor values.

/// What a field's numbers are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// One number.
    Number,
    /// A point: x, y, z.
    Point,
    /// A direction: x, y, z; normalised when read.
    Direction,
    /// A direction whose length counts: x, y, z.
    Axis,
    /// A colour: red, green, blue.
    Colour,
    /// Width and height, whole numbers.
    Pixels,
    /// Width or height, a whole number.
    Side,
    /// Two numbers: across and up.
    Pair,
    /// A vector and a number that multiplies it: x, y, z, value.
    ScaledVector,
    /// A colour and a number that multiplies it: red, green, blue, value.
    ScaledColour,
    /// An axis x, y, z and an angle about it.
    Rotation,
    /// A half-space: the normal x, y, z of its face, and how far along it the face is.
    HalfSpace,
    /// One of some words.
    Choice(&'static [&'static str]),
    /// The whole number by which another thing is known.
    Reference(Category),
    /// The name that another thing has.
    Name(Category),
    /// A word of the user's own.
    Word,
}

impl Kind {
    /// Whether it is of the picture's size, which no camera moves.
    pub const fn is_size(self) -> bool {
        matches!(self, Self::Pixels | Self::Side)
    }

    /// How many numbers it takes.
    pub const fn components(self) -> usize {
        match self {
            Self::Number
            | Self::Side
            | Self::Choice(_)
            | Self::Reference(_)
            | Self::Name(_)
            | Self::Word => 1,
            Self::Pixels | Self::Pair => 2,
            Self::Point | Self::Direction | Self::Axis | Self::Colour => 3,
            Self::HalfSpace | Self::ScaledVector | Self::ScaledColour | Self::Rotation => 4,
        }
    }

    /// What its numbers are called, one name a component; a single number has no name of its own.
    pub const fn component_names(self) -> &'static [&'static str] {
        match self {
            Self::Number
            | Self::Side
            | Self::Choice(_)
            | Self::Reference(_)
            | Self::Name(_)
            | Self::Word => &[""],
            Self::Pixels => &["width", "height"],
            Self::Pair => &["across", "up"],
            Self::Point | Self::Direction | Self::Axis => &["x", "y", "z"],
            Self::HalfSpace => &["x", "y", "z", "d"],
            Self::ScaledVector => &["x", "y", "z", "value"],
            Self::Rotation => &["x", "y", "z", "angle"],
            Self::Colour => &["red", "green", "blue"],
            Self::ScaledColour => &["red", "green", "blue", "value"],
        }
    }
}

/// What numbers are given to; each category has its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Category {
    /// Lights.
    Light,
    /// Materials.
    Material,
    /// Textures.
    Texture,
    /// Objects.
    Object,
}

impl Category {
    /// What one of them is called.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Material => "material",
            Self::Texture => "texture",
            Self::Object => "object",
        }
    }
}

/// Bounds of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Greater than 0.
    Positive,
    /// 0 or more.
    NotNegative,
    /// From 0 to 1, both included.
    Unit,
    /// Greater than the first, less than the second.
    Between(f64, f64),
    /// A whole number, 1 or more.
    Count,
    /// A whole number that names a thing.
    Identity,
}

impl Range {
    /// Whether `value` is within the bounds. Infinity and NaN never are.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Any => true,
                Self::Positive => 0.0 < value,
                Self::NotNegative => 0.0 <= value,
                Self::Unit => (0.0..=1.0).contains(&value),
                Self::Between(low, high) => low < value && value < high,
                Self::Count => 1.0 <= value && value.fract() == 0.0,
                Self::Identity => value.fract() == 0.0,
            }
    }

    /// The least and the greatest number within the bounds; none where not all between are.
    pub const fn ends(self) -> Option<[f64; 2]> {
        match self {
            Self::Any => Some([f64::MIN, f64::MAX]),
            Self::Positive => Some([0.0_f64.next_up(), f64::MAX]),
            Self::NotNegative => Some([0.0, f64::MAX]),
            Self::Unit => Some([0.0, 1.0]),
            Self::Between(low, high) => Some([low.next_up(), high.next_down()]),
            Self::Count | Self::Identity => None,
        }
    }

    /// The bounds as a noun: `a number greater than 0`.
    pub fn words(self) -> String {
        match self {
            Self::Any => "a number".to_owned(),
            Self::Count | Self::Identity => self.limits(),
            _ => format!("a number {}", self.limits()),
        }
    }

    /// The bounds as they follow "must be": `greater than 0`.
    pub fn limits(self) -> String {
        match self {
            Self::Any => "a number".to_owned(),
            Self::Positive => "greater than 0".to_owned(),
            Self::NotNegative => "0 or more".to_owned(),
            Self::Unit => "from 0 to 1".to_owned(),
            Self::Between(low, high) => format!("greater than {low} and less than {high}"),
            Self::Count => "a whole number, 1 or more".to_owned(),
            Self::Identity => "a whole number".to_owned(),
        }
    }
}

/// One field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// Its name, as messages and the editor say it.
    pub key: &'static str,
    /// What its numbers are.
    pub kind: Kind,
    /// Outside of this it is an error.
    pub allowed: Range,
    /// Outside of this it is a warning.
    pub usual: Range,
    /// What a number reads as that is allowed but not usual; `None` if it is used as given.
    pub reads_as: Option<f64>,
    /// What one nudge adds.
    pub step: f64,
    /// Unit, or empty.
    pub unit: &'static str,
    /// What it does, in one sentence.
    pub doc: &'static str,
}

/// Other spellings of words that are chosen from, each with the word that it stands for.
const OTHER_SPELLINGS: &[(&str, &str)] = &[("intersect", "intersection")];

/// The place among `words` of the one that is said, in any of its spellings.
pub fn place_of(words: &[&str], said: &str) -> Option<usize> {
    let other = OTHER_SPELLINGS.iter().find(|(other, _)| *other == said);
    let word = other.map_or(said, |(_, word)| word);
    words.iter().position(|&known| known == word)
}

impl Field {
    /// What each of its components is, as a noun: `a number greater than 0`.
    pub fn expected(&self) -> String {
        match self.kind {
            Kind::Choice(words) => words.join(" or "),
            Kind::Reference(category) => format!("the number of one {}", category.word()),
            Kind::Name(category) => format!("the name of one {}", category.word()),
            Kind::Word => "one word".to_owned(),
            _ => self.allowed.words(),
        }
    }

    /// As [`Field::expected`], and what is usual where more is allowed: `a number, usually from 0
    /// to 1`.
    pub fn advice(&self) -> String {
        let expected = self.expected();
        if self.usual == self.allowed {
            return expected;
        }
        format!("{expected}, usually {}", self.usual.limits())
    }

    pub(super) const fn point(key: &'static str, doc: &'static str) -> Self {
        Self {
            key,
            kind: Kind::Point,
            allowed: Range::Any,
            usual: Range::Any,
            reads_as: None,
            step: 0.1,
            unit: "",
            doc,
        }
    }

    pub(super) const fn direction(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Direction,
            step: 0.05,
            ..Self::point(key, doc)
        }
    }

    pub(super) const fn colour(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Colour,
            step: 0.05,
            ..Self::point(key, doc)
        }
    }

    pub(super) const fn size(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Number,
            allowed: Range::Positive,
            usual: Range::Positive,
            ..Self::point(key, doc)
        }
    }

    pub(super) const fn number(
        key: &'static str,
        usual: Range,
        step: f64,
        doc: &'static str,
    ) -> Self {
        Self {
            kind: Kind::Number,
            usual,
            step,
            ..Self::point(key, doc)
        }
    }

    pub(super) const fn reading_as(self, value: f64) -> Self {
        Self {
            reads_as: Some(value),
            ..self
        }
    }

    pub(super) const fn coefficients(key: &'static str, doc: &'static str) -> Self {
        Self {
            usual: Range::Unit,
            ..Self::colour(key, doc)
        }
    }
}

/// How many numbers these fields take together.
pub const fn numbers(fields: &[Field]) -> usize {
    let (mut sum, mut at) = (0, 0);
    while at < fields.len() {
        sum += fields[at].kind.components();
        at += 1;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn every_component_has_a_name() {
        for kind in [
            Kind::Number,
            Kind::Point,
            Kind::Direction,
            Kind::Axis,
            Kind::Colour,
            Kind::Pixels,
            Kind::Side,
            Kind::Pair,
            Kind::ScaledVector,
            Kind::ScaledColour,
            Kind::Rotation,
            Kind::HalfSpace,
            Kind::Choice(&["yes", "no"]),
            Kind::Reference(Category::Object),
            Kind::Name(Category::Material),
            Kind::Word,
        ] {
            assert_eq!(kind.component_names().len(), kind.components(), "{kind:?}");
        }
    }

    #[test]
    fn ranges_hold_what_their_words_say() {
        let cases: [(Range, &[f64], &[f64], &str); 7] = [
            (Range::Any, &[-1e308, 0.0], &[], "a number"),
            (
                Range::Positive,
                &[5e-324],
                &[0.0, -0.0, -1.0],
                "a number greater than 0",
            ),
            (
                Range::NotNegative,
                &[0.0, -0.0, 9.0],
                &[-5e-324],
                "a number 0 or more",
            ),
            (
                Range::Unit,
                &[0.0, 0.5, 1.0],
                &[-0.1, 1.1],
                "a number from 0 to 1",
            ),
            (
                Range::Between(0.0, 180.0),
                &[0.1, 179.9],
                &[0.0, 180.0],
                "a number greater than 0 and less than 180",
            ),
            (
                Range::Count,
                &[1.0, 1e18],
                &[0.0, 1.5, -1.0],
                "a whole number, 1 or more",
            ),
            (Range::Identity, &[-1.0, 0.0, 7.0], &[0.5], "a whole number"),
        ];
        for (range, inside, outside, words) in cases {
            assert!(inside.iter().all(|&x| range.contains(x)), "{words}");
            assert!(!outside.iter().any(|&x| range.contains(x)), "{words}");
            assert!(!range.contains(f64::NAN) && !range.contains(f64::INFINITY));
            assert_eq!(range.words(), words);
            if let Some([least, greatest]) = range.ends() {
                assert!(range.contains(least) && range.contains(greatest));
                assert!(!range.contains(least.next_down()), "{words}");
                assert!(!range.contains(greatest.next_up()), "{words}");
            }
        }
    }
}
