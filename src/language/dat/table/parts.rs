//! The parts of every record, in the order of the text.

use super::Part;
use crate::slot::words;
use crate::table::{Category, Field, Kind, Range};
use geometry::Operation;
use scene::Shadows;

/// The projections of a camera, and whether they are perspective.
pub(in crate::dat) const PROJECTIONS: [(&str, bool); 2] =
    [("perspective", true), ("orthographic", false)];
/// The types of lights.
pub(in crate::dat) const SOURCES: [(&str, LightKind); 3] = [
    ("pnt", LightKind::Point),
    ("inf", LightKind::Distant),
    ("amb", LightKind::Ambient),
];
/// Whether a light casts shadows.
pub(in crate::dat) const SHADOWS: [(&str, Shadows); 2] =
    [("shadow_on", Shadows::Cast), ("shadow_off", Shadows::Off)];
/// The operations that combine two objects.
pub(in crate::dat) const OPERATIONS: [(&str, Operation); 3] = [
    ("union", Operation::Union),
    ("intersection", Operation::Intersection),
    ("difference", Operation::Difference),
];

/// Where a light comes from.
#[derive(Clone, Copy, Debug)]
pub(in crate::dat) enum LightKind {
    Point,
    Distant,
    Ambient,
}

const fn choice(key: &'static str, words: &'static [&'static str], doc: &'static str) -> Part {
    Part::Field(Field {
        kind: Kind::Choice(words),
        ..Field::point(key, doc)
    })
}

const fn reference(key: &'static str, category: Category, doc: &'static str) -> Part {
    Part::Field(Field {
        kind: Kind::Reference(category),
        allowed: Range::Identity,
        usual: Range::Identity,
        step: 1.0,
        ..Field::point(key, doc)
    })
}

const fn point(key: &'static str, doc: &'static str) -> Part {
    Part::Field(Field::point(key, doc))
}

const fn direction(key: &'static str, doc: &'static str) -> Part {
    Part::Field(Field::direction(key, doc))
}

const fn axis(key: &'static str, doc: &'static str) -> Part {
    Part::Field(Field {
        kind: Kind::Axis,
        ..Field::direction(key, doc)
    })
}

const fn colour(key: &'static str, doc: &'static str) -> Part {
    Part::Field(Field::colour(key, doc))
}

const fn size(key: &'static str, doc: &'static str) -> Part {
    Part::Field(Field::size(key, doc))
}

const fn number(key: &'static str, usual: Range, step: f64, doc: &'static str) -> Part {
    Part::Field(Field::number(key, usual, step, doc))
}

const fn share(key: &'static str, doc: &'static str) -> Part {
    number(key, Range::Unit, 0.05, doc)
}

const fn coefficient(key: &'static str, doc: &'static str) -> Part {
    number(key, Range::Any, 0.1, doc)
}

const fn pair(field: Field) -> Field {
    Field {
        kind: Kind::Pair,
        ..field
    }
}

const ID: Part = Part::Word("ID");

const MATERIAL_ID: Part = reference("mat", Category::Material, "The material, by its ID.");

pub(super) const CAMERA: &[Part] = &[
    choice(
        "projection",
        const { &words(&PROJECTIONS) },
        "Rays from the eye (perspective), or side by side (orthographic).",
    ),
    point("eye", "The position of the camera."),
    point("look", "The point the camera looks at."),
    point("up", "Which way is up in the picture; of any length."),
    Part::Field(Field::length(
        "focal",
        "From the eye to the image plane; orthographic pictures do not depend on it.",
    )),
    number(
        "near",
        Range::Any,
        0.1,
        "The picture shows nothing nearer, measured along the view; below 0 counts as 0.",
    ),
    number(
        "far",
        Range::Any,
        1.0,
        "The picture shows nothing farther, measured along the view.",
    ),
];

pub(super) const RESOLUTION: &[Part] = &[Part::Field(Field {
    step: 0.001,
    ..pair(Field::length(
        "resolution",
        "World units per pixel on the image plane, across and up.",
    ))
})];

pub(super) const VIEWPORT: &[Part] = &[Part::Field(Field {
    kind: Kind::Pixels,
    allowed: Range::Count,
    usual: Range::Count,
    step: 10.0,
    unit: "pixels",
    ..Field::point("viewport", "Width and height of the output picture.")
})];

pub(super) const LIGHT: &[Part] = &[
    ID,
    Part::Id,
    choice(
        "source",
        const { &words(&SOURCES) },
        "From a point (pnt), from infinitely far (inf), from everywhere (amb).",
    ),
    point("position", "The position of a point light."),
    point(
        "direction",
        "Where the light travels; all zero for a point light that emits equally in all directions.",
    ),
    colour("colour", "The light it emits."),
    number(
        "a0",
        Range::NotNegative,
        0.1,
        "Falloff: 1 / (a0 + a1 d + a2 d²) at distance d.",
    ),
    number("a1", Range::NotNegative, 0.01, "Falloff with the distance."),
    number(
        "a2",
        Range::NotNegative,
        0.001,
        "Falloff with the distance squared.",
    ),
    Part::Field(
        Field::number(
            "aa",
            Range::NotNegative,
            1.0,
            "Falloff with the angle from the direction: the exponent of its cosine; 0 for none.",
        )
        .reading_as(0.0),
    ),
    choice(
        "shadow",
        const { &words(&SHADOWS) },
        "Whether objects cast shadows in this light.",
    ),
];

pub(super) const MATERIAL: &[Part] = &[
    ID,
    Part::Id,
    Part::Field(Field::coefficients(
        "RGB",
        "The colour that Ka, Kd and Ks multiply, and textures as well.",
    )),
    share(
        "Ka",
        "Ambient coefficient: fraction of ambient light reflected.",
    ),
    share(
        "Kd",
        "Diffuse coefficient: fraction of light reflected diffusely.",
    ),
    number(
        "Ks",
        Range::NotNegative,
        0.05,
        "Specular coefficient: strength of the highlight, in the material's colour.",
    ),
    Part::Field(
        Field::number(
            "ns",
            Range::NotNegative,
            1.0,
            "Specular exponent: how small the highlight is; below 0 reads as 0.",
        )
        .reading_as(0.0),
    ),
    share(
        "Kt",
        "Transmission coefficient: weight of transmitted light.",
    ),
    share("Kr", "Reflection coefficient: weight of reflected light."),
    Part::Field(
        Field::number(
            "ior",
            Range::NotNegative,
            0.05,
            "Index of refraction; 0 or less reads as 1.",
        )
        .reading_as(1.0),
    ),
];

pub(super) const SPHERE: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    point("centre", "The sphere's centre."),
    size("radius", "The sphere's radius."),
];

