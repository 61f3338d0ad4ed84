//! The rays of Whitted ray tracing: the integrator's own stages run for one sample, and what they
//! leave in the wave is read between them.

use super::kind::RayKind;
use super::lights::Lit;
use super::record::{RayEnd, Shading, Stop, TracedRay, Unlisted};
use super::surface::{boundary, missing_around, missing_at, surface_hit};
use crate::integrators::{Facing, Probe, RayState, Sample, SampleResult, Secondary, Wave};
use crate::light::light_sphere;
use crate::material::{mirror_weight, reflectance, transmitted};
use crate::world::World;
use glam::DVec3;

use geometry::Ray;
use scene::Rgb;

/// A ray that is yet to be traced.
#[derive(Clone, Copy)]
struct Waiting {
    parent: Option<usize>,
    kind: RayKind,
}

/// Traces a sample; returns its radiance and all rays, or `None` once `cancelled` returns true.
pub(super) fn record(
    world: &World,
    depth: u32,
    sample: Sample,
    cancelled: impl Fn() -> bool,
) -> Option<(Rgb, Vec<TracedRay>)> {
    let mut recorder = Recorder {
        probe: Probe::new(world, depth, cancelled),
        wave: Wave::default(),
        samples: [sample],
        seen: [SampleResult::NOTHING],
        waiting: vec![Waiting {
            parent: None,
            kind: RayKind::Camera,
        }],
        rays: Vec::new(),
        room: super::MOST_TERMS,
    };
    recorder.wave.start(&recorder.samples);
    while recorder.step()? {}
    Some((recorder.seen[0].radiance, recorder.rays))
}

struct Recorder<'w, C> {
    probe: Probe<'w, C>,
    wave: Wave<'w>,
    samples: [Sample; 1],
    seen: [SampleResult; 1],
    /// What the rays are that the wave has yet to trace: the pending ones, then the one in the next
    /// front.
    waiting: Vec<Waiting>,
    rays: Vec<TracedRay>,
    /// Lights that may still be listed.
    room: usize,
}

