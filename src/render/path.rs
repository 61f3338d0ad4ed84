//! Path tracing (Kajiya, "The Rendering Equation", 1986): an unbiased estimate of all light that
//! comes by up to `depth` bounces, ambient light apart. At each bounce light is asked for from all
//! lights; a light that has a size is also met by chance, and both estimates are weighed by how
//! likely each was (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte Carlo
//! Rendering", 1995).

use glam::DVec3;

use super::frame::NO_OBJECT;
use super::lights::{self, Ball, Incoming};
use super::lobes::{Lobes, strength};
use super::microfacet::Facets;
use super::optics::{index, reflect, refract, schlick};
use super::sampler::{Sampler, Use};
use super::tracer::{Matter, Point, RAY_BUDGET, Sample, Seen, Tracer};
use super::utah::{Answer, Gloss};
use super::warp;
use super::whitted::{Dielectric, spread, transmitted};
use crate::geometry::Ray;
use crate::scene::{Light, Phong, Rgb, Source};

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
struct Turn {
    ray: Ray,
    /// What its throughput is multiplied by.
    weight: Rgb,
    absorption: Rgb,
    chosen: Option<(DVec3, f64)>,
}

impl Tracer<'_> {
    /// Radiance along a camera ray.
    pub(crate) fn by_path(&mut self, sample: &Sample, cancelled: impl Fn() -> bool) -> Seen {
        let mut seen = Seen {
            radiance: Rgb::ZERO,
            object: NO_OBJECT,
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
            let turn = self.follow(&mut path, sample, &mut seen);
            let Some(turn) = turn.filter(|_| path.bounce < self.depth) else {
                return seen;
            };
            if path.bounce + 1 == RAY_BUDGET {
                self.counts.over_budget += 1;
                return seen;
            }
            if path.bounce % 64 == 63 && cancelled() {
                return seen;
            }
            if !path.turn(turn, sample.sampler) {
                return seen;
            }
        }
    }

    /// Adds what a path meets, and chooses how it goes on from there, if it does.
    fn follow(&mut self, path: &mut Path, sample: &Sample, seen: &mut Seen) -> Option<Turn> {
        let world = self.world;
        let reach = if path.bounce == 0 {
            sample.reach
        } else {
            f64::INFINITY
        };
        let nearest = world.nearest(&path.ray, reach);
        let distance = nearest.map_or(reach, |nearest| nearest.hit.t);
        if let Some((ball, radiance, _)) = self.ball(&path.ray, distance) {
            seen.radiance += path.throughput * radiance * path.weight_of_chance(&ball);
            return None;
        }
        let Some(nearest) = nearest else {
            seen.radiance += path.throughput * world.around(&path.ray, path.bounce, sample);
            return None;
        };
        if path.bounce == 0 {
            seen.object = nearest.object;
        }
        path.throughput *= transmitted(path.absorption, nearest.hit.t);
        let (point, matter) = world.arrive(&path.ray, nearest);
        match matter {
            Matter::Flat(colour) => {
                seen.radiance += path.throughput * colour;
                None
            }
            Matter::Phong(material) => {
                let light = self.light_on_phong(&point, &material, Rgb::ZERO);
                seen.radiance += path.throughput * light;
                let numbers = sample.sampler.four(path.bounce, Use::Bounce);
                on_from_phong(&path.ray, &point, &material, numbers)
            }
            Matter::Utah(answer) => {
                let ways = Ways::at(&point, &answer);
                if answer.is_lit(&point) {
                    let light = self.light_on_lobes(&point, &ways, path.bounce, sample.sampler);
                    seen.radiance += path.throughput * (answer.emission + light);
                }
                ways.choose(&path.ray, &point, &answer, sample.sampler, path.bounce)
            }
        }
    }

    /// What is sent back of the light of all lights, in file order.
    fn light_on_lobes(&mut self, point: &Point, ways: &Ways, bounce: u32, sampler: Sampler) -> Rgb {
        let world = self.world;
        let gain = lights::path_gain(&world.scene);
        let mut sum = Rgb::ZERO;
        for (number, light) in world.scene.lights.iter().enumerate() {
            let place = || sampler.four(bounce, Use::Light(number as u32));
            sum += gain * self.on_lobes(point, ways, bounce, light, place);
        }
        sum
    }

    /// What is sent back of one light, whose intensity is as the scene has it.
    fn on_lobes(
        &mut self,
        point: &Point,
        ways: &Ways,
        bounce: u32,
        light: &Light,
        place: impl FnOnce() -> [f64; 4],
    ) -> Rgb {
        let from = point.surface.point;
        let ball = ball_of(light);
        let incoming = match &ball {
            None => lights::incoming(light, from, None),
            Some(ball) => {
                let [u, v, ..] = place();
                ball.choose(from, [u, v])
            }
        };
        let Some(incoming) = incoming else {
            return Rgb::ZERO;
        };
        let scattered = ways.lobes.scatter(point, incoming.toward);
        if scattered.share == Rgb::ZERO {
            return Rgb::ZERO;
        }
        let arriving = match &ball {
            None => light.colour * lights::share(light, from, incoming.toward),
            Some(ball) => {
                let density = ball.density(from);
                // At the last bounce no path goes on to meet it by chance.
                let chance = if bounce < self.depth {
                    ways.chance * scattered.density
                } else {
                    0.0
                };
                let weight = weight(density, chance);
                lights::radiance(ball, light.colour) * (weight / density)
            }
        };
        if ball.is_some() && self.is_behind_another(point, &incoming) {
            return Rgb::ZERO;
        }
        self.visibility(&point.surface, light, incoming) * (scattered.share * arriving)
    }

    /// The nearest light with a size that a ray meets before a distance: it, what it shows, and where.
    fn ball(&self, ray: &Ray, distance: f64) -> Option<(Ball, Rgb, f64)> {
        let balls = self.world.balls.iter();
        let hits = balls.filter_map(|(ball, radiance)| Some((*ball, *radiance, ball.hit(ray)?)));
        hits.filter(|(_, _, hit)| *hit < distance)
            .min_by(|(_, _, a), (_, _, b)| a.total_cmp(b))
    }

    /// Whether a light with a size is hidden by another one.
    fn is_behind_another(&self, point: &Point, incoming: &Incoming) -> bool {
        let ray = point.leave(incoming.toward);
        let distance = incoming
            .source
            .map_or(f64::INFINITY, |source| source.distance(ray.origin));
        // Its own surface is met at the distance itself, but for rounding.
        let nearer = (1.0 - 1e-9) * distance;
        1 < self.world.balls.len() && self.ball(&ray, nearer).is_some()
    }
}

