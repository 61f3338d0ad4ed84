//! The picture under way: what every pixel has gathered, in tiles that threads fill side by side.

use std::ops::Range;

use rayon::prelude::*;

use super::camera::Projection;
use super::frame::{NO_OBJECT, Settings};
use super::sampler::place_in_pixel;
use super::tone::to_bytes;
use super::whitted::{Counts, Tracer};
use super::world::World;
use crate::scene::{Rgb, Size};

/// Pixels along a tile's edge; a multiple of the coarsest [`Step::Grid`].
const TILE: u32 = 16;

/// Pixels of a tile.
const AREA: usize = (TILE * TILE) as usize;

/// Pixels developed without asking whether to stop: less than two milliseconds.
const QUIET: usize = 65_536;

/// Tiles freed at once: about four megabytes, less than a millisecond.
const FREED: usize = 512;

/// What one walk over all tiles adds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Sample 0 of the pixels on a grid of this spacing that no coarser grid holds.
    Grid(u32),
    /// These samples of every pixel.
    Samples(Range<u32>),
}

/// Spacings of the grids that sample 0 is taken on, coarse to fine, as in Adam7: each shows the
/// whole picture, and none of its samples is wasted.
const GRIDS: [u32; 4] = [8, 4, 2, 1];

/// The steps to `spp` samples a pixel: sample 0 from coarse to fine, then 1, 2, 4, 8 … more.
pub(crate) fn steps(spp: u32) -> Vec<Step> {
    let mut steps = GRIDS.map(Step::Grid).to_vec();
    let mut taken = 1;
    while taken < spp {
        let next = (2 * taken).min(spp);
        steps.push(Step::Samples(taken..next));
        taken = next;
    }
    steps
}

/// Everything a tile needs to be traced.
#[derive(Debug)]
pub(crate) struct Shot<'w> {
    /// What is seen.
    pub(crate) world: &'w World,
    /// From where.
    pub(crate) projection: Projection,
    /// How.
    pub(crate) settings: Settings,
}

/// The tiles of a picture, row by row.
#[derive(Debug)]
pub(crate) struct Film {
    size: Size,
    /// Those that a step has come to; there is room for all. A large picture's memory takes long to
    /// be first touched: it is, tile by tile, by the threads that trace.
    tiles: Vec<Tile>,
}

/// Pixels row by row, and the index of the object under each.
#[derive(Debug, Default)]
pub(crate) struct Raster {
    pub(crate) pixels: Vec<[u8; 3]>,
    pub(crate) objects: Vec<u32>,
}

#[derive(Debug)]
struct Tile {
    /// Its top left pixel.
    corner: [u32; 2],
    /// Sums of radiance, row by row; pixels beyond the picture's edge stay 0.
    sums: [Rgb; AREA],
    /// The object under each pixel's centre.
    objects: [u32; AREA],
    /// Spacing of the finest grid traced, while there are no whole samples.
    grid: u32,
    /// Samples that every pixel has.
    samples: u32,
}

impl Film {
    /// An empty film.
    pub(crate) fn new(size: Size) -> Self {
        Self {
            size,
            tiles: Vec::with_capacity(tiles(size)),
        }
    }

    /// How many tiles there are.
    pub(crate) fn tiles(&self) -> usize {
        tiles(self.size)
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
        let size = self.size;
        let new = self.tiles.len()..tiles.end;
        self.tiles
            .par_extend(new.into_par_iter().map(|number| Tile::new(number, size)));
        self.tiles[tiles]
            .par_iter_mut()
            .map_init(
                || Tracer::new(shot.world, shot.settings.depth),
                |tracer, tile| {
                    let before = tracer.counts;
                    tile.advance(size, step, shot, tracer, &cancelled);
                    tracer.counts.since(before)
                },
            )
            .reduce(Counts::default, Counts::and)
    }

