//! Next event estimation of what emits light but is no light: emission of objects and the
//! environment. Combined with BSDF sampling by multiple importance sampling, as lights with a size are.
//!
//! Only what a shadow ray meets first counts, so that nothing passes on the way but what a
//! path would pass too.

use glam::DVec3;

use super::Path;
use crate::integrators::probe::{Probe, RAY_BUDGET};
use crate::integrators::vertex::Vertex;
use crate::light::{Picked, Sky};
use crate::sampling::{Densities, Sampler, Use, share};
use crate::world::{Nearest, Occlusion};
use geometry::Ray;
use geometry::Side;
use scene::Rgb;

/// The light of an emitter sampled at a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct EmitterSample {
    /// Index of the object sampled; `None` for the environment.
    pub(crate) object: Option<u32>,
    /// The unit vector toward the chosen point.
    pub(crate) toward: DVec3,
    /// The distance to it, or to what hides an object; else infinite.
    pub(crate) distance: f64,
    /// Emitted radiance; `None` if it is hidden.
    pub(crate) emitted: Option<Rgb>,
    /// The fraction that the surface reflects, the cosine of incidence included.
    pub(crate) reflected: Rgb,
    pub(crate) densities: Densities,
    /// What it adds to the radiance of the surface.
    pub(crate) radiance: Rgb,
}

/// An emitter sampled at a surface, before its shadow ray is traced.
#[derive(Clone, Copy, Debug)]
struct Asking {
    /// The answer if it is hidden.
    asked: EmitterSample,
    /// The shadow ray; `None` if no light could arrive along it.
    ray: Option<Ray>,
    /// Where the ray ends.
    reach: f64,
    /// What the ray is to hit; `None` for the environment.
    target: Option<Target>,
}

/// The part of an emitter toward which a shadow ray goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Target {
    /// The indices of the object and of the part of its surface.
    pub(crate) part: (u32, u32),
    /// Whether the ray hits the front of the part.
    pub(crate) is_front: bool,
}

impl Asking {
    /// A direction toward an infinitely distant emitter.
    fn new(vertex: &Vertex<'_>, toward: DVec3, reflected: Rgb, densities: Densities) -> Self {
        let is_dark = reflected == Rgb::ZERO || densities.by_light == 0.0;
        Self {
            asked: EmitterSample {
                object: None,
                toward,
                distance: f64::INFINITY,
                emitted: None,
                reflected,
                densities,
                radiance: Rgb::ZERO,
            },
            ray: (!is_dark).then(|| vertex.point.leave(toward)),
            reach: f64::INFINITY,
            target: None,
        }
    }
}

impl EmitterSample {
    /// Adds the emission that arrives.
    fn arrives(&mut self, emitted: Rgb) {
        let Densities {
            by_light, by_path, ..
        } = self.densities;
        self.emitted = Some(emitted);
        self.radiance = self.reflected * emitted * share(by_light, by_path);
    }
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Whether objects that emit light, or the environment, are sampled at a surface. Not at the last
    /// bounce, since emission counts as the bounce that reaches it.
    #[inline]
    pub(crate) fn asks(&self, vertex: &Vertex<'_>, bounce: u32) -> bool {
        let goes_on = bounce < self.depth && bounce + 1 < RAY_BUDGET;
        self.world.has_emitters
            && goes_on
            && self.gather.glow(bounce + 1)
            && 0.0 < vertex.bsdf.lobes_chance
    }

    /// Sums the light of objects that emit light and of the environment at a surface that is lit, as
    /// far as it is sampled, and reports its parts.
    pub(crate) fn ask(
        &mut self,
        vertex: &Vertex<'_>,
        bounce: u32,
        sampler: Sampler,
        mut report: impl FnMut(EmitterSample),
    ) -> Rgb {
        let mut sum = Rgb::ZERO;
        let world = self.world;
        let of_object = (!world.emitters.is_empty())
            .then(|| {
                let numbers = sampler.four(bounce, Use::Emitter);
                let picked = world.emitters.pick(vertex.point_and_normal(), numbers)?;
                self.ask_object(vertex, bounce, picked, numbers)
            })
            .flatten();
        let of_object = of_object.map(|asking| {
            let Some(ray) = self.counted(asking.ray) else {
                return asking.asked;
            };
            let nearest = world.nearest(&ray, asking.reach);
            let mut asked = asking.asked;
            if let Some(nearest) = nearest {
                asked.distance = nearest.hit.t;
            }
            if let Some(target) = asking.target
                && let Some(emitted) = self.of_object(target, &ray, nearest)
            {
                asked.arrives(emitted);
            }
            asked
        });
        let of_sky = (!world.sky.is_unsampled())
            .then(|| self.ask_sky(vertex, bounce, sampler.four(bounce, Use::Sky)))
            .flatten();
        let of_sky = of_sky.map(|asking| {
            let Some(ray) = self.counted(asking.ray) else {
                return asking.asked;
            };
            let (reach, occlusion) = (asking.reach, Occlusion::Complete);
            let transmittance = world.transmittance(&ray, reach, occlusion, &mut self.crossed);
            let mut asked = asking.asked;
            if let Some(emitted) = self.of_sky(&ray, transmittance) {
                asked.arrives(emitted);
            }
            asked
        });
        for asked in of_object.into_iter().chain(of_sky) {
            sum += asked.radiance;
            report(asked);
        }
        sum
    }

