//! Sine and cosine in lanes, bit for bit those of the crate `libm`.
//!
//! The reduction by multiples of π/2 and the kernels are those of fdlibm (Sun Microsystems, 1993), as
//! in `libm`; a version of it that computes otherwise fails the test below.

use super::Lanes;

/// π/2 to 33 bits, and the rest.
const QUARTER: [f64; 2] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A62_6331),
];

/// Where the number of quarter turns subtracted rises to 1, 2, 3 and 4: about odd multiples of π/4.
const STEPS: [f64; 4] = [
    first_with(0x3FE9_21FC),
    first_with(0x4002_D97D),
    first_with(0x400F_6A7B),
    first_with(0x4015_FDBD),
];

/// The upper words of multiples of π/2. For angles that start with one of them, the reduction cancels
/// too many bits.
const MULTIPLES: [u64; 4] = [0x3FF9_21FB, 0x4009_21FB, 0x4012_D97C, 0x4019_21FB];

/// Coefficients of x³, x⁵, … of the sine.
const SINE: [f64; 6] = [
    f64::from_bits(0xBFC5_5555_5555_5549),
    f64::from_bits(0x3F81_1111_1110_F8A6),
    f64::from_bits(0xBF2A_01A0_19C1_61D5),
    f64::from_bits(0x3EC7_1DE3_57B1_FE7D),
    f64::from_bits(0xBE5A_E5E6_8A2B_9CEB),
    f64::from_bits(0x3DE5_D93A_5ACF_D57C),
];

/// Coefficients of x⁴, x⁶, … of the cosine.
const COSINE: [f64; 6] = [
    f64::from_bits(0x3FA5_5555_5555_554C),
    f64::from_bits(0xBF56_C16C_16C1_5177),
    f64::from_bits(0x3EFA_01A0_19CB_1590),
    f64::from_bits(0xBE92_7E4F_809C_52AD),
    f64::from_bits(0x3E21_EE9E_BDB4_B1C4),
    f64::from_bits(0xBDA8_FAE9_BE88_38D4),
];

/// The first number whose bits start with a word.
const fn first_with(word: u64) -> f64 {
    f64::from_bits(word << 32)
}

/// The sine and cosine of angles from 0 to 2π, and a mask of those that are too near to a multiple of
/// π/2 for them to be exact.
#[inline(always)]
pub(super) fn sincos<N: Lanes>(angle: N) -> ([N; 2], N::Mask) {
    // Not by `map`, which is not inlined.
    let [first, second, third, fourth] = STEPS;
    let (first, second) = (reaches(angle, first), reaches(angle, second));
    let (third, fourth) = (reaches(angle, third), reaches(angle, fourth));
    let (zero, one) = (angle.all(0.0), angle.all(1.0));
    let turns = N::select(first, one, zero)
        + N::select(second, one, zero)
        + N::select(third, one, zero)
        + N::select(fourth, one, zero);
    let [high, low] = QUARTER;
    let high = angle - turns * angle.all(high);
    let low = turns * angle.all(low);
    let rest = high - low;
    let tail = (high - rest) - low;
    let [sine, cosine] = kernels([rest, tail], first);

    let is_odd = (first ^ second) | (third ^ fourth);
    let (up, across) = (
        N::select(is_odd, cosine, sine),
        N::select(is_odd, sine, cosine),
    );
    let up = N::select(second ^ fourth, -up, up);
    let across = N::select(first ^ third, -across, across);

    let [first, second, third, fourth] = MULTIPLES;
    let near = starts_with(angle, first)
        | starts_with(angle, second)
        | starts_with(angle, third)
        | starts_with(angle, fourth);
    ([up, across], near)
}

/// Whether an angle is not below a limit.
#[inline(always)]
fn reaches<N: Lanes>(angle: N, limit: f64) -> N::Mask {
    angle.all(limit).up_to(angle)
}

/// Whether a number's bits start with a word.
#[inline(always)]
fn starts_with<N: Lanes>(number: N, word: u64) -> N::Mask {
    reaches(number, first_with(word)) & number.below(number.all(first_with(word + 1)))
}

/// The sine and cosine of an angle of at most about π/4, given with its rounding error if it was
/// reduced.
#[inline(always)]
fn kernels<N: Lanes>([angle, tail]: [N; 2], is_reduced: N::Mask) -> [N; 2] {
    let [s1, s2, s3, s4, s5, s6] = SINE;
    let [c1, c2, c3, c4, c5, c6] = COSINE;
    let (half, one) = (angle.all(0.5), angle.all(1.0));
    let square = angle * angle;
    let fourth = square * square;

    let cube = square * angle;
    let low = angle.all(s2) + square * (angle.all(s3) + square * angle.all(s4));
    let series = low + square * fourth * (angle.all(s5) + square * angle.all(s6));
    let plain = angle + cube * (angle.all(s1) + square * series);
    let reduced = angle - ((square * (half * tail - cube * series) - tail) - cube * angle.all(s1));
    let sine = N::select(is_reduced, reduced, plain);

    let low = square * (angle.all(c1) + square * (angle.all(c2) + square * angle.all(c3)));
    let high = angle.all(c4) + square * (angle.all(c5) + square * angle.all(c6));
    let series = low + fourth * fourth * high;
    let halved = half * square;
    let rough = one - halved;
    let cosine = rough + (((one - rough) - halved) + (square * series - angle * tail));
    [sine, cosine]
}

/// Sines and cosines, computed anew in the lanes whose bit is 1.
#[cold]
#[inline(never)]
pub(super) fn repaired<const N: usize>(
    angles: [f64; N],
    [mut sines, mut cosines]: [[f64; N]; 2],
    lanes: u64,
) -> [[f64; N]; 2] {
    for lane in (0..N).filter(|lane| lanes >> lane & 1 == 1) {
        (sines[lane], cosines[lane]) = libm::sincos(angles[lane]);
    }
    [sines, cosines]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::super::{Eight, Level, SimdBase, WIDTH, dispatch};
    use super::*;

    /// Multiples of 2⁻²³ of a turn, as samples are, those about the ends of quarter and eighth turns
    /// among them.
    fn parts() -> impl Iterator<Item = u32> {
        let near = (0..=8).flat_map(|eighth: u32| {
            let end = eighth << 20;
            end.saturating_sub(100)..(end + 100).min(1 << 23)
        });
        near.chain((0..1 << 23).step_by(97))
    }

    #[test]
    fn sine_and_cosine_have_the_bits_of_libm() {
        let mut angles: Vec<f64> = parts()
            .map(|part| TAU * (f64::from(part) / 8_388_608.0))
            .collect();
        angles.resize(angles.len().next_multiple_of(WIDTH), 0.0);
        let multiples = MULTIPLES.map(first_with);
        assert!(multiples.iter().all(|&multiple| {
            let mut near = angles.iter().map(|angle| angle - multiple);
            near.any(|off| (0.0..1e-6).contains(&off))
        }));
        for level in [Level::baseline(), Level::new()] {
            for angles in angles.chunks(WIDTH) {
                let found: [[f64; WIDTH]; 2] = dispatch!(level, simd => {
                    let eight = Eight::load_array(simd, angles.try_into().expect("eight angles"));
                    Lanes::sincos(eight).map(|eight| *eight)
                });
                for (lane, &angle) in angles.iter().enumerate() {
                    let (sine, cosine) = libm::sincos(angle);
                    assert_eq!(
                        [found[0][lane], found[1][lane]].map(f64::to_bits),
                        [sine, cosine].map(f64::to_bits),
                        "{angle:e}"
                    );
                }
            }
        }
    }
}
