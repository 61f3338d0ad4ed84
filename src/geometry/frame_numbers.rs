//! The numbers that a frame or a unit vector was made of, found again to the last bit.

use glam::DVec3;

use super::transform::{exact_cross, exact_dot, length};
use super::{Affine, normalise};

/// Maximum number of pairs of a direction and a length tried for one axis.
const PAIRS: usize = 12;

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
        let of = |pairs: [Pair; 3]| FrameNumbers {
            origin: self.origin(),
            directions: pairs.map(|pair| pair.direction),
            lengths: pairs.map(|pair| pair.length).into(),
        };
        let is_same = |numbers: &FrameNumbers| numbers.affine().as_ref() == Some(self);
        let first = of(axes.map(|axis| pairs(axis).next().unwrap_or_else(|| Pair::about(axis))));
        if is_same(&first) {
            return first;
        }
        let [dual, ..] = self.duals();
        let [x, y, z] = axes.map(|axis| pairs(axis).take(PAIRS).collect::<Vec<_>>());
        for &second in &y {
            for &third in &z {
                let across = exact_cross(second.unit, third.unit);
                // Most are ruled out by the first of the dual vectors.
                let fits = |one: &&Pair| across / exact_dot(across, one.unit) / one.length == dual;
                for &one in x.iter().filter(fits) {
                    let numbers = of([one, second, third]);
                    if is_same(&numbers) {
                        return numbers;
                    }
                }
            }
        }
        first
    }
}

/// A direction and a length that make an axis.
#[derive(Clone, Copy)]
struct Pair {
    direction: DVec3,
    /// The direction, normalised.
    unit: DVec3,
    length: f64,
}

impl Pair {
    /// A pair that makes nearly this axis.
    fn about(axis: DVec3) -> Self {
        let unit = normalise(axis).unwrap_or(DVec3::Z);
        Self {
            direction: unit,
            unit,
            length: length(axis),
        }
    }
}

/// A direction, as short as it may have been written, that [`normalise`] makes this unit vector; the
/// vector itself if none is found.
pub fn direction_of(unit: DVec3) -> DVec3 {
    direction(unit).unwrap_or(unit)
}

/// A direction of about unit length that becomes this unit vector.
fn direction(unit: DVec3) -> Option<DVec3> {
    /// The number of lengths tried, above and below 1: few vectors need more than ten, the most
    /// stubborn of thousands needed thirty.
    const LENGTHS: i32 = 400;
    /// By how much they differ: none is off by more than what readers take for a unit vector.
    const STEP: f64 = 1.23e-6;
    let short = DVec3::from_array(unit.to_array().map(plain));
    let other = (1..=LENGTHS).flat_map(move |step| {
        let change = STEP * f64::from(step);
        [(1.0 + change) * unit, (1.0 - change) * unit]
    });
    let mut tried = [short, unit].into_iter().chain(other);
    tried.find(|&direction| normalise(direction) == Some(unit))
}

/// Directions and lengths whose product is this axis, the likeliest first.
fn pairs(axis: DVec3) -> impl Iterator<Item = Pair> {
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
    lengths.flat_map(move |(_, length)| {
        let units = neighbours(axis / length);
        let fitting = units.filter(move |&unit| length * unit == axis);
        fitting.filter_map(move |unit| {
            let direction = direction(unit)?;
            Some(Pair {
                direction,
                unit,
                length,
            })
        })
    })
}

/// A vector, and those that differ by the last bit of one component, two or all. The components that
/// are 0 are kept: nothing beside them is meant.
fn neighbours(vector: DVec3) -> impl Iterator<Item = DVec3> {
    let steps = |number: usize| [number % 3, number / 3 % 3, number / 9];
    let changes = move |number: &usize| steps(*number).iter().filter(|&&step| step != 0).count();
    let ordered = (0..=3).flat_map(move |count| (0..27).filter(move |at| changes(at) == count));
    ordered.filter_map(move |number| {
        let mut stepped = vector;
        for (axis, step) in steps(number).into_iter().enumerate() {
            stepped[axis] = match step {
                0 => vector[axis],
                _ if vector[axis] == 0.0 => return None,
                1 => vector[axis].next_up(),
                _ => vector[axis].next_down(),
            };
        }
        Some(stepped)
    })
}

/// The number rounded to fifteen digits, as decimals that people write have them.
fn plain(number: f64) -> f64 {
    format!("{number:.14e}").parse().unwrap_or(number)
}
