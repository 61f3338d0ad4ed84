//! A picture as far as it is traced, kept to be continued: by the next job, or as bytes by another
//! renderer.
//!
//! The bytes, with integers and floats in little-endian order: samples asked for of each pixel as
//! u32, what tiles remember as u8 (0 or 1), number of tiles as u32, time spent as u64 seconds and u32
//! nanoseconds, rays, shadow rays and samples over budget as u64, then the tiles begun, in rows.

use std::io::{self, ErrorKind, Read, Write};
use std::time::Duration;

use super::tile::{Remembers, Tile, TileShape};
use crate::integrators::Counts;
use crate::job::Job;
use scene::{MAX_SPP, Size};

/// Tiles freed at once: about 4 MB, in less than 1 ms.
const FREED: usize = 512;

/// Bytes before the tiles.
const HEAD: usize = 4 + 1 + 4 + 8 + 4 + 3 * 8;

/// A picture as far as it is traced, in which tiles may be unfinished.
#[derive(Debug)]
pub struct Kept {
    pub(crate) size: Size,
    /// The samples of each pixel that it was traced to.
    pub(crate) spp: u32,
    pub(crate) remembers: Remembers,
    /// The tiles begun, in rows.
    pub(crate) tiles: Vec<Tile>,
    pub(crate) effort: Effort,
}

/// The work that a picture took: of its job, and of those that it continues.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Effort {
    /// Without pauses.
    pub(crate) time: Duration,
    pub(crate) counts: Counts,
}

impl Kept {
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
        self.effort.time
    }

    /// The number of pixels.
    pub(crate) fn pixels(&self) -> usize {
        self.size.pixels()
    }

    /// Writes its bytes, tile by tile.
    pub fn write(&self, out: &mut impl Write) -> io::Result<()> {
        let mut bytes = Vec::with_capacity(Tile::stored_bytes(self.remembers));
        bytes.extend(self.spp.to_le_bytes());
        bytes.push(u8::from(self.remembers == Remembers::Causes));
        // Bounded by the number of pixels, of which a kept picture has fewer.
        bytes.extend((self.tiles.len() as u32).to_le_bytes());
        let Effort { time, counts } = self.effort;
        bytes.extend(time.as_secs().to_le_bytes());
        bytes.extend(time.subsec_nanos().to_le_bytes());
        let counts = [counts.rays, counts.shadow_rays, counts.over_budget];
        bytes.extend(counts.map(u64::to_le_bytes).as_flattened());
        out.write_all(&bytes)?;
        for tile in &self.tiles {
            bytes.clear();
            tile.store(&mut bytes);
            out.write_all(&bytes)?;
        }
        Ok(())
    }

    /// Reads a picture that the job can continue, if it was traced from the same scene with the same
    /// camera and settings. Needs as much memory as the job's film.
    ///
    /// # Errors
    ///
    /// Besides errors in reading, fails with [`ErrorKind::InvalidData`] for bytes that are no picture
    /// of the job's size, and with [`ErrorKind::OutOfMemory`].
    pub fn read(from: &mut impl Read, job: &Job) -> io::Result<Self> {
        let mut head = [0; HEAD];
        from.read_exact(&mut head)?;
        let mut head = &head[..];
        let spp = u32::from_le_bytes(next(&mut head)?);
        let remembers = match next(&mut head)? {
            [0] => Remembers::Pixels,
            [1] => Remembers::Causes,
            _ => return Err(ErrorKind::InvalidData.into()),
        };
        let count = u32::from_le_bytes(next(&mut head)?) as usize;
        let seconds = u64::from_le_bytes(next(&mut head)?);
        let nanoseconds = u32::from_le_bytes(next(&mut head)?);
        let mut counter = || next(&mut head).map(u64::from_le_bytes);
        let counts = Counts {
            rays: counter()?,
            shadow_rays: counter()?,
            over_budget: counter()?,
        };
        let size = job.settings.traced().size();
        let shape = TileShape::of(size);
        let is_one = (1..=MAX_SPP).contains(&spp)
            && remembers.suffices(Remembers::of(&job.settings, job.frames, job.denoise))
            && count <= shape.count(size)
            && nanoseconds < 1_000_000_000;
        if !is_one {
            return Err(ErrorKind::InvalidData.into());
        }
        let mut tiles = Vec::new();
        // Untouched memory: tiles not begun are added later.
        tiles.try_reserve_exact(shape.count(size))?;
        let mut bytes = vec![0; Tile::stored_bytes(remembers)];
        let objects = job.scene.objects.len();
        for number in 0..count {
            from.read_exact(&mut bytes)?;
            let empty = Tile::new(number, size, shape, remembers);
            let tile = empty.restored(&bytes, spp, objects);
            tiles.push(tile.ok_or(ErrorKind::InvalidData)?);
        }
        Ok(Self {
            size,
            spp,
            remembers,
            tiles,
            effort: Effort {
                time: Duration::new(seconds, nanoseconds),
                counts,
            },
        })
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

/// Takes the first bytes.
fn next<const N: usize>(bytes: &mut &[u8]) -> io::Result<[u8; N]> {
    let (first, rest) = bytes.split_first_chunk().ok_or(ErrorKind::InvalidData)?;
    *bytes = rest;
    Ok(*first)
}
