//! The picture under way: what every pixel has gathered, in tiles that threads fill side by side.

use std::collections::TryReserveError;
use std::ops::Range;

use rayon::prelude::*;

use super::frame::{Aov, Frames, Settings};
use super::noise::Doubling;
use super::probe::Counts;
use super::shot::Shot;
use super::steps::Step;
use super::tile::{AREA, Remembers, Tile, TileShape, Work};
use super::tone::Tone;
use super::touched::Touched;
use super::tracer::Tracer;
use crate::scene::{Size, Transfer};

/// The most pixels of a picture of which is remembered what they depend on: of larger ones that
/// would take more memory than the time is worth.
const MOST_REMEMBERED: usize = 1 << 22;

/// Pixels developed without asking whether to stop, or else two rows of tiles a thread: a few
/// milliseconds.
const QUIET: usize = 262_144;

/// Tiles freed at once: about four megabytes, less than a millisecond.
const FREED: usize = 512;

/// The tiles of a picture, row by row.
#[derive(Debug)]
pub(crate) struct Film {
    size: Size,
    spp: u32,
    aov: Option<Aov>,
    transfer: Transfer,
    shape: TileShape,
    remembers: Remembers,
    /// Those that a step has come to; there is room for all. A large picture's memory takes long to
    /// be first touched: it is, tile by tile, by the threads that trace.
    tiles: Vec<Tile>,
    /// The sum of the pixels' squared errors, as far as the pass under way has come.
    squared_errors: f64,
    /// What it came to in the last pass that told.
    noise: Option<f64>,
    /// Samples that ran out of their ray budget.
    over_budget: u64,
    /// Room for the finished picture: what long work has made must not be lost for want of it.
    room: Raster,
}

/// What a picture's tiles hold.
fn remembers(size: Size, frames: Frames) -> Remembers {
    if frames == Frames::Live && size.pixels() <= MOST_REMEMBERED {
        Remembers::Causes
    } else {
        Remembers::Pixels
    }
}

/// A picture takes more memory than the system gives.
#[derive(Debug)]
pub(crate) struct NoMemory {
    /// How many bytes it takes.
    pub(crate) bytes: u64,
}

/// Pixels row by row, and the index of the object under each.
#[derive(Debug, Default)]
pub(crate) struct Raster {
    pub(crate) pixels: Vec<[u8; 3]>,
    pub(crate) objects: Vec<u32>,
    /// What the pixels are made of, where it is asked for.
    pub(crate) values: Vec<[f32; 3]>,
}

impl Raster {
    /// Room for so many pixels, and what is told of them in frames of some kind.
    fn with_room(count: usize, frames: Frames) -> Result<Self, TryReserveError> {
        let mut room = Self::default();
        room.pixels.try_reserve_exact(count)?;
        match frames {
            Frames::Live => room.objects.try_reserve_exact(count)?,
            Frames::Last => {}
            Frames::LastWithValues => room.values.try_reserve_exact(count)?,
        }
        Ok(room)
    }
}

impl Film {
    /// What a film takes with the finished picture.
    pub(crate) fn bytes(settings: &Settings, frames: Frames) -> u64 {
        let size = settings.size;
        let bytes = |count: usize, each: usize| (count as u64).saturating_mul(each as u64);
        let told = match frames {
            Frames::Live => size_of::<u32>(),
            Frames::Last => 0,
            Frames::LastWithValues => size_of::<[f32; 3]>(),
        };
        let tile = Tile::bytes(remembers(size, frames));
        let tiles = bytes(TileShape::of(size).count(size), tile);
        tiles.saturating_add(bytes(size.pixels(), size_of::<[u8; 3]>() + told))
    }

