//! Fields: kinds, ranges, steps, units, and what their numbers are in space.

/// The kind of a field's numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A single number.
    Number,
    /// A point: x, y, z.
    Point,
    /// A direction: x, y, z; normalised when read.
    Direction,
    /// A direction whose length counts: x, y, z.
    Axis,
    /// A colour: red, green, blue.
    Colour,
    /// Width and height in pixels, integers.
    Pixels,
    /// Width or height in pixels, an integer.
    Side,
    /// Two numbers: across and up.
    Pair,
    /// A vector and a number that multiplies it: x, y, z, value.
    ScaledVector,
    /// A colour and a number that multiplies it: red, green, blue, value.
    ScaledColour,
    /// An axis x, y, z and an angle about it.
    Rotation,
    /// A half-space: the normal x, y, z of its face, and the offset of the face along it.
    HalfSpace,
    /// One of these words.
    Choice(&'static [&'static str]),
    /// The integer ID of another node.
    Reference(Category),
    /// The name of another node.
    Name(Category),
    /// A free word.
    Word,
}

impl Kind {
    /// Whether this is a size of the picture, which no camera movement changes.
    pub const fn is_size(self) -> bool {
        matches!(self, Self::Pixels | Self::Side)
    }

    /// Whether its components are numbers rather than words or IDs.
    pub const fn is_numeric(self) -> bool {
        !matches!(
            self,
            Self::Choice(_) | Self::Reference(_) | Self::Name(_) | Self::Word
        )
    }

    /// The number of components.
    pub const fn components(self) -> usize {
        self.component_names().len()
    }

    /// The names of the components; the only one of a single value has an empty name.
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

/// A category of nodes with IDs or names of its own.
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
    /// All categories, in the order of their numbers.
    pub(crate) const ALL: [Self; 4] = [Self::Light, Self::Material, Self::Texture, Self::Object];

    /// The noun for one of the category.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Light => "light",
            Self::Material => "material",
            Self::Texture => "texture",
            Self::Object => "object",
        }
    }
}

/// The least size of a solid, and the first that is too large: the squares of sizes in between, and of
/// distances some hundred times as large or small, have all their digits.
pub const SIZES: [f64; 2] = [1e-150, 1e150];

/// Bounds of a number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Range {
    /// Any finite number.
    Any,
    /// Greater than 0.
    Positive,
    /// Greater than 0, and within [`SIZES`], which is only said of numbers beyond.
    Size,
    /// 0 or more.
    NotNegative,
    /// From 0 to 1, inclusive.
    Unit,
    /// From 0, inclusive, to a number, exclusive.
    Below(f64),
    /// Between two numbers, exclusive.
    Between(f64, f64),
    /// Between two numbers, inclusive.
    Within(f64, f64),
    /// An integer, 1 or more.
    Count,
    /// An integer between two, inclusive.
    Whole(u32, u32),
    /// An integer ID.
    Identity,
}

impl Range {
    /// Whether `value` is within the bounds. Always false for infinity and NaN.
    pub fn contains(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Any => true,
                Self::Positive => 0.0 < value,
                Self::Size => (SIZES[0]..SIZES[1]).contains(&value),
                Self::NotNegative => 0.0 <= value,
                Self::Unit => (0.0..=1.0).contains(&value),
                Self::Below(high) => (0.0..high).contains(&value),
                Self::Between(low, high) => low < value && value < high,
                Self::Within(low, high) => (low..=high).contains(&value),
                Self::Whole(low, high) => {
                    (f64::from(low)..=f64::from(high)).contains(&value) && value.fract() == 0.0
                }
                Self::Count => 1.0 <= value && value.fract() == 0.0,
                Self::Identity => value.fract() == 0.0,
            }
    }

    /// Whether only integers are within the bounds.
    pub(crate) const fn is_whole(self) -> bool {
        matches!(self, Self::Count | Self::Whole(..) | Self::Identity)
    }

    /// The least and greatest number within the bounds; `None` if there are gaps between.
    pub const fn ends(self) -> Option<[f64; 2]> {
        match self {
            Self::Any => Some([f64::MIN, f64::MAX]),
            Self::Positive => Some([0.0_f64.next_up(), f64::MAX]),
            Self::Size => Some([SIZES[0], SIZES[1].next_down()]),
            Self::NotNegative => Some([0.0, f64::MAX]),
            Self::Unit => Some([0.0, 1.0]),
            Self::Below(high) => Some([0.0, high.next_down()]),
            Self::Between(low, high) => Some([low.next_up(), high.next_down()]),
            Self::Within(low, high) => Some([low, high]),
            Self::Count | Self::Whole(..) | Self::Identity => None,
        }
    }

    /// The bounds as a noun phrase: `a number greater than 0`.
    pub fn words(self) -> String {
        match self {
            Self::Any => "a number".to_owned(),
            _ if self.is_whole() => self.limits(),
            _ => format!("a number {}", self.limits()),
        }
    }

    /// As [`Range::words`], for a value that is out of bounds.
    pub fn words_against(self, value: f64) -> String {
        match self {
            Self::Size if 0.0 < value => format!("a number of {}", self.limits_against(value)),
            _ => self.words(),
        }
    }

    /// As [`Range::limits`], for a value that is out of bounds.
    pub fn limits_against(self, value: f64) -> String {
        match self {
            Self::Size if 0.0 < value => {
                let [least, beyond] = SIZES;
                format!("at least {least:e} and less than {beyond:e}")
            }
            _ => self.limits(),
        }
    }

    /// The bounds as a phrase after "must be": `greater than 0`.
    pub fn limits(self) -> String {
        match self {
            Self::Any => "a number".to_owned(),
            Self::Positive | Self::Size => "greater than 0".to_owned(),
            Self::NotNegative => "0 or more".to_owned(),
            Self::Unit => "from 0 to 1".to_owned(),
            Self::Below(high) => format!("at least 0 and less than {high}"),
            Self::Between(low, high) => format!("greater than {low} and less than {high}"),
            Self::Within(low, high) => format!("from {low} to {high}"),
            Self::Count => "a whole number, 1 or more".to_owned(),
            Self::Whole(low, high) => format!("a whole number from {low} to {high}"),
            Self::Identity => "a whole number".to_owned(),
        }
    }
}

