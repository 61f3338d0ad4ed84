//! The table of fields of `.xml`: the names of elements, their attributes, and the defaults of
//! missing ones.

mod kinds;

use crate::language::at::is_same;
use crate::language::table::{Category, Field, Kind, Range};
pub(super) use kinds::{LightKind, MaterialKind, ObjectKind};

/// An element that sets a property of its parent.
#[derive(Debug, PartialEq)]
pub(super) struct Parameter {
    /// Its name.
    pub element: &'static str,
    /// How its attributes are read.
    pub reading: Reading,
    /// The default of numbers missing in the element.
    pub inside: &'static str,
    /// The defaults if the element itself is missing.
    pub missing: &'static [&'static str],
    /// Its field if `value` is missing, or is the only attribute.
    pub field: Field,
    /// Its field if `value` multiplies the other attributes.
    pub scaled: Field,
    /// Further attributes, each a field of its own.
    pub extras: &'static [Extra],
    /// Whether it may have a texture.
    pub texture: Texturing,
}

/// How an element's attributes are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reading {
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
    pub(super) fn missing(&self, is_srgb: bool) -> &'static str {
        if is_srgb {
            self.missing_srgb
        } else {
            self.missing
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

impl Reading {
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
            reading: Reading::Vector,
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
            reading: Reading::Colour,
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
            reading: Reading::Number,
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

    const fn with(self, extras: &'static [Extra]) -> Self {
        Self { extras, ..self }
    }

    const fn bare(self, inside: &'static str) -> Self {
        Self { inside, ..self }
    }

    /// The default of an attribute missing in the element.
    pub(super) fn inside(&self, attribute: &str) -> &'static str {
        match (self.reading, attribute) {
            (Reading::Vector | Reading::Colour, "value") => "1",
            _ => self.inside,
        }
    }
}

const ZERO: &[&str; 3] = &["0", "0", "0"];
const HALF: &[&str; 3] = &["0.5", "0.5", "0.5"];
const ONE: &[&str; 3] = &["1", "1", "1"];

const fn side(key: &'static str, doc: &'static str) -> Field {
    Field {
        kind: Kind::Side,
        allowed: Range::Count,
        usual: Range::Count,
        step: 10.0,
        unit: "pixels",
        ..Field::number(key, Range::Any, 1.0, doc)
    }
}

const fn at_least_0(key: &'static str, step: f64, doc: &'static str) -> Field {
    Field {
        allowed: Range::NotNegative,
        ..Field::number(key, Range::NotNegative, step, doc)
    }
}

/// The parameters of a camera.
pub(super) static CAMERA: [Parameter; 8] = [
    Parameter::vector("position", ZERO, "Where the camera stands."),
    Parameter::vector("target", &["0", "0", "-1"], "The point it looks at."),
    Parameter::vector("up", &["0", "1", "0"], "Which way is up in the picture."),
    Parameter::number(
        Field {
            allowed: Range::Between(0.0, 180.0),
            usual: Range::Between(0.0, 180.0),
            unit: "degrees",
            ..Field::number(
                "fov",
                Range::Any,
                1.0,
                "The angle of view from top to bottom.",
            )
        },
        &["40"],
    ),
    Parameter::number(
        Field::size("focaldist", "How far away what is sharp stands."),
        &["1"],
    ),
    Parameter::number(
        at_least_0(
            "dof",
            0.1,
            "The radius of the lens: 0 shows everything sharp.",
        ),
        &["0"],
    ),
    Parameter::number(side("width", "How wide the picture is."), &["200"]),
    Parameter::number(side("height", "How high the picture is."), &["150"]),
];

/// The `gamma` attribute of a camera.
pub(super) static GAMMA: Word = word(
    "gamma",
    Kind::Choice(&["linear", "sRGB"]),
    "linear",
    "sRGB: the picture is path traced, and its values go through the sRGB curve.",
);

/// Index in [`CAMERA`] of the position.
pub(super) const POSITION: usize = place_in_camera("position");
/// Index of the point the camera looks at.
pub(super) const TARGET: usize = place_in_camera("target");
/// Index of the up direction.
pub(super) const UP: usize = place_in_camera("up");
/// Index of the angle of view.
pub(super) const FOV: usize = place_in_camera("fov");
/// Index of the distance in focus.
pub(super) const FOCAL_DISTANCE: usize = place_in_camera("focaldist");
/// Index of the lens radius.
pub(super) const LENS: usize = place_in_camera("dof");
/// Index of the picture's width.
pub(super) const WIDTH: usize = place_in_camera("width");
/// Index of the picture's height.
pub(super) const HEIGHT: usize = place_in_camera("height");

/// The index in [`CAMERA`] of the element with this name; an unknown name does not compile.
const fn place_in_camera(element: &str) -> usize {
    let mut at = 0;
    while !is_same(CAMERA[at].element, element) {
        at += 1;
    }
    at
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
    "What mirrors and glass see behind everything.",
)
.textured();

