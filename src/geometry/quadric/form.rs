//! Quadratic functions in coordinates of their own.

use glam::DVec3;

use super::axes::Axes;
use crate::geometry::Ray;
use crate::geometry::double_double::{Double, vector};
use crate::geometry::transform::power_of_two;

/// A quadratic function F of space, up to a factor above 0: with p = W (x − centre) + offset,
/// F = Σ sᵢ pᵢ² + 2 h · p + k.
///
/// The axes of p are orthogonal and scaled so that s is −1, 0 or 1, or so small that it may be meant
/// to be 0. Where s is ±1, h is 0. What is left of F has size 1: |k| or |h| is 1, unless both are 0,
/// as for a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    /// The centre, vertex, or some place on the axis, to the nearest `f64`.
    pub(super) centre: DVec3,
    /// The exact centre to `centre`, in the coordinates of p.
    pub(super) offset: DVec3,
    /// The rows of W.
    pub(super) rows: [DVec3; 3],
    /// The columns of its inverse.
    pub(super) columns: [DVec3; 3],
    /// s.
    pub(super) squares: DVec3,
    /// h.
    pub(super) linear: DVec3,
    /// k.
    pub(super) constant: f64,
    /// The length in the world of a 1 along the most curved axis: its least semi-axis, or half the
    /// parameter of a paraboloid.
    pub(super) unit: f64,
    /// A line that starts no farther from the centre stays where it starts; 0 if no size says what
    /// far is.
    pub(super) near: f64,
    /// How much the axes of p count in finding the closest place.
    pub(super) weights: DVec3,
}

/// A line in the world, as seen from the centre, and in the coordinates of p. Distances along both
/// are those along the ray.
#[derive(Clone, Copy)]
pub(super) struct Line {
    /// The place at `start` in the world, minus the centre.
    pub(super) place: DVec3,
    /// The ray's direction.
    pub(super) direction: DVec3,
    /// How far along the ray `place` is.
    pub(super) start: f64,
    /// p at `start`.
    pub(super) p: DVec3,
    /// The direction of p.
    pub(super) q: DVec3,
}

impl Form {
    /// Brings A x² + 2B xy + 2C xz + 2D x + E y² + 2F yz + 2G y + H z² + 2I z + J, finite, into its
    /// own coordinates, in twice the precision: coefficients of a small solid far from the origin
    /// hold its size in their last bits.
    pub(super) fn new(coefficients: [f64; 10]) -> Self {
        let [xx, xy, xz, x, yy, yz, y, zz, z, constant] = coefficients;
        let size = |terms: &[f64]| {
            terms
                .iter()
                .fold(0.0, |size, term| f64::max(size, term.abs()))
        };
        let square = size(&[xx, xy, xz, yy, yz, zz]);
        let leading = if square == 0.0 {
            size(&[x, y, z])
        } else {
            square
        };
        if leading == 0.0 {
            return Self::constant(constant);
        }
        let factor = power_of_two(leading);
        let matrix = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
        let matrix = matrix.map(|row| row.map(|term| Double::of(term / factor)));
        let linear = vector(DVec3::new(x, y, z) / factor);
        let form = Axes::new(matrix, linear, Double::of(constant / factor)).form();
        // Coefficients near the ends of the range of `f64` leave nothing to compute with.
        if form.is_finite() {
            form
        } else {
            Self::constant(1.0)
        }
    }

    fn is_finite(&self) -> bool {
        [self.centre, self.offset, self.squares, self.linear]
            .iter()
            .chain(&self.rows)
            .chain(&self.columns)
            .all(|v| v.is_finite())
            && self.constant.is_finite()
    }

    pub(super) fn constant(value: f64) -> Self {
        Self {
            centre: DVec3::ZERO,
            offset: DVec3::ZERO,
            rows: DVec3::AXES,
            columns: DVec3::AXES,
            squares: DVec3::ZERO,
            linear: DVec3::ZERO,
            constant: value,
            unit: 1.0,
            near: 0.0,
            weights: DVec3::ONE,
        }
    }

    /// The ray's line from where it starts, or, if that is far, from about where it is closest.
    #[inline]
    pub(super) fn line(&self, ray: &Ray) -> Line {
        let place = ray.origin - self.centre;
        let line = Line {
            place,
            direction: ray.direction,
            start: 0.0,
            p: self.turn(place) + self.offset,
            q: self.turn(ray.direction),
        };
        if self.near * self.near < place.length_squared() {
            self.approach(ray, &line)
        } else {
            line
        }
    }

    /// The same line from about where it is closest. The offset is far below what is rounded off.
    fn approach(&self, ray: &Ray, line: &Line) -> Line {
        let Line {
            place,
            direction,
            p,
            q,
            ..
        } = *line;
        let weighted = self.weights * q;
        let start = -p.dot(weighted) / q.dot(weighted);
        // What the subtraction rounded off, exactly.
        let kept = place - ray.origin;
        let rest = (ray.origin - (place - kept)) - (self.centre + kept);
        let place = DVec3::new(
            start.mul_add(direction.x, place.x),
            start.mul_add(direction.y, place.y),
            start.mul_add(direction.z, place.z),
        ) + rest;
        Line {
            place,
            start,
            p: self.turn(place) + self.offset,
            ..*line
        }
    }

    /// F.
    pub(super) fn value(&self, p: DVec3) -> f64 {
        p.dot(self.squares * p) + 2.0 * self.linear.dot(p) + self.constant
    }

    /// The sum of the magnitudes of F's terms, of which its rounding error is a few units in the
    /// last place.
    pub(super) fn terms(&self, p: DVec3) -> f64 {
        p.dot(self.squares.abs() * p) + 2.0 * self.linear.abs().dot(p.abs()) + self.constant.abs()
    }

    /// Half the gradient of F in the coordinates of p.
    pub(super) fn gradient(&self, p: DVec3) -> DVec3 {
        self.squares * p + self.linear
    }

    /// W v.
    #[inline]
    pub(super) fn turn(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.rows;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }

    /// The gradient in the world of a function whose gradient in the coordinates of p this is.
    pub(super) fn gradient_in_world(&self, gradient: DVec3) -> DVec3 {
        let [x, y, z] = self.rows;
        gradient.x * x + gradient.y * y + gradient.z * z
    }

    /// The place in the world, minus the centre.
    pub(super) fn place(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        let p = p - self.offset;
        p.x * x + p.y * y + p.z * z
    }
}
