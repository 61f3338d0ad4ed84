//! The parameters of a camera.

use super::{Parameter, Word, ZERO, at_least_0, word};
use crate::schema::position::is_same;
use crate::schema::{Field, Kind, Range};

pub(in crate::xml) static POSITION: Parameter =
    Parameter::vector("position", ZERO, "The position of the camera.");

pub(in crate::xml) static TARGET: Parameter =
    Parameter::vector("target", &["0", "0", "-1"], "The point it looks at.");

pub(in crate::xml) static UP: Parameter =
    Parameter::vector("up", &["0", "1", "0"], "Which way is up in the picture.");

pub(in crate::xml) static FOV: Parameter = Parameter::number(
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
);

pub(in crate::xml) static FOCAL_DISTANCE: Parameter =
    Parameter::number(Field::length("focaldist", "The distance in focus."), &["1"]);

pub(in crate::xml) static LENS_RADIUS: Parameter = Parameter::number(
    at_least_0(
        "dof",
        0.1,
        "The radius of the lens; 0 keeps everything in focus.",
    ),
    &["0"],
);

pub(in crate::xml) static WIDTH: Parameter =
    Parameter::number(side("width", "How wide the picture is."), &["200"]);

pub(in crate::xml) static HEIGHT: Parameter =
    Parameter::number(side("height", "How high the picture is."), &["150"]);

/// All parameters, in the order of the interface.
pub(in crate::xml) const PARAMETERS: &[&Parameter; 8] = &[
    &POSITION,
    &TARGET,
    &UP,
    &FOV,
    &FOCAL_DISTANCE,
    &LENS_RADIUS,
    &WIDTH,
    &HEIGHT,
];

/// The index in [`PARAMETERS`] of one of them.
pub(in crate::xml) const fn index_of(parameter: &Parameter) -> usize {
    let mut at = 0;
    while !is_same(PARAMETERS[at].element, parameter.element) {
        at += 1;
    }
    at
}

/// The `gamma` attribute.
pub(in crate::xml) static GAMMA: Word = word(
    "gamma",
    Kind::Choice(&["linear", "sRGB"]),
    "linear",
    "sRGB: the picture is path traced, and its values go through the sRGB curve.",
);

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