impl Path {
    /// How much a light that is met by chance counts beside the one that was asked for its light.
    fn weight_of_chance(&self, ball: &Ball) -> f64 {
        self.chosen
            .map_or(1.0, |(from, density)| weight(density, ball.density(from)))
    }

    /// Goes on, unless it is faint and chance ends it ("Russian roulette": Arvo and Kirk, "Particle
    /// Transport and Image Synthesis", 1990).
    fn turn(&mut self, turn: Turn, sampler: Sampler) -> bool {
        self.throughput *= turn.weight;
        let left = self.throughput.abs().max_element() / FAINT;
        if left < 1.0 {
            let [.., chance] = sampler.four(self.bounce, Use::Bounce);
            if left <= chance {
                return false;
            }
            self.throughput /= left;
        }
        self.ray = turn.ray;
        self.absorption = turn.absorption;
        self.chosen = turn.chosen;
        self.bounce += 1;
        true
    }
}

/// The weight of what was found with one density, where another way finds it with another: Veach's
/// power heuristic.
fn weight(own: f64, other: f64) -> f64 {
    let ratio = other / own;
    1.0 / (1.0 + ratio * ratio)
}

/// The sphere that a light with a size is.
fn ball_of(light: &Light) -> Option<Ball> {
    match light.source {
        Source::Point { position, .. } if 0.0 < light.radius => Some(Ball {
            centre: position,
            radius: light.radius,
        }),
        _ => None,
    }
}

