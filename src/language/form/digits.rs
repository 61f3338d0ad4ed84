//! As few digits as a change needs: what is moved, turned and scaled is written as by hand, and misses
//! what was meant by less than is ever seen.

use glam::{DMat3, DVec3};

use geometry::normalise;

/// The tolerance for a direction's length around 1 and for dot products of two around 0.
pub(crate) const UNIT_TOLERANCE: f64 = 1e-3;

/// The largest angle, in radians, between the direction that is meant and the one that is written: half a
/// pixel at the rim of a thing that is twenty thousand pixels wide.
pub(super) const TURN: f64 = 5e-5;

/// The largest relative error of the length of a direction that is to have length 1: half of what is
/// reported.
const STRETCH: f64 = 0.5 * UNIT_TOLERANCE;

/// The largest angle between directions that differ by the rounding errors of binary fractions only.
const ROUNDING: f64 = 1e-12;

/// The most decimals that are tried: with them, a number is written to its last digit.
const MOST: usize = 17;

/// The share of the error of a rotation that its axis may have.
const AXIS: f64 = 0.75;

/// Digits after the first of a length, of which a picture's decimals may show fewer.
const SIGNIFICANT: i32 = 3;

/// The lengths of directions that become orthogonal.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Lengths {
    /// They become 1.
    Unit,
    /// They stay, since they count.
    Kept,
}

/// The direction that is written for a new one, with the fewest decimals that point there within this
/// angle: the old one if it does, and otherwise components that stay keep their digits.
pub(crate) fn direction(old: DVec3, new: DVec3, lengths: Lengths, within: f64) -> DVec3 {
    if matches!(lengths, Lengths::Unit) && angle(old, new) <= ROUNDING {
        return old;
    }
    shortest(old, new, lengths, within)
}

fn shortest(old: DVec3, new: DVec3, lengths: Lengths, within: f64) -> DVec3 {
    let stretch = match lengths {
        Lengths::Unit => STRETCH,
        Lengths::Kept => within,
    };
    let length = new.length();
    let is_near = |written: &DVec3| {
        let stretched = (written.length() - length).abs();
        stretched <= stretch * length && angle(*written, new) <= within
    };
    let mut written = (0..=MOST).map(|decimals| rounded_vector(old, new, decimals));
    written.find(is_near).unwrap_or(new)
}

/// The direction that is written for one that becomes part of an orthogonal frame.
pub(crate) fn straightened(old: DVec3, new: DVec3, lengths: Lengths) -> DVec3 {
    shortest(old, new, lengths, TURN)
}

/// Whether a direction is where it would be straightened to, but for digits that are left out.
pub(crate) fn is_straight(old: DVec3, new: DVec3) -> bool {
    let length = new.length();
    (old.length() - length).abs() <= STRETCH * length && angle(old, new) <= STRETCH
}

/// The axis and the degrees that are written for a rotation, with the fewest decimals that turn everything
/// to where it turns within this angle.
pub(crate) fn turn(axis: DVec3, degrees: f64, within: f64) -> (DVec3, f64) {
    let meant = rotation(axis, degrees);
    let is_near = |axis: DVec3, degrees: f64, within: f64| {
        let Some(axis) = normalise(axis) else {
            return false;
        };
        let matrix = rotation(axis, degrees);
        let columns = (0..3).map(|at| angle(matrix.col(at), meant.col(at)));
        columns.fold(0.0, f64::max) <= within
    };
    let mut axes = (0..=MOST).map(|decimals| rounded_vector(DVec3::ZERO, axis, decimals));
    let found = axes.find(|axis| is_near(*axis, degrees, AXIS * within));
    let axis = found.unwrap_or(axis);
    let mut angles = (0..=MOST).map(|decimals| rounded(0.0, degrees, decimals));
    let found = angles.find(|degrees| is_near(axis, *degrees, within));
    (axis, found.unwrap_or(degrees))
}

/// Decimals for a length: those of its picture, or more for one that is too small for them.
pub(crate) fn of_length(length: f64, decimals: usize) -> usize {
    if !length.is_normal() {
        return decimals;
    }
    let own = SIGNIFICANT - libm::floor(libm::log10(length.abs())) as i32;
    decimals.max(usize::try_from(own).unwrap_or(0).min(MOST))
}

fn rounded_vector(old: DVec3, new: DVec3, decimals: usize) -> DVec3 {
    DVec3::from_array([0, 1, 2].map(|at| rounded(old[at], new[at], decimals)))
}

/// The angle between two directions, in radians; also of those so near that a cosine does not tell.
fn angle(one: DVec3, other: DVec3) -> f64 {
    match (normalise(one), normalise(other)) {
        (Some(one), Some(other)) => 2.0 * libm::asin((0.5 * (one - other).length()).min(1.0)),
        _ => f64::INFINITY,
    }
}

/// Rodrigues' rotation about a unit vector, right-handed, in degrees; exact for quarter turns.
pub(crate) fn rotation(axis: DVec3, angle: f64) -> DMat3 {
    let turned = angle % 360.0;
    let (sin, cos) = match turned {
        0.0 => (0.0, 1.0),
        90.0 | -270.0 => (1.0, 0.0),
        180.0 | -180.0 => (0.0, -1.0),
        270.0 | -90.0 => (-1.0, 0.0),
        _ => libm::sincos(turned.to_radians()),
    };
    let turned = |v: DVec3| cos * v + sin * axis.cross(v) + (1.0 - cos) * axis.dot(v) * axis;
    DMat3::from_cols(turned(DVec3::X), turned(DVec3::Y), turned(DVec3::Z))
}

/// The number that a moved one is written as: the old one if they differ by rounding errors only,
/// with the digits of the old one after a step of no more than this number of decimals, otherwise
/// rounded to them.
pub(crate) fn rounded(old: f64, new: f64, decimals: usize) -> f64 {
    let error = 1e-12 * old.abs().max(new.abs());
    if (new - old).abs() <= error {
        return old;
    }
    let step = text::rounded(new - old, decimals);
    if (old + step - new).abs() <= error {
        let own = text::decimals(&old.to_string());
        return text::rounded(old + step, decimals.max(own));
    }
    text::rounded(new, decimals)
}
