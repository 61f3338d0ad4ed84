//! Rays, alone and side by side.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use std::ops::Deref;

use glam::DVec3;

use super::lanes::{Eight, Lanes, Row, Simd, SimdBase, Vector, WIDTH};

/// A half line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: DVec3,
    /// Where it goes; of unit length, so that distances along it are in world units.
    pub direction: DVec3,
}

impl Ray {
    /// The point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// One ray, or several side by side.
#[derive(Clone, Copy, Debug)]
pub struct Rays<N> {
    /// Where they start.
    pub origin: Vector<N>,
    /// Where they go.
    pub direction: Vector<N>,
}

impl<N: Lanes> Rays<N> {
    /// The points at distances `t`.
    #[inline(always)]
    pub fn at(&self, t: N) -> Vector<N> {
        self.origin + self.direction.scaled(t)
    }
}

impl From<&Ray> for Rays<f64> {
    #[inline(always)]
    fn from(ray: &Ray) -> Self {
        Self {
            origin: ray.origin.into(),
            direction: ray.direction.into(),
        }
    }
}

impl<S: Simd> Rays<Eight<S>> {
    /// The same ray in each lane.
    #[inline(always)]
    pub fn all(simd: S, ray: &Ray) -> Self {
        let like = Eight::splat(simd, 0.0);
        Self {
            origin: Vector::all(like, ray.origin),
            direction: Vector::all(like, ray.direction),
        }
    }

    /// Up to eight rays; the first stands in the lanes that are left. There is at least one.
    #[inline(always)]
    pub fn gather(simd: S, rays: &[Ray]) -> Self {
        let mut packet = Packet::new(&rays[0], 0.0);
        for (lane, ray) in rays.iter().enumerate().take(WIDTH) {
            packet.rays.origin.set(lane, ray.origin);
            packet.rays.direction.set(lane, ray.direction);
        }
        packet.rays.load(simd)
    }

    /// The ray in a lane.
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        Ray {
            origin: self.origin.lane(lane),
            direction: self.direction.lane(lane),
        }
    }
}

/// Up to eight rays as they lie in memory, each with a distance where it ends.
#[derive(Clone, Copy, Debug)]
pub struct Packet {
    /// The rays; the first stands in the lanes that are left.
    pub rays: Rays<Row>,
    /// How far they go.
    pub ends: Row,
    /// A bit for each lane that holds one, the lowest for the first.
    pub lanes: u32,
}

impl Packet {
    /// A packet of one ray.
    pub fn new(ray: &Ray, end: f64) -> Self {
        Self {
            rays: Rays {
                origin: Vector::repeat(ray.origin),
                direction: Vector::repeat(ray.direction),
            },
            ends: Row::all(end),
            lanes: 1,
        }
    }

    /// The ray in a lane.
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        Ray {
            origin: self.rays.origin.get(lane),
            direction: self.rays.direction.get(lane),
        }
    }
}

impl Rays<Row> {
    /// Those, in vectors.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> Rays<Eight<S>> {
        Rays {
            origin: self.origin.load(simd),
            direction: self.direction.load(simd),
        }
    }
}

/// Rays in packets of eight, of which the last may hold fewer.
#[derive(Clone, Debug, Default)]
pub struct Packets {
    packets: Vec<Packet>,
    count: usize,
}

impl Packets {
    /// Takes all rays out.
    pub fn clear(&mut self) {
        self.packets.clear();
        self.count = 0;
    }

    /// How many rays there are.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Adds a ray and how far it goes.
    #[inline]
    pub fn push(&mut self, ray: &Ray, end: f64) {
        let lane = self.count % WIDTH;
        self.count += 1;
        match self.packets.last_mut() {
            Some(packet) if lane != 0 => {
                packet.rays.origin.set(lane, ray.origin);
                packet.rays.direction.set(lane, ray.direction);
                packet.ends.0[lane] = end;
                packet.lanes |= 1 << lane;
            }
            _ => self.packets.push(Packet::new(ray, end)),
        }
    }
}

impl Deref for Packets {
    type Target = [Packet];

    fn deref(&self) -> &[Packet] {
        &self.packets
    }
}
