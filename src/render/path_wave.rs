//! Paths traced together, one bounce of each at a time, so that their rays and shadow rays form
//! packets. The order of summation within each path does not depend on the others.

use std::borrow::Cow;
use std::mem;

use glam::DVec3;

use super::direct::Unshadowed;
use super::emitters::Picked;
use super::intersect::{Nearest, Occlusion};
use super::next_event::Asking;
use super::path::{Met, Onward, Path, Vertex};
use super::probe::{Probe, Sample, Seen};
use super::sampler::{Sampler, Use};
use super::surfaces::Landing;
use super::touched::Touched;
use super::wave::Found;
use super::world::World;
use crate::geometry::Packets;
use crate::geometry::lanes::WIDTH;
use crate::scene::Rgb;

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
    /// For each surface, its numbers for a purpose.
    numbers: Vec<[f64; 4]>,
    /// Their points and shading normals, and the emitter or light picked for each.
    surfaces: Vec<(DVec3, DVec3)>,
    picked: Vec<Option<Picked>>,
    shadows: Packets,
    /// For each shadow ray to a light, the indices of its surface and of the light.
    lit: Vec<(usize, usize, Unshadowed)>,
    /// For each shadow ray to an emitter, the index of its surface.
    asking: Vec<(usize, Asking)>,
    nearest: Vec<Option<Nearest>>,
    transmittances: Vec<f64>,
    /// For each light, the last simple object that occluded it; then for the environment, and for one of
    /// many lights.
    blockers: Vec<Option<u32>>,
}