/// The transforms, applied in the order of the text.
pub(super) static TRANSFORMS: [Parameter; 3] = [
    Parameter {
        inside: "1",
        ..Parameter::vector(
            "scale",
            ONE,
            "How many times as large it becomes along each axis.",
        )
    },
    Parameter {
        reading: Reading::Rotation,
        field: Field {
            kind: Kind::Rotation,
            ..Field::point("rotate", "The axis it is turned about, and how far.")
        },
        ..Parameter::vector("rotate", ZERO, "The axis it is turned about, and how far.")
    },
    Parameter::vector("translate", ZERO, "How far it is moved."),
];

/// The parameters of a checkerboard besides transforms.
pub(super) static CHECKER: [Parameter; 2] = [
    Parameter::colour("color1", ZERO, "The squares at uv 0, 0.").textured(),
    Parameter::colour("color2", ONE, "The other squares.").textured(),
];

const JITTER: Extra = Extra {
    attribute: "glossiness",
    missing: "0",
    missing_srgb: "0",
    field: at_least_0(
        "blur",
        0.01,
        "How much its rays are spread: 0 is a perfect mirror or clear glass.",
    ),
};

const REFLECTION: Parameter = Parameter::colour("reflection", ZERO, "How much is mirrored.")
    .textured()
    .with(&[JITTER]);
const REFRACTION: Parameter = Parameter::colour("refraction", ZERO, "How much goes through.")
    .textured()
    .with(&[
        Extra {
            attribute: "index",
            missing: "1",
            missing_srgb: "1.5",
            field: Field::number(
                "index",
                Range::Any,
                0.01,
                "Index of refraction; 0 or less reads as 1.",
            ),
        },
        JITTER,
    ]);
const ABSORPTION: Parameter = Parameter::colour(
    "absorption",
    ZERO,
    "What is lost inside, per unit of length.",
);
const EMISSION: Parameter =
    Parameter::colour("emission", ZERO, "What shines by itself.").textured();

/// The parameters of a blinn or phong material.
pub(super) static MATERIAL: [Parameter; 7] = [
    Parameter::colour("diffuse", HALF, "The colour of light sent back evenly.").textured(),
    Parameter::colour(
        "specular",
        &["0.7", "0.7", "0.7"],
        "The colour of the highlight.",
    )
    .textured(),
    Parameter::number(
        Field::number(
            "glossiness",
            Range::NotNegative,
            1.0,
            "How small the highlight is.",
        ),
        &["20"],
    )
    .bare("1")
    .textured(),
    REFLECTION,
    REFRACTION,
    ABSORPTION,
    EMISSION,
];

/// The parameters of a microfacet material.
pub(super) static MICROFACET: [Parameter; 7] = [
    Parameter::colour("color", HALF, "Its colour.").textured(),
    Parameter::number(
        Field::number(
            "roughness",
            Range::Unit,
            0.05,
            "How rough it is; 0 mirrors perfectly.",
        ),
        &["1"],
    )
    .textured(),
    Parameter::number(
        Field::number("metallic", Range::Unit, 0.05, "How much of it is metal."),
        &["0"],
    )
    .textured(),
    Parameter::number(
        Field::number(
            "ior",
            Range::Any,
            0.01,
            "Index of refraction; 0 or less reads as 1.",
        ),
        &["1.5"],
    ),
    Parameter::colour("transmittance", ZERO, "How much goes through.").textured(),
    ABSORPTION,
    EMISSION,
];

const INTENSITY: Parameter =
    Parameter::colour("intensity", ZERO, "How bright it is, and in which colour.");

/// The parameters of an ambient light.
pub(super) static AMBIENT: [Parameter; 1] = [INTENSITY];

/// The parameters of a direct light.
pub(super) static DIRECT: [Parameter; 2] = [
    INTENSITY,
    Parameter::vector(
        "direction",
        &["0", "0", "1"],
        "Which way its light travels.",
    ),
];

/// The parameters of a point light.
pub(super) static POINT: [Parameter; 4] = [
    INTENSITY,
    Parameter::vector("position", ZERO, "Where it stands."),
    Parameter::number(
        at_least_0("size", 0.1, "Its radius: 0 casts hard shadows."),
        &["0"],
    ),
    Parameter::number(
        at_least_0(
            "attenuation",
            0.01,
            "Its light is divided by the square of this times the distance; 0: by nothing.",
        ),
        &["0"],
    ),
];

/// The attributes of an object.
pub(super) static OBJECT: [Word; 3] = [
    word(
        "type",
        Kind::Choice(ObjectKind::TYPES),
        "group",
        "What it is; without one it is a group of what is in it.",
    ),
    word(
        "name",
        Kind::Word,
        "none",
        "What it is called; of an obj the file, relative to the scene.",
    ),
    word(
        "material",
        Kind::Name(Category::Material),
        "none",
        "The name of its material; what is in it has its own.",
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
    word("name", Kind::Word, "none", "The name that objects say."),
];

/// The attributes of a light.
pub(super) static LIGHT_WORDS: [Word; 2] = [
    word(
        "type",
        Kind::Choice(LightKind::TYPES),
        "none",
        "Where its light comes from.",
    ),
    word("name", Kind::Word, "none", "What it is called."),
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
