//! A tile in the middle of a step that is taken in parts.

use super::{AREA, Tile};
use scene::Rgb;

/// The pixels of a tile as they were before the step, which are shown, and those that take it.
#[derive(Debug)]
pub(super) struct PartialPass {
    pub(super) pixels: Vec<[u32; 2]>,
    pub(super) sums: [Rgb; AREA as usize],
    levels: [u8; AREA as usize],
    /// Empty where they are not recorded.
    rays: Vec<u32>,
    over_budget: u64,
}

impl Tile {
    /// The most bytes that a tile has more between the parts of a step.
    pub(crate) fn partial_pass_bytes() -> usize {
        size_of::<PartialPass>() + AREA as usize * (size_of::<[u32; 2]>() + size_of::<u32>())
    }

    /// Stores the pixels as they are.
    pub(super) fn start_partial_pass(&self) -> Box<PartialPass> {
        let memory = self.memory.as_ref();
        Box::new(PartialPass {
            pixels: Vec::new(),
            sums: self.sums,
            levels: self.levels,
            rays: memory.map_or(Vec::new(), |memory| memory.rays.to_vec()),
            over_budget: self.counts.over_budget,
        })
    }

    /// Undoes the parts taken of a step that is not finished.
    pub(crate) fn revert(&mut self) {
        let Some(partial_pass) = self.partial_pass.take() else {
            return;
        };
        self.sums = partial_pass.sums;
        self.levels = partial_pass.levels;
        self.counts.over_budget = partial_pass.over_budget;
        if let Some(memory) = &mut self.memory {
            memory.rays.copy_from_slice(&partial_pass.rays);
        }
    }

    /// The sum and the level of a pixel, and the rays traced for it, 0 where they are not recorded:
    /// those before a step that is not finished.
    pub(super) fn shown(&self, at: usize) -> (Rgb, u8, u32) {
        let rays = |memory: &super::Memory| memory.rays[at];
        if let Some(partial_pass) = &self.partial_pass {
            let rays = partial_pass.rays.get(at).copied();
            return (
                partial_pass.sums[at],
                partial_pass.levels[at],
                rays.unwrap_or(0),
            );
        }
        let rays = self.memory.as_deref().map_or(0, rays);
        (self.sums[at], self.levels[at], rays)
    }
}
