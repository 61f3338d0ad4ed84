//! Next event estimation at the surfaces that paths meet at a bounce, all together: light samples in
//! lanes, shadow rays in packets.

use glam::DVec3;

use super::next_event::Target;
use super::vertices::{Aimed, Vertices};
use crate::integrators::direct::{Shadow, sent_back, shadowed};
use crate::integrators::probe::{Probe, SampleResult};
use crate::light::{Choices, SphereLight, Spheres, light_sphere, luminous_sphere};
use crate::sampling::{Draws, Fours, Use};
use crate::world::{NearestHits, Occlusion, World};
use geometry::lanes::{Row, Vector, WIDTH, dispatch, each_bit, lanes_of};
use geometry::{Packets, Ray};
use scene::{Light, Rgb, Shadows};

/// Shadow rays of the surfaces of a bounce, what they carry, and scratch space.
#[derive(Debug, Default)]
pub(crate) struct NextEventWave {
    /// The light that each surface samples, with the probability of its choice.
    chosen: Vec<Option<(usize, f64)>>,
    shadows: Packets,
    to_lights: Vec<LightRay>,
    to_emitters: Vec<EmitterRay>,
    nearest: Vec<NearestHits>,
    transmittances: Vec<f64>,
    /// For each light, the last simple object that occluded it; then for the environment, and for one of
    /// many lights.
    blockers: Vec<Option<u32>>,
}

/// A surface that a path met.
pub(crate) struct Meeting {
    /// Index of the path.
    pub(crate) path: usize,
    /// Whether its side emits and reflects light.
    pub(crate) is_lit: bool,
    /// The light of lights that it reflects.
    pub(crate) light: Rgb,
    /// The light of emitters that it reflects.
    pub(crate) of_emitters: Rgb,
}

/// A shadow ray to a light.
#[derive(Clone, Copy, Debug)]
struct LightRay {
    /// Index of the surface.
    at: usize,
    /// Index of the light.
    number: usize,
    /// The light that arrives if nothing is in between, unscaled.
    light: Rgb,
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
    share: f64,
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

/// Collects the contributions of lights.
struct Lit<'e> {
    lights: &'e [Light],
    meetings: &'e mut [Meeting],
    shadows: &'e mut Packets,
    rays: &'e mut Vec<LightRay>,
}

impl LightBatch {
    /// Collects the lights from their indices and probabilities.
    fn new(lights: &[Light], chosen: &[Option<(usize, f64)>]) -> Self {
        let mut asked = Self {
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
            asked.indices[lane] = number;
            asked.chances.0[lane] = chance;
            asked.spheres[lane] = luminous_sphere(&lights[number]);
            if asked.spheres[lane].is_some() {
                asked.with_radiance |= 1 << lane;
            } else {
                asked.without |= 1 << lane;
            }
        }
        asked
    }
}

