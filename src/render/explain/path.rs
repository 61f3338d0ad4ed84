//! The rays of a path: the integrator's steps run for one path alone, and what each returns is
//! recorded.

use super::kind::RayKind;
use super::lights::Lit;
use super::record::{
    Chosen, EmitterTerm, LightHit, LightTerm, RayEnd, Shading, Stop, TracedRay, Unlisted,
    UnlitReason,
};
use super::surface::{boundary, missing_around, missing_at, surface_hit};
use crate::integrators::{
    Continuation, EmitterSample, Facing, Path, PathHit, PhotonMap, Probe, Sample, Vertex,
    place_on_light,
};
use crate::light::{Incoming, SphereLight, light_sphere, luminous_sphere};
use crate::material::{BsdfSample, Component, transmitted};
use crate::sampling::{Densities, Use};
use crate::world::World;
use geometry::lanes::Vector;
use scene::Rgb;

/// Traces a sample; returns its radiance and all rays, or `None` once `cancelled` returns true.
pub(super) fn record(
    world: &World,
    depth: u32,
    photons: Option<&PhotonMap>,
    sample: Sample,
    cancelled: impl Fn() -> bool,
) -> Option<(Rgb, Vec<TracedRay>)> {
    let mut recorder = Recorder {
        probe: Probe::new(world, depth, cancelled).with_photons(photons),
        sample,
        radiance: Rgb::ZERO,
        rays: Vec::new(),
        room: super::MOST_TERMS,
    };
    let mut path = Path::new(&sample);
    recorder.begin(&path, RayKind::Camera, None);
    loop {
        match recorder.step(&mut path) {
            Step::Cancelled => return None,
            Step::Ended => return Some((recorder.radiance, recorder.rays)),
            Step::GoesOn(kind, chosen) => recorder.begin(&path, kind, Some(chosen)),
        }
    }
}

struct Recorder<'w, C> {
    probe: Probe<'w, C>,
    sample: Sample,
    radiance: Rgb,
    rays: Vec<TracedRay>,
    /// Lights that may still be listed.
    room: usize,
}

/// How a path goes on from a vertex.
enum Step {
    Cancelled,
    Ended,
    GoesOn(RayKind, Chosen),
}

