//! A picture in progress: the accumulated pixels, in tiles that threads fill in parallel.

mod raster;

use std::collections::{BTreeMap, TryReserveError};
use std::ops::Range;
use std::time::Duration;

use rayon::prelude::*;

use super::adaptive::{SQUARES, Selection, Squares, square, unconverged};
use super::blocks::{BLOCK, Blocks};
use super::checkpoint::{Checkpoint, Effort};
use super::noise::Doubling;
use super::pass_schedule::Step;
use super::pixel_sampler::PixelSampler;
use super::tile::{AREA, Remembers, Tile, TileShape};
use crate::integrators::{Counts, FrameContext, LightComponent, MAPS, PhotonRules, Tracer};
use crate::job::{Aov, Frames, Job, Settings};
use crate::picture::{DisplayTransform, Excess, Overexposure, Tone, UNKNOWN, denoise, tone};
use crate::world::Dependencies;
use geometry::IsCancelled;
pub(crate) use raster::Raster;
use scene::{Integrator, LEAST_ADAPTIVE_SPP, Rgb, Size};

/// Pixels developed between two polls of cancellation, which takes a few milliseconds; at least two
/// rows of tiles per thread.
const QUIET: usize = 262_144;

/// The tiles of a picture, in rows.
#[derive(Debug)]
pub(crate) struct Film {
    size: Size,
    spp: u32,
    aov: Option<Aov>,
    display: DisplayTransform,
    /// The noise below which pixels take no more samples.
    adaptive: Option<f64>,
    shape: TileShape,
    remembers: Remembers,
    /// The tiles begun so far; capacity is reserved for all. First touching a large picture's
    /// memory takes long, so the tracing threads do it tile by tile.
    tiles: Vec<Tile>,
    /// The pixels that take part in the current step, unless all do.
    selection: Option<Selection>,
    /// The highest level of a pixel of the film taken over; 0 without one.
    reached: u8,
    /// The sum of the pixels' squared errors, up to the current tile of the pass.
    squared_errors: f64,
    /// The noise after the last pass that estimated it.
    noise: Option<f64>,
    /// Samples that exceeded their ray budget.
    over_budget: u64,
    /// Memory for the finished picture, reserved so that long work is not lost for lack of it.
    room: Raster,
}

/// The picture does not fit into memory.
#[derive(Debug)]
pub(crate) struct NoMemory {
    /// Required bytes.
    pub(crate) bytes: u64,
}

impl Film {
    /// Bytes needed by a film and its finished picture.
    pub(crate) fn bytes(job: &Job) -> u64 {
        let settings = &job.settings;
        let size = settings.traced().size();
        let bytes = |count: usize, each: usize| (count as u64).saturating_mul(each as u64);
        let remembers = Remembers::of(job);
        let denoising = if job.denoise && remembers == Remembers::Histories {
            denoise::bytes(size)
        } else {
            0
        };
        let values = match developed(job) {
            Frames::Live => size_of::<u32>() + size_of::<[f32; 3]>() + size_of::<f32>(),
            Frames::Last => 0,
            Frames::LastWithValues => size_of::<[f32; 3]>(),
        };
        let is_in_parts = PhotonRules::of(settings).is_some() && 2 * MAPS < settings.spp;
        let partial_pass = if is_in_parts {
            Tile::partial_pass_bytes()
        } else {
            0
        };
        let tile = Tile::bytes(remembers) + partial_pass;
        let tiles = bytes(TileShape::of(size).count(size), tile);
        let picture = bytes(size.pixels(), size_of::<[u8; 3]>() + values);
        tiles.saturating_add(picture).saturating_add(denoising)
    }

