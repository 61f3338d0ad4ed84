//! Wide nodes: the boxes of several children, tested against a ray at once.

use std::array;

use glam::DVec3;

use crate::geometry::lanes::{Eight, Lanes, Simd, SimdBase, bits};
use crate::geometry::{Aabb, Ray};

/// Children of a node.
pub(super) const WIDTH: usize = 8;

/// How much farther than computed a ray may leave a box, or a limit may lie.
///
/// With u = 2⁻⁵³, a distance (plane − origin) · (1 / direction) carries three roundings, so it is
/// off by a factor of 1 ± γ₃, γ₃ = 3u / (1 − 3u). Entry ≤ exit therefore holds for every box that is
/// met once the exit is scaled by 1 + 2γ₃ (Ize, "Robust BVH Ray Traversal", JCGT 2013); 8u leaves
/// room for the rounding of that product.
pub(super) const WIDEN: f64 = 1.0 + 4.0 * f64::EPSILON;

/// A closed box in `f32`, relative to the reference point of its tree. The fourth lane is zero and
/// makes unions whole vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

impl Bounds {
    /// The box that holds nothing and changes no union.
    pub(super) const EMPTY: Self = Self {
        low: [f32::INFINITY; 4],
        high: [f32::NEG_INFINITY; 4],
    };

    /// The box relative to `reference`, rounded outward. Both the subtraction and the cast round to
    /// nearest; one step outward makes up for both, as a unit of `f64` is far less than one of
    /// `f32`.
    pub(super) fn around(aabb: Aabb, reference: DVec3) -> Self {
        let [x, y, z] = (aabb.min - reference).as_vec3().to_array();
        let [u, v, w] = (aabb.max - reference).as_vec3().to_array();
        Self {
            low: [x.next_down(), y.next_down(), z.next_down(), 0.0],
            high: [u.next_up(), v.next_up(), w.next_up(), 0.0],
        }
    }

    /// Whether all planes are finite.
    pub(super) fn is_finite(&self) -> bool {
        self.low.iter().chain(&self.high).all(|x| x.is_finite())
    }

    /// The smallest box around both.
    #[inline]
    pub(super) fn union(&self, other: &Self) -> Self {
        Self {
            low: array::from_fn(|i| least(self.low[i], other.low[i])),
            high: array::from_fn(|i| greatest(self.high[i], other.high[i])),
        }
    }

    /// The centre.
    #[inline]
    pub(super) fn centre(&self) -> [f32; 4] {
        array::from_fn(|i| 0.5 * self.low[i] + 0.5 * self.high[i])
    }

    /// Half the surface, in `f64` because squares of `f32` overflow; 0 for an empty box.
    #[inline]
    pub(super) fn half_area(&self) -> f64 {
        let [x, y, z]: [f64; 3] =
            array::from_fn(|i| (f64::from(self.high[i]) - f64::from(self.low[i])).max(0.0));
        x * y + y * z + z * x
    }
}

/// `f32::min` for numbers that are never NaN: one instruction instead of three.
#[inline]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// `f32::max` for numbers that are never NaN.
#[inline]
fn greatest(a: f32, b: f32) -> f32 {
    if b < a { a } else { b }
}

/// What a child of a node is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Child {
    /// The node with this number.
    Inner(u32),
    /// A run of the tree's indices.
    Leaf { first: u32, count: u8 },
}

/// The boxes of up to [`WIDTH`] children, planes side by side so that one vector holds one plane of
/// all of them. Four cache lines.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// By axis, then low or high, then child. A missing child has an empty box.
    planes: [[[f32; WIDTH]; 2]; 3],
    /// The node of an inner child, the first index of a leaf.
    first: [u32; WIDTH],
    /// The number of indices of a leaf, [`INNER`] for a node.
    count: [u8; WIDTH],
}

/// The count that marks an inner child.
const INNER: u8 = u8::MAX;

impl Node {
    /// A node without children: its lanes are leaves that hold nothing, in boxes no ray meets.
    pub(super) const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        first: [0; WIDTH],
        count: [0; WIDTH],
    };

    /// Fills one lane.
    pub(super) fn put(&mut self, lane: usize, bounds: &Bounds, child: Child) {
        for (axis, [low, high]) in self.planes.iter_mut().enumerate() {
            low[lane] = bounds.low[axis];
            high[lane] = bounds.high[axis];
        }
        (self.first[lane], self.count[lane]) = match child {
            Child::Inner(node) => (node, INNER),
            Child::Leaf { first, count } => (first, count),
        };
    }

    /// Adds `offset` to the numbers of the nodes below.
    pub(super) fn shift(&mut self, offset: u32) {
        for (first, &count) in self.first.iter_mut().zip(&self.count) {
            if count == INNER {
                *first += offset;
            }
        }
    }

    /// The child in a lane.
    #[inline]
    pub(super) fn child(&self, lane: usize) -> Child {
        match self.count[lane] {
            INNER => Child::Inner(self.first[lane]),
            count => Child::Leaf {
                first: self.first[lane],
                count,
            },
        }
    }

    /// The box of the child in a lane.
    pub(super) fn bounds(&self, lane: usize) -> Bounds {
        let plane = |side: usize, axis: usize| match self.planes.get(axis) {
            Some(sides) => sides[side][lane],
            None => 0.0,
        };
        Bounds {
            low: array::from_fn(|axis| plane(0, axis)),
            high: array::from_fn(|axis| plane(1, axis)),
        }
    }

    /// A bit for each lane that something is in.
    #[inline]
    pub(super) fn filled(&self) -> u32 {
        let mut filled = 0;
        for (lane, &count) in self.count.iter().enumerate() {
            filled |= u32::from(count != 0) << lane;
        }
        filled
    }

    /// The planes of all children across an axis, those on a side first.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub(super) fn planes<S: Simd>(&self, simd: S, axis: usize, side: usize) -> [Eight<S>; 2] {
        sorted(simd, &self.planes[axis], side)
    }

    /// The low and the high plane across an axis of the box in a lane.
    #[inline]
    pub(super) fn box_planes(&self, lane: usize, axis: usize) -> [f64; 2] {
        let [low, high] = &self.planes[axis];
        [f64::from(low[lane]), f64::from(high[lane])]
    }

    /// The distances at which the ray enters the children's boxes, 0 inside of one, and a bit for
    /// each child that it enters at a distance up to `limit`, both with the margin of [`WIDEN`].
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub(super) fn entries<S: Simd>(&self, ray: &SlabRay<S>, limit: f64) -> ([f64; WIDTH], u32) {
        let simd = ray.slopes[0].inverse.simd;
        let mut entry = Eight::splat(simd, 0.0);
        let mut exit = Eight::splat(simd, limit);
        for (sides, slope) in self.planes.iter().zip(&ray.slopes) {
            let [near, far] = sorted(simd, sides, slope.near_side);
            let near = (near - slope.near_origin) * slope.inverse;
            let far = (far - slope.far_origin) * slope.inverse;
            [entry, exit] = cut([entry, exit], near, far);
        }
        let met = entry.up_to(exit * WIDEN);
        (*entry, bits::<S>(met))
    }
}

