//! Path tracing (Kajiya, "The Rendering Equation", 1986): an unbiased estimate of radiance over up
//! to `depth` bounces, without ambient light. Next event estimation samples all lights at each
//! bounce; for a light with a size it is combined with BSDF sampling by multiple importance
//! sampling (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
//! 1995).

use glam::DVec3;

use super::bsdf::{Bsdf, BsdfSample};
use super::direct::shadow;
use super::frame::NO_OBJECT;
use super::lights::SphereLight;
use super::optics::transmitted;
use super::probe::{Point, Probe, RAY_BUDGET, Sample, Seen};
use super::sampler::{Sampler, Use};
use super::touched::Touched;
use crate::geometry::Ray;
use crate::geometry::lanes::Vector;
use crate::scene::{Light, Rgb};

/// Paths with a throughput below this are subject to Russian roulette.
const FAINT: f64 = 1.0 / 16.0;

/// The state of a path.
struct Path {
    ray: Ray,
    /// Weight of the incoming radiance in the pixel.
    throughput: Rgb,
    /// Absorption per unit of length up to the next hit.
    absorption: Rgb,
    /// The point of the last scattering and the probability density of the direction per steradian;
    /// `None` after mirrors and boundaries.
    chosen: Option<(DVec3, f64)>,
    bounce: u32,
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Estimates the radiance along a camera ray.
    pub(crate) fn by_path(&mut self, sample: &Sample) -> Seen {
        let mut seen = Seen {
            radiance: Rgb::ZERO,
            object: NO_OBJECT,
            touched: Touched::default(),
            rays: 0,
        };
        let mut path = Path {
            ray: sample.ray,
            throughput: Rgb::ONE,
            absorption: Rgb::ZERO,
            chosen: None,
            bounce: 0,
        };
        loop {
            self.counts.rays += 1;
            let next = self.follow(&mut path, sample, &mut seen);
            let Some(next) = next.filter(|_| path.bounce < self.depth) else {
                return seen;
            };
            if path.bounce + 1 == RAY_BUDGET {
                self.counts.over_budget += 1;
                return seen;
            }
            if path.bounce % 64 == 63 && (self.cancelled)() {
                return seen;
            }
            if !path.go_on(next, sample.sampler) {
                return seen;
            }
        }
    }

    /// Adds the light at the path's next hit and samples its continuation; `None` at its end.
    fn follow(&mut self, path: &mut Path, sample: &Sample, seen: &mut Seen) -> Option<BsdfSample> {
        let world = self.world;
        let reach = if path.bounce == 0 {
            sample.reach
        } else {
            f64::INFINITY
        };
        let nearest = world.nearest(&path.ray, reach);
        let distance = nearest.map_or(reach, |nearest| nearest.hit.t);
        if let Some((light, distance)) = world.sphere_lights.nearest(&path.ray, distance) {
            path.throughput *= transmitted(path.absorption, distance);
            let radiance = light.scale * light.radiance();
            seen.radiance += path.throughput * radiance * path.weight_of_chance(&light);
            return None;
        }
        let Some(nearest) = nearest else {
            seen.radiance += path.throughput * world.around(&path.ray, path.bounce, sample.screen);
            return None;
        };
        if path.bounce == 0 {
            seen.object = nearest.object;
        }
        self.touched |= Touched::object(nearest.object);
        path.throughput *= transmitted(path.absorption, nearest.hit.t);
        let mut mapped = None;
        let (point, material) = world.arrive(&path.ray, nearest, &mut mapped);
        let bsdf = Bsdf::at(&point, material);
        if material.is_lit(point.side) {
            let light = self.light_of_all(&point, &bsdf, path.bounce, sample.sampler);
            seen.radiance += path.throughput * (material.emission + light);
        }
        bsdf.sample(&path.ray, &point, sample.sampler, path.bounce)
    }

