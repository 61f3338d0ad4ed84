//! Paths traced together, one bounce of each at a time, so that their rays and shadow rays form
//! packets. The order of summation within each path does not depend on the others.

use std::borrow::Cow;

use glam::DVec3;

use super::bsdf::BsdfSample;
use super::direct::{Shadow, Unshadowed, shadowed};
use super::emitters::Choices;
use super::intersect::{Nearest, Occlusion};
use super::lights::{SphereLight, Spheres};
use super::next_event::Target;
use super::path::{Met, Onward, Path, Vertex};
use super::probe::{Probe, Sample, Seen};
use super::sampler::{Fours, Sampler, Use};
use super::surfaces::Landing;
use super::touched::Touched;
use super::vertices::{Aimed, Vertices};
use super::wave::Found;
use super::world::World;
use crate::geometry::lanes::{Row, Vector, WIDTH, dispatch, each_bit};
use crate::geometry::{Packets, Ray};
use crate::scene::{Rgb, Shadows};

/// How many paths are traced together: with four times as many, tracing takes 2 % longer.
const TOGETHER: usize = 64;

/// Scratch space for paths traced together.
#[derive(Debug, Default)]
pub(crate) struct PathWave {
    paths: Vec<Path>,
    /// Indices of the unfinished paths.
    growing: Vec<usize>,
    /// Their rays, nearest hits and surface points.
    rays: Packets,
    nearest: Vec<Option<Nearest>>,
    landings: Vec<Landing>,
    questions: Questions,
}

/// The light samples of a bounce at all its surfaces, and scratch space.
#[derive(Debug, Default)]
struct Questions {
    bounce: u32,
    samplers: Vec<Sampler>,
    /// The numbers of all surfaces for a purpose, eight by eight.
    numbers: Vec<Fours>,
    /// The light that each surface samples, with the probability of its choice.
    chosen: Vec<Option<(usize, f64)>>,
    shadows: Packets,
    /// For each shadow ray to a light, the indices of its surface and of the light, and the light
    /// without shadow.
    lit: Vec<(usize, usize, Rgb)>,
    to_emitters: Vec<EmitterRay>,
    nearest: Vec<Option<Nearest>>,
    transmittances: Vec<f64>,
    /// For each light, the last simple object that occluded it; then for the environment, and for one of
    /// many lights.
    blockers: Vec<Option<u32>>,
}

/// A surface that a path met.
struct Meeting {
    /// Index of the path.
    path: usize,
    /// Whether its side emits and reflects light.
    is_lit: bool,
    /// The reflected light of lights.
    light: Rgb,
    /// The reflected light of emitters.
    of_emitters: Rgb,
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

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Estimates the radiance along camera rays of samples with the same index.
    pub(crate) fn by_paths(
        &mut self,
        wave: &mut PathWave,
        samples: &[Sample],
        seen: &mut Vec<Seen>,
    ) {
        let index = |sample: &Sample| sample.sampler.index();
        debug_assert!(
            samples
                .windows(2)
                .all(|pair| index(&pair[0]) == index(&pair[1]))
        );
        seen.resize(samples.len(), Seen::NOTHING);
        let blockers = self.world.lights().len() + 2;
        wave.questions.blockers.resize(blockers, None);
        for (samples, seen) in samples.chunks(TOGETHER).zip(seen.chunks_mut(TOGETHER)) {
            wave.paths.clear();
            wave.paths.extend(samples.iter().map(Path::new));
            wave.growing.clear();
            wave.growing.extend(0..samples.len());
            wave.questions.bounce = 0;
            while !wave.growing.is_empty() && !(self.cancelled)() {
                self.bounce(wave, samples, seen);
                wave.questions.bounce += 1;
            }
        }
    }

