//! Wide nodes, whose children's boxes are tested against a ray at once.

use std::array;

use glam::DVec3;

use super::slab::{SlabRay, Slope, is_open_in_lanes};
use geometry::Aabb;
use geometry::lanes::{Simd, SimdBase, Singles, bits};

/// The maximum number of children of a node.
pub(super) const WIDTH: usize = 8;

/// A closed box in `f32`, relative to the reference point of its tree. The fourth lane lets unions use
/// whole vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bounds {
    pub(super) low: [f32; 4],
    pub(super) high: [f32; 4],
}

impl Bounds {
    /// The empty box, neutral under union.
    pub(super) const EMPTY: Self = Self {
        low: [f32::INFINITY; 4],
        high: [f32::NEG_INFINITY; 4],
    };

    /// The box relative to `reference`, rounded outward. Both the subtraction and the cast round to
    /// nearest; one step outward covers both, as an ulp of `f64` is far less than one of `f32`.
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
        let [low, high] = [&self.low[..3], &self.high[..3]];
        low.iter().chain(high).all(|x| x.is_finite())
    }

    /// The smallest box that contains both.
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
        array::from_fn(|i| self.middle(i))
    }

    /// The centre along one axis.
    #[inline]
    pub(super) fn middle(&self, axis: usize) -> f32 {
        0.5 * self.low[axis] + 0.5 * self.high[axis]
    }

    /// Half the surface area, in `f64` because squares of `f32` overflow; 0 for an empty box.
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

/// A child of a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Child {
    /// The node with this index.
    Inner(u32),
    /// A run in the tree's order of boxes.
    Leaf { first: u32, count: u8 },
}

/// The boxes of up to [`WIDTH`] children, laid out so that one vector holds one plane of all of
/// them. Four cache lines.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// Indexed by axis, then low or high, then child. A missing child has an empty box.
    planes: [[[f32; WIDTH]; 2]; 3],
    children: [Link; WIDTH],
}

/// A [`Child`] in one word: the node index of an inner child or the start of a leaf's run, and above
/// it the length of the run, or [`INNER`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Link(u64);

/// The length that marks an inner child.
const INNER: u64 = 1 << 31;

impl From<Child> for Link {
    #[inline(always)]
    fn from(child: Child) -> Self {
        match child {
            Child::Inner(node) => Self(INNER << 32 | u64::from(node)),
            Child::Leaf { first, count } => Self(u64::from(count) << 32 | u64::from(first)),
        }
    }
}

impl From<Link> for Child {
    #[inline(always)]
    fn from(Link(link): Link) -> Self {
        let first = link as u32;
        match link >> 32 {
            INNER => Self::Inner(first),
            count => Self::Leaf {
                first,
                count: count as u8,
            },
        }
    }
}

impl Link {
    /// A leaf without boxes.
    const EMPTY: Self = Self(0);

    /// The root of a tree.
    pub(super) const ROOT: Self = Self(INNER << 32);
}

impl Node {
    /// A node without children: all lanes are empty leaves in empty boxes.
    pub(super) const EMPTY: Self = Self {
        planes: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        children: [Link::EMPTY; WIDTH],
    };

    /// Sets the child in a lane.
    pub(super) fn put(&mut self, lane: usize, bounds: &Bounds, child: Child) {
        for (axis, [low, high]) in self.planes.iter_mut().enumerate() {
            low[lane] = bounds.low[axis];
            high[lane] = bounds.high[axis];
        }
        self.children[lane] = child.into();
    }

    /// Adds `offset` to the node indices of the children.
    pub(super) fn shift(&mut self, offset: u32) {
        for link in &mut self.children {
            if let Child::Inner(node) = (*link).into() {
                *link = Child::Inner(node + offset).into();
            }
        }
    }

    /// The child in a lane.
    #[inline]
    pub(super) fn child(&self, lane: usize) -> Child {
        self.link(lane).into()
    }

    /// The same, in one word.
    #[inline(always)]
    pub(super) fn link(&self, lane: usize) -> Link {
        self.children[lane]
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

    /// A mask of the lanes with a child.
    #[inline]
    pub(super) fn filled(&self) -> u32 {
        let mut filled = 0;
        for (lane, &link) in self.children.iter().enumerate() {
            filled |= u32::from(link != Link::EMPTY) << lane;
        }
        filled
    }

    /// The largest distance of a plane from the reference point.
    pub(super) fn farthest(&self) -> f64 {
        let planes = self.planes.iter().flatten().flatten();
        let finite = planes.copied().filter(|plane| plane.is_finite());
        finite.fold(0.0, |farthest, plane| farthest.max(f64::from(plane.abs())))
    }

    /// The planes of all children across an axis, those of `side` first.
    #[inline(always)]
    pub(super) fn planes<S: Simd>(&self, simd: S, axis: usize, side: usize) -> [Singles<S>; 2] {
        let sides = &self.planes[axis];
        let [first, second] = [side & 1, side & 1 ^ 1];
        [
            Singles::load_array(simd, sides[first]),
            Singles::load_array(simd, sides[second]),
        ]
    }

    /// The low and the high plane across an axis of the box in a lane.
    #[inline]
    pub(super) fn box_planes(&self, lane: usize, axis: usize) -> [f32; 2] {
        let [low, high] = &self.planes[axis];
        [low[lane], high[lane]]
    }

    /// Half the surface area of the box in a lane; infinite or NaN where it overflows.
    #[inline(always)]
    pub(super) fn half_area(&self, lane: usize) -> f32 {
        let [x, y, z] = [0, 1, 2].map(
            #[inline(always)]
            |axis| {
                let [low, high] = self.box_planes(lane, axis);
                high - low
            },
        );
        x * y + y * z + z * x
    }

    /// Returns the distances at which the ray enters the children's boxes, or starts inside, and a
    /// mask of the children whose box it may enter at a distance up to `limit`.
    #[inline(always)]
    pub(super) fn entries<S: Simd>(&self, ray: &SlabRay<S>, limit: f32) -> ([f32; WIDTH], u32) {
        let simd = ray.slopes[0].inverse.simd;
        let [x, y, z] = &ray.slopes;
        let [(x_near, x_far), (y_near, y_far), (z_near, z_far)] = [
            self.crossings(simd, 0, x),
            self.crossings(simd, 1, y),
            self.crossings(simd, 2, z),
        ];
        // A maximum with NaN, which 0 · ∞ is for a ray in a face, may be either number: it clips no more
        // than it should.
        let near = x_near.max(y_near).max(z_near);
        let far = x_far.min(y_far).min(z_far);
        let entry = Singles::splat(simd, ray.start).max_precise(near);
        let exit = Singles::splat(simd, limit).min_precise(far);
        (*entry, bits::<S>(is_open_in_lanes([entry, exit])))
    }

    /// The distances at which the ray crosses the children's planes across an axis, the nearer first.
    #[inline(always)]
    fn crossings<S: Simd>(
        &self,
        simd: S,
        axis: usize,
        slope: &Slope<S>,
    ) -> (Singles<S>, Singles<S>) {
        let [near, far] = self.planes(simd, axis, slope.near_side);
        (
            (near - slope.near_origin) * slope.inverse,
            (far - slope.far_origin) * slope.inverse,
        )
    }
}
