//! The table of fields of `.dat`, record by record.

mod parts;

use crate::slot::{At, is_same};
use crate::table::Field;
use parts::{
    BOX, CAMERA, CHECKER, CSG, CYLINDER, ELLIPSOID, IMAGE, LIGHT, MATERIAL, QUADRIC, RESOLUTION,
    SPHERE, USE_BUMP, USE_COLOUR, VIEWPORT,
};

pub(super) use parts::{HALF_SPACE, LightKind, OPERATIONS, PROJECTIONS, SHADOWS, SOURCES};

/// A part of a record, after the words that identify its kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Part {
    /// A fixed word.
    Word(&'static str),
    /// The ID by which other records refer to this one.
    Id,
    /// A field.
    Field(Field),
}

impl Part {
    /// The number of tokens.
    pub(super) const fn tokens(&self) -> usize {
        match self {
            Self::Word(_) | Self::Id => 1,
            Self::Field(field) => field.kind.components(),
        }
    }
}

/// The kinds of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum RecordKind {
    /// The camera: its position, direction and lens.
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
    /// A use of a texture by a material.
    Use(UseKind),
    /// The list of objects to draw.
    Render,
}

/// The kinds of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum ObjectKind {
    /// A sphere.
    Sphere,
    /// An axis-aligned ellipsoid.
    Ellipsoid,
    /// A closed circular cylinder.
    Cylinder,
    /// A box.
    Box,
    /// A combination of two objects.
    Csg,
    /// A general quadric clipped by half-spaces.
    Quadric,
}

/// The kinds of textures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum TextureKind {
    /// A checkerboard of two colours.
    Checker,
    /// A picture from a file.
    Image,
}

/// The uses of a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum UseKind {
    /// The texture multiplies the material's colour.
    Colour,
    /// The texture's brightness is a height.
    Bump,
}

/// The words that identify the kind of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Heads {
    /// The first word alone.
    One(RecordKind),
    /// The first word and one of these.
    Two(&'static [(&'static str, RecordKind)]),
}

/// The first words of records.
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

impl ObjectKind {
    /// The position of the numbers of the field with this key.
    pub(super) const fn at<const N: usize>(self, key: &str) -> At<N> {
        RecordKind::Object(self).at(key)
    }

    /// The word after `obj`.
    pub(super) fn keyword(self) -> &'static str {
        OBJECTS
            .iter()
            .find(|(_, kind)| *kind == RecordKind::Object(self))
            .map_or("", |(word, _)| word)
    }
}

impl RecordKind {
    /// The parts after the words that identify the kind. A quadric's half-spaces and the objects
    /// listed by `render` follow, as many as the text declares.
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

    /// The number of numbers in its fields.
    pub(super) const fn numbers(self) -> usize {
        let parts = self.parts();
        let (mut at, mut numbers) = (0, 0);
        while at < parts.len() {
            if let Part::Field(field) = &parts[at] {
                numbers += field.kind.components();
            }
            at += 1;
        }
        numbers
    }

    /// The number of words that identify the kind.
    pub(super) const fn heads(self) -> usize {
        match self {
            Self::Object(_) | Self::Use(_) => 2,
            _ => 1,
        }
    }

    /// The position of the numbers of the field with this key.
    pub(super) const fn at<const N: usize>(self, key: &str) -> At<N> {
        let parts = self.parts();
        let (mut at, mut before) = (0, 0);
        while at < parts.len() {
            if let Part::Field(field) = &parts[at] {
                if is_same(field.key, key) {
                    return At::after(before, field);
                }
                before += field.kind.components();
            }
            at += 1;
        }
        panic!("the record has such a field")
    }

    /// Its fields, in text order.
    pub(super) fn fields(self) -> impl Iterator<Item = &'static Field> + Clone {
        self.parts().iter().filter_map(|part| match part {
            Part::Field(field) => Some(field),
            Part::Word(_) | Part::Id => None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_have_the_number_of_tokens_that_the_format_defines() {
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
