//! Textbook ray–solid intersection in twice the precision.

use glam::DVec3;

use super::{Frame, Kind, Ray};
use crate::double_double::{Double, Vector, cross, dot, scaled, sum, vector};

/// A solid with a dual basis of 106 bits.
pub(super) struct Exact {
    kind: Kind,
    origin: Vector,
    duals: [Vector; 3],
}

/// An interval of a line, with infinite ends where it is unbounded.
type Span = [Double; 2];

impl Exact {
    pub(super) fn new(kind: Kind, frame: &Frame) -> Self {
        let frame = frame.of(kind);
        let axes: [Vector; 3] = std::array::from_fn(|i| {
            let direction = vector(frame.directions[i]);
            let length = Double::of(frame.lengths[i]) / dot(direction, direction).sqrt();
            scaled(length, direction)
        });
        let volume = dot(axes[0], cross(axes[1], axes[2]));
        let duals = std::array::from_fn(|i| {
            let across = cross(axes[(i + 1) % 3], axes[(i + 2) % 3]);
            across.map(|component| component / volume)
        });
        Self {
            kind,
            origin: vector(frame.origin),
            duals,
        }
    }

    /// The interval of the line inside the solid.
    pub(super) fn span(&self, ray: &Ray) -> Option<[f64; 2]> {
        let (o, d, start) = self.unit_line(ray);
        let [enter, exit] = self.unit_span(o, d)?;
        Some([(enter + start).round(), (exit + start).round()])
    }

    /// Returns 1 − l², where l is the least distance of the line from the unit solid's origin.
    pub(super) fn clearance(&self, ray: &Ray) -> f64 {
        let (o, d, _) = self.unit_line(ray);
        let along = dot(o, d);
        (Double::of(1.0) - dot(o, o) + along * along / dot(d, d)).round()
    }

    /// The line from its point closest to the solid's origin, and the distance of that point.
    fn unit_line(&self, ray: &Ray) -> (Vector, Vector, Double) {
        let direction = vector(ray.direction);
        let offset = sum(vector(ray.origin), self.origin.map(|component| -component));
        let start = -(dot(offset, direction) / dot(direction, direction));
        let nearest = sum(offset, scaled(start, direction));
        let o = self.duals.map(|dual| dot(dual, nearest));
        let d = self.duals.map(|dual| dot(dual, direction));
        (o, d, start)
    }

    fn unit_span(&self, o: Vector, d: Vector) -> Option<Span> {
        let one = Double::of(1.0);
        let flat = |v: Vector| [v[0], v[1], Double::ZERO];
        match self.kind {
            Kind::Sphere | Kind::Ellipsoid => below_zero(dot(d, d), dot(o, d), dot(o, o) - one),
            Kind::Cuboid => {
                let first = overlap(slab(o[0], d[0])?, slab(o[1], d[1])?)?;
                overlap(first, slab(o[2], d[2])?)
            }
            Kind::Cylinder => {
                let (o2, d2) = (flat(o), flat(d));
                let side = below_zero(dot(d2, d2), dot(o2, d2), dot(o2, o2) - one)?;
                overlap(side, slab(o[2], d[2])?)
            }
            Kind::Cone => {
                let apex = [o[0], o[1], o[2] - one];
                let mirrored = |v: Vector| [v[0], v[1], -v[2]];
                let a = dot(d, mirrored(d));
                let [first, last] =
                    below_zero(a, dot(apex, mirrored(d)), dot(apex, mirrored(apex)))?;
                let side = if 0.0 < a.round() {
                    [first, last]
                } else if 0.0 < d[2].round() {
                    [Double::of(f64::NEG_INFINITY), first]
                } else {
                    [last, Double::of(f64::INFINITY)]
                };
                overlap(side, slab(o[2], d[2])?)
            }
        }
    }
}

/// The real roots of a t² + 2 b t + c = 0 in ascending order.
fn below_zero(a: Double, b: Double, c: Double) -> Option<Span> {
    let discriminant = b * b - a * c;
    if discriminant.round() < 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    let (first, second) = ((-b - root) / a, (root - b) / a);
    Some(if 0.0 < a.round() {
        [first, second]
    } else {
        [second, first]
    })
}

fn slab(o: Double, d: Double) -> Option<Span> {
    if d.round() == 0.0 {
        let inside = 0.0 <= o.round() && o.round() <= 1.0;
        return inside.then_some([f64::NEG_INFINITY, f64::INFINITY].map(Double::of));
    }
    let (low, high) = (-o / d, (Double::of(1.0) - o) / d);
    Some(if 0.0 < d.round() {
        [low, high]
    } else {
        [high, low]
    })
}

fn overlap(a: Span, b: Span) -> Option<Span> {
    // Differences with an infinite end are NaN: compare the leading parts.
    let less = |x: Double, y: Double| {
        let difference = (x - y).round();
        if difference.is_nan() {
            x.round() < y.round()
        } else {
            difference < 0.0
        }
    };
    let enter = if less(a[0], b[0]) { b[0] } else { a[0] };
    let exit = if less(b[1], a[1]) { b[1] } else { a[1] };
    (!less(exit, enter)).then_some([enter, exit])
}

#[test]
fn spans_match_hand_computed_values() {
    let frame = Frame::upright(DVec3::ZERO, DVec3::ONE);
    let along_z = super::ray(DVec3::new(0.0, 0.0, -5.0), DVec3::ZERO);
    let spans = [
        (Kind::Ellipsoid, [4.0, 6.0]),
        (Kind::Cuboid, [5.0, 6.0]),
        (Kind::Cone, [5.0, 6.0]),
    ];
    for (kind, span) in spans {
        assert_eq!(Exact::new(kind, &frame).span(&along_z), Some(span));
    }
    let along_x = super::ray(DVec3::new(-5.0, 0.0, 0.5), DVec3::new(0.0, 0.0, 0.5));
    let across = [(Kind::Cylinder, [4.0, 6.0]), (Kind::Cone, [4.5, 5.5])];
    for (kind, span) in across {
        assert_eq!(Exact::new(kind, &frame).span(&along_x), Some(span));
    }
}