impl<C: Fn() -> bool> Recorder<'_, C> {
    /// Records the ray that a path is about to follow.
    fn begin(&mut self, path: &Path, kind: RayKind, chosen: Option<Chosen>) {
        self.rays.push(TracedRay {
            parent: self.rays.len().checked_sub(1),
            kind,
            bounce: path.bounce,
            weight: path.throughput,
            origin: path.ray.origin,
            direction: path.ray.direction,
            reach: path.reach(&self.sample),
            absorption: path.absorption,
            chosen,
            end: RayEnd::OverBudget,
            contribution: Rgb::ZERO,
        });
    }

    /// Ends the current ray.
    fn end(&mut self, end: RayEnd, contribution: Rgb) {
        self.radiance += contribution;
        if let Some(ray) = self.rays.last_mut() {
            ray.end = end;
            ray.contribution = contribution;
        }
    }

    /// Follows a path to its next vertex.
    fn step(&mut self, path: &mut Path) -> Step {
        let world = self.probe.world;
        let nearest = world.nearest(&path.ray, path.reach(&self.sample));
        match self.probe.meet(path, &self.sample, nearest) {
            PathHit::Nothing(radiance) => {
                let densities = path.densities_of(&self.probe.world.sky);
                let screen = self.sample.screen;
                let missing = missing_around(self.probe.world, &path.ray, path.bounce, screen);
                let weight = densities.map_or(1.0, |densities| densities.weight);
                let contribution = path.throughput * radiance * weight;
                let missed = RayEnd::Missed {
                    radiance,
                    densities,
                    missing,
                };
                self.end(missed, contribution);
                Step::Ended
            }
            PathHit::Light {
                number,
                light,
                distance,
                radiance,
                weight,
            } => {
                let hit = self.light_hit(path, (number, &light), (distance, radiance, weight));
                self.end(RayEnd::Light(hit), path.throughput * radiance * weight);
                Step::Ended
            }
            PathHit::Surface(nearest) => {
                let mut mapped = None;
                let (point, material) = world.arrive(&path.ray, nearest, &mut mapped);
                let vertex = Vertex::new(world, nearest, point, material);
                self.surface(path, &vertex)
            }
        }
    }

    fn light_hit(
        &self,
        path: &Path,
        (number, light): (u32, &SphereLight),
        (t, radiance, weight): (f64, Rgb, f64),
    ) -> LightHit {
        let world = self.probe.world;
        LightHit {
            light: number,
            t,
            transmitted: transmitted(path.absorption, t),
            radiance,
            densities: path.chosen.map(|chosen| Densities {
                by_light: chosen.density_of(world, (number, light)),
                by_path: chosen.density,
                weight,
            }),
        }
    }

    fn surface(&mut self, path: &mut Path, vertex: &Vertex<'_>) -> Step {
        let world = self.probe.world;
        let Vertex {
            nearest,
            point,
            material,
            bsdf,
        } = vertex;
        let lit = material.is_lit(point.side);
        let (emission, densities) = self.emission(path, vertex);
        let mut shading = Box::new(Shading {
            hit: surface_hit(world, &path.ray, *nearest, point),
            missing: missing_at(world, &path.ray, *nearest),
            lit,
            transmitted: transmitted(path.absorption, nearest.hit.t),
            emission,
            densities,
            ambient: Rgb::ZERO,
            lights: Vec::new(),
            unlisted: Unlisted::default(),
            emitters: Vec::new(),
            caustics: Rgb::ZERO,
            radiance: Rgb::ZERO,
            mirror: bsdf.mirror,
            boundary: boundary(&path.ray, point, material),
            stop: None,
            material: (*material).clone(),
        });
        let mut sum = Rgb::ZERO;
        for (listed, number) in world.many_lights.others().enumerate() {
            if listed % 16 == 15 && (self.probe.cancelled)() {
                return Step::Cancelled;
            }
            let place = place_on_light(number, path.bounce, self.sample.sampler);
            sum += self.light((number, 1.0, place), path, vertex, &mut shading);
        }
        if !world.many_lights.is_empty() {
            let numbers = self.sample.sampler.four(path.bounce, Use::ManyLights);
            let [u, v, ..] = numbers;
            let chosen = world.many_lights.choose(vertex.point_and_normal(), numbers);
            if let Some((number, chance)) = chosen {
                sum += self.light((number, chance, [u, v]), path, vertex, &mut shading);
            }
        }
        let mut contribution = Rgb::ZERO;
        if lit {
            let sampler = self.sample.sampler;
            let mut local = emission + sum;
            if self.probe.photon_map.is_some() {
                shading.caustics = self.probe.caustics(vertex, path.bounce);
                local += shading.caustics;
            }
            if self.probe.asks(vertex, path.bounce) {
                local += self.probe.ask(vertex, path.bounce, sampler, |asked| {
                    shading.emitters.push(asked_for(vertex, &asked));
                });
            }
            shading.radiance = local;
            contribution = path.throughput * shading.radiance;
        }
        let sampler = self.sample.sampler;
        let numbers = sampler.four(path.bounce, Use::Bounce);
        let next = vertex.sample(&path.ray, numbers, (sampler, path.bounce));
        let kind = self.kind(path, vertex, numbers);
        let onward = self.probe.onward(path, next, numbers);
        let can_go_on = bsdf.can_go_on();
        shading.stop = stop(onward).filter(|_| can_go_on);
        self.end(RayEnd::Surface(shading), contribution);
        match (onward, next, kind) {
            (Continuation::Cancelled, ..) => Step::Cancelled,
            (Continuation::Goes { survival }, Some(next), Some((kind, chance))) => {
                let BsdfSample { weight, chosen, .. } = next;
                Step::GoesOn(
                    kind,
                    Chosen {
                        chance,
                        density: chosen.map(|chosen| chosen.density),
                        factor: weight,
                        survival,
                    },
                )
            }
            _ => Step::Ended,
        }
    }

    /// The emission of a surface as far as it counts, with the densities that this depends on.
    fn emission(&self, path: &Path, vertex: &Vertex<'_>) -> (Rgb, Option<Densities>) {
        let Vertex {
            point, material, ..
        } = vertex;
        if !material.is_lit(point.side) || material.emission == Rgb::ZERO {
            return (Rgb::ZERO, None);
        }
        let densities = self.probe.densities_at(path, vertex);
        let weight = densities.map_or(1.0, |densities| densities.weight);
        (weight * material.emission, densities)
    }

    /// Records a light at a vertex, the probability of its choice and the place at which it is sampled,
    /// and returns what it adds.
    fn light(
        &mut self,
        asked: (usize, f64, [f64; 2]),
        path: &Path,
        vertex: &Vertex<'_>,
        shading: &mut Shading,
    ) -> Rgb {
        let (number, chance, place) = asked;
        let added = if shading.lit {
            let chosen = (number, chance);
            self.probe.light_of(chosen, vertex, path.bounce, place)
        } else {
            Rgb::ZERO
        };
        if self.room == 0 {
            shading.unlisted.lights += 1;
            shading.unlisted.radiance += added;
            return added;
        }
        if let Some(term) = self.term(asked, path, vertex, added) {
            shading.lights.push(term);
            self.room -= 1;
        }
        added
    }

    fn term(
        &self,
        (number, chance, place): (usize, f64, [f64; 2]),
        path: &Path,
        vertex: &Vertex<'_>,
        added: Rgb,
    ) -> Option<LightTerm> {
        let Vertex {
            point,
            material,
            bsdf,
            ..
        } = vertex;
        let world = self.probe.world;
        let lit = Lit {
            world,
            point,
            material,
        };
        let light = &world.lights()[number];
        let scattered = |toward| {
            let scattered = bsdf.lobes.scatter(point, toward);
            scattered.value + bsdf.lobes.highlight(point, toward)
        };
        let reflected = |facing: &Facing<f64>| light.scale * scattered(facing.toward.into());
        let from = point.surface.point;
        let chosen = light_sphere(light).and_then(|sphere| sphere.choose(from, place));
        let mut term = lit.term(number, chosen, reflected, added)?;
        term.chance = chance;
        if self.probe.is_by_photons(light) && term.transmittance.is_some_and(|share| share < 1.0) {
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
        let by_path = self.probe.density_of(bsdf, scattered, path.bounce);
        let by_light = chance * sphere.density(from);
        term.densities = Some(Densities::for_light(by_light, by_path));
        if term.dark == Some(UnlitReason::NotReflected) && self.is_hidden(vertex, &sphere, chosen) {
            term.dark = Some(UnlitReason::Hidden);
        }
        Some(term)
    }

    /// Whether another light with a size lies before a point of one.
    fn is_hidden(&self, vertex: &Vertex<'_>, sphere: &SphereLight, chosen: Incoming<f64>) -> bool {
        let ray = vertex.point.leave(chosen.toward.into());
        let sphere_lights = &self.probe.world.sphere_lights;
        let hides = |place: Vector<f64>| sphere_lights.hide(sphere, &ray, place.into());
        chosen.source.is_some_and(hides)
    }

    /// What the ray is that a path chooses next, and the probability of its component.
    fn kind(
        &self,
        path: &Path,
        vertex: &Vertex<'_>,
        [_, _, choice, _]: [f64; 4],
    ) -> Option<(RayKind, f64)> {
        let Vertex { point, bsdf, .. } = vertex;
        let component = bsdf.component(choice)?;
        let kind = match component {
            Component::Lobes(choice) if bsdf.lobes.is_diffuse(choice) => RayKind::Diffuse,
            Component::Lobes(_) => RayKind::Glossy,
            Component::Mirror => RayKind::Mirror,
            Component::Boundary(choice) => {
                let facet = bsdf.facet(point, self.sample.sampler, path.bounce);
                if bsdf.refracted(&path.ray, (point, facet), choice).is_some() {
                    RayKind::Refraction
                } else if bsdf.refracted(&path.ray, (point, facet), 1.0).is_some() {
                    RayKind::Boundary
                } else {
                    RayKind::TotalReflection
                }
            }
        };
        Some((kind, bsdf.chance(component)))
    }
}