    /// Creates an empty film; reserves memory for its tiles and the finished picture.
    pub(crate) fn new(job: &Job) -> Result<Self, NoMemory> {
        let settings = &job.settings;
        let Settings { spp, aov, .. } = *settings;
        let size = settings.traced().size();
        let shape = TileShape::of(size);
        let remembers = Remembers::of(job);
        let count = shape.count(size);
        let film = || {
            let mut tiles = Vec::new();
            tiles.try_reserve_exact(count)?;
            Ok(Self {
                size,
                spp,
                aov,
                display: DisplayTransform::of(settings),
                adaptive: settings.adaptive(),
                shape,
                remembers,
                tiles,
                selection: None,
                reached: 0,
                squared_errors: 0.0,
                noise: None,
                over_budget: 0,
                room: Raster::with_room(size.pixels(), developed(job), remembers)?,
            })
        };
        film().map_err(|_: TryReserveError| NoMemory {
            bytes: Self::bytes(job),
        })
    }

    /// The number of tiles.
    pub(crate) fn tiles(&self) -> usize {
        self.shape.count(self.size)
    }

    /// The number of rows of tiles.
    pub(crate) fn rows(&self) -> usize {
        self.tiles() / self.shape.across(self.size)
    }

    /// The number of tiles begun.
    #[cfg(test)]
    pub(crate) fn begun(&self) -> usize {
        self.tiles.len()
    }

    /// Takes over a picture of the same size, except what depends on `changed`, and pixels that
    /// cannot be continued to this number of samples. Returns the effort that counts as its own:
    /// what was spent on it, unless it changed. Runs on the current thread pool.
    pub(crate) fn take_over(&mut self, checkpoint: Checkpoint, changed: Dependencies) -> Effort {
        self.tiles = checkpoint.tiles;
        self.remembers = checkpoint.remembers;
        let spp = [checkpoint.spp, self.spp];
        let levels: Vec<_> = self.tiles.iter().map(Tile::level).collect();
        let tiles = self.tiles.par_iter_mut();
        let stale = tiles.map(|tile| tile.forget(changed, spp)).collect();
        if self.adaptive.is_some() {
            self.forget_blocks(&levels, stale);
        }
        let reached = self.tiles.par_iter().map(Tile::reached);
        self.reached = reached.max().unwrap_or(0);
        self.over_budget = self.tiles.iter().map(|tile| tile.counts.over_budget).sum();
        let is_same = changed == Dependencies::NOTHING && 0 < self.reached;
        if !is_same {
            self.tiles.iter_mut().for_each(Tile::forget_rays);
        }
        let counts = self.tiles.iter().map(|tile| tile.counts);
        Effort {
            time: if is_same {
                checkpoint.time
            } else {
                Duration::ZERO
            },
            counts: counts.fold(Counts::default(), Counts::and),
        }
    }

    /// Resets all tiles of the blocks in which some are stale or lack a step that others have taken: the
    /// state from which their pixels were selected is lost.
    fn forget_blocks(&mut self, levels: &[u8], stale: Vec<bool>) {
        let block = |number: usize| {
            let [x, y] = self.shape.corner(number, self.size);
            // Tiles of low and narrow pictures extend over several.
            let is_within = self.shape.width.max(self.shape.height) <= BLOCK;
            is_within.then_some([x / BLOCK, y / BLOCK])
        };
        let mut states = BTreeMap::new();
        for (number, (level, is_stale)) in levels.iter().zip(stale).enumerate() {
            let state = states.entry(block(number)).or_insert((*level, false));
            state.1 |= is_stale || state.0 != *level;
        }
        for number in self.tiles.len()..self.tiles() {
            states.entry(block(number)).or_default().1 = true;
        }
        for (number, tile) in self.tiles.iter_mut().enumerate() {
            if states[&block(number)].1 {
                *tile = Tile::new(number, self.size, self.shape, self.remembers);
            }
        }
    }

    /// Whether a picture of the same size stores all that this one shows.
    pub(crate) fn can_take_over(&self, checkpoint: &Checkpoint) -> bool {
        let tells_rays = self.aov != Some(Aov::Cost) || checkpoint.tells_rays();
        checkpoint.remembers.suffices(self.remembers) && tells_rays
    }

