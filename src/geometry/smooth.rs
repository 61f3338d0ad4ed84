//! How far around a point a surface is smooth.

use glam::DVec3;

use super::{Affine, Hit, Shape, Solid};

impl Shape {
    /// A radius around a point of the surface, met at a hit, within which the surface is one disc that
    /// is off the tangent plane by at most 0.075 of the distance from the point; 0 if none is known.
    pub fn smooth_within(&self, hit: Hit, point: DVec3) -> f64 {
        match self {
            Self::Solid(Solid::Sphere(sphere)) => 0.15 * sphere.radius,
            Self::Solid(Solid::Cuboid(cuboid)) => {
                let across = (hit.part / 2) as usize % 3;
                within_edges(&cuboid.0, point, |axis, along| {
                    if axis == across {
                        1.0
                    } else {
                        along.min(1.0 - along)
                    }
                })
            }
            Self::Plane(plane) => within_edges(&plane.0, point, |axis, along| {
                if axis == 2 {
                    f64::INFINITY
                } else {
                    1.0 - along.abs()
                }
            }),
            Self::Solid(_) | Self::Csg(_) | Self::Mesh(_) => 0.0,
        }
    }
}

/// The least distance from a point to planes across a frame's axes, given how far from its place along
/// an axis, in the frame, they are.
fn within_edges(frame: &Affine, point: DVec3, apart: impl Fn(usize, f64) -> f64) -> f64 {
    let place = frame.position(point).to_array();
    let axes = (0..).zip(place).zip(frame.duals());
    let distances = axes.map(|((axis, along), dual)| apart(axis, along) / dual.length());
    distances.fold(f64::INFINITY, f64::min)
}
