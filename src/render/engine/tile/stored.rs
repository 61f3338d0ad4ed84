//! Pixels of tiles as blocks store them.

use super::{BEYOND, Tile};
use crate::integrators::Counts;
use crate::job::NO_OBJECT;
use crate::picture::UNKNOWN;
use crate::world::Dependencies;
use scene::Rgb;

/// What is recorded of a pixel so that edits retrace only some.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PixelHistory {
    /// The objects and lights that its samples touched, as bits that each stand for several.
    pub touched: u64,
    /// The rays traced for its samples; [`u32::MAX`] if that is not known.
    pub rays: u32,
}

impl PixelHistory {
    /// The history of a pixel of which nothing is recorded: it depends on everything.
    pub(crate) const UNKNOWN: Self = Self {
        touched: u64::MAX,
        rays: u32::MAX,
    };
}

/// What a tile knows of a pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stored {
    pub(crate) sum: Rgb,
    pub(crate) object: u32,
    pub(crate) level: u8,
    /// The mean of its tile where single ones are not recorded.
    pub(crate) squared_error: f32,
    /// [`UNKNOWN`] where it is not recorded.
    pub(crate) variance: f32,
    pub(crate) history: Option<PixelHistory>,
}

impl Stored {
    /// A pixel of which nothing is traced.
    pub(crate) const NOTHING: Self = Self {
        sum: Rgb::ZERO,
        object: NO_OBJECT,
        level: 0,
        squared_error: 0.0,
        variance: UNKNOWN,
        history: None,
    };
}

impl Tile {
    /// What is known of a pixel, by its index.
    pub(crate) fn stored(&self, at: usize) -> Stored {
        let memory = self.memory.as_ref();
        let mean = || {
            let pixels = self.levels.iter().filter(|&&level| level != BEYOND);
            (self.squared_errors / pixels.count() as f64) as f32
        };
        Stored {
            sum: self.sums[at],
            object: self.objects[at],
            level: self.levels[at],
            squared_error: memory.map_or_else(mean, |memory| memory.squared_errors[at]),
            variance: self.variance(at),
            history: memory.map(|memory| PixelHistory {
                touched: memory.touched[at].bits(),
                rays: memory.rays[at],
            }),
        }
    }

    /// Takes over a pixel, by its index, into an empty tile. [`Tile::settle`] comes after all pixels.
    pub(crate) fn store(&mut self, at: usize, pixel: &Stored) {
        self.sums[at] = pixel.sum;
        self.objects[at] = pixel.object;
        self.levels[at] = pixel.level;
        if let Some(memory) = &mut self.memory {
            let PixelHistory { touched, rays } = pixel.history.unwrap_or(PixelHistory::UNKNOWN);
            memory.squared_errors[at] = pixel.squared_error;
            memory.variances[at] = pixel.variance;
            memory.touched[at] = Dependencies::of_bits(touched);
            memory.rays[at] = rays;
        } else {
            self.squared_errors += f64::from(pixel.squared_error);
        }
    }

    /// Ends taking over pixels, of which those that have not stopped have at least this level. The grid
    /// is not stored: a tile that lacks a sample of a pixel takes the grids again.
    pub(crate) fn settle(&mut self, level: u8) {
        let is_begun = !self.levels.contains(&0);
        self.level = if is_begun { level } else { 0 };
        if let Some(memory) = &self.memory {
            let errors = memory.squared_errors.iter();
            self.squared_errors = errors.copied().map(f64::from).sum();
        }
    }

    /// The top left pixel.
    pub(crate) fn corner(&self) -> [u32; 2] {
        self.corner
    }

    /// Whether the rays traced for each of its pixels are known.
    pub(crate) fn tells_rays(&self) -> bool {
        let memory = self.memory.as_ref();
        memory.is_some_and(|memory| !memory.rays.contains(&PixelHistory::UNKNOWN.rays))
    }

    /// Adds rays traced for it.
    pub(crate) fn add_rays(&mut self, traced: Counts) {
        self.counts.rays += traced.rays;
        self.counts.shadow_rays += traced.shadow_rays;
    }

    /// Counts its rays from 0 again.
    pub(crate) fn forget_rays(&mut self) {
        self.counts = Counts {
            over_budget: self.counts.over_budget,
            ..Counts::default()
        };
    }
}

#[cfg(test)]
impl Tile {
    /// Whether it has sums of pixels whose tracing was cancelled.
    pub(crate) fn has_leftovers(&self) -> bool {
        let mut pixels = self.levels.iter().zip(&self.sums);
        pixels.any(|(&level, &sum)| level == 0 && sum != Rgb::ZERO)
    }
}
