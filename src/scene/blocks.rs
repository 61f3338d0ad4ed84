//! Long lists of a scene, in blocks shared between scenes: changing one object of a million, or its
//! material, copies only a block.

use std::ops::{Index, Range};
use std::sync::Arc;

use rayon::prelude::*;

/// Items per block.
pub(crate) const BLOCK: usize = 1024;

/// A list. Clones share blocks until they are changed.
#[derive(Clone, Debug)]
pub struct Blocks<T> {
    /// All full except the last, which is never empty.
    blocks: Vec<Arc<[T]>>,
}

impl<T> Blocks<T> {
    /// Creates a list from blocks, all full except the last, which is not empty.
    pub(crate) fn of_blocks(blocks: Vec<Arc<[T]>>) -> Self {
        debug_assert!(
            blocks
                .iter()
                .rev()
                .skip(1)
                .all(|block| block.len() == BLOCK)
                && blocks
                    .last()
                    .is_none_or(|block| (1..=BLOCK).contains(&block.len())),
            "an item is found by its number"
        );
        Self { blocks }
    }

    /// The blocks in order.
    pub(crate) fn blocks(&self) -> &[Arc<[T]>] {
        &self.blocks
    }

    /// The number of items.
    pub fn len(&self) -> usize {
        let Some((last, full)) = self.blocks.split_last() else {
            return 0;
        };
        full.len() * BLOCK + last.len()
    }

    /// Whether the list is empty.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Returns the item at an index.
    pub fn get(&self, number: usize) -> Option<&T> {
        self.blocks.get(number / BLOCK)?.get(number % BLOCK)
    }

    /// Iterates over all items in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.blocks.iter().flat_map(|block| block.iter())
    }

    /// Indices at which two lists differ according to `is_other`, in ascending order, up to the
    /// length of the shorter list. Shared blocks are skipped.
    pub fn differences<'a>(
        &'a self,
        other: &'a Self,
        is_other: impl Fn(&T, &T) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = usize> + 'a {
        let blocks = self.blocks.iter().zip(&other.blocks).enumerate();
        let unshared = blocks.filter(|(_, (one, other))| !Arc::ptr_eq(one, other));
        unshared.flat_map(move |(number, (one, other))| {
            let pairs = (number * BLOCK..).zip(one.iter().zip(other.iter()));
            pairs.filter_map(move |(number, (one, other))| is_other(one, other).then_some(number))
        })
    }
}

impl<T: Sync + Send> Blocks<T> {
    /// Iterates in parallel over all items and their indices, in order.
    pub(crate) fn par_numbered(&self) -> impl ParallelIterator<Item = (usize, &T)> {
        /// Blocks per task of a parallel walk over all items.
        const TASK: usize = 8;
        let blocks = self.blocks.par_iter().with_min_len(TASK).enumerate();
        blocks.flat_map_iter(|(number, block)| (number * BLOCK..).zip(block.iter()))
    }
}

impl<T: Clone> Blocks<T> {
    /// Replaces a range of items, which must be one of the list. Copies only the blocks of the
    /// range if as many items take its place, otherwise also all those behind it.
    pub(crate) fn replace(&mut self, range: Range<usize>, items: Vec<T>) {
        if range.len() == items.len() {
            let mut items = items.into_iter();
            let mut at = range.start;
            while at < range.end {
                let within = at % BLOCK..(at % BLOCK + range.end - at).min(BLOCK);
                at += within.len();
                let block = Arc::make_mut(&mut self.blocks[(at - 1) / BLOCK]);
                let places = block[within].iter_mut();
                places
                    .zip(&mut items)
                    .for_each(|(place, item)| *place = item);
            }
            return;
        }
        let first = range.start / BLOCK;
        let behind = self.blocks.split_off(first);
        let old = || behind.iter().flat_map(|block| block.iter());
        let before = old().take(range.start - first * BLOCK).cloned();
        let after = old().skip(range.end - first * BLOCK).cloned();
        let replaced: Self = before.chain(items).chain(after).collect();
        self.blocks.extend(replaced.blocks);
    }
}

