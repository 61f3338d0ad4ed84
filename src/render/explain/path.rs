//! The rays of a path: the integrator's own steps run for one sample, and what they leave in the wave
//! is read between them.

use super::lights::LitPoint;
use super::ray_kind::RayKind;
use super::record::{
    Chosen, EmitterTerm, LightHit, LightTerm, RayEnd, Shading, Stop, TracedRay, UnlitReason,
};
use super::recorder::Recorder;
use super::surface::{missing_around, shading};
use crate::integrators::path::{
    Aimed, Continuation, EmitterArrival, Path, PathHit, PathWave, Vertices, add_caustics,
    add_emitting_objects, add_light, add_one_of_many, add_sky, aim_at_object, aim_at_sky,
    choose_light, classify_hit, density_of, emission, samples_emitters, shade_and_continue,
    trace_rays,
};
use crate::integrators::{LightGeometry, PhotonMap, Probe, Sample, SampleResult, Vertex};
use crate::light::{Incoming, SphereLight, light_sphere, luminous_sphere};
use crate::material::{Component, transmitted};
use crate::sampling::{Densities, Purpose};
use crate::world::World;
use geometry::lanes::Vector;
use scene::Rgb;

/// The lanes of the only path.
const ONE: u32 = 1;

/// Traces a sample; returns its radiance and all rays, or `None` once `cancelled` returns true.
pub(super) fn record(
    world: &World,
    depth: u32,
    photons: Option<&PhotonMap>,
    sample: Sample,
    cancelled: &dyn Fn() -> bool,
) -> Option<(Rgb, Vec<TracedRay>)> {
    let mut trace = Trace {
        probe: Probe::new(world, depth, cancelled).with_photons(photons),
        wave: PathWave::default(),
        samples: [sample],
        seen: [SampleResult::NOTHING],
        recorder: Recorder::new(),
    };
    trace.wave.start(world, &trace.samples);
    trace.begin(RayKind::Camera, None);
    loop {
        match trace.bounce() {
            Step::Cancelled => return None,
            Step::Ended => return Some((trace.seen[0].radiance, trace.recorder.rays)),
            Step::GoesOn(kind, chosen) => trace.begin(kind, Some(chosen)),
        }
        trace.wave.draws.node += 1;
    }
}

/// A wave of one path, and its record.
struct Trace<'w> {
    probe: Probe<'w>,
    wave: PathWave,
    samples: [Sample; 1],
    seen: [SampleResult; 1],
    recorder: Recorder,
}

/// How a path goes on from a vertex.
enum Step {
    Cancelled,
    Ended,
    GoesOn(RayKind, Chosen),
}