    /// An empty film, with room for its tiles and the finished picture.
    pub(crate) fn new(settings: &Settings, frames: Frames) -> Result<Self, NoMemory> {
        let Settings {
            size,
            spp,
            aov,
            transfer,
            ..
        } = *settings;
        let shape = TileShape::of(size);
        let remembers = remembers(size, frames);
        let count = shape.count(size);
        let film = || {
            let mut tiles = Vec::new();
            tiles.try_reserve_exact(count)?;
            Ok(Self {
                size,
                spp,
                aov,
                transfer,
                shape,
                remembers,
                tiles,
                squared_errors: 0.0,
                noise: None,
                over_budget: 0,
                room: Raster::with_room(size.pixels(), frames)?,
            })
        };
        film().map_err(|_: TryReserveError| NoMemory {
            bytes: Self::bytes(settings, frames),
        })
    }

    /// How many tiles there are.
    pub(crate) fn tiles(&self) -> usize {
        self.shape.count(self.size)
    }

    /// How many rows of tiles there are.
    pub(crate) fn rows(&self) -> usize {
        self.tiles() / self.shape.across(self.size)
    }

    /// How many tiles a step has come to.
    #[cfg(test)]
    pub(crate) fn begun(&self) -> usize {
        self.tiles.len()
    }

    /// Takes over what another film of as large a picture holds, but for what depends on `changed`. On
    /// the threads of the current pool.
    pub(crate) fn take_over(&mut self, other: Self, changed: Touched) {
        self.tiles = other.tiles;
        self.tiles
            .par_iter_mut()
            .for_each(|tile| tile.forget(changed));
        self.over_budget = self.tiles.iter().map(|tile| tile.over_budget).sum();
    }

    /// Whether something can be told of what its pixels depend on.
    pub(crate) fn remembers(&self) -> bool {
        self.remembers == Remembers::Causes
    }

    /// Where so many tiles from one on end that have yet to take a step.
    pub(crate) fn stretch(&self, from: usize, count: usize, step: &Step) -> usize {
        let lacks = |number: usize| {
            let tile = self.tiles.get(number);
            tile.is_none_or(|tile| tile.lacks(step))
        };
        let mut lacking = (from..self.tiles()).filter(|&number| lacks(number));
        lacking.nth(count).unwrap_or_else(|| self.tiles())
    }

    /// Takes one step in those of some tiles that have yet to take it, on the threads of the current
    /// pool. Once `cancelled` says so it stops, and what was under way is to be forgotten. The first
    /// step comes to all tiles in order.
    pub(crate) fn advance(
        &mut self,
        tiles: Range<usize>,
        step: &Step,
        shot: &Shot<'_>,
        cancelled: impl Fn() -> bool + Sync,
    ) -> Counts {
        let (size, shape, remembers) = (self.size, self.shape, self.remembers);
        let new = self.tiles.len()..tiles.end;
        self.tiles.par_extend(
            new.into_par_iter()
                .map(|number| Tile::new(number, size, shape, remembers)),
        );
        let lacking = self.tiles[tiles.clone()]
            .iter_mut()
            .filter(|tile| tile.lacks(step));
        // Each thread takes the next tile when it is done with one: some take a hundred times as long
        // as others, and halves of their list would not end together.
        let counts = lacking
            .par_bridge()
            .map_init(
                || {
                    let Settings {
                        integrator, depth, ..
                    } = shot.settings;
                    let tracer = Tracer::new(shot.world, integrator, depth, &cancelled);
                    Work::new(match remembers {
                        Remembers::Pixels => tracer,
                        Remembers::Causes => tracer.noting(),
                    })
                },
                |work, tile| {
                    let before = work.tracer.counts();
                    tile.advance(size, step, shot, work);
                    work.tracer.counts().since(before)
                },
            )
            .reduce(Counts::default, Counts::and);
        self.over_budget += counts.over_budget;
        if Doubling::of(step, &shot.settings).is_some() {
            self.gather_errors(tiles);
        }
        counts
    }

    /// Adds up the squared errors of tiles, one by one in their order: sums of other groups would be
    /// other numbers. With the last tile the noise is known.
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

    /// The root of the mean of the pixels' squared errors, in 0..1, as of the last pass that told.
    pub(crate) fn noise(&self) -> Option<f64> {
        self.noise
    }

