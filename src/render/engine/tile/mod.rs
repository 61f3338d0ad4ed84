//! A part of a film: the accumulated samples of its pixels.

mod partial_pass;
mod shape;
mod stored;

use std::ops::Range;

use super::adaptive::Selection;
use super::noise::Doubling;
use super::pass_schedule::{COARSEST, Step, samples_at};
use super::pixel_sampler::PixelSampler;
use crate::integrators::{Counts, FrameContext};
use crate::job::{Aov, Frames, Job, NO_OBJECT};
use crate::picture::UNKNOWN;
use crate::world::Dependencies;
use partial_pass::PartialPass;
use scene::{Rgb, Size};
pub(crate) use shape::TileShape;
pub use stored::PixelHistory;
pub(crate) use stored::Stored;

/// Pixels per tile.
pub(crate) const AREA: u32 = 256;

/// Most pixels of a picture whose dependencies are recorded; for larger pictures that would cost
/// more memory than the time saved is worth.
const MOST_REMEMBERED: usize = 1 << 22;

/// A spacing coarser than any grid.
const NO_GRID: u32 = 2 * COARSEST;

/// The level of pixels beyond the picture's edge, which no step applies to.
const BEYOND: u8 = u8::MAX;

/// A part of a picture.
#[derive(Debug)]
pub(crate) struct Tile {
    /// Top left pixel.
    corner: [u32; 2],
    shape: TileShape,
    /// Sums of radiance, in rows; pixels beyond the picture's edge stay 0.
    sums: [Rgb; AREA as usize],
    /// Index of the object under each pixel's centre.
    objects: [u32; AREA as usize],
    /// [`Step::level`] of each pixel; 0 before its first sample or after cancellation.
    levels: [u8; AREA as usize],
    /// Spacing of the finest complete grid, until every pixel is traced.
    grid: u32,
    /// The level that all pixels have after the steps taken, except those that stopped.
    level: u8,
    /// The sum of its pixels' squared errors after the last pass that estimated them.
    pub(crate) squared_errors: f64,
    /// The rays traced for it, and the samples that exceeded their ray budget.
    pub(crate) counts: Counts,
    /// Data for tracing a subset of the pixels again.
    memory: Option<Box<Memory>>,
    /// What it was before a step of which parts are taken.
    partial_pass: Option<Box<PartialPass>>,
}

/// Data of each pixel that is not displayed.
#[derive(Debug)]
struct Memory {
    /// Dependencies of all its samples.
    touched: [Dependencies; AREA as usize],
    /// Squared error after the last pass that estimated it.
    squared_errors: [f32; AREA as usize],
    /// The variance of its mean after the last pass that estimated it, negative before.
    variances: [f32; AREA as usize],
    /// Rays traced for all its samples.
    rays: [u32; AREA as usize],
}

/// What a tile stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Remembers {
    /// Pixels only.
    Pixels,
    /// Pixels and their dependencies.
    Histories,
}

impl Remembers {
    /// What the tiles of a picture store. Live pictures are continued whether or not they are denoised.
    pub(crate) fn of(job: &Job) -> Self {
        let (settings, frames) = (&job.settings, job.frames);
        let shown = matches!(settings.aov, Some(Aov::Cost | Aov::Noise));
        let decides = settings.adaptive().is_some();
        let guides = job.denoise && frames != Frames::Live;
        let is_small = settings.traced().size().pixels() <= MOST_REMEMBERED;
        if shown || guides || decides || frames == Frames::Live && is_small {
            Self::Histories
        } else {
            Self::Pixels
        }
    }

    /// Whether all that `other` needs is stored.
    pub(crate) fn suffices(self, other: Self) -> bool {
        self == Self::Histories || other == Self::Pixels
    }
}

impl Tile {
    /// Bytes of one tile.
    pub(crate) fn bytes(remembers: Remembers) -> usize {
        let memory = match remembers {
            Remembers::Pixels => 0,
            Remembers::Histories => size_of::<Memory>(),
        };
        size_of::<Self>() + memory
    }

    /// Creates an empty tile, given its number in the film.
    pub(crate) fn new(number: usize, size: Size, shape: TileShape, remembers: Remembers) -> Self {
        let memory = || {
            Box::new(Memory {
                touched: [Dependencies::default(); AREA as usize],
                squared_errors: [0.0; AREA as usize],
                variances: [UNKNOWN; AREA as usize],
                rays: [0; AREA as usize],
            })
        };
        let mut tile = Self {
            corner: shape.corner(number, size),
            shape,
            sums: [Rgb::ZERO; AREA as usize],
            objects: [NO_OBJECT; AREA as usize],
            levels: [BEYOND; AREA as usize],
            grid: NO_GRID,
            level: 0,
            squared_errors: 0.0,
            counts: Counts::default(),
            memory: (remembers == Remembers::Histories).then(memory),
            partial_pass: None,
        };
        let [left, top] = tile.corner;
        let across = (size.width - left).min(shape.width) as usize;
        let down = (size.height - top).min(shape.height) as usize;
        for row in tile.levels.chunks_mut(shape.width as usize).take(down) {
            row[..across].fill(0);
        }
        tile
    }

