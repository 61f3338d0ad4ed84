//! The elements of `.xml`, one parameter per row.

use super::parameter::{Class, Parameter, Single, Type, at_least_0, side};
use crate::schema::{Category, Field, Kind, Range};

const ZERO: &[&str; 3] = &["0", "0", "0"];
const HALF: &[&str; 3] = &["0.5", "0.5", "0.5"];
const ONE: &[&str; 3] = &["1", "1", "1"];
const SHINY: &[&str; 3] = &["0.7", "0.7", "0.7"];

/// The elements in `scene` that are nodes of categories.
pub(super) const CLASSES: [&Class; 3] = [&OBJECT, &MATERIAL, &LIGHT];

/// The elements of a category.
pub(super) fn class_of(category: Category) -> Option<&'static Class> {
    CLASSES.into_iter().find(|class| class.category == category)
}

/// The parameters of the camera, in the order of the interface: three vectors, and five numbers.
pub(super) const CAMERA: &[&Parameter; 8] = &[
    &Parameter::vector("position", ZERO, "The position of the camera."),
    &Parameter::vector("target", &["0", "0", "-1"], "The point it looks at."),
    &Parameter::vector("up", &["0", "1", "0"], "Which way is up in the picture."),
    &Parameter::number(&["40"], Field {
        allowed: Range::Between(0.0, 180.0),
        unit: "degrees",
        ..Field::number("fov", Range::Between(0.0, 180.0), 1.0, "The angle of view from top to bottom.")
    }),
    &Parameter::number(&["1"], Field::length("focaldist", "The distance in focus.")),
    &Parameter::number(&["0"], at_least_0("dof", 0.1, "The radius of the lens; 0 keeps everything in focus.")),
    &Parameter::number(&["200"], side("width", "How wide the picture is.")),
    &Parameter::number(&["150"], side("height", "How high the picture is.")),
];

/// The `gamma` attribute.
pub(super) const GAMMA: Single = Single::word(
    "gamma", Kind::Choice(&["linear", "sRGB"]), "linear",
    "sRGB: the picture is path traced, and its values go through the sRGB curve.",
);

/// The background seen by camera rays.
pub(super) const BACKGROUND: Parameter =
    Parameter::colour("background", ZERO, "What the camera sees behind everything.").textured();
/// The background seen by all other rays.
pub(super) const ENVIRONMENT: Parameter =
    Parameter::colour("environment", ZERO, "What reflected and refracted rays see behind everything.").textured();

pub(super) const LIGHT: Class = Class {
    category: Category::Light,
    words: &[
        Single::word("type", Kind::Choice(&[AMBIENT.word, DIRECT.word, POINT.word]), "none", "Where its light comes from."),
        Single::word("name", Kind::Word, "none", "Its name."),
    ],
    kinds: &[&AMBIENT, &DIRECT, &POINT],
    otherwise: None,
    hint: "the light is skipped",
};

/// From everywhere.
pub(super) const AMBIENT: Type = Type { word: "ambient", parameters: &[&INTENSITY] };
/// From one direction.
pub(super) const DIRECT: Type = Type { word: "direct", parameters: &[&INTENSITY, &DIRECTION] };
/// From one point.
pub(super) const POINT: Type = Type { word: "point", parameters: &[&INTENSITY, &POSITION, &RADIUS, &ATTENUATION] };

pub(super) const INTENSITY: Parameter = Parameter::colour("intensity", ZERO, "Its brightness and colour.");
pub(super) const DIRECTION: Parameter = Parameter::vector("direction", &["0", "0", "1"], "Which way its light travels.");
pub(super) const POSITION: Parameter = Parameter::vector("position", ZERO, "Its position.");
pub(super) const RADIUS: Parameter = Parameter::number(&["0"], at_least_0("size", 0.1, "Its radius: 0 casts hard shadows."));
pub(super) const ATTENUATION: Parameter = Parameter::number(&["0"], at_least_0(
    "attenuation", 0.01, "Its light is divided by the square of this times the distance; 0 for no falloff.",
));

pub(super) const MATERIAL: Class = Class {
    category: Category::Material,
    words: &[
        Single::word("type", Kind::Choice(&[BLINN.word, PHONG.word, MICROFACET.word]), "blinn", "How it is shaded."),
        Single::word("name", Kind::Word, "none", "The name by which objects refer to it."),
    ],
    kinds: &[&BLINN, &PHONG, &MICROFACET],
    otherwise: Some(&BLINN),
    hint: "it is treated as blinn",
};