    /// How many of its samples ran out of their ray budget.
    pub(crate) fn over_budget(&self) -> u64 {
        self.over_budget
    }

    /// The pixels as far as they are known, on the threads of the current pool: where only a coarse
    /// grid is traced, its nearest point up and to the left stands for them. Every tile has been
    /// come to. `None` once `cancelled` says so, or where there is no memory for them.
    pub(crate) fn develop(&self, cancelled: impl Fn() -> bool) -> Option<Raster> {
        let room = Raster::with_room(self.size.pixels(), Frames::Live);
        self.develop_in(room.ok()?, cancelled)
    }

    /// As [`Film::develop`], but only once, and there is memory for it.
    pub(crate) fn finish(&mut self, cancelled: impl Fn() -> bool) -> Option<Raster> {
        let room = std::mem::take(&mut self.room);
        self.develop_in(room, cancelled)
    }

    fn develop_in(&self, mut raster: Raster, cancelled: impl Fn() -> bool) -> Option<Raster> {
        let tone = self.tone();
        let value = |tile: &Tile, at| tile.value(at, self.spp);
        let tells_objects = 0 < raster.objects.capacity();
        let tells_values = 0 < raster.values.capacity();
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
                self.develop_rows(rows, &mut raster.values, |tile, at| {
                    value(tile, at).as_vec3().to_array()
                });
            }
        }
        Some(raster)
    }

    /// Adds the pixels of some rows of tiles to those before: of each what `told` says of the one that
    /// stands for it.
    pub(crate) fn develop_rows<T: Clone + Default + Send>(
        &self,
        rows: Range<usize>,
        developed: &mut Vec<T>,
        told: impl Fn(&Tile, usize) -> T + Sync,
    ) {
        let Size { width, height } = self.size;
        let (across, shape) = (self.shape.across(self.size), self.shape);
        let from = developed.len();
        let below = height.min(rows.end as u32 * shape.height);
        developed.resize(width as usize * below as usize, T::default());
        let new = developed[from..].par_chunks_mut(width as usize * shape.height as usize);
        new.zip(rows).for_each(|(pixels, row)| {
            let tiles = &self.tiles[row * across..][..across];
            // Tile by tile: along lines that cross many of them, memory is waited for.
            for (left, tile) in (0..).step_by(shape.width as usize).zip(tiles) {
                let right = width.min(left + shape.width);
                let lines = pixels.chunks_exact_mut(width as usize);
                for (y, line) in (row as u32 * shape.height..).zip(lines) {
                    let line = &mut line[left as usize..right as usize];
                    for (x, pixel) in (left..).zip(line) {
                        *pixel = told(tile, tile.known([x, y]));
                    }
                }
            }
        });
    }

    /// Leaves the memory to the current pool to free, bit by bit: a large picture takes a tenth of a
    /// second, and while the system takes memory back, no thread of the process can end.
    pub(crate) fn free_later(mut self) {
        rayon::spawn(move || {
            while !self.tiles.is_empty() {
                self.tiles.truncate(self.tiles.len().saturating_sub(FREED));
                self.tiles.shrink_to_fit();
            }
        });
    }

    /// How what the pixels hold is shown.
    fn tone(&self) -> Tone {
        match self.aov {
            None | Some(Aov::Albedo) => Tone::Colour(self.transfer),
            Some(Aov::Normal) => Tone::Normal,
            Some(Aov::Object) => Tone::Number,
            Some(Aov::Depth) => {
                let distances = self.tiles.par_iter().flat_map_iter(Tile::sums);
                let distances = distances
                    .map(|sum| sum.x)
                    .filter(|&x| 0.0 < x && x.is_finite());
                let (nearest, farthest) = distances
                    .map(|x| (x, x))
                    .reduce(|| (f64::INFINITY, 0.0), |a, b| (a.0.min(b.0), a.1.max(b.1)));
                Tone::Depth { nearest, farthest }
            }
        }
    }
}
