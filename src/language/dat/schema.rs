//! The records of `.dat`, one slot per row.

use crate::schema::layout::Unit;
use crate::schema::position::words;
use crate::schema::slots::{
    ID, axis, choice, colour, direction, edge, number, pair, pixels, place, point, radius, reference,
    share, share_of_light,
};
use crate::schema::{Category, Field, Kind, Makes, Part, Range, Record, Repeat, Schema, Slot};
use geometry::{Operation, Quadric};
use scene::Shadows;
use Slot::{Id, Word};

/// The projections of a camera, and whether they are perspective.
pub(super) const PROJECTIONS: [(&str, bool); 2] = [("perspective", true), ("orthographic", false)];
/// The types of lights.
pub(super) const SOURCES: [(&str, LightKind); 3] =
    [("pnt", LightKind::Point), ("inf", LightKind::Distant), ("amb", LightKind::Ambient)];
/// Whether a light casts shadows.
pub(super) const SHADOWS: [(&str, Shadows); 2] = [("shadow_on", Shadows::Cast), ("shadow_off", Shadows::Off)];
/// The operations that combine two objects.
pub(super) const OPERATIONS: [(&str, Operation); 3] = [
    ("union", Operation::Union),
    ("intersection", Operation::Intersection),
    ("difference", Operation::Difference),
];

/// Where a light comes from.
#[derive(Clone, Copy, Debug)]
pub(super) enum LightKind {
    Point,
    Distant,
    Ambient,
}

pub(super) static SCHEMA: Schema = Schema {
    extension: "dat",
    noun: "record",
    is_short_at_head: false,
    any_case: false,
    records: &[
        &CAMERA, &RESOLUTION, &VIEWPORT, &LIGHT, &MATERIAL, &SPHERE, &ELLIPSOID, &CYLINDER, &BOX, &CSG, &QUADRIC,
        &CHECKER, &IMAGE, &USE_COLOUR, &USE_BUMP, &RENDER,
    ],
};

const CENTRE: [f64; 3] = [0.0; 3];
const MAT: Slot = Word("mat");
const MATERIAL_ID: Slot = reference("mat", Category::Material, "The material, by its ID.");

pub(super) const CAMERA: Record = Record::new("camera", &["camera"], Makes::View, &[
    choice("projection", &words(&PROJECTIONS), "Rays from the eye (perspective), or side by side (orthographic)."),
    point("eye", "The position of the camera."),
    point("look", "The point the camera looks at."),
    point("up", "Which way is up in the picture; of any length."),
    Slot::Field(Field::length("focal", "From the eye to the image plane; orthographic pictures do not depend on it.")),
    number("near", Range::Any, 0.1, "The picture shows nothing nearer, measured along the view; below 0 counts as 0."),
    number("far", Range::Any, 1.0, "The picture shows nothing farther, measured along the view."),
]);

pub(super) const RESOLUTION: Record = Record::new("resolution", &["resolution"], Makes::View, &[
    pair(Field::length("resolution", "World units per pixel on the image plane, across and up."), 0.001),
]);

pub(super) const VIEWPORT: Record = Record::new("viewport", &["viewport"], Makes::View, &[pixels("viewport")]);

pub(super) const LIGHT: Record = Record::new("light", &["light"], Makes::Node(Category::Light), &[
    ID, Id,
    choice("source", &words(&SOURCES), "From a point (pnt), from infinitely far (inf), from everywhere (amb)."),
    place("position", CENTRE, "The position of a point light."),
    Slot::Field(
        Field::point("direction", "Where the light travels; all zero for a point light that emits equally in all directions.")
            .part(Part::Direction),
    ),
    colour("colour", "The light it emits."),
    number("a0", Range::NotNegative, 0.1, "Falloff: 1 / (a0 + a1 d + a2 d²) at distance d."),
    number("a1", Range::NotNegative, 0.01, "Falloff with the distance."),
    number("a2", Range::NotNegative, 0.001, "Falloff with the distance squared."),
    Slot::Field(
        Field::number("aa", Range::NotNegative, 1.0, "Falloff with the angle from the direction: the exponent of its cosine; 0 for none.")
            .reading_as(0.0),
    ),
    choice("shadow", &words(&SHADOWS), "Whether objects cast shadows in this light."),
]);

pub(super) const MATERIAL: Record = Record::new("mat", &["mat"], Makes::Node(Category::Material), &[
    ID, Id,
    share_of_light("RGB", "The colour that Ka, Kd and Ks multiply, and textures as well."),
    share("Ka", "Ambient coefficient: fraction of ambient light reflected."),
    share("Kd", "Diffuse coefficient: fraction of light reflected diffusely."),
    number("Ks", Range::NotNegative, 0.05, "Specular coefficient: strength of the highlight, in the material's colour."),
    Slot::Field(
        Field::number("ns", Range::NotNegative, 1.0, "Specular exponent: how small the highlight is; below 0 reads as 0.")
            .reading_as(0.0),
    ),
    share("Kt", "Transmission coefficient: weight of transmitted light."),
    share("Kr", "Reflection coefficient: weight of reflected light."),
    Slot::Field(
        Field::number("ior", Range::NotNegative, 0.05, "Index of refraction; 0 or less reads as 1.").reading_as(1.0),
    ),
]);

