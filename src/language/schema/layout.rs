//! Where the numbers of a record place a unit solid: the one description from which solids are read,
//! moved, turned, scaled, changed to other kinds and added.

use glam::DVec3;

use super::position::At;
use super::{Field, Kind, Part, Slot};
use crate::form::digits;
use crate::form::digits::Lengths;
use crate::form::{Form, rotated};
use geometry::{Affine, Cone, Cuboid, Cylinder, Ellipsoid, Solid, Sphere, normalise};

/// The unit solids.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A sphere with a single radius.
    Sphere,
    /// A sphere around the origin.
    Ellipsoid,
    /// A cube with a corner at the origin.
    Box,
    /// A closed cylinder from the origin along the last axis.
    Cylinder,
    /// A closed cone, its base at the origin, along the last axis.
    Cone,
}

impl Unit {
    /// Its origin, in half edges from its centre along each axis.
    const fn origin(self) -> [f64; 3] {
        match self {
            Self::Sphere | Self::Ellipsoid => [0.0; 3],
            Self::Box => [-1.0; 3],
            Self::Cylinder | Self::Cone => [0.0, 0.0, -1.0],
        }
    }
}

/// The positions of a solid's numbers in its record.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Layout {
    unit: Unit,
    point: At<3>,
    /// Where the point is, in half edges from the centre along each axis.
    offset: [f64; 3],
    /// No axis: they are the world's. Only the last: the shortest rotation from z gives the others.
    axes: [Option<At<3>>; 3],
    lengths: [At<1>; 3],
    /// What each length measures, in half edges.
    halves: [f64; 3],
    /// Whether lengths are multiples of the directions' own.
    is_relative: bool,
}

/// Why numbers cannot describe a form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unfit {
    /// There is one length for all directions.
    Uneven,
    /// There is one length for both directions of the base.
    Elliptic,
    /// The axes are always the world's.
    Turned,
}

impl Layout {
    /// The layout of a record with these slots.
    pub(super) const fn of(unit: Unit, slots: &[Slot]) -> Self {
        let nowhere = At::<1>::first(0);
        let mut layout = Self {
            unit,
            point: At::<3>::first(0),
            offset: [0.0; 3],
            axes: [None; 3],
            lengths: [nowhere; 3],
            halves: [1.0; 3],
            is_relative: false,
        };
        let (mut slot, mut before) = (0, 0);
        while slot < slots.len() {
            if let Slot::Field(field) = &slots[slot] {
                layout.add(field, before);
            }
            before += slots[slot].numbers();
            slot += 1;
        }
        layout
    }

    const fn add(&mut self, field: &Field, before: usize) {
        match field.part {
            Part::Point(offset) => {
                (self.point, self.offset) = (At::after(before, field), offset);
            }
            Part::Axis(axis) => {
                self.axes[axis] = Some(At::after(before, field));
                self.is_relative |= matches!(field.kind, Kind::Axis);
            }
            Part::Length(axes, halves) => {
                let mut at = 0;
                while at < axes.len() {
                    self.lengths[axes[at]] = At::after(before, field);
                    self.halves[axes[at]] = halves;
                    at += 1;
                }
            }
            Part::None | Part::Direction => {}
        }
    }

    /// The positions of its directions, if it has three.
    pub(crate) fn frame(&self) -> Option<[At<3>; 3]> {
        let [a, b, c] = self.axes;
        Some([a?, b?, c?])
    }

    /// Whether lengths are multiples of the directions' own.
    pub(crate) fn is_relative(&self) -> bool {
        self.is_relative
    }

    /// The solid with these numbers; `None` if its frame overflows or has no volume.
    pub(crate) fn solid(&self, numbers: &[f64]) -> Option<Solid> {
        Some(match self.unit {
            Unit::Sphere => Solid::Sphere(Sphere {
                centre: self.point.vector(numbers),
                radius: self.lengths[0].number(numbers),
            }),
            Unit::Ellipsoid => Solid::Ellipsoid(Box::new(Ellipsoid(self.affine(numbers)?))),
            Unit::Box => Solid::Cuboid(Box::new(Cuboid(self.affine(numbers)?))),
            Unit::Cylinder => Solid::Cylinder(Box::new(Cylinder(self.affine(numbers)?))),
            Unit::Cone => Solid::Cone(Box::new(Cone(self.affine(numbers)?))),
        })
    }

    /// The frame of the unit solid. Directions are used as given.
    fn affine(&self, numbers: &[f64]) -> Option<Affine> {
        let directions = match self.frame() {
            Some(axes) => axes.map(|at| at.vector(numbers)),
            None => self.axes(numbers)?,
        };
        let mut origin = self.point.vector(numbers);
        let target = self.unit.origin();
        if target != self.offset {
            let edge = |axis: usize| {
                let edges = (self.offset[axis] - target[axis]) / self.halves[axis];
                edges * self.lengths[axis].number(numbers) * directions[axis]
            };
            origin -= edge(0) + edge(1) + edge(2);
        }
        Affine::new(origin, directions, self.lengths(numbers).into())
    }

