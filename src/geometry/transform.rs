//! Affine frames, which place unit solids in the world.

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{Ends, Line, approach};
use super::surface::CLEARANCE;
use super::{Aabb, Chart, Hit, Ray, Rays, Surfaces};

/// The least |determinant| of a frame's unit directions; flatter frames count as degenerate.
pub const FLATTEST: f64 = 1e-6;

/// The same for the columns of a matrix, which need not resemble a solid's axes.
const FLATTEST_COLUMNS: f64 = 1e-12;

/// The condition number above which a frame is ill-conditioned; below it rounding is negligible
/// compared with a shape.
const ILL_CONDITIONED: f64 = 1e4;

/// An affine frame: an origin, three directions of unit length (not necessarily orthogonal) and a
/// length along each. A unit solid's point q is at `origin + Σ qᵢ lengthᵢ directionᵢ`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Affine {
    origin: DVec3,
    /// lengthᵢ · directionᵢ: the columns of the unit-to-world matrix.
    axes: [DVec3; 3],
    /// The dual basis, dualᵢ · axisⱼ = δᵢⱼ: the rows of the world-to-unit matrix.
    duals: [DVec3; 3],
    /// An upper bound of the distance from the origin to a point of a unit solid.
    reach: f64,
    /// The largest change of each unit coordinate per world length: the lengths of the duals.
    steps: DVec3,
    /// Whether the rounding of positions may be large in unit space.
    is_ill_conditioned: bool,
}

impl Affine {
    /// Creates a frame. Directions are normalised; lengths must be above 0. Returns `None` if a
    /// direction is zero or |determinant| of the unit directions is below [`FLATTEST`].
    ///
    /// A dual vector is the cross product of two directions over their triple product with the
    /// third, both computed as if in twice the precision. The two matrices are therefore inverse to
    /// each other to the last bits, however flat the frame is.
    pub fn new(origin: DVec3, directions: [DVec3; 3], lengths: DVec3) -> Option<Self> {
        Self::with_threshold(origin, directions, lengths, FLATTEST)
    }

    /// Creates the frame of a 3 × 4 matrix with any scaling, rotation, reflection and shear.
    /// Returns `None` if |determinant| < 1e-12 · the product of the columns' lengths, or a number
    /// is not finite.
    pub fn of_matrix(columns: [DVec3; 3], translation: DVec3) -> Option<Self> {
        let lengths = DVec3::from_array(columns.map(length));
        if !translation.is_finite() || !lengths.is_finite() {
            return None;
        }
        Self::with_threshold(translation, columns, lengths, FLATTEST_COLUMNS)
    }

    fn with_threshold(
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
        Some(Self::from_parts(origin, axes, duals, lengths.element_sum()))
    }

    /// The frame of a cube around a position in this frame; its half edge `size` is a power of two.
    pub(super) fn around(&self, position: DVec3, size: f64) -> Self {
        let [x, y, z] = self.axes;
        let origin = self.origin + (position.x * x + position.y * y + position.z * z);
        let axes = self.axes.map(|axis| size * axis);
        let duals = self.duals.map(|dual| dual / size);
        Self::from_parts(origin, axes, duals, size * self.reach)
    }

    fn from_parts(origin: DVec3, axes: [DVec3; 3], duals: [DVec3; 3], reach: f64) -> Self {
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

    /// The image of the unit solid's origin.
    pub(super) fn origin(&self) -> DVec3 {
        self.origin
    }

    /// The images of the unit solid's axes.
    pub(super) fn axes(&self) -> [DVec3; 3] {
        self.axes
    }

    /// The dual basis: the rows of the world-to-unit matrix.
    pub(super) fn duals(&self) -> [DVec3; 3] {
        self.duals
    }

    /// The half extent, along each world axis, of the image of the unit disc or ball in the given
    /// axes: the length of that row of the unit-to-world matrix.
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

    /// The rays in the space of the unit solid, in each lane.
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

    /// Clips crossings to the bounds of the shape if the frame is ill-conditioned.
    ///
    /// Rounding may then move a crossing off the shape. A crossing outside the box must not count,
    /// because a BVH finds a shape only inside its box.
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

    /// Maps a world point into the space of the unit solid.
    #[inline]
    pub(super) fn position(&self, point: DVec3) -> DVec3 {
        self.dual_products(point - self.origin)
    }

    /// Maps the rays' points at distances `t` into the space of the unit solid.
    #[inline(always)]
    pub(super) fn positions<N: Lanes>(&self, rays: &Rays<N>, t: N) -> Vector<N> {
        let offset = rays.at(t) - Vector::all(t, self.origin);
        products(all(t, self.duals), offset)
    }

    /// The surface at a position on the unit solid with the outward normal `outward`, of any
    /// length, in each lane. `project` returns that position, on the surface and at least a margin,
    /// in each coordinate, away from the solid's edges: a ray that leaves inward must start inside.
    ///
    /// Normals are transformed by the inverse transpose. If the terms of that sum cancel, the
    /// rounding of a position grows relative to the gradient by that factor, and so does the scale.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(
        &self,
        outward: Vector<N>,
        project: impl FnOnce(Vector<N>) -> Vector<N>,
    ) -> Surfaces<N> {
        let like = outward.x;
        let [u, v, w] = all(like, self.duals);
        let gradient = self.gradients(outward);
        let terms =
            u.scaled(outward.x).abs() + v.scaled(outward.y).abs() + w.scaled(outward.z).abs();
        let cancellation = terms.largest() / gradient.abs().largest();
        let scale = like.all(self.origin.abs().max_element().max(self.reach)) * cancellation;
        let margin = Vector::all(like, self.steps).scaled(like.all(2.0 * CLEARANCE) * scale.ulp());
        let position = project(margin.smaller(Vector::all(like, DVec3::splat(0.25))));
        Surfaces {
            point: Vector::all(like, self.origin) + position.combine(all(like, self.axes)),
            normal: normalised(gradient, Vector::all(like, DVec3::Z)),
            scale,
        }
    }