    /// Whether to stop before the light with this index; polled for some only, since a scene may
    /// have 100,000 lights.
    fn is_cancelled_at(&self, light: usize) -> bool {
        light % 16 == 15 && (self.cancelled)()
    }

    /// Sums the reflected light of all lights, in file order.
    fn light_of_all(
        &mut self,
        point: &Point,
        bsdf: &Bsdf<'_>,
        bounce: u32,
        sampler: Sampler,
    ) -> Rgb {
        let world = self.world;
        let mut sum = Rgb::ZERO;
        for (number, light) in world.scene.lights.iter().enumerate() {
            if self.is_cancelled_at(number) {
                break;
            }
            let sent_back = match light.sphere() {
                None => self.direct(point, light, |facing| {
                    let toward = facing.toward.into();
                    let scattered = bsdf.lobes.scatter(point, toward);
                    scattered.value + bsdf.lobes.highlight(point, toward)
                }),
                Some(sphere) => {
                    let [u, v, ..] = sampler.four(bounce, Use::Light(number as u32));
                    self.of_sphere_light(point, bsdf, bounce, light, &sphere, [u, v])
                }
            };
            sum += light.scale * sent_back;
        }
        sum
    }

    /// Returns the reflected light of a light with a size, sampled at the point that `place` gives.
    fn of_sphere_light(
        &mut self,
        point: &Point,
        bsdf: &Bsdf<'_>,
        bounce: u32,
        light: &Light,
        sphere: &SphereLight,
        place: [f64; 2],
    ) -> Rgb {
        let from = point.surface.point;
        let Some(incoming) = sphere.choose(from, place) else {
            return Rgb::ZERO;
        };
        let toward = incoming.toward.into();
        let scattered = bsdf.lobes.scatter(point, toward);
        let highlight = bsdf.lobes.highlight(point, toward);
        let ray = point.leave(toward);
        let hides = |place: Vector<f64>| {
            let distance = DVec3::from(place).distance(ray.origin);
            self.world.sphere_lights.hide(sphere, &ray, distance)
        };
        let is_dark = scattered.value == Rgb::ZERO && highlight == Rgb::ZERO;
        if is_dark || incoming.source.is_some_and(hides) {
            return Rgb::ZERO;
        }
        // At the last bounce no BSDF sample can hit the light.
        let chance = if bounce < self.depth {
            bsdf.lobes_chance * scattered.density
        } else {
            0.0
        };
        let weight = power_heuristic(sphere.density(from), chance);
        let irradiance = sphere.irradiance(from);
        let arriving = weight * irradiance;
        let shadow = shadow(&point.surface.into(), light, incoming);
        // BSDF samples never include the highlight.
        let sent_back = scattered.value * arriving + highlight * irradiance;
        self.visibility(shadow) * sent_back
    }
}

impl Path {
    /// The multiple importance sampling weight of a light hit by a BSDF sample.
    fn weight_of_chance(&self, light: &SphereLight) -> f64 {
        self.chosen.map_or(1.0, |(from, density)| {
            power_heuristic(density, light.density(from))
        })
    }

    /// Continues a path, subject to Russian roulette if it is faint (Arvo and Kirk, "Particle
    /// Transport and Image Synthesis", 1990).
    fn go_on(&mut self, next: BsdfSample, sampler: Sampler) -> bool {
        self.throughput *= next.weight;
        if !self.throughput.is_finite() {
            // Overflow caused by materials that reflect more than they receive.
            return false;
        }
        let left = self.throughput.abs().max_element() / FAINT;
        if left < 1.0 {
            let [.., chance] = sampler.four(self.bounce, Use::Bounce);
            if left <= chance {
                return false;
            }
            self.throughput /= left;
        }
        self.ray = next.ray;
        self.absorption = next.absorption;
        self.chosen = next.chosen;
        self.bounce += 1;
        true
    }
}

/// Veach's power heuristic: the weight of a sample with density `own` that another technique would
/// produce with density `other`.
fn power_heuristic(own: f64, other: f64) -> f64 {
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}