    /// Counts a shadow ray.
    fn counted(&mut self, ray: Option<Ray>) -> Option<Ray> {
        if ray.is_some() {
            self.counts.rays += 1;
            self.counts.shadow_rays += 1;
        }
        ray
    }

    /// Samples the emission of an object that was picked, by numbers in 0..1.
    fn ask_object(
        &self,
        vertex: &Vertex<'_>,
        bounce: u32,
        picked: Picked,
        [u, v, ..]: [f64; 4],
    ) -> Option<Asking> {
        let Vertex { point, bsdf, .. } = vertex;
        let world = self.world;
        let from = point.surface.point;
        let choice = world.emitters.choose(&world.scene, from, picked, [u, v])?;
        let scattered = bsdf.lobes.scatter(point, choice.toward);
        let by_path = self.density_of(bsdf, scattered, bounce);
        let densities = Densities::for_light(choice.density, by_path);
        let mut asking = Asking::new(vertex, choice.toward, scattered.value, densities);
        asking.reach = choice.reach;
        asking.asked.object = Some(choice.object);
        asking.target = Some(Target {
            part: (choice.object, choice.part),
            is_front: choice.is_front,
        });
        Some(asking)
    }

    /// The emission of an object that arrives, given what its shadow ray hits; `None` if it is hidden.
    pub(crate) fn of_object(
        &self,
        target: Target,
        ray: &Ray,
        nearest: Option<Nearest>,
    ) -> Option<Rgb> {
        let nearest = nearest?;
        let is_met = (nearest.object, nearest.hit.part) == target.part;
        let sphere_lights = &self.world.sphere_lights;
        let arrives = is_met && sphere_lights.nearest(ray, nearest.hit.t).is_none();
        arrives.then(|| self.emitted(ray, nearest, target.is_front))
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

    /// Samples the environment by numbers in 0..1.
    fn ask_sky(&self, vertex: &Vertex<'_>, bounce: u32, numbers: [f64; 4]) -> Option<Asking> {
        let Vertex { point, bsdf, .. } = vertex;
        let world = self.world;
        let [u, v, ..] = numbers;
        let toward = world.sky.choose([u, v])?;
        let scattered = bsdf.lobes.scatter(point, toward);
        let by_path = self.density_of(bsdf, scattered, bounce);
        let densities = Densities::for_light(world.sky.density(toward), by_path);
        Some(Asking::new(vertex, toward, scattered.value, densities))
    }

    /// The radiance of the environment that arrives along a shadow ray, given its transmittance; `None`
    /// if it is hidden.
    pub(crate) fn of_sky(&self, ray: &Ray, transmittance: f64) -> Option<Rgb> {
        let sphere_lights = &self.world.sphere_lights;
        let arrives = transmittance != 0.0 && sphere_lights.nearest(ray, f64::INFINITY).is_none();
        arrives.then(|| self.world.environment(ray.direction))
    }

    /// The densities by which a path that hits an object could have found its emission; `None` where
    /// only the path can.
    #[inline(never)]
    pub(crate) fn densities_at(&self, path: &Path, vertex: &Vertex<'_>) -> Option<Densities> {
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
    pub(crate) fn densities_of(&self, sky: &Sky) -> Option<Densities> {
        if sky.is_unsampled() {
            return None;
        }
        let chosen = self.chosen?;
        let by_light = sky.density(self.ray.direction);
        (0.0 < by_light).then(|| Densities::for_path(chosen.density, by_light))
    }
}
