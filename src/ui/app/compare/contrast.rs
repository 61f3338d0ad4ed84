//! The ways to look at two pictures at once.

use std::borrow::Cow;

use compare::heat_map;
use scene::Size;

/// The factors by which differences are amplified, ascending.
const GAINS: [u8; 4] = [1, 4, 16, 64];
/// Of the pixels that differ, one in so many may be too bright to show when amplified.
const CLIPPED: usize = 100;

/// What of two pictures is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Contrast {
    /// The present picture.
    #[default]
    Live,
    /// What it is compared with.
    Reference,
    /// The present picture to the left of a line, the reference to its right.
    Wipe,
    /// The difference of each channel, times this factor.
    Difference(u8),
    /// The largest difference of each pixel's channels, as a colour.
    Heat,
}

impl Contrast {
    /// Shows the picture alone, or instead of it the reference.
    pub(crate) fn flipped(self) -> Self {
        match self {
            Self::Live => Self::Reference,
            _ => Self::Live,
        }
    }

    /// The differences, the next after the last of them being the first: from another view, the one
    /// amplified by `fitting`.
    pub(crate) fn next_difference(self, fitting: u8) -> Self {
        match self {
            Self::Difference(gain) => {
                let larger = GAINS.into_iter().find(|larger| gain < *larger);
                larger.map_or(Self::Heat, Self::Difference)
            }
            Self::Heat => Self::Difference(1),
            _ => Self::Difference(fitting),
        }
    }

    /// What is shown, in a word or two.
    pub fn name(self) -> Cow<'static, str> {
        Cow::Borrowed(match self {
            Self::Live => "live",
            Self::Reference => "reference",
            Self::Wipe => "wipe",
            Self::Difference(1) => "difference",
            Self::Difference(gain) => return Cow::Owned(format!("difference ×{gain}")),
            Self::Heat => "heat map",
        })
    }

    /// The colour that stands for a difference of so many levels in all channels.
    pub(crate) fn colour_of(self, levels: u8) -> [u8; 3] {
        let size = Size {
            width: 1,
            height: 1,
        };
        let pixels = self.pixels([&[[levels; 3]], &[[0; 3]]], size, 0.0);
        pixels.first().copied().unwrap_or_default()
    }

    /// The pixels to show of a picture and its reference, both of this size; `wipe` is the share of the
    /// width that is left of the line.
    pub(crate) fn pixels(
        self,
        [live, reference]: [&[[u8; 3]]; 2],
        size: Size,
        wipe: f64,
    ) -> Vec<[u8; 3]> {
        match self {
            Self::Live => live.to_vec(),
            Self::Reference => reference.to_vec(),
            Self::Heat => heat_map(live, reference),
            Self::Difference(gain) => {
                let amplified = |a: u8, b: u8| a.abs_diff(b).saturating_mul(gain);
                let pairs = live.iter().zip(reference);
                pairs
                    .map(|(a, b)| std::array::from_fn(|channel| amplified(a[channel], b[channel])))
                    .collect()
            }
            Self::Wipe => {
                let width = size.width as usize;
                let line = (wipe * f64::from(size.width)).round() as usize;
                let line = line.min(width);
                let rows = live.chunks(width).zip(reference.chunks(width));
                rows.flat_map(|(live, reference)| live[..line].iter().chain(&reference[line..]))
                    .copied()
                    .collect()
            }
        }
    }
}

/// The largest factor that leaves the differences of two pictures within what can be shown, but for a few.
pub(super) fn fitting_gain([live, reference]: [&[[u8; 3]]; 2]) -> u8 {
    let mut counts = [0_usize; 256];
    for (a, b) in live.iter().zip(reference) {
        let levels = [0, 1, 2].map(|channel| a[channel].abs_diff(b[channel]));
        counts[usize::from(levels.into_iter().max().unwrap_or(0))] += 1;
    }
    let differing: usize = counts[1..].iter().sum();
    let clips = |gain: u8| {
        let first = usize::from(u8::MAX / gain) + 1;
        counts[first..].iter().sum::<usize>() * CLIPPED > differing
    };
    let mut fitting = GAINS.into_iter().rev().filter(|gain| !clips(*gain));
    fitting.next().filter(|_| 0 < differing).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_view_is_a_function_of_both_pictures() {
        let live = [[10, 20, 30], [40, 50, 60], [0; 3], [255; 3]];
        let reference = [[10, 25, 10], [40, 50, 60], [100; 3], [0; 3]];
        let size = Size {
            width: 2,
            height: 2,
        };
        let both = [&live[..], &reference];
        for (view, wipe, pixels) in [
            (Contrast::Live, 0.5, live),
            (Contrast::Reference, 0.5, reference),
            (
                Contrast::Wipe,
                0.5,
                [live[0], reference[1], live[2], reference[3]],
            ),
            (Contrast::Wipe, 0.0, reference),
            (Contrast::Wipe, 1.0, live),
            (
                Contrast::Difference(1),
                0.5,
                [[0, 5, 20], [0; 3], [100; 3], [255; 3]],
            ),
            (
                Contrast::Difference(4),
                0.5,
                [[0, 20, 80], [0; 3], [255; 3], [255; 3]],
            ),
        ] {
            assert_eq!(view.pixels(both, size, wipe), pixels, "{view:?} {wipe}");
        }
        let heat = Contrast::Heat.pixels(both, size, 0.5);
        assert_eq!([heat[1], heat[2]], [[0; 3], [255; 3]]);
    }

    #[test]
    fn differences_are_amplified_in_turn() {
        for (fitting, expected) in [
            (
                1,
                "difference, difference ×4, difference ×16, difference ×64, heat map, difference",
            ),
            (
                16,
                "difference ×16, difference ×64, heat map, difference, difference ×4, difference ×16",
            ),
        ] {
            let mut view = Contrast::Wipe;
            let names = (0..6).map(|_| {
                view = view.next_difference(fitting);
                view.name().into_owned()
            });
            assert_eq!(names.collect::<Vec<_>>().join(", "), expected);
            assert_eq!(view.flipped(), Contrast::Live);
        }
        assert_eq!(Contrast::Live.flipped(), Contrast::Reference);
    }

    #[test]
    fn the_factor_fills_the_range() {
        for (levels, expected) in [
            (&[0, 0][..], 1),
            (&[0, 1], 64),
            (&[3, 2], 64),
            (&[4, 0], 16),
            (&[20, 3], 4),
            (&[200, 3], 1),
            // One of many does not count.
            (&[[3; 200].as_slice(), &[255]].concat(), 64),
        ] {
            let live: Vec<_> = levels.iter().map(|&level| [0, level, 0]).collect();
            let reference = vec![[0; 3]; live.len()];
            assert_eq!(fitting_gain([&live, &reference]), expected, "{levels:?}");
        }
    }
}
