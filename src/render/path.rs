//! Path tracing (Kajiya, "The Rendering Equation", 1986): an unbiased estimate of radiance over up
//! to `depth` bounces, without ambient light. Next event estimation samples all lights at each
//! bounce; for a light with a size it is combined with BSDF sampling by multiple importance
//! sampling (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo Rendering",
//! 1995).

use glam::DVec3;

use super::bsdf::{Bsdf, BsdfSample, Scattering};
use super::direct::shadow;
use super::gather::Gather;
use super::heuristic::power_heuristic;
use super::intersect::Nearest;
use super::lights::SphereLight;
use super::lobes::Scattered;
use super::optics::transmitted;
use super::probe::{Point, Probe, RAY_BUDGET, Sample, Seen};
use super::sampler::{Sampler, Use};
use super::touched::Touched;
use crate::geometry::Ray;
use crate::geometry::lanes::Vector;
use crate::scene::{FalloffRule, Light, Material, Rgb};

/// Paths with a throughput below this are subject to Russian roulette.
const FAINT: f64 = 1.0 / 16.0;

/// The state of a path.
pub(super) struct Path {
    pub(super) ray: Ray,
    /// Weight of the incoming radiance in the pixel.
    pub(super) throughput: Rgb,
    /// Absorption per unit of length up to the next hit.
    pub(super) absorption: Rgb,
    /// The last scattering; `None` after mirrors and boundaries.
    pub(super) chosen: Option<Scattering>,
    /// Whether it was ever scattered other than by mirrors and boundaries.
    pub(super) was_scattered: bool,
    pub(super) bounce: u32,
}

/// What the ray of a path leads to.
#[expect(
    clippy::large_enum_variant,
    reason = "a surface is what most rays lead to, and it must not cost an allocation"
)]
pub(super) enum Reached<'m> {
    /// Nothing but the background or environment, with this radiance.
    Nothing(Rgb),
    /// A light with a size.
    Light {
        light: SphereLight,
        distance: f64,
        radiance: Rgb,
        /// The multiple importance sampling weight.
        weight: f64,
    },
    /// A surface.
    Surface(Vertex<'m>),
}

/// A surface that a path reached.
pub(super) struct Vertex<'m> {
    pub(super) nearest: Nearest,
    pub(super) point: Point,
    pub(super) material: &'m Material,
    pub(super) bsdf: Bsdf<'m>,
}