/// A value that a text may state under a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// The name.
    pub name: &'static str,
    /// The field that it is, or part of.
    pub field: &'static Field,
    /// Which of its components.
    pub component: usize,
    /// What holds where the text omits it.
    pub default: String,
}

/// What the numbers of a field are in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// Nothing.
    None,
    /// A point of the node: the centre, or this many half edges from it along each axis.
    Point([f64; 3]),
    /// The direction of an axis of the node, by its number.
    Axis(usize),
    /// A length along these axes: this many half edges.
    Length(&'static [usize], f64),
    /// A direction that turns with the node.
    Direction,
}

/// A field of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Field {
    /// The name shown in messages and the editor.
    pub key: &'static str,
    /// The kind of its numbers.
    pub kind: Kind,
    /// The range outside of which a value is an error.
    pub allowed: Range,
    /// The range outside of which a value is a warning.
    pub usual: Range,
    /// The value used for a number that is allowed but not usual; `None` to use it as given.
    pub reads_as: Option<f64>,
    /// The increment of one nudge.
    pub step: f64,
    /// The unit, or an empty string.
    pub unit: &'static str,
    /// Alternative spellings of the words of a choice, each with the word it stands for.
    pub other_spellings: &'static [(&'static str, &'static str)],
    /// What its numbers are in space.
    pub part: Part,
    /// A description in one sentence.
    pub doc: &'static str,
}

impl Field {
    /// The index and canonical spelling of a chosen word; `None` if it is unknown.
    pub fn chosen(&self, word: &str) -> Option<(usize, &'static str)> {
        let Kind::Choice(words) = self.kind else {
            return None;
        };
        let mut others = self.other_spellings.iter();
        let other = others.find(|(other, _)| *other == word);
        let word = other.map_or(word, |(_, word)| word);
        let place = words.iter().position(|&known| known == word)?;
        Some((place, words[place]))
    }

    /// Whether it is a single number that is usually from 0 to 1.
    pub fn is_share(&self) -> bool {
        self.kind == Kind::Number && self.usual == Range::Unit
    }

    /// What each component is, as a noun phrase: `a number greater than 0`.
    pub fn expected(&self) -> String {
        match self.kind {
            Kind::Choice(words) => words.join(" or "),
            Kind::Reference(category) => format!("the number of one {}", category.word()),
            Kind::Name(category) => format!("the name of one {}", category.word()),
            Kind::Word => "one word".to_owned(),
            _ => self.allowed.words(),
        }
    }

    /// As [`Field::expected`], with the usual range where more is allowed:
    /// `a number, usually from 0 to 1`.
    pub fn advice(&self) -> String {
        let expected = self.expected();
        if self.usual == self.allowed {
            return expected;
        }
        format!("{expected}, usually {}", self.usual.limits())
    }

    /// A point in space.
    pub const fn point(key: &'static str, doc: &'static str) -> Self {
        Self {
            key,
            kind: Kind::Point,
            allowed: Range::Any,
            usual: Range::Any,
            reads_as: None,
            step: 0.1,
            unit: "",
            other_spellings: &[],
            part: Part::None,
            doc,
        }
    }

    pub(crate) const fn direction(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Direction,
            step: 0.05,
            ..Self::point(key, doc)
        }
    }

    pub(crate) const fn colour(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Colour,
            step: 0.05,
            ..Self::point(key, doc)
        }
    }

    pub(crate) const fn size(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Number,
            allowed: Range::Size,
            usual: Range::Size,
            ..Self::point(key, doc)
        }
    }

    /// A length that is not of a solid.
    pub(crate) const fn length(key: &'static str, doc: &'static str) -> Self {
        Self {
            kind: Kind::Number,
            allowed: Range::Positive,
            usual: Range::Positive,
            ..Self::point(key, doc)
        }
    }

    pub(crate) const fn number(
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

    pub(crate) const fn reading_as(self, value: f64) -> Self {
        Self {
            reads_as: Some(value),
            ..self
        }
    }

    pub(crate) const fn part(self, part: Part) -> Self {
        Self { part, ..self }
    }

    pub(crate) const fn coefficients(key: &'static str, doc: &'static str) -> Self {
        Self {
            usual: Range::Unit,
            ..Self::colour(key, doc)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_contain_what_their_words_describe() {
        let cases: [(Range, &[f64], &[f64], &str); 10] = [
            (Range::Any, &[-1e308, 0.0], &[], "a number"),
            (
                Range::Positive,
                &[5e-324],
                &[0.0, -0.0, -1.0],
                "a number greater than 0",
            ),
            (
                Range::Size,
                &[1e-150, 1.0, 9.9e149],
                &[0.0, -1.0, 9.9e-151, 1e150],
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
            (
                Range::Within(-2.0, 3.0),
                &[-2.0, 0.5, 3.0],
                &[-2.1, 3.1],
                "a number from -2 to 3",
            ),
            (
                Range::Whole(1, 9),
                &[1.0, 9.0],
                &[0.0, 1.5, 10.0],
                "a whole number from 1 to 9",
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
