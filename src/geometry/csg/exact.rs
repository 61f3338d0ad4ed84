//! Single lines through a CSG solid, with coincident boundaries resolved.

use smallvec::SmallVec;

use super::evaluate::{Lists, Slopes};
use super::{Csg, Leaf, Operation};
use crate::geometry::{Aabb, Hit, Ray, Spans};

/// Where a line crosses the boundary of a solid, ascending, alternately entering and leaving.
pub(super) type Boundaries = SmallVec<[Hit; 32]>;

struct Exact<'a> {
    csg: &'a Csg,
    ray: &'a Ray,
    slopes: Slopes<f64>,
    hits: Boundaries,
    /// The saved lists of shared steps.
    known: Vec<Option<Vec<Hit>>>,
    /// Scratch buffer of `merge`.
    merged: Boundaries,
    spans: Spans,
}

impl Csg {
    /// The boundaries on the ray's line at distances in `reach`; beyond it pairs of boundaries may
    /// be missing.
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

    fn may_hit(&self, bounds: &Aabb, (): ()) -> Option<()> {
        self.slopes.may_hit(bounds).then_some(())
    }

    fn len(&self) -> usize {
        self.hits.len()
    }

    fn push(&mut self, leaf: &Leaf, (): ()) {
        self.spans.clear();
        leaf.solid.spans(self.ray, &mut self.spans);
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