    /// Whether a step has yet to be taken.
    pub(crate) fn lacks(&self, step: &Step) -> bool {
        match step {
            &Step::Grid(spacing) => self.level == 0 && spacing < self.grid,
            Step::Samples(_) => self.level < step.level(),
        }
    }

    /// Takes a step, or one of its parts after the other, in those pixels that lack it, if they are
    /// selected.
    pub(crate) fn advance(
        &mut self,
        size: Size,
        (step, part, selection): (&Step, Range<u32>, Option<&Selection>),
        context: &FrameContext<'_>,
        sampler: &mut PixelSampler<'_>,
    ) {
        if sampler.tracer.is_cancelled() {
            return;
        }
        let counts = sampler.tracer.counts();
        let level = step.level();
        let is_last = part.end == step.indices().end;
        sampler.pixels.clear();
        if let Some(partial_pass) = &self.partial_pass {
            sampler.pixels.extend_from_slice(&partial_pass.pixels);
        } else {
            let partial_pass = (!is_last).then(|| self.start_partial_pass());
            self.each_pixel(size, step.spacing(), |tile, pixel| {
                let at = tile.index(pixel);
                let is_selected = selection.is_none_or(|selection| selection.has(pixel));
                if tile.levels[at] < level && is_selected {
                    tile.levels[at] = 0;
                    sampler.pixels.push(pixel);
                }
            });
            self.partial_pass = partial_pass;
            if let Some(partial_pass) = &mut self.partial_pass {
                partial_pass.pixels.clone_from(&sampler.pixels);
            }
        }
        let doubling = Doubling::of(step, &context.settings).filter(|_| is_last);
        let doubling = doubling.map(|doubling| {
            let partial_pass = self.partial_pass.as_ref();
            (
                doubling,
                partial_pass.map_or(self.sums, |partial_pass| partial_pass.sums),
            )
        });
        for index in part {
            self.sample(index, context, sampler);
            if sampler.tracer.is_cancelled() {
                return;
            }
        }
        self.counts.over_budget += sampler.tracer.counts().since(counts).over_budget;
        if !is_last {
            return;
        }
        self.partial_pass = None;
        for &pixel in &sampler.pixels {
            self.levels[self.index(pixel)] = level;
        }
        if let Some((doubling, before)) = doubling {
            self.estimate(doubling, &before, &sampler.pixels);
        }
        match *step {
            Step::Grid(spacing) if 1 < spacing => self.grid = spacing,
            Step::Grid(_) | Step::Samples(_) => self.level = level,
        }
    }

    /// Adds one sample to each of the given pixels.
    fn sample(&mut self, index: u32, context: &FrameContext<'_>, sampler: &mut PixelSampler<'_>) {
        sampler.sample(index, context);
        for (&pixel, seen) in sampler.pixels.iter().zip(&sampler.seen) {
            let at = self.index(pixel);
            self.sums[at] += seen.radiance;
            if index == 0 {
                self.objects[at] = seen.object;
            }
            if let Some(memory) = &mut self.memory {
                memory.touched[at] |= seen.touched;
                memory.rays[at] = memory.rays[at].saturating_add(seen.rays);
            }
        }
    }

    /// Estimates the errors of pixels whose samples were doubled.
    fn estimate(&mut self, doubling: Doubling, before: &[Rgb; AREA as usize], pixels: &[[u32; 2]]) {
        let mut own = [0.0; AREA as usize];
        let (errors, mut variances) = match &mut self.memory {
            Some(memory) => (&mut memory.squared_errors, Some(&mut memory.variances)),
            None => (&mut own, None),
        };
        for &pixel in pixels {
            let at = self.shape.index(self.corner, pixel);
            if let Some(variances) = &mut variances {
                variances[at] = doubling.variance(before[at], self.sums[at]) as f32;
            }
            errors[at] = doubling.squared_error(before[at], self.sums[at]) as f32;
        }
        self.squared_errors = errors.iter().copied().map(f64::from).sum();
    }

    /// Resets the pixels that depend on a change, those whose tracing was cancelled, and those with
    /// a number of samples that is no step on the way to the new one, given the maximum before and
    /// now. Returns whether there are any.
    pub(crate) fn forget(&mut self, changed: Dependencies, [before, now]: [u32; 2]) -> bool {
        let memory = self.memory.as_deref();
        let stale: [bool; AREA as usize] = std::array::from_fn(|at| {
            let level = self.levels[at];
            let depends = |memory: &Memory| memory.touched[at].meets(changed);
            let is_step = level == BEYOND || samples_at(level, before) == samples_at(level, now);
            level == 0
                || !is_step
                || (changed != Dependencies::NOTHING && memory.is_none_or(depends))
        });
        if !stale.contains(&true) {
            return false;
        }
        // The pixels that exceeded their budget are not known individually.
        let is_whole = 0 < self.counts.over_budget;
        self.counts.over_budget = 0;
        for (at, is_stale) in stale.into_iter().enumerate() {
            if is_whole || is_stale {
                self.forget_pixel(at);
            }
        }
        self.grid = NO_GRID;
        self.level = 0;
        true
    }

