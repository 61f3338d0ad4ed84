//! Path tracing (Kajiya, "The Rendering Equation", 1986): an unbiased estimate of all light that
//! comes by up to `depth` bounces, ambient light apart. At each bounce light is asked for from all
//! lights; a light that has a size is also met by chance, and both estimates are weighed by how
//! likely each was (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo
//! Rendering", 1995).

use glam::DVec3;

use super::direct::shadow;
use super::frame::NO_OBJECT;
use super::lights::{self, SphereLight};
use super::lobes::{Lobes, strength};
use super::microfacet::Microfacets;
use super::optics::{Dielectric, index, reflect, refract, schlick, spread, transmitted};
use super::phong;
use super::probe::{Matter, Point, Probe, RAY_BUDGET, Sample, Seen};
use super::sampler::{Sampler, Use};
use super::touched::Touched;
use super::utah::{Gloss, Shading};
use super::warp;
use crate::geometry::Ray;
use crate::geometry::lanes::Vector;
use crate::scene::{Light, Phong, Rgb};

/// Paths that carry less than this go on by chance only.
const FAINT: f64 = 1.0 / 16.0;

/// A path on its way.
struct Path {
    ray: Ray,
    /// Which part of the radiance ahead reaches the eye.
    throughput: Rgb,
    /// What is lost per unit of length until it meets something.
    absorption: Rgb,
    /// The surface it left by chance among many directions, and how likely it went this way, per
    /// steradian; none if it had no choice.
    chosen: Option<(DVec3, f64)>,
    bounce: u32,
}

/// How a path goes on.
#[derive(Clone, Copy, Debug)]
struct BsdfSample {
    ray: Ray,
    /// What its throughput is multiplied by.
    weight: Rgb,
    absorption: Rgb,
    chosen: Option<(DVec3, f64)>,
}

impl<C: Fn() -> bool> Probe<'_, C> {
    /// Radiance along a camera ray.
    pub(crate) fn by_path(&mut self, sample: &Sample) -> Seen {
        let mut seen = Seen {
            radiance: Rgb::ZERO,
            object: NO_OBJECT,
            touched: Touched::default(),
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

    /// Adds what a path meets, and chooses how it goes on from there, if it does.
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
            let radiance = lights::path_gain(&world.scene) * light.radiance();
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
        let (point, matter) = world.arrive(&path.ray, nearest);
        match matter {
            Matter::Flat(colour) => {
                seen.radiance += path.throughput * colour;
                None
            }
            Matter::Phong(material) => {
                let light = self.light_on_phong(&point, &material);
                seen.radiance += path.throughput * light;
                let numbers = sample.sampler.four(path.bounce, Use::Bounce);
                sample_phong(&path.ray, &point, &material, numbers)
            }
            Matter::Utah(shading) => {
                let bsdf = Bsdf::at(&point, &shading);
                if shading.is_lit(point.front) {
                    let light = self.light_on_lobes(&point, &bsdf, path.bounce, sample.sampler);
                    seen.radiance += path.throughput * (shading.emission + light);
                }
                bsdf.sample(&path.ray, &point, &shading, sample.sampler, path.bounce)
            }
        }
    }

    /// Whether to stop before the light of this number, which is asked for some of them: a scene may
    /// have a hundred thousand.
    fn is_cancelled_at(&self, light: usize) -> bool {
        light % 16 == 15 && (self.cancelled)()
    }

    /// What a surface of `.ray` or `.dat` sends back of the light of all lights, in file order.
    fn light_on_phong(&mut self, point: &Point, material: &Phong) -> Rgb {
        let world = self.world;
        let mut sum = Rgb::ZERO;
        for (number, light) in world.scene.lights.iter().enumerate() {
            if self.is_cancelled_at(number) {
                break;
            }
            sum += self.direct(point, light, |facing| {
                phong::reflected(material, facing.cosine, facing.mirrored)
            });
        }
        sum
    }

    /// What is sent back of the light of all lights, in file order.
    fn light_on_lobes(&mut self, point: &Point, bsdf: &Bsdf, bounce: u32, sampler: Sampler) -> Rgb {
        let world = self.world;
        let mut sum = Rgb::ZERO;
        for (number, light) in world.scene.lights.iter().enumerate() {
            if self.is_cancelled_at(number) {
                break;
            }
            sum += match light.sphere() {
                None => self.direct(point, light, |facing| {
                    bsdf.lobes.scatter(point, facing.toward.into()).value
                }),
                Some(sphere) => {
                    let [u, v, ..] = sampler.four(bounce, Use::Light(number as u32));
                    self.of_sphere_light(point, bsdf, bounce, light, &sphere, [u, v])
                }
            };
        }
        lights::path_gain(&world.scene) * sum
    }

    /// What is sent back of a light that has a size, by asking the place of it that `place` says.
    fn of_sphere_light(
        &mut self,
        point: &Point,
        bsdf: &Bsdf,
        bounce: u32,
        light: &Light,
        sphere: &SphereLight,
        place: [f64; 2],
    ) -> Rgb {
        let from = point.surface.point;
        let Some(incoming) = sphere.choose(from, place) else {
            return Rgb::ZERO;
        };
        let scattered = bsdf.lobes.scatter(point, incoming.toward.into());
        let ray = point.leave(incoming.toward.into());
        let hides = |place: Vector<f64>| {
            let distance = DVec3::from(place).distance(ray.origin);
            self.world.sphere_lights.hide(sphere, &ray, distance)
        };
        if scattered.value == Rgb::ZERO || incoming.source.is_some_and(hides) {
            return Rgb::ZERO;
        }
        // At the last bounce no path goes on to meet it by chance.
        let chance = if bounce < self.depth {
            bsdf.lobes_chance * scattered.density
        } else {
            0.0
        };
        let weight = power_heuristic(sphere.density(from), chance);
        let arriving = weight * sphere.irradiance(from);
        let shadow = shadow(&point.surface.into(), light, incoming);
        self.visibility(shadow) * (scattered.value * arriving)
    }
}

