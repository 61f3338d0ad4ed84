//! The 240 fixed colours of 256, and which two of them stand for any other.
//!
//! The first sixteen are the theme's and may be anything; they are never used.

use super::dither;

/// The levels of each channel in the 6×6×6 cube of 256 colours.
pub(super) const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The index of the first fixed colour.
const FIRST: u8 = 16;

/// Into how many equal parts a mix is divided.
const PARTS: u32 = 16;

/// How many of the nearest colours are tried with each other. With more, pairs are found that are
/// right on average and loud to the eye.
const CANDIDATES: usize = 12;

/// How much more a wrong hue counts than a wrong lightness. `OkLab`'s two axes of hue are about half
/// as long as the eye has them.
const HUE_WEIGHT: f32 = 2.0;

/// How much the noise of a mix counts beside the error of its mean. At 1 nothing is ever mixed; at
/// 0 the pairs lie far apart. With a half, pixels and means of 2×2 both come closer to the picture
/// than chafa's (see `benches/colours.rs`).
const NOISE_WEIGHT: f32 = 0.5;

/// The most that neighbours in an area of one colour may differ in luma, as a mean.
const FLAT: f32 = 12.0;

/// The width of a box of colours that share a mix. The levels of [`CUBE`] are multiples of it, so
/// that they are mapped to themselves.
const STEP: usize = 5;

/// Boxes along a channel.
const STEPS: usize = 255 / STEP + 1;

/// Mixes of the fixed colours, worked out as they are needed.
#[derive(Debug)]
pub(super) struct Palette {
    fixed: Vec<Fixed>,
    /// One for each box of colours, then one for each grey: the ramp's are no multiples of
    /// [`STEP`].
    mixes: Vec<Option<Mix>>,
}

/// A fixed colour.
#[derive(Clone, Copy, Debug)]
struct Fixed {
    index: u8,
    lab: [f32; 3],
    luma: f32,
}

/// Two fixed colours, the first one darker or the same.
#[derive(Clone, Copy, Debug)]
struct Mix {
    below: u8,
    above: u8,
    /// Of [`PARTS`], how many are of `above`.
    share: u8,
}

impl Palette {
    pub(super) fn new() -> Self {
        let fixed = (FIRST..=255).map(|index| {
            let colour = fixed_colour(index);
            Fixed {
                index,
                lab: oklab(colour),
                luma: luma(colour),
            }
        });
        Self {
            fixed: fixed.collect(),
            mixes: vec![None; STEPS * STEPS * STEPS + 256],
        }
    }

    /// The index of the fixed colour for a pixel at a place.
    pub(super) fn at(&mut self, colour: [u8; 3], x: u32, y: u32) -> u8 {
        let (slot, of_box) = slot(colour);
        let mix = match self.mixes[slot] {
            Some(mix) => mix,
            None => *self.mixes[slot].insert(mix(&self.fixed, oklab(of_box))),
        };
        let threshold = dither::threshold(x, y) * PARTS / dither::STEPS;
        if threshold < u32::from(mix.share) {
            mix.above
        } else {
            mix.below
        }
    }
}

/// The place of a colour's mix, and the colour that it is worked out for.
fn slot(colour: [u8; 3]) -> (usize, [u8; 3]) {
    let [red, green, blue] = colour;
    if red == green && green == blue {
        return (STEPS * STEPS * STEPS + usize::from(green), colour);
    }
    let boxes = colour.map(|channel| (usize::from(channel) + STEP / 2) / STEP);
    let [red, green, blue] = boxes;
    (
        (red * STEPS + green) * STEPS + blue,
        boxes.map(|at| (at * STEP) as u8),
    )
}

