//! The fields of `.dat`, record by record.

use crate::language::table::{Category, Field, Kind, Range};

/// What stands at a place of a record, after the words that say which record it is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    /// Just this word.
    Word(&'static str),
    /// The number by which other records know this one.
    Id,
    /// A field.
    Field(Field),
}

impl Part {
    /// How many tokens it takes.
    pub(super) const fn tokens(&self) -> usize {
        match self {
            Self::Word(_) | Self::Id => 1,
            Self::Field(field) => field.kind.components(),
        }
    }
}

/// The kinds of record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum RecordKind {
    /// Where the camera stands and how it sees.
    Camera,
    /// World units per pixel.
    Resolution,
    /// Size of the picture.
    Viewport,
    /// A light.
    Light,
    /// A material.
    Material,
    /// An object.
    Object(ObjectKind),
    /// A texture.
    Texture(TextureKind),
    /// What a texture does to a material.
    Use(UseKind),
    /// Which objects are drawn.
    Render,
}

/// The kinds of object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ObjectKind {
    /// A sphere.
    Sphere,
    /// An ellipsoid along the axes of the world.
    Ellipsoid,
    /// A closed round cylinder.
    Cylinder,
    /// A box.
    Box,
    /// Two objects combined.
    Csg,
    /// A general quadric cut by half-spaces.
    Quadric,
}

/// The kinds of texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum TextureKind {
    /// Two colours in squares.
    Checker,
    /// A picture from a file.
    Image,
}

/// What a texture is used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum UseKind {
    /// Its colour multiplies the material's.
    Colour,
    /// Its brightness is a height.
    Bump,
}

/// The words that may follow the first word of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Heads {
    /// The first word says it all.
    One(RecordKind),
    /// The second word says which kind it is.
    Two(&'static [(&'static str, RecordKind)]),
}

/// The words that a record may begin with.
pub(super) const RECORDS: &[(&str, Heads)] = &[
    ("camera", Heads::One(RecordKind::Camera)),
    ("resolution", Heads::One(RecordKind::Resolution)),
    ("viewport", Heads::One(RecordKind::Viewport)),
    ("light", Heads::One(RecordKind::Light)),
    ("mat", Heads::One(RecordKind::Material)),
    ("obj", Heads::Two(OBJECTS)),
    (
        "texture",
        Heads::One(RecordKind::Texture(TextureKind::Checker)),
    ),
    (
        "use",
        Heads::Two(&[
            ("colour", RecordKind::Use(UseKind::Colour)),
            ("bump", RecordKind::Use(UseKind::Bump)),
        ]),
    ),
    ("render", Heads::One(RecordKind::Render)),
];

const OBJECTS: &[(&str, RecordKind)] = &[
    ("sphere", RecordKind::Object(ObjectKind::Sphere)),
    ("ellipsoid", RecordKind::Object(ObjectKind::Ellipsoid)),
    ("cylinder", RecordKind::Object(ObjectKind::Cylinder)),
    ("box", RecordKind::Object(ObjectKind::Box)),
    ("CSG", RecordKind::Object(ObjectKind::Csg)),
    ("quadric", RecordKind::Object(ObjectKind::Quadric)),
];

/// The words by which a record says how the camera sees.
pub(super) const PROJECTIONS: &[&str] = &["perspective", "orthographic"];
/// The words by which a light says what it is.
pub(super) const SOURCES: &[&str] = &["pnt", "inf", "amb"];
/// The words by which a light says whether it casts shadows.
pub(super) const SHADOWS: &[&str] = &["shadow_on", "shadow_off"];
/// The words by which an object says how two others are combined.
pub(super) const OPERATIONS: &[&str] = &["union", "intersection", "difference"];

impl ObjectKind {
    /// The word after `obj`.
    pub(super) fn keyword(self) -> &'static str {
        OBJECTS
            .iter()
            .find(|(_, kind)| *kind == RecordKind::Object(self))
            .map_or("", |(word, _)| word)
    }
}

impl RecordKind {
    /// What follows the words that begin the record. A quadric's half-spaces and the objects that
    /// `render` lists come on top: as many as the text says.
    pub(super) const fn parts(self) -> &'static [Part] {
        match self {
            Self::Camera => CAMERA,
            Self::Resolution => RESOLUTION,
            Self::Viewport => VIEWPORT,
            Self::Light => LIGHT,
            Self::Material => MATERIAL,
            Self::Object(ObjectKind::Sphere) => SPHERE,
            Self::Object(ObjectKind::Ellipsoid) => ELLIPSOID,
            Self::Object(ObjectKind::Cylinder) => CYLINDER,
            Self::Object(ObjectKind::Box) => BOX,
            Self::Object(ObjectKind::Csg) => CSG,
            Self::Object(ObjectKind::Quadric) => QUADRIC,
            Self::Texture(TextureKind::Checker) => CHECKER,
            Self::Texture(TextureKind::Image) => IMAGE,
            Self::Use(UseKind::Colour) => USE_COLOUR,
            Self::Use(UseKind::Bump) => USE_BUMP,
            Self::Render => &[],
        }
    }

    /// How many words say which record it is.
    pub(super) const fn heads(self) -> usize {
        match self {
            Self::Object(_) | Self::Use(_) => 2,
            _ => 1,
        }
    }

    /// Its fields, in the order of the text.
    pub(super) fn fields(self) -> impl Iterator<Item = &'static Field> + Clone {
        self.parts().iter().filter_map(|part| match part {
            Part::Field(field) => Some(field),
            Part::Word(_) | Part::Id => None,
        })
    }
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

