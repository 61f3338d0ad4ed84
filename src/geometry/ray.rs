//! Rays, alone and side by side.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Eight, Simd, SimdBase, Vector, WIDTH};

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; of unit length, so that distances along it are in world units.
    pub direction: DVec3,
}

impl Ray {
    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// One ray, or several side by side.
#[derive(Clone, Copy, Debug)]
pub struct Rays<N> {
    /// Where they start.
    pub origin: Vector<N>,
    /// Where they go.
    pub direction: Vector<N>,
}

impl From<&Ray> for Rays<f64> {
    #[inline(always)]
    fn from(ray: &Ray) -> Self {
        Self {
            origin: ray.origin.into(),
            direction: ray.direction.into(),
        }
    }
}

impl<S: Simd> Rays<Eight<S>> {
    /// The same ray in each lane.
    #[inline(always)]
    pub fn all(simd: S, ray: &Ray) -> Self {
        let like = Eight::splat(simd, 0.0);
        Self {
            origin: Vector::all(like, ray.origin),
            direction: Vector::all(like, ray.direction),
        }
    }

    /// Up to eight rays; the last stands in the lanes that are left. There is at least one.
    #[inline(always)]
    pub fn gather(simd: S, rays: &[Ray]) -> Self {
        let last = rays.len() - 1;
        let mut coordinates = [[0.0; WIDTH]; 6];
        for lane in 0..WIDTH {
            let Ray { origin, direction } = rays[lane.min(last)];
            coordinates[0][lane] = origin.x;
            coordinates[1][lane] = origin.y;
            coordinates[2][lane] = origin.z;
            coordinates[3][lane] = direction.x;
            coordinates[4][lane] = direction.y;
            coordinates[5][lane] = direction.z;
        }
        Self {
            origin: Vector {
                x: Eight::load_array(simd, coordinates[0]),
                y: Eight::load_array(simd, coordinates[1]),
                z: Eight::load_array(simd, coordinates[2]),
            },
            direction: Vector {
                x: Eight::load_array(simd, coordinates[3]),
                y: Eight::load_array(simd, coordinates[4]),
                z: Eight::load_array(simd, coordinates[5]),
            },
        }
    }

    /// The ray in a lane.
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        let (origin, direction) = (self.origin, self.direction);
        Ray {
            origin: DVec3::new(origin.x[lane], origin.y[lane], origin.z[lane]),
            direction: DVec3::new(direction.x[lane], direction.y[lane], direction.z[lane]),
        }
    }
}
