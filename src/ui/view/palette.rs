//! The colours of a terminal that has only a few, and which of them stand for any other.
//!
//! A colour becomes a mix: a few of the palette's in a pattern, whose light together is close to
//! its own. Of 256 colours the first sixteen are never used: they are the theme's.

use super::dither;
use super::oklab::{light, luma, oklab};

/// The levels of each channel in the 6×6×6 cube of 256 colours.
const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

/// The sixteen colours: the mean light of xterm's, the Linux console's, the Tango palette's and
/// Windows' first. Pictures made for the mean are closer than chafa's in each of these themes; those
/// made for xterm's alone are not.
const THEME: [[u8; 3]; 16] = [
    [0, 0, 0],
    [180, 0, 0],
    [38, 167, 2],
    [178, 153, 0],
    [23, 51, 181],
    [160, 39, 161],
    [2, 167, 167],
    [202, 202, 202],
    [109, 109, 109],
    [251, 47, 47],
    [83, 248, 49],
    [254, 250, 58],
    [85, 103, 244],
    [238, 78, 237],
    [49, 248, 248],
    [251, 251, 251],
];

/// How many pixels a mix is made of.
const PARTS: usize = 8;

/// How many of the nearest colours are tried for a mix. With more, mixes are found that are right on
/// average and loud to the eye.
const CANDIDATES: usize = 12;

/// How much more a wrong hue counts than a wrong lightness. `OkLab`'s two axes of hue are about half
/// as long as the eye has them.
const HUE_WEIGHT: f32 = 2.0;

/// The most that neighbours in an area of one colour may differ in luma, as a mean, in 256 colours. At
/// 12, skies and walls show the pattern; at 4, means of 2×2 pixels are off by a tenth more.
const FLAT: f32 = 7.5;

/// The width of a box of colours that share a mix. The levels of [`CUBE`] are multiples of it, so
/// that they are mapped to themselves.
const STEP: usize = 5;

/// Boxes along a channel.
const STEPS: usize = 255 / STEP + 1;

/// Which of a palette's colours are mixed. See `benches/colours.rs` for what it comes to.
#[derive(Clone, Copy, Debug)]
struct Taste {
    /// How much the noise of a mix counts beside the error of its mean. The more, the flatter areas
    /// are, and the coarser the steps between them.
    noise: f32,
    /// The most that neighbours in an area of one colour may differ in luma, as a mean.
    step: f32,
    /// How far a colour of a mix may be from the nearest one, as a part of the lightness: what is
    /// close in the light is loud in the dark, such as teal among greys.
    reach: f32,
}

/// Colours of a palette, and mixes of them, made as they are needed.
#[derive(Debug)]
pub(super) struct Palette {
    colours: Vec<Fixed>,
    taste: Taste,
    /// One for each box of colours, then one for each grey: the ramp's are not multiples of
    /// [`STEP`].
    mixes: Vec<Option<Mix>>,
}

/// A colour of a palette.
#[derive(Clone, Copy, Debug)]
struct Fixed {
    index: u8,
    light: [f32; 3],
    lab: [f32; 3],
    luma: f32,
    is_grey: bool,
}

/// Indices of colours, the darkest first.
type Mix = [u8; PARTS];

impl Palette {
    /// The 240 fixed colours of 256.
    pub(super) fn of_256() -> Self {
        let taste = Taste {
            noise: 0.6,
            step: FLAT,
            reach: 0.3,
        };
        Self::new((16..=255).map(|index| (index, fixed_colour(index))), taste)
    }

    /// The sixteen colours of the terminal's theme.
    pub(super) fn of_16() -> Self {
        // Nothing is close to anything here: contrast and hue are worth the noise.
        let taste = Taste {
            noise: 0.2,
            step: f32::MAX,
            reach: f32::MAX,
        };
        Self::new((0..).zip(THEME), taste)
    }

    fn new(colours: impl Iterator<Item = (u8, [u8; 3])>, taste: Taste) -> Self {
        let colours = colours.map(|(index, colour)| Fixed {
            index,
            light: light(colour),
            lab: oklab(light(colour)),
            luma: luma(colour),
            is_grey: is_grey(colour),
        });
        Self {
            colours: colours.collect(),
            taste,
            mixes: vec![None; STEPS * STEPS * STEPS + 256],
        }
    }

    /// The index of the colour for a pixel at a place.
    pub(super) fn at(&mut self, colour: [u8; 3], x: u32, y: u32) -> u8 {
        let (slot, of_box) = slot(colour);
        let mix = match self.mixes[slot] {
            Some(mix) => mix,
            None => *self.mixes[slot].insert(mix(&self.colours, self.taste, of_box)),
        };
        mix[dither::threshold(x, y) as usize * PARTS / dither::STEPS as usize]
    }
}

