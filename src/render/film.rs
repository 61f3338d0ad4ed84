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
    tiles: Vec<Tile>,
}

#[derive(Clone, Debug)]
struct Tile {
    /// Its top left pixel.
    corner: [u32; 2],
    /// Sums of radiance, row by row; pixels beyond the picture's edge stay 0.
    sums: Box<[Rgb]>,
    /// The object under each pixel's centre.
    objects: Box<[u32]>,
    /// Spacing of the finest grid traced, while there are no whole samples.
    grid: u32,
    /// Samples that every pixel has.
    samples: u32,
}

impl Film {
    /// An empty film.
    pub(crate) fn new(size: Size) -> Self {
        let area = (TILE * TILE) as usize;
        let corners = (0..size.height)
            .step_by(TILE as usize)
            .flat_map(|y| (0..size.width).step_by(TILE as usize).map(move |x| [x, y]));
        let tiles = corners.map(|corner| Tile {
            corner,
            sums: vec![Rgb::ZERO; area].into(),
            objects: vec![NO_OBJECT; area].into(),
            grid: GRIDS[0],
            samples: 0,
        });
        Self {
            size,
            tiles: tiles.collect(),
        }
    }

    /// How many tiles there are.
    pub(crate) fn tiles(&self) -> usize {
        self.tiles.len()
    }

    /// Takes one step in some of the tiles, on the threads of the current pool. Once `cancelled`
    /// says so it stops, and the film is of no more use.
    pub(crate) fn advance(
        &mut self,
        tiles: Range<usize>,
        step: &Step,
        shot: &Shot<'_>,
        cancelled: impl Fn() -> bool + Sync,
    ) -> Counts {
        let size = self.size;
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

    /// The pixels as far as they are known: where only a coarse grid is traced, its nearest point
    /// up and to the left stands for them.
    pub(crate) fn develop(&self) -> (Vec<[u8; 3]>, Vec<u32>) {
        let mut pixels = vec![[0; 3]; self.size.pixels()];
        let mut objects = vec![NO_OBJECT; self.size.pixels()];
        for tile in &self.tiles {
            for [x, y] in tile.pixels(self.size, 1) {
                let at = y as usize * self.size.width as usize + x as usize;
                (pixels[at], objects[at]) = tile.pixel(x, y);
            }
        }
        (pixels, objects)
    }
}

impl Tile {
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
        let ray = shot
            .projection
            .ray(f64::from(x) + across, f64::from(y) + down);
        let seen = tracer.radiance(ray, cancelled);
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

    fn pixel(&self, x: u32, y: u32) -> ([u8; 3], u32) {
        let at = if self.samples == 0 {
            self.index(x - x % self.grid, y - y % self.grid)
        } else {
            self.index(x, y)
        };
        let mean = self.sums[at] / f64::from(self.samples.max(1));
        (to_bytes(mean), self.objects[at])
    }

    fn index(&self, x: u32, y: u32) -> usize {
        ((y - self.corner[1]) * TILE + (x - self.corner[0])) as usize
    }
}
