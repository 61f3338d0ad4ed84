//! The picture under way: what every pixel has gathered, in tiles that threads fill side by side.

use std::collections::TryReserveError;
use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::camera::Projection;
use super::filter::Spread;
use super::first_hit::first_hit;
use super::frame::{Aov, Frames, NO_OBJECT, Settings};
use super::noise::Doubling;
use super::probe::{Counts, Sample, Seen};
use super::sampler::{Sampler, Use};
use super::steps::{COARSEST, Step};
use super::tone::Tone;
use super::tracer::Tracer;
use super::world::World;
use crate::scene::{Integrator, Rgb, Size, Transfer};

/// Pixels of a tile.
const AREA: u32 = 256;

/// Pixels along the edges of most tiles; a multiple of the coarsest [`Step::Grid`].
const TILE: u32 = 16;

/// Pixels developed without asking whether to stop: less than two milliseconds.
const QUIET: usize = 65_536;

/// Tiles freed at once: about four megabytes, less than a millisecond.
const FREED: usize = 512;

/// Everything a tile needs to be traced.
#[derive(Debug)]
pub(crate) struct Shot<'w> {
    /// What is seen.
    pub(crate) world: &'w World,
    /// From where.
    pub(crate) projection: Projection,
    /// Where the camera stands.
    pub(crate) eye: DVec3,
    /// How.
    pub(crate) settings: Settings,
    /// Where around its pixel each sample lies.
    pub(crate) spread: Spread,
}

impl Shot<'_> {
    /// A sample of a pixel.
    fn sample(&self, [x, y]: [u32; 2], index: u32) -> Sample {
        let Settings {
            size,
            seed,
            integrator,
            aov,
            ..
        } = self.settings;
        let sampler = Sampler::new(x, y, index, seed);
        let [across, down] = self.spread.place(sampler.place_in_pixel());
        let [x, y] = [x, y].map(f64::from);
        let lens = || match (integrator, aov) {
            // An unbiased sample has no middle.
            (Integrator::Path, None) => {
                let [u, v, ..] = sampler.four(Sampler::ROOT, Use::Lens);
                Some([u, v])
            }
            _ => sampler.pair(Sampler::ROOT, Use::Lens),
        };
        let (ray, reach) = self.projection.ray(x + across, y + down, lens);
        Sample {
            ray,
            reach,
            screen: (DVec2::new(x, y) + 0.5) / DVec2::new(size.width.into(), size.height.into()),
            sampler,
        }
    }
}

/// What a thread traces tiles with: room that it keeps from one to the next.
struct Work<'w, C> {
    tracer: Tracer<'w, C>,
    /// The pixels that are sampled.
    pixels: Vec<[u32; 2]>,
    /// A sample of each.
    samples: Vec<Sample>,
    /// What each brings.
    seen: Vec<Seen>,
}

/// The tiles of a picture, row by row.
#[derive(Debug)]
pub(crate) struct Film {
    size: Size,
    aov: Option<Aov>,
    transfer: Transfer,
    shape: TileShape,
    /// Those that a step has come to; there is room for all. A large picture's memory takes long to
    /// be first touched: it is, tile by tile, by the threads that trace.
    tiles: Vec<Tile>,
    /// The sum of the pixels' squared errors, as far as the pass under way has come.
    squared_errors: f64,
    /// What it came to in the last pass that told.
    noise: Option<f64>,
    /// Room for the finished picture: what long work has made must not be lost for want of it.
    room: Raster,
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
    /// Room for so many pixels.
    fn with_room(count: usize) -> Result<Self, TryReserveError> {
        let mut room = Self::default();
        room.pixels.try_reserve_exact(count)?;
        room.objects.try_reserve_exact(count)?;
        Ok(room)
    }
}

/// The pixels along a tile's edges.
#[derive(Clone, Copy, Debug)]
struct TileShape {
    width: u32,
    height: u32,
}

impl TileShape {
    /// Squares, unless the picture is narrower or lower than those: what of a tile lies beyond the
    /// picture takes memory too, and grids begin at its edges.
    fn of(size: Size) -> Self {
        let edge = |pixels: u32| pixels.min(TILE).next_power_of_two();
        if size.height < TILE {
            let height = edge(size.height);
            Self {
                width: AREA / height,
                height,
            }
        } else {
            let width = edge(size.width);
            Self {
                width,
                height: AREA / width,
            }
        }
    }

    /// Tiles along each row of a picture.
    fn across(self, size: Size) -> usize {
        size.width.div_ceil(self.width) as usize
    }

    /// Tiles of a picture.
    fn count(self, size: Size) -> usize {
        self.across(size) * size.height.div_ceil(self.height) as usize
    }
}

