//! A picture as far as it is traced, kept to be continued by the next job, or in blocks by another
//! process.

use std::collections::TryReserveError;
use std::io::{self, ErrorKind};
use std::time::Duration;

use super::adaptive::{SQUARES, square};
use super::block::Block;
use super::blocks::Blocks;
use super::pass_schedule::{level_of, samples_at};
use super::tile::{PixelHistory, Remembers, Stored, Tile, TileShape};
use crate::integrators::Counts;
use crate::job::{Aov, Job, NO_OBJECT, Region};
use crate::picture::UNKNOWN;
use scene::Size;

/// Tiles freed at once: about 4 MB, in less than 1 ms.
const FREED: usize = 512;

/// A picture as far as it is traced, in which tiles may be unfinished.
#[derive(Debug)]
pub struct Checkpoint {
    pub(crate) size: Size,
    /// The samples of each pixel that it was traced to.
    pub(crate) spp: u32,
    /// Whether pixels stop, see [`Settings::noise`](crate::Settings::noise).
    pub(crate) is_adaptive: bool,
    pub(crate) remembers: Remembers,
    /// The tiles begun, in rows.
    pub(crate) tiles: Vec<Tile>,
    /// The time spent on it, without pauses.
    pub(crate) time: Duration,
}

/// The work that a picture took: of its job, and of those that it continues.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Effort {
    /// Without pauses.
    pub(crate) time: Duration,
    pub(crate) counts: Counts,
}

impl Checkpoint {
    /// The sum of the numbers of samples of all pixels.
    pub fn samples(&self) -> u64 {
        self.tiles.iter().map(|tile| tile.samples(self.spp)).sum()
    }

    /// The mean number of samples of a pixel, rounded down.
    pub fn spp(&self) -> u32 {
        (self.samples() / self.size.pixels() as u64) as u32
    }

    /// The samples that each pixel was to have.
    pub fn goal(&self) -> u32 {
        self.spp
    }

    /// The time spent on it, without pauses.
    pub fn time(&self) -> Duration {
        self.time
    }

    /// The number of pixels.
    pub(crate) fn pixels(&self) -> usize {
        self.size.pixels()
    }

    /// Whether the rays traced for each pixel are known.
    pub(crate) fn tells_rays(&self) -> bool {
        self.tiles.iter().all(Tile::tells_rays)
    }

    /// The blocks of which something is traced. Squares whose pixels have different numbers of samples
    /// are left out, as are blocks in which the state is lost from which pixels were stopped.
    pub fn blocks(&self) -> impl Iterator<Item = Block> {
        (0..Blocks::of(self.size).count()).filter_map(|number| self.block(number))
    }

    fn block(&self, number: u32) -> Option<Block> {
        let blocks = Blocks::of(self.size);
        let region = blocks.region(number);
        let mut squares = [None; SQUARES];
        for pixel in region.pixels() {
            let level = self
                .tile(pixel)
                .map(|tile| tile.pixel_level(tile.index(pixel)));
            let samples = samples_at(level.unwrap_or(0), self.spp);
            let of_square = squares[square(pixel)].get_or_insert(samples);
            if *of_square != samples {
                *of_square = 0;
            }
        }
        let taken = || squares.iter().copied().flatten();
        let samples = if self.is_adaptive {
            self.samples_of(region)
                .filter(|_| taken().all(|samples| samples != 0))
        } else {
            taken().min()
        };
        let samples = samples.filter(|_| taken().any(|samples| samples != 0))?;
        let mut block = Block {
            samples,
            ..Block::new(number, blocks)
        };
        if taken().any(|other| other != samples) {
            let apart = |of_square: Option<u32>| of_square.filter(|&other| other != samples);
            block.apart = squares
                .map(|of_square| apart(of_square).unwrap_or(0))
                .into();
        }
        if self.remembers == Remembers::Histories {
            block
                .histories
                .resize(region.size().pixels(), PixelHistory::default());
        }
        for (at, pixel) in region.pixels().enumerate() {
            if let Some(tile) = self.tile(pixel).filter(|tile| tile.corner() == pixel) {
                block.counts = block.counts.and(tile.counts);
            }
            if squares[square(pixel)] == Some(0) {
                continue;
            }
            let stored = self.pixel(pixel);
            block.sums[at] = stored.sum;
            block.squared_errors[at] = stored.squared_error;
            block.variances[at] = stored.variance;
            block.objects[at] = stored.object;
            if let Some((place, history)) = block.histories.get_mut(at).zip(stored.history) {
                *place = history;
            }
        }
        Some(block)
    }

    /// The samples that all pixels of a region have that have not stopped, if they have as many.
    fn samples_of(&self, region: Region) -> Option<u32> {
        let mut levels = region
            .pixels()
            .map(|pixel| self.tile(pixel).map(Tile::level));
        let level = levels.next()??;
        levels
            .all(|other| other == Some(level))
            .then(|| samples_at(level, self.spp))
    }

    /// The tile of a pixel, if it is begun.
    fn tile(&self, pixel: [u32; 2]) -> Option<&Tile> {
        let shape = TileShape::of(self.size);
        self.tiles.get(shape.number(pixel, self.size))
    }

    fn pixel(&self, pixel: [u32; 2]) -> Stored {
        let tile = self.tile(pixel);
        tile.map_or(Stored::NOTHING, |tile| tile.stored(tile.index(pixel)))
    }

