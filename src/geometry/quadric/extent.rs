//! The bounding box of a region.
//!
//! A coordinate is extreme at a stationary point on the quadric, or on its curve in a plane, where
//! the quadric crosses the line of two planes, or at the corner of three. All such points are
//! tested, and those in the region count. Six far planes close unbounded regions.

use glam::DVec3;

use super::form::Form;
use super::{HalfSpace, roots};
use crate::Aabb;

/// How far outside a point may be due to rounding, relative to its terms.
const TOLERANCE: f64 = 1.0 / (1 << 30) as f64;

/// The distance of the six far planes, in sizes of the solid. There the width of a paraboloid is
/// the square root of this, and must still differ from that of a bounded solid; and an ulp of this
/// must be less than a size.
const FAR_AWAY: f64 = (1_u64 << 48) as f64;

/// A region that extends farther, in sizes of the solid, is unbounded.
const ENDLESS: f64 = (1 << 18) as f64;

/// A plane m · p = d in the coordinates of the form, m of unit length.
#[derive(Clone, Copy)]
struct Plane {
    normal: DVec3,
    distance: f64,
}

impl Plane {
    /// The point closest to the origin.
    fn foot(&self) -> DVec3 {
        self.distance * self.normal
    }
}

struct Region<'a> {
    form: &'a Form,
    planes: Vec<Plane>,
    /// The size of the solid, or the distance of its planes.
    size: f64,
    /// The extremes of each world coordinate so far, relative to the centre.
    low: DVec3,
    high: DVec3,
    /// The gradients of the world coordinates.
    rises: [DVec3; 3],
}

/// The bounding box of the region, or [`Aabb::EMPTY`].
pub(super) fn bounds(form: &Form, half_spaces: &[HalfSpace]) -> Aabb {
    let form = &without_rounding(form);
    let mut planes: Vec<_> = half_spaces.iter().map(|half| plane(form, half)).collect();
    let farthest = |far: f64, plane: &Plane| far.max(plane.distance.abs());
    let own = if form.constant == 0.0 && form.linear == DVec3::ZERO {
        0.0
    } else {
        1.0
    };
    let size = planes.iter().fold(own, farthest);
    let size = if size == 0.0 { 1.0 } else { size };
    for axis in DVec3::AXES {
        for normal in [axis, -axis] {
            planes.push(Plane {
                normal,
                distance: FAR_AWAY * size,
            });
        }
    }
    let rises = std::array::from_fn(|k| {
        let rise = DVec3::from_array(form.columns.map(|column| column[k]));
        // The rest of a perpendicular axis is rounding.
        let least = f64::EPSILON * f64::EPSILON * rise.abs().max_element();
        DVec3::select(rise.abs().cmple(DVec3::splat(least)), DVec3::ZERO, rise)
    });
    let mut region = Region {
        form,
        planes,
        size,
        low: DVec3::INFINITY,
        high: DVec3::NEG_INFINITY,
        rises,
    };
    region.try_all();
    // Without planes no point is accepted by the tolerance of one.
    region.into_box(if half_spaces.is_empty() {
        4.0 * f64::EPSILON
    } else {
        TOLERANCE
    })
}

/// The function without terms that may be rounding of its coefficients: they would matter at the
/// far planes, but nowhere on a bounded region.
fn without_rounding(form: &Form) -> Form {
    let least = DVec3::splat(8.0 * f64::EPSILON);
    let significant = |v: DVec3| DVec3::select(v.abs().cmplt(least), DVec3::ZERO, v);
    Form {
        squares: significant(form.squares),
        linear: significant(form.linear),
        ..*form
    }
}

fn plane(form: &Form, half: &HalfSpace) -> Plane {
    let normal = DVec3::from_array(form.columns.map(|column| half.normal.dot(column)));
    let length = normal.length();
    Plane {
        normal: normal / length,
        distance: (half.distance + normal.dot(form.offset)) / length,
    }
}

