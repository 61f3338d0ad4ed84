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

/// Lines prepared for tests against triangles, whose directions have their largest components on the
/// same axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared<N> {
    /// The axes, that of the largest component of the direction last. Coordinates are in their order,
    /// those of triangles too.
    pub(super) axes: [usize; 3],
    origin: [N; 3],
    /// The slopes of the other two along that axis, and 1 over the component along it.
    shear: [N; 3],
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
        let [first, second, along] = ordered(direction, is_x, is_y);
        Self {
            is_x,
            is_y,
            slopes: [first / along, second / along, along.all(1.0) / along],
        }
    }

    /// Intersects lines from origins with triangles: see [`Sheared::crossing`].
    #[inline(always)]
    pub(super) fn crossing(
        &self,
        origin: Vector<N>,
        [a, b, c]: [Vector<N>; 3],
    ) -> Option<(Crossing<N>, N::Mask)> {
        let lines = Sheared {
            // The coordinates are already in order.
            axes: [0, 1, 2],
            origin: ordered(origin, self.is_x, self.is_y),
            shear: self.slopes,
        };
        lines.crossing([
            ordered(a, self.is_x, self.is_y),
            ordered(b, self.is_x, self.is_y),
            ordered(c, self.is_x, self.is_y),
        ])
    }
}

/// The coordinates in the order of [`axes`], in each lane: the last is that on the first axis where
/// `is_x`, on the second where `is_y`, otherwise on the third.
#[inline(always)]
fn ordered<N: Lanes>(Vector { x, y, z }: Vector<N>, is_x: N::Mask, is_y: N::Mask) -> [N; 3] {
    [
        N::select(is_x, y, N::select(is_y, z, x)),
        N::select(is_x, z, N::select(is_y, x, y)),
        N::select(is_x, x, N::select(is_y, y, z)),
    ]
}

impl Shears<f64> {
    /// A line from an origin.
    #[inline(always)]
    pub(super) fn sheared(&self, origin: DVec3) -> Sheared<f64> {
        let last = if self.is_x {
            0
        } else if self.is_y {
            1
        } else {
            2
        };
        let axes = axes(last);
        Sheared {
            axes,
            origin: permuted(origin.to_array(), axes),
            shear: self.slopes,
        }
    }
}

impl<S: Simd> Shears<Eight<S>> {
    /// The line in a lane, from an origin.
    #[inline(always)]
    pub(super) fn lane(&self, origin: DVec3, lane: usize) -> Sheared<f64> {
        let [x, y, z] = self.slopes;
        let of_lane = Shears {
            is_x: bits::<S>(self.is_x) >> lane & 1 == 1,
            is_y: bits::<S>(self.is_y) >> lane & 1 == 1,
            slopes: [x[lane], y[lane], z[lane]],
        };
        of_lane.sheared(origin)
    }

    /// The lines from origins; `None` if their largest components are on different axes in the lanes
    /// whose bit is 1.
    #[inline(always)]
    pub(super) fn sheared_together(
        &self,
        origin: Vector<Eight<S>>,
        lanes: u32,
    ) -> Option<Sheared<Eight<S>>> {
        let (is_x, is_y) = (bits::<S>(self.is_x) & lanes, bits::<S>(self.is_y) & lanes);
        let last = match (is_x, is_y) {
            _ if is_x == lanes => 0,
            _ if is_y == lanes => 1,
            (0, 0) => 2,
            _ => return None,
        };
        let axes = axes(last);
        Some(Sheared {
            axes,
            origin: permuted([origin.x, origin.y, origin.z], axes),
            shear: self.slopes,
        })
    }
}

/// Numbers in the order of axes.
#[inline(always)]
fn permuted<N: Copy>(numbers: [N; 3], [i, j, k]: [usize; 3]) -> [N; 3] {
    [numbers[i], numbers[j], numbers[k]]
}

/// The axes, the given one last.
#[inline(always)]
fn axes(last: usize) -> [usize; 3] {
    [(last + 1) % 3, (last + 2) % 3, last]
}

/// The point where a line crosses a triangle, in each lane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing<N> {
    /// The distance, in units of the line's direction.
    pub(super) t: N,
    /// The barycentric coordinates, none below 0, with sum 1.
    pub(super) weights: [N; 3],
}

impl Sheared<f64> {
    /// Vertices with their coordinates in the order of the line's axes.
    #[inline(always)]
    pub(super) fn corners(&self, [a, b, c]: [DVec3; 3]) -> [[f64; 3]; 3] {
        let axes = self.axes;
        [
            permuted(a.to_array(), axes),
            permuted(b.to_array(), axes),
            permuted(c.to_array(), axes),
        ]
    }
}

impl<S: Simd> Sheared<Eight<S>> {
    /// Vertices in all lanes, with their coordinates in the order of the lines' axes.
    #[inline(always)]
    pub(super) fn splat(&self, [a, b, c]: [DVec3; 3]) -> [[Eight<S>; 3]; 3] {
        [self.splat_one(a), self.splat_one(b), self.splat_one(c)]
    }

    #[inline(always)]
    fn splat_one(&self, corner: DVec3) -> [Eight<S>; 3] {
        let simd = self.origin[0].simd;
        let [x, y, z] = permuted(corner.to_array(), self.axes);
        [
            SimdBase::splat(simd, x),
            SimdBase::splat(simd, y),
            SimdBase::splat(simd, z),
        ]
    }
}

