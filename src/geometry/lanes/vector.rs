//! Vectors of single numbers or of lanes.

use std::ops::{Add, Neg, Sub};

use glam::DVec3;

use super::{Eight, Lanes, Row, Simd};

/// Three coordinates, in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Vector<N> {
    /// First coordinate.
    pub x: N,
    /// Second coordinate.
    pub y: N,
    /// Third coordinate.
    pub z: N,
}

impl<N: Lanes> Vector<N> {
    /// Broadcasts a vector to all lanes of a number like `like`.
    #[inline(always)]
    pub fn all(like: N, vector: DVec3) -> Self {
        Self {
            x: like.all(vector.x),
            y: like.all(vector.y),
            z: like.all(vector.z),
        }
    }

    /// The dot product, summed in the order of the axes.
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// The projection onto the xy plane.
    #[must_use]
    #[inline(always)]
    pub fn flat(self) -> Self {
        Self {
            z: self.z.all(0.0),
            ..self
        }
    }

    /// The square of the length.
    #[inline(always)]
    pub fn length_squared(self) -> N {
        self.dot(self)
    }

    /// The product with a number.
    #[must_use]
    #[inline(always)]
    pub fn scaled(self, factor: N) -> Self {
        Self {
            x: factor * self.x,
            y: factor * self.y,
            z: factor * self.z,
        }
    }

    /// The product with another vector, coordinate by coordinate.
    #[must_use]
    #[inline(always)]
    pub fn times(self, other: Self) -> Self {
        Self {
            x: self.x * other.x,
            y: self.y * other.y,
            z: self.z * other.z,
        }
    }

    /// The quotient by a number.
    #[must_use]
    #[inline(always)]
    pub fn over(self, divisor: N) -> Self {
        Self {
            x: self.x / divisor,
            y: self.y / divisor,
            z: self.z / divisor,
        }
    }

    /// The length.
    #[inline(always)]
    pub fn length(self) -> N {
        self.length_squared().sqrt()
    }

    /// Scales the vector to unit length; not finite if its squared length underflows or overflows.
    #[must_use]
    #[inline(always)]
    pub fn unit(self) -> Self {
        self.scaled(self.x.all(1.0) / self.length())
    }

    /// Shortens the vector to `length` if it is longer.
    #[must_use]
    #[inline(always)]
    pub fn clamp_length_max(self, length: N) -> Self {
        let squared = self.length_squared();
        let short = self.over(squared.sqrt()).scaled(length);
        Self::select((length * length).below(squared), short, self)
    }

    /// The magnitudes of the coordinates.
    #[must_use]
    #[inline(always)]
    pub fn abs(self) -> Self {
        Self {
            x: self.x.abs(),
            y: self.y.abs(),
            z: self.z.abs(),
        }
    }

    /// The larger coordinate along each axis.
    #[must_use]
    #[inline(always)]
    pub fn larger(self, other: Self) -> Self {
        Self {
            x: self.x.larger(other.x),
            y: self.y.larger(other.y),
            z: self.z.larger(other.z),
        }
    }

    /// The smaller coordinate along each axis.
    #[must_use]
    #[inline(always)]
    pub fn smaller(self, other: Self) -> Self {
        Self {
            x: self.x.smaller(other.x),
            y: self.y.smaller(other.y),
            z: self.z.smaller(other.z),
        }
    }

    /// Whether all coordinates are finite.
    #[inline(always)]
    pub fn is_finite(self) -> N::Mask {
        self.x.is_finite() & self.y.is_finite() & self.z.is_finite()
    }

    /// Whether all coordinates are 0.
    #[inline(always)]
    pub fn is_zero(self) -> N::Mask {
        let zero = self.x.all(0.0);
        self.x.equals(zero) & self.y.equals(zero) & self.z.equals(zero)
    }

    /// The largest coordinate.
    #[inline(always)]
    pub fn largest(self) -> N {
        self.x.larger(self.y).larger(self.z)
    }

    /// The sum of the coordinates, in the order of the axes.
    #[inline(always)]
    pub fn sum(self) -> N {
        self.x + self.y + self.z
    }

    /// The sum of three vectors weighted by the coordinates, in the order of the axes.
    #[must_use]
    #[inline(always)]
    pub fn combine(self, [u, v, w]: [Self; 3]) -> Self {
        u.scaled(self.x) + v.scaled(self.y) + w.scaled(self.z)
    }

    /// The cross product.
    #[must_use]
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// Selects `yes` in the lanes where the mask is true, `no` in the others.
    #[must_use]
    #[inline(always)]
    pub fn select(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self {
            x: N::select(mask, yes.x, no.x),
            y: N::select(mask, yes.y, no.y),
            z: N::select(mask, yes.z, no.z),
        }
    }
}

impl<S: Simd> Vector<Eight<S>> {
    /// Returns the vector in a lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    /// Replaces the vector in a lane.
    #[inline(always)]
    pub fn put(&mut self, lane: usize, vector: DVec3) {
        [self.x[lane], self.y[lane], self.z[lane]] = vector.to_array();
    }

    /// Stores the vectors in memory.
    #[inline(always)]
    pub fn store(self) -> Vector<Row> {
        Vector {
            x: self.x.into(),
            y: self.y.into(),
            z: self.z.into(),
        }
    }
}

impl Vector<Row> {
    /// Repeats a vector in all lanes.
    pub const fn repeat(vector: DVec3) -> Self {
        Self {
            x: Row::all(vector.x),
            y: Row::all(vector.y),
            z: Row::all(vector.z),
        }
    }

    /// Returns the vector in a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> DVec3 {
        DVec3::new(self.x.0[lane], self.y.0[lane], self.z.0[lane])
    }

    /// Replaces the vector in a lane.
    #[inline(always)]
    pub fn set(&mut self, lane: usize, vector: DVec3) {
        [self.x.0[lane], self.y.0[lane], self.z.0[lane]] = vector.to_array();
    }

    /// Loads the vectors into SIMD registers.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> Vector<Eight<S>> {
        Vector {
            x: self.x.load(simd),
            y: self.y.load(simd),
            z: self.z.load(simd),
        }
    }
}

impl<N: Lanes> Add for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self {
            x: self.x + other.x,
            y: self.y + other.y,
            z: self.z + other.z,
        }
    }
}

impl<N: Lanes> Neg for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self {
            x: -self.x,
            y: -self.y,
            z: -self.z,
        }
    }
}

impl<N: Lanes> Sub for Vector<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self {
            x: self.x - other.x,
            y: self.y - other.y,
            z: self.z - other.z,
        }
    }
}

impl From<DVec3> for Vector<f64> {
    #[inline(always)]
    fn from(DVec3 { x, y, z }: DVec3) -> Self {
        Self { x, y, z }
    }
}

impl From<Vector<f64>> for DVec3 {
    #[inline(always)]
    fn from(Vector { x, y, z }: Vector<f64>) -> Self {
        Self { x, y, z }
    }
}
