//! The part of a point's gathering disc that lies on the point's own surface: walls, edges and folds cut
//! the disc, and photons arrive on the rest alone.
//!
//! A place of the disc is reached by a ray that rises a little from the point to above the place, and
//! one straight down from there to the surface. Photons count where both pass, and the area of the
//! places where both pass is what their kernel is divided by: whatever stands in the way, photons and
//! area are those of one region. The bias that the disc leaves shrinks with the kernel.

use std::cell::Cell;
use std::f64::consts::TAU;

use glam::{DMat3, DVec3, Vec3};

use crate::integrators::photon::{Photon, hash};
use crate::integrators::vertex::Vertex;
use crate::material::{Bsdf, Point};
use crate::sampling::warp;
use crate::world::{Nearby, Nearest, World};
use geometry::{Ray, Side};

/// The least cosine between the normals of one surface: beyond, a fold ends it.
pub(crate) const SAME: f64 = 0.7;

/// Rays to the rim, which tell whether anything cuts the disc: a straight cut that all of them miss
/// takes less than 1/200 of the kernel.
const RIM: u32 = 8;

/// The distance from the point at which the rim is asked for, as a share of the radius.
const AT_RIM: f64 = 0.97;

/// Places at which a disc that is cut is measured. A straight cut through its middle then leaves an
/// uncertainty of 2.5 %, with 32 of 4 %.
const PLACES: u32 = 64;

/// The share below which a disc is not measured: less than eight places are left, and the inverse of so
/// rough a share is off in the mean.
const LEAST_SHARE: f64 = 1.0 / 8.0;

/// How much rays rise above the surface, as a share of their way: the less, the narrower a gap they
/// pass; the more, the deeper a hollow is one surface.
const RISE: f64 = 0.1;

/// The share of a disc from which on light is taken to slope across it a little, and the share above
/// which its slope is not restrained. What is left of a disc lies to one side of the point, so that a
/// slope counts that a whole disc evens out: .3 from a mirror, by a kernel of radius .9, it is 2 % of the
/// light. With less than half a disc left, making up for it has more than three times the variance,
/// which costs more.
const SLOPED: [f64; 2] = [0.5, 0.7];

/// How deep places are searched for the surface, as a share of their way: farther than the steepest slope
/// of the same surface falls.
const DEPTH: f64 = 1.5;

/// The golden section of a turn.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Walls told apart.
const WALLS: usize = 8;

/// The disc of a radius around a point.
pub(crate) struct Disc<'w> {
    world: &'w World,
    vertex: &'w Vertex<'w>,
    point: &'w Point,
    /// All objects that rays to places may meet.
    nearby: Nearby<'w>,
    /// The geometric normal, on the side that is seen.
    facing: DVec3,
    radius: f64,
    /// Unit vectors along the surface.
    frame: [DVec3; 2],
    /// The part of a turn by which places are turned, unrelated from point to point.
    turn: f64,
    /// Rays traced.
    rays: Cell<u64>,
}

/// The part of a disc that lies on its surface.
pub(crate) struct Part<'d> {
    disc: &'d Disc<'d>,
    /// The share of the disc, by its kernel.
    share: f64,
    /// Whether walls hide most of the rest, rather than the surface ending before.
    is_hidden: bool,
    /// The factor of the kernel at the point, and its changes along the surface per radius.
    factor: DVec3,
    walls: Walls,
}

/// How much of a disc lies on its surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Extent {
    /// Enough to be measured by its places.
    Measured,
    /// Less, or nothing if it is gone: the point is in a gap between walls.
    Hidden { is_gone: bool },
    /// Less: the surface is much smaller.
    Ended,
}

/// Walls around a point: a point of each, and its normal on that side.
#[derive(Default)]
struct Walls {
    count: usize,
    known: [(DVec3, DVec3); WALLS],
}

/// What is met at a place of the disc.
enum PathHit {
    /// A wall before it: a point and its normal.
    Wall(DVec3, DVec3),
    /// The surface, at an offset from the point, which carries so much of the place's kernel.
    Surface(DVec3, f64),
    /// Neither: the surface ends before.
    Nothing,
}

impl<'w> Disc<'w> {
    /// The disc with a radius above 0.
    pub(crate) fn new(world: &'w World, vertex: &'w Vertex<'w>, radius: f64) -> Self {
        /// Places are searched no farther from the point, in radii: 1.72 is √(1 + (DEPTH − RISE)²).
        const REACH: f64 = 1.73;
        let point = &vertex.point;
        let facing = point.side.turn(point.surface.normal);
        let place = (point.surface.point / radius).to_array();
        let bits = hash(place.map(|along| along.to_bits() as i64)) as u64;
        Self {
            world,
            vertex,
            point,
            nearby: Nearby::new(world, point.surface.point, REACH * radius),
            facing,
            radius,
            frame: warp::basis(facing),
            turn: (bits >> 11) as f64 / (1u64 << 53) as f64,
            rays: Cell::new(0),
        }
    }