impl Trace<'_> {
    /// Records the ray that the path is about to follow.
    fn begin(&mut self, kind: RayKind, chosen: Option<Chosen>) {
        let path = &self.wave.paths[0];
        let ray = TracedRay {
            bounce: path.bounce,
            weight: path.throughput,
            reach: path.reach(&self.samples[0]),
            absorption: path.absorption,
            chosen,
            ..TracedRay::new(&path.ray, kind, self.recorder.current())
        };
        self.recorder.begin(ray);
    }

    /// Follows the path to its next surface and on from there.
    fn bounce(&mut self) -> Step {
        let Self {
            probe,
            wave,
            samples,
            seen,
            recorder,
        } = self;
        let world = probe.world;
        let mut path = wave.paths[0];
        let hits = trace_rays(probe, wave, samples, seen);
        let nearest = wave.nearest[0].get(0);
        match classify_hit(probe, &mut path, &samples[0], nearest) {
            PathHit::Nothing(radiance) => {
                let screen = samples[0].screen;
                let missed = RayEnd::Missed {
                    radiance,
                    densities: path.densities_of(&world.sky),
                    missing: missing_around(world, &path.ray, path.bounce, screen),
                };
                recorder.end(missed, path.of_nothing(world, radiance));
                return Step::Ended;
            }
            PathHit::Light {
                number,
                light,
                distance,
                radiance,
                weight,
            } => {
                let densities = path.chosen.map(|chosen| Densities {
                    by_light: chosen.density_of(world, (number, &light)),
                    by_path: chosen.density,
                    weight,
                });
                let hit = LightHit {
                    light: number,
                    t: distance,
                    transmitted: transmitted(path.absorption, distance),
                    radiance,
                    densities,
                };
                recorder.end(RayEnd::Light(hit), path.throughput * radiance * weight);
                return Step::Ended;
            }
            PathHit::Surface(_) => {}
        }
        let vertices = hits.vertices(world, wave, samples);
        let vertices = Vertices::collect(&vertices);
        self.surface(&vertices)
    }

    /// Records the surface that the path met, and continues the path from there.
    fn surface(&mut self, vertices: &[Vertices<'_, '_>]) -> Step {
        let world = self.probe.world;
        let path = self.wave.paths[0];
        let vertex = &vertices[0].all()[0];
        let Vertex {
            nearest,
            point,
            material,
            bsdf,
        } = vertex;
        let mut shading = shading(
            world,
            (&path.ray, path.absorption),
            *nearest,
            point,
            material,
        );
        shading.mirror = bsdf.mirror;
        if shading.lit {
            (shading.emission, shading.densities) = emission(world, &path, vertex);
        }
        if self.lights(vertices, &mut shading).is_none() {
            return Step::Cancelled;
        }
        if shading.lit && samples_emitters(&self.probe, vertex, path.bounce) {
            self.emitting_object(vertices, &mut shading);
            self.sky(vertices, &mut shading);
        }
        let Self {
            probe,
            wave,
            samples,
            seen,
            recorder,
        } = self;
        add_caustics(probe, vertices, &mut wave.sums, path.bounce);
        shading.caustics = wave.sums[0].of_photons;
        let numbers = wave.draws.four(Purpose::Bounce, world.level)[0];
        let by_lobes = vertices[0].sample(world.level, &numbers);
        let batch = (&vertices[0], &numbers, &by_lobes);
        let departure = shade_and_continue(
            probe,
            batch,
            0,
            &wave.sums[0],
            &mut wave.paths[0],
            &samples[0],
        );
        seen[0].radiance += departure.arriving;
        shading.radiance = departure.radiance;
        shading.stop = stop(departure.continuation).filter(|_| bsdf.can_go_on());
        recorder.end(RayEnd::Surface(shading), departure.arriving);
        let component = bsdf.component(numbers.lane(0)[2]);
        match (departure.continuation, departure.next, component) {
            (Continuation::Cancelled, ..) => Step::Cancelled,
            (Continuation::Goes { survival }, Some(next), Some(component)) => {
                let chosen = Chosen {
                    chance: bsdf.chance(component),
                    density: next.chosen.map(|chosen| chosen.density),
                    factor: next.weight,
                    survival,
                };
                Step::GoesOn(kind(&path, vertex, component, &samples[0]), chosen)
            }
            _ => Step::Ended,
        }
    }

    /// Adds all lights; `None` if cancelled.
    fn lights(&mut self, vertices: &[Vertices<'_, '_>], shading: &mut Shading) -> Option<()> {
        let world = self.probe.world;
        for (place, number) in world.many_lights.others().enumerate() {
            if place % 16 == 15 && (self.probe.cancelled)() {
                return None;
            }
            let Self {
                probe, wave, seen, ..
            } = self;
            let sampling = (&mut wave.draws, &mut wave.of_lights);
            add_light(probe, number, vertices, &mut wave.sums, sampling, seen);
            let purpose = Purpose::Light(number as u32);
            self.light((number, 1.0), purpose, &vertices[0], shading);
        }
        if world.many_lights.is_empty() {
            return Some(());
        }
        let Self {
            probe, wave, seen, ..
        } = self;
        let sampling = (&mut wave.draws, &mut wave.of_lights);
        add_one_of_many(probe, vertices, &mut wave.sums, sampling, seen);
        let numbers = wave.draws.four(Purpose::ManyLights, world.level)[0];
        if let [Some(chosen), ..] = choose_light(world, &vertices[0], &numbers, ONE) {
            self.light(chosen, Purpose::ManyLights, &vertices[0], shading);
        }
        Some(())
    }

    /// Lists the light that was added last, with the probability of its choice; the numbers for a purpose
    /// choose a place on it.
    fn light(
        &mut self,
        chosen: (usize, f64),
        purpose: Purpose,
        vertices: &Vertices<'_, '_>,
        shading: &mut Shading,
    ) {
        let Self {
            probe,
            wave,
            recorder,
            ..
        } = self;
        let level = probe.world.level;
        let bounce = wave.draws.node;
        let [u, v, ..] = wave.draws.four(purpose, level)[0].lane(0);
        let lights = probe.world.lights();
        let mut reflected = wave.of_lights.reflected(lights);
        let added = reflected.next().filter(|_| shading.lit);
        let added = added.map_or(Rgb::ZERO, |(_, light)| light);
        let vertex = &vertices.all()[0];
        recorder.list(shading, added, |_| {
            light_term(probe, chosen, [u, v], (vertex, bounce), added)
        });
    }

    /// Adds and lists the object that emits light which the path samples, if there is one.
    fn emitting_object(&mut self, vertices: &[Vertices<'_, '_>], shading: &mut Shading) {
        let Self {
            probe, wave, seen, ..
        } = self;
        let world = probe.world;
        if world.emitters.is_empty() {
            return;
        }
        let sampling = (&mut wave.draws, &mut wave.of_emitters);
        let sums = &mut wave.sums;
        add_emitting_objects(probe, (vertices, &[ONE]), sums, sampling, seen);
        let numbers = wave.draws.four(Purpose::Emitter, world.level)[0];
        let (choices, aimed) = aim_at_object(world, &vertices[0], &numbers, ONE);
        if choices.lanes & ONE != 0 {
            let (object, _) = choices.parts[0];
            let arrival = wave.of_emitters.of_objects(world).next();
            let vertex = &vertices[0].all()[0];
            shading
                .emitters
                .push(emitter_term(Some(object), vertex, &aimed, arrival));
        }
    }

    /// Adds and lists the environment, if the path samples it.
    fn sky(&mut self, vertices: &[Vertices<'_, '_>], shading: &mut Shading) {
        let Self {
            probe, wave, seen, ..
        } = self;
        let world = probe.world;
        if world.sky.is_unsampled() {
            return;
        }
        let sampling = (&mut wave.draws, &mut wave.of_emitters);
        add_sky(probe, (vertices, &[ONE]), &mut wave.sums, sampling, seen);
        let numbers = wave.draws.four(Purpose::Sky, world.level)[0];
        let (lanes, aimed) = aim_at_sky(world, &vertices[0], &numbers, ONE);
        if lanes & ONE != 0 {
            let arrival = wave.of_emitters.of_sky(world).next();
            let vertex = &vertices[0].all()[0];
            shading
                .emitters
                .push(emitter_term(None, vertex, &aimed, arrival));
        }
    }
}

