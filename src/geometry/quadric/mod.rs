//! Solids bounded by a quadric and planes.

mod axes;
mod extent;
mod form;

use glam::DVec3;

use super::line::{Ends, half_line, roots};
use super::transform::{normalise, power_of_two};
use super::{Aabb, Chart, Crossings, Hit, Ray, Surface};
pub use axes::principal_axes;
use form::{Form, QuadricLine};

/// The part of the curved side; plane i is part 1 + i.
const CURVED: u32 = 0;

/// The region where a quadratic function is at most 0, clipped by half-spaces: convex or concave,
/// bounded or unbounded.
///
/// Part 0 is the quadric itself, part 1 + i the boundary plane of half-space i.
#[derive(Clone, Debug, PartialEq)]
pub struct Quadric {
    form: Form,
    half_spaces: Vec<HalfSpace>,
    bounds: Aabb,
    has_lost_its_shape: bool,
}

/// The half-space normal · (x − centre) ≤ distance, relative to the centre of the form.
#[derive(Clone, Copy, Debug, PartialEq)]
struct HalfSpace {
    /// Scaled by a power of two, which keeps its bits, to a length from 1 to 4.
    normal: DVec3,
    distance: f64,
}

impl Quadric {
    /// The maximum number of half-spaces: the bounding box takes time cubic in it.
    pub const MOST_HALF_SPACES: usize = 64;

    /// Creates the region A x² + 2B xy + 2C xz + 2D x + E y² + 2F yz + 2G y + H z² + 2I z + J ≤ 0,
    /// coefficients in this order, clipped by the half-spaces n · x ≤ d, at most
    /// [`Self::MOST_HALF_SPACES`] pairs n, d. All numbers must be finite, and each n nonzero.
    pub fn new(coefficients: [f64; 10], half_spaces: &[(DVec3, f64)]) -> Self {
        let form = Form::new(coefficients);
        let half_spaces: Vec<_> = half_spaces
            .iter()
            .map(|&(normal, distance)| HalfSpace::new(normal, distance, form.centre))
            .collect();
        let bounds = extent::bounds(&form, &half_spaces);
        let has_lost_its_shape =
            form.centre.length_squared() * 2_f64.powi(-52) > 1e-4 * size(&form, bounds).powi(2);
        Self {
            form,
            half_spaces,
            bounds,
            has_lost_its_shape,
        }
    }

    /// An axis-aligned box around the region, tight to a billionth of its size, with infinite sides
    /// where the region is unbounded.
    pub fn bounds(&self) -> Aabb {
        self.bounds
    }

    /// Whether the region contains no point.
    pub fn is_empty(&self) -> bool {
        self.bounds.is_empty()
    }

    /// Its sizes: those of its bounds that are finite, and that of its curvature if it is curved.
    pub fn sizes(&self) -> impl Iterator<Item = f64> {
        let curved = self.form.squares != DVec3::ZERO;
        let bounds = self.bounds.size().to_array().into_iter();
        let bounded = bounds.filter(|size| size.is_finite());
        bounded.chain(curved.then_some(self.form.unit))
    }

    /// Whether the solid is too small for its distance from the origin to be described by
    /// coefficients in `f64`: |centre|² 2⁻⁵² > 1e-4 size².
    pub fn has_lost_its_shape(&self) -> bool {
        self.has_lost_its_shape
    }

    /// The spans of the ray's line inside the region, at most two, in ascending order.
    #[inline]
    pub fn crossings(&self, ray: &Ray) -> [Option<Crossings>; 2] {
        let line = self.form.line(ray);
        let [first, second] = inside(&self.form, &line);
        if first.is_none() && second.is_none() {
            return [None; 2];
        }
        let Some(clip) = self.clip(&line) else {
            return [None; 2];
        };
        let clipped = |span: Crossings| span.overlap(clip)?.shifted(line.start);
        [first.and_then(clipped), second.and_then(clipped)]
    }

    /// The nearest crossing with `0 < t < limit`.
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let [first, second] = self.crossings(ray);
        first
            .and_then(|span| span.nearest(limit))
            .or_else(|| second?.nearest(limit))
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let line = self.form.line(ray);
        let t = hit.t - line.start;
        match self.half_spaces.get((hit.part as usize).wrapping_sub(1)) {
            Some(half_space) => {
                half_space.surface(line.position + t * line.direction, self.form.centre)
            }
            None => curved_surface(&self.form, line.p + t * line.q),
        }
    }

    /// The texture coordinates at a hit: those of a sphere around the centre with its poles along
    /// z, on the planes too.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        let line = self.form.line(ray);
        Chart::of_ball(line.position + (hit.t - line.start) * line.direction)
    }

    /// A function that is at most 0 inside the region only, continuous and without a scale.
    pub(super) fn excess(&self, point: DVec3) -> f64 {
        let position = point - self.form.centre;
        let p = self.form.map_vector(position) + self.form.offset;
        let outside = |half: &HalfSpace| half.normal.dot(position) - half.distance;
        let curved = self.form.value(p);
        self.half_spaces.iter().map(outside).fold(curved, f64::max)
    }

    /// The number of parts.
    pub(super) fn parts(&self) -> u32 {
        1 + self.half_spaces.len() as u32
    }

    /// The interval inside all half-spaces.
    #[inline]
    fn clip(&self, line: &QuadricLine) -> Option<Crossings> {
        let mut clip = Crossings::EVERYWHERE;
        for (half_space, part) in self.half_spaces.iter().zip(1..) {
            let outside = half_space.normal.dot(line.position) - half_space.distance;
            let speed = half_space.normal.dot(line.direction);
            if speed == 0.0 {
                if outside <= 0.0 {
                    continue;
                }
                return None;
            }
            let hit = Hit {
                t: -outside / speed,
                part,
            };
            if speed < 0.0 {
                if clip.enter.t < hit.t {
                    clip.enter = hit;
                }
            } else if hit.t < clip.exit.t {
                clip.exit = hit;
            }
        }
        (clip.enter.t <= clip.exit.t).then_some(clip)
    }
}

