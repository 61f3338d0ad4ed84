//! Choice of directions toward a part of a surface, with their density.

use std::f64::consts::TAU;

use glam::DVec3;

use super::super::warp;
use crate::geometry::{Ball, Flat, Patch};

/// A direction toward a part of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Aim {
    /// The unit vector.
    pub(super) toward: DVec3,
    /// The distance within which a ray in this direction hits the part, if nothing is in between.
    pub(super) reach: f64,
    /// See [`Patch::density`].
    pub(super) density: f64,
    /// Whether it hits the front of the part.
    pub(super) is_front: bool,
}

/// Allows for rounding of a distance.
const SLACK: f64 = 1.0 + 1e-6;

impl Patch {
    /// Chooses a direction from a point toward this part, by two numbers in 0..1: points of flat
    /// parts uniformly by area, a ball, from outside, uniformly over the directions of its unit
    /// sphere's space.
    pub(super) fn aim(&self, from: DVec3, place: [f64; 2]) -> Option<Aim> {
        let (flat, at) = match self {
            Self::Triangle(flat) => (flat, flat.in_triangle(place)),
            Self::Parallelogram(flat) => (flat, flat.at(place)),
            Self::Ball(ball) => return ball.aim(from, place),
        };
        let offset = at - from;
        let distance = offset.length();
        let toward = offset / distance;
        toward.is_finite().then(|| Aim {
            toward,
            reach: SLACK * distance,
            density: self.density(from, toward, at),
            is_front: toward.dot(flat.normal) < 0.0,
        })
    }

    /// The density of [`Patch::aim`] per steradian in the direction `toward`, in which the part is hit
    /// at a point.
    pub(super) fn density(&self, from: DVec3, toward: DVec3, at: DVec3) -> f64 {
        let (part, flat) = match self {
            Self::Triangle(flat) => (0.5, flat),
            Self::Parallelogram(flat) => (1.0, flat),
            Self::Ball(ball) => return ball.density(from, toward),
        };
        let seen = part * flat.normal.dot(toward).abs();
        finite(at.distance_squared(from) / seen)
    }

    /// A point and the normal there, by two numbers in 0..1.
    pub(super) fn point(&self, place: [f64; 2]) -> (DVec3, DVec3) {
        match self {
            Self::Triangle(flat) => (flat.in_triangle(place), flat.normal.normalize_or_zero()),
            Self::Parallelogram(flat) => (flat.at(place), flat.normal.normalize_or_zero()),
            Self::Ball(ball) => {
                let unit = warp::in_cone(DVec3::Z, 2.0, place);
                let [x, y, z] = ball.duals;
                let normal = unit.x * x + unit.y * y + unit.z * z;
                (
                    ball.centre + ball.to_world(unit),
                    normal.normalize_or_zero(),
                )
            }
        }
    }
}

impl Flat {
    fn at(&self, [u, v]: [f64; 2]) -> DVec3 {
        self.corner + u * self.sides[0] + v * self.sides[1]
    }

    /// Maps the square to the triangle, uniformly and with little distortion (Heitz, "A
    /// Low-Distortion Map Between Triangle and Square", 2019).
    fn in_triangle(&self, [u, v]: [f64; 2]) -> DVec3 {
        if u < v {
            self.at([0.5 * u, v - 0.5 * u])
        } else {
            self.at([u - 0.5 * v, 0.5 * v])
        }
    }
}

impl Ball {
    /// `None` inside.
    fn aim(&self, from: DVec3, place: [f64; 2]) -> Option<Aim> {
        let offset = self.to_unit(self.centre - from);
        let versine = versine(offset)?;
        let turned = self.to_world(warp::in_cone(offset.normalize(), versine, place));
        let speed = turned.length();
        let toward = turned / speed;
        toward.is_finite().then(|| Aim {
            toward,
            density: self.density(from, toward),
            is_front: true,
            // From the surface itself, the far side is seen.
            reach: SLACK * speed * (1.0 + offset.length()),
        })
    }

    /// A direction d of unit length is the image of one that covers |M⁻¹ d|³ det M as much of the
    /// sphere.
    fn density(&self, from: DVec3, toward: DVec3) -> f64 {
        let offset = self.to_unit(self.centre - from);
        versine(offset).map_or(0.0, |versine| {
            let shrunk = self.to_unit(toward).length();
            finite(1.0 / (TAU * versine * self.volume() * shrunk * shrunk * shrunk))
        })
    }
}

/// 1 − cos of the half angle that a unit sphere subtends from a point; `None` inside.
fn versine(offset: DVec3) -> Option<f64> {
    let square = 1.0 / offset.length_squared();
    (square < 1.0).then(|| square / (1.0 + (1.0 - square).sqrt()))
}

/// A density; where it overflows 0, which leaves a direction to BSDF sampling.
fn finite(density: f64) -> f64 {
    if density.is_finite() { density } else { 0.0 }
}