    /// Rays traced so far.
    pub(crate) fn rays(&self) -> u64 {
        self.rays.get()
    }

    /// The part of the disc that lies on the surface; `None` if nothing cuts it.
    pub(crate) fn part(&self) -> Option<Part<'_>> {
        if self.is_surely_whole() {
            return None;
        }
        let is_whole = |number| {
            let around = (f64::from(number) + self.turn) / f64::from(RIM);
            matches!(self.met(around, AT_RIM), PathHit::Surface(..))
        };
        if (0..RIM).all(is_whole) {
            return None;
        }
        let mut walls = Walls::default();
        let [mut hidden, mut ended] = [0, 0];
        // Sums of 1, x, y; of x, xx, xy; of y, xy, yy.
        let mut moments = DMat3::ZERO;
        for number in 0..PLACES {
            // With the density of the kernel.
            let until = (f64::from(number) + self.turn) / f64::from(PLACES);
            let distance = (1.0 - (1.0 - until).sqrt()).sqrt();
            match self.met(f64::from(number) * GOLDEN + self.turn, distance) {
                PathHit::Wall(at, normal) => {
                    walls.add(self.radius, at, normal);
                    hidden += 1;
                }
                PathHit::Surface(offset, weight) => {
                    let place = self.place(offset);
                    let each = place.to_array().map(|along| weight * along * place);
                    moments += DMat3::from_cols(each[0], each[1], each[2]);
                }
                PathHit::Nothing => ended += 1,
            }
        }
        moments *= 1.0 / f64::from(PLACES);
        Some(Part {
            disc: self,
            share: moments.x_axis.x,
            is_hidden: ended < hidden,
            factor: factor(&moments),
            walls,
        })
    }

    /// Whether all places are known to be on the surface, without a ray.
    fn is_surely_whole(&self) -> bool {
        let Vertex {
            nearest: Nearest { object, hit },
            material,
            ref bsdf,
            ..
        } = *self.vertex;
        let at = self.point.surface.point;
        let shape = &self.world.scene.objects[object as usize].shape;
        material.maps.is_none()
            && bsdf.takes_photons(self.point)
            && self.radius <= shape.smooth_within(hit, at)
            && self.nearby.is_alone(object, at, self.radius)
    }

    /// What is met at a place at a part of a turn, at a distance in radii.
    fn met(&self, around: f64, distance: f64) -> PathHit {
        let (sine, cosine) = libm::sincos(TAU * around);
        let [right, up] = self.frame;
        let flat = distance * self.radius;
        let aside = flat * (cosine * right + sine * up);
        let (ray, wall) = self.wall(aside, flat);
        if let Some(nearest) = wall {
            let shape = &self.world.scene.objects[nearest.object as usize].shape;
            let surface = shape.surface(&ray, nearest.hit);
            let side = Side::hit(ray.direction, surface.normal);
            return PathHit::Wall(surface.point, side.turn(surface.normal));
        }
        let Some((at, normal)) = self.below(aside, flat) else {
            return PathHit::Nothing;
        };
        let offset = at - self.point.surface.point;
        if !self.is_same(offset, normal) {
            return PathHit::Nothing;
        }
        let kernel = |square: f64| (1.0 - square).max(0.0);
        let there = kernel(offset.length_squared() / (self.radius * self.radius));
        let weight = there / kernel(distance * distance) / normal.dot(self.facing);
        PathHit::Surface(offset, weight)
    }

    /// The ray to above a place, and what stands in its way.
    fn wall(&self, aside: DVec3, flat: f64) -> (Ray, Option<Nearest>) {
        let way = aside + RISE * flat * self.facing;
        let length = way.length();
        let ray = self.point.leave(way / length);
        self.rays.set(self.rays.get() + 1);
        let wall = self.nearby.nearest(&ray, length);
        (ray, wall)
    }

    /// The surface below a place if photons arrive at it, and its normal.
    fn below(&self, aside: DVec3, flat: f64) -> Option<(DVec3, DVec3)> {
        let ray = self.down(aside, flat);
        let nearest = self.nearby.nearest(&ray, DEPTH * flat)?;
        let mut mapped = None;
        let (point, material) = self.world.shading_point(&ray, nearest, &mut mapped);
        let bsdf = Bsdf::at(&point, material, self.world.gloss);
        let normal = point.side.turn(point.surface.normal);
        let takes = bsdf.takes_photons(&point);
        takes.then_some((point.surface.point, normal))
    }

    /// The ray down to a place.
    fn down(&self, aside: DVec3, flat: f64) -> Ray {
        self.rays.set(self.rays.get() + 1);
        Ray {
            origin: self.point.surface.point + aside + RISE * flat * self.facing,
            direction: -self.facing,
        }
    }

    /// Whether what is at an offset and has this normal may be the same surface: no lower than the
    /// normal explains.
    fn is_same(&self, offset: DVec3, normal: DVec3) -> bool {
        let (aside, height) = self.split(offset);
        let flat = aside.length();
        let cosine = normal.dot(self.facing);
        let slope = (1.0 - cosine * cosine).max(0.0).sqrt() / cosine;
        let rounding = 1e-6 * self.radius;
        SAME <= cosine
            && height <= RISE * flat + rounding
            && -height <= (slope + RISE) * flat + rounding
    }

    /// Whether the way to a photon is open.
    fn is_open(&self, offset: DVec3) -> bool {
        let (aside, height) = self.split(offset);
        let flat = aside.length();
        if flat == 0.0 {
            return true;
        }
        let rounding = 1e-6 * self.radius;
        self.wall(aside, flat).1.is_none() && {
            let ray = self.down(aside, flat);
            let nearest = self.nearby.nearest(&ray, RISE * flat - height - rounding);
            nearest.is_none()
        }
    }

    /// The part of an offset along the surface, and that off it.
    fn split(&self, offset: DVec3) -> (DVec3, f64) {
        let height = offset.dot(self.facing);
        (offset - height * self.facing, height)
    }

    /// 1, and the offset along the surface in radii.
    fn place(&self, offset: DVec3) -> DVec3 {
        let [x, y] = self.frame.map(|axis| axis.dot(offset) / self.radius);
        DVec3::new(1.0, x, y)
    }
}

