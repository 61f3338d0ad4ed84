//! The lights of a scene, sampled at the surfaces that paths meet at a bounce.

use super::shadow_rays::{ShadowRays, VertexLight};
use super::vertices::Vertices;
use crate::integrators::direct::{Shadow, sent_back, shadowed};
use crate::integrators::probe::{BounceStage, Probe, SampleResult};
use crate::light::{SphereLight, Spheres, light_sphere, luminous_sphere};
use crate::sampling::{Draws, Fours, Purpose};
use crate::world::{Occlusion, World};
use geometry::Packets;
use geometry::lanes::{Row, WIDTH, dispatch, each_bit, lanes_of};
use scene::{Light, Rgb, Shadows};

/// What lights send to the surfaces of a bounce.
#[derive(Debug, Default)]
pub(crate) struct LightSamples {
    /// The light that each surface samples, with the probability of its choice.
    chosen: Vec<Option<(usize, f64)>>,
    shadows: ShadowRays,
    /// What arrives along the shadow rays.
    shadowed: Vec<LightRay>,
    /// What arrives from lights that cast no shadows.
    unshadowed: Vec<LightRay>,
    /// For each light, the last simple object that occluded it; then for one of many lights.
    blockers: Vec<Option<u32>>,
}

/// Light that arrives at a surface.
#[derive(Clone, Copy, Debug)]
struct LightRay {
    /// Index of the surface.
    at: usize,
    /// Index of the light.
    number: usize,
    /// The light that arrives if nothing is in between, unscaled.
    light: Rgb,
}

/// The lights sampled at a batch of surfaces, in lanes.
struct LightBatch {
    /// The lanes of lights with a radiance, and of others.
    with_radiance: u32,
    without: u32,
    /// The lights' indices, and the probabilities of their choice.
    indices: [usize; WIDTH],
    chances: Row,
    spheres: [Option<SphereLight>; WIDTH],
}

/// Collects what lights send to surfaces if nothing is in between.
struct LightRays<'e> {
    lights: &'e [Light],
    unshadowed: &'e mut Vec<LightRay>,
    shadows: &'e mut Packets,
    shadowed: &'e mut Vec<LightRay>,
}

impl LightBatch {
    /// Collects the lights from their indices and probabilities.
    fn new(lights: &[Light], chosen: &[Option<(usize, f64)>]) -> Self {
        let mut batch = Self {
            with_radiance: 0,
            without: 0,
            indices: [0; WIDTH],
            chances: Row::all(1.0),
            spheres: [None; WIDTH],
        };
        for (lane, &chosen) in chosen.iter().enumerate() {
            let Some((number, chance)) = chosen else {
                continue;
            };
            batch.indices[lane] = number;
            batch.chances.0[lane] = chance;
            batch.spheres[lane] = luminous_sphere(&lights[number]);
            if batch.spheres[lane].is_some() {
                batch.with_radiance |= 1 << lane;
            } else {
                batch.without |= 1 << lane;
            }
        }
        batch
    }
}

impl LightRays<'_> {
    /// Adds light that arrives at a surface if nothing is in between, given the indices of the surface and
    /// of the light.
    fn add(&mut self, at: usize, number: usize, light: Rgb, shadow: &Shadow<f64>) {
        let ray = LightRay { at, number, light };
        if self.lights[number].shadows == Shadows::Off {
            self.unshadowed.push(ray);
        } else {
            self.shadows.push(&shadow.ray(), shadow.ends);
            self.shadowed.push(ray);
        }
    }
}

/// Adds the light of all lights, in file order; of many lights, that of one at each surface.
pub(super) fn add_lights(
    probe: &mut Probe<'_>,
    vertices: &[Vertices<'_, '_>],
    sums: &mut [VertexLight],
    (draws, samples): (&mut Draws, &mut LightSamples),
    seen: &mut [SampleResult],
) {
    for (place, number) in probe.world.many_lights.others().enumerate() {
        // Each light may take as many rays as there are paths.
        if 0 < place && (probe.cancelled)() {
            return;
        }
        if probe.component.light(number, draws.node) {
            add_light(probe, number, vertices, sums, (draws, samples), seen);
        }
    }
    add_one_of_many(probe, vertices, sums, (draws, samples), seen);
}

