//! The parameters of materials.

use super::{Extra, HALF, Parameter, ZERO, at_least_0};
use crate::schema::{Field, Range};

pub(in crate::xml) static DIFFUSE: Parameter =
    Parameter::colour("diffuse", HALF, "The colour of diffuse reflection.").textured();

pub(in crate::xml) static SPECULAR: Parameter = Parameter::colour(
    "specular",
    &["0.7", "0.7", "0.7"],
    "The colour of the highlight.",
)
.textured();

pub(in crate::xml) static GLOSSINESS: Parameter = Parameter::number(
    Field::number(
        "glossiness",
        Range::NotNegative,
        1.0,
        "How small the highlight is.",
    ),
    &["20"],
)
.bare("1")
.textured();

pub(in crate::xml) static REFLECTION: Parameter =
    Parameter::colour("reflection", ZERO, "The fraction of light reflected.")
        .textured()
        .with(&[&SPREAD]);

pub(in crate::xml) static REFRACTION: Parameter =
    Parameter::colour("refraction", ZERO, "The fraction of light transmitted.")
        .textured()
        .with(&[&REFRACTION_INDEX, &SPREAD]);

/// The spread of reflected or refracted rays.
pub(in crate::xml) static SPREAD: Extra = Extra {
    attribute: "glossiness",
    missing: "0",
    missing_srgb: "0",
    field: at_least_0(
        "blur",
        0.01,
        "How much its rays are spread: 0 is a perfect mirror or clear glass.",
    ),
};

pub(in crate::xml) static REFRACTION_INDEX: Extra = Extra {
    attribute: "index",
    missing: "1",
    missing_srgb: "1.5",
    field: index_of_refraction("index"),
};

pub(in crate::xml) static ABSORPTION: Parameter = Parameter::colour(
    "absorption",
    ZERO,
    "The light absorbed inside, per unit of length.",
);

pub(in crate::xml) static EMISSION: Parameter =
    Parameter::colour("emission", ZERO, "The light it emits.").textured();

/// The parameters of a blinn or phong material.
pub(super) const GLOSSY: &[&Parameter] = &[
    &DIFFUSE,
    &SPECULAR,
    &GLOSSINESS,
    &REFLECTION,
    &REFRACTION,
    &ABSORPTION,
    &EMISSION,
];

pub(in crate::xml) static COLOUR: Parameter =
    Parameter::colour("color", HALF, "Its colour.").textured();

pub(in crate::xml) static ROUGHNESS: Parameter = Parameter::number(
    Field::number(
        "roughness",
        Range::Unit,
        0.05,
        "How rough it is; 0 mirrors perfectly.",
    ),
    &["1"],
)
.textured();

pub(in crate::xml) static METALLIC: Parameter = Parameter::number(
    Field::number("metallic", Range::Unit, 0.05, "How much of it is metal."),
    &["0"],
)
.textured();

pub(in crate::xml) static INDEX: Parameter =
    Parameter::number(index_of_refraction("ior"), &["1.5"]);

pub(in crate::xml) static TRANSMITTANCE: Parameter =
    Parameter::colour("transmittance", ZERO, "The fraction of light transmitted.").textured();

/// The parameters of a microfacet material.
pub(super) const MICROFACET: &[&Parameter] = &[
    &COLOUR,
    &ROUGHNESS,
    &METALLIC,
    &INDEX,
    &TRANSMITTANCE,
    &ABSORPTION,
    &EMISSION,
];

const fn index_of_refraction(key: &'static str) -> Field {
    let doc = "Index of refraction; 0 or less reads as 1.";
    Field::number(key, Range::Any, 0.01, doc)
}
