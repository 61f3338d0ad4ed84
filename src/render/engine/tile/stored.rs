//! Tiles as bytes, with integers and floats in little-endian order: sums as 3 f64 a pixel, indices of
//! objects as u32, levels as u8, the level of the tile as u8, the sum of squared errors as f64, samples
//! over budget as u64, and with [`super::Memory`] the touched sets as u64, squared errors and variances
//! as f32 and rays as u32.
//!
//! The grid is not stored: a tile that lacks a sample of a pixel takes the grids again.

use super::{AREA, BEYOND, NO_GRID, Remembers, Tile};
use crate::engine::pass_schedule::Step;
use crate::job::NO_OBJECT;
use crate::world::Dependencies;
use scene::Rgb;

/// Bytes of a pixel and of what is remembered of it.
const PIXEL: usize = 3 * 8 + 4 + 1;
const MEMORY: usize = 8 + 4 + 4 + 4;

impl Tile {
    /// The number of bytes of a stored tile.
    pub(crate) fn stored_bytes(remembers: Remembers) -> usize {
        let memory = match remembers {
            Remembers::Pixels => 0,
            Remembers::Causes => MEMORY,
        };
        AREA as usize * (PIXEL + memory) + 1 + 8 + 8
    }

    /// Appends its bytes.
    pub(crate) fn store(&self, bytes: &mut Vec<u8>) {
        for sum in &self.sums {
            bytes.extend(sum.to_array().map(f64::to_le_bytes).as_flattened());
        }
        bytes.extend(self.objects.map(u32::to_le_bytes).as_flattened());
        bytes.extend(self.levels);
        bytes.push(self.level);
        bytes.extend(self.squared_errors.to_le_bytes());
        bytes.extend(self.over_budget.to_le_bytes());
        if let Some(memory) = &self.memory {
            let touched = memory.touched.map(|touched| touched.bits().to_le_bytes());
            bytes.extend(touched.as_flattened());
            bytes.extend(memory.squared_errors.map(f32::to_le_bytes).as_flattened());
            bytes.extend(memory.variances.map(f32::to_le_bytes).as_flattened());
            bytes.extend(memory.rays.map(u32::to_le_bytes).as_flattened());
        }
    }

    /// Fills an empty tile with what was stored of a picture of `spp` samples a pixel, in a scene with
    /// this number of objects. `None` if the bytes are no such tile.
    pub(crate) fn restored(mut self, mut bytes: &[u8], spp: u32, objects: usize) -> Option<Self> {
        let last = Step::Samples(0..spp).level();
        for sum in &mut self.sums {
            let mut channel = || next(&mut bytes).map(f64::from_le_bytes);
            *sum = Rgb::new(channel()?, channel()?, channel()?);
        }
        for object in &mut self.objects {
            *object = u32::from_le_bytes(next(&mut bytes)?);
            if *object != NO_OBJECT && objects <= *object as usize {
                return None;
            }
        }
        for level in &mut self.levels {
            let [stored] = next(&mut bytes)?;
            // Pixels beyond the edge are the same in all tiles with this number.
            if (*level == BEYOND) != (stored == BEYOND) || stored != BEYOND && last < stored {
                return None;
            }
            *level = stored;
        }
        [self.level] = next(&mut bytes)?;
        if last < self.level {
            return None;
        }
        self.grid = NO_GRID;
        self.squared_errors = f64::from_le_bytes(next(&mut bytes)?);
        self.over_budget = u64::from_le_bytes(next(&mut bytes)?);
        if let Some(memory) = &mut self.memory {
            for touched in &mut memory.touched {
                *touched = Dependencies::of_bits(u64::from_le_bytes(next(&mut bytes)?));
            }
            for error in &mut memory.squared_errors {
                *error = f32::from_le_bytes(next(&mut bytes)?);
            }
            for variance in &mut memory.variances {
                *variance = f32::from_le_bytes(next(&mut bytes)?);
            }
            for rays in &mut memory.rays {
                *rays = u32::from_le_bytes(next(&mut bytes)?);
            }
        }
        bytes.is_empty().then_some(self)
    }
}

#[cfg(test)]
impl Tile {
    /// Whether it has sums of pixels whose tracing was cancelled.
    pub(crate) fn has_leftovers(&self) -> bool {
        let mut pixels = self.levels.iter().zip(&self.sums);
        pixels.any(|(&level, &sum)| level == 0 && sum != Rgb::ZERO)
    }
}

/// Takes the first bytes.
fn next<const N: usize>(bytes: &mut &[u8]) -> Option<[u8; N]> {
    let (first, rest) = bytes.split_first_chunk()?;
    *bytes = rest;
    Some(*first)
}
