//! What is left of a combination where nothing can be cut away.

use super::{Csg, Operation, PreparedKind};
use crate::{Aabb, Solid};

impl Csg {
    /// The solids that resemble it most if nothing can be cut away, with their tags: both operands
    /// of a union, the first of a difference, and of an intersection the one in the smaller box.
    pub fn uncut(&self) -> Vec<(&Solid, u32)> {
        let boxes = self.boxes();
        let mut kept = vec![false; self.steps.len()];
        if let Some(last) = kept.last_mut() {
            *last = true;
        }
        let mut leaves = Vec::new();
        // Operands precede their users.
        for index in (0..self.steps.len()).rev() {
            if !kept[index] {
                continue;
            }
            match self.steps[index].kind {
                PreparedKind::Leaf(leaf) => leaves.push(leaf),
                PreparedKind::Operation(operation, [first, second]) => {
                    let [a, b] = [first as usize, second as usize];
                    let is_larger = boxes[b].half_diagonal() < boxes[a].half_diagonal();
                    kept[a] |= operation != Operation::Intersection || !is_larger;
                    kept[b] |= match operation {
                        Operation::Union => true,
                        Operation::Intersection => is_larger,
                        Operation::Difference => false,
                    };
                }
            }
        }
        leaves.sort_unstable();
        let leaves = leaves.into_iter().map(|leaf| &self.leaves[leaf as usize]);
        leaves.map(|leaf| (&leaf.solid, leaf.tag)).collect()
    }

    /// The box of each step.
    fn boxes(&self) -> Vec<Aabb> {
        let mut boxes: Vec<Aabb> = Vec::with_capacity(self.steps.len());
        for step in &self.steps {
            boxes.push(match step.kind {
                PreparedKind::Leaf(leaf) => self.leaves[leaf as usize].solid.bounds(),
                PreparedKind::Operation(operation, [first, second]) => {
                    let [a, b] = [boxes[first as usize], boxes[second as usize]];
                    match operation {
                        Operation::Union => a.union(b),
                        Operation::Intersection => a.intersection(b),
                        Operation::Difference => a,
                    }
                }
            });
        }
        boxes
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{Node, Sphere};

    #[test]
    fn unions_keep_both_operands_and_cuts_one() {
        let ball = |tag: u32| Node::Leaf {
            solid: Solid::Sphere(Sphere {
                centre: DVec3::ZERO,
                radius: f64::from(1 + tag),
            }),
            tag,
        };
        let combined = |operation, [first, second]: [u32; 2]| Node::Operation {
            operation,
            first,
            second,
        };
        for (last, kept) in [
            (combined(Operation::Union, [2, 3]), vec![0, 2]),
            (combined(Operation::Difference, [2, 3]), vec![0]),
            (combined(Operation::Difference, [3, 2]), vec![2]),
            (combined(Operation::Intersection, [3, 2]), vec![0]),
        ] {
            // The second of them is cut away from the first.
            let cut = combined(Operation::Difference, [0, 1]);
            let csg = Csg::new(vec![ball(0), ball(1), cut, ball(2), last]);
            let tags: Vec<_> = csg.uncut().into_iter().map(|(_, tag)| tag).collect();
            assert_eq!(tags, kept);
        }
    }
}
