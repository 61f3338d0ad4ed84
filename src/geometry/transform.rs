//! Affine frames: where a unit solid stands in the world.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{Ends, Line, approach};
use super::surface::CLEARANCE;
use super::{Aabb, Chart, Hit, Ray, Rays, Surfaces};

/// The least |determinant| of a frame's unit directions: flatter ones span no volume.
pub const FLATTEST: f64 = 1e-6;

/// The same for the columns of a matrix, which need not look like a solid's axes.
const FLATTEST_COLUMNS: f64 = 1e-12;

/// The condition number above which a frame is ill-conditioned: below it rounding is nothing beside
/// a shape.
const ILL_CONDITIONED: f64 = 1e4;

/// An affine frame: an origin, three directions of unit length (not necessarily orthogonal) and a
/// length along each. A unit solid's point q is at `origin + Σ qᵢ lengthᵢ directionᵢ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    origin: DVec3,
    /// lengthᵢ · directionᵢ: the columns of the matrix to the world.
    axes: [DVec3; 3],
    /// The dual basis, dualᵢ · axisⱼ = 1 if i = j, else 0: the rows of the matrix from the world.
    duals: [DVec3; 3],
    /// No point of a unit solid is farther from the origin.
    reach: f64,
    /// How far a step of length 1 in the world goes at most along each axis of the unit solid: the
    /// lengths of the duals.
    steps: DVec3,
    /// Whether steps of the rounding of places may be large ones in the unit space.
    is_ill_conditioned: bool,
}

impl Affine {
    /// Makes a frame. Directions are normalised; `None` if one is zero, or the determinant of the
    /// unit directions is below [`FLATTEST`] in magnitude: then they span no volume. Lengths are above 0.
    ///
    /// A dual vector is the cross product of two directions, made one by its own product with the
    /// third; both are computed as if with twice the precision. So the two matrices undo each other
    /// to the last bits however flat the frame is.
    pub fn new(origin: DVec3, directions: [DVec3; 3], lengths: DVec3) -> Option<Self> {
        Self::spanning(origin, directions, lengths, FLATTEST)
    }

    /// Makes the frame that a 3 × 4 matrix takes the unit axes to: any scaling, turning, mirroring
    /// and shearing. `None` if |determinant| < 1e-12 · the product of the columns' lengths, or a
    /// number is not finite.
    pub fn of_matrix(columns: [DVec3; 3], translation: DVec3) -> Option<Self> {
        let lengths = DVec3::from_array(columns.map(length));
        if !translation.is_finite() || !lengths.is_finite() {
            return None;
        }
        Self::spanning(translation, columns, lengths, FLATTEST_COLUMNS)
    }

    fn spanning(
        origin: DVec3,
        directions: [DVec3; 3],
        lengths: DVec3,
        flattest: f64,
    ) -> Option<Self> {
        let [u, v, w] = directions.map(normalise);
        let (u, v, w) = (u?, v?, w?);
        let volume = exact_dot(u, exact_cross(v, w)).abs();
        if volume.is_nan() || volume < flattest {
            return None;
        }
        let dual = |own: DVec3, next: DVec3, last: DVec3, length: f64| {
            let across = exact_cross(next, last);
            across / exact_dot(across, own) / length
        };
        let duals = [
            dual(u, v, w, lengths.x),
            dual(v, w, u, lengths.y),
            dual(w, u, v, lengths.z),
        ];
        let axes = [lengths.x * u, lengths.y * v, lengths.z * w];
        Some(Self::by(origin, axes, duals, lengths.element_sum()))
    }

    /// The frame of the cube of half edge `size`, a power of two, around a place of this one.
    pub(super) fn around(&self, place: DVec3, size: f64) -> Self {
        let [x, y, z] = self.axes;
        let origin = self.origin + (place.x * x + place.y * y + place.z * z);
        let axes = self.axes.map(|axis| size * axis);
        let duals = self.duals.map(|dual| dual / size);
        Self::by(origin, axes, duals, size * self.reach)
    }