/// Records an emitter sampled at a vertex.
fn asked_for(vertex: &Vertex<'_>, asked: &EmitterSample) -> EmitterTerm {
    let cosine = vertex.point.normal.dot(asked.toward);
    let dark = if asked.radiance != Rgb::ZERO {
        None
    } else if cosine <= 0.0 {
        Some(UnlitReason::FacesAway)
    } else if asked.reflected == Rgb::ZERO {
        Some(UnlitReason::NotReflected)
    } else if asked.emitted.is_none() {
        Some(UnlitReason::Blocked)
    } else {
        Some(UnlitReason::SwitchedOff)
    };
    EmitterTerm {
        object: asked.object,
        toward: asked.toward,
        distance: asked.distance,
        cosine,
        emitted: asked.emitted,
        reflected: asked.reflected,
        densities: asked.densities,
        radiance: asked.radiance,
        dark,
    }
}

/// Why a path ends.
fn stop(onward: Continuation) -> Option<Stop> {
    match onward {
        Continuation::Goes { .. } | Continuation::Cancelled => None,
        Continuation::Nowhere => Some(Stop::Nowhere),
        Continuation::Depth => Some(Stop::Depth),
        Continuation::Budget => Some(Stop::Budget),
        Continuation::Overflow => Some(Stop::Overflow),
        Continuation::Roulette { survival } => Some(Stop::Roulette { survival }),
    }
}
