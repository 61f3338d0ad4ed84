//! Seeded random numbers, frames and points.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::{Frame, Kind, unit};

/// The `SplitMix64` generator: G. Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number
/// generators", OOPSLA 2014.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [low, high).
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        let fraction = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + fraction * (high - low)
    }

    /// A number whose decimal logarithm is uniform in [low, high).
    pub(super) fn magnitude(&mut self, low: f64, high: f64) -> f64 {
        10_f64.powf(self.between(low, high))
    }

    /// Uniform in the cube [−1, 1)³.
    pub(super) fn in_cube(&mut self) -> DVec3 {
        DVec3::new(
            self.between(-1.0, 1.0),
            self.between(-1.0, 1.0),
            self.between(-1.0, 1.0),
        )
    }

    /// Uniform on the unit sphere.
    pub(super) fn direction(&mut self) -> DVec3 {
        loop {
            let v = self.in_cube();
            if (1e-3..1.0).contains(&v.length_squared()) {
                return unit(v);
            }
        }
    }

    /// Random orthonormal directions.
    pub(super) fn rotation(&mut self) -> [DVec3; 3] {
        let u = self.direction();
        let v = unit(u.cross(self.direction()));
        [u, v, u.cross(v)]
    }

    /// Directions at random angles, with a determinant of at least half of `volume`.
    pub(super) fn skewed(&mut self, volume: f64) -> [DVec3; 3] {
        loop {
            let [u, v] = [self.direction(), self.direction()];
            let w = unit(u + volume * self.direction());
            if 0.5 * volume < u.dot(v.cross(w)).abs() {
                return [u, v, w];
            }
        }
    }

    /// A frame of moderate size near the origin, orthogonal or skewed.
    pub(super) fn frame(&mut self) -> Frame {
        let directions = if self.bits().is_multiple_of(2) {
            self.rotation()
        } else {
            self.skewed(0.3)
        };
        Frame {
            origin: 10.0 * self.in_cube(),
            directions,
            lengths: DVec3::new(
                self.between(0.5, 3.0),
                self.between(0.5, 3.0),
                self.between(0.5, 3.0),
            ),
        }
    }

    /// A point inside the unit solid.
    pub(super) fn inside(&mut self, kind: Kind) -> DVec3 {
        loop {
            let point = match kind {
                Kind::Sphere | Kind::Ellipsoid => self.in_cube(),
                Kind::Cuboid => 0.5 * (self.in_cube() + 1.0),
                Kind::Cylinder | Kind::Cone => {
                    let point = self.in_cube();
                    point.with_z(0.5 * (point.z + 1.0))
                }
            };
            if excess(kind, point) < 0.0 {
                return point;
            }
        }
    }
}

/// The implicit function of a unit solid: below 0 inside, above 0 outside.
pub(super) fn excess(kind: Kind, point: DVec3) -> f64 {
    let DVec3 { x, y, z } = point;
    match kind {
        Kind::Sphere | Kind::Ellipsoid => x * x + y * y + z * z - 1.0,
        Kind::Cuboid => ((point - 0.5).abs() - 0.5).max_element(),
        Kind::Cylinder => (x * x + y * y - 1.0).max(-z).max(z - 1.0),
        Kind::Cone => (x * x + y * y - (1.0 - z) * (1.0 - z)).max(-z).max(z - 1.0),
    }
}

/// Maps a world point to the space of the unit solid by Cramer's rule.
pub(super) fn to_unit(frame: &Frame, point: DVec3) -> DVec3 {
    let [u, v, w] = frame.directions.map(unit);
    let p = point - frame.origin;
    let determinant = |a: DVec3, b: DVec3, c: DVec3| a.dot(b.cross(c));
    let numerators = DVec3::new(
        determinant(p, v, w),
        determinant(u, p, w),
        determinant(u, v, p),
    );
    numerators / determinant(u, v, w) / frame.lengths
}

/// Points on a unit solid's surface that include its extremes, or nearly: its edges, if it has any.
pub(super) fn extremes(kind: Kind) -> Vec<DVec3> {
    let circle = |radius: f64, z: f64| {
        (0..256).map(move |i| {
            let angle = TAU * f64::from(i) / 256.0;
            DVec3::new(radius * angle.cos(), radius * angle.sin(), z)
        })
    };
    match kind {
        Kind::Sphere | Kind::Ellipsoid => (0..=128)
            .flat_map(|i| {
                let angle = PI * f64::from(i) / 128.0;
                circle(angle.sin(), angle.cos())
            })
            .collect(),
        Kind::Cuboid => (0..8)
            .map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)))
            .collect(),
        Kind::Cylinder => circle(1.0, 0.0).chain(circle(1.0, 1.0)).collect(),
        Kind::Cone => circle(1.0, 0.0).chain([DVec3::Z]).collect(),
    }
}
