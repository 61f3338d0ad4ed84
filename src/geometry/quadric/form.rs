//! Quadratic functions in their principal coordinates.

use glam::DVec3;

use crate::Ray;

/// A quadratic function F, up to a positive factor: with p = W (x − centre) + offset,
/// F = Σ sᵢ pᵢ² + 2 h · p + k.
///
/// The axes of p are orthogonal and scaled so that s is −1, 0 or 1, or so small that 0 may be
/// intended. Where s is ±1, h is 0. The rest of F has size 1: |k| or |h| is 1, unless both are 0,
/// as for a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Form {
    /// The centre, the vertex, or a point on the axis, rounded to `f64`.
    pub(super) centre: DVec3,
    /// `centre` minus the exact centre, in the coordinates of p.
    pub(super) offset: DVec3,
    /// The rows of W.
    pub(super) rows: [DVec3; 3],
    /// The columns of its inverse.
    pub(super) columns: [DVec3; 3],
    /// The squared terms' coefficients s.
    pub(super) squares: DVec3,
    /// The linear terms' coefficients h.
    pub(super) linear: DVec3,
    /// The constant k.
    pub(super) constant: f64,
    /// The world length of a unit along the most curved axis: the least semi-axis, or half the
    /// parameter of a paraboloid.
    pub(super) unit: f64,
    /// Lines that start farther from the centre are advanced first; 0 if the solid has no size.
    pub(super) near: f64,
    /// The weights of the axes of p in finding the closest point.
    pub(super) weights: DVec3,
}

/// A line in the world, relative to the centre, and in the coordinates of p. Distances along both
/// equal those along the ray.
#[derive(Clone, Copy)]
pub(super) struct QuadricLine {
    /// The world position at `start`, minus the centre.
    pub(super) position: DVec3,
    /// The ray's direction.
    pub(super) direction: DVec3,
    /// The distance of `position` along the ray.
    pub(super) start: f64,
    /// The value of p at `start`.
    pub(super) p: DVec3,
    /// The direction of p.
    pub(super) q: DVec3,
}

impl Form {
    pub(super) fn is_finite(&self) -> bool {
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

    /// The ray's line from its start or, if that is far, from about its closest point.
    #[inline]
    pub(super) fn line(&self, ray: &Ray) -> QuadricLine {
        let position = ray.origin - self.centre;
        let line = QuadricLine {
            position,
            direction: ray.direction,
            start: 0.0,
            p: self.map_vector(position) + self.offset,
            q: self.map_vector(ray.direction),
        };
        if self.near * self.near < position.length_squared() {
            self.approach(ray, &line)
        } else {
            line
        }
    }

    /// Moves the line's start to about its closest point. The offset is far below the rounding.
    fn approach(&self, ray: &Ray, line: &QuadricLine) -> QuadricLine {
        let QuadricLine {
            position,
            direction,
            p,
            q,
            ..
        } = *line;
        let weighted = self.weights * q;
        let start = -p.dot(weighted) / q.dot(weighted);
        // The exact rounding error of the subtraction.
        let kept = position - ray.origin;
        let rest = (ray.origin - (position - kept)) - (self.centre + kept);
        let position = DVec3::new(
            start.mul_add(direction.x, position.x),
            start.mul_add(direction.y, position.y),
            start.mul_add(direction.z, position.z),
        ) + rest;
        QuadricLine {
            position,
            start,
            p: self.map_vector(position) + self.offset,
            ..*line
        }
    }

    /// The value of F.
    pub(super) fn value(&self, p: DVec3) -> f64 {
        p.dot(self.squares * p) + 2.0 * self.linear.dot(p) + self.constant
    }

    /// The sum of the magnitudes of F's terms; the rounding error of F is a few ulps of it.
    pub(super) fn terms(&self, p: DVec3) -> f64 {
        p.dot(self.squares.abs() * p) + 2.0 * self.linear.abs().dot(p.abs()) + self.constant.abs()
    }

    /// Half the gradient of F in the coordinates of p.
    pub(super) fn gradient(&self, p: DVec3) -> DVec3 {
        self.squares * p + self.linear
    }

    /// Returns W v.
    #[inline]
    pub(super) fn map_vector(&self, v: DVec3) -> DVec3 {
        let [x, y, z] = self.rows;
        DVec3::new(x.dot(v), y.dot(v), z.dot(v))
    }

    /// Transforms a gradient from the coordinates of p to the world.
    pub(super) fn gradient_in_world(&self, gradient: DVec3) -> DVec3 {
        let [x, y, z] = self.rows;
        gradient.x * x + gradient.y * y + gradient.z * z
    }

    /// The world position of p, minus the centre.
    pub(super) fn position(&self, p: DVec3) -> DVec3 {
        let [x, y, z] = self.columns;
        let p = p - self.offset;
        p.x * x + p.y * y + p.z * z
    }
}
