//! What a table of elements says: names, attributes, and the defaults of missing ones.

use glam::{DAffine3, DVec3};

use crate::form::rotation;
use crate::schema::{Category, Field, Kind, Range};
use geometry::normalise;
use scene::Transfer;

/// A category of nodes that are elements of the same name.
#[derive(Debug)]
pub(super) struct Class {
    /// The category, whose noun is the name.
    pub(super) category: Category,
    /// The attributes besides those of parameters.
    pub(super) words: &'static [Single],
    /// The kinds, named by `type`.
    pub(super) kinds: &'static [&'static Type],
    /// The kind if `type` is missing or unknown; `None` if the element is skipped.
    pub(super) otherwise: Option<&'static Type>,
    /// What becomes of an element of an unknown kind.
    pub(super) hint: &'static str,
}

/// A kind of node in its category. Types with the same word are equal.
#[derive(Debug)]
pub(super) struct Type {
    /// The word for it, mostly the value of `type`.
    pub(super) word: &'static str,
    /// Its parameters.
    pub(super) parameters: &'static [&'static Parameter],
}

impl PartialEq for Type {
    fn eq(&self, other: &Self) -> bool {
        self.word == other.word
    }
}

/// An element that sets a property of its parent.
#[derive(Debug, PartialEq)]
pub(super) struct Parameter {
    /// Its name.
    pub(super) element: &'static str,
    /// How its attributes are read.
    pub(super) reading: Attributes,
    /// The default of numbers missing in the element.
    pub(super) inside: &'static str,
    /// The defaults if the element itself is missing.
    pub(super) missing: &'static [&'static str],
    /// Its field if `value` is missing, or is the only attribute.
    pub(super) field: Field,
    /// Its field if `value` multiplies the other attributes.
    pub(super) scaled: Field,
    /// Further attributes.
    pub(super) extras: &'static [&'static Single],
    /// Whether it may have a texture.
    pub(super) may_have_texture: bool,
}

/// How an element's attributes are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Attributes {
    /// x, y, z, times `value`.
    Vector,
    /// r, g, b, times `value`.
    Colour,
    /// `value`.
    Number,
    /// An axis x, y, z and an `angle`, or `value` if that is missing.
    Rotation,
}

/// An attribute that is a field of its own.
#[derive(Debug, PartialEq)]
pub(super) struct Single {
    /// The name of the attribute.
    pub(super) attribute: &'static str,
    /// Its default.
    missing: &'static str,
    /// Its default in scenes for path tracing.
    missing_srgb: &'static str,
    /// Its field.
    pub(super) field: Field,
}

impl Single {
    /// A number.
    pub(super) const fn number(
        attribute: &'static str,
        missing: &'static str,
        field: Field,
    ) -> Self {
        Self {
            attribute,
            missing,
            missing_srgb: missing,
            field,
        }
    }

    /// A word.
    pub(super) const fn word(
        key: &'static str,
        kind: Kind,
        missing: &'static str,
        doc: &'static str,
    ) -> Self {
        let field = Field {
            kind,
            ..Field::point(key, doc)
        };
        Self::number(key, missing, field)
    }

    /// With another default in scenes for path tracing.
    pub(super) const fn srgb(self, missing_srgb: &'static str) -> Self {
        Self {
            missing_srgb,
            ..self
        }
    }

    /// Its default for this kind of scene.
    pub(super) fn missing(&self, transfer: Transfer) -> &'static str {
        match transfer {
            Transfer::Linear => self.missing,
            Transfer::Srgb => self.missing_srgb,
        }
    }
}

impl Attributes {
    /// The attributes, in order; the last one of a vector or a colour multiplies the others.
    pub(super) const fn attributes(self) -> &'static [&'static str] {
        match self {
            Self::Vector => &["x", "y", "z", "value"],
            Self::Colour => &["r", "g", "b", "value"],
            Self::Number => &["value"],
            Self::Rotation => &["x", "y", "z", "angle"],
        }
    }
}

impl Parameter {
    const fn new(
        reading: Attributes,
        inside: &'static str,
        missing: &'static [&'static str],
        field: Field,
    ) -> Self {
        let kind = match reading {
            Attributes::Vector | Attributes::Rotation => Kind::ScaledVector,
            Attributes::Colour => Kind::ScaledColour,
            Attributes::Number => field.kind,
        };
        Self {
            element: field.key,
            reading,
            inside,
            missing,
            field,
            scaled: Field { kind, ..field },
            extras: &[],
            may_have_texture: false,
        }
    }

    /// A vector.
    pub(super) const fn vector(
        element: &'static str,
        missing: &'static [&'static str; 3],
        doc: &'static str,
    ) -> Self {
        Self::new(Attributes::Vector, "0", missing, Field::point(element, doc))
    }

    /// A colour.
    pub(super) const fn colour(
        element: &'static str,
        missing: &'static [&'static str; 3],
        doc: &'static str,
    ) -> Self {
        Self::new(
            Attributes::Colour,
            "1",
            missing,
            Field::colour(element, doc),
        )
    }

    /// A number.
    pub(super) const fn number(missing: &'static [&'static str; 1], field: Field) -> Self {
        Self::new(Attributes::Number, missing[0], missing, field)
    }

    /// An axis and an angle.
    pub(super) const fn rotation(missing: &'static [&'static str; 3], field: Field) -> Self {
        let kind = Kind::Rotation;
        Self::new(Attributes::Rotation, "0", missing, Field { kind, ..field })
    }

    /// With an optional texture.
    pub(super) const fn textured(self) -> Self {
        Self {
            may_have_texture: true,
            ..self
        }
    }

    /// With further attributes.
    pub(super) const fn with(self, extras: &'static [&'static Single]) -> Self {
        Self { extras, ..self }
    }

    /// With another default of numbers missing in the element.
    pub(super) const fn bare(self, inside: &'static str) -> Self {
        Self { inside, ..self }
    }

    /// The map of a transform with this vector, or this angle about it.
    pub(super) fn matrix(&self, vector: DVec3, angle: f64) -> DAffine3 {
        match self.element {
            "scale" => DAffine3::from_scale(vector),
            "translate" => DAffine3::from_translation(vector),
            _ => {
                let turn = normalise(vector).map(|axis| rotation(axis, angle));
                turn.map_or(DAffine3::IDENTITY, DAffine3::from_mat3)
            }
        }
    }

    /// The default of an attribute missing in the element.
    pub(super) fn inside(&self, attribute: &str) -> &'static str {
        match (self.reading, attribute) {
            (Attributes::Vector | Attributes::Colour, "value") => "1",
            _ => self.inside,
        }
    }
}

/// A number of 0 or more.
pub(super) const fn at_least_0(key: &'static str, step: f64, doc: &'static str) -> Field {
    Field {
        allowed: Range::NotNegative,
        ..Field::number(key, Range::NotNegative, step, doc)
    }
}

/// A side of the picture.
pub(super) const fn side(key: &'static str, doc: &'static str) -> Field {
    Field {
        kind: Kind::Side,
        allowed: Range::Count,
        usual: Range::Count,
        step: 10.0,
        unit: "pixels",
        ..Field::point(key, doc)
    }
}
