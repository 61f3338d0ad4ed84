//! Watertight ray–triangle intersection: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
//! Intersection", JCGT 2 (2013).
//!
//! Vertices are transformed to a space where the ray starts at the origin and runs along z, each by
//! itself, so that all triangles that share a vertex have it at the same position. There the signs
//! of the edge functions show whether the origin is inside. They are exact for the rounded
//! vertices, so two triangles agree on the side of a shared edge, and edges belong to both: no ray
//! slips through a closed mesh, however the vertices were rounded.

use glam::DVec3;

use super::lanes::{Eight, Lanes, Simd, SimdBase, Singles, Vector, bits, singles};
use super::transform::exact_difference;

/// A line prepared for tests against triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared {
    origin: DVec3,
    /// The axes, the one of the largest component of the direction last.
    axes: [usize; 3],
    /// The slopes of the other two along that axis, and 1 over the component along it.
    shear: [f64; 3],
}

/// The axes and slopes of [`Sheared`], in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shears<N: Lanes> {
    /// Whether the largest component of the direction is that on the first axis.
    is_x: N::Mask,
    /// Whether it is that on the second.
    is_y: N::Mask,
    slopes: [N; 3],
}

impl<N: Lanes> Shears<N> {
    /// Of directions of any length.
    #[inline(always)]
    pub(super) fn new(direction: Vector<N>) -> Self {
        let size = direction.abs();
        let is_x = size.y.up_to(size.x) & size.z.up_to(size.x);
        let is_y = !is_x & size.z.up_to(size.y);
        let Vector { x, y, z } = direction;
        let along = N::select(is_x, x, N::select(is_y, y, z));
        let first = N::select(is_x, y, N::select(is_y, z, x));
        let second = N::select(is_x, z, N::select(is_y, x, y));
        Self {
            is_x,
            is_y,
            slopes: [first / along, second / along, along.all(1.0) / along],
        }
    }
}

impl Shears<f64> {
    /// A line from an origin.
    #[inline(always)]
    pub(super) fn sheared(&self, origin: DVec3) -> Sheared {
        let last = if self.is_x {
            0
        } else if self.is_y {
            1
        } else {
            2
        };
        Sheared {
            origin,
            axes: axes(last),
            shear: self.slopes,
        }
    }
}

impl<S: Simd> Shears<Eight<S>> {
    /// The line in a lane, from an origin.
    #[inline(always)]
    pub(super) fn lane(&self, origin: DVec3, lane: usize) -> Sheared {
        let [x, y, z] = self.slopes;
        let of_lane = Shears {
            is_x: bits::<S>(self.is_x) >> lane & 1 == 1,
            is_y: bits::<S>(self.is_y) >> lane & 1 == 1,
            slopes: [x[lane], y[lane], z[lane]],
        };
        of_lane.sheared(origin)
    }

    /// The axes, if they are the same in all lanes whose bit is 1.
    #[inline(always)]
    fn common_axes(&self, lanes: u32) -> Option<[usize; 3]> {
        let (is_x, is_y) = (bits::<S>(self.is_x) & lanes, bits::<S>(self.is_y) & lanes);
        if is_x == lanes {
            Some(axes(0))
        } else if is_y == lanes {
            Some(axes(1))
        } else if is_x | is_y == 0 {
            Some(axes(2))
        } else {
            None
        }
    }
}

/// The axes, the given one last.
#[inline(always)]
fn axes(last: usize) -> [usize; 3] {
    [(last + 1) % 3, (last + 2) % 3, last]
}

/// The point where a line crosses a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// The distance, in units of the line's direction.
    pub(super) t: f64,
    /// The barycentric coordinates, none below 0, with sum 1.
    pub(super) weights: [f64; 3],
}

impl Sheared {
    /// Intersects the line with a triangle. A line in its plane does not cross it.
    #[inline]
    pub(super) fn crossing(&self, corners: [DVec3; 3]) -> Option<Crossing> {
        let [a, b, c] = corners;
        let (a, b, c) = (
            self.transformed(a),
            self.transformed(b),
            self.transformed(c),
        );
        let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
        if (u < 0.0 || v < 0.0 || w < 0.0) && (0.0 < u || 0.0 < v || 0.0 < w) {
            return None;
        }
        // In a needle-shaped triangle the products of an edge function nearly cancel: signs are
        // right, but a distance needs more precision. Few triangles come this far.
        let (u, v, w) = (exact_edge(c, b), exact_edge(a, c), exact_edge(b, a));
        let area = u + v + w;
        if area == 0.0 {
            return None;
        }
        Some(Crossing {
            t: (u * a[2] + v * b[2] + w * c[2]) / area,
            weights: [u / area, v / area, w / area],
        })
    }

    /// A vertex relative to the line: two coordinates across it, one along it.
    #[inline]
    fn transformed(&self, corner: DVec3) -> [f64; 3] {
        let offset = (corner - self.origin).to_array();
        let [i, j, k] = self.axes;
        let (x, y, z) = (offset[i], offset[j], offset[k]);
        let [shear_x, shear_y, shear_z] = self.shear;
        [x - shear_x * z, y - shear_y * z, shear_z * z]
    }
}