    fn by(origin: DVec3, axes: [DVec3; 3], duals: [DVec3; 3], reach: f64) -> Self {
        let condition = reach * DVec3::from_array(duals.map(length)).max_element();
        Self {
            origin,
            axes,
            duals,
            reach,
            steps: DVec3::from_array(duals.map(DVec3::length)),
            is_ill_conditioned: ILL_CONDITIONED < condition,
        }
    }

    /// Where the unit solid's origin is.
    pub(super) fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The images of the unit solid's axes.
    pub(super) fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    /// How far the image of the unit disc or ball in the given axes reaches along each axis of the
    /// world: the length of that row of the matrix to the world.
    pub(super) fn reach_of_disc<const N: usize>(&self, axes: [usize; N]) -> DVec3 {
        let row = |world: usize| {
            let mut row = DVec3::ZERO;
            for axis in axes {
                row[axis] = self.axes[axis][world];
            }
            length(row)
        };
        DVec3::new(row(0), row(1), row(2))
    }

    /// The rays' lines in the space of the unit solid, in each lane.
    #[inline(always)]
    pub(super) fn line<N: Lanes>(&self, rays: &Rays<N>) -> Line<N> {
        let like = rays.origin.x;
        let offset = rays.origin - Vector::all(like, self.origin);
        let (offset, start) = approach(offset, rays.direction, like.all(self.reach));
        let duals = all(like, self.duals);
        Line {
            origin: products(duals, offset),
            direction: products(duals, rays.direction),
            start,
        }
    }

    /// Crossings of the shape, which has these bounds, but for those that are nowhere near it.
    ///
    /// In an ill-conditioned frame rounding may take a crossing to where the shape is not. What of it
    /// is outside the box does not count: a tree looks for the shape in its box alone.
    #[inline(always)]
    pub(super) fn clipped<N: Lanes>(
        &self,
        found: Ends<N>,
        rays: &Rays<N>,
        bounds: impl FnOnce() -> Aabb,
    ) -> Option<Ends<N>> {
        if self.is_ill_conditioned {
            found.clipped(&bounds(), rays)
        } else {
            Some(found)
        }
    }

    /// A point of the world in the space of the unit solid.
    pub(super) fn place(&self, point: DVec3) -> DVec3 {
        self.dual_products(point - self.origin)
    }

    /// Where rays are in the space of the unit solid at distances `t`.
    #[inline(always)]
    pub(super) fn places<N: Lanes>(&self, rays: &Rays<N>, t: N) -> Vector<N> {
        let offset = rays.at(t) - Vector::all(t, self.origin);
        products(all(t, self.duals), offset)
    }

    /// The surface at a place of the unit solid where its outward normal is `outward`, of any
    /// length, in each lane. `project` gives that place, on the surface and at least a margin, in each
    /// coordinate, from the solid's edges: a ray that leaves inward must start inside.
    ///
    /// Normals go to the world by the inverse transpose. Where the terms of that sum cancel, the
    /// rounding of a place does not: it is as much larger beside the gradient, and so is the scale.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(
        &self,
        outward: Vector<N>,
        project: impl FnOnce(Vector<N>) -> Vector<N>,
    ) -> Surfaces<N> {
        let like = outward.x;
        let duals @ [u, v, w] = all(like, self.duals);
        let gradient = outward.weigh(duals);
        let terms =
            u.scaled(outward.x).abs() + v.scaled(outward.y).abs() + w.scaled(outward.z).abs();
        let cancellation = terms.largest() / gradient.abs().largest();
        let scale = like.all(self.origin.abs().max_element().max(self.reach)) * cancellation;
        let margin = Vector::all(like, self.steps).scaled(like.all(2.0 * CLEARANCE) * scale.ulp());
        let place = project(margin.smaller(Vector::all(like, DVec3::splat(0.25))));
        Surfaces {
            point: Vector::all(like, self.origin) + place.weigh(all(like, self.axes)),
            normal: normalised(gradient, DVec3::Z),
            scale,
        }
    }

    /// The texture coordinates at a hit, from those at its place in the unit solid. Gradients go to
    /// the world by the inverse transpose, as normals do.
    pub(super) fn chart(&self, ray: &Ray, hit: Hit, chart: impl FnOnce(DVec3) -> Chart) -> Chart {
        chart(self.place(ray.at(hit.t))).with_gradients(|gradient| self.gradient(gradient))
    }

    /// A gradient, such as a normal of any length, taken to the world: by the inverse transpose.
    pub(super) fn gradient(&self, gradient: DVec3) -> DVec3 {
        let [u, v, w] = self.duals;
        gradient.x * u + gradient.y * v + gradient.z * w
    }

    #[inline]
    fn dual_products(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.duals;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }
}

