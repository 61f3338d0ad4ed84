//! The rays of Whitted ray tracing: the integrator's own stages run for one sample, and what they
//! leave in the wave is read between them.

use glam::DVec3;

use super::lights::LitPoint;
use super::ray_kind::RayKind;
use super::record::{RayEnd, Shading, Stop, TracedRay};
use super::recorder::Recorder;
use super::surface::{missing_around, shading};
use crate::integrators::whitted::{Secondary, add_light, branch, trace_front};
use crate::integrators::{LightGeometry, Probe, RayState, Sample, SampleResult, WhittedWave};
use crate::light::light_sphere;
use crate::material::reflectance;
use crate::world::World;
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
    cancelled: &dyn Fn() -> bool,
) -> Option<(Rgb, Vec<TracedRay>)> {
    let mut trace = Trace {
        probe: Probe::new(world, depth, cancelled),
        wave: WhittedWave::default(),
        samples: [sample],
        seen: [SampleResult::NOTHING],
        waiting: vec![Waiting {
            parent: None,
            kind: RayKind::Camera,
        }],
        recorder: Recorder::new(),
    };
    trace.wave.start(&trace.samples);
    while trace.step()? {}
    Some((trace.seen[0].radiance, trace.recorder.rays))
}

/// A wave of one sample, and its record.
struct Trace<'w> {
    probe: Probe<'w>,
    wave: WhittedWave<'w>,
    samples: [Sample; 1],
    seen: [SampleResult; 1],
    /// What the rays are that the wave has yet to trace: the pending ones, then the one in the next
    /// front.
    waiting: Vec<Waiting>,
    recorder: Recorder,
}

impl Trace<'_> {
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
        trace_front(probe, wave, samples, seen);
        let waiting = self.waiting.pop();
        let state = next.1;
        let reach = wave.front.rays[0].ends.0[0];
        self.recorder.begin(traced(next, waiting?, reach));
        match self.wave.nearest[0].get(0) {
            None => self.miss(&state),
            Some(_) => self.shade(&state)?,
        }
        assert!(
            {
                let last = self.recorder.rays.last();
                let added = before + last.map_or(Rgb::ZERO, |ray| ray.contribution);
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
            self.recorder.begin(traced(next, waiting, f64::INFINITY));
        }
    }

    fn miss(&mut self, state: &RayState) {
        let world = self.probe.world;
        let ray = self.wave.front.rays[0].ray(0);
        let screen = self.samples[0].screen;
        let radiance = world.around(&ray, state.bounce, screen);
        self.recorder.end(
            RayEnd::Missed {
                radiance,
                densities: None,
                missing: missing_around(world, &ray, state.bounce, screen),
            },
            state.weight * radiance,
        );
        branch(&self.probe, &mut self.wave, &self.samples, &mut self.seen);
    }

    fn shade(&mut self, state: &RayState) -> Option<()> {
        let Self { probe, wave, .. } = self;
        let world = probe.world;
        let nearest = wave.nearest[0].get(0)?;
        let material = wave.shaded[0].material.get(&wave.mapped)?;
        let ray = wave.front.rays[0].ray(0);
        let point = wave.hit_points[0].point(&wave.front.rays[0], 0);
        let shown = if material.is_lit(point.side) {
            Rgb::ONE
        } else {
            Rgb::ZERO
        };
        let mut shading = shading(world, (&ray, state.absorption), nearest, &point, material);
        shading.emission = shown * material.emission;
        shading.ambient = shown * material.ambience(world.ambient);
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
        shading.radiance = wave.shaded[0].radiance;
        let contribution = wave.shaded[0].weight * shading.radiance;
        let before = wave.trees[0].pending.len();
        branch(probe, wave, samples, seen);
        let asks = shading.mirror != Rgb::ZERO || shading.boundary.is_some();
        if asks && state.bounce == probe.depth {
            shading.stop = Some(Stop::Depth);
        }
        let parent = self.recorder.current();
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
        self.recorder.end(RayEnd::Surface(shading), contribution);
        Some(())
    }

    /// Adds a light to the hit of the current ray.
    fn light(&mut self, number: usize, state: &RayState, shading: &mut Shading) {
        let Self {
            probe,
            wave,
            samples,
            seen,
            recorder,
            ..
        } = self;
        let before = wave.shaded[0].radiance;
        add_light(probe, wave, number, samples, seen);
        let difference = wave.shaded[0].radiance - before;
        recorder.list(shading, difference, |shading| {
            let point = wave.hit_points[0].point(&wave.front.rays[0], 0);
            let material = &shading.material;
            let lit = LitPoint {
                world: probe.world,
                point: &point,
                material,
            };
            let sphere = light_sphere(&probe.world.lights()[number]);
            let from = point.surface.point;
            let sampler = samples[0].sampler;
            let chosen = sphere.and_then(|sphere| state.choose((number, &sphere), from, sampler));
            let reflected = |to_light: &LightGeometry<f64>| {
                let toward = DVec3::from(to_light.toward);
                let halfway = || point.normal.dot((toward + point.view).normalize());
                reflectance(material, to_light.cosine, to_light.mirrored, halfway)
            };
            let added = match (wave.unblocked.first(), wave.transmittances.first()) {
                (Some(_), Some(0.0)) => Rgb::ZERO,
                (Some((_, unblocked)), Some(transmittance)) => transmittance * unblocked,
                // Nothing was added, or light without shadows.
                _ => difference,
            };
            lit.term(number, chosen, reflected, added)
        });
    }
}

/// A ray that has not ended.
fn traced((ray, state): (Ray, RayState), waiting: Waiting, reach: f64) -> TracedRay {
    TracedRay {
        bounce: state.bounce,
        weight: state.weight,
        reach,
        absorption: state.absorption,
        ..TracedRay::new(&ray, waiting.kind, waiting.parent)
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
