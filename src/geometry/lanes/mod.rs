//! Numbers for formulas that are written once, and evaluated for one number or for eight side by side.
//!
//! The same operations in the same order on each lane give the same bits as on one number alone,
//! whatever vectors the machine has: no operation here depends on its neighbours, and products are
//! fused only where [`Lanes::mul_add`] says so.

mod angle;
mod rows;
mod vector;

use std::iter;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f32x8, f64x4, f64x8, u32x8};

pub use fearless_simd::prelude::{Select, SimdBase, SimdMask};
pub use fearless_simd::{Level, Simd};
pub use rows::{Rows, Run};
pub use vector::Vector;

#[cfg(not(target_arch = "x86_64"))]
pub use fearless_simd::dispatch;

/// Evaluates an expression with the vectors of a [`Level`], compiled for each that it may be.
///
/// On x86-64 these are AVX-512, AVX2 and SSE2. SSE4.2 is treated as SSE2: it has no fused
/// multiply-add either, so it is hardly faster, and its code is larger than that of AVX-512 and AVX2
/// together.
#[cfg(target_arch = "x86_64")]
#[macro_export]
macro_rules! dispatch {
    ($level:expr, $simd:ident => $result:expr) => {{
        use $crate::lanes::Simd as _;
        let level = $level;
        if let Some($simd) = level.as_avx512() {
            $simd.vectorize(
                #[inline(always)]
                || $result,
            )
        } else if let Some($simd) = level.as_avx2() {
            $simd.vectorize(
                #[inline(always)]
                || $result,
            )
        } else {
            let $simd = level.as_sse2().expect("every x86-64 processor has SSE2");
            $simd.vectorize(
                #[inline(always)]
                || $result,
            )
        }
    }};
}
#[cfg(target_arch = "x86_64")]
pub use crate::dispatch;

/// How many numbers stand side by side.
pub const WIDTH: usize = 8;

/// Eight numbers side by side.
pub type Eight<S> = f64x8<S>;

/// Four numbers side by side.
pub type Four<S> = f64x4<S>;

/// Eight numbers of single precision side by side.
pub type Singles<S> = f32x8<S>;

/// Eight integers side by side.
pub type Words<S> = u32x8<S>;

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
        + BitXor<Output = Self::Mask>
        + Not<Output = Self::Mask>;

    /// The same value in each lane, of as many as here.
    #[must_use]
    fn all(self, value: f64) -> Self;
    /// The square root.
    #[must_use]
    fn sqrt(self) -> Self;
    /// The magnitude.
    #[must_use]
    fn abs(self) -> Self;
    /// The magnitude of this with the sign of the other.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;
    /// The sine and cosine of an angle from 0, not −0, to 2π, with the bits of `libm::sincos`.
    #[must_use]
    fn sincos(self) -> [Self; 2];
    /// The product with `factor`, plus `term`, rounded once.
    #[must_use]
    fn mul_add(self, factor: Self, term: Self) -> Self;
    /// Whether this is below the other; not if either is not a number.
    fn below(self, other: Self) -> Self::Mask;
    /// Whether this is the other or below it; not if either is not a number.
    fn up_to(self, other: Self) -> Self::Mask;
    /// Whether this equals the other.
    fn equals(self, other: Self) -> Self::Mask;
    /// The one where the mask is true, the other where it is not.
    #[must_use]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;
    /// Whether the mask is true in any lane.
    fn any(mask: Self::Mask) -> bool;
    /// Calls a part of a long formula, compiled for vectors like this as a function of its own: the
    /// compiler takes about the square of a function's size.
    fn outlined<R>(self, part: impl FnOnce() -> R) -> R;

    /// Whether this is a finite number.
    #[inline(always)]
    fn is_finite(self) -> Self::Mask {
        self.abs().below(self.all(f64::INFINITY))
    }

    /// The larger of two numbers.
    #[must_use]
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        Self::select(self.below(other), other, self)
    }

    /// The smaller of two numbers.
    #[must_use]
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        Self::select(other.below(self), other, self)
    }

    /// The unit in the last place: the gap from the magnitude to the next larger number, or twice
    /// that between 2⁻¹⁰²² and 2⁻¹⁰²⁰ (S. Rump, P. Zimmermann, S. Boldo, G. Melquiond, "Computing
    /// predecessor and successor in rounding to nearest", BIT 49, 2009).
    #[must_use]
    #[inline(always)]
    fn ulp(self) -> Self {
        const HALF: f64 = 0.5 * f64::EPSILON * (1.0 + f64::EPSILON);
        const LEAST: f64 = f64::from_bits(1);
        let size = self.abs();
        size + (self.all(HALF) * size + self.all(LEAST)) - size
    }
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
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.copysign(sign)
    }

    #[inline(always)]
    fn sincos(self) -> [Self; 2] {
        libm::sincos(self).into()
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

    #[inline(always)]
    fn outlined<R>(self, part: impl FnOnce() -> R) -> R {
        part()
    }
}

