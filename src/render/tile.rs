//! A part of the picture under way: what its pixels have gathered.

use super::first_hit::first_hit;
use super::frame::NO_OBJECT;
use super::noise::Doubling;
use super::probe::{Sample, Seen};
use super::shot::Shot;
use super::steps::{COARSEST, Step, samples_at};
use super::touched::Touched;
use super::tracer::Tracer;
use crate::scene::{Rgb, Size};

/// Pixels of a tile.
pub(crate) const AREA: u32 = 256;

/// Pixels along the edges of most tiles; a multiple of the coarsest [`Step::Grid`].
const TILE: u32 = 16;

/// The spacing of no grid.
const NO_GRID: u32 = 2 * COARSEST;

/// The level of pixels beyond the picture's edge, where no step is lacking.
const BEYOND: u8 = u8::MAX;

/// What a thread traces tiles with: room that it keeps from one to the next.
pub(crate) struct Work<'w, C> {
    pub(crate) tracer: Tracer<'w, C>,
    /// The pixels that are sampled.
    pixels: Vec<[u32; 2]>,
    /// A sample of each.
    samples: Vec<Sample>,
    /// What each brings.
    seen: Vec<Seen>,
}

impl<'w, C: Fn() -> bool> Work<'w, C> {
    pub(crate) fn new(tracer: Tracer<'w, C>) -> Self {
        Self {
            tracer,
            pixels: Vec::new(),
            samples: Vec::new(),
            seen: Vec::new(),
        }
    }
}

/// The pixels along a tile's edges, powers of two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TileShape {
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl TileShape {
    /// Squares, unless the picture is narrower or lower than those: what of a tile lies beyond the
    /// picture takes memory too, and grids begin at its edges.
    pub(crate) fn of(size: Size) -> Self {
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

    /// Where a pixel is in a tile with this corner.
    fn index(self, [left, top]: [u32; 2], [x, y]: [u32; 2]) -> usize {
        ((y - top) * self.width + (x - left)) as usize
    }

    /// Tiles along each row of a picture.
    pub(crate) fn across(self, size: Size) -> usize {
        size.width.div_ceil(self.width) as usize
    }

    /// Tiles of a picture.
    pub(crate) fn count(self, size: Size) -> usize {
        self.across(size) * size.height.div_ceil(self.height) as usize
    }
}

/// A part of a picture.
#[derive(Debug)]
pub(crate) struct Tile {
    /// Its top left pixel.
    corner: [u32; 2],
    shape: TileShape,
    /// Sums of radiance, row by row; pixels beyond the picture's edge stay 0.
    sums: [Rgb; AREA as usize],
    /// The object under each pixel's centre.
    objects: [u32; AREA as usize],
    /// How far each pixel is, see [`Step::level`]; 0 if it was not come to, or cancelled on the way.
    levels: [u8; AREA as usize],
    /// Spacing of the finest grid whose pixels are all traced, while not every pixel is.
    grid: u32,
    /// What every pixel has reached, at least.
    level: u8,
    /// The sum of its pixels' squared errors in the last pass that told.
    pub(crate) squared_errors: f64,
    /// Its samples that ran out of their ray budget.
    pub(crate) over_budget: u64,
    /// What it takes to trace some of its pixels anew.
    memory: Option<Box<Memory>>,
}

/// What a tile knows of each pixel beside what is shown.
#[derive(Debug)]
struct Memory {
    /// What all samples of it depend on.
    touched: [Touched; AREA as usize],
    /// Its squared error in the last pass that told.
    squared_errors: [f32; AREA as usize],
}

/// What a tile remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Remembers {
    /// Its pixels.
    Pixels,
    /// And what each of them depends on.
    Causes,
}

impl Tile {
    /// How much memory one takes.
    pub(crate) fn bytes(remembers: Remembers) -> usize {
        let memory = match remembers {
            Remembers::Pixels => 0,
            Remembers::Causes => size_of::<Memory>(),
        };
        size_of::<Self>() + memory
    }

