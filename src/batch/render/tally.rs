//! How far the blocks of a part are traced.

use std::collections::BTreeMap;

use render::{Block, Blocks, Counts};

/// How far all blocks of a part are traced.
pub(super) struct Tally {
    /// Samples of each pixel to reach.
    spp: u32,
    blocks: Blocks,
    /// The samples of each block, and the rays of those that are to be continued.
    reached: BTreeMap<u32, (u32, Counts)>,
    /// How many blocks have reached each number of samples.
    levels: BTreeMap<u32, usize>,
    /// Samples of all blocks to take, and taken, before too.
    pub(super) all: u64,
    pub(super) taken: u64,
    /// Rays traced since it began.
    pub(super) counts: Counts,
}

impl Tally {
    /// Begins with blocks of some samples.
    pub(super) fn new(
        spp: u32,
        blocks: Blocks,
        begun: impl Iterator<Item = (u32, u32, Counts)>,
    ) -> Self {
        let mut tally = Self {
            spp,
            blocks,
            reached: BTreeMap::new(),
            levels: BTreeMap::new(),
            all: 0,
            taken: 0,
            counts: Counts::default(),
        };
        for (number, samples, counts) in begun {
            let (samples, area) = (samples.min(spp), blocks.area(number) as u64);
            tally.all += u64::from(spp) * area;
            tally.taken += u64::from(samples) * area;
            tally.reached.insert(number, (samples, counts));
            *tally.levels.entry(samples).or_default() += 1;
        }
        tally
    }

    pub(super) fn add(&mut self, block: &Block) {
        let now = (block.samples, block.counts);
        let (samples, counts) = self.reached.insert(block.number, now).unwrap_or_default();
        let taken = u64::from(block.samples - samples);
        self.taken += taken * self.blocks.area(block.number) as u64;
        self.counts = self.counts.and(block.counts.since(counts));
        if let Some(blocks) = self.levels.get_mut(&samples) {
            *blocks -= 1;
            if *blocks == 0 {
                self.levels.remove(&samples);
            }
        }
        *self.levels.entry(block.samples).or_default() += 1;
    }

    /// Samples that every pixel has.
    pub(super) fn least(&self) -> u32 {
        let least = self.levels.first_key_value();
        least.map_or(self.spp, |(&samples, _)| samples)
    }

    /// The share of all the work that is done, 0 to 1.
    pub(super) fn done(&self) -> f64 {
        self.taken as f64 / self.all.max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use scene::Size;

    #[test]
    fn what_was_traced_before_counts_as_done() {
        let size = Size {
            width: 96,
            height: 32,
        };
        let blocks = Blocks::of(size);
        let counts = |rays| Counts {
            rays,
            ..Counts::default()
        };
        let traced = |number, samples, rays| Block {
            samples,
            counts: counts(rays),
            ..Block::new(number, blocks)
        };
        // One block is complete, one is begun.
        let begun = [
            (0, 8, Counts::default()),
            (1, 4, counts(40)),
            (2, 0, counts(0)),
        ];
        let mut tally = Tally::new(8, blocks, begun.into_iter());
        assert_eq!(
            (tally.done(), tally.least(), tally.counts.rays),
            (0.5, 0, 0)
        );
        tally.add(&traced(2, 4, 50));
        assert_eq!((tally.least(), tally.counts.rays), (4, 50));
        tally.add(&traced(1, 8, 80));
        tally.add(&traced(2, 8, 90));
        assert_eq!(
            (tally.done(), tally.least(), tally.counts.rays),
            (1.0, 8, 130)
        );
    }
}
