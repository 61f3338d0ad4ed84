//! Next event estimation of what emits light but is no light: emission of objects and the
//! environment. Combined with BSDF sampling by multiple importance sampling, as lights with a size are.
//!
//! Only what a shadow ray meets first counts, so that nothing passes on the way but what a
//! path would pass too.

use glam::DVec3;

use super::heuristic::Densities;
use super::intersect::Nearest;
use super::path::{Path, Vertex};
use super::probe::{Probe, RAY_BUDGET};
use super::sampler::{Sampler, Use};
use super::shading::Side;
use super::sky::Sky;
use crate::geometry::Ray;
use crate::scene::Rgb;

/// The light of an emitter sampled at a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Asked {
    /// Index of the object sampled; `None` for the environment.
    pub(super) object: Option<u32>,
    /// The unit vector toward the chosen point.
    pub(super) toward: DVec3,
    /// The distance to it, or to what hides an object; else infinite.
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
    /// Whether objects that emit light, or the environment, are sampled at a surface. Not at the last
    /// bounce, since emission counts as the bounce that reaches it.
    #[inline]
    pub(super) fn asks(&self, vertex: &Vertex<'_>, bounce: u32) -> bool {
        let goes_on = bounce < self.depth && bounce + 1 < RAY_BUDGET;
        self.world.has_emitters
            && goes_on
            && self.gather.glow(bounce + 1)
            && 0.0 < vertex.bsdf.lobes_chance
    }

    /// Sums the light of objects that emit light and of the environment at a surface that is lit, as
    /// far as it is sampled, and reports its parts.
    #[inline(never)]
    pub(super) fn ask(
        &mut self,
        vertex: &Vertex<'_>,
        bounce: u32,
        sampler: Sampler,
        mut report: impl FnMut(Asked),
    ) -> Rgb {
        let mut sum = Rgb::ZERO;
        let world = self.world;
        let of_object = (!world.emitters.is_empty())
            .then(|| self.of_object(vertex, bounce, sampler))
            .flatten();
        let of_sky = (!world.sky.is_unsampled())
            .then(|| self.of_sky(vertex, bounce, sampler))
            .flatten();
        for asked in of_object.into_iter().chain(of_sky) {
            sum += asked.radiance;
            report(asked);
        }
        sum
    }

    /// Samples the emission of an object.
    fn of_object(&mut self, vertex: &Vertex<'_>, bounce: u32, sampler: Sampler) -> Option<Asked> {
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
            object: Some(choice.object),
            toward,
            distance: f64::INFINITY,
            emitted: None,
            reflected: scattered.value,
            densities: Densities::for_light(
                choice.density,
                self.density_of(bsdf, scattered, bounce),
            ),
            radiance: Rgb::ZERO,
        };
        if scattered.value == Rgb::ZERO || choice.density == 0.0 {
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
        let emitted = self.emitted(&ray, nearest, choice.is_front);
        asked.emitted = Some(emitted);
        let weight = asked.densities.weight / choice.density;
        asked.radiance = scattered.value * emitted * weight;
        Some(asked)
    }

    /// The emission of an object toward the start of a ray that hits it.
    fn emitted(&self, ray: &Ray, nearest: Nearest, is_front: bool) -> Rgb {
        let side = if is_front { Side::Front } else { Side::Back };
        let unmapped = || (*ray, DVec3::Z);
        let (material, _) = self.world.material(nearest, unmapped);
        if material.is_lit(side) {
            material.emission
        } else {
            Rgb::ZERO
        }
    }

    /// Samples the environment.
    fn of_sky(&mut self, vertex: &Vertex<'_>, bounce: u32, sampler: Sampler) -> Option<Asked> {
        let Vertex { point, bsdf, .. } = vertex;
        let world = self.world;
        let [u, v, ..] = sampler.four(bounce, Use::Sky);
        let toward = world.sky.choose([u, v])?;
        let scattered = bsdf.lobes.scatter(point, toward);
        let by_path = self.density_of(bsdf, scattered, bounce);
        let by_light = world.sky.density(toward);
        let mut asked = Asked {
            object: None,
            toward,
            distance: f64::INFINITY,
            emitted: None,
            reflected: scattered.value,
            densities: Densities::for_light(by_light, by_path),
            radiance: Rgb::ZERO,
        };
        if scattered.value == Rgb::ZERO || by_light == 0.0 {
            return Some(asked);
        }
        self.counts.rays += 1;
        self.counts.shadow_rays += 1;
        let ray = point.leave(toward);
        let is_hidden =
            world.is_blocked(&ray) || world.sphere_lights.nearest(&ray, f64::INFINITY).is_some();
        if is_hidden {
            return Some(asked);
        }
        let emitted = world.environment(toward);
        asked.emitted = Some(emitted);
        asked.radiance = scattered.value * emitted * (asked.densities.weight / by_light);
        Some(asked)
    }

    /// The densities by which a path that hits an object could have found its emission; `None` where
    /// only the path can.
    #[inline(never)]
    pub(super) fn densities_at(&self, path: &Path, vertex: &Vertex<'_>) -> Option<Densities> {
        let chosen = path.chosen?;
        let world = self.world;
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
}

impl Path {
    /// The densities by which a path that meets nothing could have found the environment; `None` where
    /// only the path can.
    #[inline]
    pub(super) fn densities_of(&self, sky: &Sky) -> Option<Densities> {
        if sky.is_unsampled() {
            return None;
        }
        let chosen = self.chosen?;
        let by_light = sky.density(self.ray.direction);
        (0.0 < by_light).then(|| Densities::for_path(chosen.density, by_light))
    }
}