/// The quietest pair whose mean is close to a colour, or the nearest colour alone.
fn mix(fixed: &[Fixed], lab: [f32; 3]) -> Mix {
    let nearest = nearest(fixed, lab);
    let alone = nearest[0];
    let mut least = distance(alone.lab, lab);
    let mut best = Mix {
        below: alone.index,
        above: alone.index,
        share: 0,
    };
    for (at, one) in nearest.iter().enumerate() {
        for other in &nearest[..at] {
            let (below, above) = if one.luma <= other.luma {
                (one, other)
            } else {
                (other, one)
            };
            let (along, mean, spread) = projected(below.lab, above.lab, lab);
            let cost = distance(mean, lab) + NOISE_WEIGHT * along * (1.0 - along) * spread;
            if least <= cost {
                continue;
            }
            let share = (light_share(along, below.lab[0], above.lab[0]) * PARTS as f32).round();
            let part = share / PARTS as f32;
            // In an ordered pattern each pixel of the rarer colour has its neighbours of the other.
            let step = 2.0 * part.min(1.0 - part) * (above.luma - below.luma);
            if 0.0 < part && part < 1.0 && step <= FLAT {
                least = cost;
                best = Mix {
                    below: below.index,
                    above: above.index,
                    share: share as u8,
                };
            }
        }
    }
    best
}

/// The fixed colours closest to a colour, the closest first.
fn nearest(fixed: &[Fixed], lab: [f32; 3]) -> [Fixed; CANDIDATES] {
    let mut found = [(f32::INFINITY, fixed[0]); CANDIDATES];
    for &candidate in fixed {
        let far = distance(candidate.lab, lab);
        if far < found[CANDIDATES - 1].0 {
            let at = found.partition_point(|&(closer, _)| closer <= far);
            found.copy_within(at..CANDIDATES - 1, at + 1);
            found[at] = (far, candidate);
        }
    }
    found.map(|(_, fixed)| fixed)
}

/// The point of the line from one colour to another that is closest to a third: how far along it
/// lies, from 0 to 1, the point itself, and the squared length of the line.
fn projected(from: [f32; 3], to: [f32; 3], of: [f32; 3]) -> (f32, [f32; 3], f32) {
    let line: [f32; 3] = std::array::from_fn(|axis| to[axis] - from[axis]);
    let dot = |other: [f32; 3]| -> f32 { (0..3).map(|axis| line[axis] * other[axis]).sum() };
    let spread = dot(line);
    let along = dot(std::array::from_fn(|axis| of[axis] - from[axis])) / spread;
    let along = along.clamp(0.0, 1.0);
    let mean = std::array::from_fn(|axis| from[axis] + along * line[axis]);
    (along, mean, spread)
}

/// The share of the light that makes a mix look as if it lay so far along. Light adds up, and is
/// the cube of lightness.
fn light_share(along: f32, from: f32, to: f32) -> f32 {
    let way = to - from;
    let part = |along: f32| along * (3.0 * from * (from + along * way) + (along * way).powi(2));
    part(along) / part(1.0)
}

/// A squared distance of colours.
fn distance(one: [f32; 3], other: [f32; 3]) -> f32 {
    let [lightness, a, b] = std::array::from_fn(|axis| (one[axis] - other[axis]).powi(2));
    lightness + HUE_WEIGHT * (a + b)
}

/// Red, green and blue of a fixed colour.
fn fixed_colour(index: u8) -> [u8; 3] {
    let at = index - FIRST;
    match index {
        // The ramp has 24 steps of ten from 8 to 238.
        232.. => [8 + 10 * (index - 232); 3],
        _ => [at / 36, at / 6 % 6, at % 6].map(|level| CUBE[usize::from(level)]),
    }
}

/// The brightness of an 8-bit colour, from 0 to 255, with the weights of Rec. 709.
pub(super) fn luma([red, green, blue]: [u8; 3]) -> f32 {
    0.2126 * f32::from(red) + 0.7152 * f32::from(green) + 0.0722 * f32::from(blue)
}

