//! Palettes of terminals with few colours, and the approximation of other colours by mixing them.
//!
//! A colour becomes a mix: a pattern of a few palette colours whose total light is close to its
//! own. The first sixteen of 256 colours are never used, because they depend on the theme.

use ratatui::style::Color;

use super::dither;
use super::oklab::{light, luma, oklab};
use crate::terminal::{THEME, colour_on_screen};

/// Number of pixels in a mix.
const PARTS: usize = 8;

/// Number of nearest colours tried for a mix. More give mixes that are right on average but visibly
/// noisy.
const CANDIDATES: usize = 12;

/// Weight of an error in hue relative to lightness. The two chromatic axes of `OkLab` are about
/// half as long as perceived.
const HUE_WEIGHT: f32 = 2.0;

/// Maximum mean difference in luma between neighbours in an area of one colour, in 256 colours. At
/// 12, skies and walls show the pattern; at 4, means of 2×2 pixels are off by a tenth more.
const FLAT: f32 = 7.5;

/// Width of a box of colours that share a mix. The levels of the 6×6×6 cube of the 256 colours are
/// multiples of it, so that they are mapped to themselves.
const STEP: usize = 5;

/// Number of boxes along a channel.
const STEPS: usize = 255 / STEP + 1;

/// How the colours of a palette are mixed. `benches/colours.rs` measures the result.
#[derive(Clone, Copy, Debug)]
struct Taste {
    /// Weight of the noise of a mix relative to the error of its mean. Greater values give flatter
    /// areas and coarser steps between them.
    noise: f32,
    /// Maximum mean difference in luma between neighbours in an area of one colour.
    step: f32,
    /// Maximum distance of a colour of a mix from the nearest one, relative to the lightness:
    /// colours that are close when bright are conspicuous when dark, such as teal among greys.
    reach: f32,
}

/// A palette and mixes of its colours, computed on demand.
#[derive(Debug)]
pub(super) struct Palette {
    colours: Vec<Fixed>,
    taste: Taste,
    /// One for each box of colours, then one for each grey: those of the ramp are not multiples of
    /// [`STEP`].
    mixes: Vec<Option<Mix>>,
}

/// A colour of the palette.
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
    /// The 240 fixed colours of the 256.
    pub(super) fn of_256() -> Self {
        let taste = Taste {
            noise: 0.6,
            step: FLAT,
            reach: 0.3,
        };
        let fixed = |index| Some((index, colour_on_screen(Color::Indexed(index))?));
        Self::new((16..=255).filter_map(fixed), taste)
    }

    /// The sixteen colours of the terminal's theme.
    pub(super) fn of_16() -> Self {
        // No palette colour is close to anything: contrast and hue are worth the noise.
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

    /// The index of the palette colour for a pixel of this colour and position.
    pub(super) fn at(&mut self, colour: [u8; 3], x: u32, y: u32) -> u8 {
        let (slot, of_box) = slot(colour);
        let mix = match self.mixes[slot] {
            Some(mix) => mix,
            None => *self.mixes[slot].insert(mix(&self.colours, self.taste, of_box)),
        };
        mix[dither::threshold(x, y) as usize * PARTS / dither::STEPS as usize]
    }
}

/// The slot of a colour's mix, and the colour that the mix is made for.
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

/// Returns a mix that is close to a colour, both in total light and in each part. Each part in turn
/// minimizes the error of the parts so far. Greys are mixed only from greys.
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
    // In Bayer's pattern, each pixel of the brighter half of a mix is surrounded by the darker
    // half, so that the mean step is twice the mean deviation from the median, which is at most
    // that from any other part.
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

/// The colours nearest to a colour, the nearest first.
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

/// The squared distance of two colours in `OkLab`.
fn squared(one: [f32; 3], other: [f32; 3], hue_weight: f32) -> f32 {
    let [lightness, a, b] = std::array::from_fn(|axis| (one[axis] - other[axis]).powi(2));
    lightness + hue_weight * (a + b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The levels of each channel in the 6×6×6 cube of the 256 colours.
    const CUBE: [u8; 6] = [0, 95, 135, 175, 215, 255];

    /// Red, green and blue of one of the 240 fixed colours.
    fn fixed_colour(index: u8) -> [u8; 3] {
        let at = index - 16;
        match index {
            // The ramp has 24 steps of ten from 8 to 238.
            232.. => [8 + 10 * (index - 232); 3],
            _ => [at / 36, at / 6 % 6, at % 6].map(|level| CUBE[usize::from(level)]),
        }
    }

    const PLACES: std::ops::Range<u32> = 0..64;

    /// Maps an index to its colour.
    type Look = fn(u8) -> [u8; 3];

    fn palettes() -> [(Palette, Look); 2] {
        [
            (Palette::of_256(), fixed_colour),
            (Palette::of_16(), |index| THEME[usize::from(index)]),
        ]
    }

    /// The colours of an 8×8 patch of one colour.
    fn patch(palette: &mut Palette, look: Look, colour: [u8; 3]) -> Vec<[u8; 3]> {
        PLACES
            .map(|at| look(palette.at(colour, at % 8, at / 8)))
            .collect()
    }

    /// A few thousand colours, none on a level of the cube.
    fn colours() -> impl Iterator<Item = [u8; 3]> {
        let level = |at: u32| (at * 17 + 3).min(255) as u8;
        (0..16 * 16 * 16).map(move |at| [level(at / 256), level(at / 16 % 16), level(at % 16)])
    }

    /// The mean colour of a patch, in `OkLab`.
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
            let patch = patch(&mut palette, fixed_colour, colour);
            assert!(patch.iter().all(|&shown| shown == colour), "{index}");
        }
    }

    #[test]
    fn greys_are_mixed_from_greys() {
        // The widest gap among the 256 is from the end of the ramp to white.
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
    fn flat_areas_stay_flat() {
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
    fn dark_greys_contain_no_saturated_dots() {
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
    fn a_patch_is_closer_than_the_nearest_palette_colour() {
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
            let [_, a, b] = oklab(light(colour));
            let [_, mixed_a, mixed_b] = mean(&patch(&mut palette, look, colour));
            assert!(0.0 < a * mixed_a + b * mixed_b, "{colour:?} lost its hue");
        }
    }
}
