//! Conversion of pixel values to 8 bits per channel.

use crate::scene::{Rgb, Transfer};

/// The mapping from pixel values to colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Tone {
    /// A linear colour.
    Colour(Transfer),
    /// A distance: the nearest is white, the farthest black, infinity black too.
    Depth { nearest: f64, farthest: f64 },
    /// A unit vector with components from −1 to 1; zero is black.
    Normal,
    /// A number, each in its own colour; 0 is black.
    Number,
}

impl Tone {
    /// Converts a value to 8 bits per channel.
    #[inline]
    pub(crate) fn bytes(self, value: Rgb) -> [u8; 3] {
        match self {
            Self::Colour(transfer) => to_bytes(curved(value, transfer)),
            Self::Depth { .. } if value.x == f64::INFINITY => [0; 3],
            Self::Depth { nearest, farthest } if nearest < farthest => {
                to_bytes((farthest - value) / (farthest - nearest))
            }
            Self::Depth { .. } => [255; 3],
            Self::Normal | Self::Number if value == Rgb::ZERO => [0; 3],
            Self::Normal => to_bytes(0.5 * value + 0.5),
            Self::Number => colour_of(value.x as u32),
        }
    }
}

/// Returns a colour as displayed, each channel from 0 to 1.
pub(crate) fn displayed(colour: Rgb, transfer: Transfer) -> Rgb {
    // NaN survives clamping and becomes 0, as in bytes.
    curved(colour, transfer).map(|channel| channel.clamp(0.0, 1.0).max(0.0))
}

/// Applies the transfer function.
fn curved(colour: Rgb, transfer: Transfer) -> Rgb {
    match transfer {
        Transfer::Linear => colour,
        Transfer::Srgb => colour.map(srgb),
    }
}

/// Returns a bright colour for a number; Fibonacci hashing (Knuth, The Art of Computer Programming
/// 6.4) makes neighbours distinct.
fn colour_of(number: u32) -> [u8; 3] {
    let [hash @ .., _] = number.wrapping_mul(0x9E37_79B9).to_be_bytes();
    hash.map(|byte| 64 | byte)
}

/// The sRGB transfer function for a linear value from 0 to 1.
fn srgb(linear: f64) -> f64 {
    if linear <= 0.003_130_8 {
        12.92 * linear
    } else {
        1.055 * libm::pow(linear, 1.0 / 2.4) - 0.055
    }
}

/// Quantises each channel: ⌊255 · clamp(c, 0, 1) + ½⌋.
fn to_bytes(colour: Rgb) -> [u8; 3] {
    // The cast truncates and maps NaN to 0.
    colour
        .to_array()
        .map(|channel| (255.0 * channel.clamp(0.0, 1.0) + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the standard's table: 128 / 255 is linear 0.21586; 0.003 lies in the linear segment.
    #[test]
    fn the_srgb_curve_matches_the_standard() {
        let tone = Tone::Colour(Transfer::Srgb);
        for (linear, byte) in [
            (0.0, 0),
            (1.0, 255),
            (0.215_860_5, 128),
            (0.003, 10),
            (0.5, 188),
            (2.0, 255),
            (-1.0, 0),
        ] {
            assert_eq!(tone.bytes(Rgb::splat(linear)), [byte; 3], "{linear}");
        }
    }

    #[test]
    fn distances_normals_and_numbers_have_distinct_mappings() {
        let depth = Tone::Depth {
            nearest: 2.0,
            farthest: 4.0,
        };
        for (distance, byte) in [(2.0, 255), (3.0, 128), (4.0, 0), (f64::INFINITY, 0)] {
            assert_eq!(depth.bytes(Rgb::splat(distance)), [byte; 3], "{distance}");
        }
        let flat = Tone::Depth {
            nearest: 2.0,
            farthest: 2.0,
        };
        assert_eq!(flat.bytes(Rgb::splat(2.0)), [255; 3]);
        assert_eq!(Tone::Normal.bytes(Rgb::new(0.0, 1.0, -1.0)), [128, 255, 0]);
        assert_eq!(Tone::Normal.bytes(Rgb::ZERO), [0; 3]);
        assert_eq!(Tone::Number.bytes(Rgb::ZERO), [0; 3]);
        let colours: std::collections::BTreeSet<_> = (1..200)
            .map(|number| Tone::Number.bytes(Rgb::splat(f64::from(number))))
            .collect();
        assert_eq!(colours.len(), 199);
    }

    #[test]
    fn values_are_clamped_and_rounded_to_the_nearest_level() {
        for (channel, byte) in [
            (0.0, 0),
            (1.0, 255),
            (0.5, 128),
            (0.499, 127),
            (0.5 / 255.0, 1),
            (0.49 / 255.0, 0),
            (-3.0, 0),
            (7.0, 255),
            (f64::INFINITY, 255),
        ] {
            assert_eq!(to_bytes(Rgb::splat(channel)), [byte; 3], "{channel}");
        }
    }
}