impl Lit<'_> {
    /// Adds light that arrives at a surface if nothing is in between, given the indices of the surface and
    /// of the light.
    fn add(&mut self, at: usize, number: usize, light: Rgb, shadow: &Shadow<f64>) {
        let source = &self.lights[number];
        if source.shadows == Shadows::Off {
            self.meetings[at].light += source.scale * light;
        } else {
            self.shadows.push(&shadow.ray(), shadow.ends);
            self.rays.push(LightRay { at, number, light });
        }
    }
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Adds the light of all lights, in file order; of many lights, that of one at each surface.
    pub(crate) fn add_lights(
        &mut self,
        vertices: &[Vertices<'_, '_>],
        meetings: &mut [Meeting],
        (draws, events): (&mut Draws, &mut NextEventWave),
        seen: &mut [SampleResult],
    ) {
        let (world, bounce) = (self.world, draws.node);
        let (many, lights) = (&world.many_lights, world.lights());
        for (place, number) in many.others().enumerate() {
            // Each light may take as many rays as there are paths.
            if 0 < place && (self.cancelled)() {
                return;
            }
            if !self.gather.light(number, bounce) {
                continue;
            }
            // Only lights with a size need random numbers.
            let numbers = if light_sphere(&lights[number]).is_some() {
                draws.four(Use::Light(number as u32), world.level)
            } else {
                &[]
            };
            let is_lit = meetings.iter().map(|meeting| meeting.is_lit);
            events.chosen.clear();
            (events.chosen).extend(is_lit.map(|is_lit| is_lit.then_some((number, 1.0))));
            let occlusion = self.occlusion(&lights[number]);
            let batches = (vertices, numbers);
            self.add_light(batches, meetings, events, seen, (number, occlusion, bounce));
        }
        let is_lit = |meeting: &Meeting| meeting.is_lit;
        if !many.is_empty() && meetings.iter().any(is_lit) {
            let numbers = draws.four(Use::ManyLights, world.level);
            let gathers = |number| self.gather.light(number, bounce);
            events.choose_lights(world, (vertices, numbers), meetings, gathers);
            // All of them emit photons, or none.
            let occlusion = self.occlusion(&lights[many.first()]);
            let batches = (vertices, numbers);
            let slot = lights.len() + 1;
            self.add_light(batches, meetings, events, seen, (slot, occlusion, bounce));
        }
    }

    /// Adds, at each surface, the light chosen there. All of them share a slot for the last blocker,
    /// and the kind of occlusion.
    fn add_light(
        &mut self,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        meetings: &mut [Meeting],
        events: &mut NextEventWave,
        seen: &mut [SampleResult],
        (slot, occlusion, bounce): (usize, Occlusion, u32),
    ) {
        let world = self.world;
        let mut lit = Lit {
            lights: world.lights(),
            meetings,
            shadows: &mut events.shadows,
            rays: &mut events.to_lights,
        };
        lit.shadows.clear();
        lit.rays.clear();
        for (batch, vertices) in vertices.iter().enumerate() {
            let numbers = numbers.get(batch).unwrap_or(&Fours::ZERO);
            let chosen = &events.chosen[batch * WIDTH..][..vertices.all().len()];
            let asked = LightBatch::new(world.lights(), chosen);
            let surfaces = (vertices, batch * WIDTH, numbers);
            self.ask_spheres(&asked, surfaces, bounce, &mut lit);
            self.ask_points(&asked, surfaces, &mut lit);
        }
        for ray in &events.to_lights {
            seen[meetings[ray.at].path].rays += 1;
        }
        self.counts.rays += events.to_lights.len() as u64;
        self.counts.shadow_rays += events.to_lights.len() as u64;
        self.trace_shadows(slot, occlusion, events);
        for (ray, &transmittance) in events.to_lights.iter().zip(&events.transmittances) {
            let light = world.lights()[ray.number].scale * shadowed(ray.light, transmittance);
            meetings[ray.at].light += light;
        }
        // Empty unless dependencies are recorded.
        for (ray, &touched) in events.to_lights.iter().zip(&self.crossed.touched) {
            seen[meetings[ray.at].path].touched |= touched;
        }
    }

    /// Samples those lights of a batch that have a radiance, at its surfaces, given the index of the first.
    fn ask_spheres(
        &self,
        asked: &LightBatch,
        (vertices, first, numbers): (&Vertices<'_, '_>, usize, &Fours),
        bounce: u32,
        lit: &mut Lit<'_>,
    ) {
        if asked.with_radiance == 0 {
            return;
        }
        let world = self.world;
        let spheres = (
            &Spheres::gather(&asked.spheres),
            &asked.chances,
            asked.with_radiance,
        );
        let samples =
            vertices.sample_spheres(world.level, spheres, numbers, self.may_go_on(bounce));
        for lane in each_bit(samples.lanes) {
            let hides = |sphere: &SphereLight| {
                let (ray, place) = (samples.rays.get(lane), samples.places.get(lane));
                world.sphere_lights.hide(sphere, &ray, place)
            };
            if !asked.spheres[lane].as_ref().is_some_and(hides) {
                let light = samples.light.get(lane);
                lit.add(
                    first + lane,
                    asked.indices[lane],
                    light,
                    &samples.shadow.lane(lane),
                );
            }
        }
    }

    /// Samples all other lights of a batch.
    fn ask_points(
        &self,
        asked: &LightBatch,
        (vertices, first, numbers): (&Vertices<'_, '_>, usize, &Fours),
        lit: &mut Lit<'_>,
    ) {
        if asked.without == 0 {
            return;
        }
        let (world, lights) = (self.world, self.world.lights());
        let sampled = (lights, &asked.indices, asked.without);
        let Some(samples) = vertices.sample_points(world.level, sampled, numbers) else {
            return;
        };
        let (places, _) = vertices.places();
        for lane in each_bit(samples.lanes) {
            let number = asked.indices[lane];
            let (place, toward) = (places.get(lane), samples.toward.get(lane));
            let reflected = samples.reflected.get(lane);
            if let Some(light) = sent_back(&lights[number], place, || toward, reflected) {
                let light = light / asked.chances.0[lane];
                lit.add(first + lane, number, light, &samples.shadow.lane(lane));
            }
        }
    }

    /// Adds the light of objects that emit light, and of the environment, as far as it is sampled.
    pub(crate) fn add_emitters(
        &mut self,
        vertices: &[Vertices<'_, '_>],
        meetings: &mut [Meeting],
        (draws, events): (&mut Draws, &mut NextEventWave),
        seen: &mut [SampleResult],
    ) {
        let (world, bounce) = (self.world, draws.node);
        let of_batch = |(meetings, vertices): (&[Meeting], &Vertices<'_, '_>)| {
            let all = meetings.iter().zip(vertices.all());
            lanes_of(all.map(|(meeting, vertex)| meeting.is_lit && self.asks(vertex, bounce)))
        };
        let lanes: Vec<_> = meetings.chunks(WIDTH).zip(vertices).map(of_batch).collect();
        if lanes.iter().all(|&lanes| lanes == 0) {
            return;
        }
        if !world.emitters.is_empty() {
            let numbers = draws.four(Use::Emitter, world.level);
            events.ask_objects(world, (vertices, numbers), &lanes);
            self.count_emitter_rays(events, meetings, seen);
            world.nearest_each(&events.shadows, &mut events.nearest);
            for (number, to_emitter) in events.to_emitters.iter().enumerate() {
                let nearest = events.nearest[number / WIDTH].get(number % WIDTH);
                if let Some(target) = to_emitter.target
                    && let Some(emitted) = self.of_object(target, &to_emitter.ray, nearest)
                {
                    meetings[to_emitter.at].of_emitters += to_emitter.reflect(emitted);
                }
            }
        }
        if !world.sky.is_unsampled() {
            let numbers = draws.four(Use::Sky, world.level);
            events.ask_sky(world, (vertices, numbers), &lanes);
            self.count_emitter_rays(events, meetings, seen);
            self.trace_shadows(world.lights().len(), Occlusion::Complete, events);
            let rays = events.to_emitters.iter();
            for (to_emitter, &transmittance) in rays.zip(&events.transmittances) {
                if let Some(emitted) = self.of_sky(&to_emitter.ray, transmittance) {
                    meetings[to_emitter.at].of_emitters += to_emitter.reflect(emitted);
                }
            }
        }
    }

    /// Computes the transmittances of all shadow rays, given the place of their last blocker.
    fn trace_shadows(&mut self, slot: usize, occlusion: Occlusion, events: &mut NextEventWave) {
        self.world.transmittance_each(
            &events.shadows,
            occlusion,
            &mut events.blockers[slot],
            &mut self.crossed,
            &mut events.transmittances,
        );
    }

    /// Counts the shadow rays to emitters.
    fn count_emitter_rays(
        &mut self,
        events: &NextEventWave,
        meetings: &[Meeting],
        seen: &mut [SampleResult],
    ) {
        for to_emitter in &events.to_emitters {
            seen[meetings[to_emitter.at].path].rays += 1;
        }
        self.counts.rays += events.to_emitters.len() as u64;
        self.counts.shadow_rays += events.to_emitters.len() as u64;
    }
}

