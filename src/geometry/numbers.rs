//! The numbers that a frame or a unit vector was made of, found again to the last bit.

use glam::DVec3;

use super::transform::length;
use super::{Affine, normalise};

/// Maximum number of pairs of a direction and a length kept for one axis.
const MOST: usize = 4;

/// The arguments of [`Affine::new`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrameNumbers {
    /// The origin.
    pub origin: DVec3,
    /// Directions, about of unit length.
    pub directions: [DVec3; 3],
    /// The lengths along them.
    pub lengths: DVec3,
}

impl FrameNumbers {
    /// The frame; `None` if it is too flat.
    pub fn affine(&self) -> Option<Affine> {
        Affine::new(self.origin, self.directions, self.lengths)
    }

    /// The columns of the unit-to-world matrix.
    pub fn columns(&self) -> [DVec3; 3] {
        [0, 1, 2].map(|axis| self.lengths[axis] * self.directions[axis])
    }
}

impl Affine {
    /// The numbers of the frame, as short as they may have been written. They give the same frame
    /// to the last bit, except for some frames of matrices, where they give the nearest one found.
    pub fn numbers(&self) -> FrameNumbers {
        let origin = self.origin();
        let axes = self.axes();
        let simple = axes.map(|axis| {
            let first = pairs(axis).next();
            first.unwrap_or_else(|| (normalise(axis).unwrap_or(DVec3::Z), length(axis)))
        });
        let of = |pairs: [(DVec3, f64); 3]| FrameNumbers {
            origin,
            directions: pairs.map(|(direction, _)| direction),
            lengths: pairs.map(|(_, length)| length).into(),
        };
        let is_same = |numbers: &FrameNumbers| numbers.affine().as_ref() == Some(self);
        let first = of(simple);
        if is_same(&first) {
            return first;
        }
        let [x, y, z] = axes.map(distinct);
        for &x in &x {
            for &y in &y {
                for &z in &z {
                    let numbers = of([x, y, z]);
                    if is_same(&numbers) {
                        return numbers;
                    }
                }
            }
        }
        first
    }
}

/// A direction, as short as it may have been written, that [`normalise`] makes this unit vector; the
/// vector itself if none is found.
pub fn direction_of(unit: DVec3) -> DVec3 {
    // Multiples are rounded otherwise: about every tenth is normalised to this very vector.
    let multiples = (1..1024).map(|step| (1.0 + f64::from(step) / 1024.0) * unit);
    let mut candidates = directions(unit).chain(multiples);
    let found = candidates.find(|&direction| normalise(direction) == Some(unit));
    found.unwrap_or(unit)
}

/// Pairs of different unit vectors.
fn distinct(axis: DVec3) -> Vec<(DVec3, f64)> {
    let mut kept: Vec<(DVec3, f64)> = Vec::with_capacity(MOST);
    for (direction, length) in pairs(axis) {
        let is_known =
            |known: &(DVec3, f64)| known.1 == length && normalise(known.0) == normalise(direction);
        if !kept.iter().any(is_known) {
            kept.push((direction, length));
        }
        if kept.len() == MOST {
            break;
        }
    }
    kept
}

/// Directions and lengths whose product is this axis.
fn pairs(axis: DVec3) -> impl Iterator<Item = (DVec3, f64)> {
    let whole = length(axis);
    let lengths = [
        plain(whole),
        whole,
        whole.next_up(),
        whole.next_down(),
        whole.next_up().next_up(),
        whole.next_down().next_down(),
    ];
    let units = normalise(axis).into_iter().flat_map(directions);
    units.flat_map(move |direction| {
        let unit = normalise(direction);
        let fits = move |&length: &f64| {
            0.0 < length && length.is_finite() && unit.map(|unit| length * unit) == Some(axis)
        };
        lengths
            .into_iter()
            .filter(fits)
            .map(move |length| (direction, length))
    })
}

/// Vectors within about a rounding error of a unit vector: that with components of fifteen digits
/// first.
fn directions(unit: DVec3) -> impl Iterator<Item = DVec3> {
    let steps = (0..27).map(move |number| {
        let stepped = |axis: usize, step: usize| match step {
            1 => unit[axis].next_up(),
            2 => unit[axis].next_down(),
            _ => unit[axis],
        };
        DVec3::new(
            stepped(0, number % 3),
            stepped(1, number / 3 % 3),
            stepped(2, number / 9),
        )
    });
    let short = DVec3::from_array(unit.to_array().map(plain));
    [short].into_iter().chain(steps)
}

/// The number rounded to fifteen digits, as decimals that people write have them.
fn plain(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}
