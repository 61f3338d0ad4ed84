//! Frames of directions: along the world's axes, or made orthonormal.

use glam::DVec3;

use super::StructureError;
use super::form::digits::{self, Lengths};
use super::form::orthonormal;
use super::schema::position::At;
use geometry::FrameNumbers;

/// The error for a node without directions.
pub(super) fn frameless(name: &str) -> StructureError {
    StructureError::Inexpressible(format!("{name} has no frame to orthonormalise"))
}

/// The new numbers of the directions at these places; the old ones if they are orthogonal but for digits
/// that are left out.
///
/// # Errors
///
/// Fails if the directions span no frame.
pub(super) fn straight(
    places: [At<3>; 3],
    old: &[f64],
    lengths: Lengths,
) -> Result<Vec<f64>, StructureError> {
    let directions = places.map(|at| at.vector(old));
    let refused = || StructureError::Inexpressible("two of its directions are parallel".to_owned());
    let frame = orthonormal(directions).ok_or_else(refused)?;
    let mut new = old.to_vec();
    let placed = directions.iter().zip(frame).map(|(&before, direction)| {
        let length = match lengths {
            Lengths::Unit => 1.0,
            Lengths::Kept => before.length(),
        };
        (before, length * direction)
    });
    let placed: Vec<_> = placed.collect();
    if !placed
        .iter()
        .all(|&(before, wanted)| digits::is_straight(before, wanted))
    {
        for (at, &(before, wanted)) in places.iter().zip(&placed) {
            let written = digits::straightened(before, wanted, lengths);
            at.put(&mut new, written.to_array());
        }
    }
    Ok(new)
}

/// The lengths along x, y and z of a frame of the world's axes in any order.
pub(super) fn aligned(frame: &FrameNumbers) -> Option<DVec3> {
    let mut lengths = DVec3::ZERO;
    for (direction, length) in frame.directions.iter().zip(frame.lengths.to_array()) {
        let mut axes = DVec3::AXES.iter();
        lengths[axes.position(|axis| *axis == direction.abs())?] = length;
    }
    (0.0 < lengths.min_element()).then_some(lengths)
}
