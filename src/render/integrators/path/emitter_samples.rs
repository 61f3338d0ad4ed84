//! Objects that emit light and the environment, sampled at the surfaces that paths meet at a bounce.

use glam::DVec3;

use super::emission::{Target, sent_by_object, sent_by_sky};
use super::shadow_rays::{ShadowRays, VertexLight};
use super::vertices::{Aimed, Vertices};
use crate::integrators::probe::{Probe, RAY_BUDGET, SampleResult};
use crate::integrators::vertex::Vertex;
use crate::light::Choices;
use crate::sampling::{Draws, Fours, Purpose};
use crate::world::{NearestHits, Occlusion, World};
use geometry::Ray;
use geometry::lanes::{Row, Vector, WIDTH, dispatch, each_bit, lanes_of};
use scene::Rgb;

/// What emitters send to the surfaces of a bounce.
#[derive(Debug, Default)]
pub(crate) struct EmitterSamples {
    shadows: ShadowRays,
    /// The shadow rays, with what they are to hit.
    rays: Vec<EmitterRay>,
    nearest: Vec<NearestHits>,
    /// The last simple object that occluded the environment.
    blocker: Option<u32>,
}

/// A shadow ray to an emitter.
#[derive(Clone, Copy, Debug)]
struct EmitterRay {
    /// Index of the surface.
    at: usize,
    ray: Ray,
    /// What it is to hit; `None` for the environment.
    target: Option<Target>,
    /// See [`Aimed`].
    reflected: Rgb,
    weight_over_density: f64,
}

/// What arrives along the shadow ray of an emitter.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EmitterArrival {
    /// Index of the surface.
    at: usize,
    /// The distance at which the ray ends.
    pub(crate) distance: f64,
    /// Emitted radiance; `None` if it is hidden.
    pub(crate) emitted: Option<Rgb>,
    /// The light that the surface reflects of it.
    pub(crate) reflected: Rgb,
}

/// Adds the light of objects that emit light, and of the environment, as far as it is sampled.
pub(super) fn add_emitters(
    probe: &mut Probe<'_>,
    vertices: &[Vertices<'_, '_>],
    sums: &mut [VertexLight],
    (draws, samples): (&mut Draws, &mut EmitterSamples),
    seen: &mut [SampleResult],
) {
    let of_batch = |(sums, vertices): (&[VertexLight], &Vertices<'_, '_>)| {
        let all = sums.iter().zip(vertices.all());
        let is_sampled = |(sum, vertex): (&VertexLight, _)| {
            sum.is_lit && samples_emitters(probe, vertex, draws.node)
        };
        lanes_of(all.map(is_sampled))
    };
    let lanes: Vec<_> = sums.chunks(WIDTH).zip(vertices).map(of_batch).collect();
    if lanes.iter().all(|&lanes| lanes == 0) {
        return;
    }
    add_emitting_objects(probe, (vertices, &lanes), sums, (draws, samples), seen);
    add_sky(probe, (vertices, &lanes), sums, (draws, samples), seen);
}

/// Whether objects that emit light, or the environment, are sampled at a surface that is lit. Not at
/// the last bounce, since emission counts as the bounce that reaches it.
#[inline]
pub(crate) fn samples_emitters(probe: &Probe<'_>, vertex: &Vertex<'_>, bounce: u32) -> bool {
    let goes_on = bounce < probe.depth && bounce + 1 < RAY_BUDGET;
    probe.world.has_emitters
        && goes_on
        && probe.component.glow(bounce + 1)
        && 0.0 < vertex.bsdf.lobes_chance
}

/// Adds the light of objects that emit light, in lanes.
pub(crate) fn add_emitting_objects(
    probe: &mut Probe<'_>,
    (vertices, lanes): (&[Vertices<'_, '_>], &[u32]),
    sums: &mut [VertexLight],
    (draws, samples): (&mut Draws, &mut EmitterSamples),
    seen: &mut [SampleResult],
) {
    let world = probe.world;
    if world.emitters.is_empty() {
        return;
    }
    let numbers = draws.four(Purpose::Emitter, world.level);
    samples.aim_at_objects(world, (vertices, numbers), lanes);
    samples.count(probe, sums, seen);
    world.nearest_each(&samples.shadows.rays, &mut samples.nearest);
    for arrival in samples.of_objects(world) {
        sums[arrival.at].of_emitters += arrival.reflected;
    }
}

/// Adds the light of the environment, in lanes.
pub(crate) fn add_sky(
    probe: &mut Probe<'_>,
    (vertices, lanes): (&[Vertices<'_, '_>], &[u32]),
    sums: &mut [VertexLight],
    (draws, samples): (&mut Draws, &mut EmitterSamples),
    seen: &mut [SampleResult],
) {
    let world = probe.world;
    if world.sky.is_unsampled() {
        return;
    }
    let numbers = draws.four(Purpose::Sky, world.level);
    samples.aim_at_sky(world, (vertices, numbers), lanes);
    samples.count(probe, sums, seen);
    let blocker = &mut samples.blocker;
    samples.shadows.trace(probe, blocker, Occlusion::Complete);
    for arrival in samples.of_sky(world) {
        sums[arrival.at].of_emitters += arrival.reflected;
    }
}

