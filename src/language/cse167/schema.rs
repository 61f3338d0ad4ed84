//! The commands of `.test`, one slot per row.

use crate::schema::position::words;
use crate::schema::slots::{fov, choice, colour, number, pixels, place, point, size};
use crate::schema::{Category, Field, Kind, Makes, Part, Range, Record, Schema, Slot};

pub(super) static SCHEMA: Schema = Schema {
    extension: "test",
    noun: "command",
    is_short_at_head: true,
    any_case: true,
    records: &[
        &CAMERA, &SIZE, &MAXDEPTH, &INTEGRATOR, &SPP, &OUTPUT, &AMBIENT, &DIFFUSE, &SPECULAR, &EMISSION, &SHININESS,
        &DIRECTIONAL, &POINT, &ATTENUATION, &QUAD_LIGHT, &PUSH, &POP, &TRANSLATE, &SCALE, &ROTATE, &SPHERE, &MAXVERTS,
        &MAXVERTNORMS, &VERTEX, &VERTEX_NORMAL, &TRI, &TRI_NORMAL, &LIGHT_SAMPLES, &LIGHT_STRATIFY,
        &NEXT_EVENT_ESTIMATION, &RUSSIAN_ROULETTE, &IMPORTANCE_SAMPLING, &BRDF,
    ],
};

/// The integrators.
pub(super) const INTEGRATORS: [(&str, Method); 4] = [
    ("raytracer", Method::Whitted),
    ("analyticdirect", Method::Direct),
    ("direct", Method::Direct),
    ("pathtracer", Method::Path),
];

/// How light is traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Method {
    Whitted,
    /// By paths of one bounce.
    Direct,
    Path,
}

const CENTRE: [f64; 3] = [0.0; 3];

pub(super) const CAMERA: Record = Record::new("camera", &["camera"], Makes::View, &[
    point("from", "The position of the camera."),
    point("at", "The point the camera looks at."),
    point("up", "Which way is up in the picture; of any length."),
    fov(),
]);

pub(super) const SIZE: Record = Record::new("size", &["size"], Makes::View, &[pixels("size")]).replaced();

pub(super) const MAXDEPTH: Record = state("maxdepth", &["maxdepth"], &[
    whole("maxdepth", "The maximum number of bounces; -1 for as many as a path can have."),
]);

pub(super) const INTEGRATOR: Record = state("integrator", &["integrator"], &[
    choice("integrator", &words(&INTEGRATORS), "How light is traced."),
]);

pub(super) const SPP: Record = state("spp", &["spp"], &[whole("spp", "Samples per pixel.")]);

const OUTPUT: Record = state("output", &["output"], &[word("file", "The name of the picture; ignored.")]);

pub(super) const AMBIENT: Record = state("ambient", &["ambient"], &[colour("ambient", "Added as it is.")]);
pub(super) const DIFFUSE: Record = state("diffuse", &["diffuse"], &[
    colour("diffuse", "The fraction of light reflected diffusely."),
]);
pub(super) const SPECULAR: Record = state("specular", &["specular"], &[
    colour("specular", "Strength of the highlight, and weight of reflected rays."),
]);
pub(super) const EMISSION: Record = state("emission", &["emission"], &[colour("emission", "Added as it is.")]);
pub(super) const SHININESS: Record = state("shininess", &["shininess"], &[
    Slot::Field(
        Field::number("shininess", Range::NotNegative, 1.0, "How small the highlight is; below 0 reads as 0.")
            .reading_as(0.0),
    ),
]);

pub(super) const DIRECTIONAL: Record = light("directional", &["directional"], &[
    toward("direction", "Towards the light; of any length."),
    colour("colour", "The light that arrives."),
]);

pub(super) const POINT: Record = light("point", &["point"], &[
    place("position", CENTRE, "The position of the light."),
    colour("colour", "The light it emits."),
]);

pub(super) const ATTENUATION: Record = state("attenuation", &["attenuation"], &[
    number("constant", Range::Any, 0.1, "Point lights fade as 1 / (constant + linear d + quadratic d²)."),
    number("linear", Range::Any, 0.01, "Fading with the distance."),
    number("quadratic", Range::Any, 0.001, "Fading with the distance squared."),
]);

