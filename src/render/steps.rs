//! The order in which a picture's samples are taken.

use std::ops::Range;

use super::frame::Frames;

/// What one walk over all tiles adds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Sample 0 of the pixels on a grid of this spacing that no coarser grid holds.
    Grid(u32),
    /// These samples of every pixel.
    Samples(Range<u32>),
}

/// Spacing of the grid that comes first.
pub(crate) const COARSEST: u32 = 8;

/// Spacings of the grids that sample 0 is taken on, coarse to fine, as in Adam7: each shows the
/// whole picture, and none of its samples is wasted.
const GRIDS: [u32; 4] = [COARSEST, 4, 2, 1];

/// The steps to `spp` samples a pixel: sample 0, then 1, 2, 4, 8 … more. Sample 0 is taken from coarse
/// to fine where frames are looked at before the last; else at once, as rays that start side by side
/// are faster.
pub(crate) fn steps(spp: u32, frames: Frames) -> Vec<Step> {
    let mut steps = match frames {
        Frames::Live => GRIDS.map(Step::Grid).to_vec(),
        Frames::Last | Frames::LastWithValues => vec![Step::Samples(0..1)],
    };
    let mut taken = 1;
    while taken < spp {
        let next = (2 * taken).min(spp);
        steps.push(Step::Samples(taken..next));
        taken = next;
    }
    steps
}

impl Step {
    /// The samples it adds, a pixel.
    pub(crate) fn share(&self) -> f64 {
        match self {
            Self::Grid(COARSEST) => 1.0 / f64::from(COARSEST * COARSEST),
            // A grid holds a quarter of the next finer one's points, itself included.
            Self::Grid(spacing) => 0.75 / f64::from(spacing * spacing),
            Self::Samples(indices) => f64::from(indices.end - indices.start),
        }
    }

    /// The samples that every pixel has after it.
    pub(crate) fn whole_after(&self) -> u32 {
        match self {
            Self::Grid(spacing) => u32::from(*spacing == 1),
            Self::Samples(indices) => indices.end,
        }
    }

    /// The spacing of the pixels that it is for.
    pub(crate) fn spacing(&self) -> u32 {
        match self {
            Self::Grid(spacing) => *spacing,
            Self::Samples(_) => 1,
        }
    }

    /// The samples that it adds to each of them.
    pub(crate) fn indices(&self) -> Range<u32> {
        match self {
            Self::Grid(_) => 0..1,
            Self::Samples(indices) => indices.clone(),
        }
    }

    /// What it brings them to, which tells how many samples they have (see [`samples_at`]): 1 with
    /// sample 0, and 1 more each time their samples double or come to the last one.
    pub(crate) fn level(&self) -> u8 {
        1 + self.indices().end.next_power_of_two().ilog2() as u8
    }
}

/// The samples of a pixel at a level, where `spp` are all; none at level 0.
pub(crate) fn samples_at(level: u8, spp: u32) -> u32 {
    match level {
        0 => 0,
        level => spp.min(1 << (level - 1)),
    }
}
