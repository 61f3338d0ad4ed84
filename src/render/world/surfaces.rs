//! The surface points hit by packets of eight rays.

use std::borrow::Cow;

use glam::DVec3;

use super::World;
use super::intersect::{Nearest, NearestHits};
use crate::material::Point;
use geometry::lanes::{Eight, Lanes, Row, Simd, Vector, WIDTH, bits, dispatch, each_bit, mask};
use geometry::{Packet, Rays, Shape, Side, Solid, Surface, Surfaces, sphere_surfaces};
use scene::Material;

/// Up to eight surface points, in memory layout; lanes of rays that miss are undefined.
#[derive(Clone, Copy, Debug)]
pub(crate) struct HitPoints {
    pub(crate) surface: Surfaces<Row>,
    /// Shading normals, flipped on back faces.
    pub(crate) normal: Vector<Row>,
    /// A bit for each ray that hit a front face.
    pub(crate) front: u32,
    /// A mask of the rays that hit, lowest bit first.
    hits: u32,
}

impl HitPoints {
    /// The points of a packet whose rays all miss.
    const NONE: Self = Self {
        surface: Surfaces {
            point: Vector::repeat(DVec3::ZERO),
            normal: Vector::repeat(DVec3::ZERO),
            scale: Row::all(0.0),
        },
        normal: Vector::repeat(DVec3::ZERO),
        front: 0,
        hits: 0,
    };

    /// Whether all rays of the packet miss.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.hits == 0
    }

    /// The side hit by the ray in a lane.
    pub(crate) fn side(&self, lane: usize) -> Side {
        if self.front >> lane & 1 == 1 {
            Side::Front
        } else {
            Side::Back
        }
    }

    /// Returns the material of a hit in a lane of a packet, and turns the shading normal if it has
    /// bumps.
    #[inline]
    pub(crate) fn material<'w>(
        &mut self,
        world: &'w World,
        nearest: Nearest,
        (packet, lane): (&Packet, usize),
    ) -> Cow<'w, Material> {
        let side = self.side(lane);
        let coming = || (packet.ray(lane), side.turn(self.normal.get(lane)));
        let (material, bumped) = world.material(nearest, coming);
        if let Some(normal) = bumped {
            self.normal.set(lane, side.turn(normal));
        }
        material
    }

    /// Returns the point in a lane of a packet.
    #[inline(always)]
    pub(crate) fn point(&self, packet: &Packet, lane: usize) -> Point {
        Point {
            surface: Surface {
                point: self.surface.point.get(lane),
                normal: self.surface.normal.get(lane),
                shading: self.normal.get(lane),
                scale: self.surface.scale.0[lane],
            },
            normal: self.normal.get(lane),
            side: self.side(lane),
            view: -packet.rays.direction.get(lane),
        }
    }
}

impl World {
    /// Computes the surface points of all rays, packet by packet; `nearest` holds their hits.
    pub(crate) fn hit_points_each(
        &self,
        packets: &[Packet],
        nearest: &[NearestHits],
        hit_points: &mut Vec<HitPoints>,
    ) {
        hit_points.clear();
        dispatch!(self.level, simd => {
            for (packet, nearest) in packets.iter().zip(nearest) {
                hit_points.push(self.hit_points_together(simd, packet, nearest));
            }
        });
    }

    #[inline(always)]
    fn hit_points_together<S: Simd>(
        &self,
        simd: S,
        packet: &Packet,
        nearest: &NearestHits,
    ) -> HitPoints {
        let hits = &nearest.hits;
        if hits.lanes == 0 {
            return HitPoints::NONE;
        }
        let rays = packet.rays.load(simd);
        let zero = Vector::all(rays.origin.x, DVec3::ZERO);
        let mut surface = Surfaces {
            point: zero,
            normal: zero,
            scale: zero.x,
        };
        let mut shading = zero;
        let mut rest = hits.lanes;
        while rest != 0 {
            let first = rest.trailing_zeros() as usize % WIDTH;
            let Some(met) = nearest.get(first) else { break };
            let shape = &self.scene.objects[met.object as usize].shape;
            let found = if let Shape::Solid(Solid::Sphere(_)) = shape {
                let (lanes, found) = self.of_spheres(&rays, nearest);
                Some((lanes, found.into()))
            } else {
                let lanes = nearest.lanes_of(simd, met.object) & rest;
                let found = shape.surfaces(&rays, &hits.within(lanes));
                found.map(|found| (lanes, found))
            };
            if let Some((lanes, found)) = found {
                let chosen = mask(simd, lanes);
                surface = Surfaces::select(chosen, found.surface, surface);
                shading = Vector::select(chosen, found.shading, shading);
                rest &= !lanes;
            } else {
                let found = shape.surface(&packet.ray(first), met.hit);
                surface.point.put(first, found.point);
                surface.normal.put(first, found.normal);
                surface.scale[first] = found.scale;
                shading.put(first, found.shading);
                rest &= rest - 1;
            }
        }
        // The visible side depends on the geometric normal, not on the shading normal.
        let front = rays.direction.dot(surface.normal).below(zero.x);
        HitPoints {
            surface: surface.store(),
            normal: Vector::select(front, shading, -shading).store(),
            front: bits::<S>(front),
            hits: hits.lanes,
        }
    }

    /// Computes the surface points of all spheres hit, and their lanes.
    #[inline(always)]
    fn of_spheres<S: Simd>(
        &self,
        rays: &Rays<Eight<S>>,
        nearest: &NearestHits,
    ) -> (u32, Surfaces<Eight<S>>) {
        let simd = rays.origin.x.simd;
        let mut centre = Vector::repeat(DVec3::ZERO);
        let mut radius = Row::all(1.0);
        let mut lanes = 0;
        for lane in each_bit(nearest.hits.lanes) {
            let lane = lane % WIDTH;
            if let Some(Nearest { object, .. }) = nearest.get(lane)
                && let Shape::Solid(Solid::Sphere(sphere)) =
                    &self.scene.objects[object as usize].shape
            {
                centre.set(lane, sphere.centre);
                radius.0[lane] = sphere.radius;
                lanes |= 1 << lane;
            }
        }
        let (centre, radius) = (centre.load(simd), radius.load(simd));
        let found = sphere_surfaces(centre, radius, rays, nearest.hits.distances(simd));
        (lanes, found)
    }
}
