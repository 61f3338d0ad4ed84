//! Shards: which blocks of a picture are whose.

use std::fmt;

use crate::render::Blocks;

/// The most shards of a picture.
pub const MOST_SHARDS: u32 = 1 << 20;

/// One of the shards into which the blocks of a picture are dealt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Its index, from 0.
    pub index: u32,
    /// The number of shards.
    pub count: u32,
}

impl Shard {
    /// The only shard of a picture.
    pub const WHOLE: Self = Self { index: 0, count: 1 };

    /// Parses `K/N`, with K from 0 to N − 1.
    pub fn parse(said: &str) -> Option<Self> {
        let number = |digits: &str| {
            let plain = digits.bytes().all(|byte| byte.is_ascii_digit());
            digits.parse().ok().filter(|_: &u32| plain)
        };
        let (index, count) = said.split_once('/')?;
        let (index, count) = (number(index)?, number(count)?);
        (index < count && count <= MOST_SHARDS).then_some(Self { index, count })
    }

    /// The blocks that are dealt to it, in ascending order.
    pub fn blocks(self, blocks: Blocks) -> Vec<u32> {
        deal(blocks, self.count)
            .enumerate()
            .filter(|&(_, owner)| owner == self.index)
            .map(|(number, _)| number as u32)
            .collect()
    }
}

/// As [`Shard::parse`] reads it.
impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// The index of the shard that each block is dealt to, by its number.
///
/// Blocks are dealt along a curve on which neighbours are close in the picture, one to each shard in
/// turn, so that each gets as much of every part of it. The turn starts elsewhere each time, because
/// otherwise shards would be a regular pattern, of which one may have all the blocks with, say, a
/// horizon. Measured at 3840×2160, the costs of shards differ less than those of rows, columns,
/// diagonals or a random order.
pub(super) fn deal(blocks: Blocks, shards: u32) -> impl Iterator<Item = u32> {
    let mut along: Vec<_> = (0..blocks.count()).collect();
    let across = blocks.across();
    along.sort_by_cached_key(|number| interleaved(number % across, number / across));
    let mut owners = vec![0; along.len()];
    for (turn, numbers) in (0_u32..).zip(along.chunks(shards as usize)) {
        for (place, &number) in (0_u32..).zip(numbers) {
            owners[number as usize] = (place + scattered(turn)) % shards;
        }
    }
    owners.into_iter()
}

/// The place on the Z-order curve (Morton, 1966): the bits of both coordinates in turn.
fn interleaved(x: u32, y: u32) -> u64 {
    (0..32).fold(0, |key, bit| {
        let bits = u64::from(x >> bit & 1) | u64::from(y >> bit & 1) << 1;
        key | bits << (2 * bit)
    })
}

/// Fibonacci hashing (Knuth, The Art of Computer Programming 6.4).
fn scattered(number: u32) -> u32 {
    number.wrapping_mul(0x9E37_79B9) >> 8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Size;

    #[test]
    fn shards_are_read_as_they_are_written() {
        for (said, written) in [
            ("0/1", Some("0/1")),
            ("63/64", Some("63/64")),
            ("64/64", None),
            ("0/0", None),
            ("-1/4", None),
            ("+1/4", None),
            ("1", None),
            ("1/4/5", None),
            ("1/4294967296", None),
            ("1/1048577", None),
            ("", None),
        ] {
            let shard = Shard::parse(said).map(|shard| shard.to_string());
            assert_eq!(shard.as_deref(), written, "{said:?}");
        }
    }

    #[test]
    fn every_block_is_dealt_once_and_shards_differ_by_few() {
        for (width, height) in [(1, 1), (33, 65), (800, 600), (5000, 1), (1, 5000)] {
            let blocks = Blocks::of(Size { width, height });
            for count in [1, 2, 3, 7, 64, 1000] {
                let shards = (0..count).map(|index| Shard { index, count }.blocks(blocks));
                let shards: Vec<_> = shards.collect();
                let mut all = shards.concat();
                all.sort_unstable();
                assert_eq!(all, (0..blocks.count()).collect::<Vec<_>>());
                let sizes = || shards.iter().map(Vec::len);
                let least = blocks.count() / count;
                assert!(sizes().all(|size| size as u32 - least <= 1));
            }
        }
    }
}
