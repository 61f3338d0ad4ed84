//! The table of fields of `.ray`.

use crate::slot::At;
use crate::table::{Field, Kind, Range, numbers};
use text::nearest_word;

/// The camera, in a view comment.
pub(super) const VIEW: &[Field; 5] = &[
    Field::point("eye", "The position of the camera."),
    Field::point("target", "The point the camera looks at."),
    Field::direction("up", "Which way is up in the picture; of any length."),
    Field {
        kind: Kind::Number,
        allowed: Range::Between(0.0, 180.0),
        usual: Range::Between(0.0, 180.0),
        step: 1.0,
        unit: "degrees",
        ..Field::point("fov", "The vertical full angle of view.")
    },
    Field {
        kind: Kind::Pixels,
        allowed: Range::Count,
        usual: Range::Count,
        step: 10.0,
        unit: "pixels",
        ..Field::point("size", "Width and height of the output picture.")
    },
];

/// Ambient light.
pub(super) const AMBIENT: &[Field; 1] = &[Field::colour(
    "colour",
    "The light that reaches every surface from everywhere.",
)];

/// A light.
pub(super) const LIGHT: &[Field; 2] = &[
    Field::point("position", "The position of the light."),
    Field::colour("colour", "The light it emits, the same at any distance."),
];

/// The material of every object, after the fields of its shape.
pub(super) const MATERIAL: &[Field; 7] = &[
    Field::coefficients(
        "ka",
        "Ambient coefficient: fraction of ambient light reflected.",
    ),
    Field::coefficients(
        "kd",
        "Diffuse coefficient: fraction of light reflected diffusely.",
    ),
    Field::coefficients("ks", "Specular coefficient: strength of the highlight."),
    Field::number(
        "ns",
        Range::NotNegative,
        1.0,
        "Specular exponent: how small the highlight is; below 0 reads as 0.",
    )
    .reading_as(0.0),
    Field::number(
        "kr",
        Range::Unit,
        0.05,
        "Reflection coefficient: weight of reflected light.",
    ),
    Field::number(
        "kt",
        Range::Unit,
        0.05,
        "Transparency coefficient: weight of transmitted light.",
    ),
    Field::number(
        "ior",
        Range::Positive,
        0.05,
        "Index of refraction; 0 or less reads as 1.",
    )
    .reading_as(1.0),
];

const SPHERE: &[Field; 2] = &[
    Field::point("centre", "The sphere's centre."),
    Field::size("radius", "The sphere's radius."),
];

const ELLIPSOID: &[Field; 7] = &[
    Field::point("centre", "The ellipsoid's centre."),
    Field::direction("v1", "Direction of the first axis."),
    Field::direction("v2", "Direction of the second axis."),
    Field::direction("v3", "Direction of the third axis, v1 × v2."),
    Field::size("l1", "Semi-axis along v1."),
    Field::size("l2", "Semi-axis along v2."),
    Field::size("l3", "Semi-axis along v3."),
];

const BOX: &[Field; 7] = &[
    Field::point("corner", "The corner where the three edges begin."),
    Field::direction("vl", "Direction of the length."),
    Field::direction("vw", "Direction of the width."),
    Field::direction("vh", "Direction of the height, vl × vw."),
    Field::size("length", "Edge along vl."),
    Field::size("width", "Edge along vw."),
    Field::size("height", "Edge along vh."),
];

const CYLINDER: &[Field; 7] = &[
    Field::point("base", "Centre of the base."),
    Field::direction("a1", "Direction of the base's first axis."),
    Field::direction("a2", "Direction of the base's second axis."),
    Field::direction("axis", "From the base to the top, a1 × a2."),
    Field::size("l1", "Semi-axis of the base along a1."),
    Field::size("l2", "Semi-axis of the base along a2."),
    Field::size("height", "From the base to the top along the axis."),
];

const CONE: &[Field; 7] = &[
    Field::point("base", "Centre of the base."),
    Field::direction("a1", "Direction of the base's first axis."),
    Field::direction("a2", "Direction of the base's second axis."),
    Field::direction("axis", "From the base to the apex, a1 × a2."),
    Field::size("l1", "Semi-axis of the base along a1."),
    Field::size("l2", "Semi-axis of the base along a2."),
    Field::size("height", "From the base to the apex along the axis."),
];

