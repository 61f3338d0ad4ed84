//! Next event estimation of what emits light but is no light: emission of objects. Combined with
//! BSDF sampling by multiple importance sampling, as lights with a size are.
//!
//! What a ray asked for meets first is all that counts, so that nothing passes on the way but what a
//! path would pass too.

use glam::DVec3;

use super::emitters::Emitters;
use super::heuristic::Densities;
use super::path::{Path, Vertex};
use super::probe::{Probe, RAY_BUDGET};
use super::sampler::{Sampler, Use};
use crate::scene::Rgb;

/// The light of an emitter that was asked for at a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Asked {
    /// Index of the object that was asked for.
    pub(super) object: u32,
    /// The unit vector toward the chosen point.
    pub(super) toward: DVec3,
    /// The distance to it, or to what hides it; infinite where nothing is met.
    pub(super) distance: f64,
    /// Emitted radiance; `None` if it is hidden.
    pub(super) emitted: Option<Rgb>,
    /// The fraction that the surface reflects, the cosine of incidence included.
    pub(super) reflected: Rgb,
    pub(super) densities: Densities,
    /// What it adds to the radiance of the surface.
    pub(super) radiance: Rgb,
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// The light of objects that emit light at a surface that is lit; `None` without any, and at the
    /// last bounce, since emission counts as the bounce that reaches it.
    #[inline]
    pub(super) fn of_emitters(
        &mut self,
        vertex: &Vertex<'_>,
        bounce: u32,
        sampler: Sampler,
    ) -> Option<Asked> {
        let goes_on = bounce < self.depth && bounce + 1 < RAY_BUDGET;
        if self.world.emitters.is_empty() || !goes_on || !self.gather.glow(bounce + 1) {
            return None;
        }
        self.of_emitter(vertex, bounce, sampler)
    }

    /// Asks for the emission of an object.
    #[inline(never)]
    fn of_emitter(&mut self, vertex: &Vertex<'_>, bounce: u32, sampler: Sampler) -> Option<Asked> {
        let Vertex { point, bsdf, .. } = vertex;
        let world = self.world;
        let (scene, from) = (&*world.scene, point.surface.point);
        let [number, u, v, _] = sampler.four(bounce, Use::Emitter);
        let choice = world
            .emitters
            .choose(scene, (from, point.normal), [number, u, v])?;
        let toward = choice.toward;
        let scattered = bsdf.lobes.scatter(point, toward);
        let mut asked = Asked {
            object: choice.object,
            toward,
            distance: f64::INFINITY,
            emitted: None,
            reflected: scattered.value,
            densities: Densities::for_light(0.0, self.density_of(bsdf, scattered, bounce)),
            radiance: Rgb::ZERO,
        };
        if scattered.value == Rgb::ZERO {
            return Some(asked);
        }
        self.counts.rays += 1;
        self.counts.shadow_rays += 1;
        let ray = point.leave(toward);
        let Some(nearest) = world.nearest(&ray, choice.reach) else {
            return Some(asked);
        };
        asked.distance = nearest.hit.t;
        let is_met = (nearest.object, nearest.hit.part) == (choice.object, choice.part);
        if !is_met || world.sphere_lights.nearest(&ray, asked.distance).is_some() {
            return Some(asked);
        }
        let mut mapped = None;
        let (met, material) = world.arrive(&ray, nearest, &mut mapped);
        let by_light = Emitters::density_of(scene, &choice, from, toward, &met.surface);
        asked.densities = Densities::for_light(by_light, asked.densities.by_path);
        let emitted = if material.is_lit(met.side) {
            material.emission
        } else {
            Rgb::ZERO
        };
        asked.emitted = Some(emitted);
        if 0.0 < by_light {
            asked.radiance = scattered.value * emitted * (asked.densities.weight / by_light);
        }
        Some(asked)
    }

    /// The densities by which a path that hits an object could have found its emission; `None` where
    /// only the path can.
    pub(super) fn densities_at(&self, path: &Path, vertex: &Vertex<'_>) -> Option<Densities> {
        let chosen = path.chosen?;
        let world = self.world;
        let nearest = vertex.nearest;
        let by_light = world.emitters.density(
            &world.scene,
            (chosen.point, chosen.normal),
            path.ray.direction,
            (nearest.object, nearest.hit.part),
            &vertex.point.surface,
        );
        (0.0 < by_light).then(|| Densities::for_path(chosen.density, by_light))
    }
}