    /// The lengths in space.
    pub(crate) fn lengths(&self, numbers: &[f64]) -> [f64; 3] {
        let length =
            |axis: usize| self.lengths[axis].number(numbers) * self.unit_length(axis, numbers);
        [0, 1, 2].map(length)
    }

    /// The length that a length of 1 has in space.
    fn unit_length(&self, axis: usize, numbers: &[f64]) -> f64 {
        match self.axes[axis].filter(|_| self.is_relative) {
            Some(at) => at.vector(numbers).length(),
            None => 1.0,
        }
    }

    /// The unit vectors of its axes; `None` if it has only one and that is 0.
    fn axes(&self, numbers: &[f64]) -> Option<[DVec3; 3]> {
        let unit = |at: At<3>| normalise(at.vector(numbers));
        Some(match self.axes {
            [None, None, None] => DVec3::AXES,
            [None, None, Some(last)] => rotated(unit(last)?),
            axes => axes.map(|at| at.and_then(unit).unwrap_or(DVec3::X)),
        })
    }

    /// The form of a solid with these numbers; `None` if its only direction is 0.
    pub(crate) fn form(&self, numbers: &[f64]) -> Option<Form> {
        let axes = self.axes(numbers)?;
        let lengths = self.lengths(numbers);
        let half = [0, 1, 2].map(|axis| lengths[axis] / self.halves[axis]);
        let centre = self.point.vector(numbers) - self.offset(&axes, &half);
        Some(Form { centre, axes, half })
    }

    /// Writes the numbers of a form.
    ///
    /// # Errors
    ///
    /// Fails if they cannot describe it.
    pub(crate) fn put(&self, form: &Form, numbers: &mut [f64]) -> Result<(), Unfit> {
        let is_near = |one: f64, other: f64| (one - other).abs() <= 1e-9 * one.abs();
        let [a, b, c] = form.half;
        if self.lengths[0] == self.lengths[1] && !is_near(a, b) {
            let is_round = self.lengths[1] == self.lengths[2];
            return Err(if is_round {
                Unfit::Uneven
            } else {
                Unfit::Elliptic
            });
        }
        if self.lengths[1] == self.lengths[2] && !is_near(b, c) {
            return Err(Unfit::Uneven);
        }
        let mut half = form.half;
        if self.axes == [None; 3] && !self.is_round() {
            if !form.is_aligned() {
                return Err(Unfit::Turned);
            }
            half = form.aligned();
        }
        let point = form.centre + self.offset(&form.axes, &half);
        self.point.put(numbers, point.to_array());
        for (axis, half) in half.into_iter().enumerate() {
            let unit = match self.unit_length(axis, numbers) {
                0.0 => 1.0,
                length => length,
            };
            if let Some(at) = self.axes[axis] {
                at.put(numbers, (unit * form.axes[axis]).to_array());
            }
            self.lengths[axis].put(numbers, [self.halves[axis] * half / unit]);
        }
        Ok(())
    }

    /// Leaves out digits of directions that differ from the old ones, as far as they point within this
    /// angle of where they do.
    pub(crate) fn shorten_axes(&self, old: &[f64], new: &mut [f64], within: f64) {
        let lengths = if self.is_relative {
            Lengths::Kept
        } else {
            Lengths::Unit
        };
        for at in self.axes.iter().flatten() {
            let [before, meant] = [at.vector(old), at.vector(new)];
            let written = digits::direction(before, meant, lengths, within);
            at.put(new, written.to_array());
        }
    }

    /// The form of this solid that comes nearest to another.
    pub(crate) fn nearest(&self, form: &Form) -> Form {
        let [a, b, c] = form.half;
        if self.is_round() {
            let half = [libm::cbrt(a * b * c); 3];
            return Form { half, ..*form };
        }
        if self.axes == [None; 3] {
            let (axes, half) = (DVec3::AXES, form.aligned());
            return Form {
                axes,
                half,
                ..*form
            };
        }
        let base = if self.lengths[0] == self.lengths[1] {
            [0.5 * (a + b); 2]
        } else {
            [a, b]
        };
        Form {
            half: [base[0], base[1], c],
            ..*form
        }
    }

    /// Whether it has one length for all directions.
    fn is_round(&self) -> bool {
        self.lengths[0] == self.lengths[1] && self.lengths[1] == self.lengths[2]
    }

    /// From the centre to the point.
    fn offset(&self, axes: &[DVec3; 3], half: &[f64; 3]) -> DVec3 {
        let along = |axis: usize| self.offset[axis] * half[axis] * axes[axis];
        (0..3).map(along).sum()
    }
}