    /// The picture as far as it is traced, and the time that it took.
    pub(crate) fn into_checkpoint(mut self, time: Duration) -> Checkpoint {
        self.tiles.par_iter_mut().for_each(Tile::revert);
        Checkpoint {
            size: self.size,
            spp: self.spp,
            is_adaptive: self.adaptive.is_some(),
            remembers: self.remembers,
            tiles: self.tiles,
            time,
        }
    }

    /// The highest level of a pixel of the film taken over.
    pub(crate) fn reached(&self) -> u8 {
        self.reached
    }

    /// Returns the end of the range from tile `from` that holds `count` tiles lacking a step.
    pub(crate) fn stretch(&self, from: usize, count: usize, step: &Step) -> usize {
        let lacks = |number: usize| {
            let tile = self.tiles.get(number);
            tile.is_none_or(|tile| tile.lacks(step))
        };
        let mut lacking = (from..self.tiles()).filter(|&number| lacks(number));
        lacking.nth(count).unwrap_or_else(|| self.tiles())
    }

    /// Selects the pixels that take part in a step, all of which lack it or none. Returns the share of
    /// pixels that have its samples afterwards, 0 to 1.
    pub(crate) fn select(&mut self, step: &Step) -> f64 {
        self.selection = match (self.adaptive, step) {
            (Some(limit), Step::Samples(indices)) if LEAST_ADAPTIVE_SPP <= indices.start => {
                let blocks = Blocks::of(self.size);
                let select = |number| self.select_in(blocks, number, limit, step.level());
                Some(Selection::new(blocks, select))
            }
            _ => None,
        };
        self.selection.as_ref().map_or(1.0, |selection| {
            selection.pixels() as f64 / self.size.pixels() as f64
        })
    }

    /// Selects the squares of a block that go on to a level. Returns also the number of pixels that
    /// have that level afterwards.
    fn select_in(&self, blocks: Blocks, number: u32, limit: f64, level: u8) -> (Squares, usize) {
        let region = blocks.region(number);
        let levels = region.pixels().map(|pixel| {
            let (tile, at) = self.pixel(pixel);
            (square(pixel), tile.pixel_level(at))
        });
        let levels: Vec<_> = levels.collect();
        let highest = levels.iter().map(|&(_, level)| level).max().unwrap_or(0);
        if level <= highest {
            let ahead = levels.iter().filter(|&&(_, reached)| level <= reached);
            return (Squares::default(), ahead.count());
        }
        let mut reached = [0; SQUARES];
        for &(square, level) in &levels {
            reached[square] = level;
        }
        // Those that stopped before have fewer samples.
        let taking = Squares::of(|square| reached[square] == highest);
        let errors = region.pixels().map(|pixel| {
            let (tile, at) = self.pixel(pixel);
            (square(pixel), tile.squared_error(at))
        });
        let squares = unconverged(limit, taking, errors);
        let selected = levels.iter().filter(|&&(square, _)| squares.has(square));
        (squares, selected.count())
    }

    /// The tile of a pixel and its index there.
    fn pixel(&self, pixel: [u32; 2]) -> (&Tile, usize) {
        let tile = &self.tiles[self.shape.number(pixel, self.size)];
        (tile, tile.index(pixel))
    }