impl<C: Fn() -> bool> Recorder<'_, C> {
    /// Traces the next ray; returns whether there was one, and `None` if cancelled.
    fn step(&mut self) -> Option<bool> {
        let Self {
            probe,
            wave,
            samples,
            seen,
            ..
        } = self;
        if !wave.advance(&mut probe.counts) {
            self.give_up();
            return Some(false);
        }
        let next = (wave.front.rays[0].ray(0), wave.front.states[0]);
        let before = seen[0].radiance;
        probe.land(wave, samples, seen);
        let waiting = self.waiting.pop();
        let state = next.1;
        self.rays
            .push(traced(next, waiting?, wave.front.rays[0].ends.0[0]));
        match self.wave.nearest[0].get(0) {
            None => self.miss(&state),
            Some(_) => self.shade(&state)?,
        }
        debug_assert!(
            {
                let added = before + self.rays[self.rays.len() - 1].contribution;
                let now = self.seen[0].radiance;
                added == now || !now.is_finite()
            },
            "each ray adds to the sample once"
        );
        Some(true)
    }

    /// Records the rays that exceed the budget.
    fn give_up(&mut self) {
        let unseen = self.wave.trees[0].pending.iter().rev().copied();
        for (next, waiting) in unseen.zip(self.waiting.drain(..).rev()) {
            self.rays.push(traced(next, waiting, f64::INFINITY));
        }
    }

    fn miss(&mut self, state: &RayState) {
        let world = self.probe.world;
        let ray = self.wave.front.rays[0].ray(0);
        let screen = self.samples[0].screen;
        let radiance = world.around(&ray, state.bounce, screen);
        self.end(
            RayEnd::Missed {
                radiance,
                densities: None,
                missing: missing_around(world, &ray, state.bounce, screen),
            },
            state.weight * radiance,
        );
        self.probe
            .branch(&mut self.wave, &self.samples, &mut self.seen);
    }

    fn shade(&mut self, state: &RayState) -> Option<()> {
        let Self { probe, wave, .. } = self;
        let world = probe.world;
        let nearest = wave.nearest[0].get(0)?;
        let material = wave.arrived[0].found.material(&wave.mapped)?.clone();
        let ray = wave.front.rays[0].ray(0);
        let point = wave.landings[0].point(&wave.front.rays[0], 0);
        let lit = material.is_lit(point.side);
        let shown = if lit { Rgb::ONE } else { Rgb::ZERO };
        let mut shading = Box::new(Shading {
            hit: surface_hit(world, &ray, nearest, &point),
            missing: missing_at(world, &ray, nearest),
            lit,
            transmitted: transmitted(state.absorption, nearest.hit.t),
            emission: shown * material.emission,
            densities: None,
            ambient: shown * material.ambience(world.ambient),
            lights: Vec::new(),
            unlisted: Unlisted::default(),
            emitters: Vec::new(),
            caustics: Rgb::ZERO,
            radiance: Rgb::ZERO,
            mirror: mirror_weight(&material, point.side),
            boundary: boundary(&ray, &point, &material),
            stop: None,
            material,
        });
        for number in 0..world.scene.lights.len() {
            if 0 < number && (self.probe.cancelled)() {
                return None;
            }
            self.light(number, state, &mut shading);
        }
        let Self {
            probe,
            wave,
            samples,
            seen,
            ..
        } = self;
        shading.radiance = wave.arrived[0].radiance;
        let contribution = wave.arrived[0].weight * shading.radiance;
        let before = wave.trees[0].pending.len();
        probe.branch(wave, samples, seen);
        let asks = shading.mirror != Rgb::ZERO || shading.boundary.is_some();
        if asks && state.bounce == probe.depth {
            shading.stop = Some(Stop::Depth);
        }
        let parent = Some(self.rays.len() - 1);
        // The last one pushed is in the next front; without one it is a ray that was pending before.
        let pending = wave.trees[0].pending.get(before..);
        let pushed = pending.into_iter().flat_map(|pending| {
            let waiting = pending.iter().map(|(_, child)| child);
            waiting.chain(&wave.next.states)
        });
        self.waiting.extend(pushed.map(|child| Waiting {
            parent,
            kind: kind(child.node, state.node, &shading),
        }));
        self.end(RayEnd::Surface(shading), contribution);
        Some(())
    }

    /// Adds a light to the hit of the current ray.
    fn light(&mut self, number: usize, state: &RayState, shading: &mut Shading) {
        let Self {
            probe,
            wave,
            samples,
            seen,
            ..
        } = self;
        let before = wave.arrived[0].radiance;
        probe.light(wave, number, samples, seen);
        let after = wave.arrived[0].radiance;
        if self.room == 0 {
            shading.unlisted.lights += 1;
            shading.unlisted.radiance += after - before;
            return;
        }
        let point = wave.landings[0].point(&wave.front.rays[0], 0);
        let material = &shading.material;
        let lit = Lit {
            world: probe.world,
            point: &point,
            material,
        };
        let sphere = light_sphere(&probe.world.lights()[number]);
        let from = point.surface.point;
        let sampler = samples[0].sampler;
        let chosen = sphere.and_then(|sphere| state.choose((number, &sphere), from, sampler));
        let reflected = |facing: &Facing<f64>| {
            let toward = DVec3::from(facing.toward);
            let halfway = || point.normal.dot((toward + point.view).normalize());
            reflectance(material, facing.cosine, facing.mirrored, halfway)
        };
        let added = match (wave.asking.first(), wave.transmittances.first()) {
            (Some(_), Some(0.0)) => Rgb::ZERO,
            (Some((_, unblocked)), Some(transmittance)) => transmittance * unblocked,
            // Nothing was added, or light without shadows.
            _ => after - before,
        };
        let term = lit.term(number, chosen, reflected, added);
        self.room -= usize::from(term.is_some());
        shading.lights.extend(term);
    }

    /// Ends the current ray.
    fn end(&mut self, end: RayEnd, contribution: Rgb) {
        if let Some(ray) = self.rays.last_mut() {
            ray.end = end;
            ray.contribution = contribution;
        }
    }
}

/// A ray that has not ended.
fn traced((ray, state): (Ray, RayState), waiting: Waiting, reach: f64) -> TracedRay {
    TracedRay {
        parent: waiting.parent,
        kind: waiting.kind,
        bounce: state.bounce,
        weight: state.weight,
        origin: ray.origin,
        direction: ray.direction,
        reach,
        absorption: state.absorption,
        chosen: None,
        end: RayEnd::OverBudget,
        contribution: Rgb::ZERO,
    }
}

/// What the ray of a node is, given the node of its parent and where that ended.
fn kind(node: u32, parent: u32, shading: &Shading) -> RayKind {
    let total = shading.boundary.is_some_and(|boundary| boundary.total);
    // A mirror and a boundary that reflect into one direction share a ray.
    let mirrors = shading.mirror != Rgb::ZERO;
    match Secondary::of(node, parent) {
        Secondary::Refracted => RayKind::Refraction,
        Secondary::Mirrored if mirrors => RayKind::Mirror,
        Secondary::Boundary | Secondary::Mirrored if total => RayKind::TotalReflection,
        Secondary::Boundary | Secondary::Mirrored => RayKind::Boundary,
    }
}