impl Path {
    /// How much a light that is met by chance counts beside the one that was asked for its light.
    fn weight_of_chance(&self, light: &SphereLight) -> f64 {
        self.chosen.map_or(1.0, |(from, density)| {
            power_heuristic(density, light.density(from))
        })
    }

    /// Goes on, unless it is faint and chance ends it ("Russian roulette": Arvo and Kirk, "Particle
    /// Transport and Image Synthesis", 1990).
    fn go_on(&mut self, next: BsdfSample, sampler: Sampler) -> bool {
        self.throughput *= next.weight;
        if !self.throughput.is_finite() {
            // Materials that send back more than comes, beyond what numbers hold.
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

/// Veach's power heuristic: the weight of what was found with one density, where another way of
/// finding it has another.
fn power_heuristic(own: f64, other: f64) -> f64 {
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// A way on from a surface of `.ray` or `.dat`: mirrored, through, or anywhere by the cosine.
fn sample_phong(
    ray: &Ray,
    point: &Point,
    material: &Phong,
    numbers: [f64; 4],
) -> Option<BsdfSample> {
    let index = index(material.index);
    let ratio = if point.front { 1.0 / index } else { index };
    let through = match material.transmission {
        0.0 => None,
        _ => refract(ray.direction, point.normal, ratio),
    };
    let mirrored = reflect(ray.direction, point.normal);
    let specular = [
        (mirrored, material.reflection),
        // On total internal reflection what would go through goes this way too.
        (through.unwrap_or(mirrored), material.transmission),
    ];
    let diffuse = strength(material.diffuse);
    let total = diffuse + specular.iter().map(|(_, weight)| weight.abs()).sum::<f64>();
    let [lobe, u, v, _] = numbers;
    let mut chosen = lobe * total;
    for (direction, weight) in specular {
        if chosen < weight.abs() {
            return Some(BsdfSample {
                ray: point.leave(direction),
                weight: Rgb::splat(total * weight.signum()),
                absorption: Rgb::ZERO,
                chosen: None,
            });
        }
        chosen -= weight.abs();
    }
    (0.0 < diffuse).then(|| {
        let direction = warp::by_cosine(point.normal, [u, v]);
        BsdfSample {
            ray: point.leave(direction),
            weight: material.diffuse * (total / diffuse),
            absorption: Rgb::ZERO,
            chosen: None,
        }
    })
}

/// The ways on from a surface of `.xml`, and how likely each is chosen.
struct Bsdf {
    lobes: Lobes,
    lobes_chance: f64,
    /// What is mirrored.
    mirror: Rgb,
    mirror_chance: f64,
}

impl Bsdf {
    fn at(point: &Point, shading: &Shading) -> Self {
        let is_lit = shading.is_lit(point.front);
        let (lobes, of_lobes) = Lobes::of(point, shading);
        let of_lobes = if is_lit { of_lobes } else { 0.0 };
        let mirror = match shading.gloss {
            Gloss::Microfacet(straight, alpha) if is_lit && Microfacets::is_perfect(alpha) => {
                let cosine = point.normal.dot(point.view);
                straight + (Rgb::ONE - straight) * schlick(cosine)
            }
            Gloss::Blinn(..) | Gloss::Phong(..) if point.front => shading.reflection,
            _ => Rgb::ZERO,
        };
        let total = of_lobes + strength(mirror) + strength(shading.refraction);
        let chance = |strength: f64| if total == 0.0 { 0.0 } else { strength / total };
        Self {
            lobes,
            lobes_chance: chance(of_lobes),
            mirror,
            mirror_chance: chance(strength(mirror)),
        }
    }

    /// A way on, by chance.
    fn sample(
        &self,
        ray: &Ray,
        point: &Point,
        shading: &Shading,
        sampler: Sampler,
        bounce: u32,
    ) -> Option<BsdfSample> {
        let [way, u, v, _] = sampler.four(bounce, Use::Bounce);
        if way < self.lobes_chance {
            let direction = self.lobes.choose(point, way / self.lobes_chance, [u, v]);
            let scattered = self.lobes.scatter(point, direction);
            let density = self.lobes_chance * scattered.density;
            let leads_on = scattered.value != Rgb::ZERO && 0.0 < density;
            return leads_on.then(|| BsdfSample {
                ray: point.leave(direction),
                weight: scattered.value / density,
                absorption: Rgb::ZERO,
                chosen: Some((point.surface.point, density)),
            });
        }
        let numbers = || {
            let [u, v, ..] = sampler.four(bounce, Use::Spread);
            Some([u, v])
        };
        let specular = |direction, weight, absorption| {
            Some(BsdfSample {
                ray: point.leave(direction),
                weight,
                absorption,
                chosen: None,
            })
        };
        let losses = shading.losses(point.front);
        let mirrored = reflect(ray.direction, point.normal);
        let way = way - self.lobes_chance;
        if way < self.mirror_chance {
            let direction = spread(mirrored, shading.reflection_spread, point.normal, numbers);
            return specular(direction, self.mirror / self.mirror_chance, losses.mirrored);
        }
        let chance = 1.0 - self.lobes_chance - self.mirror_chance;
        if shading.refraction == Rgb::ZERO || chance <= 0.0 {
            return None;
        }
        let weight = shading.refraction / chance;
        let way = (way - self.mirror_chance) / chance;
        let tangent = shading.refraction_spread;
        let Dielectric {
            reflectance,
            refracted,
        } = Dielectric::new(ray.direction, point.normal, shading.indices(point.front));
        if let Some(refracted) = refracted.filter(|_| reflectance <= way) {
            let direction = spread(refracted, tangent, -point.normal, numbers);
            return specular(direction, weight, losses.refracted);
        }
        let direction = spread(mirrored, tangent, point.normal, numbers);
        specular(direction, weight, losses.mirrored)
    }
}