/// Describes a light at a vertex at a bounce, given the probability of its choice, the place at which it
/// is sampled, and what it adds. `None` for ambient light.
fn light_term(
    probe: &Probe<'_>,
    (number, chance): (usize, f64),
    place: [f64; 2],
    (vertex, bounce): (&Vertex<'_>, u32),
    added: Rgb,
) -> Option<LightTerm> {
    let Vertex {
        point,
        material,
        bsdf,
        ..
    } = vertex;
    let world = probe.world;
    let lit = LitPoint {
        world,
        point,
        material,
    };
    let light = &world.lights()[number];
    let scattered = |toward| {
        let scattered = bsdf.lobes.scatter(point, toward);
        scattered.value + bsdf.lobes.highlight(point, toward)
    };
    let reflected = |to_light: &LightGeometry<f64>| light.scale * scattered(to_light.toward.into());
    let from = point.surface.point;
    let chosen = light_sphere(light).and_then(|sphere| sphere.choose(from, place));
    let mut term = lit.term(number, chosen, reflected, added)?;
    term.chance = chance;
    if probe.is_by_photons(light) && term.transmittance.is_some_and(|share| share < 1.0) {
        term.transmittance = Some(0.0);
        term.dark = Some(UnlitReason::Blocked);
    }
    let Some(sphere) = luminous_sphere(light) else {
        return Some(term);
    };
    // Falloff does not apply to lights with a size.
    [term.radial, term.spot] = [1.0; 2];
    term.arriving = sphere.irradiance(from);
    let Some(chosen) = chosen else {
        term.arriving = Rgb::ZERO;
        if term.dark.is_some_and(|dark| dark != UnlitReason::UnlitSide) {
            term.dark = Some(UnlitReason::AtThePoint);
        }
        return Some(term);
    };
    let scattered = bsdf.lobes.scatter(point, chosen.toward.into());
    let by_path = density_of(probe, bsdf, scattered, bounce);
    let by_light = chance * sphere.density(from);
    term.densities = Some(Densities::for_light(by_light, by_path));
    if term.dark == Some(UnlitReason::NotReflected) && is_hidden(world, vertex, &sphere, chosen) {
        term.dark = Some(UnlitReason::Hidden);
    }
    Some(term)
}

/// Whether another light with a size lies before a point of one.
fn is_hidden(
    world: &World,
    vertex: &Vertex<'_>,
    sphere: &SphereLight,
    chosen: Incoming<f64>,
) -> bool {
    let ray = vertex.point.leave(chosen.toward.into());
    let hides = |place: Vector<f64>| world.sphere_lights.hide(sphere, &ray, place.into());
    chosen.source.is_some_and(hides)
}

/// Describes an emitter sampled at a vertex, given what arrived if a shadow ray was traced; without an
/// object the environment.
fn emitter_term(
    object: Option<u32>,
    vertex: &Vertex<'_>,
    aimed: &Aimed,
    arrival: Option<EmitterArrival>,
) -> EmitterTerm {
    let toward = aimed.rays.direction.get(0);
    let reflected = aimed.reflected.get(0);
    let cosine = vertex.point.normal.dot(toward);
    let emitted = arrival.and_then(|arrival| arrival.emitted);
    let radiance = arrival.map_or(Rgb::ZERO, |arrival| arrival.reflected);
    let dark = if radiance != Rgb::ZERO {
        None
    } else if cosine <= 0.0 {
        Some(UnlitReason::FacesAway)
    } else if reflected == Rgb::ZERO {
        Some(UnlitReason::NotReflected)
    } else if emitted.is_none() {
        Some(UnlitReason::Blocked)
    } else {
        Some(UnlitReason::SwitchedOff)
    };
    EmitterTerm {
        object,
        toward,
        distance: arrival.map_or(f64::INFINITY, |arrival| arrival.distance),
        cosine,
        emitted,
        reflected,
        densities: Densities::for_light(aimed.by_light.0[0], aimed.by_path.0[0]),
        radiance,
        dark,
    }
}

/// What the ray is by which a path goes on from a vertex by a component.
fn kind(path: &Path, vertex: &Vertex<'_>, component: Component, sample: &Sample) -> RayKind {
    let Vertex { point, bsdf, .. } = vertex;
    match component {
        Component::Lobes(choice) if bsdf.lobes.is_diffuse(choice) => RayKind::Diffuse,
        Component::Lobes(_) => RayKind::Glossy,
        Component::Mirror => RayKind::Mirror,
        Component::Boundary(choice) => {
            let facet = bsdf.facet(point, sample.sampler, path.bounce);
            let refracted = |choice| bsdf.refracted(&path.ray, (point, facet), choice);
            if refracted(choice).is_some() {
                RayKind::Refraction
            } else if refracted(1.0).is_some() {
                RayKind::Boundary
            } else {
                RayKind::TotalReflection
            }
        }
    }
}

/// Why a path ends.
fn stop(continuation: Continuation) -> Option<Stop> {
    match continuation {
        Continuation::Goes { .. } | Continuation::Cancelled => None,
        Continuation::Nowhere => Some(Stop::Nowhere),
        Continuation::Depth => Some(Stop::Depth),
        Continuation::Budget => Some(Stop::Budget),
        Continuation::Overflow => Some(Stop::Overflow),
        Continuation::Roulette { survival } => Some(Stop::Roulette { survival }),
    }
}