#[derive(Debug)]
struct Tile {
    /// Its top left pixel.
    corner: [u32; 2],
    shape: TileShape,
    /// Sums of radiance, row by row; pixels beyond the picture's edge stay 0.
    sums: [Rgb; AREA as usize],
    /// The object under each pixel's centre.
    objects: [u32; AREA as usize],
    /// Spacing of the finest grid traced, while there are no whole samples.
    grid: u32,
    /// Samples that every pixel has.
    samples: u32,
    /// The sum of its pixels' squared errors in the last pass.
    squared_errors: f64,
}

impl Film {
    /// An empty film, with room for all that it and the finished picture take.
    pub(crate) fn new(settings: &Settings, frames: Frames) -> Result<Self, NoMemory> {
        let Settings {
            size,
            aov,
            transfer,
            ..
        } = *settings;
        let shape = TileShape::of(size);
        let count = shape.count(size);
        let film = || {
            let mut tiles = Vec::new();
            tiles.try_reserve_exact(count)?;
            let mut room = Raster::with_room(size.pixels())?;
            if frames == Frames::LastWithValues {
                room.values.try_reserve_exact(size.pixels())?;
            }
            Ok(Self {
                size,
                aov,
                transfer,
                shape,
                tiles,
                squared_errors: 0.0,
                noise: None,
                room,
            })
        };
        film().map_err(|_: TryReserveError| {
            let bytes = |count: usize, each: usize| (count as u64).saturating_mul(each as u64);
            let developed = size_of::<[u8; 3]>() + size_of::<u32>();
            let tiles = bytes(count, size_of::<Tile>());
            NoMemory {
                bytes: tiles.saturating_add(bytes(size.pixels(), developed)),
            }
        })
    }

    /// How many tiles there are.
    pub(crate) fn tiles(&self) -> usize {
        self.shape.count(self.size)
    }

    /// How many tiles a step has come to.
    #[cfg(test)]
    pub(crate) fn begun(&self) -> usize {
        self.tiles.len()
    }