pub(super) const ELLIPSOID: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    point("centre", "The ellipsoid's centre."),
    size("rx", "Semi-axis along x."),
    size("ry", "Semi-axis along y."),
    size("rz", "Semi-axis along z."),
];

pub(super) const CYLINDER: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    point("centre", "The middle of the axis."),
    direction("axis", "Direction of the axis."),
    size("radius", "The cylinder's radius."),
    size("length", "From one end to the other."),
];

pub(super) const BOX: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    point("centre", "The box's centre."),
    axis("u", "Direction of the first edges."),
    axis("v", "Direction of the second edges."),
    axis("w", "Direction of the third edges, u × v."),
    size("uw", "Full width along u, in lengths of u."),
    size("vw", "Full width along v, in lengths of v."),
    size("ww", "Full width along w, in lengths of w."),
];

pub(super) const CSG: &[Part] = &[
    ID,
    Part::Id,
    Part::Field(Field {
        kind: Kind::Choice(const { &words(&OPERATIONS) }),
        other_spellings: &[("intersect", "intersection")],
        ..Field::point(
            "operator",
            "Both together, what both share, or the first without the second.",
        )
    }),
    ID,
    reference("first", Category::Object, "The first object, by its ID."),
    ID,
    reference("second", Category::Object, "The second object, by its ID."),
];

pub(super) const QUADRIC: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    coefficient(
        "A",
        "Inside is Ax² + 2Bxy + 2Cxz + 2Dx + Ey² + 2Fyz + 2Gy + Hz² + 2Iz + J ≤ 0.",
    ),
    coefficient("B", "Of 2xy."),
    coefficient("C", "Of 2xz."),
    coefficient("D", "Of 2x."),
    coefficient("E", "Of y²."),
    coefficient("F", "Of 2yz."),
    coefficient("G", "Of 2y."),
    coefficient("H", "Of z²."),
    coefficient("I", "Of 2z."),
    coefficient("J", "The constant."),
];

/// A half-space that clips a quadric.
pub(in crate::dat) const HALF_SPACE: &Field = &Field {
    kind: Kind::HalfSpace,
    ..Field::point(
        "cut",
        "Only points with n·x ≤ d remain; the normal n may have any length above 0.",
    )
};

const REPEAT: Part = Part::Field(Field {
    step: 1.0,
    ..pair(Field::point(
        "repeat",
        "How often it repeats over the unit square of uv.",
    ))
});

pub(super) const CHECKER: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("checker"),
    REPEAT,
    Part::Field(Field::coefficients(
        "first",
        "The colour of the square at uv 0, 0.",
    )),
    Part::Field(Field::coefficients(
        "second",
        "The colour of the squares beside it.",
    )),
];

pub(super) const IMAGE: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("image"),
    REPEAT,
    Part::Field(Field {
        kind: Kind::Word,
        ..Field::point("file", "The picture's path, from the scene's folder.")
    }),
];

pub(super) const USE_COLOUR: &[Part] = &[
    ID,
    reference(
        "texture",
        Category::Texture,
        "The texture that multiplies the colour, by its ID.",
    ),
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
];

pub(super) const USE_BUMP: &[Part] = &[
    ID,
    reference(
        "bump",
        Category::Texture,
        "The texture whose brightness is a height, by its ID.",
    ),
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    number(
        "height",
        Range::Any,
        0.01,
        "The height of the brightest places, in world units.",
    ),
];
