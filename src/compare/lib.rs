//! Two pictures against each other: which pixels differ, by how much, and how visibly. Knows no
//! files and no scenes.

mod blur;
mod flip;
mod heat;
mod ssim;

use blur::Plane;
use scene::{Image, Size};

pub use heat::heat_map;

/// The number of worst pixels that are listed.
const WORST: usize = 10;

/// The edge length of the tiles of which each lists one pixel, so that the worst are not neighbours.
const TILE: u32 = 16;

/// How two pictures of the same size differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The size of both pictures.
    pub size: Size,
    /// The number of pixels with a channel that differs by more levels than the tolerance.
    pub differing: usize,
    /// The largest difference of a channel, in levels from 0 to 255.
    pub largest: u8,
    /// The mean squared difference of all channels, in squared levels.
    pub mse: f64,
    /// The mean structural similarity, 1 for equal pictures; see [`ssim`]. `None` for pictures that
    /// are narrower or lower than its window of 11 pixels.
    pub ssim: Option<f64>,
    /// The mean visible difference, 0 to 1; see [`flip`].
    pub flip: f64,
    /// The worst pixels, worst first; at most ten, from different tiles of 16 × 16 pixels.
    pub worst: Vec<Difference>,
}

/// A pixel that differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Column from the left.
    pub x: u32,
    /// Row from the top.
    pub y: u32,
    /// Its colours in both pictures.
    pub colours: [[u8; 3]; 2],
}

impl Difference {
    /// The largest difference of a channel, in levels.
    pub fn largest(&self) -> u8 {
        let [a, b] = self.colours;
        levels(a, b).into_iter().max().unwrap_or(0)
    }
}

/// Pictures of different sizes cannot be compared pixel by pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SizesDiffer(pub [Size; 2]);

/// A picture that others are compared with: what the figures need of it is computed once, and takes about
/// 115 bytes per pixel.
#[derive(Debug)]
pub struct Reference {
    image: Image,
    seen: flip::Seen,
    moments: [ssim::Moments; 3],
}

impl Reference {
    /// Prepares a picture.
    pub fn new(image: Image) -> Self {
        Self {
            seen: flip::Seen::of(&image),
            moments: [0, 1, 2].map(|channel| ssim::Moments::of(&image, channel)),
            image,
        }
    }

    /// The picture itself.
    pub fn image(&self) -> &Image {
        &self.image
    }

    /// Compares a picture with it, as [`Comparison::of`] does.
    ///
    /// # Errors
    ///
    /// Fails if their sizes differ.
    pub fn compared(&self, other: &Image, tolerance: u8) -> Result<Comparison, SizesDiffer> {
        let similarity = |channel: usize| {
            ssim::of_channel(&self.moments[channel], &ssim::Moments::of(other, channel))
        };
        let flip = || flip::mean(&self.seen, &flip::Seen::of(other));
        Comparison::with([&self.image, other], tolerance, similarity, flip)
    }
}

impl Comparison {
    /// Compares two pictures. Pixels count as differing if a channel does by more than `tolerance`
    /// levels; the other figures do not depend on it.
    ///
    /// # Errors
    ///
    /// Fails if their sizes differ.
    pub fn of(a: &Image, b: &Image, tolerance: u8) -> Result<Self, SizesDiffer> {
        let similarity = |channel: usize| {
            let [a, b] = [a, b].map(|image| ssim::Moments::of(image, channel));
            ssim::of_channel(&a, &b)
        };
        let flip = || flip::mean(&flip::Seen::of(a), &flip::Seen::of(b));
        Self::with([a, b], tolerance, similarity, flip)
    }

    fn with(
        [a, b]: [&Image; 2],
        tolerance: u8,
        similarity: impl Fn(usize) -> Plane,
        flip: impl FnOnce() -> f64,
    ) -> Result<Self, SizesDiffer> {
        let size = a.size();
        if size != b.size() {
            return Err(SizesDiffer([size, b.size()]));
        }
        let pairs = || a.pixels().iter().zip(b.pixels());
        let mut differing = 0;
        let mut largest = 0;
        let mut squares = 0_u64;
        for (a, b) in pairs() {
            let levels = levels(*a, *b);
            let most = levels.into_iter().max().unwrap_or(0);
            differing += usize::from(tolerance < most);
            largest = largest.max(most);
            squares += levels
                .map(|level| u64::from(level).pow(2))
                .iter()
                .sum::<u64>();
        }
        Ok(Self {
            size,
            differing,
            largest,
            mse: squares as f64 / (3 * size.pixels()) as f64,
            ssim: ssim::mean(similarity),
            flip: if largest == 0 { 0.0 } else { flip() },
            worst: worst(a, b),
        })
    }

    /// The peak signal-to-noise ratio in decibels, infinite for equal pictures.
    pub fn psnr(&self) -> f64 {
        20.0 * 255_f64.log10() - 10.0 * self.mse.log10()
    }

    /// The number of differing pixels in words, with their share.
    pub fn differing_words(&self) -> String {
        let count = self.size.pixels();
        let percent = 100.0 * self.differing as f64 / count as f64;
        format!("{} of {count} ({percent:.2} %)", self.differing)
    }

    /// The other figures in words, by their names.
    pub fn figures(&self) -> [(&'static str, String); 5] {
        let ssim = self.ssim.map_or_else(
            || "none: below 11 pixels wide or high".to_owned(),
            |ssim| format!("{ssim:.5}"),
        );
        [
            ("largest", format!("{} of 255", self.largest)),
            ("MSE", format!("{:.4}", self.mse)),
            ("PSNR", format!("{:.2} dB", self.psnr())),
            ("SSIM", ssim),
            ("FLIP", format!("{:.5}", self.flip)),
        ]
    }
}

/// The difference of each channel, in levels.
fn levels(a: [u8; 3], b: [u8; 3]) -> [u8; 3] {
    std::array::from_fn(|channel| a[channel].abs_diff(b[channel]))
}

/// The worst pixel of each of the worst tiles. Of equally bad ones the first, row by row.
fn worst(a: &Image, b: &Image) -> Vec<Difference> {
    let badness = |found: &Difference| {
        let levels = levels(found.colours[0], found.colours[1]);
        let sum: u16 = levels.into_iter().map(u16::from).sum();
        (levels.into_iter().max(), sum)
    };
    let width = a.size().width;
    let across = width.div_ceil(TILE);
    let mut tiles = vec![None::<Difference>; (across * a.size().height.div_ceil(TILE)) as usize];
    let places = (0..).flat_map(|y| (0..width).map(move |x| (x, y)));
    for ((x, y), (a, b)) in places.zip(a.pixels().iter().zip(b.pixels())) {
        if a == b {
            continue;
        }
        let colours = [*a, *b];
        let found = Difference { x, y, colours };
        let tile = &mut tiles[(y / TILE * across + x / TILE) as usize];
        if tile.is_none_or(|worst| badness(&worst) < badness(&found)) {
            *tile = Some(found);
        }
    }
    let mut worst: Vec<_> = tiles.into_iter().flatten().collect();
    worst.sort_by_key(|found| (std::cmp::Reverse(badness(found)), found.y, found.x));
    worst.truncate(WORST);
    worst
}

#[cfg(test)]
mod tests;
