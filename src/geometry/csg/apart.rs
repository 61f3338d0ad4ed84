//! Lines through a solid made of solids, side by side, where boundaries are far apart.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use smallvec::SmallVec;

use super::evaluate::{Lists, Slopes};
use super::merge::APART;
use super::{Csg, Leaf, Operation};
use crate::geometry::lanes::Lanes;
use crate::geometry::line::End;
use crate::geometry::{Aabb, Rays};

/// How many boundaries are kept at most.
const MOST: usize = 32;

/// A crossing of a leaf's surface and several lines, by those that it is a boundary of the solid on.
///
/// Lists are gone through by reference: by value their copies took an eighth of a picture. Nothing
/// is sorted: a line is inside a solid after an odd number of its boundaries, wherever these
/// stand in the list.
#[derive(Clone, Copy)]
struct Boundary<N: Lanes> {
    end: End<N>,
    /// Whether the surface is turned inside out: 1 or 0.
    turned: f64,
    lines: N::Mask,
}

struct Apart<'a, N: Lanes> {
    rays: &'a Rays<N>,
    slopes: Slopes<N>,
    /// The largest coordinate that matters on each line, but for those of the boundaries.
    scale: N,
    boundaries: SmallVec<[Boundary<N>; MOST]>,
    close: N::Mask,
}

/// The nearest boundary on each of several lines.
pub(super) struct Nearest<N: Lanes> {
    pub(super) end: End<N>,
    /// The lines that have one.
    pub(super) met: N::Mask,
    /// Lines with boundaries so close that they may be one, of which nothing is known.
    pub(super) close: N::Mask,
}

impl Csg {
    /// The nearest boundary with `0 < t < limit` on each of some lines, of a solid whose leaves are
    /// all met in one span and used once.
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
            met: none,
            close: lists.close,
        };
        for &Boundary { end, turned, lines } in &lists.boundaries {
            let part = limits.all(2.0) * end.part + limits.all(turned);
            let nearer = lines & end.is_within(nearest.end.t);
            nearest.end = End::select(nearer, End { part, ..end }, nearest.end);
            nearest.met = nearest.met | nearer;
        }
        nearest
    }
}

impl<N: Lanes> Lists for Apart<'_, N> {
    type Lines = N::Mask;

    #[inline(always)]
    fn meet(&self, bounds: &Aabb, lines: N::Mask) -> Option<N::Mask> {
        let met = lines & self.slopes.meet(bounds);
        N::any(met).then_some(met)
    }

    #[inline(always)]
    fn len(&self) -> usize {
        self.boundaries.len()
    }

    #[inline(always)]
    fn push(&mut self, leaf: &Leaf, lines: N::Mask) {
        let Some(ends) = leaf.shape.ends(self.rays) else {
            return;
        };
        let lines = lines & ends.met;
        if !N::any(lines) {
            return;
        }
        if MOST < self.boundaries.len() + 2 {
            // As if all that is left out were close to something.
            self.close = self.close | lines;
            return;
        }
        for end in [ends.enter, ends.exit] {
            let part = end.part + end.part.all(f64::from(leaf.first_part));
            self.boundaries.push(Boundary {
                end: End { part, ..end },
                turned: 0.0,
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
                b.turned = 1.0 - b.turned;
            }
        }
        let mut kept = start;
        for place in start..self.boundaries.len() {
            if N::any(self.boundaries[place].lines) {
                self.boundaries[kept] = self.boundaries[place];
                kept += 1;
            }
        }
        self.boundaries.truncate(kept);
    }

    /// No step is shared.
    #[inline(always)]
    fn remember(&mut self, _: u32, _: usize) {}

    #[inline(always)]
    fn recall(&mut self, _: u32) -> bool {
        false
    }
}