    /// Follows each path to its next surface and on from there.
    fn bounce(&mut self, wave: &mut PathWave, samples: &[Sample], seen: &mut [Seen]) {
        let PathWave {
            paths,
            growing,
            rays,
            nearest,
            landings,
            questions,
        } = wave;
        let world = self.world;
        rays.clear();
        for &number in &*growing {
            let path = &paths[number];
            rays.push(&path.ray, path.reach(&samples[number]));
            seen[number].rays += 1;
        }
        self.counts.rays += growing.len() as u64;
        world.nearest_each(rays, nearest);
        world.land_each(rays, nearest, landings);
        let mut mapped = Vec::new();
        let mut found = Vec::with_capacity(growing.len());
        for (place, &number) in growing.iter().enumerate() {
            let (path, seen) = (&mut paths[number], &mut seen[number]);
            match self.meet(path, &samples[number], nearest[place]) {
                Met::Nothing(radiance) => seen.radiance += self.of_nothing(path, radiance),
                Met::Light {
                    number,
                    radiance,
                    weight,
                    ..
                } => {
                    if self.gathers(number, path) {
                        seen.radiance += path.throughput * radiance * weight;
                    }
                }
                Met::Surface(nearest) => {
                    if path.bounce == 0 {
                        seen.object = nearest.object;
                    }
                    seen.touched |= Touched::object(nearest.object);
                    let (landing, lane) = (&mut landings[place / WIDTH], place % WIDTH);
                    let material =
                        match landing.material(world, nearest, (&rays[place / WIDTH], lane)) {
                            Cow::Borrowed(material) => Found::Plain(material),
                            Cow::Owned(material) => {
                                mapped.push(material);
                                Found::Mapped(mapped.len() - 1)
                            }
                        };
                    found.push((place, nearest, material));
                }
            }
        }
        let mut meetings = Vec::with_capacity(found.len());
        let mut vertices = Vec::with_capacity(found.len());
        questions.samplers.clear();
        for &(place, nearest, material) in &found {
            let Some(material) = material.material(&mapped) else {
                continue;
            };
            let point = landings[place / WIDTH].point(&rays[place / WIDTH], place % WIDTH);
            let path = growing[place];
            vertices.push(Vertex::new(world, nearest, point, material));
            questions.samplers.push(samples[path].sampler);
            meetings.push(Meeting {
                path,
                is_lit: material.is_lit(point.side),
                light: Rgb::ZERO,
                of_emitters: Rgb::ZERO,
            });
        }
        let vertices = Vertices::collect(&vertices);
        self.add_lights(&vertices, &mut meetings, questions, seen);
        self.add_emitters(&vertices, &mut meetings, questions, seen);
        questions.draw(world, Use::Bounce);
        growing.clear();
        let batches = vertices.iter().zip(&questions.numbers);
        for ((vertices, numbers), meetings) in batches.zip(meetings.chunks(WIDTH)) {
            let batch = (vertices, numbers, meetings);
            self.go_on(batch, paths, samples, seen, growing);
        }
    }

    /// Adds what the surfaces send back, and continues the paths.
    fn go_on(
        &mut self,
        (vertices, numbers, meetings): (&Vertices<'_, '_>, &Fours, &[Meeting]),
        paths: &mut [Path],
        samples: &[Sample],
        seen: &mut [Seen],
        growing: &mut Vec<usize>,
    ) {
        let by_lobes = vertices.sample(self.world.level, numbers);
        for (lane, (vertex, meeting)) in vertices.all().iter().zip(meetings).enumerate() {
            let path = &mut paths[meeting.path];
            if meeting.is_lit {
                let local = self.local(path, vertex, meeting);
                seen[meeting.path].radiance += path.throughput * local;
            }
            let numbers = numbers.lane(lane);
            let next = if by_lobes.lobes >> lane & 1 == 0 {
                vertex.sample(path, numbers, samples[meeting.path].sampler)
            } else {
                (by_lobes.lead_on >> lane & 1 == 1).then(|| {
                    let (ray, weight) = (by_lobes.rays.get(lane), by_lobes.weight.get(lane));
                    BsdfSample::by_lobes(&vertex.point, ray, weight, by_lobes.density.0[lane])
                })
            };
            if let Onward::Goes { .. } = self.onward(path, next, numbers) {
                growing.push(meeting.path);
            }
        }
    }

    /// What a path that leads to nothing adds, given the radiance there.
    fn of_nothing(&self, path: &Path, radiance: Rgb) -> Rgb {
        if !self.gather.glow(path.bounce) {
            return Rgb::ZERO;
        }
        let densities = path.densities_of(&self.world.sky);
        let weight = densities.map_or(1.0, |densities| densities.weight);
        path.throughput * radiance * weight
    }

    /// The radiance of a surface toward a path.
    fn local(&self, path: &Path, vertex: &Vertex<'_>, meeting: &Meeting) -> Rgb {
        let emission = if self.gather.glow(path.bounce) {
            self.emission(path, vertex)
        } else {
            Rgb::ZERO
        };
        let mut local = emission + meeting.light;
        if self.photon_map.is_some() {
            local += self.caustics(vertex, path.bounce);
        }
        local + meeting.of_emitters
    }

