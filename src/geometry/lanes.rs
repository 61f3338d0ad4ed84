//! What formulas are made of that are written once, for one number and for eight side by side.
//!
//! The same operations in the same order on each lane give the same bits as on one number alone,
//! whatever vectors the machine has: no operation here depends on its neighbours, and products are
//! fused only where [`Lanes::mul_add`] says so.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

use fearless_simd::f64x8;
use fearless_simd::prelude::*;
use glam::DVec3;

pub use fearless_simd::prelude::SimdBase;
pub use fearless_simd::{Level, Simd, dispatch};

/// How many numbers stand side by side.
pub const WIDTH: usize = 8;

/// Eight numbers side by side.
pub type Eight<S> = f64x8<S>;

/// One number, or several side by side.
pub trait Lanes:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// One truth a lane.
    type Mask: Copy
        + BitAnd<Output = Self::Mask>
        + BitOr<Output = Self::Mask>
        + Not<Output = Self::Mask>;

    /// The same value in each lane, of as many as here.
    #[must_use]
    fn all(self, value: f64) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The magnitude of this with the sign of the other.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// The product with `factor`, plus `term`, rounded once.
    #[must_use]
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// Whether this is below the other; not if either is no number.
    fn below(self, other: Self) -> Self::Mask;
    /// Whether this is the other or below it; not if either is no number.
    fn up_to(self, other: Self) -> Self::Mask;
    /// Whether this equals the other.
    fn equals(self, other: Self) -> Self::Mask;
    /// The one where the mask is true, the other where it is not.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask is true in any lane.
    fn any(mask: Self::Mask) -> bool;
}

impl Lanes for f64 {
    type Mask = bool;

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.copysign(sign)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self.mul_add(factor, term)
    }

    #[inline(always)]
    fn below(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn up_to(self, other: Self) -> bool {
        self <= other
    }

    #[inline(always)]
    fn equals(self, other: Self) -> bool {
        self == other
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}

impl<S: Simd> Lanes for f64x8<S> {
    type Mask = <Self as SimdBase<S>>::Mask;

    #[inline(always)]
    fn all(self, value: f64) -> Self {
        Self::splat(self.simd, value)
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        SimdFloat::copysign(self, sign)
    }

    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self.mul_add_precise(factor, term)
    }

    #[inline(always)]
    fn below(self, other: Self) -> Self::Mask {
        self.simd_lt(other)
    }

    #[inline(always)]
    fn up_to(self, other: Self) -> Self::Mask {
        self.simd_le(other)
    }

    #[inline(always)]
    fn equals(self, other: Self) -> Self::Mask {
        self.simd_eq(other)
    }

    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        mask.select(yes, no)
    }

    #[inline(always)]
    fn any(mask: Self::Mask) -> bool {
        mask.any_true()
    }
}

/// A bit for each lane of a mask, the lowest for the first.
#[inline(always)]
pub fn bits<S: Simd>(mask: <Eight<S> as Lanes>::Mask) -> u32 {
    mask.to_bitmask() as u32
}

/// Three coordinates, in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Vector<N> {
    /// Along the first axis.
    pub x: N,
    /// Along the second.
    pub y: N,
    /// Along the third.
    pub z: N,
}

impl<N: Lanes> Vector<N> {
    /// The same vector in each lane, of as many as `like` has.
    #[inline(always)]
    pub fn all(like: N, vector: DVec3) -> Self {
        Self {
            x: like.all(vector.x),
            y: like.all(vector.y),
            z: like.all(vector.z),
        }
    }

    /// The scalar product, summed in the order of the axes.
    #[inline(always)]
    pub fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    /// Its image on the plane of the first two axes.
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

    /// The vector product.
    #[must_use]
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    /// The one where the mask is true, the other where it is not.
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