/// Three vectors, in each lane the same.
#[inline(always)]
fn all<N: Lanes>(like: N, [x, y, z]: [DVec3; 3]) -> [Vector<N>; 3] {
    [
        Vector::all(like, x),
        Vector::all(like, y),
        Vector::all(like, z),
    ]
}

/// The scalar products of a vector with three.
#[inline(always)]
fn products<N: Lanes>([x, y, z]: [Vector<N>; 3], v: Vector<N>) -> Vector<N> {
    Vector {
        x: x.dot(v),
        y: y.dot(v),
        z: z.dot(v),
    }
}

/// The vector of unit length in the direction of `v`, or `None` if `v` is zero or not finite.
pub fn normalise(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    (0.0 < largest && largest.is_finite()).then(|| normalised(v.into(), v).into())
}

/// The vector of unit length in the direction of `v`, or another if `v` is zero or not finite, in
/// each lane.
///
/// Divided by a power of two first, which changes no bits of the result, no component is too large
/// or too small to be squared.
#[inline(always)]
pub(super) fn normalised<N: Lanes>(v: Vector<N>, otherwise: DVec3) -> Vector<N> {
    let largest = v.abs().largest();
    let has_direction = largest.all(0.0).below(largest) & largest.below(largest.all(f64::INFINITY));
    // Of half the largest, as there may be none next to it.
    let power = (largest.all(0.5) * largest).ulp() * largest.all(2.0 / f64::EPSILON);
    let v = v.over(power);
    let unit = v.over(v.length());
    Vector::select(has_direction, unit, Vector::all(largest, otherwise))
}

/// The length of a vector whose components may be too large or too small to be squared.
fn length(v: DVec3) -> f64 {
    let size = power_of_two(v.abs().max_element());
    size * (v / size).length()
}

/// The largest power of two not above `x`, or the least normal number; `x` ≥ 0 and finite.
pub(super) fn power_of_two(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE)
}

/// The cross product, each component rounded as if once.
pub(super) fn exact_cross(u: DVec3, v: DVec3) -> DVec3 {
    DVec3::new(
        exact_difference([u.y, v.z], [u.z, v.y]),
        exact_difference([u.z, v.x], [u.x, v.z]),
        exact_difference([u.x, v.y], [u.y, v.x]),
    )
}

/// The difference of two products, rounded as if once or twice. Kahan: the error of one product is
/// recovered by a fused multiply-add; C.-P. Jeannerod, N. Louvet, J.-M. Muller, "Further analysis of
/// Kahan's algorithm", Mathematics of Computation 82 (2013).
pub(super) fn exact_difference([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    let product = c * d;
    let error = (-c).mul_add(d, product);
    a.mul_add(b, -product) + error
}

/// The dot product as if computed with twice the precision: T. Ogita, S. Rump, S. Oishi, "Accurate
/// sum and dot product", SIAM Journal on Scientific Computing 26 (2005).
fn exact_dot(u: DVec3, v: DVec3) -> f64 {
    let mut sum = u.x * v.x;
    let mut error = u.x.mul_add(v.x, -sum);
    for (a, b) in [(u.y, v.y), (u.z, v.z)] {
        let product = a * b;
        error += a.mul_add(b, -product);
        let total = sum + product;
        let kept = total - sum;
        error += (sum - (total - kept)) + (product - kept);
        sum = total;
    }
    sum + error
}
