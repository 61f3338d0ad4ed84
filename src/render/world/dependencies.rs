//! Dependencies of pixels: the objects and lights that a pixel's radiance depends on.

use std::ops::{BitOr, BitOrAssign};

/// A conservative set of objects and lights, in which several share a bit.
///
/// A pixel depends on the materials of the objects that its rays hit and that its shadow rays are
/// blocked by or pass through, and on the colours of the lights that contribute to it. A shadow ray
/// blocked by one object depends on no other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Dependencies(u64);

impl Dependencies {
    /// The empty set.
    pub(crate) const NOTHING: Self = Self(0);

    /// The set of one object, by its number.
    #[inline]
    pub(crate) fn object(number: u32) -> Self {
        Self(1 << (number % u64::BITS))
    }

    /// The set of one light, by its number, counted from the other end to avoid shared bits.
    #[inline]
    pub(crate) fn light(number: usize) -> Self {
        Self(1 << 63 >> (number as u32 % u64::BITS))
    }

    /// The set as bits, each of which stands for some objects and lights.
    pub(crate) fn bits(self) -> u64 {
        self.0
    }

    /// The set with these bits.
    pub(crate) fn of_bits(bits: u64) -> Self {
        Self(bits)
    }

    /// Whether two sets may intersect.
    pub(crate) fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

impl BitOr for Dependencies {
    type Output = Self;

    #[inline]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for Dependencies {
    #[inline]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}
