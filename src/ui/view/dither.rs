//! Ordered dithering: colours that a terminal lacks, mixed from neighbouring pixels of colours it
//! has.
//!
//! What a pixel becomes depends on its colour and its place alone, so that a picture that has not
//! changed sends nothing.

use ratatui::style::Color;

/// The greys of the sixteen colours, dark to bright, and their indices.
const GREYS_OF_16: ([u8; 4], [u8; 4]) = ([0, 128, 192, 255], [0, 8, 7, 15]);

/// The most that channels differ in a colour that is taken for a grey.
const GREY: u8 = 8;

/// How many thresholds there are.
pub(super) const STEPS: u32 = 64;

/// The threshold of a pixel, less than [`STEPS`]: Bayer's 8×8 matrix (B. E. Bayer, “An optimum
/// method for two-level rendition of continuous-tone pictures”, 1973).
pub(super) fn threshold(x: u32, y: u32) -> u32 {
    (0..3).fold(0, |sum, bit| {
        let (x, y) = (x >> bit & 1, y >> bit & 1);
        4 * sum + 2 * (x ^ y) + y
    })
}

/// One of the terminal's sixteen colours, for a pixel at a place.
///
/// Dark colours are mixed from the eight dark ones, others from the corners of the cube of colours:
/// each channel is right on average, so that hues survive.
pub(super) fn of_16(colour: [u8; 3], x: u32, y: u32) -> Color {
    let threshold = threshold(x, y);
    if let Some(grey) = grey(colour) {
        let (levels, indices) = GREYS_OF_16;
        return Color::Indexed(indices[usize::from(level(grey, &levels, threshold))]);
    }
    let dark = colour.iter().all(|&channel| channel <= 128);
    let levels = if dark { [0, 128] } else { [0, 255] };
    let [red, green, blue] = colour.map(|channel| level(channel, &levels, threshold));
    let bits = red + 2 * green + 4 * blue;
    Color::Indexed(match (bits, dark) {
        // The dark white is brighter than its channels say; the bright black is what is meant.
        (7, true) => 8,
        (0, _) | (_, true) => bits,
        (_, false) => 8 + bits,
    })
}

/// The brightness of a colour that is a grey to the eye.
fn grey(colour: [u8; 3]) -> Option<u8> {
    let [red, green, blue] = colour;
    let (least, most) = (red.min(green).min(blue), red.max(green).max(blue));
    (most - least <= GREY).then_some(green)
}

/// The index of one of the two levels around a value, so that the light of many pixels with
/// different thresholds is on average the value's. Light is taken for the square of a value, which
/// is close to sRGB's curve. The levels rise from 0 to 255, or the value is at most the last.
fn level(value: u8, levels: &[u8], threshold: u32) -> u8 {
    let light = |value: u8| u32::from(value) * u32::from(value);
    let upper = levels.partition_point(|&level| level < value);
    let (Some(lower), Some(&above)) = (upper.checked_sub(1), levels.get(upper)) else {
        return 0;
    };
    let below = light(levels[lower]);
    let share = (light(value) - below) * 2 * STEPS;
    let takes_upper = (2 * threshold + 1) * (light(above) - below) < share;
    (if takes_upper { upper } else { lower }) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The colours of the palette as xterm's chart has them.
    fn chart(colour: Color) -> [u8; 3] {
        let Color::Indexed(index) = colour else {
            panic!("{colour:?} is none of the palette");
        };
        match index {
            7 => [192; 3],
            8 => [128; 3],
            _ => {
                let full = if index < 8 { 128 } else { 255 };
                [0, 1, 2].map(|bit| if index >> bit & 1 == 1 { full } else { 0 })
            }
        }
    }

    /// The value whose square is the mean square of each channel over a patch of one colour.
    fn seen(dithered: impl Fn(u32, u32) -> Color) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for at in 0..64 {
            for (sum, channel) in sums.iter_mut().zip(chart(dithered(at % 8, at / 8))) {
                *sum += f64::from(channel) * f64::from(channel) / 64.0;
            }
        }
        sums.map(f64::sqrt)
    }

    const COLOURS: [[u8; 3]; 9] = [
        [0, 0, 0],
        [255, 255, 255],
        [200, 60, 30],
        [90, 20, 110],
        [20, 90, 40],
        [255, 140, 0],
        [60, 120, 250],
        [131, 131, 131],
        [40, 40, 44],
    ];

    #[test]
    fn every_threshold_is_used_once() {
        let mut all: Vec<u32> = (0..64).map(|at| threshold(at % 8, at / 8)).collect();
        all.sort_unstable();
        assert_eq!(all, (0..64).collect::<Vec<_>>());
        assert_eq!([threshold(0, 0), threshold(1, 1)], [0, 16]);
    }

    #[test]
    fn a_patch_has_its_colour_on_average() {
        for colour in COLOURS {
            let seen = seen(|x, y| of_16(colour, x, y));
            for (channel, seen) in colour.into_iter().zip(seen) {
                let channel = f64::from(channel);
                // Half a step of 64 in the light of the widest gap, or the width of a grey.
                let error = (seen * seen - channel * channel).abs();
                let bound = 255.0 * 255.0 / 128.0 + 2.0 * channel * f64::from(GREY);
                assert!(error <= bound, "{colour:?}: {seen} for {channel}");
            }
        }
    }
}
