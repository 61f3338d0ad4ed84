//! Rows of a table: slots by what they hold.

use super::Slot::{self, Word};
use super::{Category, Field, Kind, Part, Range};

/// The word before an ID.
pub(crate) const ID: Slot = Word("ID");

pub(crate) const fn choice(
    key: &'static str,
    words: &'static [&'static str],
    doc: &'static str,
) -> Slot {
    Slot::Field(Field {
        kind: Kind::Choice(words),
        ..Field::point(key, doc)
    })
}

pub(crate) const fn reference(key: &'static str, category: Category, doc: &'static str) -> Slot {
    Slot::Field(Field {
        kind: Kind::Reference(category),
        allowed: Range::Identity,
        usual: Range::Identity,
        step: 1.0,
        ..Field::point(key, doc)
    })
}

pub(crate) const fn point(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field::point(key, doc))
}

/// The point of a solid, this many half edges from its centre along each axis.
pub(crate) const fn place(key: &'static str, offset: [f64; 3], doc: &'static str) -> Slot {
    Slot::Field(Field::point(key, doc).part(Part::Point(offset)))
}

/// The direction of an axis of a solid.
pub(crate) const fn direction(key: &'static str, axis: usize, doc: &'static str) -> Slot {
    Slot::Field(Field::direction(key, doc).part(Part::Axis(axis)))
}

/// The direction of an axis of a solid, whose length counts.
pub(crate) const fn axis(key: &'static str, axis: usize, doc: &'static str) -> Slot {
    let field = Field::direction(key, doc).part(Part::Axis(axis));
    Slot::Field(Field {
        kind: Kind::Axis,
        ..field
    })
}

/// The half edges of a solid along some axes.
pub(crate) const fn radius(key: &'static str, axes: &'static [usize], doc: &'static str) -> Slot {
    Slot::Field(Field::size(key, doc).part(Part::Length(axes, 1.0)))
}

/// The edges of a solid along some axes.
pub(crate) const fn edge(key: &'static str, axes: &'static [usize], doc: &'static str) -> Slot {
    Slot::Field(Field::size(key, doc).part(Part::Length(axes, 2.0)))
}

pub(crate) const fn colour(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field::colour(key, doc))
}

/// A colour that is usually within 0 to 1.
pub(crate) const fn share_of_light(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field::coefficients(key, doc))
}

pub(crate) const fn number(key: &'static str, usual: Range, step: f64, doc: &'static str) -> Slot {
    Slot::Field(Field::number(key, usual, step, doc))
}

/// A number from 0 to 1.
pub(crate) const fn share(key: &'static str, doc: &'static str) -> Slot {
    number(key, Range::Unit, 0.05, doc)
}

/// Two numbers, with a step.
pub(crate) const fn pair(field: Field, step: f64) -> Slot {
    Slot::Field(Field {
        kind: Kind::Pair,
        step,
        ..field
    })
}

/// Width and height of the picture.
pub(crate) const fn pixels(key: &'static str) -> Slot {
    Slot::Field(Field {
        kind: Kind::Pixels,
        allowed: Range::Count,
        usual: Range::Count,
        step: 10.0,
        unit: "pixels",
        ..Field::point(key, "Width and height of the output picture.")
    })
}

/// The size of a solid.
pub(crate) const fn size(key: &'static str, doc: &'static str) -> Slot {
    Slot::Field(Field::size(key, doc))
}

/// The vertical full angle of view.
pub(crate) const fn fov() -> Slot {
    let allowed = Range::Between(0.0, 180.0);
    Slot::Field(Field {
        allowed,
        unit: "degrees",
        ..Field::number("fov", allowed, 1.0, "The vertical full angle of view.")
    })
}