/// A highlight around the normal.
pub(super) const BLINN: Type = Type { word: "blinn", parameters: GLOSSY };
/// A highlight around the reflected direction.
pub(super) const PHONG: Type = Type { word: "phong", parameters: GLOSSY };
/// Microfacets.
pub(super) const MICROFACET: Type = Type {
    word: "microfacet",
    parameters: &[&COLOUR, &ROUGHNESS, &METALLIC, &INDEX, &TRANSMITTANCE, &ABSORPTION, &EMISSION],
};
const GLOSSY: &[&Parameter] = &[&DIFFUSE, &SPECULAR, &GLOSSINESS, &REFLECTION, &REFRACTION, &ABSORPTION, &EMISSION];

pub(super) const DIFFUSE: Parameter = Parameter::colour("diffuse", HALF, "The colour of diffuse reflection.").textured();
pub(super) const SPECULAR: Parameter = Parameter::colour("specular", SHINY, "The colour of the highlight.").textured();
pub(super) const GLOSSINESS: Parameter =
    Parameter::number(&["20"], Field::number("glossiness", Range::NotNegative, 1.0, "How small the highlight is."))
        .bare("1")
        .textured();
pub(super) const REFLECTION: Parameter =
    Parameter::colour("reflection", ZERO, "The fraction of light reflected.").textured().with(&[&SPREAD]);
pub(super) const REFRACTION: Parameter =
    Parameter::colour("refraction", ZERO, "The fraction of light transmitted.").textured().with(&[&REFRACTION_INDEX, &SPREAD]);
/// The spread of reflected or refracted rays.
pub(super) const SPREAD: Single = Single::number("glossiness", "0", at_least_0(
    "blur", 0.01, "How much its rays are spread: 0 is a perfect mirror or clear glass.",
));
pub(super) const REFRACTION_INDEX: Single = Single::number("index", "1", index_of_refraction("index")).srgb("1.5");
pub(super) const ABSORPTION: Parameter =
    Parameter::colour("absorption", ZERO, "The light absorbed inside, per unit of length.");
pub(super) const EMISSION: Parameter = Parameter::colour("emission", ZERO, "The light it emits.").textured();
pub(super) const COLOUR: Parameter = Parameter::colour("color", HALF, "Its colour.").textured();
pub(super) const ROUGHNESS: Parameter =
    Parameter::number(&["1"], Field::number("roughness", Range::Unit, 0.05, "How rough it is; 0 mirrors perfectly."))
        .textured();
pub(super) const METALLIC: Parameter =
    Parameter::number(&["0"], Field::number("metallic", Range::Unit, 0.05, "How much of it is metal.")).textured();
pub(super) const INDEX: Parameter = Parameter::number(&["1.5"], index_of_refraction("ior"));
pub(super) const TRANSMITTANCE: Parameter =
    Parameter::colour("transmittance", ZERO, "The fraction of light transmitted.").textured();

pub(super) const OBJECT: Class = Class {
    category: Category::Object,
    words: &[
        Single::word(
            "type", Kind::Choice(&[SPHERE.word, PLANE.word, OBJ.word]), "group",
            "What it is; without a type, a group of the objects in it.",
        ),
        Single::word("name", Kind::Word, "none", "Its name; for an obj, the file, relative to the scene."),
        Single::word(
            "material", Kind::Name(Category::Material), "none",
            "The name of its material; objects in it have their own.",
        ),
    ],
    kinds: &[&SPHERE, &PLANE, &OBJ],
    otherwise: Some(&GROUP),
    hint: "it is treated as a group",
};

/// A sphere of radius 1.
pub(super) const SPHERE: Type = Type { word: "sphere", parameters: &[] };
/// A square from −1 to 1 in x and y.
pub(super) const PLANE: Type = Type { word: "plane", parameters: &[] };
/// A mesh from a file.
pub(super) const OBJ: Type = Type { word: "obj", parameters: &[] };
/// The objects in it.
pub(super) const GROUP: Type = Type { word: "group", parameters: &[] };

/// The transforms, applied in the order of the text.
pub(super) const TRANSFORMS: &[&Parameter] = &[
    &Parameter::vector("scale", ONE, "The scale factor along each axis.").bare("1"),
    &Parameter::rotation(ZERO, Field::point("rotate", "The axis it is turned about, and how far.")),
    &Parameter::vector("translate", ZERO, "How far it is moved."),
];

/// The name of a texture: `checkerboard`, or a file.
pub(super) const TEXTURE: Field = Single::word(
    "texture", Kind::Word, "none",
    "checkerboard, or a picture file relative to the scene; it multiplies the colour.",
).field;

/// The parameters of a checkerboard besides transforms: the colours of its squares, first those at
/// uv 0, 0.
pub(super) const CHECKER: &[&Parameter; 2] = &[
    &Parameter::colour("color1", ZERO, "The squares at uv 0, 0.").textured(),
    &Parameter::colour("color2", ONE, "The other squares.").textured(),
];

const fn index_of_refraction(key: &'static str) -> Field {
    Field::number(key, Range::Any, 0.01, "Index of refraction; 0 or less reads as 1.")
}
