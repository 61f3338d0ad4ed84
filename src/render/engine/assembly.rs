//! A picture put together of blocks.

use std::collections::TryReserveError;

use rayon::prelude::*;

use super::adaptive::square;
use super::block::Block;
use super::blocks::Blocks;
use super::preflight::Refusal;
use crate::integrators::Counts;
use crate::job::{Aov, Frames, Settings};
use crate::picture::{DisplayTransform, Frame, Overexposure, Progress, Tone, tone};
use scene::Rgb;

/// A picture whose blocks arrive in any order; a later one replaces an earlier one of its number.
///
/// It needs the memory of one picture, and gives the same frame as a renderer that traces all of it.
#[derive(Debug)]
pub struct Assembly {
    settings: Settings,
    frames: Frames,
    /// The values of all pixels, in rows.
    values: Vec<Rgb>,
    /// What is known of each block.
    placed: Vec<Placed>,
}

/// A block whose pixels are placed.
#[derive(Clone, Copy, Debug, Default)]
struct Placed {
    counts: Counts,
    /// Samples of all its pixels, and of the one with most.
    taken: u64,
    highest: u32,
    squared_errors: f64,
}

impl Assembly {
    /// Begins a picture with these settings, whose number of samples does not matter; its frame has
    /// what `frames` says of the last frame.
    pub fn new(settings: Settings, frames: Frames) -> Result<Self, Refusal> {
        let size = settings.traced().size();
        let blocks = Blocks::of(size);
        let room = || -> Result<_, TryReserveError> {
            let (mut values, mut placed) = (Vec::new(), Vec::new());
            values.try_reserve_exact(size.pixels())?;
            placed.try_reserve_exact(blocks.count() as usize)?;
            Ok((values, placed))
        };
        let bytes = (size.pixels() * size_of::<Rgb>()) as u64;
        let (mut values, mut placed) = room().map_err(|_| Refusal::Memory { size, bytes })?;
        values.resize(size.pixels(), Rgb::ZERO);
        placed.resize(blocks.count() as usize, Placed::default());
        Ok(Self {
            settings,
            frames,
            values,
            placed,
        })
    }

    /// Places the pixels of a block, which must be one of this picture.
    pub fn place(&mut self, block: &Block) {
        let size = self.settings.traced().size();
        let region = Blocks::of(size).region(block.number);
        for (row, y) in (region.y..region.y + region.height).enumerate() {
            let from = y as usize * size.width as usize + region.x as usize;
            let pixels = self.values[from..][..region.width as usize].iter_mut();
            let places = (row * region.width as usize..).zip(region.x..);
            for ((at, x), value) in places.zip(pixels) {
                *value = block.value(at, square([x, y]), self.settings.aov);
            }
        }
        let squared_errors = block.squared_errors.iter().copied().map(f64::from);
        self.placed[block.number as usize] = Placed {
            counts: block.counts,
            taken: block.taken(region).map(u64::from).sum(),
            highest: block.taken(region).max().unwrap_or(0),
            squared_errors: squared_errors.sum(),
        };
    }

    /// The complete frame, with `spp` samples of each pixel, or fewer if all pixels stopped before.
    pub fn finish(self, spp: u32) -> Frame {
        let Self {
            mut settings,
            frames,
            values,
            placed,
        } = self;
        settings.spp = spp;
        let passes = settings.passes();
        let highest = placed.iter().map(|block| block.highest).max();
        settings.spp = spp.min(highest.unwrap_or(spp));
        let range = tone::scale(settings.aov, values.par_iter().copied());
        let tone = Tone::of(settings.aov, DisplayTransform::of(&settings), range);
        let overexposure = Overexposure::of_all(&values, |&value| tone.linear(value));
        let pixels = values.par_iter().map(|&value| tone.bytes(value)).collect();
        let values = match frames {
            Frames::Last => Vec::new(),
            Frames::Live | Frames::LastWithValues => {
                let linear = |&value| tone.linear(value).as_vec3().to_array();
                values.par_iter().map(linear).collect()
            }
        };
        let traced = settings.traced();
        let counts = placed.iter().map(|block| block.counts);
        let Counts {
            rays,
            shadow_rays,
            over_budget,
        } = counts.fold(Counts::default(), Counts::and);
        let taken: u64 = placed.iter().map(|block| block.taken).sum();
        let squared_errors: f64 = placed.iter().map(|block| block.squared_errors).sum();
        let noise = (squared_errors / traced.size().pixels() as f64).sqrt();
        // Blocks of the cost hold no light.
        let is_of_light = settings.surface().is_none() && settings.aov != Some(Aov::Cost);
        let is_estimated = 1 < settings.spp && is_of_light;
        let drawn = Frame::drawn(traced.size(), pixels);
        Frame {
            corner: traced.corner(),
            values,
            range,
            overexposure,
            progress: Progress {
                pass: passes,
                passes,
                spp: settings.spp,
                mean_spp: taken as f64 / traced.size().pixels() as f64,
                rays,
                shadow_rays,
                over_budget,
                noise: is_estimated.then_some(noise),
                ..drawn.progress
            },
            ..drawn
        }
    }
}
