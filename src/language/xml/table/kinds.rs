//! The kinds of objects, materials and lights, named by `type`.

use super::{Parameter, lights, materials};

/// The kinds of objects.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::xml) enum ObjectKind {
    /// A sphere of radius 1.
    Sphere,
    /// A square from −1 to 1 in x and y.
    Plane,
    /// A mesh from a file.
    Obj,
    /// The objects in it.
    Group,
}

/// The shading models of materials.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::xml) enum MaterialKind {
    /// A highlight around the normal.
    Blinn,
    /// A highlight around the reflected direction.
    Phong,
    /// Microfacets.
    Microfacet,
}

/// The kinds of lights.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::xml) enum LightKind {
    /// From everywhere.
    Ambient,
    /// From one direction.
    Direct,
    /// From one point.
    Point,
}

impl ObjectKind {
    /// The values of `type`; a group has none.
    pub(in crate::xml) const TYPES: &'static [&'static str] = &["sphere", "plane", "obj"];

    /// The kind for a type, ignoring case.
    pub(in crate::xml) fn of(word: &str) -> Option<Self> {
        let kinds = [Self::Sphere, Self::Plane, Self::Obj];
        Some(kinds[place(Self::TYPES, word)?])
    }

    /// The name of the kind.
    pub(in crate::xml) const fn word(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Plane => "plane",
            Self::Obj => "obj",
            Self::Group => "group",
        }
    }
}

impl MaterialKind {
    /// The values of `type`.
    pub(in crate::xml) const TYPES: &'static [&'static str] = &["blinn", "phong", "microfacet"];

    /// The kind for a type, ignoring case.
    pub(in crate::xml) fn of(word: &str) -> Option<Self> {
        let kinds = [Self::Blinn, Self::Phong, Self::Microfacet];
        Some(kinds[place(Self::TYPES, word)?])
    }

    /// The name of the kind.
    pub(in crate::xml) const fn word(self) -> &'static str {
        Self::TYPES[self as usize]
    }

    /// Its parameters.
    pub(in crate::xml) fn parameters(self) -> &'static [&'static Parameter] {
        match self {
            Self::Blinn | Self::Phong => materials::GLOSSY,
            Self::Microfacet => materials::MICROFACET,
        }
    }
}

impl LightKind {
    /// The values of `type`.
    pub(in crate::xml) const TYPES: &'static [&'static str] = &["ambient", "direct", "point"];

    /// The kind for a type, ignoring case.
    pub(in crate::xml) fn of(word: &str) -> Option<Self> {
        let kinds = [Self::Ambient, Self::Direct, Self::Point];
        Some(kinds[place(Self::TYPES, word)?])
    }

    /// The name of the kind.
    pub(in crate::xml) const fn word(self) -> &'static str {
        Self::TYPES[self as usize]
    }

    /// Its parameters.
    pub(in crate::xml) fn parameters(self) -> &'static [&'static Parameter] {
        match self {
            Self::Ambient => lights::AMBIENT,
            Self::Direct => lights::DIRECT,
            Self::Point => lights::POINT,
        }
    }
}

fn place(words: &[&str], name: &str) -> Option<usize> {
    words
        .iter()
        .position(|word| word.eq_ignore_ascii_case(name))
}
