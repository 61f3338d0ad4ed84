//! Watertight ray–triangle intersection: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
//! Intersection", JCGT 2 (2013).
//!
//! Vertices are transformed to a space where the ray starts at the origin and runs along z, each by
//! itself, so that all triangles that share a vertex have it at the same position. There the signs
//! of the edge functions show whether the origin is inside. They are exact for the rounded
//! vertices, so two triangles agree on the side of a shared edge, and edges belong to both: no ray
//! slips through a closed mesh, however the vertices were rounded.

use glam::DVec3;

use super::lanes::{Eight, Lanes, Simd, SimdBase, WIDTH, bits};
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

/// The point where a line crosses a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// The distance, in units of the line's direction.
    pub(super) t: f64,
    /// The barycentric coordinates, none below 0, with sum 1.
    pub(super) weights: [f64; 3],
}

impl Sheared {
    /// Prepares the line from `origin` along `direction`, of any length.
    #[inline]
    pub(super) fn new(origin: DVec3, direction: DVec3) -> Self {
        let size = direction.abs();
        let z = if size.y <= size.x && size.z <= size.x {
            0
        } else if size.z <= size.y {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let [x, y, z] = axes.map(|axis| direction[axis]);
        Self {
            origin,
            axes,
            shear: [x / z, y / z, z.recip()],
        }
    }

    /// Intersects the line with a triangle. A line in its plane does not cross it.
    #[inline]
    pub(super) fn crossing(&self, corners: [DVec3; 3]) -> Option<Crossing> {
        let [a, b, c] = corners.map(|corner| self.transformed(corner));
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
        let [x, y, z] = self.axes.map(|axis| offset[axis]);
        let [shear_x, shear_y, shear_z] = self.shear;
        [x - shear_x * z, y - shear_y * z, shear_z * z]
    }
}

/// Lines whose directions have their largest component on the same axis, one per lane, prepared for
/// tests against triangles.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShearedLines<S: Simd> {
    origin: [Eight<S>; 3],
    axes: [usize; 3],
    shear: [Eight<S>; 2],
}

impl<S: Simd> ShearedLines<S> {
    /// Returns `None` if the largest components are on different axes.
    #[inline(always)]
    pub(super) fn new(simd: S, lines: [&Sheared; WIDTH]) -> Option<Self> {
        let axes = lines[0].axes;
        let mut numbers = [[0.0; WIDTH]; 5];
        for (lane, line) in lines.into_iter().enumerate() {
            if line.axes != axes {
                return None;
            }
            let [x, y, z] = line.axes.map(|axis| line.origin[axis]);
            let [shear_x, shear_y, _] = line.shear;
            for (numbers, number) in numbers.iter_mut().zip([x, y, z, shear_x, shear_y]) {
                numbers[lane] = number;
            }
        }
        let [x, y, z, shear_x, shear_y] = numbers;
        Some(Self {
            origin: [
                Eight::load_array(simd, x),
                Eight::load_array(simd, y),
                Eight::load_array(simd, z),
            ],
            axes,
            shear: [
                Eight::load_array(simd, shear_x),
                Eight::load_array(simd, shear_y),
            ],
        })
    }

    /// A mask of the lines that may cross a triangle by [`Sheared::crossing`]: all except those
    /// that surely miss it, as most do, by the same signs. Equal products count as on the edge.
    #[inline(always)]
    pub(super) fn may_cross(&self, [a, b, c]: [DVec3; 3]) -> u32 {
        let (a, b, c) = (
            self.transformed(a),
            self.transformed(b),
            self.transformed(c),
        );
        let (u, v, w) = (across(c, b), across(a, c), across(b, a));
        let zero = u.all(0.0);
        let below = u.below(zero) | v.below(zero) | w.below(zero);
        let above = zero.below(u) | zero.below(v) | zero.below(w);
        bits::<S>(!(below & above))
    }

    /// The two coordinates of a vertex across the lines.
    #[inline(always)]
    fn transformed(&self, corner: DVec3) -> [Eight<S>; 2] {
        let [x, y, z] = self.origin;
        let [i, j, k] = self.axes;
        let (x, y, z) = (
            x.all(corner[i]) - x,
            y.all(corner[j]) - y,
            z.all(corner[k]) - z,
        );
        let [shear_x, shear_y] = self.shear;
        [x - shear_x * z, y - shear_y * z]
    }
}

/// [`edge`] in each lane; 0 if rounding hides the sign.
#[inline(always)]
fn across<S: Simd>(a: [Eight<S>; 2], b: [Eight<S>; 2]) -> Eight<S> {
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
