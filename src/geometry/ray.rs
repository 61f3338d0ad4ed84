//! Single rays and packets of rays.

use std::ops::Deref;

use glam::DVec3;

use super::lanes::{Eight, Lanes, Row, Simd, SimdBase, Vector, WIDTH};

/// A half-line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// The start.
    pub origin: DVec3,
    /// The direction, of unit length, so that distances along it are in world units.
    pub direction: DVec3,
}

impl Ray {
    /// Returns the point at distance `t`.
    pub fn at(&self, t: f64) -> DVec3 {
        self.origin + t * self.direction
    }
}

/// One ray, or one in each lane.
#[derive(Clone, Copy, Debug)]
pub struct Rays<N> {
    /// The starts.
    pub origin: Vector<N>,
    /// The directions.
    pub direction: Vector<N>,
}

impl<N: Lanes> Rays<N> {
    /// Returns the points at distances `t`.
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
    /// Stores the rays in memory.
    #[inline(always)]
    pub fn store(self) -> Rays<Row> {
        Rays {
            origin: self.origin.store(),
            direction: self.direction.store(),
        }
    }

    /// Broadcasts a ray to all lanes.
    #[inline(always)]
    pub fn all(simd: S, ray: &Ray) -> Self {
        let like = Eight::splat(simd, 0.0);
        Self {
            origin: Vector::all(like, ray.origin),
            direction: Vector::all(like, ray.direction),
        }
    }

    /// Gathers 1 to 8 rays; unused lanes repeat the first.
    #[inline(always)]
    pub fn gather(simd: S, rays: &[Ray]) -> Self {
        let mut packet = Packet::new(&rays[0], 0.0);
        for (lane, ray) in rays.iter().enumerate().take(WIDTH) {
            packet.rays.origin.set(lane, ray.origin);
            packet.rays.direction.set(lane, ray.direction);
        }
        packet.rays.load(simd)
    }

    /// Whether all directions are in one octant.
    #[inline(always)]
    pub fn share_octant(&self) -> bool {
        let Vector { x, y, z } = self.direction;
        same_sign(x) && same_sign(y) && same_sign(z)
    }

    /// Returns the ray in a lane.
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        Ray {
            origin: self.origin.lane(lane),
            direction: self.direction.lane(lane),
        }
    }
}

/// Whether no number is below 0, or none above.
#[inline(always)]
fn same_sign<S: Simd>(numbers: Eight<S>) -> bool {
    let zero = numbers.all(0.0);
    !Eight::any(numbers.below(zero)) || !Eight::any(zero.below(numbers))
}

/// 1 to 8 rays in memory, each with a maximum distance.
#[derive(Clone, Copy, Debug)]
pub struct Packet {
    /// The rays; unused lanes repeat the first.
    pub rays: Rays<Row>,
    /// Their maximum distances.
    pub ends: Row,
    /// A mask of the used lanes, lowest bit first.
    pub lanes: u32,
}

impl Packet {
    /// Creates a packet of one ray.
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

    /// Returns the ray in a lane.
    #[inline(always)]
    pub fn ray(&self, lane: usize) -> Ray {
        self.rays.get(lane)
    }
}

impl Rays<Row> {
    /// Returns the ray in a lane.
    #[inline(always)]
    pub fn get(&self, lane: usize) -> Ray {
        Ray {
            origin: self.origin.get(lane),
            direction: self.direction.get(lane),
        }
    }

    /// Loads the rays into SIMD vectors.
    #[inline(always)]
    pub fn load<S: Simd>(&self, simd: S) -> Rays<Eight<S>> {
        Rays {
            origin: self.origin.load(simd),
            direction: self.direction.load(simd),
        }
    }
}

/// Rays in packets of eight; the last may have fewer.
#[derive(Clone, Debug, Default)]
pub struct Packets {
    packets: Vec<Packet>,
    count: usize,
}

impl Packets {
    /// Removes all rays.
    pub fn clear(&mut self) {
        self.packets.clear();
        self.count = 0;
    }

    /// Adds a ray and its maximum distance.
    #[inline(always)]
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
