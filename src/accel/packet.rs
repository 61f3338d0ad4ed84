//! The walk of eight rays side by side, which visits what any of them may meet.
//!
//! A node is first asked which of its children's boxes any ray between the packet's bounds could
//! meet, all at once; only those are tested against each ray (after Wald, Boulos and Shirley, "Ray
//! Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies", TOG 2007).
//!
//! Where only one or two of the rays are left, each is tested against all children at once: a tenth
//! less time with many objects; with three left nothing more is gained.
//!
//! Tried and lost: one list of children for both (a tenth more time); rays that do not go the same
//! way walking alone from the root, for any measure of that (on a sphereflake of mirrors all alone
//! took 1.3 times as long as all side by side, and no mixture less).

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use std::ops::Range;

use arrayvec::ArrayVec;

use crate::geometry::Rays;
use crate::geometry::lanes::{Eight, Select, Simd, SimdBase, Singles, bits, singles};

use super::Bvh;
use super::node::{Child, Node, WIDTH};
use super::slab::{Approach, SlabRay, cut, opens};
use super::traverse::{STACK, Waiting, insert};

/// As many rays are tested against all children of a node, one after the other; of more all against
/// each child.
const FEW: u32 = 2;

/// Rays along one axis.
struct Slopes<S: Simd> {
    /// 1 over the direction; infinite for 0, with its sign.
    inverse: Singles<S>,
    /// The origin against low planes. Rays that rise come in there, and the planes must not be too
    /// far; others go out there, and they must not be too near: it is the larger end both times.
    against_low: Singles<S>,
    /// The origin against high planes, the smaller end.
    against_high: Singles<S>,
    rises: <Singles<S> as SimdBase<S>>::Mask,
    bounds: SlopeBounds<S>,
}

/// What lies between all rays of a packet along one axis, in each lane the same.
struct SlopeBounds<S: Simd> {
    /// The least and the greatest inverse.
    inverse: [Singles<S>; 2],
    /// The origins against planes where rays come in, such that none is too far.
    near_origin: Singles<S>,
    /// The origins against planes where rays go out, such that none is too near.
    far_origin: Singles<S>,
    /// Where rays come in: 0 for low planes, 1 for high ones.
    near_side: usize,
    /// Whether this says anything: not if some rise and others do not, or a direction is 0.
    tells: bool,
}

/// See [`Bvh::traverse_packet`].
#[inline(always)]
pub(super) fn traverse<S: Simd>(
    bvh: &Bvh,
    rays: &Rays<Eight<S>>,
    lanes: u32,
    mut limits: Eight<S>,
    mut visit: impl FnMut(Range<usize>, u32, Eight<S>) -> Eight<S>,
) {
    for run in bvh.unbounded() {
        limits = visit(run, lanes, limits);
    }
    if bvh.nodes.is_empty() {
        return;
    }
    let approach = Approach::new(rays, bvh);
    let [x, y, z] = approach.slopes(rays.direction, bvh.farthest);
    let slopes = [slopes(x), slopes(y), slopes(z)];
    let start = singles(approach.start());
    let mut reach = singles(approach.limits(limits));
    let mut stack = ArrayVec::<_, STACK>::new();
    stack.push(Waiting {
        entry: f32::NEG_INFINITY,
        child: Child::Inner(0),
        lanes,
    });
    while let Some(Waiting {
        entry,
        child,
        lanes,
    }) = stack.pop()
    {
        let reached = opens([Singles::splat(reach.simd, entry), reach]);
        let lanes = bits::<S>(reached) & lanes;
        if lanes == 0 {
            continue;
        }
        match child {
            Child::Inner(number) => {
                let node = &bvh.nodes[number as usize];
                let base = stack.len();
                if lanes.count_ones() <= FEW {
                    let mut met = meet_few(node, &slopes, [start, reach], lanes);
                    while met.children != 0 {
                        let lane = met.children.trailing_zeros() as usize % WIDTH;
                        met.children &= met.children - 1;
                        let waiting = Waiting {
                            entry: met.entries[lane],
                            child: node.child(lane),
                            lanes: met.lanes[lane],
                        };
                        insert(&mut stack, base, waiting);
                    }
                    continue;
                }
                let mut candidates = candidates(node, &slopes, [start, reach]);
                while candidates != 0 {
                    let lane = candidates.trailing_zeros() as usize % WIDTH;
                    candidates &= candidates - 1;
                    let (entry, lanes) = meet(node, lane, &slopes, [start, reach], lanes);
                    if lanes != 0 {
                        let child = node.child(lane);
                        let waiting = Waiting {
                            entry,
                            child,
                            lanes,
                        };
                        insert(&mut stack, base, waiting);
                    }
                }
            }
            Child::Leaf { first, count } => {
                let first = first as usize;
                limits = visit(first..first + usize::from(count), lanes, limits);
                reach = singles(approach.limits(limits));
            }
        }
    }
}