/// One line in all lanes, or several whose directions have their largest component on the same axis,
/// prepared for tests in single precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roughly<S: Simd> {
    origin: [Singles<S>; 3],
    axes: [usize; 3],
    shear: [Singles<S>; 2],
    /// A bound of the error of a transformed coordinate.
    error: Singles<S>,
}

/// The unit roundoff of single precision.
const ROUNDOFF: f32 = f32::EPSILON / 2.0;

impl<S: Simd> Roughly<S> {
    /// One line in all lanes.
    #[inline(always)]
    pub(super) fn all(simd: S, line: &Sheared) -> Self {
        let splat = |number: f64| Singles::splat(simd, number as f32);
        let [i, j, k] = line.axes;
        let (x, y, z) = (line.origin[i], line.origin[j], line.origin[k]);
        let [shear_x, shear_y, _] = line.shear;
        Self::new(
            line.axes,
            [splat(x), splat(y), splat(z)],
            [splat(shear_x), splat(shear_y)],
        )
    }

    /// A line in each lane whose bit is 1; `None` if their largest components are on different axes.
    #[inline(always)]
    pub(super) fn each(
        origin: &Vector<Eight<S>>,
        shears: &Shears<Eight<S>>,
        lanes: u32,
    ) -> Option<Self> {
        let axes = shears.common_axes(lanes)?;
        let origin = [origin.x, origin.y, origin.z];
        let [i, j, k] = axes;
        let [slope_x, slope_y, _] = shears.slopes;
        Some(Self::new(
            axes,
            [singles(origin[i]), singles(origin[j]), singles(origin[k])],
            [singles(slope_x), singles(slope_y)],
        ))
    }

    /// The error of a transformed coordinate, for vertices in unit space, none of whose coordinates is
    /// above 1: with u the unit roundoff and o the largest coordinate of the origin, those of a vertex and
    /// of the origin are off by u and o u. Their difference, at most 1 + o, is rounded too, and off by
    /// 2 (1 + o) u. Its product with a slope of at most 1 is off by 4 (1 + o) u, with the roundings of the
    /// slope and of the product. The result, at most 2 (1 + o), is off by their sum and by its own
    /// rounding: by 8 (1 + o) u, up to terms in u². Roundings in double precision are far smaller.
    #[inline(always)]
    fn new(axes: [usize; 3], origin: [Singles<S>; 3], shear: [Singles<S>; 2]) -> Self {
        let [x, y, z] = origin;
        let reach = x.abs().max(y.abs()).max(z.abs()) + 1.0;
        Self {
            origin,
            axes,
            shear,
            error: reach * (10.0 * ROUNDOFF),
        }
    }

    /// The token of the vector instructions.
    #[inline(always)]
    pub(super) fn simd(&self) -> S {
        self.error.simd
    }

    /// A mask of the lanes in which the line may cross the triangle by [`Sheared::crossing`]: all but
    /// those in which it surely does not.
    ///
    /// If no transformed coordinate is above m or off by more than e, then a product is off by at most
    /// 2 m e + e² and by m² u for its own rounding, and an edge function by twice that and by the rounding
    /// of the difference, which is at most 2 m²: by 4 m e + 2 e² + 4 m² u in all. The factors below are
    /// larger to cover the rounding of the bound itself. NaN rejects nothing.
    #[inline(always)]
    pub(super) fn may_cross(&self, corners: [[Singles<S>; 3]; 3]) -> u32 {
        let [a, b, c] = corners;
        let (a, b, c) = (
            self.transformed(a),
            self.transformed(b),
            self.transformed(c),
        );
        let (u, v, w) = (across(c, b), across(a, c), across(b, a));
        let most = |[x, y]: [Singles<S>; 2]| x.abs().max(y.abs());
        let most = most(a).max(most(b)).max(most(c));
        let error = self.error;
        let bound = most * (error * 5.0 + most * (8.0 * ROUNDOFF)) + error * error * 4.0;
        let below = -bound;
        let is_below = u.simd_lt(below) | v.simd_lt(below) | w.simd_lt(below);
        let is_above = u.simd_gt(bound) | v.simd_gt(bound) | w.simd_gt(bound);
        bits::<S>(!(is_below & is_above))
    }

    /// The two coordinates of a vertex across the lines.
    #[inline(always)]
    fn transformed(&self, corner: [Singles<S>; 3]) -> [Singles<S>; 2] {
        let [i, j, k] = self.axes;
        let [x, y, z] = self.origin;
        let (x, y, z) = (corner[i] - x, corner[j] - y, corner[k] - z);
        let [shear_x, shear_y] = self.shear;
        [x - shear_x * z, y - shear_y * z]
    }
}

/// [`edge`] in each lane, with three roundings; its sign may be wrong.
#[inline(always)]
fn across<S: Simd>(a: [Singles<S>; 2], b: [Singles<S>; 2]) -> Singles<S> {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the signed area of the triangle of an edge and the origin. The sign is exact: rounded
/// products compare correctly unless they are equal.
#[inline]
fn edge(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (first, second) = (a[0] * b[1], a[1] * b[0]);
    if first == second {
        exact_edge(a, b)
    } else {
        first - second
    }
}

/// The same, as if rounded once or twice.
#[inline]
fn exact_edge([ax, ay, _]: [f64; 3], [bx, by, _]: [f64; 3]) -> f64 {
    exact_difference([ax, by], [ay, bx])
}