/// The ways on from a surface of `.ray` or `.dat`: mirrored, through, or anywhere by the cosine.
fn on_from_phong(ray: &Ray, point: &Point, material: &Phong, numbers: [f64; 4]) -> Option<Turn> {
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
            return Some(Turn {
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
        Turn {
            ray: point.leave(direction),
            weight: material.diffuse * (total / diffuse),
            absorption: Rgb::ZERO,
            chosen: None,
        }
    })
}

/// The ways on from a surface of `.xml`, and how likely each is chosen.
struct Ways {
    lobes: Lobes,
    /// How likely the lobes are chosen.
    chance: f64,
    /// What is mirrored.
    mirror: Rgb,
    mirror_chance: f64,
}

impl Ways {
    fn at(point: &Point, answer: &Answer) -> Self {
        let (lobes, of_lobes) = Lobes::of(answer);
        let of_lobes = if answer.is_lit(point) { of_lobes } else { 0.0 };
        let mirror = match answer.gloss {
            Gloss::Microfacet(straight, alpha)
                if Facets::is_perfect(alpha) && answer.is_lit(point) =>
            {
                let cosine = point.normal.dot(point.view);
                straight + (Rgb::ONE - straight) * schlick(cosine)
            }
            _ if point.front => answer.reflection,
            _ => Rgb::ZERO,
        };
        let total = of_lobes + strength(mirror) + strength(answer.refraction);
        let chance = |strength: f64| if total == 0.0 { 0.0 } else { strength / total };
        Self {
            lobes,
            chance: chance(of_lobes),
            mirror,
            mirror_chance: chance(strength(mirror)),
        }
    }

    fn choose(
        &self,
        ray: &Ray,
        point: &Point,
        answer: &Answer,
        sampler: Sampler,
        bounce: u32,
    ) -> Option<Turn> {
        let [way, u, v, _] = sampler.four(bounce, Use::Bounce);
        if way < self.chance {
            let direction = self.lobes.choose(point, way / self.chance, [u, v]);
            let scattered = self.lobes.scatter(point, direction);
            let density = self.chance * scattered.density;
            return (scattered.share != Rgb::ZERO && 0.0 < density).then(|| Turn {
                ray: point.leave(direction),
                weight: scattered.share / density,
                absorption: Rgb::ZERO,
                chosen: Some((point.surface.point, density)),
            });
        }
        let spread = |direction, tangent, outward| {
            let numbers = || {
                let [u, v, ..] = sampler.four(bounce, Use::Spread);
                Some([u, v])
            };
            point.leave(spread(direction, tangent, outward, numbers))
        };
        let mirrored = reflect(ray.direction, point.normal);
        let specular = |ray, weight, absorption| {
            Some(Turn {
                ray,
                weight,
                absorption,
                chosen: None,
            })
        };
        let way = way - self.chance;
        if way < self.mirror_chance {
            let ray = spread(mirrored, answer.reflection_spread, point.normal);
            let weight = self.mirror / self.mirror_chance;
            return specular(ray, weight, answer.within(!point.front));
        }
        let chance = 1.0 - self.chance - self.mirror_chance;
        if answer.refraction == Rgb::ZERO || chance <= 0.0 {
            return None;
        }
        let weight = answer.refraction / chance;
        let way = (way - self.mirror_chance) / chance;
        let Dielectric { share, refracted } = Dielectric::at(ray.direction, point, answer);
        if let Some(refracted) = refracted.filter(|_| share <= way) {
            let ray = spread(refracted, answer.refraction_spread, -point.normal);
            return specular(ray, weight, answer.within(point.front));
        }
        let ray = spread(mirrored, answer.refraction_spread, point.normal);
        specular(ray, weight, answer.within(!point.front))
    }
}