/// Planes of both sides in `f64`, those of a side first.
#[expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take this with it"
)]
#[inline(always)]
fn sorted<S: Simd>(simd: S, sides: &[[f32; WIDTH]; 2], side: usize) -> [Eight<S>; 2] {
    [
        widened(simd, &sides[side & 1]),
        widened(simd, &sides[side & 1 ^ 1]),
    ]
}

/// Planes in `f64`.
#[expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take this with it"
)]
#[inline(always)]
fn widened<S: Simd>(simd: S, planes: &[f32; WIDTH]) -> Eight<S> {
    let mut widened = [0.0; WIDTH];
    for lane in 0..WIDTH {
        widened[lane] = f64::from(planes[lane]);
    }
    Eight::load_array(simd, widened)
}

/// The part of an interval that is beyond the `near` and before the `far`. A NaN, 0 · ∞ of a ray that
/// runs in a face, fails the comparison and cuts nothing.
#[expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take this with it"
)]
#[inline(always)]
pub(super) fn cut<N: Lanes>([entry, exit]: [N; 2], near: N, far: N) -> [N; 2] {
    [entry.larger(near), exit.smaller(far)]
}

/// A ray as nodes test it.
pub(super) struct SlabRay<S: Simd> {
    slopes: [Slope<S>; 3],
}

/// A ray along one axis, in each lane the same.
struct Slope<S: Simd> {
    /// 1 over the direction; infinite for 0, with its sign.
    inverse: Eight<S>,
    /// The origin against planes where the ray comes in, such that they are not too far.
    near_origin: Eight<S>,
    /// The origin against planes where the ray goes out, such that they are not too near.
    far_origin: Eight<S>,
    /// Where the ray comes in: 0 for low planes, 1 for high ones.
    near_side: usize,
}

impl<S: Simd> SlabRay<S> {
    /// A ray by 1 over its direction and its origin against low and high planes, along each axis.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub(super) fn of(simd: S, [x, y, z]: [[f64; 3]; 3]) -> Self {
        Self {
            slopes: [
                Slope::of(simd, x[0], x[1], x[2]),
                Slope::of(simd, y[0], y[1], y[2]),
                Slope::of(simd, z[0], z[1], z[2]),
            ],
        }
    }

    /// The ray relative to the reference point of a tree.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub(super) fn new(simd: S, ray: &Ray, reference: DVec3) -> Self {
        let Ray { origin, direction } = ray;
        Self {
            slopes: [
                Slope::new(simd, origin.x, direction.x, reference.x),
                Slope::new(simd, origin.y, direction.y, reference.y),
                Slope::new(simd, origin.z, direction.z, reference.z),
            ],
        }
    }
}

impl<S: Simd> Slope<S> {
    /// A ray by 1 over its direction and its origin against low and high planes.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    fn of(simd: S, inverse: f64, low: f64, high: f64) -> Self {
        let rises = inverse.is_sign_positive();
        let (near, far) = if rises { (low, high) } else { (high, low) };
        Self {
            inverse: Eight::splat(simd, inverse),
            near_origin: Eight::splat(simd, near),
            far_origin: Eight::splat(simd, far),
            near_side: usize::from(!rises),
        }
    }

    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    fn new(simd: S, origin: f64, direction: f64, reference: f64) -> Self {
        let [below, above] = difference(origin, reference);
        Self::of(simd, direction.recip(), above, below)
    }
}

/// The nearest `f64`s not above and not below the exact a − b. The sign of the rounding error is
/// that of Knuth's two-sum, which is exact.
#[inline]
pub(super) fn difference(a: f64, b: f64) -> [f64; 2] {
    let sum = a - b;
    let part = sum - a;
    let error = (a - (sum - part)) - (b + part);
    if error < 0.0 {
        [sum.next_down(), sum]
    } else if 0.0 < error {
        [sum, sum.next_up()]
    } else {
        [sum, sum]
    }
}