pub(super) const QUAD_LIGHT: Record =
    Record::new("quadLight", &["quadLight"], Makes::Node(Category::Object), &[
        place("corner", CENTRE, "A corner of the parallelogram."),
        toward("e1", "The edge from it to the second corner."),
        toward("e2", "The edge from it to the last corner; the light shines along e2 × e1."),
        colour("colour", "The radiance."),
    ]);

pub(super) const PUSH: Record = state("pushTransform", &["pushTransform"], &[]);
pub(super) const POP: Record = state("popTransform", &["popTransform"], &[]);
pub(super) const TRANSLATE: Record = state("translate", &["translate"], &[point("by", "The displacement.")]);
pub(super) const SCALE: Record = state("scale", &["scale"], &[point("by", "The factors along x, y and z.")]);
pub(super) const ROTATE: Record = state("rotate", &["rotate"], &[
    Slot::Field(Field { kind: Kind::Rotation, step: 1.0, ..Field::point("about", "An axis and an angle in degrees.") }),
]);

pub(super) const SPHERE: Record = Record::new("sphere", &["sphere"], Makes::Node(Category::Object), &[
    place("centre", CENTRE, "The sphere's centre."),
    size("radius", "The sphere's radius."),
]);

pub(super) const MAXVERTS: Record = state("maxverts", &["maxverts"], &[whole("maxverts", "The number of vertices.")]);
pub(super) const MAXVERTNORMS: Record = state("maxvertnorms", &["maxvertnorms"], &[
    whole("maxvertnorms", "The number of vertices with normals."),
]);
pub(super) const VERTEX: Record = state("vertex", &["vertex"], &[point("position", "A vertex.")]);
pub(super) const VERTEX_NORMAL: Record = state("vertexnormal", &["vertexnormal"], &[
    point("position", "A vertex."),
    point("normal", "Its normal, of any length."),
]);
pub(super) const TRI: Record = state("tri", &["tri"], CORNERS);
pub(super) const TRI_NORMAL: Record = state("trinormal", &["trinormal"], CORNERS);

const LIGHT_SAMPLES: Record = state("lightsamples", &["lightsamples"], IGNORED);
const LIGHT_STRATIFY: Record = state("lightstratify", &["lightstratify"], IGNORED);
const NEXT_EVENT_ESTIMATION: Record = state("nexteventestimation", &["nexteventestimation"], IGNORED);
const RUSSIAN_ROULETTE: Record = state("russianroulette", &["russianroulette"], IGNORED);
const IMPORTANCE_SAMPLING: Record = state("importancesampling", &["importancesampling"], IGNORED);
const BRDF: Record = state("brdf", &["brdf"], IGNORED);

/// The commands that a mesh is made of.
pub(super) const PILES: [Record; 6] = [MAXVERTS, MAXVERTNORMS, VERTEX, VERTEX_NORMAL, TRI, TRI_NORMAL];

/// The commands that are ignored, with one note for all.
pub(super) const READ_OVER: [&str; 6] = [
    LIGHT_SAMPLES.name, LIGHT_STRATIFY.name, NEXT_EVENT_ESTIMATION.name, RUSSIAN_ROULETTE.name,
    IMPORTANCE_SAMPLING.name, BRDF.name,
];

const CORNERS: &[Slot] = &[
    whole("first", "The number of a vertex, from 0."),
    whole("second", "The number of a vertex, from 0."),
    whole("third", "The number of a vertex, from 0."),
];
const IGNORED: &[Slot] = &[word("value", "Ignored.")];

const fn whole(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field { kind: Kind::Number, allowed: Range::Identity, usual: Range::Identity, step: 1.0, ..Field::point(key, doc) })
}

const fn word(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field { kind: Kind::Word, ..Field::point(key, doc) })
}

const fn toward(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field::point(key, doc).part(Part::Direction))
}

const fn light(name: &'static str, heads: &'static [&'static str], slots: &'static [Slot]) -> Record {
    Record::new(name, heads, Makes::Node(Category::Light), slots)
}

const fn state(name: &'static str, heads: &'static [&'static str], slots: &'static [Slot]) -> Record {
    Record::new(name, heads, Makes::State, slots)
}