impl<N: Lanes> Sheared<N> {
    /// Intersects lines with triangles: valid where the mask is true; `None` if it is nowhere. A line
    /// in the plane of a triangle does not cross it.
    #[inline(always)]
    pub(super) fn crossing(&self, corners: [[N; 3]; 3]) -> Option<(Crossing<N>, N::Mask)> {
        let [a, b, c] = self.transformed(corners);
        let misses = is_outside([edge(c, b), edge(a, c), edge(b, a)]);
        if !N::any(!misses) {
            return None;
        }
        // In a needle-shaped triangle the products of an edge function nearly cancel: signs are
        // right, but a distance needs more precision. Few triangles come this far.
        let [u, v, w] = [exact_edge(c, b), exact_edge(a, c), exact_edge(b, a)];
        let area = u + v + w;
        let crosses = !misses & !area.equals(area.all(0.0));
        let crossing = Crossing {
            t: (u * a[2] + v * b[2] + w * c[2]) / area,
            weights: [u / area, v / area, w / area],
        };
        N::any(crosses).then_some((crossing, crosses))
    }

    /// The vertices relative to the lines: two coordinates across them, one along them.
    #[inline(always)]
    fn transformed(&self, [a, b, c]: [[N; 3]; 3]) -> [[N; 3]; 3] {
        [self.relative(a), self.relative(b), self.relative(c)]
    }

    #[inline(always)]
    fn relative(&self, corner: [N; 3]) -> [N; 3] {
        let (x, y, z) = (
            corner[0] - self.origin[0],
            corner[1] - self.origin[1],
            corner[2] - self.origin[2],
        );
        let [shear_x, shear_y, shear_z] = self.shear;
        [x - shear_x * z, y - shear_y * z, shear_z * z]
    }
}

/// Lines as in [`Sheared`], one in each lane or one in all, prepared for tests in single precision.
#[derive(Clone, Copy, Debug)]
pub(super) struct Roughly<S: Simd> {
    /// As in [`Sheared`].
    pub(super) axes: [usize; 3],
    origin: [Singles<S>; 3],
    shear: [Singles<S>; 2],
    /// A bound of the error of a transformed coordinate.
    error: Singles<S>,
}

/// The unit roundoff of single precision.
const ROUNDOFF: f32 = f32::EPSILON / 2.0;

impl<S: Simd> Roughly<S> {
    /// One line in all lanes.
    #[inline(always)]
    pub(super) fn all(simd: S, line: &Sheared<f64>) -> Self {
        let [x, y, z] = line.origin;
        let [shear_x, shear_y, _] = line.shear;
        Self::new(
            line.axes,
            [splat(simd, x), splat(simd, y), splat(simd, z)],
            [splat(simd, shear_x), splat(simd, shear_y)],
        )
    }

    /// Those lines.
    #[inline(always)]
    pub(super) fn each(lines: &Sheared<Eight<S>>) -> Self {
        let [x, y, z] = lines.origin;
        let [shear_x, shear_y, _] = lines.shear;
        Self::new(
            lines.axes,
            [singles(x), singles(y), singles(z)],
            [singles(shear_x), singles(shear_y)],
        )
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
            axes,
            origin,
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
        let most = largest(a).max(largest(b)).max(largest(c));
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
        let [x, y, z] = self.origin;
        let (x, y, z) = (corner[0] - x, corner[1] - y, corner[2] - z);
        let [shear_x, shear_y] = self.shear;
        [x - shear_x * z, y - shear_y * z]
    }
}

/// A number rounded to single precision, in all lanes.
#[inline(always)]
fn splat<S: Simd>(simd: S, number: f64) -> Singles<S> {
    SimdBase::splat(simd, number as f32)
}

/// The larger magnitude.
#[inline(always)]
fn largest<S: Simd>([x, y]: [Singles<S>; 2]) -> Singles<S> {
    x.abs().max(y.abs())
}

/// [`edge`] in each lane, with three roundings; its sign may be wrong.
#[inline(always)]
fn across<S: Simd>(a: [Singles<S>; 2], b: [Singles<S>; 2]) -> Singles<S> {
    a[0] * b[1] - a[1] * b[0]
}

/// Whether edge functions have different signs.
#[inline(always)]
fn is_outside<N: Lanes>([u, v, w]: [N; 3]) -> N::Mask {
    let zero = u.all(0.0);
    let is_below = u.below(zero) | v.below(zero) | w.below(zero);
    let is_above = zero.below(u) | zero.below(v) | zero.below(w);
    is_below & is_above
}

/// Twice the signed area of the triangle of an edge and the origin. The sign is exact: rounded
/// products compare correctly unless they are equal.
#[inline(always)]
fn edge<N: Lanes>(a: [N; 3], b: [N; 3]) -> N {
    let (first, second) = (a[0] * b[1], a[1] * b[0]);
    let are_equal = first.equals(second);
    let difference = first - second;
    if !N::any(are_equal) {
        return difference;
    }
    N::select(are_equal, exact_edge(a, b), difference)
}

/// The same area, as if rounded once or twice.
#[inline(always)]
fn exact_edge<N: Lanes>([ax, ay, _]: [N; 3], [bx, by, _]: [N; 3]) -> N {
    exact_difference([ax, by], [ay, bx])
}