impl NextEventWave {
    /// Makes room for what is remembered of the lights of a world.
    pub(crate) fn start(&mut self, world: &World) {
        self.blockers.resize(world.lights().len() + 2, None);
    }

    /// Chooses one of many lights for each surface that is lit, among those gathered.
    fn choose_lights(
        &mut self,
        world: &World,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        meetings: &[Meeting],
        gathers: impl Fn(usize) -> bool,
    ) {
        self.chosen.clear();
        let batches = vertices.iter().zip(numbers);
        for ((vertices, numbers), meetings) in batches.zip(meetings.chunks(WIDTH)) {
            let lanes = lanes_of(meetings.iter().map(|meeting| meeting.is_lit));
            let chosen = dispatch!(world.level, simd => {
                world.many_lights.choose_together(simd, vertices.places(), numbers, lanes)
            });
            let chosen = chosen.into_iter().take(meetings.len());
            let gathered = chosen.map(|chosen| chosen.filter(|&(number, _)| gathers(number)));
            self.chosen.extend(gathered);
        }
    }

    /// Collects the shadow rays to objects that emit light from the surfaces in lanes.
    fn ask_objects(
        &mut self,
        world: &World,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        lanes: &[u32],
    ) {
        self.shadows.clear();
        self.to_emitters.clear();
        let batches = vertices.iter().zip(numbers).zip(lanes);
        for (batch, ((vertices, numbers), &lanes)) in batches.enumerate() {
            let (choices, aimed) = dispatch!(world.level, simd => {
                let (emitters, at) = (&world.emitters, vertices.places());
                let choices = emitters.choose_together(simd, &world.scene, at, numbers, lanes);
                let Choices { lanes, toward, density, .. } = &choices;
                let aimed = vertices.aim(simd, *lanes, toward, density);
                (choices, aimed)
            });
            for lane in each_bit(aimed.lanes) {
                let target = Target {
                    part: choices.parts[lane],
                    is_front: choices.front >> lane & 1 == 1,
                };
                let to_emitter = EmitterRay::new(batch, lane, &aimed, Some(target));
                self.shadows.push(&to_emitter.ray, choices.reach.0[lane]);
                self.to_emitters.push(to_emitter);
            }
        }
    }