    /// Puts blocks together to a picture that the job can continue, if they were traced from the same
    /// scene with the same camera and settings. Samples that are no step on the way to those of the job
    /// are left out. Needs as much memory as the job's film.
    ///
    /// # Errors
    ///
    /// Besides errors of the blocks, fails with [`ErrorKind::InvalidData`] if one is of no such picture,
    /// and with [`ErrorKind::OutOfMemory`].
    pub fn of(
        blocks: impl IntoIterator<Item = io::Result<Block>>,
        time: Duration,
        job: &Job,
    ) -> io::Result<Self> {
        let mut assembled = Assembled::new(time, job)?;
        for block in blocks {
            assembled.place(&block?, job)?;
        }
        Ok(assembled.finish())
    }

    /// Hands the memory to the current pool to free in small parts: freeing a large picture takes
    /// 0.1 s, during which no thread of the process can exit.
    pub(crate) fn free_later(mut self) {
        rayon::spawn(move || {
            while !self.tiles.is_empty() {
                self.tiles.truncate(self.tiles.len().saturating_sub(FREED));
                self.tiles.shrink_to_fit();
            }
        });
    }
}

/// A picture whose tiles are filled from blocks.
struct Assembled {
    checkpoint: Checkpoint,
    /// The level that the pixels of each tile have that have not stopped.
    levels: Vec<u8>,
}

impl Assembled {
    fn new(time: Duration, job: &Job) -> Result<Self, TryReserveError> {
        let size = job.settings.traced().size();
        let shape = TileShape::of(size);
        let count = shape.count(size);
        let remembers = Remembers::of(job);
        let mut tiles = Vec::new();
        tiles.try_reserve_exact(count)?;
        tiles.extend((0..count).map(|number| Tile::new(number, size, shape, remembers)));
        Ok(Self {
            checkpoint: Checkpoint {
                size,
                spp: job.settings.spp,
                is_adaptive: job.settings.adaptive().is_some(),
                remembers,
                tiles,
                time,
            },
            levels: vec![u8::MAX; count],
        })
    }

    fn place(&mut self, block: &Block, job: &Job) -> io::Result<()> {
        let Checkpoint {
            size, spp, tiles, ..
        } = &mut self.checkpoint;
        let blocks = Blocks::of(*size);
        if blocks.count() <= block.number {
            return Err(ErrorKind::InvalidData.into());
        }
        let region = blocks.region(block.number);
        let shape = TileShape::of(*size);
        let first = shape.number([region.x, region.y], *size);
        tiles[first].counts = tiles[first].counts.and(block.counts);
        let going_on = reached(block, block.samples, *spp).level;
        for (at, pixel) in region.pixels().enumerate() {
            let samples = block.samples_at(square(pixel));
            let reached = reached(block, samples, *spp);
            let stored = stored(block, at, &reached, job)?;
            let number = shape.number(pixel, *size);
            let tile = &mut tiles[number];
            tile.store(tile.index(pixel), &stored);
            let level = if samples < block.samples {
                going_on
            } else {
                stored.level
            };
            self.levels[number] = self.levels[number].min(level);
        }
        Ok(())
    }

    fn finish(mut self) -> Checkpoint {
        for (tile, level) in self.checkpoint.tiles.iter_mut().zip(self.levels) {
            tile.settle(level);
        }
        self.checkpoint
    }
}

/// The samples of pixels that a film can go on from.
struct Reached {
    /// See [`Step::level`](super::pass_schedule::Step::level).
    level: u8,
    /// Whether they are those after the last power of two.
    is_half: bool,
}

/// How far the pixels of a block with so many samples are on the way to `spp`.
fn reached(block: &Block, samples: u32, spp: u32) -> Reached {
    if let Some(level) = level_of(samples, spp) {
        return Reached {
            level,
            is_half: false,
        };
    }
    let half = (samples == block.samples && !block.half.is_empty()).then(|| 1 << samples.ilog2());
    let level = half.and_then(|half| level_of(half, spp));
    Reached {
        level: level.unwrap_or(0),
        is_half: true,
    }
}

/// The pixel of a block, by its place in the list, as the film of a job stores it; empty if what is known
/// of it is too little.
fn stored(block: &Block, at: usize, reached: &Reached, job: &Job) -> io::Result<Stored> {
    let object = block.objects[at];
    if object != NO_OBJECT && job.scene.objects.len() <= object as usize {
        return Err(ErrorKind::InvalidData.into());
    }
    let mut history = block
        .histories
        .get(at)
        .copied()
        .unwrap_or(PixelHistory::UNKNOWN);
    if 0 < block.counts.over_budget {
        // Which pixels exceeded their budget is not known: an edit retraces all.
        history.touched = PixelHistory::UNKNOWN.touched;
    }
    if reached.is_half {
        history.rays = PixelHistory::UNKNOWN.rays;
    }
    let is_light = job.settings.surface().is_none();
    let has_error = reached.level < 2 || !is_light || block.variances[at] != UNKNOWN;
    let needs_errors = Remembers::of(job) == Remembers::Histories;
    let needs_rays = job.settings.aov == Some(Aov::Cost);
    let is_known =
        (has_error || !needs_errors) && (history != PixelHistory::UNKNOWN || !needs_rays);
    if reached.level == 0 || !is_known {
        return Ok(Stored::NOTHING);
    }
    let sums = if reached.is_half {
        &block.half
    } else {
        &block.sums
    };
    Ok(Stored {
        sum: sums[at],
        object,
        level: reached.level,
        squared_error: block.squared_errors[at],
        variance: block.variances[at],
        history: Some(history),
    })
}
