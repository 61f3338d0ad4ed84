//! Whitted's recursive ray tracing (Whitted, "An Improved Illumination Model for Shaded Display",
//! 1980).

use glam::DVec3;

use super::frame::NO_OBJECT;
use super::optics::{Dielectric, index, reflect, refract, spread, transmitted};
use super::sampler::{Sampler, Use};
use super::tracer::{Matter, Pending, Point, RAY_BUDGET, Sample, Seen, Tracer};
use super::utah::Shading;
use super::world::Nearest;
use crate::scene::{Phong, Rgb};

/// A ray that goes on from a point.
struct Branch {
    /// Which one of the point's it is.
    number: u32,
    direction: DVec3,
    /// Which part of its radiance leaves the point toward where the ray came from.
    weight: Rgb,
    /// What is lost per unit of length until it meets something.
    absorption: Rgb,
}

impl<C: Fn() -> bool> Tracer<'_, C> {
    /// Radiance along a camera ray. Rays are traced depth first, reflection before refraction; those
    /// beyond the budget bring nothing.
    pub(crate) fn by_whitted(&mut self, sample: &Sample) -> Seen {
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
                seen.radiance +=
                    next.weight * self.world.around(&next.ray, next.bounce, sample.screen);
                continue;
            };
            if next.bounce == 0 {
                seen.object = nearest.object;
            }
            seen.radiance += self.local(&next, nearest, sample.sampler);
            if traced.is_multiple_of(64) && (self.cancelled)() {
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
            Matter::Utah(shading) => {
                let arrived = Pending {
                    weight: arrived.through(nearest),
                    ..*arrived
                };
                let radiance = if shading.is_lit(point.front) {
                    self.light_on_utah(&point, &shading, sampler, arrived.node)
                } else {
                    Rgb::ZERO
                };
                if goes_on {
                    self.branch_by_fresnel(&arrived, &point, &shading, sampler);
                }
                arrived.weight * radiance
            }
        }
    }

    /// What a surface of `.xml` emits and sends back of ambient light and that of all lights, in file
    /// order.
    fn light_on_utah(
        &mut self,
        point: &Point,
        shading: &Shading,
        sampler: Sampler,
        node: u32,
    ) -> Rgb {
        let world = self.world;
        let mut radiance = shading.emission + world.scene.ambient * shading.diffuse;
        for (number, light) in world.scene.lights.iter().enumerate() {
            if self.is_cancelled_at(number) {
                break;
            }
            let place = (0.0 < light.radius)
                .then(|| sampler.pair(node, Use::Light(number as u32)))
                .flatten();
            radiance += self.direct(point, light, place, |toward, cosine| {
                cosine * shading.reflected(point.normal, point.view, toward)
            });
        }
        radiance
    }

    /// Leaves the mirrored and the refracted ray pending, the mirrored one to be traced first.
    fn branch(&mut self, arrived: &Pending, point: &Point, material: &Phong) {
        let direction = arrived.ray.direction;
        let mut mirrored_weight = material.reflection;
        let clear = |number, direction, weight| Branch {
            number,
            direction,
            weight: Rgb::splat(weight),
            absorption: Rgb::ZERO,
        };
        if material.transmission != 0.0 {
            let index = index(material.index);
            let ratio = if point.front { 1.0 / index } else { index };
            match refract(direction, point.normal, ratio) {
                Some(refracted) => {
                    let branch = clear(0, refracted, material.transmission);
                    self.push(arrived, point, &branch);
                }
                // Total internal reflection: both rays go the same way and are traced as one.
                None => mirrored_weight += material.transmission,
            }
        }
        let mirrored = clear(1, reflect(direction, point.normal), mirrored_weight);
        self.push(arrived, point, &mirrored);
    }

    /// The same where how much goes which way depends on the angle.
    fn branch_by_fresnel(
        &mut self,
        arrived: &Pending,
        point: &Point,
        shading: &Shading,
        sampler: Sampler,
    ) {
        let direction = arrived.ray.direction;
        let losses = shading.losses(point.front);
        let mut by_mirror = if point.front {
            shading.mirror()
        } else {
            Rgb::ZERO
        };
        let mut by_glass = Rgb::ZERO;
        if shading.refraction != Rgb::ZERO {
            let Dielectric {
                reflectance,
                refracted,
            } = Dielectric::new(direction, point.normal, shading.indices(point.front));
            by_glass = reflectance * shading.refraction;
            if let Some(refracted) = refracted {
                let numbers = || sampler.pair(arrived.node, Use::Refraction);
                let branch = Branch {
                    number: 0,
                    direction: spread(refracted, shading.refraction_spread, -point.normal, numbers),
                    weight: (1.0 - reflectance) * shading.refraction,
                    absorption: losses.refracted,
                };
                self.push(arrived, point, &branch);
            }
        }
        if shading.reflection_spread == shading.refraction_spread {
            by_mirror += by_glass;
            by_glass = Rgb::ZERO;
        }
        let mirrored = reflect(direction, point.normal);
        let numbers = || sampler.pair(arrived.node, Use::Reflection);
        // The one pushed last is traced first.
        for (number, tangent, weight) in [
            (1, shading.refraction_spread, by_glass),
            (2, shading.reflection_spread, by_mirror),
        ] {
            let branch = Branch {
                number,
                direction: spread(mirrored, tangent, point.normal, numbers),
                weight,
                absorption: losses.mirrored,
            };
            self.push(arrived, point, &branch);
        }
    }

    fn push(&mut self, arrived: &Pending, point: &Point, branch: &Branch) {
        if branch.weight == Rgb::ZERO {
            return;
        }
        self.pending.push(Pending {
            ray: point.leave(branch.direction),
            weight: arrived.weight * branch.weight,
            absorption: branch.absorption,
            bounce: arrived.bounce + 1,
            node: Sampler::child(arrived.node, branch.number),
        });
    }
}

impl Pending {
    /// Which part of the radiance at a hit reaches the eye.
    fn through(&self, nearest: Nearest) -> Rgb {
        self.weight * transmitted(self.absorption, nearest.hit.t)
    }
}
