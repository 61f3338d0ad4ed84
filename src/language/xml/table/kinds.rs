//! The kinds of object, material and light, as `type` says them.

use super::{AMBIENT, DIRECT, MATERIAL, MICROFACET, POINT, Parameter};

/// What an object is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::language::xml) enum ObjectKind {
    /// A ball of radius 1.
    Sphere,
    /// A square from −1 to 1.
    Plane,
    /// A mesh from a file.
    Obj,
    /// What is in it.
    Group,
}

/// How a material is shaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::language::xml) enum MaterialKind {
    /// A highlight around the normal.
    Blinn,
    /// A highlight around the mirrored direction.
    Phong,
    /// Little mirrors.
    Microfacet,
}

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::language::xml) enum LightKind {
    /// Everywhere.
    Ambient,
    /// One direction.
    Direct,
    /// One point.
    Point,
}

impl ObjectKind {
    /// What `type` says; a group has none.
    pub(in crate::language::xml) const TYPES: &'static [&'static str] = &["sphere", "plane", "obj"];

    /// The kind of a type, in any case.
    pub(in crate::language::xml) fn of(word: &str) -> Option<Self> {
        let kinds = [Self::Sphere, Self::Plane, Self::Obj];
        Some(kinds[place(Self::TYPES, word)?])
    }

    /// What it is called.
    pub(in crate::language::xml) const fn word(self) -> &'static str {
        match self {
            Self::Sphere => "sphere",
            Self::Plane => "plane",
            Self::Obj => "obj",
            Self::Group => "group",
        }
    }
}

impl MaterialKind {
    /// What `type` says.
    pub(in crate::language::xml) const TYPES: &'static [&'static str] =
        &["blinn", "phong", "microfacet"];

    /// The kind of a type, in any case.
    pub(in crate::language::xml) fn of(word: &str) -> Option<Self> {
        let kinds = [Self::Blinn, Self::Phong, Self::Microfacet];
        Some(kinds[place(Self::TYPES, word)?])
    }

    /// What it is called.
    pub(in crate::language::xml) const fn word(self) -> &'static str {
        Self::TYPES[self as usize]
    }

    /// What it has.
    pub(in crate::language::xml) fn parameters(self) -> &'static [Parameter] {
        match self {
            Self::Blinn | Self::Phong => &MATERIAL,
            Self::Microfacet => &MICROFACET,
        }
    }
}

impl LightKind {
    /// What `type` says.
    pub(in crate::language::xml) const TYPES: &'static [&'static str] =
        &["ambient", "direct", "point"];

    /// The kind of a type, in any case.
    pub(in crate::language::xml) fn of(word: &str) -> Option<Self> {
        let kinds = [Self::Ambient, Self::Direct, Self::Point];
        Some(kinds[place(Self::TYPES, word)?])
    }

    /// What it is called.
    pub(in crate::language::xml) const fn word(self) -> &'static str {
        Self::TYPES[self as usize]
    }

    /// What it has.
    pub(in crate::language::xml) fn parameters(self) -> &'static [Parameter] {
        match self {
            Self::Ambient => &AMBIENT,
            Self::Direct => &DIRECT,
            Self::Point => &POINT,
        }
    }
}

fn place(words: &[&str], said: &str) -> Option<usize> {
    words
        .iter()
        .position(|word| word.eq_ignore_ascii_case(said))
}