/// The kinds of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ShapeKind {
    /// A sphere.
    Sphere,
    /// An ellipsoid with arbitrary semi-axes.
    Ellipsoid,
    /// A box with arbitrary edges.
    Box,
    /// A closed cylinder with an elliptic base.
    Cylinder,
    /// A closed cone with an elliptic base.
    Cone,
}

impl ShapeKind {
    /// All kinds.
    pub(super) const ALL: [Self; 5] = [
        Self::Sphere,
        Self::Ellipsoid,
        Self::Box,
        Self::Cylinder,
        Self::Cone,
    ];

    /// The keyword that begins such an object.
    pub(super) const fn keyword(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Ellipsoid => "ellipsoid",
            Self::Box => "box",
            Self::Cylinder => "cylinder",
            Self::Cone => "cone",
        }
    }

    /// The kind for a keyword, ignoring case.
    pub(super) fn of_word(word: &str) -> Option<Self> {
        Self::ALL
            .into_iter()
            .find(|kind| kind.keyword().eq_ignore_ascii_case(word))
    }

    /// The fields of the shape, in text order.
    pub(super) const fn geometry(self) -> &'static [Field] {
        match self {
            Self::Sphere => SPHERE,
            Self::Ellipsoid => ELLIPSOID,
            Self::Box => BOX,
            Self::Cylinder => CYLINDER,
            Self::Cone => CONE,
        }
    }

    /// All fields of such an object, in text order: those of the shape, then of the material.
    pub(super) fn fields(self) -> impl Iterator<Item = &'static Field> + Clone {
        self.geometry().iter().chain(MATERIAL)
    }

    /// The position of the numbers of the shape's field with this key.
    pub(super) const fn at<const N: usize>(self, key: &str) -> At<N> {
        At::of(self.geometry(), key)
    }

    /// The number of numbers after the keyword.
    pub(super) const fn numbers(self) -> usize {
        numbers(self.geometry()) + numbers(MATERIAL)
    }

    /// The keyword that a word was probably meant to be.
    pub(super) fn nearest(word: &str) -> Option<&'static str> {
        nearest_word(word, Self::ALL.map(Self::keyword))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_have_the_number_of_numbers_that_the_format_defines() {
        let counts = ShapeKind::ALL.map(|kind| (kind.keyword(), kind.numbers()));
        assert_eq!(
            counts,
            [
                ("sphere", 4 + 13),
                ("ellipsoid", 15 + 13),
                ("box", 15 + 13),
                ("cylinder", 15 + 13),
                ("cone", 15 + 13)
            ]
        );
        assert_eq!(
            [numbers(AMBIENT), numbers(LIGHT), numbers(VIEW)],
            [3, 6, 12]
        );
    }

    #[test]
    fn keywords_are_case_insensitive() {
        for kind in ShapeKind::ALL {
            assert_eq!(ShapeKind::of_word(kind.keyword()), Some(kind));
            assert_eq!(
                ShapeKind::of_word(&kind.keyword().to_uppercase()),
                Some(kind)
            );
        }
        assert_eq!(ShapeKind::of_word("spere"), None);
    }

    #[test]
    fn misspelt_keywords_are_recognised() {
        for (word, kind) in [
            ("spere", Some(ShapeKind::Sphere)),
            ("Shpere", Some(ShapeKind::Sphere)),
            ("elipsoid", Some(ShapeKind::Ellipsoid)),
            ("cilinder", Some(ShapeKind::Cylinder)),
            ("boxx", Some(ShapeKind::Box)),
            ("cones", Some(ShapeKind::Cone)),
            ("cube", None),
            ("torus", None),
            ("", None),
            ("sphère", Some(ShapeKind::Sphere)),
        ] {
            assert_eq!(
                ShapeKind::nearest(word),
                kind.map(ShapeKind::keyword),
                "{word}"
            );
        }
    }
}
