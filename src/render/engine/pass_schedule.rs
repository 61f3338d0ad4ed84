//! The order in which the samples of a picture are taken.

use std::ops::Range;

use crate::job::Frames;

/// The samples added by one pass over all tiles.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Sample 0 of the pixels on a grid of this spacing, except those on coarser grids.
    Grid(u32),
    /// These samples of every pixel.
    Samples(Range<u32>),
}

/// Spacing of the first grid.
pub(crate) const COARSEST: u32 = 8;

/// Spacings of the grids for sample 0, coarse to fine as in Adam7: each shows the whole picture,
/// and no sample is wasted.
const GRIDS: [u32; 4] = [COARSEST, 4, 2, 1];

/// Returns the steps to `spp` samples per pixel: sample 0, then 1, 2, 4, 8 … more. Sample 0 is
/// taken coarse to fine if intermediate frames are shown, and otherwise at once, because adjacent
/// rays are faster.
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
    /// Samples added by a part of it, as a mean per pixel.
    pub(crate) fn share(&self, part: &Range<u32>) -> f64 {
        match self {
            Self::Grid(COARSEST) => 1.0 / f64::from(COARSEST * COARSEST),
            // A grid has a quarter of the points of the next finer one, which includes it.
            Self::Grid(spacing) => 0.75 / f64::from(spacing * spacing),
            Self::Samples(_) => part.len() as f64,
        }
    }

    /// Samples of every pixel after this step.
    pub(crate) fn whole_after(&self) -> u32 {
        match self {
            Self::Grid(spacing) => u32::from(*spacing == 1),
            Self::Samples(indices) => indices.end,
        }
    }

    /// Spacing of the pixels sampled.
    pub(crate) fn spacing(&self) -> u32 {
        match self {
            Self::Grid(spacing) => *spacing,
            Self::Samples(_) => 1,
        }
    }

    /// Indices of the samples added to each of these pixels.
    pub(crate) fn indices(&self) -> Range<u32> {
        match self {
            Self::Grid(_) => 0..1,
            Self::Samples(indices) => indices.clone(),
        }
    }

    /// The step in parts of at most this many samples of each of these pixels.
    pub(crate) fn parts(&self, most: u32) -> impl Iterator<Item = Range<u32>> {
        let Range { start, end } = self.indices();
        let starts = (start..end).step_by(most as usize);
        starts.map(move |start| start..end.min(start.saturating_add(most)))
    }

    /// The level of these pixels after this step, which encodes their number of samples (see
    /// [`samples_at`]): 1 with sample 0, and 1 more per doubling, the last of which may be partial.
    pub(crate) fn level(&self) -> u8 {
        1 + self.indices().end.next_power_of_two().ilog2() as u8
    }
}

/// The level of pixels with this many samples, if that is a step on the way to `spp`.
pub(crate) fn level_of(samples: u32, spp: u32) -> Option<u8> {
    match samples {
        0 => Some(0),
        _ if samples == spp || samples < spp && samples.is_power_of_two() => {
            Some(Step::Samples(0..samples).level())
        }
        _ => None,
    }
}

/// The number of samples at a level, at most `spp`; 0 at level 0.
pub(crate) fn samples_at(level: u8, spp: u32) -> u32 {
    match level {
        0 => 0,
        level => spp.min(1 << (level - 1)),
    }
}