/// The factor of the kernel at a point, and its changes across, by which what is left of the disc
/// stands for all of it. Of what all places miss no more is known than that it is less than one place
/// stands for.
fn factor(moments: &DMat3) -> DVec3 {
    let share = moments.x_axis.x.max(1.0 / f64::from(PLACES));
    let even = DVec3::new(1.0 / share, 0.0, 0.0);
    let [from, to] = SLOPED;
    let sureness = ((share - from) / (to - from)).clamp(0.0, 1.0);
    // Light that changes linearly counts as at the point: local linear regression (Fan and Gijbels,
    // "Local Polynomial Modelling and Its Applications", 1996).
    let sloped = moments.inverse() * DVec3::X;
    let is_sloped = 0.0 < sureness && sloped.is_finite();
    if is_sloped {
        even.lerp(sloped, sureness)
    } else {
        even
    }
}

impl Part<'_> {
    /// What it tells about the disc.
    pub(crate) fn extent(&self) -> Extent {
        if LEAST_SHARE <= self.share {
            Extent::Measured
        } else if self.is_hidden {
            Extent::Hidden {
                is_gone: self.share <= 0.0,
            }
        } else {
            Extent::Ended
        }
    }

    /// The factor of a photon within the disc.
    pub(crate) fn factor(&self, photon: &Photon) -> f64 {
        let disc = self.disc;
        let offset = photon.point - disc.point.surface.point;
        let is_reached = disc.is_same(offset, Vec3::from(photon.normal).into())
            && (!self.walls.may_hide(photon.point) || disc.is_open(offset));
        if is_reached {
            self.factor.dot(disc.place(offset))
        } else {
            0.0
        }
    }
}

impl Walls {
    /// Adds a wall unless it is known or there are too many.
    fn add(&mut self, radius: f64, at: DVec3, normal: DVec3) {
        let is_it = |(known, other): &(DVec3, DVec3)| {
            (at - *known).dot(*other).abs() < 1e-3 * radius && 0.999 < normal.dot(*other)
        };
        if self.count < WALLS && !self.known[..self.count].iter().any(is_it) {
            self.known[self.count] = (at, normal);
            self.count += 1;
        }
    }

    /// Whether a point lies behind any, or may.
    fn may_hide(&self, point: DVec3) -> bool {
        let behind = |(at, normal): &(DVec3, DVec3)| (point - *at).dot(*normal) < 0.0;
        self.count == WALLS || self.known[..self.count].iter().any(behind)
    }
}