const CAMERA: &[Part] = &[
    choice(
        "projection",
        PROJECTIONS,
        "Rays from the eye (perspective), or side by side (orthographic).",
    ),
    point("eye", "Where the camera stands."),
    point("look", "The point the camera looks at."),
    point("up", "Which way is up in the picture; of any length."),
    size(
        "focal",
        "From the eye to the image plane; orthographic pictures do not depend on it.",
    ),
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

const RESOLUTION: &[Part] = &[Part::Field(Field {
    step: 0.001,
    ..pair(Field::size(
        "resolution",
        "World units per pixel on the image plane, across and up.",
    ))
})];

const VIEWPORT: &[Part] = &[Part::Field(Field {
    kind: Kind::Pixels,
    allowed: Range::Count,
    usual: Range::Count,
    step: 10.0,
    unit: "pixels",
    ..Field::point("viewport", "Width and height of the output picture.")
})];

const LIGHT: &[Part] = &[
    ID,
    Part::Id,
    choice(
        "source",
        SOURCES,
        "From a point (pnt), from infinitely far (inf), from everywhere (amb).",
    ),
    point("position", "Where a point light stands."),
    point(
        "direction",
        "Where the light goes; all zero for a point light that sends the same everywhere.",
    ),
    colour("colour", "What the light sends."),
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
        SHADOWS,
        "Whether objects keep this light from others.",
    ),
];

const MATERIAL: &[Part] = &[
    ID,
    Part::Id,
    Part::Field(Field::coefficients(
        "RGB",
        "The colour that Ka, Kd and Ks multiply, and textures as well.",
    )),
    share(
        "Ka",
        "Ambient coefficient: share of ambient light sent back.",
    ),
    share(
        "Kd",
        "Diffuse coefficient: share of light sent back evenly.",
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
        "Transmission coefficient: weight of what is seen through it.",
    ),
    share("Kr", "Reflection coefficient: weight of what is mirrored."),
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

const SPHERE: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("mat"),
    ID,
    MATERIAL_ID,
    point("centre", "The sphere's centre."),
    size("radius", "The sphere's radius."),
];

const ELLIPSOID: &[Part] = &[
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

const CYLINDER: &[Part] = &[
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

const BOX: &[Part] = &[
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

const CSG: &[Part] = &[
    ID,
    Part::Id,
    choice(
        "operator",
        OPERATIONS,
        "Both together, what both share, or the first without the second.",
    ),
    ID,
    reference("first", Category::Object, "The first object, by its ID."),
    ID,
    reference("second", Category::Object, "The second object, by its ID."),
];

const QUADRIC: &[Part] = &[
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

/// A face that cuts a quadric.
pub(super) const HALF_SPACE: &Field = &Field {
    kind: Kind::HalfSpace,
    ..Field::point(
        "cut",
        "Only what has n·x ≤ d stays; the normal n is of any length above 0.",
    )
};

const REPEAT: Part = Part::Field(Field {
    step: 1.0,
    ..pair(Field::point(
        "repeat",
        "How often it repeats over the unit square of uv.",
    ))
});

const CHECKER: &[Part] = &[
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

const IMAGE: &[Part] = &[
    ID,
    Part::Id,
    Part::Word("image"),
    REPEAT,
    Part::Field(Field {
        kind: Kind::Word,
        ..Field::point("file", "The picture's path, from the scene's folder.")
    }),
];

const USE_COLOUR: &[Part] = &[
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

const USE_BUMP: &[Part] = &[
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
        "How high the brightest places stand, in world units.",
    ),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_take_as_many_tokens_as_the_format_says() {
        let tokens =
            |kind: RecordKind| kind.heads() + kind.parts().iter().map(Part::tokens).sum::<usize>();
        for (line, kind) in [
            (
                "camera perspective 0 0 0  0 0 1  0 1 0  1 0 9",
                RecordKind::Camera,
            ),
            ("resolution 1 1", RecordKind::Resolution),
            ("viewport 4 3", RecordKind::Viewport),
            (
                "light ID 0 pnt 0 0 8  0 0 -1  1 1 1  1 0 0  10 shadow_on",
                RecordKind::Light,
            ),
            (
                "mat ID 0  1 1 1  0.1 0.8 0.1 5  0 0 0",
                RecordKind::Material,
            ),
            (
                "obj sphere ID 0 mat ID 1  0 0 2  1",
                RecordKind::Object(ObjectKind::Sphere),
            ),
            (
                "obj ellipsoid ID 0 mat ID 1  0 0 2  1 1 1",
                RecordKind::Object(ObjectKind::Ellipsoid),
            ),
            (
                "obj cylinder ID 0 mat ID 1  0 0 2  0 0 1  1 2",
                RecordKind::Object(ObjectKind::Cylinder),
            ),
            (
                "obj box ID 0 mat ID 1  0 0 2  1 0 0  0 1 0  0 0 1  1 2 3",
                RecordKind::Object(ObjectKind::Box),
            ),
            (
                "obj CSG ID 6 difference ID 5 ID 2",
                RecordKind::Object(ObjectKind::Csg),
            ),
            (
                "obj quadric ID 0 mat ID 1  1 0 0 0 1 0 0 1 0 -1",
                RecordKind::Object(ObjectKind::Quadric),
            ),
            (
                "texture ID 0 checker 4 4  1 1 1  0 0 0",
                RecordKind::Texture(TextureKind::Checker),
            ),
            (
                "texture ID 0 image 1 1 wood.png",
                RecordKind::Texture(TextureKind::Image),
            ),
            ("use colour ID 0 mat ID 1", RecordKind::Use(UseKind::Colour)),
            ("use bump ID 0 mat ID 1 0.1", RecordKind::Use(UseKind::Bump)),
        ] {
            assert_eq!(tokens(kind), line.split_whitespace().count(), "{line}");
        }
    }
}