/// Numbers side by side in a vector.
pub trait Several<S: Simd>: Copy {
    /// A number.
    type Number: Copy + Default + Send + Sync;
    /// How many there are.
    const COUNT: usize;

    /// The first numbers of a slice that holds at least as many.
    fn load(simd: S, numbers: &[Self::Number]) -> Self;
    /// The same number in each lane.
    fn splat(simd: S, number: Self::Number) -> Self;
}

macro_rules! several {
    ($vector:ident, $number:ident, $count:literal) => {
        impl<S: Simd> Several<S> for $vector<S> {
            type Number = $number;
            const COUNT: usize = $count;

            #[inline(always)]
            fn load(simd: S, numbers: &[$number]) -> Self {
                let numbers = numbers.first_chunk().expect("the slice is long enough");
                Self::load_array(simd, *numbers)
            }

            #[inline(always)]
            fn splat(simd: S, number: $number) -> Self {
                <Self as SimdBase<S>>::splat(simd, number)
            }
        }
    };
}

several!(f64x8, f64, 8);
several!(f64x4, f64, 4);
several!(f32x8, f32, 8);

macro_rules! lanes {
    ($vector:ident) => {
        impl<S: Simd> Lanes for $vector<S> {
            type Mask = <Self as SimdBase<S>>::Mask;

            #[inline(always)]
            fn all(self, value: f64) -> Self {
                <Self as SimdBase<S>>::splat(self.simd, value)
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                SimdFloat::copysign(self, sign)
            }

            #[inline(always)]
            fn sincos(self) -> [Self; 2] {
                let ([sine, cosine], near) = angle::sincos(self);
                if near.any_true() {
                    let [sine, cosine] =
                        angle::repaired(*self, [*sine, *cosine], near.to_bitmask());
                    return [
                        Self::load_array(self.simd, sine),
                        Self::load_array(self.simd, cosine),
                    ];
                }
                [sine, cosine]
            }

            #[inline(always)]
            fn mul_add(self, factor: Self, term: Self) -> Self {
                #[cfg(target_arch = "x86_64")]
                if let Level::Sse2(_) = self.simd.level() {
                    return Self::load_array(self.simd, fused(&self, &factor, &term));
                }
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

            #[inline(always)]
            fn outlined<R>(self, part: impl FnOnce() -> R) -> R {
                self.simd.vectorize(part)
            }
        }
    };
}

lanes!(f64x8);
lanes!(f64x4);

/// Fused products and sums in each lane, where the processor need not have an instruction for them.
/// Calls at every place would be a third of the library's code.
#[cfg(target_arch = "x86_64")]
#[inline(never)]
fn fused<const N: usize>(numbers: &[f64; N], factors: &[f64; N], terms: &[f64; N]) -> [f64; N] {
    std::array::from_fn(|lane| numbers[lane].mul_add(factors[lane], terms[lane]))
}

/// The lanes whose bit is 1, the lowest for the first.
#[inline(always)]
pub fn mask<S: Simd>(simd: S, bits: u32) -> <Eight<S> as Lanes>::Mask {
    SimdMask::from_bitmask(simd, u64::from(bits))
}

/// A bit for each lane of a mask, the lowest for the first.
#[inline(always)]
pub fn bits<S: Simd>(mask: impl SimdMask<S>) -> u32 {
    mask.to_bitmask() as u32
}

/// A mask of the lanes for which a condition holds, the lowest bit for the first.
#[inline(always)]
pub fn lanes_of(conditions: impl Iterator<Item = bool>) -> u32 {
    let mut lanes = 0;
    for (lane, holds) in conditions.enumerate() {
        lanes |= u32::from(holds) << lane;
    }
    lanes
}

/// The numbers of the bits that are 1, ascending.
#[inline(always)]
pub fn each_bit(mut bits: u32) -> impl Iterator<Item = usize> {
    iter::from_fn(
        #[inline(always)]
        move || {
            let bit = bits.trailing_zeros() as usize;
            (bits != 0).then(|| {
                bits &= bits - 1;
                bit
            })
        },
    )
}

/// Those numbers, rounded to single precision.
#[inline(always)]
pub fn singles<S: Simd>(eight: Eight<S>) -> Singles<S> {
    let mut singles = [0.0; WIDTH];
    for lane in 0..WIDTH {
        singles[lane] = eight[lane] as f32;
    }
    Singles::load_array(eight.simd, singles)
}

/// Eight numbers as they lie in memory.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub struct Row(pub [f64; WIDTH]);

impl Row {
    /// The same number eight times.
    pub const fn all(value: f64) -> Self {
        Self([value; WIDTH])
    }

    /// Those, in a vector.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> Eight<S> {
        Eight::load_array(simd, self.0)
    }
}

impl<S: Simd> From<Eight<S>> for Row {
    #[inline(always)]
    fn from(eight: Eight<S>) -> Self {
        Self(*eight)
    }
}
