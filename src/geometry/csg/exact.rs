//! One line through a solid made of solids, whatever coincides on it.

use smallvec::SmallVec;

use super::evaluate::{Lists, Slopes};
use super::{Csg, Leaf, Operation};
use crate::geometry::{Aabb, Hit, Ray, Spans};

/// Where a line crosses the boundary of a solid, in ascending order; in and out alternate.
pub(super) type Boundaries = SmallVec<[Hit; 32]>;

struct Exact<'a> {
    csg: &'a Csg,
    ray: &'a Ray,
    slopes: Slopes<f64>,
    hits: Boundaries,
    /// The lists of shared steps.
    known: Vec<Option<Vec<Hit>>>,
    /// Room for use by the moment.
    merged: Boundaries,
    spans: Spans,
}

impl Csg {
    /// Where the ray's line crosses the boundary at distances in `reach`; beyond, boundaries may be
    /// missing, in pairs.
    pub(super) fn boundaries(&self, ray: &Ray, reach: [f64; 2]) -> Boundaries {
        let mut lists = Exact {
            csg: self,
            ray,
            slopes: Slopes::new(&ray.into(), reach),
            hits: Boundaries::new(),
            known: vec![None; self.shared as usize],
            merged: Boundaries::new(),
            spans: Spans::new(),
        };
        self.evaluate(&mut lists, ());
        lists.hits
    }
}

impl Lists for Exact<'_> {
    type Lines = ();

    fn meet(&self, bounds: &Aabb, (): ()) -> Option<()> {
        self.slopes.meet(bounds).then_some(())
    }

    fn len(&self) -> usize {
        self.hits.len()
    }

    fn push(&mut self, leaf: &Leaf, (): ()) {
        self.spans.clear();
        leaf.shape.spans(self.ray, &mut self.spans);
        let ends = self.spans.iter().flat_map(|span| [span.enter, span.exit]);
        self.hits.extend(ends.map(|end| Hit {
            part: 2 * (leaf.first_part + end.part),
            ..end
        }));
    }

    fn merge(&mut self, operation: Operation, start: usize, middle: usize) {
        let (first, second) = self.hits[start..].split_at(middle - start);
        self.merged.clear();
        self.csg
            .merge(self.ray, operation, [first, second], &mut self.merged);
        self.hits.truncate(start);
        self.hits.extend_from_slice(&self.merged);
    }

    fn remember(&mut self, shared: u32, start: usize) {
        self.known[shared as usize] = Some(self.hits[start..].to_vec());
    }

    fn recall(&mut self, shared: u32) -> bool {
        let known = &self.known[shared as usize];
        if let Some(hits) = known {
            self.hits.extend_from_slice(hits);
        }
        known.is_some()
    }
}