#[cfg(test)]
impl<T: Clone> Blocks<T> {
    /// Edits the list as a whole.
    pub(crate) fn edit(&mut self, edit: impl FnOnce(&mut Vec<T>)) {
        let mut items = self.iter().cloned().collect();
        edit(&mut items);
        *self = items.into();
    }
}

impl<T> Default for Blocks<T> {
    fn default() -> Self {
        Self { blocks: Vec::new() }
    }
}

impl<T> Index<usize> for Blocks<T> {
    type Output = T;

    #[inline]
    fn index(&self, number: usize) -> &T {
        &self.blocks[number / BLOCK][number % BLOCK]
    }
}

#[cfg(test)]
impl<T: Clone> std::ops::IndexMut<usize> for Blocks<T> {
    fn index_mut(&mut self, number: usize) -> &mut T {
        &mut Arc::make_mut(&mut self.blocks[number / BLOCK])[number % BLOCK]
    }
}

impl<T: PartialEq> PartialEq for Blocks<T> {
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && self.differences(other, T::ne).next().is_none()
    }
}

impl<T> FromIterator<T> for Blocks<T> {
    fn from_iter<I: IntoIterator<Item = T>>(items: I) -> Self {
        let mut items = items.into_iter().fuse();
        let blocks = std::iter::from_fn(|| {
            let block: Arc<[T]> = items.by_ref().take(BLOCK).collect();
            (!block.is_empty()).then_some(block)
        });
        Self::of_blocks(blocks.collect())
    }
}

impl<T> From<Vec<T>> for Blocks<T> {
    fn from(items: Vec<T>) -> Self {
        items.into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn numbers(count: usize) -> Vec<usize> {
        (0..count).collect()
    }

    #[test]
    fn a_list_equals_the_items_it_was_collected_from() {
        for count in [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK] {
            let plain = numbers(count);
            let list = Blocks::from(plain.clone());
            assert_eq!((list.len(), list.is_empty()), (count, count == 0));
            assert!(list.iter().eq(&plain));
            assert!((0..=count).all(|number| list.get(number) == plain.get(number)));
            assert!((0..count).all(|number| list[number] == plain[number]));
            let numbered: Vec<_> = list.par_numbered().collect();
            assert!(numbered.into_iter().eq(plain.iter().enumerate()));
        }
    }

    #[test]
    fn changing_a_clone_does_not_change_the_original() {
        let list = Blocks::from(numbers(3 * BLOCK));
        let mut copy = list.clone();
        assert!(copy == list);
        copy[BLOCK + 7] = 0;
        assert!(copy != list);
        let changed: Vec<_> = list.differences(&copy, usize::ne).collect();
        assert_eq!((changed, list[BLOCK + 7]), (vec![BLOCK + 7], BLOCK + 7));
        copy[BLOCK + 7] = BLOCK + 7;
        assert!(copy == list);
        assert!(list != Blocks::from(numbers(3 * BLOCK - 1)));
    }

    #[test]
    fn replacing_as_many_items_copies_only_their_blocks() {
        let list = Blocks::from(numbers(4 * BLOCK));
        let mut copy = list.clone();
        copy.replace(2 * BLOCK - 1..2 * BLOCK + 1, vec![0, 0]);
        let shared = list.blocks().iter().zip(copy.blocks());
        let shared: Vec<_> = shared.map(|(one, other)| Arc::ptr_eq(one, other)).collect();
        assert_eq!(shared, [true, false, false, true]);
    }

    proptest! {
        #[test]
        fn replacing_a_range_is_what_it_is_for_a_vector(
            count in 0..3 * BLOCK,
            [one, other] in [0..=3 * BLOCK, 0..=3 * BLOCK],
            more in prop_oneof![Just(None), (0..2 * BLOCK).prop_map(Some)],
        ) {
            let (start, end) = (one.min(other).min(count), one.max(other).min(count));
            let items = vec![usize::MAX; more.unwrap_or(end - start)];
            let mut plain = numbers(count);
            let mut list = Blocks::from(plain.clone());
            plain.splice(start..end, items.clone());
            list.replace(start..end, items);
            prop_assert!(list == Blocks::from(plain));
        }
    }
}
