//! Choice of directions toward a part of a surface, with their density.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::sampling::warp;
use geometry::lanes::{Eight, Lanes, Row, Simd, Vector};
use geometry::{Ball, Flat, Parallelograms, Patch, Side};

/// A direction toward a part of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Aim {
    /// The unit vector.
    pub(super) toward: DVec3,
    /// The distance within which a ray in this direction hits the part, if nothing is in between.
    pub(super) reach: f64,
    /// See [`density`].
    pub(super) density: f64,
    /// The side of the part that it hits.
    pub(super) side: Side,
}

/// Allows for rounding of a distance.
const SLACK: f64 = 1.0 + 1e-6;

/// The part of the parallelogram that a triangle is, and the whole.
const TRIANGLE: f64 = 0.5;
const PARALLELOGRAM: f64 = 1.0;

/// Flat parts of surfaces, in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Flats<N> {
    whole: Parallelograms<N>,
    /// [`TRIANGLE`] or [`PARALLELOGRAM`]; 0 in unused lanes.
    fraction: N,
}

/// Directions toward flat parts: see [`Aim`].
#[derive(Clone, Copy, Debug)]
pub(super) struct Aims<N: Lanes> {
    pub(super) toward: Vector<N>,
    pub(super) reach: N,
    pub(super) density: N,
    pub(super) is_front: N::Mask,
}

/// Chooses a direction from a point toward a part, by two numbers in 0..1: points of flat
/// parts uniformly by area, a ball, from outside, uniformly over the directions of its unit
/// sphere's space.
pub(super) fn aim(patch: &Patch, from: DVec3, place: [f64; 2]) -> Option<Aim> {
    let flats = match patch {
        Patch::Triangle(flat) => Flats::new(flat, TRIANGLE),
        Patch::Parallelogram(flat) => Flats::new(flat, PARALLELOGRAM),
        Patch::Ball(ball) => return aim_at_ball(ball, from, place),
    };
    let (aims, is_finite) = flats.aim(from.into(), place);
    is_finite.then(|| Aim {
        toward: aims.toward.into(),
        reach: aims.reach,
        density: aims.density,
        side: if aims.is_front {
            Side::Front
        } else {
            Side::Back
        },
    })
}

/// The density of [`aim`] per steradian in the direction `toward`, in which the part is hit
/// at a point.
pub(super) fn density(patch: &Patch, from: DVec3, toward: DVec3, at: DVec3) -> f64 {
    let flats = match patch {
        Patch::Triangle(flat) => Flats::new(flat, TRIANGLE),
        Patch::Parallelogram(flat) => Flats::new(flat, PARALLELOGRAM),
        Patch::Ball(ball) => return density_of_ball(ball, from, toward),
    };
    flats.density(toward.into(), at.distance_squared(from))
}

/// A point of a part and the normal there, by two numbers in 0..1.
pub(super) fn point(patch: &Patch, place: [f64; 2]) -> (DVec3, DVec3) {
    match patch {
        Patch::Triangle(flat) => (in_triangle(flat, place), flat.normal.normalize_or_zero()),
        Patch::Parallelogram(flat) => (at(flat, place), flat.normal.normalize_or_zero()),
        Patch::Ball(ball) => {
            let unit = DVec3::from(warp::in_cone(DVec3::Z.into(), 2.0, place));
            let [x, y, z] = ball.duals;
            let normal = unit.x * x + unit.y * y + unit.z * z;
            (
                ball.centre + ball.to_world(unit),
                normal.normalize_or_zero(),
            )
        }
    }
}

fn at(flat: &Flat, [u, v]: [f64; 2]) -> DVec3 {
    flat.corner + u * flat.sides[0] + v * flat.sides[1]
}

fn in_triangle(flat: &Flat, place: [f64; 2]) -> DVec3 {
    at(flat, to_triangle(place))
}

/// Maps the square to the triangle below its diagonal, uniformly and with little distortion (Heitz,
/// "A Low-Distortion Map Between Triangle and Square", 2019), in each lane.
#[inline(always)]
fn to_triangle<N: Lanes>([u, v]: [N; 2]) -> [N; 2] {
    let (half_u, half_v) = (u.all(0.5) * u, v.all(0.5) * v);
    let is_above = u.below(v);
    [
        N::select(is_above, half_u, u - half_v),
        N::select(is_above, v - half_u, half_v),
    ]
}

impl Flats<f64> {
    fn new(flat: &Flat, fraction: f64) -> Self {
        let whole = flat.into();
        Self { whole, fraction }
    }
}

