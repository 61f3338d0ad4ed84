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
use crate::geometry::lanes::{Eight, Lanes, Simd, SimdBase, bits};

use super::Bvh;
use super::node::{Child, Node, SlabRay, WIDEN, WIDTH, cut, difference};
use super::traverse::{STACK, Waiting, insert};

/// As many rays are tested against all children of a node, one after the other; of more all against
/// each child.
const FEW: u32 = 2;

/// Rays along one axis.
struct Slopes<S: Simd> {
    /// 1 over the direction; infinite for 0, with its sign.
    inverse: Eight<S>,
    /// The origin against low planes. Rays that rise come in there, and the planes must not be too
    /// far; others go out there, and they must not be too near: it is the larger end both times.
    against_low: Eight<S>,
    /// The origin against high planes, the smaller end.
    against_high: Eight<S>,
    rises: <Eight<S> as Lanes>::Mask,
    bounds: SlopeBounds<S>,
}

/// What lies between all rays of a packet along one axis, in each lane the same.
struct SlopeBounds<S: Simd> {
    /// The least and the greatest inverse.
    inverse: [Eight<S>; 2],
    /// The origins against planes where rays come in, such that none is too far.
    near_origin: Eight<S>,
    /// The origins against planes where rays go out, such that none is too near.
    far_origin: Eight<S>,
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
    let reference = bvh.reference;
    let (origin, direction) = (rays.origin, rays.direction);
    let slopes = [
        slopes(origin.x, direction.x, reference.x),
        slopes(origin.y, direction.y, reference.y),
        slopes(origin.z, direction.z, reference.z),
    ];
    let mut stack = ArrayVec::<_, STACK>::new();
    stack.push(Waiting {
        entry: 0.0,
        child: Child::Inner(0),
        lanes,
    });
    while let Some(Waiting {
        entry,
        child,
        lanes,
    }) = stack.pop()
    {
        let reached = limits.all(entry).up_to(limits * limits.all(WIDEN));
        let lanes = bits::<S>(reached) & lanes;
        if lanes == 0 {
            continue;
        }
        match child {
            Child::Inner(number) => {
                let node = &bvh.nodes[number as usize];
                let base = stack.len();
                if lanes.count_ones() <= FEW {
                    let mut met = meet_few(node, &slopes, limits, lanes);
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
                let mut candidates = candidates(node, &slopes, limits);
                while candidates != 0 {
                    let lane = candidates.trailing_zeros() as usize % WIDTH;
                    candidates &= candidates - 1;
                    let (entry, lanes) = meet(node, lane, &slopes, limits, lanes);
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
            }
        }
    }
}

impl<S: Simd> Slopes<S> {
    /// The ray in a lane, as [`SlabRay::of`] takes it.
    #[inline(always)]
    fn of_lane(&self, lane: usize) -> [f64; 3] {
        [
            self.inverse[lane],
            self.against_low[lane],
            self.against_high[lane],
        ]
    }
}

#[inline(always)]
fn slopes<S: Simd>(origin: Eight<S>, direction: Eight<S>, reference: f64) -> Slopes<S> {
    let simd = origin.simd;
    let (mut above, mut below) = ([0.0; WIDTH], [0.0; WIDTH]);
    for lane in 0..WIDTH {
        [below[lane], above[lane]] = difference(origin[lane], reference);
    }
    let against_low = Eight::load_array(simd, above);
    let against_high = Eight::load_array(simd, below);
    let inverse = direction.all(1.0) / direction;
    // The inverse of a direction of −0 is −∞.
    let rises = inverse.all(0.0).below(inverse);
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
            inverse: [inverse.all(slow), inverse.all(fast)],
            near_origin: inverse.all(near_origin),
            far_origin: inverse.all(far_origin),
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
fn candidates<S: Simd>(node: &Node, slopes: &[Slopes<S>; 3], limits: Eight<S>) -> u32 {
    let mut interval = [limits.all(0.0), limits.all(limits.reduce_max_precise())];
    for (axis, slopes) in slopes.iter().enumerate() {
        let bounds = &slopes.bounds;
        if !bounds.tells {
            continue;
        }
        let [near, far] = node.planes(limits.simd, axis, bounds.near_side);
        let [slow, fast] = bounds.inverse;
        let near = near - bounds.near_origin;
        let far = far - bounds.far_origin;
        let (near, other_near) = (near * slow, near * fast);
        let (far, other_far) = (far * slow, far * fast);
        interval = cut(interval, near.smaller(other_near), far.larger(other_far));
    }
    let [entry, exit] = interval;
    bits::<S>(entry.up_to(exit * limits.all(WIDEN))) & node.filled()
}

/// Which of the rays meet a child, and where the first of them enters its box.
#[inline(always)]
fn meet<S: Simd>(
    node: &Node,
    lane: usize,
    slopes: &[Slopes<S>; 3],
    limits: Eight<S>,
    lanes: u32,
) -> (f64, u32) {
    let mut interval = [limits.all(0.0), limits];
    for (axis, slopes) in slopes.iter().enumerate() {
        let [low, high] = node.box_planes(lane, axis);
        let low = (limits.all(low) - slopes.against_low) * slopes.inverse;
        let high = (limits.all(high) - slopes.against_high) * slopes.inverse;
        let near = Lanes::select(slopes.rises, low, high);
        let far = Lanes::select(slopes.rises, high, low);
        interval = cut(interval, near, far);
    }
    let [entry, exit] = interval;
    let met = entry.up_to(exit * limits.all(WIDEN));
    let entry = Lanes::select(met, entry, entry.all(f64::INFINITY));
    // No entry is NaN.
    (entry.reduce_min(), bits::<S>(met) & lanes)
}

/// The children of a node that few rays meet.
struct Met {
    /// A bit for each.
    children: u32,
    /// Where the first ray enters its box.
    entries: [f64; WIDTH],
    /// Which of the rays meet it.
    lanes: [u32; WIDTH],
}

/// Tests few rays against all children, one after the other.
#[inline(always)]
fn meet_few<S: Simd>(
    node: &Node,
    [x, y, z]: &[Slopes<S>; 3],
    limits: Eight<S>,
    mut lanes: u32,
) -> Met {
    let mut few = Met {
        children: 0,
        entries: [f64::INFINITY; WIDTH],
        lanes: [0; WIDTH],
    };
    while lanes != 0 {
        let lane = lanes.trailing_zeros() as usize % WIDTH;
        lanes &= lanes - 1;
        let ray = SlabRay::of(
            limits.simd,
            [x.of_lane(lane), y.of_lane(lane), z.of_lane(lane)],
        );
        let (entries, mut met) = node.entries(&ray, limits[lane]);
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