/// The place of a colour's mix, and the colour that it is made for.
fn slot(colour: [u8; 3]) -> (usize, [u8; 3]) {
    if is_grey(colour) {
        return (STEPS * STEPS * STEPS + usize::from(colour[0]), colour);
    }
    let boxes = colour.map(|channel| (usize::from(channel) + STEP / 2) / STEP);
    let [red, green, blue] = boxes;
    (
        (red * STEPS + green) * STEPS + blue,
        boxes.map(|at| (at * STEP) as u8),
    )
}

/// A mix whose light as a whole, and whose every part, is close to a colour. Each part in turn is the
/// one that brings the light of those so far closest. Greys are mixed from greys.
fn mix(colours: &[Fixed], taste: Taste, colour: [u8; 3]) -> Mix {
    let goal = oklab(light(colour));
    let mut nearest = nearest(colours, goal);
    let closest = nearest[0];
    let reach = (taste.reach * goal[0]).powi(2);
    let mut kept = 0;
    for at in 0..CANDIDATES {
        let candidate = nearest[at];
        let is_close = squared(candidate.lab, closest.lab, 1.0) <= reach;
        if is_close && (candidate.is_grey || !is_grey(colour)) {
            nearest[kept] = candidate;
            kept += 1;
        }
    }
    let candidates = &nearest[..kept];
    let mut parts = [closest; PARTS];
    let mut sum = [0.0; 3];
    // In Bayer's pattern the neighbours of the brighter half of a mix are the darker half, so that
    // their mean step is twice the mean deviation from the median, or less than from any other part.
    let mut room = taste.step * PARTS as f32 / 2.0;
    let mut first = None;
    for (count, part) in (1_u8..).zip(&mut parts) {
        let share = f32::from(count).recip();
        let mut least = f32::INFINITY;
        for &candidate in candidates {
            let deviation = (candidate.luma - first.unwrap_or(candidate.luma)).abs();
            if room < deviation {
                continue;
            }
            let mean = std::array::from_fn(|at| (sum[at] + candidate.light[at]) * share);
            let noise = taste.noise * share * squared(candidate.lab, goal, 1.0);
            let cost = squared(oklab(mean), goal, HUE_WEIGHT) + noise;
            if cost < least {
                (least, *part) = (cost, candidate);
            }
        }
        sum = std::array::from_fn(|at| sum[at] + part.light[at]);
        room -= (part.luma - *first.get_or_insert(part.luma)).abs();
    }
    parts.sort_by(|one, other| one.luma.total_cmp(&other.luma));
    parts.map(|part| part.index)
}

/// The colours closest to a colour, the closest first.
fn nearest(colours: &[Fixed], lab: [f32; 3]) -> [Fixed; CANDIDATES] {
    let mut found = [(f32::INFINITY, colours[0]); CANDIDATES];
    for &candidate in colours {
        let far = squared(candidate.lab, lab, HUE_WEIGHT);
        if far < found[CANDIDATES - 1].0 {
            let at = found.partition_point(|&(closer, _)| closer <= far);
            found.copy_within(at..CANDIDATES - 1, at + 1);
            found[at] = (far, candidate);
        }
    }
    found.map(|(_, fixed)| fixed)
}

fn is_grey([red, green, blue]: [u8; 3]) -> bool {
    red == green && green == blue
}

/// A squared distance of colours.
fn squared(one: [f32; 3], other: [f32; 3], hue_weight: f32) -> f32 {
    let [lightness, a, b] = std::array::from_fn(|axis| (one[axis] - other[axis]).powi(2));
    lightness + hue_weight * (a + b)
}

