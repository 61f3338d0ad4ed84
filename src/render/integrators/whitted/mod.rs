//! Recursive ray tracing (Whitted, "An Improved Illumination Model for Shaded Display", 1980).

mod branch;
mod wave;

pub(crate) use branch::Secondary;
pub(crate) use wave::{RayState, WhittedWave};

use std::borrow::Cow;

use glam::DVec3;

use super::direct::{LightGeometry, ShadingPoints, Shadow, sent_back};
use super::hit_material::HitMaterial;
use super::light_component::LightComponent;
use super::probe::{Probe, Sample, SampleResult};
use crate::light::{Incoming, SphereLight, light_sphere, lights};
use crate::material::{reflectance, transmitted};
use crate::sampling::{Purpose, Sampler};
use crate::world::{Dependencies, Nearest, Occlusion, World};
use geometry::lanes::{Simd, WIDTH, bits, dispatch};
use scene::{Light, Rgb};
use wave::ShadedHit;

/// Computes the radiance along camera rays. The rays of each are traced depth first, reflection
/// before refraction; those beyond the ray budget contribute nothing.
///
/// Many samples are traced at once, one ray of each at a time, to form packets of rays and
/// shadow rays. The order of summation within each sample does not depend on the others.
pub(crate) fn by_whitted<'w>(
    probe: &mut Probe<'w>,
    wave: &mut WhittedWave<'w>,
    samples: &[Sample],
    seen: &mut Vec<SampleResult>,
) {
    wave.start(samples);
    seen.resize(seen.len() + samples.len(), SampleResult::NOTHING);
    while wave.advance(&mut probe.counts) && !(probe.cancelled)() {
        trace_front(probe, wave, samples, seen);
        for number in 0..probe.world.lights().len() {
            // Each light may take as many rays as there are samples.
            if 0 < number && (probe.cancelled)() {
                break;
            }
            if probe.component.light_anywhere(number) {
                add_light(probe, wave, number, samples, seen);
            }
        }
        branch(probe, wave, samples, seen);
    }
    for (seen, tree) in seen.iter_mut().zip(&wave.trees) {
        seen.rays += tree.traced;
    }
}

/// Finds the hits of the front's rays and shades them without lights.
pub(crate) fn trace_front<'w>(
    probe: &Probe<'w>,
    wave: &mut WhittedWave<'w>,
    samples: &[Sample],
    seen: &mut [SampleResult],
) {
    let world = probe.world;
    world.nearest_each(&wave.front.rays, &mut wave.nearest);
    world.hit_points_each(&wave.front.rays, &wave.nearest, &mut wave.hit_points);
    wave.shade(world, probe.component, samples, seen);
    wave.blockers.resize(world.lights().len(), None);
}

/// Adds the light of the light with this index that the hits reflect; lights must be added in
/// file order.
pub(crate) fn add_light(
    probe: &mut Probe<'_>,
    wave: &mut WhittedWave<'_>,
    number: usize,
    samples: &[Sample],
    seen: &mut [SampleResult],
) {
    let world = probe.world;
    let light = &world.lights()[number];
    wave.unblocked.clear();
    wave.shadows.clear();
    dispatch!(world.level, simd => {
        for packet in 0..wave.front.rays.len() {
            wave.light_packet(simd, packet, (number, light), samples, seen);
        }
    });
    probe.counts.add_shadow_rays(wave.unblocked.len() as u64);
    world.transmittance_each(
        &wave.shadows,
        Occlusion::ByMaterial,
        &mut wave.blockers[number],
        &mut probe.crossed,
        &mut wave.transmittances,
    );
    let shadow_rays = wave.unblocked.iter().zip(&wave.transmittances);
    for (&(hit, unblocked), &transmittance) in shadow_rays.clone() {
        // Occluded light adds nothing, even if infinite.
        if transmittance != 0.0 {
            wave.shaded[hit].radiance += transmittance * unblocked;
        }
    }
    // Empty unless dependencies are recorded.
    for ((&(hit, _), &transmittance), &touched) in shadow_rays.zip(&probe.crossed.touched) {
        let seen = &mut seen[wave.front.states[hit].tree];
        seen.rays += 1;
        seen.touched |= touched;
        if transmittance != 0.0 {
            seen.touched |= Dependencies::light(number);
        }
    }
}

/// Adds the radiance of the hits to `seen` and prepares the next front.
pub(crate) fn branch(
    probe: &Probe<'_>,
    wave: &mut WhittedWave<'_>,
    samples: &[Sample],
    seen: &mut [SampleResult],
) {
    dispatch!(probe.world.level, simd => {
        for packet in 0..wave.front.rays.len() {
            let rules = (probe.depth, probe.component, probe.world.gloss);
            wave.branch_packet(simd, packet, rules, samples, seen);
        }
    });
}