impl Region<'_> {
    fn try_all(&mut self) {
        let Form {
            squares,
            linear,
            constant,
            ..
        } = *self.form;
        for rise in self.rises {
            for p in stationary(
                squares.to_array(),
                linear.to_array(),
                constant,
                rise.to_array(),
            ) {
                self.try_point(DVec3::from_array(p));
            }
        }
        let planes = self.planes.clone();
        for (i, first) in planes.iter().enumerate() {
            self.try_plane(first);
            for (j, second) in planes.iter().enumerate().take(i) {
                self.try_line(first, second);
                for third in planes.iter().take(j) {
                    let across = second.normal.cross(third.normal);
                    let volume = first.normal.dot(across);
                    let corner = first.distance * across
                        + second.distance * third.normal.cross(first.normal)
                        + third.distance * first.normal.cross(second.normal);
                    if TOLERANCE * TOLERANCE < volume.abs() {
                        self.try_point(corner / volume);
                    }
                }
            }
        }
    }

    /// Tests where a world coordinate is stationary on the curve of the quadric in a plane.
    fn try_plane(&mut self, plane: &Plane) {
        let s = self.form.squares;
        let foot = plane.foot();
        let (mut u, mut v) = plane.normal.any_orthonormal_pair();
        // One Jacobi rotation aligns the plane's axes with those of the curve.
        let off = u.dot(s * v);
        if off != 0.0 {
            let ratio = (v.dot(s * v) - u.dot(s * u)) / (2.0 * off);
            let tangent = 1.0_f64.copysign(ratio) / (ratio.abs() + (ratio * ratio + 1.0).sqrt());
            let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
            let sine = tangent * cosine;
            (u, v) = (cosine * u - sine * v, sine * u + cosine * v);
        }
        let slope = self.form.gradient(foot);
        let in_plane = |w: DVec3| [u.dot(w), v.dot(w)];
        let squares = [u.dot(s * u), v.dot(s * v)];
        for rise in self.rises {
            let level = self.form.value(foot);
            for [x, y] in stationary(squares, in_plane(slope), level, in_plane(rise)) {
                self.try_point(foot + x * u + y * v);
            }
        }
    }

    /// Tests where the line of two planes crosses the quadric.
    fn try_line(&mut self, first: &Plane, second: &Plane) {
        let along = first.normal.cross(second.normal);
        let square = along.length_squared();
        if square <= TOLERANCE * TOLERANCE {
            return;
        }
        let foot = (first.distance * second.normal.cross(along)
            + second.distance * along.cross(first.normal))
            / square;
        let a = along.dot(self.form.squares * along);
        let b = along.dot(self.form.gradient(foot));
        if a == 0.0 {
            let c = self.form.value(foot);
            self.try_point(foot - (0.5 * c / b) * along);
            return;
        }
        self.try_crossings(foot, along, a);
        // From the line's stationary point the discriminant of far crossings is more precise.
        self.try_crossings(foot - (b / a) * along, along, a);
    }

    /// Tests where a line crosses the quadric; `a` is the quadratic coefficient along it.
    fn try_crossings(&mut self, from: DVec3, along: DVec3, a: f64) {
        let b = along.dot(self.form.gradient(from));
        let c = self.form.value(from);
        let discriminant = b * b - a * c;
        if -TOLERANCE * (b * b + (a * c).abs()) <= discriminant {
            for t in roots(a, b, c, discriminant.max(0.0).sqrt()) {
                let p = from + t * along;
                self.try_point(p);
                // Far away the discriminant of a parabola has little precision.
                let p = self.nearer(self.nearer(p, along), along);
                self.try_point(p);
            }
        }
    }

    /// One Newton step toward the quadric.
    fn nearer(&self, p: DVec3, along: DVec3) -> DVec3 {
        let slope = along.dot(self.form.gradient(p));
        p - (0.5 * self.form.value(p) / slope) * along
    }

    /// Extends the box to a point in the region. A point that may be outside due to rounding
    /// counts: the box is never too small, and too large only where it is unbounded anyway.
    fn try_point(&mut self, p: DVec3) {
        if !p.is_finite() {
            return;
        }
        let Form {
            squares,
            linear,
            constant,
            ..
        } = *self.form;
        let length = p.length();
        let rounding = 2.0 * f64::EPSILON * length;
        let slack = TOLERANCE * length.min(self.size) + rounding;
        let terms = TOLERANCE * (p.dot(squares.abs() * p) + constant.abs())
            + squares.abs().max_element() * rounding * rounding
            + 2.0 * (squares * p).length() * rounding
            + 2.0 * linear.length() * slack;
        let inside = self.planes.iter().all(|plane| {
            plane.normal.dot(p) - plane.distance <= slack + TOLERANCE * plane.distance.abs()
        });
        if self.form.value(p) <= terms && inside {
            let position = DVec3::from_array(self.rises.map(|rise| rise.dot(p - self.form.offset)));
            self.low = self.low.min(position);
            self.high = self.high.max(position);
        }
    }

    /// The box around the region, with a relative padding.
    fn into_box(self, padding: f64) -> Aabb {
        if !self.low.cmple(self.high).all() {
            return Aabb::EMPTY;
        }
        let mut bounds = Aabb {
            min: DVec3::NEG_INFINITY,
            max: DVec3::INFINITY,
        };
        for k in 0..3 {
            let endless = ENDLESS * self.size * self.rises[k].length();
            let (low, high) = (self.low[k], self.high[k]);
            let centre = self.form.centre[k];
            let extent = (high - low).min(self.size * self.rises[k].length());
            let padding = padding * extent + 2.0 * f64::EPSILON * centre.abs();
            if -endless < low {
                bounds.min[k] = centre + low - padding;
            }
            if high < endless {
                bounds.max[k] = centre + high + padding;
            }
        }
        bounds
    }
}