    /// An empty tile, by its place in the film.
    pub(crate) fn new(number: usize, size: Size, shape: TileShape, remembers: Remembers) -> Self {
        let across = shape.across(size);
        let memory = || {
            Box::new(Memory {
                touched: [Touched::default(); AREA as usize],
                squared_errors: [0.0; AREA as usize],
            })
        };
        let mut tile = Self {
            corner: [
                (number % across) as u32 * shape.width,
                (number / across) as u32 * shape.height,
            ],
            shape,
            sums: [Rgb::ZERO; AREA as usize],
            objects: [NO_OBJECT; AREA as usize],
            levels: [BEYOND; AREA as usize],
            grid: NO_GRID,
            level: 0,
            squared_errors: 0.0,
            over_budget: 0,
            memory: (remembers == Remembers::Causes).then(memory),
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

    /// Takes a step with those of its pixels that have yet to take it.
    pub(crate) fn advance<C: Fn() -> bool>(
        &mut self,
        size: Size,
        step: &Step,
        shot: &Shot<'_>,
        work: &mut Work<'_, C>,
    ) {
        if work.tracer.is_cancelled() {
            return;
        }
        let counts = work.tracer.counts();
        let level = step.level();
        work.pixels.clear();
        self.each_pixel(size, step.spacing(), |tile, pixel| {
            let at = tile.index(pixel);
            if tile.levels[at] < level {
                tile.levels[at] = 0;
                work.pixels.push(pixel);
            }
        });
        let doubling = Doubling::of(step, &shot.settings).map(|doubling| (doubling, self.sums));
        for index in step.indices() {
            self.sample(index, shot, work);
            if work.tracer.is_cancelled() {
                return;
            }
        }
        for &pixel in &work.pixels {
            self.levels[self.index(pixel)] = level;
        }
        if let Some((doubling, before)) = doubling {
            self.estimate(doubling, &before, &work.pixels);
        }
        self.over_budget += work.tracer.counts().since(counts).over_budget;
        match *step {
            Step::Grid(spacing) if 1 < spacing => self.grid = spacing,
            Step::Grid(_) | Step::Samples(_) => self.level = level,
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
        shot.samples(pixels, index, samples);
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
        for (&pixel, seen) in pixels.iter().zip(seen) {
            let at = self.index(pixel);
            self.sums[at] += seen.radiance;
            if index == 0 {
                self.objects[at] = seen.object;
            }
            if let Some(memory) = &mut self.memory {
                memory.touched[at] |= seen.touched;
            }
        }
    }

    /// Estimates the errors of pixels whose samples were doubled.
    fn estimate(&mut self, doubling: Doubling, before: &[Rgb; AREA as usize], pixels: &[[u32; 2]]) {
        let mut own = [0.0; AREA as usize];
        let errors = match &mut self.memory {
            Some(memory) => &mut memory.squared_errors,
            None => &mut own,
        };
        for &pixel in pixels {
            let at = self.shape.index(self.corner, pixel);
            errors[at] = doubling.squared_error(before[at], self.sums[at]) as f32;
        }
        self.squared_errors = errors.iter().copied().map(f64::from).sum();
    }

    /// Forgets the pixels that depend on what has changed, and those whose tracing was cancelled.
    pub(crate) fn forget(&mut self, changed: Touched) {
        let memory = self.memory.as_deref();
        let stale: [bool; AREA as usize] = std::array::from_fn(|at| {
            let depends = |memory: &Memory| memory.touched[at].meets(changed);
            self.levels[at] == 0 || memory.is_none_or(depends)
        });
        if !stale.contains(&true) {
            return;
        }
        // Which pixels ran out of their budget is not known.
        let is_whole = 0 < self.over_budget;
        self.over_budget = 0;
        for (at, is_stale) in stale.into_iter().enumerate() {
            if is_whole || is_stale {
                self.forget_pixel(at);
            }
        }
        self.grid = NO_GRID;
        self.level = 0;
    }

    fn forget_pixel(&mut self, at: usize) {
        self.sums[at] = Rgb::ZERO;
        // Beyond the picture's edge there is nothing to be traced.
        if self.levels[at] != BEYOND {
            self.levels[at] = 0;
        }
        if let Some(memory) = &mut self.memory {
            memory.touched[at] = Touched::default();
        }
    }

    /// What a pixel that stands for others holds.
    pub(crate) fn value(&self, at: usize, spp: u32) -> Rgb {
        self.sums[at] / f64::from(samples_at(self.levels[at], spp).max(1))
    }

    pub(crate) fn object(&self, at: usize) -> u32 {
        self.objects[at]
    }

    /// The sums of radiance of all pixels.
    pub(crate) fn sums(&self) -> [Rgb; AREA as usize] {
        self.sums
    }

    /// Visits its pixels within the picture on a grid of some spacing, in blocks of four by two: those
    /// that stand side by side are traced side by side.
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

    /// Where the pixel that stands for (x, y) is: while that is not traced, the nearest one of the grid
    /// up and to the left.
    pub(crate) fn known(&self, [x, y]: [u32; 2]) -> usize {
        let at = self.index([x, y]);
        if self.levels[at] == 0 {
            self.index([x - x % self.grid, y - y % self.grid])
        } else {
            at
        }
    }

    fn index(&self, pixel: [u32; 2]) -> usize {
        self.shape.index(self.corner, pixel)
    }
}
