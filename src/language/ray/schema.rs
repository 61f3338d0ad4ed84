//! The records of `.ray`, one slot per row.

use crate::schema::layout::{Layout, Unit};
use crate::schema::slots::{fov, colour, direction, edge, pixels, place, point, radius, share, share_of_light};
use crate::schema::{Category, Field, Makes, Range, Record, Schema, Slot};
use text::nearest_word;

pub(super) static SCHEMA: Schema = Schema {
    extension: "ray",
    noun: "object",
    is_short_at_head: false,
    any_case: true,
    records: &[&VIEW, &LIGHT, &SPHERE, &ELLIPSOID, &BOX, &CYLINDER, &CONE],
};

const CENTRE: [f64; 3] = [0.0; 3];
const CORNER: [f64; 3] = [-1.0; 3];
const BASE: [f64; 3] = [0.0, 0.0, -1.0];

/// The camera, in a comment.
pub(super) const VIEW: Record = Record::new("view", &[], Makes::View, &[
    point("eye", "The position of the camera."),
    point("target", "The point the camera looks at."),
    Slot::Field(Field::direction("up", "Which way is up in the picture; of any length.")),
    fov(),
    pixels("size"),
]);

/// Ambient light.
pub(super) const AMBIENT: Record = Record::new("ambient", &[], Makes::View, &[
    colour("colour", "The light that reaches every surface from everywhere."),
]);

/// A light.
pub(super) const LIGHT: Record = Record::new("light", &[], Makes::Node(Category::Light), &[
    place("position", CENTRE, "The position of the light."),
    colour("colour", "The light it emits, the same at any distance."),
]);

/// The material of every object, after the numbers of its shape.
pub(super) const MATERIAL: Record = Record::new("material", &[], Makes::Node(Category::Material), &[
    share_of_light("ka", "Ambient coefficient: fraction of ambient light reflected."),
    share_of_light("kd", "Diffuse coefficient: fraction of light reflected diffusely."),
    share_of_light("ks", "Specular coefficient: strength of the highlight."),
    Slot::Field(
        Field::number("ns", Range::NotNegative, 1.0, "Specular exponent: how small the highlight is; below 0 reads as 0.")
            .reading_as(0.0),
    ),
    share("kr", "Reflection coefficient: weight of reflected light."),
    share("kt", "Transparency coefficient: weight of transmitted light."),
    Slot::Field(Field::number("ior", Range::Positive, 0.05, "Index of refraction; 0 or less reads as 1.").reading_as(1.0)),
]);

const SPHERE: Record = solid("sphere", &["sphere"], Unit::Sphere, &[
    place("centre", CENTRE, "The sphere's centre."),
    radius("radius", &[0, 1, 2], "The sphere's radius."),
]);

const ELLIPSOID: Record = solid("ellipsoid", &["ellipsoid"], Unit::Ellipsoid, &[
    place("centre", CENTRE, "The ellipsoid's centre."),
    direction("v1", 0, "Direction of the first axis."),
    direction("v2", 1, "Direction of the second axis."),
    direction("v3", 2, "Direction of the third axis, v1 × v2."),
    radius("l1", &[0], "Semi-axis along v1."),
    radius("l2", &[1], "Semi-axis along v2."),
    radius("l3", &[2], "Semi-axis along v3."),
]);

const BOX: Record = solid("box", &["box"], Unit::Box, &[
    place("corner", CORNER, "The corner where the three edges begin."),
    direction("vl", 0, "Direction of the length."),
    direction("vw", 1, "Direction of the width."),
    direction("vh", 2, "Direction of the height, vl × vw."),
    edge("length", &[0], "Edge along vl."),
    edge("width", &[1], "Edge along vw."),
    edge("height", &[2], "Edge along vh."),
]);

const CYLINDER: Record = solid("cylinder", &["cylinder"], Unit::Cylinder, &[
    place("base", BASE, "Centre of the base."),
    direction("a1", 0, "Direction of the base's first axis."),
    direction("a2", 1, "Direction of the base's second axis."),
    direction("axis", 2, "From the base to the top, a1 × a2."),
    radius("l1", &[0], "Semi-axis of the base along a1."),
    radius("l2", &[1], "Semi-axis of the base along a2."),
    edge("height", &[2], "From the base to the top along the axis."),
]);

const CONE: Record = solid("cone", &["cone"], Unit::Cone, &[
    place("base", BASE, "Centre of the base."),
    direction("a1", 0, "Direction of the base's first axis."),
    direction("a2", 1, "Direction of the base's second axis."),
    direction("axis", 2, "From the base to the apex, a1 × a2."),
    radius("l1", &[0], "Semi-axis of the base along a1."),
    radius("l2", &[1], "Semi-axis of the base along a2."),
    edge("height", &[2], "From the base to the apex along the axis."),
]);

const fn solid(name: &'static str, heads: &'static [&'static str], unit: Unit, slots: &'static [Slot]) -> Record {
    Record::new(name, heads, Makes::Solid(unit), slots)
}

/// The records of shapes, in the order of [`ShapeKind::ALL`].
const SHAPES: [&Record; 5] = [&SPHERE, &ELLIPSOID, &BOX, &CYLINDER, &CONE];

/// The kinds of objects, in a byte.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ShapeKind {
    Sphere,
    Ellipsoid,
    Box,
    Cylinder,
    Cone,
}

impl ShapeKind {
    /// All kinds.
    pub(super) const ALL: [Self; 5] = [Self::Sphere, Self::Ellipsoid, Self::Box, Self::Cylinder, Self::Cone];

    /// The record of the shape, without the material.
    pub(super) const fn record(self) -> &'static Record {
        SHAPES[self as usize]
    }

    /// The keyword that begins such an object.
    pub(super) const fn keyword(self) -> &'static str {
        self.record().name
    }

    /// The kind for a keyword, ignoring case.
    pub(super) fn of_word(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.keyword().eq_ignore_ascii_case(word))
    }

    /// Where the numbers of the shape place it.
    pub(super) fn layout(self) -> &'static Layout {
        self.record().layout.as_ref().expect("every shape is a unit solid")
    }

    /// All fields of such an object, in text order: those of the shape, then of the material.
    pub(super) fn fields(self) -> impl Iterator<Item = &'static Field> + Clone {
        self.record().fields().chain(MATERIAL.fields())
    }

    /// The number of numbers of the shape.
    pub(super) const fn geometry(self) -> usize {
        self.record().numbers()
    }

    /// The number of numbers after the keyword.
    pub(super) const fn numbers(self) -> usize {
        self.geometry() + MATERIAL.numbers()
    }

    /// The keyword that a word was probably meant to be.
    pub(super) fn nearest(word: &str) -> Option<&'static str> {
        nearest_word(word, Self::ALL.map(Self::keyword))
    }
}