    /// Takes one step, or one of its parts after the other, in those of some tiles that lack it, on the
    /// current thread pool. Stops once `cancelled` returns true; unfinished pixels must then be
    /// forgotten. The first step begins the tiles in order.
    pub(crate) fn advance(
        &mut self,
        tiles: Range<usize>,
        (step, part): (&Step, Range<u32>),
        context: &FrameContext<'_>,
        cancelled: IsCancelled<'_>,
    ) -> Counts {
        let (size, shape, remembers) = (self.size, self.shape, self.remembers);
        let selection = self.selection.as_ref();
        let new = self.tiles.len()..tiles.end;
        self.tiles.par_extend(
            new.into_par_iter()
                .map(|number| Tile::new(number, size, shape, remembers)),
        );
        let lacking = self.tiles[tiles.clone()]
            .iter_mut()
            .filter(|tile| tile.lacks(step));
        // Threads take one tile at a time: some take a hundred times as long as others, and halves
        // of a list would not end together.
        let counts = lacking
            .par_bridge()
            .map_init(
                || {
                    let Settings {
                        integrator, depth, ..
                    } = context.settings;
                    let tracer = Tracer::new(context.world, integrator, depth, cancelled);
                    let tracer = tracer
                        .gathering(LightComponent::of(context.settings.aov))
                        .with_photons(context.photons);
                    PixelSampler::new(match remembers {
                        Remembers::Pixels => tracer,
                        Remembers::Histories => tracer.noting(),
                    })
                },
                |sampler, tile| {
                    let before = sampler.tracer.counts();
                    tile.advance(size, (step, part.clone(), selection), context, sampler);
                    let traced = sampler.tracer.counts().since(before);
                    tile.add_rays(traced);
                    traced
                },
            )
            .reduce(Counts::default, Counts::and);
        self.over_budget += counts.over_budget;
        if part.end == step.indices().end && Doubling::of(step, &context.settings).is_some() {
            self.gather_errors(tiles);
        }
        counts
    }

    /// Adds the squared errors of tiles one by one in order, since other groupings would round
    /// differently. The last tile completes the noise estimate.
    fn gather_errors(&mut self, tiles: Range<usize>) {
        if tiles.start == 0 {
            self.squared_errors = 0.0;
        }
        for tile in &self.tiles[tiles.clone()] {
            self.squared_errors += tile.squared_errors;
        }
        if tiles.end == self.tiles() {
            let mean = self.squared_errors / self.size.pixels() as f64;
            self.noise = Some(mean.sqrt());
        }
    }

    /// The root mean square of the pixels' errors, 0..1, after the last pass that estimated it.
    pub(crate) fn noise(&self) -> Option<f64> {
        self.noise
    }

    /// The number of samples that exceeded their ray budget.
    pub(crate) fn over_budget(&self) -> u64 {
        self.over_budget
    }

    /// Converts the pixels traced so far, on the current thread pool; while only a coarse grid is
    /// traced, each pixel shows the nearest grid point up and to the left. All tiles must be begun.
    /// `None` once `cancelled` returns true, or if memory is short.
    pub(crate) fn develop(&self, cancelled: IsCancelled<'_>) -> Option<Raster> {
        let room = Raster::with_room(self.size.pixels(), Frames::Live, self.remembers);
        self.develop_in(room.ok()?, cancelled)
    }

    /// Like [`Film::develop`], but only once, with the memory reserved.
    pub(crate) fn finish(&mut self, cancelled: IsCancelled<'_>) -> Option<Raster> {
        let room = std::mem::take(&mut self.room);
        let mut raster = self.develop_in(room, cancelled)?;
        raster.overexposure = self.overexposure();
        Some(raster)
    }

    /// The variances of the linear values of pixels, or [`UNKNOWN`]; `None` where the noise is not
    /// recorded.
    pub(crate) fn variances(&self, context: &FrameContext<'_>) -> Option<Vec<f32>> {
        if self.remembers != Remembers::Histories {
            return None;
        }
        let scale = self.display.exposed(Rgb::ONE).x;
        let scale = (scale * scale) as f32;
        let mut variances = Vec::new();
        self.develop_rows(0..self.rows(), &mut variances, |tile, at| {
            match (tile.variance(at), context.settings.integrator) {
                // What differs from sample to sample is which surfaces they hit, of which neighbours
                // tell nothing: denoised, pictures of 16 samples have up to a sixth more error.
                (_, Integrator::Whitted) if !context.blurs() => 0.0,
                // A single sample is at the centre of all distributions.
                (UNKNOWN, Integrator::Whitted) => 0.0,
                (UNKNOWN, Integrator::Path | Integrator::Photon) => UNKNOWN,
                (variance, _) => scale * variance,
            }
        });
        Some(variances)
    }