impl HalfSpace {
    fn new(normal: DVec3, distance: f64, centre: DVec3) -> Self {
        let factor = power_of_two(normal.abs().max_element());
        let normal = normal / factor;
        Self {
            normal,
            distance: axes::difference(distance / factor, normal, centre),
        }
    }

    fn surface(&self, position: DVec3, centre: DVec3) -> Surface {
        let square = self.normal.length_squared();
        let outside = self.normal.dot(position) - self.distance;
        let position = position - (outside / square) * self.normal;
        let normal = self.normal / square.sqrt();
        Surface {
            point: centre + position,
            normal,
            shading: normal,
            scale: centre.abs().max_element().max(position.abs().max_element()),
        }
    }
}

/// The intervals where F ≤ 0 on a line: a t² + 2 b t + c ≤ 0.
///
/// By Lagrange's identity b² − ac consists of the line's moment, p × q, whose square is small if
/// the line is close to the centre, and of terms that are 0 for most solids: no difference of large
/// numbers. If a = 0 the line is parallel to a generatrix or an asymptote.
#[inline]
fn inside(form: &Form, line: &QuadricLine) -> [Option<Crossings>; 2] {
    let (p, q) = (line.p, line.q);
    let (s, h) = (form.squares, form.linear);
    let (sp, sq) = (s * p, s * q);
    let (across, along) = (p.dot(sq), h.dot(q));
    let a = q.dot(sq);
    let b = across + along;
    let level = 2.0 * h.dot(p) + form.constant;
    let c = p.dot(sp) + level;
    if a == 0.0 {
        return [half_line(b, c, CURVED).map(Crossings::from), None];
    }
    let moment = p.cross(q);
    let products = DVec3::new(s.y * s.z, s.z * s.x, s.x * s.y);
    let discriminant = along * (along + 2.0 * across) - a * level - products.dot(moment * moment);
    if discriminant < 0.0 || (discriminant == 0.0 && a < 0.0) {
        return [(a < 0.0).then_some(Crossings::EVERYWHERE), None];
    }
    let [first, second] = roots(a, b, c, discriminant.sqrt());
    let between = |enter, exit, part| Crossings::from(Ends::between(enter, exit, part, true));
    if 0.0 < a {
        [Some(between(first, second, CURVED)), None]
    } else {
        [
            Some(between(f64::NEG_INFINITY, first, CURVED)),
            Some(between(second, f64::INFINITY, CURVED)),
        ]
    }
}

/// The surface near p: two Newton steps along the gradient reduce the error of a distance to that
/// of F itself. The uncertainty of the position is that of F over its slope in the world.
fn curved_surface(form: &Form, mut p: DVec3) -> Surface {
    for _ in 0..2 {
        let gradient = form.gradient(p);
        let square = gradient.length_squared();
        if 0.0 < square {
            p -= (0.5 * form.value(p) / square) * gradient;
        }
    }
    let slope = form.gradient_in_world(form.gradient(p));
    let position = form.position(p);
    let scale = form
        .centre
        .abs()
        .max_element()
        .max(position.abs().max_element());
    let uncertain = 0.5 * form.terms(p) / slope.length();
    let normal = normalise(slope).unwrap_or(DVec3::Z);
    Surface {
        point: form.centre + position,
        normal,
        shading: normal,
        scale: if uncertain.is_finite() {
            scale.max(uncertain)
        } else {
            scale
        },
    }
}

/// The least size that rounded coefficients must represent. Planes have none. The waist of a cone
/// or a hyperboloid may itself be rounding, so the size of the region counts.
fn size(form: &Form, bounds: Aabb) -> f64 {
    if form.squares == DVec3::ZERO {
        return f64::INFINITY;
    }
    let mixed = 0.5 < form.squares.max_element() && form.squares.min_element() < -0.5;
    if mixed || (form.constant == 0.0 && form.linear == DVec3::ZERO) {
        0.5 * bounds.size().min_element().max(0.0)
    } else {
        form.unit
    }
}