/// Adds the light of the light with this index.
pub(crate) fn add_light(
    probe: &mut Probe<'_>,
    number: usize,
    vertices: &[Vertices<'_, '_>],
    sums: &mut [VertexLight],
    (draws, samples): (&mut Draws, &mut LightSamples),
    seen: &mut [SampleResult],
) {
    let world = probe.world;
    let light = &world.lights()[number];
    let bounce = draws.node;
    // Only lights with a size need random numbers.
    let numbers = if light_sphere(light).is_some() {
        draws.four(Purpose::Light(number as u32), world.level)
    } else {
        &[]
    };
    let is_lit = sums.iter().map(|sum| sum.is_lit);
    samples.chosen.clear();
    (samples.chosen).extend(is_lit.map(|is_lit| is_lit.then_some((number, 1.0))));
    let rules = (number, probe.occlusion(light), bounce);
    add_chosen(probe, (vertices, numbers), sums, samples, seen, rules);
}

/// Adds, at each surface that is lit, the light of one of many lights.
pub(crate) fn add_one_of_many(
    probe: &mut Probe<'_>,
    vertices: &[Vertices<'_, '_>],
    sums: &mut [VertexLight],
    (draws, samples): (&mut Draws, &mut LightSamples),
    seen: &mut [SampleResult],
) {
    let (world, bounce) = (probe.world, draws.node);
    let many = &world.many_lights;
    if many.is_empty() || !sums.iter().any(|sum| sum.is_lit) {
        return;
    }
    let numbers = draws.four(Purpose::ManyLights, world.level);
    let gathers = |number| probe.component.light(number, bounce);
    samples.choose_lights(world, (vertices, numbers), sums, gathers);
    // All of them emit photons, or none.
    let occlusion = probe.occlusion(&world.lights()[many.first()]);
    let rules = (world.lights().len(), occlusion, bounce);
    add_chosen(probe, (vertices, numbers), sums, samples, seen, rules);
}

