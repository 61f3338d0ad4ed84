//! The ways to look at two pictures at once.

use std::borrow::Cow;

use compare::heat_map;
use scene::Size;

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

    /// The differences, the next after the last of them being the first.
    pub(crate) fn next_difference(self) -> Self {
        match self {
            Self::Difference(1) => Self::Difference(4),
            Self::Difference(4) => Self::Difference(16),
            Self::Difference(_) => Self::Heat,
            _ => Self::Difference(1),
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
        let mut view = Contrast::Wipe;
        let mut names = Vec::new();
        for _ in 0..5 {
            view = view.next_difference();
            names.push(view.name());
        }
        assert_eq!(
            names,
            [
                "difference",
                "difference ×4",
                "difference ×16",
                "heat map",
                "difference"
            ]
        );
        assert_eq!(view.flipped(), Contrast::Live);
        assert_eq!(Contrast::Live.flipped(), Contrast::Reference);
    }
}
