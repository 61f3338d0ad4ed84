//! Lines side by side through a CSG solid, if boundaries are far apart.

use smallvec::SmallVec;

use super::merge::APART;
use super::program::{Instruction, Program};
use super::slopes::Slopes;
use super::{Csg, Operation};
use crate::Rays;
use crate::lanes::Lanes;
use crate::line::End;

/// The maximum number of boundaries kept.
const MOST: usize = 32;

/// A crossing of several lines with a leaf's surface, and the lines on which it is a boundary.
///
/// Lists are not sorted: a line is inside a solid after an odd number of its boundaries, in any
/// order.
#[derive(Clone, Copy)]
struct Boundary<N: Lanes> {
    end: End<N>,
    lines: N::Mask,
    /// The lines on which it is inside the other operand, while both are merged.
    inside: N::Mask,
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
    /// The nearest boundary with `0 < t < limit` on each of the given lines, by the program.
    ///
    /// All lists stay in place, one after the other: moving them, and a stack of tasks instead of the
    /// program, took a sixth of a picture's time.
    #[inline(always)]
    pub(super) fn nearest<N: Lanes>(
        &self,
        program: &Program,
        rays: &Rays<N>,
        limits: N,
        mut lines: N::Mask,
    ) -> Nearest<N> {
        let (zero, none) = (limits.all(0.0), lines & !lines);
        let slopes = Slopes::new(rays, [zero, limits]);
        // The largest relevant coordinate on each line, except those of the boundaries.
        let scale = rays
            .origin
            .abs()
            .largest()
            .larger(limits.all(self.magnitude));
        let mut close = none;
        let mut boundaries: SmallVec<[Boundary<N>; MOST]> = SmallVec::new();
        let mut outer: SmallVec<[N::Mask; 8]> = SmallVec::new();
        let mut starts: SmallVec<[usize; 16]> = SmallVec::new();
        let mut next = 0;
        while let Some(instruction) = program.0.get(next) {
            next += 1;
            match *instruction {
                Instruction::Enter { ref bounds, end } => {
                    let hit = lines & slopes.may_hit(bounds);
                    if N::any(hit) {
                        outer.push(lines);
                        lines = hit;
                    } else {
                        next = end as usize;
                    }
                }
                Instruction::Leave => lines = outer.pop().unwrap_or(lines),
                Instruction::Leaf { leaf, inverted } => {
                    let leaf = &self.leaves[leaf as usize];
                    let Some(ends) = leaf.solid.ends(rays) else {
                        continue;
                    };
                    let lines = lines & ends.hit;
                    if !N::any(lines) {
                        continue;
                    }
                    if MOST < boundaries.len() + 2 {
                        // Lines with dropped boundaries count as close.
                        close = close | lines;
                        continue;
                    }
                    let two = limits.all(2.0);
                    let first_part =
                        limits.all(f64::from(2 * leaf.first_part + u32::from(inverted)));
                    for End { t, part } in [ends.enter, ends.exit] {
                        let part = two * part + first_part;
                        boundaries.push(Boundary {
                            end: End { t, part },
                            lines,
                            inside: none,
                        });
                    }
                }
                Instruction::First => starts.push(boundaries.len()),
                Instruction::Second { is_union, end } => {
                    if !is_union && starts.last() == Some(&boundaries.len()) {
                        starts.pop();
                        next = end as usize;
                    } else {
                        starts.push(boundaries.len());
                    }
                }
                Instruction::Merge(operation) => {
                    let (Some(middle), Some(start)) = (starts.pop(), starts.pop()) else {
                        continue;
                    };
                    let (first, second) = boundaries[start..].split_at_mut(middle - start);
                    close = close | merge(operation, [first, second], scale, none);
                    let mut kept = start;
                    for index in start..boundaries.len() {
                        if N::any(boundaries[index].lines) {
                            if kept < index {
                                boundaries[kept] = boundaries[index];
                            }
                            kept += 1;
                        }
                    }
                    boundaries.truncate(kept);
                }
            }
        }
        let mut nearest = Nearest {
            end: End {
                t: limits,
                part: zero,
            },
            hit: none,
            close,
        };
        for Boundary { end, lines, .. } in &boundaries {
            let nearer = *lines & end.is_within(nearest.end.t);
            nearest.end = End::select(nearer, *end, nearest.end);
            nearest.hit = nearest.hit | nearer;
        }
        nearest
    }
}

/// Leaves the boundaries of an operation, and returns the lines on which two may coincide.
#[inline(always)]
fn merge<N: Lanes>(
    operation: Operation,
    [first, second]: [&mut [Boundary<N>]; 2],
    scale: N,
    none: N::Mask,
) -> N::Mask {
    let mut close = none;
    for b in &mut *second {
        b.inside = none;
    }
    for a in &mut *first {
        let farthest = scale.all(APART) * scale.larger(a.end.t.abs());
        let mut inside = none;
        for b in &mut *second {
            let is_apart = farthest.below((a.end.t - b.end.t).abs());
            close = close | (a.lines & b.lines & !is_apart);
            let is_first = a.end.t.below(b.end.t);
            b.inside = b.inside ^ (a.lines & is_first);
            inside = inside ^ (b.lines & !is_first);
        }
        a.inside = inside;
    }
    for (boundaries, is_kept_inside) in [
        (first, operation == Operation::Intersection),
        (second, operation != Operation::Union),
    ] {
        for boundary in boundaries {
            let Boundary { lines, inside, .. } = *boundary;
            boundary.lines = if is_kept_inside {
                lines & inside
            } else {
                lines & !inside
            };
        }
    }
    close
}