/// Adds, at each surface, the light chosen there. All of them share a slot for the last blocker,
/// and the kind of occlusion.
fn add_chosen(
    probe: &mut Probe<'_>,
    (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
    sums: &mut [VertexLight],
    samples: &mut LightSamples,
    seen: &mut [SampleResult],
    (slot, occlusion, bounce): (usize, Occlusion, u32),
) {
    let world = probe.world;
    let mut rays = LightRays {
        lights: world.lights(),
        unshadowed: &mut samples.unshadowed,
        shadows: &mut samples.shadows.rays,
        shadowed: &mut samples.shadowed,
    };
    rays.unshadowed.clear();
    rays.shadows.clear();
    rays.shadowed.clear();
    for (batch, vertices) in vertices.iter().enumerate() {
        let numbers = numbers.get(batch).unwrap_or(&Fours::ZERO);
        let chosen = &samples.chosen[batch * WIDTH..][..vertices.all().len()];
        let lights = LightBatch::new(world.lights(), chosen);
        let surfaces = (vertices, batch * WIDTH, numbers);
        sample_spheres(world, &lights, surfaces, probe.stage(bounce), &mut rays);
        sample_points(world, &lights, surfaces, &mut rays);
    }
    for ray in &samples.shadowed {
        seen[sums[ray.at].path].rays += 1;
    }
    probe.counts.add_shadow_rays(samples.shadowed.len() as u64);
    let blocker = &mut samples.blockers[slot];
    samples.shadows.trace(probe, blocker, occlusion);
    for (at, light) in samples.reflected(world.lights()) {
        sums[at].of_lights += light;
    }
    // Empty unless dependencies are recorded.
    for (ray, &touched) in samples.shadowed.iter().zip(&probe.crossed.touched) {
        seen[sums[ray.at].path].touched |= touched;
    }
}

/// Samples those lights of a batch that have a radiance, at its surfaces, given the index of the first.
fn sample_spheres(
    world: &World,
    batch: &LightBatch,
    (vertices, first, numbers): (&Vertices<'_, '_>, usize, &Fours),
    stage: BounceStage,
    rays: &mut LightRays<'_>,
) {
    if batch.with_radiance == 0 {
        return;
    }
    let spheres = (
        &Spheres::gather(&batch.spheres),
        &batch.chances,
        batch.with_radiance,
    );
    let samples = vertices.sample_spheres(world.level, spheres, numbers, stage);
    for lane in each_bit(samples.lanes) {
        let hides = |sphere: &SphereLight| {
            let (ray, place) = (samples.rays.get(lane), samples.places.get(lane));
            world.sphere_lights.hide(sphere, &ray, place)
        };
        if !batch.spheres[lane].as_ref().is_some_and(hides) {
            let light = samples.light.get(lane);
            rays.add(
                first + lane,
                batch.indices[lane],
                light,
                &samples.shadow.lane(lane),
            );
        }
    }
}

/// Samples all other lights of a batch.
fn sample_points(
    world: &World,
    batch: &LightBatch,
    (vertices, first, numbers): (&Vertices<'_, '_>, usize, &Fours),
    rays: &mut LightRays<'_>,
) {
    if batch.without == 0 {
        return;
    }
    let lights = world.lights();
    let sampled = (lights, &batch.indices, batch.without);
    let Some(samples) = vertices.sample_points(world.level, sampled, numbers) else {
        return;
    };
    let (places, _) = vertices.places();
    for lane in each_bit(samples.lanes) {
        let number = batch.indices[lane];
        let (place, toward) = (places.get(lane), samples.toward.get(lane));
        let reflected = samples.reflected.get(lane);
        if let Some(light) = sent_back(&lights[number], place, || toward, reflected) {
            let light = light / batch.chances.0[lane];
            rays.add(first + lane, number, light, &samples.shadow.lane(lane));
        }
    }
}

/// Chooses one of many lights, with its probability, for each surface in lanes.
pub(crate) fn choose_light(
    world: &World,
    vertices: &Vertices<'_, '_>,
    numbers: &Fours,
    lanes: u32,
) -> [Option<(usize, f64)>; WIDTH] {
    dispatch!(world.level, simd => {
        world.many_lights.choose_together(simd, vertices.places(), numbers, lanes)
    })
}

impl LightSamples {
    /// Makes room for what is remembered of the lights of a world.
    pub(super) fn start(&mut self, world: &World) {
        self.blockers.resize(world.lights().len() + 1, None);
    }

    /// The light that surfaces, given by their indices, reflect of the lights sampled last.
    pub(crate) fn reflected(&self, lights: &[Light]) -> impl Iterator<Item = (usize, Rgb)> {
        let unshadowed = self.unshadowed.iter().map(|ray| (ray, ray.light));
        let rays = self.shadowed.iter().zip(&self.shadows.transmittances);
        let rays = rays.map(|(ray, &transmittance)| (ray, shadowed(ray.light, transmittance)));
        let all = unshadowed.chain(rays);
        all.map(|(ray, light)| (ray.at, lights[ray.number].scale * light))
    }

    /// Chooses one of many lights for each surface that is lit, among those gathered.
    fn choose_lights(
        &mut self,
        world: &World,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        sums: &[VertexLight],
        gathers: impl Fn(usize) -> bool,
    ) {
        self.chosen.clear();
        let batches = vertices.iter().zip(numbers);
        for ((vertices, numbers), sums) in batches.zip(sums.chunks(WIDTH)) {
            let lanes = lanes_of(sums.iter().map(|sum| sum.is_lit));
            let chosen = choose_light(world, vertices, numbers, lanes);
            let chosen = chosen.into_iter().take(sums.len());
            let gathered = chosen.map(|chosen| chosen.filter(|&(number, _)| gathers(number)));
            self.chosen.extend(gathered);
        }
    }
}