    fn develop_in(&self, mut raster: Raster, cancelled: IsCancelled<'_>) -> Option<Raster> {
        raster.range = self.range();
        let tone = Tone::of(self.aov, self.display, raster.range);
        let value = |tile: &Tile, at| tile.value(at, self.spp, self.aov);
        let tells_objects = 0 < raster.objects.capacity();
        let tells_values = 0 < raster.values.capacity();
        let tells_errors = 0 < raster.errors.capacity() && self.noise.is_some();
        let down = self.rows();
        let quiet = QUIET.div_ceil(self.shape.across(self.size) * AREA as usize);
        let quiet = quiet.max(2 * rayon::current_num_threads());
        for start in (0..down).step_by(quiet) {
            if cancelled() {
                return None;
            }
            let rows = start..down.min(start + quiet);
            self.develop_rows(rows.clone(), &mut raster.pixels, |tile, at| {
                tone.bytes(value(tile, at))
            });
            if tells_objects {
                self.develop_rows(rows.clone(), &mut raster.objects, Tile::object);
            }
            if tells_values {
                self.develop_rows(rows.clone(), &mut raster.values, |tile, at| {
                    tone.linear(value(tile, at)).as_vec3().to_array()
                });
            }
            if tells_errors {
                self.develop_rows(rows, &mut raster.errors, Tile::error);
            }
        }
        Some(raster)
    }

    /// Appends the pixels of some rows of tiles, each computed by `develop` from the pixel that
    /// represents it.
    pub(crate) fn develop_rows<T: Clone + Default + Send>(
        &self,
        rows: Range<usize>,
        developed: &mut Vec<T>,
        develop: impl Fn(&Tile, usize) -> T + Sync,
    ) {
        let Size { width, height } = self.size;
        let (across, shape) = (self.shape.across(self.size), self.shape);
        let from = developed.len();
        let below = height.min(rows.end as u32 * shape.height);
        developed.resize(width as usize * below as usize, T::default());
        let new = developed[from..].par_chunks_mut(width as usize * shape.height as usize);
        new.zip(rows).for_each(|(pixels, row)| {
            let tiles = &self.tiles[row * across..][..across];
            // Tile by tile: lines that cross many tiles would miss the cache.
            for (left, tile) in (0..).step_by(shape.width as usize).zip(tiles) {
                let right = width.min(left + shape.width);
                let lines = pixels.chunks_exact_mut(width as usize);
                for (y, line) in (row as u32 * shape.height..).zip(lines) {
                    let line = &mut line[left as usize..right as usize];
                    for (x, pixel) in (left..).zip(line) {
                        *pixel = develop(tile, tile.known([x, y]));
                    }
                }
            }
        });
    }

    /// How much of the picture exceeds 1 after the exposure.
    fn overexposure(&self) -> Overexposure {
        let excess = |tile: &Tile| {
            let values = tile.values(self.spp, self.aov);
            Excess::of(values.map(|value| self.display.exposed(value)))
        };
        Excess::sum(self.tiles.par_iter().map(excess)).over(self.size.pixels())
    }

    /// The ends of the scale of AOVs that have one.
    fn range(&self) -> Option<[f64; 2]> {
        let values = |tile| Tile::values(tile, self.spp, self.aov);
        tone::scale(self.aov, self.tiles.par_iter().flat_map_iter(values))
    }
}

/// What a picture is developed to: noise is reduced in values.
fn developed(job: &Job) -> Frames {
    match job.frames {
        Frames::Last if job.denoise => Frames::LastWithValues,
        frames => frames,
    }
}
