//! The objects of a scene, in blocks shared between scenes: changing one shape of a million copies
//! only its block.

use std::ops::Index;
use std::sync::Arc;

use rayon::prelude::*;

use super::Object;

/// Objects per block. A text may be parsed block by block without knowledge of earlier blocks, so
/// equal materials are merged only within a block.
pub(crate) const BLOCK: usize = 1024;

/// A list of objects. Clones share blocks until they are changed.
#[derive(Clone, Debug, Default)]
pub struct Objects {
    /// All full except the last, which is never empty.
    blocks: Vec<Arc<[Object]>>,
}

impl Objects {
    /// Creates a list from blocks, all full except the last, which is not empty.
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

    /// The blocks in order.
    pub(crate) fn blocks(&self) -> &[Arc<[Object]>] {
        &self.blocks
    }

    /// The number of objects.
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

    /// Returns the object at an index.
    pub fn get(&self, number: usize) -> Option<&Object> {
        self.blocks.get(number / BLOCK)?.get(number % BLOCK)
    }

    /// Iterates over all objects in order.
    pub fn iter(&self) -> impl Iterator<Item = &Object> {
        self.blocks.iter().flat_map(|block| block.iter())
    }

    /// Iterates in parallel over all objects and their indices, in order.
    pub(crate) fn par_numbered(&self) -> impl ParallelIterator<Item = (usize, &Object)> {
        /// Blocks per task of a parallel walk over all objects.
        const TASK: usize = 8;
        let blocks = self.blocks.par_iter().with_min_len(TASK).enumerate();
        blocks.flat_map_iter(|(number, block)| (number * BLOCK..).zip(block.iter()))
    }

    /// Indices at which two lists differ according to `is_other`, in ascending order, up to the
    /// length of the shorter list. Shared blocks are skipped.
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
    use crate::geometry::{Shape, Solid, Sphere};

    fn objects(count: usize) -> Vec<Object> {
        let object = |number| Object {
            shape: Shape::Solid(Solid::Sphere(Sphere {
                centre: glam::DVec3::ZERO,
                radius: f64::from(number),
            })),
            material: number,
        };
        (0..count as u32).map(object).collect()
    }

    #[test]
    fn a_list_equals_the_objects_it_was_collected_from() {
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
    fn changing_a_clone_does_not_change_the_original() {
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
