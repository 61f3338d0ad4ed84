//! Rays against triangles without gaps: S. Woop, C. Benthin, I. Wald, "Watertight Ray/Triangle
//! Intersection", JCGT 2 (2013).
//!
//! Corners go to a space where the ray starts at the origin and runs along z, each by itself, so
//! that all triangles that share a corner see it at the same place. There the signs of the edge
//! functions say whether the origin is inside. They are exact for the corners as rounded, so two
//! triangles that share an edge agree on its side, and edges belong to both: a ray that meets a
//! closed mesh slips through nowhere, however the corners were rounded.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Eight, Lanes, Simd, SimdBase, WIDTH, bits};
use super::transform::exact_difference;

/// A line in the space of its triangles, ready to be tested against them.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sheared {
    origin: DVec3,
    /// The axis along which the line runs fastest comes last.
    axes: [usize; 3],
    /// How far the other two change along that axis, and 1 over the speed along it.
    shear: [f64; 3],
}

/// Where a line crosses the plane of a triangle, inside of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Crossing {
    /// The distance, in units of the line's direction.
    pub(super) t: f64,
    /// The weights of the corners, none below 0: they add up to 1.
    pub(super) weights: [f64; 3],
}

impl Sheared {
    /// A line from `origin` along `direction`, of any length.
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

    /// Where the line crosses a triangle. A line in its plane crosses none.
    #[inline]
    pub(super) fn crossing(&self, corners: [DVec3; 3]) -> Option<Crossing> {
        let [a, b, c] = corners.map(|corner| self.seen(corner));
        let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
        if (u < 0.0 || v < 0.0 || w < 0.0) && (0.0 < u || 0.0 < v || 0.0 < w) {
            return None;
        }
        // In a needle the products of an edge function all but cancel: their signs are right, but a
        // distance takes more. Few triangles come this far.
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

    /// A corner as seen from the line: across it, and along it.
    #[inline]
    fn seen(&self, corner: DVec3) -> [f64; 3] {
        let offset = (corner - self.origin).to_array();
        let [x, y, z] = self.axes.map(|axis| offset[axis]);
        let [shear_x, shear_y, shear_z] = self.shear;
        [x - shear_x * z, y - shear_y * z, shear_z * z]
    }
}

/// Lines side by side in the space of their triangles that run fastest along the same axis.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShearedLines<S: Simd> {
    origin: [Eight<S>; 3],
    axes: [usize; 3],
    shear: [Eight<S>; 2],
}

impl<S: Simd> ShearedLines<S> {
    /// `None` if they run fastest along different axes.
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

    /// A bit for each line that [`Sheared::crossing`] may find to cross a triangle: for all but those
    /// that pass beside it, which most do, by the same signs. Equal products count as on the edge.
    #[inline(always)]
    pub(super) fn may_cross(&self, [a, b, c]: [DVec3; 3]) -> u32 {
        let (a, b, c) = (self.seen(a), self.seen(b), self.seen(c));
        let (u, v, w) = (across(c, b), across(a, c), across(b, a));
        let zero = u.all(0.0);
        let below = u.below(zero) | v.below(zero) | w.below(zero);
        let above = zero.below(u) | zero.below(v) | zero.below(w);
        bits::<S>(!(below & above))
    }

    /// A corner as seen across the lines.
    #[inline(always)]
    fn seen(&self, corner: DVec3) -> [Eight<S>; 2] {
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

/// [`edge`] in each lane, 0 where rounding hides the sign.
#[inline(always)]
fn across<S: Simd>(a: [Eight<S>; 2], b: [Eight<S>; 2]) -> Eight<S> {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the area that an edge spans with the origin, with the right sign: that of rounded products
/// is right unless they are equal.
#[inline]
fn edge(a: [f64; 3], b: [f64; 3]) -> f64 {
    let (first, second) = (a[0] * b[1], a[1] * b[0]);
    if first == second {
        exact_edge(a, b)
    } else {
        first - second
    }
}

/// The same, rounded as if once or twice.
#[inline]
fn exact_edge([ax, ay, _]: [f64; 3], [bx, by, _]: [f64; 3]) -> f64 {
    exact_difference([ax, by], [ay, bx])
}