    /// Adds the light of all lights, in file order; of many lights, that of one at each surface.
    fn add_lights(
        &mut self,
        vertices: &[Vertices<'_, '_>],
        meetings: &mut [Meeting],
        questions: &mut Questions,
        seen: &mut [Seen],
    ) {
        let (world, bounce) = (self.world, questions.bounce);
        let (many, lights) = (&world.many_lights, world.lights());
        for (place, number) in many.others().enumerate() {
            // Each light may take as many rays as there are paths.
            if 0 < place && (self.cancelled)() {
                return;
            }
            if !self.gather.light(number, bounce) {
                continue;
            }
            let light = &lights[number];
            if light.sphere().is_some() {
                questions.draw(world, Use::Light(number as u32));
            } else {
                // Only lights with a size need them.
                questions.numbers.resize(vertices.len(), Fours::ZERO);
            }
            questions.chosen.clear();
            let chosen = meetings
                .iter()
                .map(|meeting| meeting.is_lit.then_some((number, 1.0)));
            questions.chosen.extend(chosen);
            let occlusion = self.occlusion(light);
            self.add_light(vertices, meetings, questions, seen, (number, occlusion));
        }
        let is_lit = |meeting: &Meeting| meeting.is_lit;
        if !many.is_empty() && meetings.iter().any(is_lit) {
            questions.draw(world, Use::ManyLights);
            let gathers = |number| self.gather.light(number, bounce);
            questions.choose_lights(world, vertices, meetings, gathers);
            // All of them emit photons, or none.
            let occlusion = self.occlusion(&lights[many.first()]);
            let slot = lights.len() + 1;
            self.add_light(vertices, meetings, questions, seen, (slot, occlusion));
        }
    }

    /// Adds, at each surface, the light chosen there. All of them share a slot for the last blocker,
    /// and the kind of occlusion.
    fn add_light(
        &mut self,
        vertices: &[Vertices<'_, '_>],
        meetings: &mut [Meeting],
        questions: &mut Questions,
        seen: &mut [Seen],
        (slot, occlusion): (usize, Occlusion),
    ) {
        let (world, bounce) = (self.world, questions.bounce);
        let lights = world.lights();
        let Questions {
            numbers,
            chosen,
            shadows,
            lit,
            ..
        } = questions;
        shadows.clear();
        lit.clear();
        let mut receive = |at: usize, number: usize, light: Rgb, shadow: Option<Shadow<f64>>| {
            let meeting = &mut meetings[at];
            match shadow {
                None => meeting.light += lights[number].scale * light,
                Some(shadow) => {
                    shadows.push(&shadow.ray(), shadow.ends);
                    lit.push((at, number, light));
                    seen[meeting.path].rays += 1;
                }
            }
        };
        let chosen = chosen.chunks(WIDTH);
        for (batch, ((vertices, numbers), chosen)) in
            vertices.iter().zip(&*numbers).zip(chosen).enumerate()
        {
            let first = batch * WIDTH;
            let mut spheres = [None; WIDTH];
            let mut chances = Row::all(1.0);
            let mut with_size = 0;
            for (lane, vertex) in vertices.all().iter().enumerate() {
                let Some((number, chance)) = chosen[lane] else {
                    continue;
                };
                if let Some(sphere) = lights[number].luminous_sphere() {
                    spheres[lane] = Some(sphere);
                    chances.0[lane] = chance;
                    with_size |= 1 << lane;
                    continue;
                }
                let place = || {
                    let [u, v, ..] = numbers.lane(lane);
                    [u, v]
                };
                let unshadowed = self.unshadowed((number, chance), vertex, bounce, place);
                if let Some(Unshadowed { light, shadow }) = unshadowed {
                    receive(first + lane, number, light, shadow);
                }
            }
            if with_size == 0 {
                continue;
            }
            let sampled = (&Spheres::gather(&spheres), &chances, with_size);
            let samples = vertices.light(world.level, sampled, numbers, self.may_go_on(bounce));
            for lane in each_bit(samples.lanes) {
                let hides = |sphere: &SphereLight| {
                    let (ray, place) = (samples.rays.get(lane), samples.places.get(lane));
                    world.sphere_lights.hide(sphere, &ray, place)
                };
                if let Some((number, _)) = chosen[lane]
                    && !spheres[lane].as_ref().is_some_and(hides)
                {
                    let casts = lights[number].shadows != Shadows::Off;
                    let shadow = casts.then(|| samples.shadow.lane(lane));
                    receive(first + lane, number, samples.light.get(lane), shadow);
                }
            }
        }
        self.counts.rays += questions.lit.len() as u64;
        self.counts.shadow_rays += questions.lit.len() as u64;
        self.trace_shadows(slot, occlusion, questions);
        let lit = questions.lit.iter().zip(&questions.transmittances);
        for (&(at, number, light), &transmittance) in lit {
            meetings[at].light += lights[number].scale * shadowed(light, transmittance);
        }
        // Empty unless dependencies are recorded.
        for (&(at, ..), &touched) in questions.lit.iter().zip(&self.crossed.touched) {
            seen[meetings[at].path].touched |= touched;
        }
    }