pub(super) const SPHERE: Record = solid("sphere", &["obj", "sphere"], Unit::Sphere, &[
    ID, Id, MAT, ID, MATERIAL_ID,
    place("centre", CENTRE, "The sphere's centre."),
    radius("radius", &[0, 1, 2], "The sphere's radius."),
]);

pub(super) const ELLIPSOID: Record = solid("ellipsoid", &["obj", "ellipsoid"], Unit::Ellipsoid, &[
    ID, Id, MAT, ID, MATERIAL_ID,
    place("centre", CENTRE, "The ellipsoid's centre."),
    radius("rx", &[0], "Semi-axis along x."),
    radius("ry", &[1], "Semi-axis along y."),
    radius("rz", &[2], "Semi-axis along z."),
]);

pub(super) const CYLINDER: Record = solid("cylinder", &["obj", "cylinder"], Unit::Cylinder, &[
    ID, Id, MAT, ID, MATERIAL_ID,
    place("centre", CENTRE, "The middle of the axis."),
    direction("axis", 2, "Direction of the axis."),
    radius("radius", &[0, 1], "The cylinder's radius."),
    edge("length", &[2], "From one end to the other."),
]);

pub(super) const BOX: Record = solid("box", &["obj", "box"], Unit::Box, &[
    ID, Id, MAT, ID, MATERIAL_ID,
    place("centre", CENTRE, "The box's centre."),
    axis("u", 0, "Direction of the first edges."),
    axis("v", 1, "Direction of the second edges."),
    axis("w", 2, "Direction of the third edges, u × v."),
    edge("uw", &[0], "Full width along u, in lengths of u."),
    edge("vw", &[1], "Full width along v, in lengths of v."),
    edge("ww", &[2], "Full width along w, in lengths of w."),
]);

pub(super) const CSG: Record = Record::new("CSG", &["obj", "CSG"], Makes::Node(Category::Object), &[
    ID, Id,
    Slot::Field(Field {
        kind: Kind::Choice(&words(&OPERATIONS)),
        other_spellings: &[("intersect", "intersection")],
        ..Field::point("operator", "Both together, what both share, or the first without the second.")
    }),
    ID, reference("first", Category::Object, "The first object, by its ID."),
    ID, reference("second", Category::Object, "The second object, by its ID."),
]);

pub(super) const QUADRIC: Record = Record::new("quadric", &["obj", "quadric"], Makes::Node(Category::Object), &[
    ID, Id, MAT, ID, MATERIAL_ID,
    coefficient("A", "Inside is Ax² + 2Bxy + 2Cxz + 2Dx + Ey² + 2Fyz + 2Gy + Hz² + 2Iz + J ≤ 0."),
    coefficient("B", "Of 2xy."),
    coefficient("C", "Of 2xz."),
    coefficient("D", "Of 2x."),
    coefficient("E", "Of y²."),
    coefficient("F", "Of 2yz."),
    coefficient("G", "Of 2y."),
    coefficient("H", "Of z²."),
    coefficient("I", "Of 2z."),
    coefficient("J", "The constant."),
]).repeating(Repeat {
    noun: "cut",
    slots: &[Slot::Field(Field {
        kind: Kind::HalfSpace,
        ..Field::point("cut", "Only points with n·x ≤ d remain; the normal n may have any length above 0.")
    })],
    most: Quadric::MOST_HALF_SPACES,
    none: "no cuts",
    hint: "a cut takes 4 numbers: normal x y z, distance d",
});

pub(super) const CHECKER: Record = Record::new("checker", &["texture"], Makes::Node(Category::Texture), &[
    ID, Id, Word("checker"),
    REPEAT,
    share_of_light("first", "The colour of the square at uv 0, 0."),
    share_of_light("second", "The colour of the squares beside it."),
]);

pub(super) const IMAGE: Record = Record::new("image", &["texture"], Makes::Node(Category::Texture), &[
    ID, Id, Word("image"),
    REPEAT,
    Slot::Field(Field { kind: Kind::Word, ..Field::point("file", "The picture's path, from the scene's folder.") }),
]);

pub(super) const USE_COLOUR: Record = Record::new("use colour", &["use", "colour"], Makes::Use(Category::Material), &[
    ID, reference("texture", Category::Texture, "The texture that multiplies the colour, by its ID."),
    MAT, ID, MATERIAL_ID,
]);

pub(super) const USE_BUMP: Record = Record::new("use bump", &["use", "bump"], Makes::Use(Category::Material), &[
    ID, reference("bump", Category::Texture, "The texture whose brightness is a height, by its ID."),
    MAT, ID, MATERIAL_ID,
    number("height", Range::Any, 0.01, "The height of the brightest places, in world units."),
]);

pub(super) const RENDER: Record = Record::new("render", &["render"], Makes::List, &[]).repeating(Repeat {
    noun: "object",
    slots: &[ID, reference("ID", Category::Object, "An object to draw, by its ID.")],
    most: usize::MAX,
    none: "all objects",
    hint: "each object is given as `ID` and its number",
});

const REPEAT: Slot = pair(Field::point("repeat", "How often it repeats over the unit square of uv."), 1.0);

const fn coefficient(key: &'static str, doc: &'static str) -> Slot {
    number(key, Range::Any, 0.1, doc)
}

const fn solid(name: &'static str, heads: &'static [&'static str], unit: Unit, slots: &'static [Slot]) -> Record {
    Record::new(name, heads, Makes::Solid(unit), slots)
}