/// Red, green and blue of one of the fixed colours of 256.
fn fixed_colour(index: u8) -> [u8; 3] {
    let at = index - 16;
    match index {
        // The ramp has 24 steps of ten from 8 to 238.
        232.. => [8 + 10 * (index - 232); 3],
        _ => [at / 36, at / 6 % 6, at % 6].map(|level| CUBE[usize::from(level)]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLACES: std::ops::Range<u32> = 0..64;

    /// The colour of an index.
    type Look = fn(u8) -> [u8; 3];

    fn palettes() -> [(Palette, Look); 2] {
        [
            (Palette::of_256(), fixed_colour),
            (Palette::of_16(), |index| THEME[usize::from(index)]),
        ]
    }

    /// The colours of a patch of one colour, 8×8 pixels.
    fn patch(palette: &mut Palette, look: Look, colour: [u8; 3]) -> Vec<[u8; 3]> {
        PLACES
            .map(|at| look(palette.at(colour, at % 8, at / 8)))
            .collect()
    }

    /// A few thousand colours, on no level of the cube.
    fn colours() -> impl Iterator<Item = [u8; 3]> {
        let level = |at: u32| (at * 17 + 3).min(255) as u8;
        (0..16 * 16 * 16).map(move |at| [level(at / 256), level(at / 16 % 16), level(at % 16)])
    }

    /// The colour of a patch seen from afar, in `OkLab`.
    fn mean(patch: &[[u8; 3]]) -> [f32; 3] {
        let sum = patch.iter().map(|&shown| light(shown));
        let sum = sum.fold([0.0; 3], |sum, light| {
            [0, 1, 2].map(|at| sum[at] + light[at])
        });
        oklab(sum.map(|channel| channel / patch.len() as f32))
    }

    #[test]
    fn fixed_colours_are_mapped_to_themselves() {
        let mut palette = Palette::of_256();
        for index in 16..=255 {
            let colour = fixed_colour(index);
            assert!(
                patch(&mut palette, fixed_colour, colour)
                    .iter()
                    .all(|&shown| shown == colour),
                "{index}"
            );
        }
    }

    #[test]
    fn greys_are_mixed_from_greys() {
        // The widest gap of 256 is from the last of the ramp to white.
        for ((mut palette, look), gap) in palettes().into_iter().zip([17, 109]) {
            for grey in 0..=255 {
                for shown in patch(&mut palette, look, [grey; 3]) {
                    assert_eq!([shown[0], shown[1]], [shown[1], shown[2]], "{grey}");
                    assert!(shown[0].abs_diff(grey) <= gap, "{shown:?} for {grey}");
                }
            }
        }
    }

    #[test]
    fn flat_stays_flat() {
        let mut palette = Palette::of_256();
        for colour in colours() {
            let patch = patch(&mut palette, fixed_colour, colour);
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
    fn no_saturated_dots_stand_on_dark_greys() {
        let mut palette = Palette::of_256();
        let dark = colours().filter(|&colour| luma(colour) < 80.0);
        for colour in dark.filter(|&[r, g, b]| r.max(g).max(b) - r.min(g).min(b) <= 40) {
            let patch = patch(&mut palette, fixed_colour, colour);
            let spread = |at: usize| patch.iter().map(move |shown| oklab(light(*shown))[at]);
            for axis in [1, 2] {
                let most = spread(axis).fold(f32::NEG_INFINITY, f32::max);
                let least = spread(axis).fold(f32::INFINITY, f32::min);
                assert!(most - least < 0.12, "{colour:?}: {patch:?}");
            }
        }
    }

    #[test]
    fn a_patch_is_closer_than_its_nearest_colour() {
        for ((mut palette, look), part) in palettes().into_iter().zip([0.75, 0.5]) {
            let (mut mixed, mut alone, mut count) = (0.0, 0.0, 0.0);
            for colour in colours() {
                let lab = oklab(light(colour));
                let mean = mean(&patch(&mut palette, look, colour));
                mixed += squared(mean, lab, HUE_WEIGHT).sqrt();
                alone += squared(nearest(&palette.colours, lab)[0].lab, lab, HUE_WEIGHT).sqrt();
                count += 1.0;
            }
            let (mixed, alone) = (mixed / count, alone / count);
            assert!(mixed < part * alone, "{mixed} of {alone}");
        }
    }

    #[test]
    fn sixteen_colours_keep_contrast_and_hue() {
        let mut palette = Palette::of_16();
        let look = |index| THEME[usize::from(index)];
        let mut last = -1.0;
        for grey in (0..=255).step_by(15) {
            let [lightness, ..] = mean(&patch(&mut palette, look, [grey; 3]));
            assert!(last <= lightness, "{grey}: {lightness} after {last}");
            last = lightness;
        }
        assert!(0.95 < last, "{last}");
        for colour in [
            [50, 90, 125],
            [200, 60, 30],
            [90, 160, 80],
            [80, 60, 130],
            [30, 30, 70],
        ] {
            let (goal, [_, a, b]) = (
                oklab(light(colour)),
                mean(&patch(&mut palette, look, colour)),
            );
            assert!(
                0.0 < goal[1] * a + goal[2] * b,
                "{colour:?} lost its hue: {a} {b}"
            );
        }
    }
}
