//! How the small picture of a trial looks: too dark, too bright, alike all over, or as it should.

use super::frame::Frame;
use super::tone::{DisplayTransform, Tone};
use crate::job::NO_OBJECT;
use scene::{Rgb, Transfer};

/// Levels below this, of 255, count as dark.
const DARK: u8 = 4;

/// The median that a picture is to have, of 255.
const GOOD: f64 = 100.0;

/// The side of the squares whose means tell whether a picture is alike all over, in pixels: in them the
/// noise of single pixels evens out.
const SQUARE: usize = 4;

/// A picture is alike all over if the standard deviation of the means of its squares is less, of 255. That
/// of a white ball on white ground under a white sky is about 5, that of a grey ball which covers a
/// hundredth of a white picture 13.
const ALIKE: f64 = 8.0;

/// Which pixels of a picture a setting can change: all but those that see no object and nothing around.
#[derive(Clone, Debug)]
pub(crate) struct Shown {
    width: usize,
    pixels: Vec<bool>,
}

impl Shown {
    /// The pixels of a live frame.
    pub(crate) fn of(frame: &Frame) -> Self {
        let pixels = frame.values.iter().enumerate().map(|(at, value)| {
            let object = frame.objects.get(at);
            *value != [0.0; 3] || object.is_some_and(|object| *object != NO_OBJECT)
        });
        Self {
            width: frame.size.width as usize,
            pixels: pixels.collect(),
        }
    }
}

/// The figures of a picture as displayed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Appearance {
    /// Of the pixels shown, the share that is dark, 0 to 1.
    dark: f64,
    /// Of all pixels, the share that is above 1, 0 to 1.
    above: f64,
    /// The median of the channels of the pixels shown, 0 to 255.
    median: u8,
    /// The standard deviation of the means of squares, in levels.
    contrast: f64,
}

impl Appearance {
    /// The appearance of linear values after the exposure, brightened by further stops.
    pub(crate) fn of(
        values: &[[f32; 3]],
        shown: &Shown,
        (stops, transfer): (f64, Transfer),
    ) -> Self {
        let display = DisplayTransform::new(stops, transfer);
        let linear = |value: &[f32; 3]| Rgb::from(value.map(f64::from));
        let is_above = |value: &&[f32; 3]| 1.0 < display.exposed(linear(value)).max_element();
        let above = values.iter().filter(is_above).count();
        let tone = Tone::Colour(display);
        let bytes: Vec<_> = values
            .iter()
            .map(|value| tone.bytes(linear(value)))
            .collect();
        let seen = bytes.iter().zip(&shown.pixels);
        let seen: Vec<_> = seen.filter(|(_, seen)| **seen).map(|(it, _)| it).collect();
        let dark = seen
            .iter()
            .filter(|pixel| pixel.iter().all(|level| *level < DARK));
        let mut levels: Vec<u8> = seen.iter().flat_map(|pixel| **pixel).collect();
        let middle = levels.len() / 2;
        Self {
            dark: share(dark.count(), seen.len()),
            above: share(above, values.len()),
            median: if levels.is_empty() {
                0
            } else {
                *levels.select_nth_unstable(middle).1
            },
            contrast: contrast(&bytes, shown.width),
        }
    }

    /// Whether more than half of the picture is above 1.
    pub(crate) fn is_overexposed(self) -> bool {
        0.5 < self.above
    }

    /// How far the median of a picture that shows something is from the one it is to have, in levels;
    /// `None` if it is too dark, too bright or alike all over.
    pub(crate) fn distance(self) -> Option<f64> {
        let is_good = self.dark <= 0.5 && !self.is_overexposed() && ALIKE <= self.contrast;
        is_good.then(|| (f64::from(self.median) - GOOD).abs())
    }
}

/// A part of a whole, 0 to 1; 0 of nothing.
fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

/// The standard deviation of the means of squares, in the channel where it is largest.
fn contrast(bytes: &[[u8; 3]], width: usize) -> f64 {
    let across = width.div_ceil(SQUARE).max(1);
    let down = bytes.len().div_ceil(width.max(1)).div_ceil(SQUARE);
    let mut sums = vec![([0_u32; 3], 0_u32); across * down];
    for (at, pixel) in bytes.iter().enumerate() {
        let [x, y] = [at % width, at / width];
        let (sum, count) = &mut sums[y / SQUARE * across + x / SQUARE];
        for (sum, level) in sum.iter_mut().zip(pixel) {
            *sum += u32::from(*level);
        }
        *count += 1;
    }
    let deviation = |channel: usize| {
        let means = sums
            .iter()
            .map(|(sum, count)| f64::from(sum[channel]) / f64::from(*count));
        let squares = sums.len().max(1) as f64;
        let mean = means.clone().sum::<f64>() / squares;
        let variance = means.map(|it| (it - mean) * (it - mean)).sum::<f64>() / squares;
        variance.sqrt()
    };
    (0..3).map(deviation).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Size;

    /// The distance of the median, to the level, of a picture of 8 by 8 pixels of which `count` are
    /// `some` and the rest `others`, as levels; without an object where `others` is 0.
    fn distance((count, some): (usize, f32), others: f32) -> Option<f64> {
        let size = Size {
            width: 8,
            height: 8,
        };
        let mut values = vec![[some / 255.0; 3]; count];
        values.resize(size.pixels(), [others / 255.0; 3]);
        let frame = Frame {
            values: values.clone(),
            ..Frame::drawn(size, Vec::new())
        };
        let shown = Shown::of(&frame);
        Appearance::of(&values, &shown, (0.0, Transfer::Linear)).distance()
    }

    #[test]
    fn a_picture_shows_something_if_neither_dark_nor_bright_nor_alike() {
        for (some, others, expected) in [
            ((40, 90.0), 200.0, Some(10.0)),
            ((33, 3.0), 200.0, None),
            ((32, 3.0), 200.0, Some(100.0)),
            ((33, 256.0), 90.0, None),
            ((32, 256.0), 90.0, Some(155.0)),
            // White is not above 1.
            ((60, 255.0), 90.0, Some(155.0)),
            ((64, 90.0), 90.0, None),
            ((32, 90.0), 105.0, None),
            ((32, 90.0), 107.0, Some(7.0)),
            // What sees no object is not dark.
            ((16, 90.0), 0.0, Some(10.0)),
            ((0, 90.0), 0.0, None),
        ] {
            assert_eq!(distance(some, others), expected, "{some:?} {others}");
        }
    }
}
