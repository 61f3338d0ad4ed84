//! Long lists of a scene, in blocks shared between scenes: changing one object of a million, or its
//! material, copies only a block.

use std::ops::Index;
use std::sync::Arc;

use rayon::prelude::*;

/// Items per block.
pub const BLOCK: usize = 1024;

/// A list. Clones share blocks until they are changed. Items are found by their numbers: block `k`
/// holds those from `k` × [`BLOCK`] on. Numbers have gaps behind blocks that are not full.
#[derive(Clone, Debug)]
pub struct Blocks<T> {
    /// None is empty.
    blocks: Vec<Arc<[T]>>,
}

impl<T> Blocks<T> {
    /// Creates a list from blocks, none of which is empty; behind those that are not full, numbers
    /// are left out.
    pub fn of_blocks(blocks: Vec<Arc<[T]>>) -> Self {
        assert!(
            blocks
                .iter()
                .all(|block| (1..=BLOCK).contains(&block.len())),
            "an item is found by its number"
        );
        Self { blocks }
    }

    /// The blocks in order.
    pub fn blocks(&self) -> &[Arc<[T]>] {
        &self.blocks
    }

    /// One more than the last number: the number of items if none is left out.
    pub fn len(&self) -> usize {
        let Some((last, before)) = self.blocks.split_last() else {
            return 0;
        };
        before.len() * BLOCK + last.len()
    }

    /// Whether the list is empty.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// Returns the item with a number.
    pub fn get(&self, number: usize) -> Option<&T> {
        self.blocks.get(number / BLOCK)?.get(number % BLOCK)
    }

    /// Iterates over all items in order.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.blocks.iter().flat_map(|block| block.iter())
    }

    /// Iterates over all items in order with their numbers.
    pub fn numbered(&self) -> impl Iterator<Item = (usize, &T)> {
        let blocks = self.blocks.iter().enumerate();
        blocks.flat_map(|(number, block)| (number * BLOCK..).zip(block.iter()))
    }

    /// Numbers at which two lists differ according to `differs`, in ascending order, of those that
    /// both have. Shared blocks are skipped.
    pub fn differences<'a>(
        &'a self,
        other: &'a Self,
        differs: impl Fn(&T, &T) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = usize> + 'a {
        let blocks = self.blocks.iter().zip(&other.blocks).enumerate();
        let unshared = blocks.filter(|(_, (one, other))| !Arc::ptr_eq(one, other));
        unshared.flat_map(move |(number, (one, other))| {
            let pairs = (number * BLOCK..).zip(one.iter().zip(other.iter()));
            pairs.filter_map(move |(number, (one, other))| differs(one, other).then_some(number))
        })
    }
}

impl<T: Sync + Send> Blocks<T> {
    /// Iterates in parallel over all items and their numbers, in order.
    pub fn par_numbered(&self) -> impl ParallelIterator<Item = (usize, &T)> {
        /// Blocks per task of a parallel walk over all items.
        const TASK: usize = 8;
        let blocks = self.blocks.par_iter().with_min_len(TASK).enumerate();
        blocks.flat_map_iter(|(number, block)| (number * BLOCK..).zip(block.iter()))
    }
}

impl<T: Clone> Blocks<T> {
    /// Edits the list as a whole.
    pub fn edit(&mut self, edit: impl FnOnce(&mut Vec<T>)) {
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

impl<T: Clone> std::ops::IndexMut<usize> for Blocks<T> {
    fn index_mut(&mut self, number: usize) -> &mut T {
        &mut Arc::make_mut(&mut self.blocks[number / BLOCK])[number % BLOCK]
    }
}

impl<T: PartialEq> PartialEq for Blocks<T> {
    fn eq(&self, other: &Self) -> bool {
        let mut pairs = self.blocks.iter().zip(&other.blocks);
        self.blocks.len() == other.blocks.len()
            && pairs.all(|(one, other)| Arc::ptr_eq(one, other) || one == other)
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
    fn items_behind_a_gap_are_found_by_their_numbers() {
        let blocks = |last: &[u8]| Blocks::of_blocks(vec![[3, 5].into(), last.into()]);
        let list = blocks(&[8]);
        let numbered = [(0, &3), (1, &5), (BLOCK, &8)];
        assert!(list.numbered().eq(numbered) && list.iter().eq(&[3, 5, 8]));
        assert_eq!(list.par_numbered().collect::<Vec<_>>(), numbered);
        assert_eq!(list.len(), BLOCK + 1);
        let found = [1, 2, BLOCK, BLOCK + 1].map(|number| list.get(number).copied());
        assert_eq!(found, [Some(5), None, Some(8), None]);
        assert!(list == blocks(&[8]) && list != blocks(&[9]) && list != blocks(&[8, 9]));
        let other = Blocks::of_blocks(vec![[3].into(), [8].into()]);
        assert!(list != other && list.differences(&other, u8::ne).next().is_none());
    }
}
