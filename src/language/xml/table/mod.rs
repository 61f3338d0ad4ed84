//! The table of fields of `.xml`: the names of elements, their attributes, and the defaults of
//! missing ones.

pub(super) mod camera;
mod kinds;
pub(super) mod lights;
pub(super) mod materials;

use crate::schema::{Category, Field, Kind, Range};
pub(super) use kinds::{LightKind, MaterialKind, ObjectKind};
use scene::Transfer;

/// An element that sets a property of its parent.
#[derive(Debug, PartialEq)]
pub(super) struct Parameter {
    /// Its name.
    pub element: &'static str,
    /// How its attributes are read.
    pub reading: Attributes,
    /// The default of numbers missing in the element.
    pub inside: &'static str,
    /// The defaults if the element itself is missing.
    pub missing: &'static [&'static str],
    /// Its field if `value` is missing, or is the only attribute.
    pub field: Field,
    /// Its field if `value` multiplies the other attributes.
    pub scaled: Field,
    /// Further attributes, each a field of its own.
    pub extras: &'static [&'static Extra],
    /// Whether it may have a texture.
    pub texture: Texturing,
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

/// A further number of an element.
#[derive(Debug, PartialEq)]
pub(super) struct Extra {
    /// The name of the attribute.
    pub attribute: &'static str,
    /// Its default.
    pub missing: &'static str,
    /// Its default in scenes for path tracing.
    pub missing_srgb: &'static str,
    /// Its field.
    pub field: Field,
}

impl Extra {
    /// Its default for this kind of scene.
    pub(super) fn missing(&self, transfer: Transfer) -> &'static str {
        match transfer {
            Transfer::Linear => self.missing,
            Transfer::Srgb => self.missing_srgb,
        }
    }
}

/// An attribute whose value is a word.
#[derive(Debug, PartialEq)]
pub(super) struct Word {
    /// Its field; the key is the attribute's name.
    pub field: Field,
    /// Its default.
    pub missing: &'static str,
}

/// Whether an element may have a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Texturing {
    /// No texture.
    No,
    /// An optional texture.
    Yes,
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
    const fn vector(
        element: &'static str,
        missing: &'static [&'static str; 3],
        doc: &'static str,
    ) -> Self {
        let field = Field::point(element, doc);
        Self {
            element,
            reading: Attributes::Vector,
            inside: "0",
            missing,
            field,
            scaled: Field {
                kind: Kind::ScaledVector,
                ..field
            },
            extras: &[],
            texture: Texturing::No,
        }
    }

    const fn colour(
        element: &'static str,
        missing: &'static [&'static str; 3],
        doc: &'static str,
    ) -> Self {
        let field = Field::colour(element, doc);
        Self {
            element,
            reading: Attributes::Colour,
            inside: "1",
            missing,
            field,
            scaled: Field {
                kind: Kind::ScaledColour,
                ..field
            },
            extras: &[],
            texture: Texturing::No,
        }
    }

    const fn number(field: Field, missing: &'static [&'static str; 1]) -> Self {
        Self {
            element: field.key,
            reading: Attributes::Number,
            inside: missing[0],
            missing,
            field,
            scaled: field,
            extras: &[],
            texture: Texturing::No,
        }
    }

    const fn textured(self) -> Self {
        Self {
            texture: Texturing::Yes,
            ..self
        }
    }

    const fn with(self, extras: &'static [&'static Extra]) -> Self {
        Self { extras, ..self }
    }

    const fn bare(self, inside: &'static str) -> Self {
        Self { inside, ..self }
    }

    /// The default of an attribute missing in the element.
    pub(super) fn inside(&self, attribute: &str) -> &'static str {
        match (self.reading, attribute) {
            (Attributes::Vector | Attributes::Colour, "value") => "1",
            _ => self.inside,
        }
    }
}

const ZERO: &[&str; 3] = &["0", "0", "0"];
const HALF: &[&str; 3] = &["0.5", "0.5", "0.5"];
const ONE: &[&str; 3] = &["1", "1", "1"];

const fn at_least_0(key: &'static str, step: f64, doc: &'static str) -> Field {
    Field {
        allowed: Range::NotNegative,
        ..Field::number(key, Range::NotNegative, step, doc)
    }
}

/// The background seen by camera rays.
pub(super) static BACKGROUND: Parameter = Parameter::colour(
    "background",
    ZERO,
    "What the camera sees behind everything.",
)
.textured();

/// The background seen by all other rays.
pub(super) static ENVIRONMENT: Parameter = Parameter::colour(
    "environment",
    ZERO,
    "What reflected and refracted rays see behind everything.",
)
.textured();

/// The transforms, applied in the order of the text.
pub(super) const TRANSFORMS: &[&Parameter] = &[&SCALE, &ROTATE, &TRANSLATE];

pub(super) static SCALE: Parameter = Parameter {
    inside: "1",
    ..Parameter::vector("scale", ONE, "The scale factor along each axis.")
};

pub(super) static ROTATE: Parameter = Parameter {
    reading: Attributes::Rotation,
    field: Field {
        kind: Kind::Rotation,
        ..Field::point("rotate", "The axis it is turned about, and how far.")
    },
    ..Parameter::vector("rotate", ZERO, "The axis it is turned about, and how far.")
};

pub(super) static TRANSLATE: Parameter =
    Parameter::vector("translate", ZERO, "How far it is moved.");

/// The parameters of a checkerboard besides transforms: the colours of its squares, first those at
/// uv 0, 0.
pub(super) const CHECKER: &[&Parameter; 2] = &[&FIRST_SQUARES, &SECOND_SQUARES];

static FIRST_SQUARES: Parameter =
    Parameter::colour("color1", ZERO, "The squares at uv 0, 0.").textured();

static SECOND_SQUARES: Parameter =
    Parameter::colour("color2", ONE, "The other squares.").textured();

/// The attributes of an object.
pub(super) static OBJECT: [Word; 3] = [
    word(
        "type",
        Kind::Choice(ObjectKind::TYPES),
        "group",
        "What it is; without a type, a group of the objects in it.",
    ),
    word(
        "name",
        Kind::Word,
        "none",
        "Its name; for an obj, the file, relative to the scene.",
    ),
    word(
        "material",
        Kind::Name(Category::Material),
        "none",
        "The name of its material; objects in it have their own.",
    ),
];

/// The attributes of a material.
pub(super) static MATERIAL_WORDS: [Word; 2] = [
    word(
        "type",
        Kind::Choice(MaterialKind::TYPES),
        "blinn",
        "How it is shaded.",
    ),
    word(
        "name",
        Kind::Word,
        "none",
        "The name by which objects refer to it.",
    ),
];

/// The attributes of a light.
pub(super) static LIGHT_WORDS: [Word; 2] = [
    word(
        "type",
        Kind::Choice(LightKind::TYPES),
        "none",
        "Where its light comes from.",
    ),
    word("name", Kind::Word, "none", "Its name."),
];

/// The name of a texture: `checkerboard`, or a file.
pub(super) static TEXTURE: Field = word(
    "texture",
    Kind::Word,
    "none",
    "checkerboard, or a picture file relative to the scene; it multiplies the colour.",
)
.field;

const fn word(key: &'static str, kind: Kind, missing: &'static str, doc: &'static str) -> Word {
    Word {
        field: Field {
            kind,
            ..Field::point(key, doc)
        },
        missing,
    }
}
