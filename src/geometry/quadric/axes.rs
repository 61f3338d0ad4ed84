//! The axes and the centre of a quadratic function, in twice the precision.

use glam::DVec3;

use super::form::Form;
use crate::double_double::{Double, Vector, cross, dot, scaled, sum, vector};
use crate::line::FAR;
use crate::transform::power_of_two;

/// Eigenvalues and sums below this fraction of the largest term are rounding errors.
const NOISE: f64 = 1e-27;

/// An eigenvalue below this fraction of the largest may be due to rounded coefficients in the file:
/// along such an axis a solid looks unbounded, and its centre, if any, may be anywhere.
const WEAK: f64 = 5e-14;

/// The weight of an axis without curvature in finding where a line is closest to a solid. Above 0,
/// or a line along a cylinder would have no closest point; small, or a line across the cylinder's
/// far end would be advanced to a point far from it.
const STRAIGHT: f64 = 1.0 / (1 << 20) as f64;

/// F along its axes: Σ λᵢ zᵢ² + 2 βᵢ zᵢ + constant, zᵢ = axisᵢ · x.
pub(super) struct Axes {
    directions: [Vector; 3],
    lambda: [Double; 3],
    beta: [Double; 3],
    constant: Double,
    /// The largest |λ|, or |β| if all λ are 0.
    largest: Double,
}

impl Form {
    /// Transforms A x² + 2B xy + 2C xz + 2D x + E y² + 2F yz + 2G y + H z² + 2I z + J, finite, into
    /// principal coordinates, in twice the precision: the coefficients of a small solid far from
    /// the origin hold its size in their last bits.
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
        // Coefficients near the limits of `f64` overflow or underflow.
        if form.is_finite() {
            form
        } else {
            Self::constant(1.0)
        }
    }
}

impl Axes {
    pub(super) fn new(matrix: [[Double; 3]; 3], linear: Vector, constant: Double) -> Self {
        let (mut lambda, mut axes) = eigen(matrix);
        let largest = larger(lambda);
        for value in &mut lambda {
            if value.abs().round() <= NOISE * largest.round() {
                *value = Double::ZERO;
            }
        }
        let size = dot(linear, linear).sqrt().round();
        // A parabolic cylinder: rounded eigenvalues do not determine which of the two axes without
        // curvature its slope is along.
        let weak = |i: usize| lambda[i].abs().round() <= WEAK * largest.round();
        let sloped = |i: usize| weak(i) && WEAK * size < dot(axes[i], linear).abs().round();
        if (0..3).filter(|&i| weak(i)).count() == 2 && (0..3).any(sloped) {
            lambda = std::array::from_fn(|i| if weak(i) { Double::ZERO } else { lambda[i] });
        }
        rotate_null_space(&mut axes, lambda, linear);
        let beta = axes.map(|axis| {
            let beta = dot(axis, linear);
            if beta.abs().round() <= NOISE * size {
                Double::ZERO
            } else {
                beta
            }
        });
        let largest = if largest.round() == 0.0 {
            larger(beta)
        } else {
            largest
        };
        Self {
            directions: axes,
            lambda,
            beta,
            constant,
            largest,
        }
    }

    /// Moves the origin to the centre along each axis on which F has one, and scales.
    pub(super) fn form(mut self) -> Form {
        let largest = self.largest.round();
        let strong = self
            .lambda
            .map(|lambda| WEAK * largest < lambda.abs().round());
        let mut centred = [false; 3];
        let mut shifts = [Double::ZERO; 3];
        let mut terms = self.constant.abs().round();
        for i in 0..3 {
            if strong[i] {
                let shift = -self.beta[i] / self.lambda[i];
                let term = shift * self.beta[i];
                terms += term.abs().round();
                self.constant = self.constant + term;
                (centred[i], shifts[i], self.beta[i]) = (true, shift, Double::ZERO);
            }
        }
        if self.constant.abs().round() <= NOISE * terms {
            self.constant = Double::ZERO;
        }
        for i in 0..3 {
            if strong[i] || self.beta[i].round() == 0.0 {
                continue;
            }
            if self.lambda[i].round() == 0.0 {
                // To the vertex of a paraboloid, unless it is so far away that F is practically
                // constant along this axis.
                let shift = -self.constant / (self.beta[i] + self.beta[i]);
                let (parameter, square) = (
                    self.beta[i].round() / largest,
                    self.constant.round().abs() / largest,
                );
                if 2_f64.powi(-60) * square <= parameter * parameter {
                    (shifts[i], self.constant) = (shift, Double::ZERO);
                }
            } else {
                // To the centre, only if it is much farther away than the length of the solid.
                let shift = -self.beta[i] / self.lambda[i];
                let constant = self.constant + shift * self.beta[i];
                let length = (constant / self.lambda[i]).abs();
                if 2_f64.powi(20) * length.round() < (shift * shift).round() {
                    (centred[i], shifts[i], self.beta[i]) = (true, shift, Double::ZERO);
                    self.constant = constant;
                }
            }
        }
        self.scale(centred, shifts)
    }

