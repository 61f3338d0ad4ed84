//! 106-bit numbers as sums of two `f64`: T. J. Dekker, "A floating-point technique for
//! extending the available precision", Numerische Mathematik 18 (1971).

use std::ops::{Add, Div, Mul, Neg, Sub};

use glam::DVec3;

/// A sum of a number and its rounding error.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Double {
    high: f64,
    low: f64,
}

impl Double {
    pub(super) const ZERO: Self = Self {
        high: 0.0,
        low: 0.0,
    };

    pub(super) fn of(high: f64) -> Self {
        Self { high, low: 0.0 }
    }

    pub(super) fn round(self) -> f64 {
        self.high
    }

    pub(super) fn abs(self) -> Self {
        if self.high < 0.0 { -self } else { self }
    }

    /// The normalised sum of two numbers, |high| ≥ |low|.
    fn normalised(high: f64, low: f64) -> Self {
        let sum = high + low;
        Self {
            high: sum,
            low: low - (sum - high),
        }
    }

    /// The square root: one Newton step from the root of the leading part.
    pub(super) fn sqrt(self) -> Self {
        let root = self.high.sqrt();
        if root == 0.0 {
            return Self::ZERO;
        }
        let residue = self - Self::of(root) * Self::of(root);
        Self::normalised(root, residue.high / (2.0 * root))
    }
}

impl Add for Double {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let sum = self.high + other.high;
        let kept = sum - self.high;
        let error = (self.high - (sum - kept)) + (other.high - kept);
        let low = self.low + other.low;
        let low_kept = low - self.low;
        let low_error = (self.low - (low - low_kept)) + (other.low - low_kept);
        let first = Self::normalised(sum, error + low);
        Self::normalised(first.high, first.low + low_error)
    }
}

impl Neg for Double {
    type Output = Self;

    fn neg(self) -> Self {
        Self {
            high: -self.high,
            low: -self.low,
        }
    }
}

impl Sub for Double {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let product = self.high * other.high;
        let error = self.high.mul_add(other.high, -product);
        Self::normalised(
            product,
            error + (self.high * other.low + self.low * other.high),
        )
    }
}

impl Div for Double {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let residue = self - Self::of(first) * other;
        let second = residue.high / other.high;
        let rest = residue - Self::of(second) * other;
        Self::normalised(first, second) + Self::of(rest.high / other.high)
    }
}

/// A vector in twice the precision.
pub(super) type Vector = [Double; 3];

pub(super) fn vector(v: DVec3) -> Vector {
    v.to_array().map(Double::of)
}

pub(super) fn sum(u: Vector, v: Vector) -> Vector {
    std::array::from_fn(|i| u[i] + v[i])
}

pub(super) fn scaled(s: Double, v: Vector) -> Vector {
    v.map(|component| s * component)
}

pub(super) fn dot(u: Vector, v: Vector) -> Double {
    u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
}

pub(super) fn cross(u: Vector, v: Vector) -> Vector {
    [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ]
}

#[cfg(test)]
mod tests {
    use super::Double;

    #[test]
    fn holds_twice_the_bits() {
        let third = Double::of(1.0) / Double::of(3.0);
        let one = third + third + third;
        assert!((one - Double::of(1.0)).round().abs() < 1e-31);
        let two = Double::of(2.0).sqrt() * Double::of(2.0).sqrt();
        assert!((two - Double::of(2.0)).round().abs() < 1e-31);
        let tiny = (Double::of(1.0) + Double::of(1e-25)) - Double::of(1.0);
        assert!((tiny.round() - 1e-25).abs() < 1e-31);
    }
}
