//! Square parts of a picture that are traced apart from each other, stored and put together again.

use std::time::{Duration, Instant};

use super::adaptive::{SQUARES, Squares, square, unconverged};
use super::blocks::Blocks;
use super::noise::Doubling;
use super::pass_schedule::Step;
use super::pixel_sampler::PixelSampler;
use super::tile::PixelHistory;
use crate::integrators::{Counts, FrameContext};
use crate::job::{Aov, NO_OBJECT, Region, Settings};
use crate::picture::UNKNOWN;
use scene::{LEAST_ADAPTIVE_SPP, Rgb};

/// Pixels traced together: most of a block's share of the cache.
const TOGETHER: usize = 256;

/// The pixels of a block as far as they are traced. Its samples are those of the whole picture, and
/// sums are added in the order of the samples, so that it may be continued anywhere at any time.
#[derive(Clone, Debug, PartialEq)]
pub struct Block {
    /// Its number in the picture.
    pub number: u32,
    /// Samples of each pixel, except in the squares that are apart.
    pub samples: u32,
    /// The samples of the pixels of each square of 4×4 that has others, in rows of 8 squares: fewer
    /// where they stopped, see [`Settings::noise`], more where they are ahead; 0 for all other squares,
    /// and empty if there are none.
    pub apart: Vec<u32>,
    /// The sums of each pixel's radiance or AOV, in rows.
    pub sums: Vec<Rgb>,
    /// The sums after the last power of two of samples, which the next doubling is compared with;
    /// empty if that is now, before the first sample, and where they are not recorded.
    pub half: Vec<Rgb>,
    /// The square of each pixel's estimated error, see [`Progress::noise`](crate::Progress::noise);
    /// 0 before samples were first doubled, and for AOVs of surfaces.
    pub squared_errors: Vec<f32>,
    /// The variance of each pixel's mean; negative where there is no estimate, and where the errors are
    /// known only as a mean over several pixels.
    pub variances: Vec<f32>,
    /// The index of the object under each pixel's centre, or [`NO_OBJECT`].
    pub objects: Vec<u32>,
    /// What each pixel depends on, see [`PixelHistory`]; empty where it is not recorded.
    pub histories: Vec<PixelHistory>,
    /// The rays traced for it.
    pub counts: Counts,
}

impl Block {
    /// A block of which nothing is traced.
    pub fn new(number: u32, blocks: Blocks) -> Self {
        let area = blocks.area(number);
        Self {
            number,
            samples: 0,
            apart: Vec::new(),
            sums: vec![Rgb::ZERO; area],
            half: Vec::new(),
            squared_errors: vec![0.0; area],
            variances: vec![UNKNOWN; area],
            objects: vec![NO_OBJECT; area],
            histories: Vec::new(),
            counts: Counts::default(),
        }
    }

    /// The block if it can be continued to `spp` samples of each pixel, otherwise an empty one with its
    /// counts: what the next doubling is compared with may not be recorded.
    #[must_use]
    pub fn continued_to(self, spp: u32, blocks: Blocks) -> Self {
        let is_between = |samples: u32| 0 < samples && samples < spp && !samples.is_power_of_two();
        let lacks_half = is_between(self.samples) && self.half.is_empty();
        let is_ahead = |&&samples: &&u32| self.samples < samples;
        let mut ahead = self.apart.iter().filter(is_ahead);
        if lacks_half || ahead.any(|&samples| is_between(samples)) {
            let counts = self.counts;
            return Self {
                counts,
                ..Self::new(self.number, blocks)
            };
        }
        self
    }

    /// Continues to `spp` samples of each pixel. Once the tracer is cancelled, ends after the last
    /// sample that all pixels have. Calls `keep` whenever this much time has passed since its last
    /// call.
    pub(crate) fn trace(
        &mut self,
        spp: u32,
        context: &FrameContext<'_>,
        sampler: &mut PixelSampler<'_>,
        (interval, keep): (Duration, impl Fn(&Self)),
    ) {
        let region = Blocks::of(context.settings.traced().size()).region(self.number);
        let all = in_squares(region);
        let at = |[x, y]: [u32; 2]| ((y - region.y) * region.width + (x - region.x)) as usize;
        let mut taking = self.taking();
        let mut pixels = all.clone();
        pixels.retain(|&pixel| taking.has(square(pixel)));
        let mut seen = Vec::with_capacity(pixels.len());
        let mut kept = Instant::now();
        if self.samples < spp {
            // They are not recorded here.
            self.histories.clear();
        }
        for index in self.samples..spp {
            if self.rejoin(index) {
                taking = self.taking();
                pixels.clone_from(&all);
                pixels.retain(|&pixel| taking.has(square(pixel)));
            }
            if let Some(limit) = context.settings.adaptive()
                && LEAST_ADAPTIVE_SPP <= index
                && index.is_power_of_two()
            {
                let errors = region
                    .pixels()
                    .map(|pixel| (square(pixel), self.squared_errors[at(pixel)]));
                let going_on = unconverged(limit, taking, errors);
                self.stop(taking, going_on);
                taking = going_on;
                pixels.retain(|&pixel| taking.has(square(pixel)));
            }
            let before = sampler.tracer.counts();
            seen.clear();
            for together in pixels.chunks(TOGETHER) {
                sampler.pixels.clear();
                sampler.pixels.extend_from_slice(together);
                sampler.sample(index, context);
                seen.extend_from_slice(&sampler.seen);
            }
            if sampler.tracer.is_cancelled() {
                return;
            }
            if index.is_power_of_two() && self.half.is_empty() {
                self.half.clone_from(&self.sums);
            }
            for (&pixel, seen) in pixels.iter().zip(&seen) {
                self.sums[at(pixel)] += match context.settings.aov {
                    Some(Aov::Cost) => Rgb::splat(seen.rays.into()),
                    _ => seen.radiance,
                };
                if index == 0 {
                    self.objects[at(pixel)] = seen.object;
                }
            }
            self.samples = index + 1;
            let rays = sampler.tracer.counts().since(before);
            self.counts = self.counts.and(rays);
            if self.samples.is_power_of_two() {
                self.estimate(&context.settings, pixels.iter().map(|&pixel| at(pixel)));
            }
            if interval <= kept.elapsed() && self.samples < spp {
                keep(self);
                kept = Instant::now();
            }
        }
    }

