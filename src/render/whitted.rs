//! Whitted's recursive ray tracing (Whitted, "An Improved Illumination Model for Shaded Display",
//! 1980).

use glam::DVec3;

use super::frame::NO_OBJECT;
use super::optics::{fresnel, index, reflect, refract};
use super::sampler::{Sampler, Use};
use super::tracer::{Matter, Point, RAY_BUDGET, Sample, Seen, Tracer};
use super::utah::Answer;
use super::warp;
use super::world::Nearest;
use crate::geometry::Ray;
use crate::scene::{Phong, Rgb};

/// A ray yet to be traced.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pending {
    ray: Ray,
    /// Which part of its radiance reaches the eye.
    weight: Rgb,
    /// What is lost per unit of length until it meets something.
    absorption: Rgb,
    bounce: u32,
    /// Its place in the tree of rays, for numbers of its own.
    node: u32,
}

impl Tracer<'_> {
    /// Radiance along a camera ray. Rays are traced depth first, reflection before refraction; those
    /// beyond the budget bring nothing.
    pub(crate) fn by_whitted(&mut self, sample: &Sample, cancelled: impl Fn() -> bool) -> Seen {
        let mut seen = Seen {
            radiance: Rgb::ZERO,
            object: NO_OBJECT,
        };
        let mut traced = 0;
        self.pending.clear();
        self.pending.push(Pending {
            ray: sample.ray,
            weight: Rgb::ONE,
            absorption: Rgb::ZERO,
            bounce: 0,
            node: Sampler::ROOT,
        });
        while let Some(next) = self.pending.pop() {
            if traced == RAY_BUDGET {
                self.counts.over_budget += 1;
                break;
            }
            traced += 1;
            self.counts.rays += 1;
            let reach = if next.bounce == 0 {
                sample.reach
            } else {
                f64::INFINITY
            };
            let Some(nearest) = self.world.nearest(&next.ray, reach) else {
                seen.radiance += next.weight * self.world.around(&next.ray, next.bounce, sample);
                continue;
            };
            if next.bounce == 0 {
                seen.object = nearest.object;
            }
            seen.radiance += self.local(&next, nearest, sample.sampler);
            if traced.is_multiple_of(64) && cancelled() {
                break;
            }
        }
        seen
    }

    /// Light at a hit, as far as it reaches the eye; leaves the rays that go on from it pending.
    fn local(&mut self, arrived: &Pending, nearest: Nearest, sampler: Sampler) -> Rgb {
        let world = self.world;
        let (point, matter) = world.arrive(&arrived.ray, nearest);
        let goes_on = arrived.bounce < self.depth;
        match matter {
            Matter::Flat(colour) => arrived.through(nearest) * colour,
            Matter::Phong(material) => {
                let radiance = self.light_on_phong(&point, &material, world.scene.ambient);
                if goes_on {
                    self.branch(arrived, &point, &material);
                }
                arrived.weight * radiance
            }
            Matter::Utah(answer) => {
                let answer = answer.for_whitted();
                let arrived = Pending {
                    weight: arrived.through(nearest),
                    ..*arrived
                };
                let radiance = if answer.is_lit(&point) {
                    self.light_on_utah(&point, &answer, sampler, arrived.node)
                } else {
                    Rgb::ZERO
                };
                if goes_on {
                    self.branch_by_fresnel(&arrived, &point, &answer, sampler);
                }
                arrived.weight * radiance
            }
        }
    }

    /// Leaves the mirrored and the refracted ray pending, the mirrored one to be traced first.
    fn branch(&mut self, arrived: &Pending, point: &Point, material: &Phong) {
        let direction = arrived.ray.direction;
        let mut mirrored_weight = material.reflection;
        if material.transmission != 0.0 {
            let index = index(material.index);
            let ratio = if point.front { 1.0 / index } else { index };
            match refract(direction, point.normal, ratio) {
                Some(refracted) => {
                    let weight = Rgb::splat(material.transmission);
                    self.push(arrived, point, refracted, weight, Rgb::ZERO);
                }
                // Total internal reflection: both rays go the same way and are traced as one.
                None => mirrored_weight += material.transmission,
            }
        }
        if mirrored_weight != 0.0 {
            let mirrored = reflect(direction, point.normal);
            self.push(
                arrived,
                point,
                mirrored,
                Rgb::splat(mirrored_weight),
                Rgb::ZERO,
            );
        }
    }

    /// The same where how much goes which way depends on the angle.
    fn branch_by_fresnel(
        &mut self,
        arrived: &Pending,
        point: &Point,
        answer: &Answer,
        sampler: Sampler,
    ) {
        let direction = arrived.ray.direction;
        let mirrored = reflect(direction, point.normal);
        let [mut plain, mut of_glass] = [Rgb::ZERO; 2];
        if point.front {
            plain = answer.reflection;
        }
        if answer.refraction != Rgb::ZERO {
            let Dielectric { share, refracted } = Dielectric::at(direction, point, answer);
            of_glass = share * answer.refraction;
            if let Some(refracted) = refracted {
                let numbers = || sampler.pair(arrived.node, Use::Refraction);
                let refracted = spread(refracted, answer.refraction_spread, -point.normal, numbers);
                let absorption = answer.within(point.front);
                let weight = (1.0 - share) * answer.refraction;
                self.push(arrived, point, refracted, weight, absorption);
            }
        }
        // What leaves the back stays inside, and nothing else is mirrored there.
        let absorption = answer.within(!point.front);
        if answer.reflection_spread == answer.refraction_spread {
            plain += of_glass;
            of_glass = Rgb::ZERO;
        }
        let numbers = || sampler.pair(arrived.node, Use::Reflection);
        let around = |tangent| spread(mirrored, tangent, point.normal, numbers);
        // The one pushed last is traced first.
        let glass = around(answer.refraction_spread);
        self.push(arrived, point, glass, of_glass, absorption);
        let mirrored = around(answer.reflection_spread);
        self.push(arrived, point, mirrored, plain, absorption);
    }

    fn push(
        &mut self,
        arrived: &Pending,
        point: &Point,
        direction: DVec3,
        weight: Rgb,
        absorption: Rgb,
    ) {
        if weight == Rgb::ZERO {
            return;
        }
        self.pending.push(Pending {
            ray: point.leave(direction),
            weight: arrived.weight * weight,
            absorption,
            bounce: arrived.bounce + 1,
            node: Sampler::child(arrived.node, self.pending.len() as u32),
        });
    }
}

