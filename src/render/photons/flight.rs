//! The ways of photons over mirrors and boundaries.

use super::super::bsdf::Bsdf;
use super::super::optics::transmitted;
use super::super::photon_map::Photon;
use super::super::sampler::{Sampler, Use};
use super::super::world::World;
use super::emission::Emitted;

/// Follows a photon over mirrors and boundaries and keeps it where it arrives at surfaces that
/// scatter.
pub(super) fn follow(
    world: &World,
    emitted: Emitted,
    depth: u32,
    sampler: Sampler,
    arrived: &mut Vec<Photon>,
) {
    let Emitted {
        mut ray,
        mut power,
        is_seen,
    } = emitted;
    let mut kept = 0;
    for bounce in 0..=depth {
        let Some(nearest) = world.nearest(&ray, f64::INFINITY) else {
            return;
        };
        let distance = nearest.hit.t;
        if world.sphere_lights.nearest(&ray, distance).is_some() {
            return;
        }
        let mut mapped = None;
        let (point, material) = world.arrive(&ray, nearest, &mut mapped);
        let bsdf = Bsdf::at(&point, material, world.gloss);
        if 0 < bounce && material.is_lit(point.side) && bsdf.scatters() {
            kept += 1;
            let [.., chance] = sampler.four(bounce, Use::Spread);
            // Of the photons kept on one way, of which mirrors make many, the nth with a chance
            // of 1/n, which bounds the memory.
            if chance * f64::from(kept) < 1.0 {
                arrived.push(Photon {
                    point: point.surface.point,
                    toward: point.view.as_vec3().to_array(),
                    normal: point.side.turn(point.surface.normal).as_vec3().to_array(),
                    power: (f64::from(kept) * power).as_vec3().to_array(),
                    bounces: (bounce + u32::from(is_seen)) as u16,
                });
            }
        }
        let Some(next) = bsdf.deflect(&point, sampler, bounce) else {
            return;
        };
        power *= next.weight * transmitted(next.absorption, distance);
        if !power.is_finite() {
            return;
        }
        ray = next.ray;
    }
}