    fn scale(&self, centred: [bool; 3], shifts: [Double; 3]) -> Form {
        let radius = (self.constant.abs() / self.largest).sqrt();
        let parameter = larger(self.beta) / self.largest;
        let unit = if radius.round() < parameter.round() {
            parameter
        } else {
            radius
        };
        // A cone has no size, nor has a plane, whose only parameter is β.
        let flat = self.lambda.iter().all(|lambda| lambda.round() == 0.0);
        let endless = unit.round() == 0.0 || flat;
        let unit = if endless { Double::of(1.0) } else { unit };
        let exact = (0..3).fold(vector(DVec3::ZERO), |position, i| {
            sum(position, scaled(shifts[i], self.directions[i]))
        });
        let centre = rounded(exact);
        let rest = sum(vector(centre), exact.map(|component| -component));
        let mut form = Form {
            centre,
            unit: unit.round(),
            near: if endless { 0.0 } else { FAR * unit.round() },
            constant: (self.constant / (self.largest * unit * unit)).round(),
            ..Form::constant(0.0)
        };
        for (i, centred) in centred.into_iter().enumerate() {
            let relative = self.lambda[i] / self.largest;
            let length = if centred {
                relative.abs().sqrt() / unit
            } else {
                Double::of(1.0) / unit
            };
            let row = scaled(length, self.directions[i]);
            form.rows[i] = rounded(row);
            form.columns[i] = rounded(self.directions[i].map(|component| component / length));
            form.offset[i] = dot(row, rest).round();
            form.squares[i] = if centred {
                relative.round().signum()
            } else {
                relative.round()
            };
            form.linear[i] = (self.beta[i] / (self.largest * unit)).round();
            form.weights[i] = if centred {
                1.0
            } else {
                form.linear[i].abs().clamp(STRAIGHT, 1.0)
            };
        }
        form
    }
}

/// The eigenvalues and unit eigenvectors of a symmetric matrix, in no particular order.
pub fn principal_axes(matrix: [[f64; 3]; 3]) -> ([f64; 3], [DVec3; 3]) {
    let (lambda, axes) = eigen(matrix.map(|row| row.map(Double::of)));
    (lambda.map(Double::round), axes.map(rounded))
}

/// Eigenvalues and unit eigenvectors of a symmetric matrix by Jacobi rotations: G. Golub,
/// C. Van Loan, "Matrix Computations", 4th edition, section 8.5. They converge quadratically: ten
/// sweeps are more than a matrix of 106 bits needs.
fn eigen(mut matrix: [[Double; 3]; 3]) -> ([Double; 3], [Vector; 3]) {
    let mut axes = DVec3::AXES.map(vector);
    let size = matrix
        .as_flattened()
        .iter()
        .fold(0.0, |size, term| f64::max(size, term.abs().round()));
    for _ in 0..10 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let off = matrix[p][q];
            if off.abs().round() <= 2_f64.powi(-108) * size {
                (matrix[p][q], matrix[q][p]) = (Double::ZERO, Double::ZERO);
                continue;
            }
            let one = Double::of(1.0);
            let ratio = (matrix[q][q] - matrix[p][p]) / (off + off);
            let tangent = one / (ratio.abs() + (ratio * ratio + one).sqrt());
            let tangent = if ratio.round() < 0.0 {
                -tangent
            } else {
                tangent
            };
            let cosine = one / (tangent * tangent + one).sqrt();
            let sine = tangent * cosine;
            let rotate = |u: Double, v: Double| (cosine * u - sine * v, sine * u + cosine * v);
            for row in &mut matrix {
                (row[p], row[q]) = rotate(row[p], row[q]);
            }
            for k in 0..3 {
                (matrix[p][k], matrix[q][k]) = rotate(matrix[p][k], matrix[q][k]);
                (axes[p][k], axes[q][k]) = rotate(axes[p][k], axes[q][k]);
            }
        }
    }
    ([matrix[0][0], matrix[1][1], matrix[2][2]], axes)
}

/// Rotates axes with eigenvalue 0 so that F has a slope along at most one of them.
fn rotate_null_space(axes: &mut [Vector; 3], lambda: [Double; 3], linear: Vector) {
    let null = |i: &usize| lambda[*i].round() == 0.0;
    let indices: [usize; 3] = match (0..3).filter(null).count() {
        0 | 1 => return,
        2 => {
            let strong = (0..3).find(|i| !null(i)).unwrap_or(0);
            [strong, (strong + 1) % 3, (strong + 2) % 3]
        }
        _ => {
            // Any axis perpendicular to the slope can be the first.
            let least = rounded(linear).abs().min_position();
            let across = cross(linear, vector(DVec3::AXES[least]));
            if let Some(across) = unit(across) {
                axes[0] = across;
            }
            [0, 1, 2]
        }
    };
    let [strong, slope, flat] = indices;
    let along = dot(axes[strong], linear);
    let rest = sum(linear, scaled(-along, axes[strong]));
    let size = dot(linear, linear).sqrt().round();
    if dot(rest, rest).sqrt().round() <= NOISE * size {
        return;
    }
    if let Some(rest) = unit(rest) {
        axes[slope] = rest;
        axes[flat] = cross(axes[strong], rest);
    }
}

/// Returns d − n · x as if computed in twice the precision.
pub(super) fn difference(d: f64, n: DVec3, x: DVec3) -> f64 {
    (Double::of(d) - dot(vector(n), vector(x))).round()
}

fn unit(v: Vector) -> Option<Vector> {
    let length = dot(v, v).sqrt();
    (length.round() != 0.0).then(|| v.map(|component| component / length))
}

fn rounded(v: Vector) -> DVec3 {
    DVec3::from_array(v.map(Double::round))
}

fn larger(values: [Double; 3]) -> Double {
    values
        .into_iter()
        .map(Double::abs)
        .fold(Double::ZERO, |largest, value| {
            if largest.round() < value.round() {
                value
            } else {
                largest
            }
        })
}