impl Pending {
    /// Which part of the radiance at a hit reaches the eye.
    fn through(&self, nearest: Nearest) -> Rgb {
        self.weight * transmitted(self.absorption, nearest.hit.t)
    }
}

/// What is left of light after a way (Beer, Lambert): e^(−absorption · length).
pub(crate) fn transmitted(absorption: Rgb, length: f64) -> Rgb {
    if absorption == Rgb::ZERO {
        return Rgb::ONE;
    }
    absorption.map(|lost| libm::exp(-lost * length))
}

/// What becomes of light that meets a transparent surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Dielectric {
    /// The part that is mirrored: all of it on total internal reflection.
    pub(crate) share: f64,
    /// Where the rest goes.
    pub(crate) refracted: Option<DVec3>,
}

impl Dielectric {
    pub(crate) fn at(direction: DVec3, point: &Point, answer: &Answer) -> Self {
        let (from, to) = if point.front {
            (1.0, answer.index)
        } else {
            (answer.index, 1.0)
        };
        let refracted = refract(direction, point.normal, from / to);
        let share = refracted.map_or(1.0, |refracted| {
            let incident = -direction.dot(point.normal);
            fresnel(from, incident, to, -refracted.dot(point.normal))
        });
        Self { share, refracted }
    }
}

impl Answer {
    /// What is lost on a way that starts into the object, or does not.
    pub(crate) fn within(&self, inward: bool) -> Rgb {
        if inward { self.absorption } else { Rgb::ZERO }
    }
}

/// A direction spread in a cone whose half angle has this tangent; kept on the side of the surface
/// that `outward` points to by folding the cone along it.
pub(crate) fn spread(
    direction: DVec3,
    tangent: f64,
    outward: DVec3,
    numbers: impl FnOnce() -> Option<[f64; 2]>,
) -> DVec3 {
    if tangent == 0.0 {
        return direction;
    }
    let Some(numbers) = numbers() else {
        return direction;
    };
    let secant = (1.0 + tangent * tangent).sqrt();
    let versine = tangent * tangent / (secant * (secant + 1.0));
    let versine = if versine.is_finite() { versine } else { 1.0 };
    let spread = warp::in_cone(direction, versine, numbers);
    let height = spread.dot(outward);
    if height < 0.0 && 0.0 <= direction.dot(outward) {
        spread - 2.0 * height * outward
    } else {
        spread
    }
}
