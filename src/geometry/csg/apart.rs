//! Packets of lines through a CSG solid, if boundaries are far apart.

use smallvec::SmallVec;

use super::evaluate::{Lists, Slopes};
use super::merge::APART;
use super::{Csg, Leaf, Operation};
use crate::geometry::lanes::Lanes;
use crate::geometry::line::End;
use crate::geometry::{Aabb, Rays};

/// The maximum number of boundaries kept.
const MOST: usize = 32;

/// A crossing of several lines with a leaf's surface, and the lines on which it is a boundary.
///
/// Lists are traversed by reference: copies by value took an eighth of a picture's time. They are
/// not sorted: a line is inside a solid after an odd number of its boundaries, in any order.
#[derive(Clone, Copy)]
struct Boundary<N: Lanes> {
    end: End<N>,
    /// 1 if the surface is turned inside out, otherwise 0.
    inverted: f64,
    lines: N::Mask,
}

struct Apart<'a, N: Lanes> {
    rays: &'a Rays<N>,
    slopes: Slopes<N>,
    /// The largest relevant coordinate on each line, except those of the boundaries.
    scale: N,
    boundaries: SmallVec<[Boundary<N>; MOST]>,
    close: N::Mask,
}

/// The nearest boundary on each of several lines.
pub(super) struct Nearest<N: Lanes> {
    pub(super) end: End<N>,
    /// The lines that have a boundary.
    pub(super) hit: N::Mask,
    /// Lines whose result is undefined, as two boundaries are so close that they may coincide.
    pub(super) close: N::Mask,
}

impl Csg {
    /// The nearest boundary with `0 < t < limit` on each of the given lines. All leaves must be
    /// simple solids, used once.
    #[inline(always)]
    pub(super) fn nearest<N: Lanes>(
        &self,
        rays: &Rays<N>,
        limits: N,
        lines: N::Mask,
    ) -> Nearest<N> {
        let (zero, none) = (limits.all(0.0), lines & !lines);
        let magnitude = limits.all(self.magnitude);
        let mut lists = Apart {
            rays,
            slopes: Slopes::new(rays, [zero, limits]),
            scale: rays.origin.abs().largest().larger(magnitude),
            boundaries: SmallVec::new(),
            close: none,
        };
        self.evaluate(&mut lists, lines);
        let mut nearest = Nearest {
            end: End {
                t: limits,
                part: zero,
            },
            hit: none,
            close: lists.close,
        };
        for &Boundary {
            end,
            inverted,
            lines,
        } in &lists.boundaries
        {
            let part = limits.all(2.0) * end.part + limits.all(inverted);
            let nearer = lines & end.is_within(nearest.end.t);
            nearest.end = End::select(nearer, End { part, ..end }, nearest.end);
            nearest.hit = nearest.hit | nearer;
        }
        nearest
    }
}

impl<N: Lanes> Lists for Apart<'_, N> {
    type Lines = N::Mask;

    #[inline(always)]
    fn may_hit(&self, bounds: &Aabb, lines: N::Mask) -> Option<N::Mask> {
        let hit = lines & self.slopes.may_hit(bounds);
        N::any(hit).then_some(hit)
    }

    #[inline(always)]
    fn len(&self) -> usize {
        self.boundaries.len()
    }

    #[inline(always)]
    fn push(&mut self, leaf: &Leaf, lines: N::Mask) {
        let Some(ends) = leaf.solid.ends(self.rays) else {
            return;
        };
        let lines = lines & ends.hit;
        if !N::any(lines) {
            return;
        }
        if MOST < self.boundaries.len() + 2 {
            // Lines with dropped boundaries count as close.
            self.close = self.close | lines;
            return;
        }
        for end in [ends.enter, ends.exit] {
            let part = end.part + end.part.all(f64::from(leaf.first_part));
            self.boundaries.push(Boundary {
                end: End { part, ..end },
                inverted: 0.0,
                lines,
            });
        }
    }

    #[inline(always)]
    fn merge(&mut self, operation: Operation, start: usize, middle: usize) {
        let (first, second) = self.boundaries.split_at_mut(middle);
        let none = self.close & !self.close;
        let mut in_first: SmallVec<[_; MOST]> = second.iter().map(|_| none).collect();
        for a in &mut first[start..] {
            let farthest = a.end.t.all(APART) * self.scale.larger(a.end.t.abs());
            let mut in_second = none;
            for (b, in_first) in second.iter().zip(&mut in_first) {
                let is_apart = farthest.below((a.end.t - b.end.t).abs());
                self.close = self.close | (a.lines & b.lines & !is_apart);
                let is_first = a.end.t.below(b.end.t);
                *in_first = *in_first ^ (a.lines & is_first);
                in_second = in_second ^ (b.lines & !is_first);
            }
            a.lines = match operation {
                Operation::Union | Operation::Difference => a.lines & !in_second,
                Operation::Intersection => a.lines & in_second,
            };
        }
        for (b, in_first) in second.iter_mut().zip(in_first) {
            b.lines = match operation {
                Operation::Union => b.lines & !in_first,
                Operation::Intersection | Operation::Difference => b.lines & in_first,
            };
            if operation == Operation::Difference {
                b.inverted = 1.0 - b.inverted;
            }
        }
        let mut kept = start;
        for index in start..self.boundaries.len() {
            if N::any(self.boundaries[index].lines) {
                self.boundaries[kept] = self.boundaries[index];
                kept += 1;
            }
        }
        self.boundaries.truncate(kept);
    }

    /// Does nothing, as no step is shared.
    #[inline(always)]
    fn remember(&mut self, _: u32, _: usize) {}

    #[inline(always)]
    fn recall(&mut self, _: u32) -> bool {
        false
    }
}
