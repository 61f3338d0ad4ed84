//! The numbers that a frame or a unit vector was made of, found again to the last bit.

use glam::DVec3;

use super::transform::length;
use super::{Affine, normalise};

/// Maximum number of pairs of a direction and a length tried for one axis.
const PAIRS: usize = 12;

/// Maximum number of frames tried.
const FRAMES: usize = 100;

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
        let axes = self.axes();
        let of = |pairs: [(DVec3, f64); 3]| FrameNumbers {
            origin: self.origin(),
            directions: pairs.map(|(direction, _)| direction),
            lengths: pairs.map(|(_, length)| length).into(),
        };
        let is_same = |numbers: &FrameNumbers| numbers.affine().as_ref() == Some(self);
        let first = of(axes.map(|axis| {
            let first = pairs(axis).next();
            first.unwrap_or_else(|| (normalise(axis).unwrap_or(DVec3::Z), length(axis)))
        }));
        if is_same(&first) {
            return first;
        }
        let [x, y, z] = axes.map(|axis| pairs(axis).take(PAIRS).collect::<Vec<_>>());
        // The likeliest of each come first.
        let ranks = (0..3 * PAIRS).flat_map(|sum| {
            let pair = move |i: usize| (0..=sum - i).map(move |j| [i, j, sum - i - j]);
            (0..=sum).flat_map(pair)
        });
        let frames = ranks.filter_map(|[i, j, k]| Some(of([*x.get(i)?, *y.get(j)?, *z.get(k)?])));
        let mut tried = frames.take(FRAMES);
        tried.find(is_same).unwrap_or(first)
    }
}

/// A direction, as short as it may have been written, that [`normalise`] makes this unit vector; the
/// vector itself if none is found.
pub fn direction_of(unit: DVec3) -> DVec3 {
    direction(unit).unwrap_or(unit)
}

/// A direction of about unit length that becomes this unit vector.
fn direction(unit: DVec3) -> Option<DVec3> {
    /// The number of lengths tried.
    const LENGTHS: i32 = 40;
    /// By how much they differ.
    const STEP: f64 = 1.3e-5;
    let short = DVec3::from_array(unit.to_array().map(plain));
    let other = (1..=LENGTHS).flat_map(move |step| {
        let change = STEP * f64::from(step);
        [(1.0 + change) * unit, (1.0 - change) * unit]
    });
    let mut tried = [short, unit].into_iter().chain(other);
    tried.find(|&direction| normalise(direction) == Some(unit))
}

/// Directions and lengths whose product is this axis, the likeliest first.
fn pairs(axis: DVec3) -> impl Iterator<Item = (DVec3, f64)> {
    let whole = length(axis);
    let [up, down] = [whole.next_up(), whole.next_down()];
    let short = plain(whole);
    let lengths = [short, whole, up, down, up.next_up(), down.next_down()];
    let lengths = lengths
        .into_iter()
        .enumerate()
        .filter(move |&(rank, length)| {
            let is_known = 0 < rank && length == short;
            0.0 < length && length.is_finite() && !is_known
        });
    let about = normalise(axis);
    lengths.flat_map(move |(_, length)| {
        let units = about.into_iter().flat_map(neighbours);
        let fitting = units.filter(move |&unit| length * unit == axis);
        fitting.filter_map(move |unit| Some((direction(unit)?, length)))
    })
}

/// A vector, and those that differ by the last bit of some components.
fn neighbours(vector: DVec3) -> impl Iterator<Item = DVec3> {
    (0..27).map(move |number| {
        let stepped = |axis: usize, step: usize| match step {
            // The sign of 0 does not count, and nothing beside it is meant.
            1 if vector[axis] != 0.0 => vector[axis].next_up(),
            2 if vector[axis] != 0.0 => vector[axis].next_down(),
            _ => vector[axis],
        };
        DVec3::new(
            stepped(0, number % 3),
            stepped(1, number / 3 % 3),
            stepped(2, number / 9),
        )
    })
}

/// The number rounded to fifteen digits, as decimals that people write have them.
fn plain(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}