    /// The pixels as far as they are known, on the threads of the current pool: where only a coarse
    /// grid is traced, its nearest point up and to the left stands for them. Every tile has been
    /// come to. `None` once `cancelled` says so.
    pub(crate) fn develop(&self, cancelled: impl Fn() -> bool) -> Option<Raster> {
        let count = self.size.pixels();
        let mut raster = Raster {
            pixels: Vec::with_capacity(count),
            objects: Vec::with_capacity(count),
        };
        for start in (0..count).step_by(QUIET) {
            if cancelled() {
                return None;
            }
            let part = start..count.min(start + QUIET);
            let each = || part.clone().into_par_iter().with_min_len(1024);
            raster.pixels.par_extend(each().map(|at| self.pixel(at)));
            raster.objects.par_extend(each().map(|at| self.object(at)));
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

    fn pixel(&self, at: usize) -> [u8; 3] {
        let (tile, pixel) = self.find(at);
        to_bytes(tile.sums[pixel] / f64::from(tile.samples.max(1)))
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
        let across = self.size.width.div_ceil(TILE);
        let tile = &self.tiles[(y / TILE) as usize * across as usize + (x / TILE) as usize];
        (tile, tile.known(x, y))
    }
}

/// How many tiles a picture has.
fn tiles(size: Size) -> usize {
    size.width.div_ceil(TILE) as usize * size.height.div_ceil(TILE) as usize
}

impl Tile {
    /// An empty tile, by its place in the film.
    fn new(number: usize, size: Size) -> Self {
        let across = size.width.div_ceil(TILE) as usize;
        Self {
            corner: [number % across, number / across].map(|tiles| tiles as u32 * TILE),
            sums: [Rgb::ZERO; AREA],
            objects: [NO_OBJECT; AREA],
            grid: GRIDS[0],
            samples: 0,
        }
    }

    fn advance(
        &mut self,
        size: Size,
        step: &Step,
        shot: &Shot<'_>,
        tracer: &mut Tracer<'_>,
        cancelled: &impl Fn() -> bool,
    ) {
        match step {
            &Step::Grid(spacing) => {
                let coarser = 2 * spacing;
                let held =
                    |[x, y]: [u32; 2]| spacing < GRIDS[0] && x % coarser == 0 && y % coarser == 0;
                for pixel in self.pixels(size, spacing).filter(|&pixel| !held(pixel)) {
                    if cancelled() {
                        return;
                    }
                    self.sample(pixel, 0, shot, tracer, cancelled);
                }
                self.grid = spacing;
                self.samples = u32::from(spacing == 1);
            }
            Step::Samples(indices) => {
                for pixel in self.pixels(size, 1) {
                    for index in indices.clone() {
                        if cancelled() {
                            return;
                        }
                        self.sample(pixel, index, shot, tracer, cancelled);
                    }
                }
                self.samples = indices.end;
            }
        }
    }

    /// Adds one sample to its pixel.
    fn sample(
        &mut self,
        [x, y]: [u32; 2],
        index: u32,
        shot: &Shot<'_>,
        tracer: &mut Tracer<'_>,
        cancelled: &impl Fn() -> bool,
    ) {
        let [across, down] = place_in_pixel(x, y, index, shot.settings.seed);
        let (ray, reach) = shot
            .projection
            .ray(f64::from(x) + across, f64::from(y) + down);
        let seen = tracer.radiance(ray, reach, cancelled);
        let at = self.index(x, y);
        self.sums[at] += seen.radiance;
        if index == 0 {
            self.objects[at] = seen.object;
        }
    }

    /// Its pixels within the picture on a grid of some spacing, row by row.
    fn pixels(&self, size: Size, spacing: u32) -> impl Iterator<Item = [u32; 2]> + use<> {
        let [left, top] = self.corner;
        let [right, bottom] = [size.width.min(left + TILE), size.height.min(top + TILE)];
        (top..bottom)
            .step_by(spacing as usize)
            .flat_map(move |y| (left..right).step_by(spacing as usize).map(move |x| [x, y]))
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
        ((y - self.corner[1]) * TILE + (x - self.corner[0])) as usize
    }
}