    /// The texture coordinates at a hit, from those at its position on the unit solid. Gradients
    /// are transformed by the inverse transpose, as normals are.
    #[inline]
    pub(super) fn chart(&self, ray: &Ray, hit: Hit, chart: impl FnOnce(DVec3) -> Chart) -> Chart {
        chart(self.position(ray.at(hit.t))).with_gradients(|gradient| self.gradient(gradient))
    }

    /// Transforms a gradient, such as a normal, to the world by the inverse transpose.
    pub(super) fn gradient(&self, gradient: DVec3) -> DVec3 {
        self.gradients(gradient.into()).into()
    }

    /// The same in each lane.
    #[inline(always)]
    pub(super) fn gradients<N: Lanes>(&self, gradients: Vector<N>) -> Vector<N> {
        gradients.combine(all(gradients.x, self.duals))
    }

    #[inline]
    fn dual_products(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.duals;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }
}

/// Broadcasts three vectors to all lanes.
#[inline(always)]
fn all<N: Lanes>(like: N, [x, y, z]: [DVec3; 3]) -> [Vector<N>; 3] {
    [
        Vector::all(like, x),
        Vector::all(like, y),
        Vector::all(like, z),
    ]
}

/// The dot products of a vector with three others.
#[inline(always)]
fn products<N: Lanes>([x, y, z]: [Vector<N>; 3], v: Vector<N>) -> Vector<N> {
    Vector {
        x: x.dot(v),
        y: y.dot(v),
        z: z.dot(v),
    }
}

/// Returns `v` scaled to unit length, or `None` if `v` is zero or not finite.
pub fn normalise(v: DVec3) -> Option<DVec3> {
    let largest = v.abs().max_element();
    (0.0 < largest && largest.is_finite()).then(|| normalised(v.into(), v.into()).into())
}

/// Scales `v` to unit length in each lane, or returns `otherwise` where `v` is zero or not finite.
///
/// It is divided by a power of two first, which changes no bits of the result, so that no component
/// is too large or too small to be squared.
#[inline(always)]
pub(super) fn normalised<N: Lanes>(v: Vector<N>, otherwise: Vector<N>) -> Vector<N> {
    let largest = v.abs().largest();
    let has_direction = largest.all(0.0).below(largest) & largest.below(largest.all(f64::INFINITY));
    // Of half the largest, which always has a next larger number.
    let power = (largest.all(0.5) * largest).ulp() * largest.all(2.0 / f64::EPSILON);
    let v = v.over(power);
    let unit = v.over(v.length());
    Vector::select(has_direction, unit, otherwise)
}

/// The length of a vector whose components may be too large or too small to be squared.
pub(super) fn length(v: DVec3) -> f64 {
    let size = power_of_two(v.abs().max_element());
    size * (v / size).length()
}

/// The largest power of two not above `x`, at least the least normal number; `x` ≥ 0 and finite.
pub(super) fn power_of_two(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & f64::INFINITY.to_bits()).max(f64::MIN_POSITIVE)
}

/// The cross product, each component by [`exact_difference`].
pub(super) fn exact_cross(u: DVec3, v: DVec3) -> DVec3 {
    exact_cross_each(u.into(), v.into()).into()
}

/// The same in each lane.
#[inline(always)]
pub(super) fn exact_cross_each<N: Lanes>(u: Vector<N>, v: Vector<N>) -> Vector<N> {
    Vector {
        x: exact_difference([u.y, v.z], [u.z, v.y]),
        y: exact_difference([u.z, v.x], [u.x, v.z]),
        z: exact_difference([u.x, v.y], [u.y, v.x]),
    }
}

/// The difference of two products, as if rounded once or twice, by Kahan's algorithm: the error of
/// one product is recovered by a fused multiply-add. C.-P. Jeannerod, N. Louvet, J.-M. Muller,
/// "Further analysis of Kahan's algorithm", Mathematics of Computation 82 (2013).
#[inline(always)]
pub(super) fn exact_difference<N: Lanes>([a, b]: [N; 2], [c, d]: [N; 2]) -> N {
    let product = c * d;
    let error = (-c).mul_add(d, product);
    a.mul_add(b, -product) + error
}

/// The dot product as if computed in twice the precision: T. Ogita, S. Rump, S. Oishi, "Accurate
/// sum and dot product", SIAM Journal on Scientific Computing 26 (2005).
pub(super) fn exact_dot(u: DVec3, v: DVec3) -> f64 {
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