/// A surface that a path met.
struct Meeting<'m> {
    /// Index of the path.
    path: usize,
    sampler: Sampler,
    vertex: Vertex<'m>,
    /// Whether its side emits and reflects light.
    is_lit: bool,
    /// The reflected light of lights.
    light: Rgb,
    /// The reflected light of emitters.
    asked: Rgb,
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
        for &(place, nearest, material) in &found {
            let Some(material) = material.material(&mapped) else {
                continue;
            };
            let point = landings[place / WIDTH].point(&rays[place / WIDTH], place % WIDTH);
            meetings.push(Meeting {
                path: growing[place],
                sampler: samples[growing[place]].sampler,
                vertex: Vertex::new(world, nearest, point, material),
                is_lit: material.is_lit(point.side),
                light: Rgb::ZERO,
                asked: Rgb::ZERO,
            });
        }
        self.add_lights(&mut meetings, questions, seen);
        self.add_emitters(&mut meetings, questions, seen);
        questions.draw(world, &meetings, Use::Bounce);
        growing.clear();
        for (meeting, &numbers) in meetings.iter().zip(&questions.numbers) {
            let path = &mut paths[meeting.path];
            if meeting.is_lit {
                seen[meeting.path].radiance += path.throughput * self.local(path, meeting);
            }
            let next = meeting.vertex.sample(path, numbers, meeting.sampler);
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
    fn local(&self, path: &Path, meeting: &Meeting<'_>) -> Rgb {
        let emission = if self.gather.glow(path.bounce) {
            self.emission(path, &meeting.vertex)
        } else {
            Rgb::ZERO
        };
        let mut local = emission + meeting.light;
        if self.photon_map.is_some() {
            local += self.caustics(&meeting.vertex, path.bounce);
        }
        local + meeting.asked
    }

    /// Adds the light of all lights, in file order; of many lights, that of one at each surface.
    fn add_lights(
        &mut self,
        meetings: &mut [Meeting<'_>],
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
                questions.draw(world, meetings, Use::Light(number as u32));
            }
            let occlusion = self.occlusion(light);
            self.add_light(meetings, questions, seen, (number, occlusion), |_| {
                Some((number, 1.0))
            });
        }
        let is_lit = |meeting: &Meeting<'_>| meeting.is_lit;
        if !many.is_empty() && meetings.iter().any(is_lit) {
            questions.draw(world, meetings, Use::ManyLights);
            questions.locate(meetings);
            let (surfaces, numbers) = (&questions.surfaces, &questions.numbers);
            many.pick_each(surfaces, numbers, world.level, &mut questions.picked);
            let picked = mem::take(&mut questions.picked);
            let gather = self.gather;
            // All of them emit photons, or none.
            let occlusion = self.occlusion(&lights[many.first()]);
            let slot = lights.len() + 1;
            self.add_light(meetings, questions, seen, (slot, occlusion), |at| {
                let (number, chance) = many.light(picked[at]?);
                gather.light(number, bounce).then_some((number, chance))
            });
            questions.picked = picked;
        }
    }

    /// Adds, at each surface, the light that `chosen` names together with the probability of its choice.
    /// All of them share a slot for the last blocker, and the kind of occlusion.
    #[inline]
    fn add_light(
        &mut self,
        meetings: &mut [Meeting<'_>],
        questions: &mut Questions,
        seen: &mut [Seen],
        (slot, occlusion): (usize, Occlusion),
        chosen: impl Fn(usize) -> Option<(usize, f64)>,
    ) {
        let (lights, bounce) = (self.world.lights(), questions.bounce);
        questions.shadows.clear();
        questions.lit.clear();
        for (at, meeting) in meetings.iter_mut().enumerate() {
            if !meeting.is_lit {
                continue;
            }
            let Some((number, chance)) = chosen(at) else {
                continue;
            };
            let place = || {
                let [u, v, ..] = questions.numbers[at];
                [u, v]
            };
            let unshadowed = self.unshadowed((number, chance), &meeting.vertex, bounce, place);
            let Some(unshadowed) = unshadowed else {
                continue;
            };
            match &unshadowed.shadow {
                None => meeting.light += lights[number].scale * unshadowed.light,
                Some(shadow) => {
                    questions.shadows.push(&shadow.ray(), shadow.ends);
                    questions.lit.push((at, number, unshadowed));
                    seen[meeting.path].rays += 1;
                }
            }
        }
        self.trace_shadows(slot, occlusion, questions);
        let lit = questions.lit.iter().zip(&questions.transmittances);
        for (&(at, number, unshadowed), &transmittance) in lit {
            meetings[at].light += lights[number].scale * unshadowed.shadowed(transmittance);
        }
        // Empty unless dependencies are recorded.
        for (&(at, ..), &touched) in questions.lit.iter().zip(&self.crossed.touched) {
            seen[meetings[at].path].touched |= touched;
        }
    }

    /// Adds the light of objects that emit light, and of the environment, as far as it is sampled.
    fn add_emitters(
        &mut self,
        meetings: &mut [Meeting<'_>],
        questions: &mut Questions,
        seen: &mut [Seen],
    ) {
        let (world, bounce) = (self.world, questions.bounce);
        let asks = |meeting: &Meeting<'_>| meeting.is_lit && self.asks(&meeting.vertex, bounce);
        if !meetings.iter().any(asks) {
            return;
        }
        if !world.emitters.is_empty() {
            questions.draw(world, meetings, Use::Emitter);
            questions.pick(world, meetings);
            let picked = mem::take(&mut questions.picked);
            questions.ask(meetings, seen, |at, vertex, numbers| {
                let picked = picked[at].filter(|_| self.asks(vertex, bounce))?;
                self.ask_object(vertex, bounce, picked, numbers)
            });
            questions.picked = picked;
            self.count_shadows(questions);
            world.nearest_each(&questions.shadows, &mut questions.nearest);
            for ((at, asking), &nearest) in questions.asking.iter().zip(&questions.nearest) {
                if let Some(ray) = &asking.ray {
                    meetings[*at].asked += self.of_object(asking, ray, nearest).radiance;
                }
            }
        }
        if !world.sky.is_unsampled() {
            questions.draw(world, meetings, Use::Sky);
            questions.ask(meetings, seen, |_, vertex, numbers| {
                let asks = self.asks(vertex, bounce);
                asks.then(|| self.ask_sky(vertex, bounce, numbers))?
            });
            self.trace_shadows(world.lights().len(), Occlusion::Complete, questions);
            let asking = questions.asking.iter().zip(&questions.transmittances);
            for ((at, asking), &transmittance) in asking {
                if let Some(ray) = &asking.ray {
                    meetings[*at].asked += self.of_sky(asking, ray, transmittance).radiance;
                }
            }
        }
    }

    /// Computes the transmittances of all shadow rays, given the place of their last blocker.
    fn trace_shadows(&mut self, slot: usize, occlusion: Occlusion, questions: &mut Questions) {
        self.count_shadows(questions);
        self.world.transmittance_each(
            &questions.shadows,
            occlusion,
            &mut questions.blockers[slot],
            &mut self.crossed,
            &mut questions.transmittances,
        );
    }

    fn count_shadows(&mut self, questions: &Questions) {
        self.counts.rays += questions.shadows.count() as u64;
        self.counts.shadow_rays += questions.shadows.count() as u64;
    }
}

impl Questions {
    /// Draws the numbers of all surfaces for a purpose.
    fn draw(&mut self, world: &World, meetings: &[Meeting<'_>], purpose: Use) {
        self.samplers.clear();
        self.samplers
            .extend(meetings.iter().map(|meeting| meeting.sampler));
        let (node, numbers) = (self.bounce, &mut self.numbers);
        Sampler::four_each(&self.samplers, (node, purpose), world.level, numbers);
    }

    /// Collects the points and shading normals of all surfaces.
    fn locate(&mut self, meetings: &[Meeting<'_>]) {
        let places = meetings.iter();
        let places = places.map(|meeting| meeting.vertex.point_and_normal());
        self.surfaces.clear();
        self.surfaces.extend(places);
    }

    /// Picks an emitter for each surface.
    fn pick(&mut self, world: &World, meetings: &[Meeting<'_>]) {
        self.locate(meetings);
        let (surfaces, numbers) = (&self.surfaces, &self.numbers);
        world
            .emitters
            .pick_each(surfaces, numbers, world.level, &mut self.picked);
    }

    /// Collects the shadow rays to emitters from all surfaces that are lit.
    fn ask(
        &mut self,
        meetings: &[Meeting<'_>],
        seen: &mut [Seen],
        mut ask: impl FnMut(usize, &Vertex<'_>, [f64; 4]) -> Option<Asking>,
    ) {
        self.shadows.clear();
        self.asking.clear();
        for (at, (meeting, &numbers)) in meetings.iter().zip(&self.numbers).enumerate() {
            if meeting.is_lit
                && let Some(asking) = ask(at, &meeting.vertex, numbers)
                && let Some(ray) = &asking.ray
            {
                self.shadows.push(ray, asking.reach);
                self.asking.push((at, asking));
                seen[meeting.path].rays += 1;
            }
        }
    }
}