    /// The level of a pixel, see [`Step::level`].
    pub(crate) fn pixel_level(&self, at: usize) -> u8 {
        self.levels[at]
    }

    /// The level after the steps taken.
    pub(crate) fn level(&self) -> u8 {
        self.level
    }

    /// The squared error of a pixel after the last step that estimated it; 0 where it is not recorded.
    pub(crate) fn squared_error(&self, at: usize) -> f32 {
        let memory = self.memory.as_ref();
        memory.map_or(0.0, |memory| memory.squared_errors[at])
    }

    /// The sum of the numbers of its pixels' samples, of at most `spp` each.
    pub(crate) fn samples(&self, spp: u32) -> u64 {
        let levels = self.levels.into_iter().filter(|&level| level != BEYOND);
        levels.map(|level| u64::from(samples_at(level, spp))).sum()
    }

    /// The highest level of its pixels.
    pub(crate) fn reached(&self) -> u8 {
        let traced = self.levels.into_iter().filter(|&level| level != BEYOND);
        traced.max().unwrap_or(0)
    }

    fn forget_pixel(&mut self, at: usize) {
        self.sums[at] = Rgb::ZERO;
        // Pixels beyond the picture's edge are never traced.
        if self.levels[at] != BEYOND {
            self.levels[at] = 0;
        }
        if let Some(memory) = &mut self.memory {
            memory.touched[at] = Dependencies::default();
            memory.variances[at] = UNKNOWN;
            memory.rays[at] = 0;
        }
    }

    /// The mean of a pixel's samples, or what an AOV of light shows of them.
    pub(crate) fn value(&self, at: usize, spp: u32, aov: Option<Aov>) -> Rgb {
        let (sum, level, rays) = self.shown(at);
        let samples = f64::from(samples_at(level, spp));
        match aov {
            Some(Aov::Cost) => Rgb::splat(f64::from(rays) / samples.max(1.0)),
            Some(Aov::Samples) => Rgb::splat(samples),
            Some(Aov::Noise) => Rgb::splat(self.error(at).into()),
            // Most pixels have one sample; without any, the sum is 0.
            _ if samples <= 1.0 => sum,
            _ => sum / samples,
        }
    }

    /// The estimated error of a pixel, 0 to 1; 0 where it is not recorded.
    pub(crate) fn error(&self, at: usize) -> f32 {
        self.squared_error(at).sqrt()
    }

    /// The variance of a pixel's mean, as the mean of its channels; negative if it is not known.
    pub(crate) fn variance(&self, at: usize) -> f32 {
        let memory = self.memory.as_ref();
        memory.map_or(UNKNOWN, |memory| memory.variances[at])
    }

    /// The values of the pixels traced so far.
    pub(crate) fn values(&self, spp: u32, aov: Option<Aov>) -> impl Iterator<Item = Rgb> {
        let traced = |&at: &usize| ![0, BEYOND].contains(&self.shown(at).1);
        (0..AREA as usize)
            .filter(traced)
            .map(move |at| self.value(at, spp, aov))
    }

    pub(crate) fn object(&self, at: usize) -> u32 {
        self.objects[at]
    }

    /// Visits the pixels of a grid that lie within the picture, in blocks of 4×2, so that adjacent
    /// pixels are traced together.
    fn each_pixel(&mut self, size: Size, spacing: u32, mut visit: impl FnMut(&mut Self, [u32; 2])) {
        let [left, top] = self.corner;
        let right = left + (size.width - left).min(self.shape.width);
        let bottom = top + (size.height - top).min(self.shape.height);
        let step = spacing as usize;
        for y0 in (top..bottom).step_by(2 * step) {
            for x0 in (left..right).step_by(4 * step) {
                for y in (y0..bottom.min(y0 + 2 * spacing)).step_by(step) {
                    for x in (x0..right.min(x0 + 4 * spacing)).step_by(step) {
                        visit(self, [x, y]);
                    }
                }
            }
        }
    }

    /// Index of the pixel that represents (x, y): itself if traced, otherwise the nearest grid
    /// point up and to the left.
    pub(crate) fn known(&self, [x, y]: [u32; 2]) -> usize {
        let at = self.index([x, y]);
        if self.shown(at).1 == 0 {
            self.index([x - x % self.grid, y - y % self.grid])
        } else {
            at
        }
    }

    /// The index of a pixel.
    pub(crate) fn index(&self, pixel: [u32; 2]) -> usize {
        self.shape.index(self.corner, pixel)
    }
}