    /// Takes one step in some of the tiles, on the threads of the current pool. Once `cancelled`
    /// says so it stops, and the film is of no more use. The first step comes to all tiles in order.
    pub(crate) fn advance(
        &mut self,
        tiles: Range<usize>,
        step: &Step,
        shot: &Shot<'_>,
        cancelled: impl Fn() -> bool + Sync,
    ) -> Counts {
        let (size, shape) = (self.size, self.shape);
        let new = self.tiles.len()..tiles.end;
        self.tiles.par_extend(
            new.into_par_iter()
                .map(|number| Tile::new(number, size, shape)),
        );
        let counts = self.tiles[tiles.clone()]
            .par_iter_mut()
            .map_init(
                || {
                    let Settings {
                        integrator, depth, ..
                    } = shot.settings;
                    Work {
                        tracer: Tracer::new(shot.world, integrator, depth, &cancelled),
                        pixels: Vec::new(),
                        samples: Vec::new(),
                        seen: Vec::new(),
                    }
                },
                |work, tile| {
                    let before = work.tracer.counts();
                    tile.advance(size, step, shot, work);
                    work.tracer.counts().since(before)
                },
            )
            .reduce(Counts::default, Counts::and);
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

    /// The pixels as far as they are known, on the threads of the current pool: where only a coarse
    /// grid is traced, its nearest point up and to the left stands for them. Every tile has been
    /// come to. `None` once `cancelled` says so, or where there is no memory for them.
    pub(crate) fn develop(&self, cancelled: impl Fn() -> bool) -> Option<Raster> {
        self.develop_in(Raster::with_room(self.size.pixels()).ok()?, cancelled)
    }

    /// As [`Film::develop`], but only once, and there is memory for it.
    pub(crate) fn finish(&mut self, cancelled: impl Fn() -> bool) -> Option<Raster> {
        let room = std::mem::take(&mut self.room);
        self.develop_in(room, cancelled)
    }

    fn develop_in(&self, mut raster: Raster, cancelled: impl Fn() -> bool) -> Option<Raster> {
        let count = self.size.pixels();
        let tone = self.tone();
        let tells_values = 0 < raster.values.capacity();
        for start in (0..count).step_by(QUIET) {
            if cancelled() {
                return None;
            }
            let part = start..count.min(start + QUIET);
            let each = || part.clone().into_par_iter().with_min_len(1024);
            let value = |at| self.value(at);
            raster
                .pixels
                .par_extend(each().map(value).map(|value| tone.bytes(value)));
            raster.objects.par_extend(each().map(|at| self.object(at)));
            if tells_values {
                let values = each().map(value).map(|value| value.as_vec3().to_array());
                raster.values.par_extend(values);
            }
        }
        Some(raster)
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
                let distances = self.tiles.par_iter().flat_map_iter(|tile| tile.sums);
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

    /// What a pixel holds.
    fn value(&self, at: usize) -> Rgb {
        let (tile, pixel) = self.find(at);
        tile.sums[pixel] / f64::from(tile.samples.max(1))
    }

    fn object(&self, at: usize) -> u32 {
        let (tile, pixel) = self.find(at);
        tile.objects[pixel]
    }

    /// The tile of a pixel, and the pixel in it that stands for it.
    fn find(&self, at: usize) -> (&Tile, usize) {
        // A picture has no more pixels each way than 32 bits count.
        let width = self.size.width as usize;
        let (x, y) = ((at % width) as u32, (at / width) as u32);
        let TileShape { width, height } = self.shape;
        let row = (y / height) as usize * self.shape.across(self.size);
        let tile = &self.tiles[row + (x / width) as usize];
        (tile, tile.known(x, y))
    }
}

impl Tile {
    /// An empty tile, by its place in the film.
    fn new(number: usize, size: Size, shape: TileShape) -> Self {
        let across = shape.across(size);
        Self {
            corner: [
                (number % across) as u32 * shape.width,
                (number / across) as u32 * shape.height,
            ],
            shape,
            sums: [Rgb::ZERO; AREA as usize],
            objects: [NO_OBJECT; AREA as usize],
            grid: COARSEST,
            samples: 0,
            squared_errors: 0.0,
        }
    }

    fn advance<C: Fn() -> bool>(
        &mut self,
        size: Size,
        step: &Step,
        shot: &Shot<'_>,
        work: &mut Work<'_, C>,
    ) {
        match step {
            &Step::Grid(spacing) => {
                let coarser = 2 * spacing;
                let held =
                    |[x, y]: [u32; 2]| spacing < COARSEST && x % coarser == 0 && y % coarser == 0;
                let pixels = self.pixels(size, spacing).filter(|&pixel| !held(pixel));
                work.pixels.clear();
                work.pixels.extend(pixels);
                self.sample(0, shot, work);
                self.grid = spacing;
                self.samples = u32::from(spacing == 1);
            }
            Step::Samples(indices) => {
                let doubling = Doubling::of(step, &shot.settings);
                let before = self.sums;
                work.pixels.clear();
                work.pixels.extend(self.pixels(size, 1));
                for index in indices.clone() {
                    if work.tracer.is_cancelled() {
                        return;
                    }
                    self.sample(index, shot, work);
                }
                self.squared_errors = 0.0;
                for &[x, y] in &work.pixels {
                    let at = self.index(x, y);
                    self.squared_errors += doubling.map_or(0.0, |doubling| {
                        doubling.squared_error(before[at], self.sums[at])
                    });
                }
                self.samples = indices.end;
            }
        }
    }

    /// Adds one sample to each of some pixels.
    fn sample<C: Fn() -> bool>(&mut self, index: u32, shot: &Shot<'_>, work: &mut Work<'_, C>) {
        let Work {
            tracer,
            pixels,
            samples,
            seen,
        } = work;
        samples.clear();
        samples.extend(pixels.iter().map(|&pixel| shot.sample(pixel, index)));
        match shot.settings.aov {
            None => tracer.trace(samples, seen),
            Some(aov) => {
                tracer.count(samples.len());
                seen.clear();
                seen.extend(samples.iter().map(|&Sample { ray, reach, .. }| {
                    let skipped = (ray.origin - shot.eye).dot(ray.direction);
                    first_hit(shot.world, &ray, reach, skipped, aov)
                }));
            }
        }
        for (&[x, y], seen) in pixels.iter().zip(seen) {
            let at = self.index(x, y);
            self.sums[at] += seen.radiance;
            if index == 0 {
                self.objects[at] = seen.object;
            }
        }
    }

    /// Its pixels within the picture on a grid of some spacing, in blocks of four by two: those that
    /// stand side by side are traced side by side.
    fn pixels(&self, size: Size, spacing: u32) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [left, top] = self.corner;
        let right = left + (size.width - left).min(self.shape.width);
        let bottom = top + (size.height - top).min(self.shape.height);
        let step = spacing as usize;
        let part = move |from: u32, to: u32, count: u32| {
            (from..to.min(from + count * spacing)).step_by(step)
        };
        (top..bottom).step_by(2 * step).flat_map(move |y0| {
            (left..right).step_by(4 * step).flat_map(move |x0| {
                part(y0, bottom, 2).flat_map(move |y| part(x0, right, 4).map(move |x| [x, y]))
            })
        })
    }

    /// Where the pixel that stands for (x, y) is.
    fn known(&self, x: u32, y: u32) -> usize {
        if self.samples == 0 {
            self.index(x - x % self.grid, y - y % self.grid)
        } else {
            self.index(x, y)
        }
    }

    fn index(&self, x: u32, y: u32) -> usize {
        ((y - self.corner[1]) * self.shape.width + (x - self.corner[0])) as usize
    }
}