/// An 8-bit sRGB colour in `OkLab`, where distances are about those that are seen (B. Ottosson, “A
/// perceptual color space for image processing”, 2020).
fn oklab(colour: [u8; 3]) -> [f32; 3] {
    let light = colour.map(|channel| {
        let value = f32::from(channel) / 255.0;
        if value <= 0.04045 {
            value / 12.92
        } else {
            ((value + 0.055) / 1.055).powf(2.4)
        }
    });
    let times = |rows: [[f32; 3]; 3], of: [f32; 3]| {
        rows.map(|row| row[0] * of[0] + row[1] * of[1] + row[2] * of[2])
    };
    let cones = times(
        [
            [0.412_221_47, 0.536_332_54, 0.051_445_995],
            [0.211_903_5, 0.680_699_5, 0.107_396_96],
            [0.088_302_46, 0.281_718_85, 0.629_978_7],
        ],
        light,
    );
    times(
        [
            [0.210_454_26, 0.793_617_8, -0.004_072_047],
            [1.977_998_5, -2.428_592_2, 0.450_593_7],
            [0.025_904_037, 0.782_771_77, -0.808_675_77],
        ],
        cones.map(f32::cbrt),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: std::ops::Range<u32> = 0..64;

    /// The fixed colours of a patch of one colour, 8×8 pixels.
    fn patch(palette: &mut Palette, colour: [u8; 3]) -> Vec<[u8; 3]> {
        PLACES
            .map(|at| fixed_colour(palette.at(colour, at % 8, at / 8)))
            .collect()
    }

    /// A few thousand colours, on no level of the cube.
    fn colours() -> impl Iterator<Item = [u8; 3]> {
        let level = |at: u32| (at * 17 + 3).min(255) as u8;
        (0..16 * 16 * 16).map(move |at| [level(at / 256), level(at / 16 % 16), level(at % 16)])
    }

    #[test]
    fn fixed_colours_are_mapped_to_themselves() {
        let mut palette = Palette::new();
        for index in FIRST..=255 {
            let colour = fixed_colour(index);
            assert!(
                patch(&mut palette, colour).iter().all(|&c| c == colour),
                "{index}"
            );
        }
    }

    #[test]
    fn greys_are_mixed_from_greys() {
        let mut palette = Palette::new();
        for grey in 0..=255 {
            for shown in patch(&mut palette, [grey; 3]) {
                assert_eq!([shown[0], shown[1]], [shown[1], shown[2]], "{grey}");
                // The widest gap is from the last of the ramp to white.
                assert!(shown[0].abs_diff(grey) <= 17, "{shown:?} for {grey}");
            }
        }
    }

    #[test]
    fn flat_stays_flat() {
        let mut palette = Palette::new();
        for colour in colours() {
            let patch = patch(&mut palette, colour);
            let luma = |at: u32| luma(patch[at as usize]);
            let steps = PLACES.flat_map(|at| {
                let (right, below) = (at / 8 * 8 + (at + 1) % 8, (at + 8) % 64);
                [luma(at) - luma(right), luma(at) - luma(below)]
            });
            let mean = steps.map(f32::abs).sum::<f32>() / 128.0;
            assert!(mean <= FLAT + 0.01, "{colour:?}: {mean}");
        }
    }

    #[test]
    fn a_patch_is_as_close_as_its_nearest_colour_or_closer() {
        let mut palette = Palette::new();
        let light = |v: u8| (f32::from(v) / 255.0).powf(2.2);
        let (mut mixed, mut alone, mut count) = (0.0, 0.0, 0.0);
        for colour in colours() {
            let patch = patch(&mut palette, colour);
            let mean = [0, 1, 2].map(|channel| {
                let sum: f32 = patch.iter().map(|shown| light(shown[channel])).sum();
                ((sum / 64.0).powf(1.0 / 2.2) * 255.0).round() as u8
            });
            let lab = oklab(colour);
            mixed += distance(oklab(mean), lab).sqrt();
            alone += distance(nearest(&palette.fixed, lab)[0].lab, lab).sqrt();
            count += 1.0;
        }
        let (mixed, alone) = (mixed / count, alone / count);
        assert!(mixed < 0.75 * alone, "{mixed} of {alone}");
    }

    #[test]
    fn lightness_is_that_of_the_colour_space() {
        let white = oklab([255; 3]);
        assert!((white[0] - 1.0).abs() < 1e-3 && white[1].abs() < 1e-3 && white[2].abs() < 1e-3);
        // Red, as its author gives it.
        let red = oklab([255, 0, 0]);
        for (value, known) in red.into_iter().zip([0.628, 0.225, 0.126]) {
            assert!((value - known).abs() < 1e-3, "{red:?}");
        }
    }
}