/// Whether a path goes on from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Onward {
    /// It does, having survived Russian roulette with this probability.
    Goes {
        survival: f64,
    },
    /// No direction leads on.
    Nowhere,
    /// It would exceed the maximum number of bounces.
    Depth,
    /// The budget of rays is spent.
    Budget,
    /// The throughput overflowed, because materials reflect more than they receive.
    Overflow,
    /// It did not survive Russian roulette, with this probability.
    Roulette {
        survival: f64,
    },
    Cancelled,
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Estimates the radiance along a camera ray.
    pub(crate) fn by_path(&mut self, sample: &Sample) -> Seen {
        let mut seen = Seen::NOTHING;
        let mut path = Path::new(sample);
        loop {
            self.counts.rays += 1;
            let mut mapped = None;
            let reached = self.reach(&mut path, sample, &mut mapped);
            // By reference: moving the vertex out would take 3 % of the time.
            let next = match &reached {
                Reached::Nothing(radiance) => {
                    if self.gather.glow(path.bounce) {
                        let densities = path.densities_of(&self.world.sky);
                        let weight = densities.map_or(1.0, |densities| densities.weight);
                        seen.radiance += path.throughput * *radiance * weight;
                    }
                    None
                }
                Reached::Light {
                    light,
                    radiance,
                    weight,
                    ..
                } => {
                    if self.gathers(light, &path) {
                        seen.radiance += path.throughput * *radiance * *weight;
                    }
                    None
                }
                Reached::Surface(vertex) => {
                    let object = vertex.nearest.object;
                    if path.bounce == 0 {
                        seen.object = object;
                    }
                    self.touched |= Touched::object(object);
                    if vertex.material.is_lit(vertex.point.side) {
                        let light = self.light_of_all(vertex, path.bounce, sample.sampler);
                        let emission = if self.gather.glow(path.bounce) {
                            self.emission(&path, vertex)
                        } else {
                            Rgb::ZERO
                        };
                        let mut local = emission + light;
                        if self.photon_map.is_some() {
                            local += self.caustics(vertex, path.bounce);
                        }
                        if self.asks(vertex, path.bounce) {
                            local += self.ask(vertex, path.bounce, sample.sampler, |_| {});
                        }
                        seen.radiance += path.throughput * local;
                    }
                    vertex.sample(&path, sample.sampler)
                }
            };
            let Onward::Goes { .. } = self.onward(&mut path, next, sample.sampler) else {
                return seen;
            };
        }
    }

    /// Finds what a path's ray leads to, reducing the throughput by absorption up to there.
    pub(super) fn reach<'m>(
        &self,
        path: &mut Path,
        sample: &Sample,
        mapped: &'m mut Option<Material>,
    ) -> Reached<'m>
    where
        Self: 'm,
    {
        let world = self.world;
        let reach = path.reach(sample);
        let nearest = world.nearest(&path.ray, reach);
        let distance = nearest.map_or(reach, |nearest| nearest.hit.t);
        if let Some((light, distance)) = world.sphere_lights.nearest(&path.ray, distance) {
            path.throughput *= transmitted(path.absorption, distance);
            return Reached::Light {
                radiance: light.scale * light.radiance(),
                weight: if self.photon_map.is_some() && path.is_caustic() {
                    // Photons carry it.
                    0.0
                } else {
                    path.weight_of_chance(&light)
                },
                light,
                distance,
            };
        }
        let Some(nearest) = nearest else {
            return Reached::Nothing(world.around(&path.ray, path.bounce, sample.screen));
        };
        path.throughput *= transmitted(path.absorption, nearest.hit.t);
        let (point, material) = world.arrive(&path.ray, nearest, mapped);
        Reached::Surface(Vertex {
            nearest,
            bsdf: Bsdf::at(&point, material, world.gloss),
            point,
            material,
        })
    }

    /// Continues a path in a sampled direction, if there is one, the depth and the budget allow it
    /// and it survives Russian roulette.
    pub(super) fn onward(
        &mut self,
        path: &mut Path,
        next: Option<BsdfSample>,
        sampler: Sampler,
    ) -> Onward {
        let Some(next) = next else {
            return Onward::Nowhere;
        };
        if self.depth <= path.bounce {
            return Onward::Depth;
        }
        if path.bounce + 1 == RAY_BUDGET {
            self.counts.over_budget += 1;
            return Onward::Budget;
        }
        if path.bounce % 64 == 63 && (self.cancelled)() {
            return Onward::Cancelled;
        }
        path.go_on(next, sampler)
    }

    /// Whether a light with a size that a path hits is part of the light gathered. Where it could
    /// have been sampled from the first surface, it is that surface's direct light.
    fn gathers(&self, light: &SphereLight, path: &Path) -> bool {
        let from_first = path.bounce == 1 && path.chosen.is_some();
        match self.gather {
            Gather::Direct(number) => {
                let wanted = self.world.lights().get(number as usize);
                from_first && wanted.and_then(Light::luminous_sphere).as_ref() == Some(light)
            }
            Gather::Indirect if from_first => false,
            gather => gather.glow(path.bounce),
        }
    }

    /// The emission of a surface, as far as it counts where a BSDF sample hits it.
    #[inline]
    fn emission(&self, path: &Path, vertex: &Vertex<'_>) -> Rgb {
        let emission = vertex.material.emission;
        if emission == Rgb::ZERO {
            return emission;
        }
        let densities = self.densities_at(path, vertex);
        densities.map_or(emission, |densities| densities.weight * emission)
    }

    /// Whether to stop before the light with this index; polled for some only, since a scene may
    /// have 100,000 lights.
    fn is_cancelled_at(&self, light: usize) -> bool {
        light % 16 == 15 && (self.cancelled)()
    }

    /// Sums the reflected light of all lights, in file order.
    fn light_of_all(&mut self, vertex: &Vertex<'_>, bounce: u32, sampler: Sampler) -> Rgb {
        let mut sum = Rgb::ZERO;
        for number in 0..self.world.lights().len() {
            if self.is_cancelled_at(number) {
                break;
            }
            if self.gather.light(number, bounce) {
                sum += self.light_of(number, vertex, bounce, sampler);
            }
        }
        sum
    }

    /// Returns the reflected light of the light with this index.
    pub(super) fn light_of(
        &mut self,
        number: usize,
        vertex: &Vertex<'_>,
        bounce: u32,
        sampler: Sampler,
    ) -> Rgb {
        let light = &self.world.lights()[number];
        let Vertex { point, bsdf, .. } = vertex;
        let place = || place_on_light(number, bounce, sampler);
        let sent_back = match light.luminous_sphere() {
            None => {
                let from = point.surface.point;
                let sphere = light.sphere();
                let chosen = sphere.and_then(|sphere| sphere.choose(from, place()));
                self.direct(point, light, chosen, |facing| {
                    let toward = facing.toward.into();
                    let scattered = bsdf.lobes.scatter(point, toward);
                    scattered.value + bsdf.lobes.highlight(point, toward)
                })
            }
            Some(sphere) => self.of_sphere_light(point, bsdf, bounce, light, &sphere, place()),
        };
        // Photons carry what passes through.
        if self.photon_map.is_some() && !self.crossed.passed.is_empty() && self.is_by_photons(light)
        {
            return Rgb::ZERO;
        }
        light.scale * sent_back
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
        let chance = self.density_of(bsdf, scattered, bounce);
        let weight = power_heuristic(sphere.density(from), chance);
        let irradiance = sphere.irradiance(from);
        let arriving = weight * irradiance;
        let shadow = shadow(&point.surface.into(), light, incoming);
        // BSDF samples never include the highlight.
        let sent_back = scattered.value * arriving + highlight * irradiance;
        self.visibility(shadow) * sent_back
    }
}