/// The points where g · p is stationary on Σ sᵢ pᵢ² + 2 h · p + k = 0, and the centre, if the
/// function has one. Points that are not real are NaN.
///
/// With a Lagrange multiplier μ, pᵢ = (μ gᵢ − hᵢ) / sᵢ, and μ² = (h² + s S) / (g² + s R) for one of
/// the axes, with the sums over the others S = Σ h²/s − k and R = Σ g²/s. It is the axis with the
/// smallest s relative to h: there μ g − h cancels, and its product with μ g + h does not.
fn stationary<const N: usize>(
    s: [f64; N],
    h: [f64; N],
    k: f64,
    g: [f64; N],
) -> impl Iterator<Item = [f64; N]> {
    let missing = move |i: usize| s[i] == 0.0 && h[i] == 0.0;
    let ratio = |i: usize| {
        if missing(i) {
            -1.0
        } else {
            (h[i] / s[i]).abs()
        }
    };
    let weak = (1..N).fold(0, |weak, i| if ratio(weak) < ratio(i) { i } else { weak });
    let (mut sum, mut rises) = (-k, 0.0);
    let mut parallel = true;
    for i in (0..N).filter(|&i| i != weak || missing(i)) {
        if missing(i) {
            parallel &= g[i] == 0.0;
        } else {
            sum += h[i] * h[i] / s[i];
            rises += g[i] * g[i] / s[i];
        }
    }
    let (sw, hw, gw) = (s[weak], h[weak], g[weak]);
    let terms = hw * hw + (sw * sum).abs();
    let numerator = hw * hw + sw * sum;
    let numerator = if numerator.abs() <= TOLERANCE * TOLERANCE * terms {
        0.0
    } else {
        numerator
    };
    let denominator = gw * gw + sw * rises;
    let root = (numerator / denominator).sqrt();
    let root = if parallel { root } else { f64::NAN };
    let position = move |multiplier: f64| {
        std::array::from_fn(|i| {
            let (rise, slope) = (multiplier * g[i], h[i]);
            if missing(i) {
                0.0
            } else if i == weak && 0.0 < rise * slope {
                (gw * gw * sum - hw * hw * rises) / (denominator * (rise + slope))
            } else {
                (rise - slope) / s[i]
            }
        })
    };
    [root, -root, 0.0].into_iter().map(position)
}
