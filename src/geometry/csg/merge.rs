//! Merging two lists of boundaries by an operation.

use super::exact::Boundaries;
use super::{Csg, Operation};
use crate::{Hit, Ray, ulp};

/// The distance, in ulps of their scale, within which two boundaries coincide.
const SAME: f64 = 64.0;

/// Boundaries farther apart than this fraction of their scale never coincide: a line that crosses
/// coincident surfaces so far apart meets them at an angle below 2⁻²⁶.
pub(super) const APART: f64 = 1.0 / (1 << 20) as f64;

/// Normals whose cosine differs from 1 by less are parallel.
const PARALLEL: f64 = 1.0 / (1 << 30) as f64;

impl Csg {
    /// Appends the boundaries of the result. Where those of both operands coincide, the line
    /// crosses both at once, and the first operand's stands for both: the states before and after
    /// decide what remains of touching faces.
    pub(super) fn merge(
        &self,
        ray: &Ray,
        operation: Operation,
        [first, second]: [&[Hit]; 2],
        merged: &mut Boundaries,
    ) {
        let (mut i, mut j) = (0, 0);
        loop {
            let (crosses_first, crosses_second) = match (first.get(i), second.get(j)) {
                (Some(a), Some(b)) if self.coincide(ray, *a, *b) => (true, true),
                (Some(a), Some(b)) => (a.t < b.t, b.t <= a.t),
                (Some(_), None) => (true, false),
                (None, Some(_)) => (false, true),
                (None, None) => return,
            };
            let before = operation.holds(is_odd(i), is_odd(j));
            let mut hit = if crosses_first { first[i] } else { second[j] };
            if !crosses_first && operation == Operation::Difference {
                hit.part ^= 1;
            }
            i += usize::from(crosses_first);
            j += usize::from(crosses_second);
            if before != operation.holds(is_odd(i), is_odd(j)) {
                merged.push(hit);
            }
        }
    }

    /// Whether two boundaries coincide up to rounding.
    ///
    /// A line that grazes two coplanar faces crosses them as far apart as their rounding over the
    /// sine of its angle: for such lines the distance along the normal counts.
    fn coincide(&self, ray: &Ray, a: Hit, b: Hit) -> bool {
        let apart = (a.t - b.t).abs();
        if a.t == b.t {
            return true;
        }
        let scale = ray.origin.abs().max_element().max(a.t.abs());
        let farthest = APART * scale.max(self.magnitude);
        if !scale.is_finite() || farthest.is_nan() || farthest < apart || apart.is_infinite() {
            return false;
        }
        let ((leaf, own), (other, others)) = (self.leaf(a), self.leaf(b));
        let scale = scale.max(leaf.magnitude).max(other.magnitude);
        let same = SAME * ulp(scale);
        if apart <= same {
            return true;
        }
        if APART * scale < apart {
            return false;
        }
        let normal = leaf.solid.surface(ray, own).normal;
        let cosine = normal.dot(other.solid.surface(ray, others).normal).abs();
        1.0 - PARALLEL < cosine && apart * normal.dot(ray.direction).abs() <= same
    }
}

impl Operation {
    /// Whether a point is inside the result.
    fn holds(self, in_first: bool, in_second: bool) -> bool {
        match self {
            Self::Union => in_first || in_second,
            Self::Intersection => in_first && in_second,
            Self::Difference => in_first && !in_second,
        }
    }
}

/// Whether a line is inside after `count` boundaries.
fn is_odd(count: usize) -> bool {
    count % 2 == 1
}