impl<C> Probe<'_, C> {
    /// Whether photons carry what arrives from a light via mirrors and boundaries.
    #[cold]
    pub(super) fn is_by_photons(&self, light: &Light) -> bool {
        self.photon_map.is_some() && light.emits_photons(FalloffRule::None)
    }

    /// The density with which a path at a bounce goes on in a direction, per steradian; 0 at the last
    /// bounce, after which no BSDF sample can hit a light.
    pub(super) fn density_of(&self, bsdf: &Bsdf<'_>, scattered: Scattered, bounce: u32) -> f64 {
        if bounce < self.depth {
            bsdf.lobes_chance * scattered.density
        } else {
            0.0
        }
    }
}

impl Vertex<'_> {
    /// Samples the continuation of a path; `None` at its end.
    pub(super) fn sample(&self, path: &Path, sampler: Sampler) -> Option<BsdfSample> {
        self.bsdf
            .sample(&path.ray, &self.point, sampler, path.bounce)
    }
}

impl Path {
    /// Starts a path along a camera ray.
    pub(super) fn new(sample: &Sample) -> Self {
        Self {
            ray: sample.ray,
            throughput: Rgb::ONE,
            absorption: Rgb::ZERO,
            chosen: None,
            was_scattered: false,
            bounce: 0,
        }
    }

    /// The length up to which its ray is followed.
    pub(super) fn reach(&self, sample: &Sample) -> f64 {
        if self.bounce == 0 {
            sample.reach
        } else {
            f64::INFINITY
        }
    }

    /// Whether it goes on from a mirror or boundary after it was scattered otherwise.
    fn is_caustic(&self) -> bool {
        self.was_scattered && self.chosen.is_none()
    }

    /// The multiple importance sampling weight of a light hit by a BSDF sample.
    fn weight_of_chance(&self, light: &SphereLight) -> f64 {
        self.chosen.map_or(1.0, |chosen| {
            power_heuristic(chosen.density, light.density(chosen.point))
        })
    }

    /// Continues a path, subject to Russian roulette if it is faint (Arvo and Kirk, "Particle
    /// Transport and Image Synthesis", 1990).
    fn go_on(&mut self, next: BsdfSample, sampler: Sampler) -> Onward {
        self.throughput *= next.weight;
        if !self.throughput.is_finite() {
            return Onward::Overflow;
        }
        let survival = self.throughput.abs().max_element() / FAINT;
        if survival < 1.0 {
            let [.., chance] = sampler.four(self.bounce, Use::Bounce);
            if survival <= chance {
                return Onward::Roulette { survival };
            }
            self.throughput /= survival;
        }
        self.ray = next.ray;
        self.absorption = next.absorption;
        self.chosen = next.chosen;
        self.was_scattered |= next.chosen.is_some();
        self.bounce += 1;
        Onward::Goes {
            survival: survival.min(1.0),
        }
    }
}

/// Where on a light with a size, given its index, a path samples it.
pub(super) fn place_on_light(number: usize, bounce: u32, sampler: Sampler) -> [f64; 2] {
    let [u, v, ..] = sampler.four(bounce, Use::Light(number as u32));
    [u, v]
}