impl<S: Simd> Slopes<S> {
    /// The ray in a lane, as [`SlabRay::of`] takes it.
    #[inline(always)]
    fn of_lane(&self, lane: usize) -> [f32; 3] {
        [
            self.inverse[lane],
            self.against_low[lane],
            self.against_high[lane],
        ]
    }
}

/// Rays along an axis by what [`Approach::slopes`] says.
#[inline(always)]
fn slopes<S: Simd>(numbers: [Eight<S>; 3]) -> Slopes<S> {
    let [inverse, against_low, against_high] = numbers.map(
        #[inline(always)]
        |numbers| singles(numbers),
    );
    let simd = inverse.simd;
    // The inverse of a direction of −0 is −∞.
    let rises = inverse.simd_gt(Singles::splat(simd, 0.0));
    let all_rise = bits::<S>(rises) == 0xFF;
    let ends = [
        against_low.reduce_max_precise(),
        against_high.reduce_min_precise(),
    ];
    let [near_origin, far_origin] = if all_rise { ends } else { [ends[1], ends[0]] };
    let (slow, fast) = (inverse.reduce_min_precise(), inverse.reduce_max_precise());
    let alike = all_rise || bits::<S>(rises) == 0;
    Slopes {
        inverse,
        against_low,
        against_high,
        rises,
        bounds: SlopeBounds {
            inverse: [Singles::splat(simd, slow), Singles::splat(simd, fast)],
            near_origin: Singles::splat(simd, near_origin),
            far_origin: Singles::splat(simd, far_origin),
            near_side: usize::from(!all_rise),
            tells: alike && slow.is_finite() && fast.is_finite(),
        },
    }
}

/// The children that are not empty and that some ray may meet, a bit for each.
///
/// Where all rays go the same way along an axis, a distance of any of them is between the products
/// of the bounds: rounding keeps order.
#[inline(always)]
fn candidates<S: Simd>(
    node: &Node,
    slopes: &[Slopes<S>; 3],
    [start, reach]: [Singles<S>; 2],
) -> u32 {
    let simd = reach.simd;
    let mut interval = [
        Singles::splat(simd, start.reduce_min()),
        Singles::splat(simd, reach.reduce_max_precise()),
    ];
    for (axis, slopes) in slopes.iter().enumerate() {
        let bounds = &slopes.bounds;
        if !bounds.tells {
            continue;
        }
        let [near, far] = node.planes(reach.simd, axis, bounds.near_side);
        let [slow, fast] = bounds.inverse;
        let near = near - bounds.near_origin;
        let far = far - bounds.far_origin;
        let near = (near * slow).min(near * fast);
        let far = (far * slow).max(far * fast);
        interval = cut(interval, near, far);
    }
    bits::<S>(opens(interval)) & node.filled()
}

/// Which of the rays meet a child, and where the first of them enters its box.
#[inline(always)]
fn meet<S: Simd>(
    node: &Node,
    lane: usize,
    slopes: &[Slopes<S>; 3],
    [start, reach]: [Singles<S>; 2],
    lanes: u32,
) -> (f32, u32) {
    let simd = reach.simd;
    let mut interval = [start, reach];
    for (axis, slopes) in slopes.iter().enumerate() {
        let [low, high] = node.box_planes(lane, axis);
        let low = (Singles::splat(simd, low) - slopes.against_low) * slopes.inverse;
        let high = (Singles::splat(simd, high) - slopes.against_high) * slopes.inverse;
        let near = slopes.rises.select(low, high);
        let far = slopes.rises.select(high, low);
        interval = cut(interval, near, far);
    }
    let met = opens(interval);
    let entry = met.select(interval[0], Singles::splat(simd, f32::INFINITY));
    // No entry is NaN.
    (entry.reduce_min(), bits::<S>(met) & lanes)
}

/// The children of a node that few rays meet.
struct Met {
    /// A bit for each.
    children: u32,
    /// Where the first ray enters its box.
    entries: [f32; WIDTH],
    /// Which of the rays meet it.
    lanes: [u32; WIDTH],
}

/// Tests few rays against all children, one after the other.
#[inline(always)]
fn meet_few<S: Simd>(
    node: &Node,
    [x, y, z]: &[Slopes<S>; 3],
    [start, reach]: [Singles<S>; 2],
    mut lanes: u32,
) -> Met {
    let mut few = Met {
        children: 0,
        entries: [f32::INFINITY; WIDTH],
        lanes: [0; WIDTH],
    };
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % WIDTH;
        lanes &= lanes - 1;
        let ray = SlabRay::of(
            reach.simd,
            start[lane],
            [x.of_lane(lane), y.of_lane(lane), z.of_lane(lane)],
        );
        let (entries, mut met) = node.entries(&ray, reach[lane]);
        few.children |= met;
        while met != 0 {
            let child = met.trailing_zeros() as usize % WIDTH;
            met &= met - 1;
            few.entries[child] = few.entries[child].min(entries[child]);
            few.lanes[child] |= 1 << lane;
        }
    }
    few
}