/// Chooses points on objects that emit light for the surfaces in lanes.
pub(crate) fn aim_at_object(
    world: &World,
    vertices: &Vertices<'_, '_>,
    numbers: &Fours,
    lanes: u32,
) -> (Choices, Aimed) {
    dispatch!(world.level, simd => {
        let (emitters, at) = (&world.emitters, vertices.places());
        let choices = emitters.choose_together(simd, &world.scene, at, numbers, lanes);
        let Choices { lanes, toward, density, .. } = &choices;
        let aimed = vertices.aim(simd, *lanes, toward, density);
        (choices, aimed)
    })
}

/// Chooses directions to the environment for the surfaces in lanes; returns the lanes that have one.
pub(crate) fn aim_at_sky(
    world: &World,
    vertices: &Vertices<'_, '_>,
    numbers: &Fours,
    lanes: u32,
) -> (u32, Aimed) {
    let mut toward = Vector::repeat(DVec3::ZERO);
    let mut density = Row::all(0.0);
    let mut chosen = 0;
    for lane in each_bit(lanes) {
        let [u, v, ..] = numbers.lane(lane);
        if let Some(direction) = world.sky.choose([u, v]) {
            chosen |= 1 << lane;
            toward.set(lane, direction);
            density.0[lane] = world.sky.density(direction);
        }
    }
    let aimed = dispatch!(world.level, simd => {
        vertices.aim(simd, chosen, &toward, &density)
    });
    (chosen, aimed)
}

impl EmitterSamples {
    /// What arrives along the shadow rays to objects that emit light.
    pub(crate) fn of_objects(&self, world: &World) -> impl Iterator<Item = EmitterArrival> {
        let rays = self.rays.iter().enumerate();
        rays.map(|(number, to_emitter)| {
            let nearest = self.nearest[number / WIDTH].get(number % WIDTH);
            let target = to_emitter.target;
            let sent =
                target.and_then(|target| sent_by_object(world, target, &to_emitter.ray, nearest));
            let distance = nearest.map_or(f64::INFINITY, |nearest| nearest.hit.t);
            to_emitter.arrival(distance, sent)
        })
    }

    /// What arrives along the shadow rays to the environment.
    pub(crate) fn of_sky(&self, world: &World) -> impl Iterator<Item = EmitterArrival> {
        let rays = self.rays.iter().zip(&self.shadows.transmittances);
        rays.map(|(to_emitter, &transmittance)| {
            let sent = sent_by_sky(world, &to_emitter.ray, transmittance);
            to_emitter.arrival(f64::INFINITY, sent)
        })
    }

    /// Collects the shadow rays to objects that emit light from the surfaces in lanes.
    fn aim_at_objects(
        &mut self,
        world: &World,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        lanes: &[u32],
    ) {
        self.shadows.rays.clear();
        self.rays.clear();
        let batches = vertices.iter().zip(numbers).zip(lanes);
        for (batch, ((vertices, numbers), &lanes)) in batches.enumerate() {
            let (choices, aimed) = aim_at_object(world, vertices, numbers, lanes);
            for lane in each_bit(aimed.lanes) {
                let target = Target {
                    part: choices.parts[lane],
                    side: choices.side(lane),
                };
                let to_emitter = EmitterRay::new(batch, lane, &aimed, Some(target));
                self.shadows
                    .rays
                    .push(&to_emitter.ray, choices.reach.0[lane]);
                self.rays.push(to_emitter);
            }
        }
    }

    /// Collects the shadow rays to the environment from the surfaces in lanes.
    fn aim_at_sky(
        &mut self,
        world: &World,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        lanes: &[u32],
    ) {
        self.shadows.rays.clear();
        self.rays.clear();
        let batches = vertices.iter().zip(numbers).zip(lanes);
        for (batch, ((vertices, numbers), &lanes)) in batches.enumerate() {
            let (_, aimed) = aim_at_sky(world, vertices, numbers, lanes);
            for lane in each_bit(aimed.lanes) {
                let to_emitter = EmitterRay::new(batch, lane, &aimed, None);
                self.shadows.rays.push(&to_emitter.ray, f64::INFINITY);
                self.rays.push(to_emitter);
            }
        }
    }

    /// Counts the shadow rays.
    fn count(&self, probe: &mut Probe<'_>, sums: &[VertexLight], seen: &mut [SampleResult]) {
        for ray in &self.rays {
            seen[sums[ray.at].path].rays += 1;
        }
        probe.counts.add_shadow_rays(self.rays.len() as u64);
    }
}

impl EmitterRay {
    /// The ray in a lane of a batch of surfaces.
    fn new(batch: usize, lane: usize, aimed: &Aimed, target: Option<Target>) -> Self {
        Self {
            at: batch * WIDTH + lane,
            ray: aimed.rays.get(lane),
            target,
            reflected: aimed.reflected.get(lane),
            weight_over_density: aimed.weight_over_density.0[lane],
        }
    }

    /// What arrives, given what is sent along the ray.
    fn arrival(&self, distance: f64, emitted: Option<Rgb>) -> EmitterArrival {
        let reflected = emitted.map(|emitted| self.reflected * emitted * self.weight_over_density);
        EmitterArrival {
            at: self.at,
            distance,
            emitted,
            reflected: reflected.unwrap_or(Rgb::ZERO),
        }
    }
}
