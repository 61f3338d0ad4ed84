//! The parameters of lights.

use super::{Parameter, ZERO, at_least_0};

pub(in crate::xml) static INTENSITY: Parameter =
    Parameter::colour("intensity", ZERO, "Its brightness and colour.");

pub(in crate::xml) static DIRECTION: Parameter = Parameter::vector(
    "direction",
    &["0", "0", "1"],
    "Which way its light travels.",
);

pub(in crate::xml) static POSITION: Parameter =
    Parameter::vector("position", ZERO, "Its position.");

pub(in crate::xml) static RADIUS: Parameter = Parameter::number(
    at_least_0("size", 0.1, "Its radius: 0 casts hard shadows."),
    &["0"],
);

pub(in crate::xml) static ATTENUATION: Parameter = Parameter::number(
    at_least_0(
        "attenuation",
        0.01,
        "Its light is divided by the square of this times the distance; 0 for no falloff.",
    ),
    &["0"],
);

/// The parameters of an ambient light.
pub(super) const AMBIENT: &[&Parameter] = &[&INTENSITY];

/// The parameters of a direct light.
pub(super) const DIRECT: &[&Parameter] = &[&INTENSITY, &DIRECTION];

/// The parameters of a point light.
pub(super) const POINT: &[&Parameter] = &[&INTENSITY, &POSITION, &RADIUS, &ATTENUATION];