impl<'w> WhittedWave<'w> {
    /// Shades the hits of the front's rays.
    fn shade(
        &mut self,
        world: &'w World,
        component: LightComponent,
        samples: &[Sample],
        seen: &mut [SampleResult],
    ) {
        self.shaded.clear();
        self.mapped.clear();
        for (number, state) in self.front.states.iter().enumerate() {
            let seen = &mut seen[state.tree];
            let (packet, lane) = (&self.front.rays[number / WIDTH], number % WIDTH);
            let hit_points = &mut self.hit_points[number / WIDTH];
            let mut hit = ShadedHit {
                material: HitMaterial::Nothing,
                weight: state.weight,
                radiance: Rgb::ZERO,
            };
            if let Some(nearest) = self.nearest[number / WIDTH].get(lane) {
                if state.bounce == 0 {
                    seen.object = nearest.object;
                }
                seen.touched |= Dependencies::object(nearest.object);
                let material = hit_points.material(world, nearest, (packet, lane));
                let side = hit_points.side(lane);
                hit.weight = state.through(nearest);
                if material.is_lit(side) && component.glow(state.bounce) {
                    hit.radiance = material.glow(world.ambient);
                }
                hit.material = match material {
                    Cow::Borrowed(material) => HitMaterial::Plain(material),
                    Cow::Owned(material) => {
                        self.mapped.push(material);
                        HitMaterial::Mapped(self.mapped.len() - 1)
                    }
                };
            } else if component.glow(state.bounce) {
                let screen = samples[state.tree].screen;
                let around = world.around(&packet.ray(lane), state.bounce, screen);
                seen.radiance += state.weight * around;
            }
            self.shaded.push(hit);
        }
    }

    /// Adds shadow rays from a packet's points to a light.
    ///
    /// Rejected: computing the reflected light in lanes, from materials gathered into rows (no less time).
    #[inline(always)]
    fn light_packet<S: Simd>(
        &mut self,
        simd: S,
        packet: usize,
        (number, light): (usize, &Light),
        samples: &[Sample],
        seen: &mut [SampleResult],
    ) {
        let hit_points = &self.hit_points[packet];
        if hit_points.is_empty() {
            return;
        }
        let rays = &self.front.rays[packet].rays;
        let first = packet * WIDTH;
        let points = ShadingPoints {
            surface: hit_points.surface.load(simd),
            normal: hit_points.normal.load(simd),
            view: -rays.direction.load(simd),
        };
        let Some(mut incoming) = lights::incoming(light, points.surface.point) else {
            return;
        };
        let last = self.shaded.len().min(first + WIDTH);
        let hit = &mut self.shaded[first..last];
        if let Some(sphere) = light_sphere(light) {
            for (lane, (hit, state)) in hit.iter().zip(&self.front.states[first..]).enumerate() {
                if let HitMaterial::Nothing = hit.material {
                    continue;
                }
                let sampler = samples[state.tree].sampler;
                let point = hit_points.surface.point.get(lane);
                if let Some(chosen) = state.choose((number, &sphere), point, sampler) {
                    incoming.put(lane, chosen);
                }
            }
        }
        let to_light = LightGeometry::new(&points, light, incoming);
        let mut lit = bits::<S>(to_light.is_lit) & self.front.rays[packet].lanes;
        while lit != 0 {
            let lane = lit.trailing_zeros() as usize % WIDTH;
            lit &= lit - 1;
            let hit = &mut hit[lane];
            let material = match hit.material.get(&self.mapped) {
                Some(material) if material.is_lit(hit_points.side(lane)) => material,
                _ => continue,
            };
            let halfway = || {
                let view = -rays.direction.get(lane);
                let toward: DVec3 = to_light.toward.lane(lane);
                hit_points.normal.get(lane).dot((toward + view).normalize())
            };
            let reflected = reflectance(
                material,
                to_light.cosine[lane],
                to_light.mirrored[lane],
                halfway,
            );
            let place = hit_points.surface.point.get(lane);
            let toward = || to_light.toward.lane(lane);
            let Some(unblocked) = sent_back(light, place, toward, reflected) else {
                continue;
            };
            match &to_light.shadow {
                None => {
                    seen[self.front.states[first + lane].tree].touched |=
                        Dependencies::light(number);
                    hit.radiance += unblocked;
                }
                Some(Shadow { rays, ends }) => {
                    self.unblocked.push((first + lane, unblocked));
                    self.shadows.push(&rays.ray(lane), ends[lane]);
                }
            }
        }
    }
}

impl RayState {
    /// Samples a light with a size, given its index, from a point; without random numbers `None`,
    /// which stands for its centre.
    pub(crate) fn choose(
        &self,
        (number, sphere): (usize, &SphereLight),
        point: DVec3,
        sampler: Sampler,
    ) -> Option<Incoming<f64>> {
        let place = sampler.pair(self.node, Purpose::Light(number as u32))?;
        sphere.choose(point, place)
    }

    /// Weight of the radiance at a hit in the pixel.
    fn through(&self, nearest: Nearest) -> Rgb {
        self.weight * transmitted(self.absorption, nearest.hit.t)
    }
}
