//! The objects of a scene, in blocks that scenes share: another shape of one among a million copies
//! its block and no other.

use std::ops::Index;
use std::sync::Arc;

use rayon::prelude::*;

use super::Object;

/// How many objects a block holds. Lowering reads each block of a `.ray` text without knowing of
/// those before it, so that equal materials of different blocks are not one.
pub(crate) const BLOCK: usize = 1024;

/// A list of objects. Copies share their blocks until one of them is changed.
#[derive(Clone, Debug, Default)]
pub struct Objects {
    /// All full but the last, which is never empty.
    blocks: Vec<Arc<[Object]>>,
}

impl Objects {
    /// Objects in blocks, all full but the last, which is not empty.
    pub(crate) fn of_blocks(blocks: Vec<Arc<[Object]>>) -> Self {
        debug_assert!(
            blocks
                .iter()
                .rev()
                .skip(1)
                .all(|block| block.len() == BLOCK)
                && blocks
                    .last()
                    .is_none_or(|block| (1..=BLOCK).contains(&block.len())),
            "an object is found by its number"
        );
        Self { blocks }
    }

    /// The blocks.
    pub(crate) fn blocks(&self) -> &[Arc<[Object]>] {
        &self.blocks
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        let Some((last, full)) = self.blocks.split_last() else {
            return 0;
        };
        full.len() * BLOCK + last.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.blocks.is_empty()
    }

    /// The object with a number.
    pub fn get(&self, number: usize) -> Option<&Object> {
        self.blocks.get(number / BLOCK)?.get(number % BLOCK)
    }

    /// All of them, in order.
    pub fn iter(&self) -> impl Iterator<Item = &Object> {
        self.blocks.iter().flat_map(|block| block.iter())
    }

    /// All of them with their numbers, in order, side by side.
    pub(crate) fn par_numbered(&self) -> impl ParallelIterator<Item = (usize, &Object)> {
        /// Blocks that are a task together, if that is to look at each object.
        const TASK: usize = 8;
        let blocks = self.blocks.par_iter().with_min_len(TASK).enumerate();
        blocks.flat_map_iter(|(number, block)| (number * BLOCK..).zip(block.iter()))
    }

    /// The numbers at which two lists differ, as far as both go: those whose objects `is_other` tells
    /// apart, in order. Blocks that are shared are not looked at.
    pub fn differences<'a>(
        &'a self,
        other: &'a Self,
        is_other: impl Fn(&Object, &Object) -> bool + Copy + 'a,
    ) -> impl Iterator<Item = usize> + 'a {
        let blocks = self.blocks.iter().zip(&other.blocks).enumerate();
        let unshared = blocks.filter(|(_, (one, other))| !Arc::ptr_eq(one, other));
        unshared.flat_map(move |(number, (one, other))| {
            let pairs = (number * BLOCK..).zip(one.iter().zip(other.iter()));
            pairs.filter_map(move |(number, (one, other))| is_other(one, other).then_some(number))
        })
    }
}

impl Index<usize> for Objects {
    type Output = Object;

    #[inline]
    fn index(&self, number: usize) -> &Object {
        &self.blocks[number / BLOCK][number % BLOCK]
    }
}

#[cfg(test)]
impl std::ops::IndexMut<usize> for Objects {
    fn index_mut(&mut self, number: usize) -> &mut Object {
        &mut Arc::make_mut(&mut self.blocks[number / BLOCK])[number % BLOCK]
    }
}

impl PartialEq for Objects {
    fn eq(&self, other: &Self) -> bool {
        self.len() == other.len() && self.differences(other, Object::ne).next().is_none()
    }
}

impl FromIterator<Object> for Objects {
    fn from_iter<I: IntoIterator<Item = Object>>(objects: I) -> Self {
        let mut objects = objects.into_iter().fuse();
        let blocks = std::iter::from_fn(|| {
            let block: Arc<[Object]> = objects.by_ref().take(BLOCK).collect();
            (!block.is_empty()).then_some(block)
        });
        Self::of_blocks(blocks.collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Shape, Sphere};

    fn objects(count: usize) -> Vec<Object> {
        let object = |number| Object {
            shape: Shape::Sphere(Sphere {
                centre: glam::DVec3::ZERO,
                radius: f64::from(number),
            }),
            material: number,
        };
        (0..count as u32).map(object).collect()
    }

    #[test]
    fn a_list_is_what_it_was_made_of() {
        for count in [0, 1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK] {
            let plain = objects(count);
            let list: Objects = plain.iter().cloned().collect();
            assert_eq!((list.len(), list.is_empty()), (count, count == 0));
            assert!(list.iter().eq(&plain));
            assert!((0..=count).all(|number| list.get(number) == plain.get(number)));
            assert!((0..count).all(|number| list[number] == plain[number]));
            let numbered: Vec<_> = list.par_numbered().collect();
            assert!(numbered.into_iter().eq(plain.iter().enumerate()));
        }
    }

    #[test]
    fn a_change_of_one_list_is_none_of_its_copy() {
        let list: Objects = objects(3 * BLOCK).into_iter().collect();
        let mut copy = list.clone();
        assert!(copy == list);
        copy[BLOCK + 7].material = 0;
        assert!(copy != list);
        let changed: Vec<_> = list.differences(&copy, Object::ne).collect();
        assert_eq!(
            (changed, list[BLOCK + 7].material),
            (vec![BLOCK + 7], BLOCK as u32 + 7)
        );
        copy[BLOCK + 7].material = BLOCK as u32 + 7;
        assert!(copy == list);
        let fewer: Objects = objects(3 * BLOCK - 1).into_iter().collect();
        assert!(list != fewer);
    }
}