impl<N: Lanes> Flats<N> {
    /// Replaces some by triangles.
    #[inline(always)]
    pub(super) fn put_triangles(&mut self, mask: N::Mask, triangles: &Parallelograms<N>) {
        let Parallelograms {
            corner,
            sides: [across, up],
            normal,
        } = &mut self.whole;
        let [across_triangle, up_triangle] = triangles.sides;
        *corner = Vector::select(mask, triangles.corner, *corner);
        *across = Vector::select(mask, across_triangle, *across);
        *up = Vector::select(mask, up_triangle, *up);
        *normal = Vector::select(mask, triangles.normal, *normal);
        self.fraction = N::select(mask, self.fraction.all(TRIANGLE), self.fraction);
    }

    /// See [`aim`]; the mask selects lanes in which there is a direction.
    #[inline(always)]
    pub(super) fn aim(&self, from: Vector<N>, [u, v]: [N; 2]) -> (Aims<N>, N::Mask) {
        let is_triangle = self.fraction.equals(self.fraction.all(TRIANGLE));
        let [across, up] = to_triangle([u, v]);
        let u = N::select(is_triangle, across, u);
        let v = N::select(is_triangle, up, v);
        let Parallelograms { corner, sides, .. } = &self.whole;
        let at = *corner + sides[0].scaled(u) + sides[1].scaled(v);
        let offset = at - from;
        let square = offset.length_squared();
        let distance = square.sqrt();
        let toward = offset.over(distance);
        let aims = Aims {
            toward,
            reach: distance.all(SLACK) * distance,
            density: self.density(toward, square),
            is_front: toward.dot(self.whole.normal).below(square.all(0.0)),
        };
        (aims, toward.is_finite())
    }

    /// The density per steradian, given the square of the distance.
    #[inline(always)]
    fn density(&self, toward: Vector<N>, square: N) -> N {
        let seen = self.fraction * self.whole.normal.dot(toward).abs();
        finite(square / seen)
    }
}

impl Flats<Row> {
    /// Room for flat parts.
    pub(super) const NONE: Self = Self {
        whole: Parallelograms {
            corner: Vector::repeat(DVec3::ZERO),
            sides: [Vector::repeat(DVec3::ZERO); 2],
            normal: Vector::repeat(DVec3::ZERO),
        },
        fraction: Row::all(0.0),
    };

    /// Puts a part into a lane; whether it is flat.
    #[inline(always)]
    pub(super) fn set(&mut self, lane: usize, patch: &Patch) -> bool {
        let (flat, fraction) = match patch {
            Patch::Triangle(flat) => (flat, TRIANGLE),
            Patch::Parallelogram(flat) => (flat, PARALLELOGRAM),
            Patch::Ball(_) => return false,
        };
        self.whole.corner.set(lane, flat.corner);
        self.whole.sides[0].set(lane, flat.sides[0]);
        self.whole.sides[1].set(lane, flat.sides[1]);
        self.whole.normal.set(lane, flat.normal);
        self.fraction.0[lane] = fraction;
        true
    }

    /// Loads the parts into SIMD vectors.
    #[inline(always)]
    pub(super) fn load<S: Simd>(&self, simd: S) -> Flats<Eight<S>> {
        let [across, up] = &self.whole.sides;
        Flats {
            whole: Parallelograms {
                corner: self.whole.corner.load(simd),
                sides: [across.load(simd), up.load(simd)],
                normal: self.whole.normal.load(simd),
            },
            fraction: self.fraction.load(simd),
        }
    }
}

/// Chooses a direction toward a ball; `None` inside.
fn aim_at_ball(ball: &Ball, from: DVec3, place: [f64; 2]) -> Option<Aim> {
    let offset = ball.to_unit(ball.centre - from);
    let versine = versine(offset)?;
    let chosen = warp::in_cone(offset.normalize().into(), versine, place);
    let turned = ball.to_world(chosen.into());
    let speed = turned.length();
    let toward = turned / speed;
    toward.is_finite().then(|| Aim {
        toward,
        density: density_of_ball(ball, from, toward),
        side: Side::Front,
        // From the surface itself, the far side is seen.
        reach: SLACK * speed * (1.0 + offset.length()),
    })
}

/// The density of [`aim_at_ball`]. A direction d of unit length is the image of one that covers |M⁻¹ d|³ det M as much of the
/// sphere.
fn density_of_ball(ball: &Ball, from: DVec3, toward: DVec3) -> f64 {
    let offset = ball.to_unit(ball.centre - from);
    versine(offset).map_or(0.0, |versine| {
        let shrunk = ball.to_unit(toward).length();
        finite(1.0 / (TAU * versine * ball.volume() * shrunk * shrunk * shrunk))
    })
}

/// 1 − cos of the half angle that a unit sphere subtends from a point; `None` inside.
fn versine(offset: DVec3) -> Option<f64> {
    let square = 1.0 / offset.length_squared();
    (square < 1.0).then(|| square / (1.0 + (1.0 - square).sqrt()))
}

/// A density; where it overflows, 0, which leaves a direction to BSDF sampling. In each lane.
#[inline(always)]
fn finite<N: Lanes>(density: N) -> N {
    N::select(Lanes::is_finite(density), density, density.all(0.0))
}