    /// Adds the light of objects that emit light, and of the environment, as far as it is sampled.
    fn add_emitters(
        &mut self,
        vertices: &[Vertices<'_, '_>],
        meetings: &mut [Meeting],
        questions: &mut Questions,
        seen: &mut [Seen],
    ) {
        let (world, bounce) = (self.world, questions.bounce);
        let of_batch = |(meetings, vertices): (&[Meeting], &Vertices<'_, '_>)| {
            let all = meetings.iter().zip(vertices.all());
            lanes_of(all.map(|(meeting, vertex)| meeting.is_lit && self.asks(vertex, bounce)))
        };
        let lanes: Vec<_> = meetings.chunks(WIDTH).zip(vertices).map(of_batch).collect();
        if lanes.iter().all(|&lanes| lanes == 0) {
            return;
        }
        if !world.emitters.is_empty() {
            questions.draw(world, Use::Emitter);
            questions.ask_objects(world, vertices, &lanes);
            self.count_emitter_rays(questions, meetings, seen);
            world.nearest_each(&questions.shadows, &mut questions.nearest);
            for (to_emitter, &nearest) in questions.to_emitters.iter().zip(&questions.nearest) {
                if let Some(target) = to_emitter.target
                    && let Some(emitted) = self.of_object(target, &to_emitter.ray, nearest)
                {
                    meetings[to_emitter.at].of_emitters += to_emitter.reflect(emitted);
                }
            }
        }
        if !world.sky.is_unsampled() {
            questions.draw(world, Use::Sky);
            questions.ask_sky(world, vertices, &lanes);
            self.count_emitter_rays(questions, meetings, seen);
            self.trace_shadows(world.lights().len(), Occlusion::Complete, questions);
            let rays = questions.to_emitters.iter();
            for (to_emitter, &transmittance) in rays.zip(&questions.transmittances) {
                if let Some(emitted) = self.of_sky(&to_emitter.ray, transmittance) {
                    meetings[to_emitter.at].of_emitters += to_emitter.reflect(emitted);
                }
            }
        }
    }

    /// Computes the transmittances of all shadow rays, given the place of their last blocker.
    fn trace_shadows(&mut self, slot: usize, occlusion: Occlusion, questions: &mut Questions) {
        self.world.transmittance_each(
            &questions.shadows,
            occlusion,
            &mut questions.blockers[slot],
            &mut self.crossed,
            &mut questions.transmittances,
        );
    }

    /// Counts the shadow rays to emitters.
    fn count_emitter_rays(
        &mut self,
        questions: &Questions,
        meetings: &[Meeting],
        seen: &mut [Seen],
    ) {
        for to_emitter in &questions.to_emitters {
            seen[meetings[to_emitter.at].path].rays += 1;
        }
        self.counts.rays += questions.to_emitters.len() as u64;
        self.counts.shadow_rays += questions.to_emitters.len() as u64;
    }
}

impl Questions {
    /// Draws the numbers of all surfaces for a purpose.
    fn draw(&mut self, world: &World, purpose: Use) {
        let (node, numbers) = (self.bounce, &mut self.numbers);
        Sampler::four_each(&self.samplers, (node, purpose), world.level, numbers);
    }

    /// Chooses one of many lights for each surface that is lit, among those gathered.
    fn choose_lights(
        &mut self,
        world: &World,
        vertices: &[Vertices<'_, '_>],
        meetings: &[Meeting],
        gathers: impl Fn(usize) -> bool,
    ) {
        self.chosen.clear();
        let batches = vertices.iter().zip(&self.numbers);
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
    fn ask_objects(&mut self, world: &World, vertices: &[Vertices<'_, '_>], lanes: &[u32]) {
        self.shadows.clear();
        self.to_emitters.clear();
        let batches = vertices.iter().zip(&self.numbers).zip(lanes);
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
    fn ask_sky(&mut self, world: &World, vertices: &[Vertices<'_, '_>], lanes: &[u32]) {
        self.shadows.clear();
        self.to_emitters.clear();
        let batches = vertices.iter().zip(&self.numbers).zip(lanes);
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

/// A bit for each of up to eight, the lowest for the first.
fn lanes_of(each: impl Iterator<Item = bool>) -> u32 {
    let numbered = each.enumerate();
    numbered.fold(0, |lanes, (lane, is_in)| lanes | u32::from(is_in) << lane)
}
