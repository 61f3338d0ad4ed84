//! Emission that does not come from the list of lights, that of objects and the environment, where a path
//! or shadow ray meets it. Paths that find it by chance are combined with
//! [next event estimation](super::emitter_samples) by multiple importance sampling, as for lights with a
//! size.
//!
//! Only what a shadow ray meets first counts, so that nothing passes on the way but what a
//! path would pass too.

use glam::DVec3;

use super::Path;
use crate::integrators::vertex::Vertex;
use crate::light::Sky;
use crate::sampling::Densities;
use crate::world::{Nearest, World};
use geometry::{Ray, Side};
use scene::Rgb;

/// The part of an emitter toward which a shadow ray goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Target {
    /// The indices of the object and of the part of its surface.
    pub(crate) part: (u32, u32),
    /// The side of the part that the ray hits.
    pub(crate) side: Side,
}

/// The emission of a surface, as far as it counts where a BSDF sample hits it, and the densities that
/// this depends on; no densities where only the path can find it.
#[inline]
pub(crate) fn emission(
    world: &World,
    path: &Path,
    vertex: &Vertex<'_>,
) -> (Rgb, Option<Densities>) {
    let emission = vertex.material.emission;
    if emission == Rgb::ZERO {
        return (emission, None);
    }
    let densities = densities_at(world, path, vertex);
    let counted = densities.map_or(emission, |densities| densities.weight * emission);
    (counted, densities)
}

/// The densities by which a path that hits an object could have found its emission; `None` where
/// only the path can.
#[inline(never)]
fn densities_at(world: &World, path: &Path, vertex: &Vertex<'_>) -> Option<Densities> {
    let chosen = path.chosen?;
    let nearest = vertex.nearest;
    let by_light = world.emitters.density(
        &world.scene,
        (chosen.point, chosen.normal),
        path.ray.direction,
        (nearest.object, nearest.hit.part),
        vertex.point.surface.point,
    );
    (0.0 < by_light).then(|| Densities::for_path(chosen.density, by_light))
}

/// The emission of an object that arrives, given what its shadow ray hits; `None` if it is hidden.
pub(crate) fn sent_by_object(
    world: &World,
    target: Target,
    ray: &Ray,
    nearest: Option<Nearest>,
) -> Option<Rgb> {
    let nearest = nearest?;
    let is_met = (nearest.object, nearest.hit.part) == target.part;
    let arrives = is_met && world.sphere_lights.nearest(ray, nearest.hit.t).is_none();
    arrives.then(|| emitted(world, ray, nearest, target.side))
}

/// The emission of an object toward the start of a ray that hits it.
fn emitted(world: &World, ray: &Ray, nearest: Nearest, side: Side) -> Rgb {
    let unmapped = || (*ray, DVec3::Z);
    let (material, _) = world.material(nearest, unmapped);
    if material.is_lit(side) {
        material.emission
    } else {
        Rgb::ZERO
    }
}

/// The radiance of the environment that arrives along a shadow ray, given its transmittance; `None`
/// if it is hidden.
pub(crate) fn sent_by_sky(world: &World, ray: &Ray, transmittance: f64) -> Option<Rgb> {
    let sphere_lights = &world.sphere_lights;
    let arrives = transmittance != 0.0 && sphere_lights.nearest(ray, f64::INFINITY).is_none();
    arrives.then(|| world.environment(ray.direction))
}

impl Path {
    /// The densities by which a path that meets nothing could have found the environment; `None` where
    /// only the path can.
    #[inline]
    pub(crate) fn densities_of(&self, sky: &Sky) -> Option<Densities> {
        if sky.is_unsampled() {
            return None;
        }
        let chosen = self.chosen?;
        let by_light = sky.density(self.ray.direction);
        (0.0 < by_light).then(|| Densities::for_path(chosen.density, by_light))
    }
}
