//! The numbers of the frames to render.

use shards::Shard;

/// Numbers of frames in ascending order, equally far apart. Takes no memory for each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Numbers {
    first: u32,
    step: u32,
    /// How many there are.
    pub(super) count: u32,
}

impl Numbers {
    /// The numbers from the first to the last, which is below [`u32::MAX`].
    pub(super) fn within([first, last]: [u32; 2]) -> Self {
        Self {
            first,
            step: 1,
            count: (last + 1).saturating_sub(first),
        }
    }

    /// The numbers from the first to the last that leave the shard's index when divided by the number of
    /// shards.
    pub(super) fn of_shard(self, Shard { index, count }: Shard) -> Self {
        let skipped = (index + count - self.first % count) % count;
        Self {
            first: self.first.saturating_add(skipped),
            step: count,
            count: self.count.saturating_sub(skipped).div_ceil(count),
        }
    }

    /// All of them.
    pub(super) fn iter(self) -> impl Iterator<Item = u32> {
        (0..self.count).map(move |at| self.first + at * self.step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_divide_the_numbers() {
        for [first, last] in [[0, 0], [0, 9], [3, 17], [999_990, 999_999]] {
            let all = Numbers::within([first, last]);
            assert!(all.iter().eq(first..=last));
            for count in [1, 2, 7, 20] {
                for index in 0..count {
                    let numbers = all.of_shard(Shard { index, count });
                    let expected = (first..=last).filter(|number| number % count == index);
                    assert!(numbers.iter().eq(expected), "{index}/{count} of {all:?}");
                }
            }
        }
        assert_eq!(Numbers::within([0, u32::MAX - 1]).count, u32::MAX);
    }
}