    /// The squares that take the next sample.
    fn taking(&self) -> Squares {
        Squares::of(|square| self.apart.get(square).is_none_or(|&samples| samples == 0))
    }

    /// Lets squares take part again that were ahead up to now; whether there are any. Those that stop at
    /// these samples are decided on again, with the same outcome.
    fn rejoin(&mut self, samples: u32) -> bool {
        let mut is_any = false;
        for apart in self.apart.iter_mut().filter(|apart| **apart == samples) {
            is_any |= samples != 0;
            *apart = 0;
        }
        if self.apart.iter().all(|&apart| apart == 0) {
            self.apart.clear();
        }
        is_any
    }

    /// Notes how many samples the squares have that do not go on.
    fn stop(&mut self, taking: Squares, going_on: Squares) {
        let stops = |&square: &usize| taking.has(square) && !going_on.has(square);
        for square in (0..SQUARES).filter(stops) {
            self.apart.resize(SQUARES, 0);
            self.apart[square] = self.samples;
        }
    }

    /// Estimates the errors of pixels after their samples were doubled.
    fn estimate(&mut self, settings: &Settings, pixels: impl Iterator<Item = usize>) {
        let step = Step::Samples(self.samples / 2..self.samples);
        if let Some(doubling) = Doubling::of(&step, settings).filter(|_| !self.half.is_empty()) {
            for at in pixels {
                let squared_error = doubling.squared_error(self.half[at], self.sums[at]);
                self.squared_errors[at] = squared_error as f32;
                self.variances[at] = doubling.variance(self.half[at], self.sums[at]) as f32;
            }
        }
        self.half.clear();
    }

    /// The samples of the pixels of a square.
    pub(crate) fn samples_at(&self, square: usize) -> u32 {
        let apart = self.apart.get(square).copied();
        apart
            .filter(|&samples| samples != 0)
            .unwrap_or(self.samples)
    }

    /// The samples of the pixels that have most.
    pub fn most_samples(&self) -> u32 {
        let most = (0..SQUARES).map(|square| self.samples_at(square)).max();
        most.unwrap_or(self.samples)
    }

    /// The sum of the numbers of samples of all its pixels.
    pub fn total(&self, blocks: Blocks) -> u64 {
        let taken = self.taken(blocks.region(self.number));
        taken.map(u64::from).sum()
    }

    /// The samples of each of its pixels.
    pub(crate) fn taken(&self, region: Region) -> impl Iterator<Item = u32> {
        region.pixels().map(|pixel| self.samples_at(square(pixel)))
    }

    /// The mean of a pixel's samples, or what an AOV of light shows of them, given its place in the list
    /// and its square.
    pub(crate) fn value(&self, at: usize, square: usize, aov: Option<Aov>) -> Rgb {
        let samples = f64::from(self.samples_at(square));
        match aov {
            Some(Aov::Samples) => Rgb::splat(samples),
            Some(Aov::Noise) => Rgb::splat(self.squared_errors[at].sqrt().into()),
            _ => self.sums[at] / samples.max(1.0),
        }
    }
}

/// The pixels of a region square by square, in pieces of 4×2, so that adjacent ones are traced
/// together.
fn in_squares(region: Region) -> Vec<[u32; 2]> {
    let steps = |from: u32, to: u32, step: usize| (from..to).step_by(step);
    let (right, bottom) = (region.x + region.width, region.y + region.height);
    let mut pixels = Vec::with_capacity(region.size().pixels());
    for top in steps(region.y, bottom, 16) {
        for left in steps(region.x, right, 16) {
            let (end, below) = (right.min(left + 16), bottom.min(top + 16));
            for y0 in steps(top, below, 2) {
                for x0 in steps(left, end, 4) {
                    for y in y0..below.min(y0 + 2) {
                        pixels.extend((x0..end.min(x0 + 4)).map(|x| [x, y]));
                    }
                }
            }
        }
    }
    pixels
}
