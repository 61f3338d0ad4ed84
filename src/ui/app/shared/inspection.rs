//! What INSPECT mode looks at.

use std::collections::BTreeSet;

use crate::keymap::Mode;
use crate::msg::{Question, Target};
use render::Explanation;
use scene::Size;

/// The state of INSPECT mode.
#[derive(Debug, Default)]
pub struct Inspection {
    /// The cross; `None` before the first inspection.
    pub cross: Option<Cross>,
    /// The mode to return to, and the picture that is inspected.
    before: Option<(Mode, Target)>,
    /// The explanation of the pixel under the cross, if it is wanted.
    pub explained: Option<Explained>,
    /// Whether a panel tells where the selected thing is.
    pub(crate) locates: bool,
}

/// The explanation of a pixel.
#[derive(Debug, Default)]
pub struct Explained {
    /// The index of the sample that is explained.
    pub sample: u32,
    /// The question asked last.
    pub(crate) asked: Option<Question>,
    /// The answer received last.
    pub answer: Option<Box<Explanation>>,
    /// What is the case, and what would change it.
    pub verdict: Option<String>,
    /// The line under the cursor.
    pub at: usize,
    /// The first line shown.
    pub top: usize,
    /// The folded rays.
    pub folded: BTreeSet<usize>,
}

/// A pixel of a picture. Pictures of other sizes have it at the same place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cross {
    /// Its column and row.
    pub pixel: [u32; 2],
    /// The size of the picture.
    pub size: Size,
}

impl Inspection {
    /// Remembers the mode that INSPECT replaces, and the picture on screen.
    pub(crate) fn begin(&mut self, before: Mode, seen: Target) {
        self.before = Some((before, seen));
    }

    /// The mode to return to.
    pub(crate) fn before(&self) -> Mode {
        self.before.map_or(Mode::Select, |(mode, _)| mode)
    }

    /// The picture that is inspected.
    pub(crate) fn seen(&self) -> Target {
        self.before.map_or(Target::Preview, |(_, seen)| seen)
    }
}

impl Cross {
    /// The pixel in the middle of a picture of this size.
    pub(crate) fn middle(size: Size) -> Self {
        Self {
            pixel: [size.width / 2, size.height / 2],
            size,
        }
    }

    /// The same place in a picture of another size.
    #[must_use]
    pub fn in_size(self, size: Size) -> Self {
        let [x, y] = self.pixel;
        Self {
            pixel: [
                scaled(x, self.size.width, size.width),
                scaled(y, self.size.height, size.height),
            ],
            size,
        }
    }

    /// Moves it by some pixels, up to the edge of the picture.
    pub(crate) fn step(&mut self, right: i32, down: i32) {
        let moved = |at: u32, by: i32, length: u32| {
            at.saturating_add_signed(by).min(length.saturating_sub(1))
        };
        let [x, y] = &mut self.pixel;
        *x = moved(*x, right, self.size.width);
        *y = moved(*y, down, self.size.height);
    }
}

/// The pixel of `to` that contains the centre of pixel `at` of `from`.
fn scaled(at: u32, from: u32, to: u32) -> u32 {
    if from == to {
        return at;
    }
    let pixel = (2 * u64::from(at) + 1) * u64::from(to) / (2 * u64::from(from.max(1)));
    pixel.min(u64::from(to).saturating_sub(1)) as u32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    #[test]
    fn a_cross_keeps_its_place_in_pictures_of_other_sizes() {
        for (pixel, from, to, expected) in [
            ([2, 1], size(4, 3), size(4, 3), [2, 1]),
            ([2, 1], size(4, 3), size(400, 300), [250, 150]),
            ([399, 0], size(400, 300), size(4, 3), [3, 0]),
            ([0, 0], size(1, 1), size(5, 3), [2, 1]),
        ] {
            let cross = Cross { pixel, size: from };
            assert_eq!(cross.in_size(to).pixel, expected);
        }
    }

    #[test]
    fn a_cross_stays_inside_the_picture() {
        let mut cross = Cross::middle(size(4, 3));
        for (right, down, expected) in [
            (1, -1, [3, 0]),
            (8, -8, [3, 0]),
            (-8, 8, [0, 2]),
            (1, 0, [1, 2]),
        ] {
            cross.step(right, down);
            assert_eq!(cross.pixel, expected);
        }
    }
}