    /// Collects the shadow rays to the environment from the surfaces in lanes.
    fn ask_sky(
        &mut self,
        world: &World,
        (vertices, numbers): (&[Vertices<'_, '_>], &[Fours]),
        lanes: &[u32],
    ) {
        self.shadows.clear();
        self.to_emitters.clear();
        let batches = vertices.iter().zip(numbers).zip(lanes);
        for (batch, ((vertices, numbers), &lanes)) in batches.enumerate() {
            let mut toward = Vector::repeat(DVec3::ZERO);
            let mut density = Row::all(0.0);
            for lane in each_bit(lanes) {
                let [u, v, ..] = numbers.lane(lane);
                if let Some(chosen) = world.sky.choose([u, v]) {
                    toward.set(lane, chosen);
                    density.0[lane] = world.sky.density(chosen);
                }
            }
            let aimed = dispatch!(world.level, simd => {
                vertices.aim(simd, lanes, &toward, &density)
            });
            for lane in each_bit(aimed.lanes) {
                let to_emitter = EmitterRay::new(batch, lane, &aimed, None);
                self.shadows.push(&to_emitter.ray, f64::INFINITY);
                self.to_emitters.push(to_emitter);
            }
        }
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
            share: aimed.share.0[lane],
        }
    }

    /// The light that the surface reflects of the emission that arrives.
    fn reflect(&self, emitted: Rgb) -> Rgb {
        self.reflected * emitted * self.share
    }
}
