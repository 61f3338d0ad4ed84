//! How rays go on from the surfaces that they have come to.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use super::optics::{Dielectric, index, mirror, refract_all, spread};
use super::probe::{Matter, Point, Sample, Seen};
use super::sampler::{Sampler, Use};
use super::surfaces::Landing;
use super::utah::Shading;
use super::wave::{Arrived, Wave, Way};
use crate::geometry::lanes::{Eight, Row, Simd, WIDTH, bits};
use crate::geometry::{Packet, Ray, Rays};
use crate::scene::Rgb;

/// Rays that go on from a packet's points where matter is clear, in each lane.
struct Clear<S: Simd> {
    mirrored: Rays<Eight<S>>,
    refracted: Rays<Eight<S>>,
    /// A bit for each lane that has no total internal reflection.
    passes: u32,
}

/// A ray that goes on from a point.
struct Branch {
    /// Which one of the point's it is.
    number: u32,
    ray: Ray,
    /// Which part of its radiance leaves the point toward where the ray came from.
    weight: Rgb,
    /// What is lost per unit of length until it meets something.
    absorption: Rgb,
}

impl Wave<'_> {
    /// Adds what leaves the points that a packet has come to to what is seen, and leaves the rays that
    /// go on pending: the mirrored one last, which is to be traced first.
    #[inline(always)]
    pub(super) fn go_on<S: Simd>(
        &mut self,
        simd: S,
        packet: usize,
        depth: u32,
        samples: &[Sample],
        seen: &mut [Seen],
    ) {
        let landing = &self.landings[packet];
        let first = packet * WIDTH;
        let packet = &self.rays[packet];
        let last = self.arrived.len().min(first + WIDTH);
        let all = &self.arrived[first..last];
        let ways = &self.ways[first..last];
        let mut clear = None;
        for (lane, (arrived, way)) in all.iter().zip(ways).enumerate() {
            if let Matter::Flat(_) = arrived.matter {
                continue;
            }
            seen[way.tree].radiance += arrived.weight * arrived.radiance;
            if way.bounce == depth {
                continue;
            }
            let pending = &mut self.trees[way.tree].pending;
            let mut push = |branch: Branch| {
                if branch.weight != Rgb::ZERO {
                    pending.push((branch.ray, branch.way(way, arrived.weight)));
                }
            };
            match &arrived.matter {
                Matter::Phong(material) => {
                    let mut mirrored_weight = material.reflection;
                    let branch = |number, ray, weight| Branch {
                        number,
                        ray,
                        weight: Rgb::splat(weight),
                        absorption: Rgb::ZERO,
                    };
                    if material.reflection == 0.0 && material.transmission == 0.0 {
                        continue;
                    }
                    let clear = match &clear {
                        Some(clear) => clear,
                        None => &*clear.insert(Clear::new(simd, packet, landing, all)),
                    };
                    if material.transmission != 0.0 {
                        if clear.passes >> lane & 1 == 1 {
                            push(branch(0, clear.refracted.ray(lane), material.transmission));
                        } else {
                            // Both rays go the same way and are traced as one.
                            mirrored_weight += material.transmission;
                        }
                    }
                    push(branch(1, clear.mirrored.ray(lane), mirrored_weight));
                }
                Matter::Utah(shading) => {
                    let point = landing.point(packet, lane);
                    let sampler = samples[way.tree].sampler;
                    let numbers = |purpose| sampler.pair(way.node, purpose);
                    branch_by_fresnel(&point, shading, numbers, push);
                }
                Matter::Flat(_) => {}
            }
        }
    }
}

impl<S: Simd> Clear<S> {
    #[inline(always)]
    fn new(simd: S, packet: &Packet, landing: &Landing, arrived: &[Arrived<'_>]) -> Self {
        let mut ratios = Row::all(1.0);
        for (lane, arrived) in arrived.iter().enumerate() {
            if let Matter::Phong(material) = &arrived.matter {
                let index = index(material.index);
                let front = landing.is_front(lane);
                ratios.0[lane] = if front { 1.0 / index } else { index };
            }
        }
        let surface = landing.surface.load(simd);
        let normal = landing.normal.load(simd);
        let direction = packet.rays.direction.load(simd);
        let mirrored = mirror(direction, normal);
        let (refracted, passes) = refract_all(direction, normal, ratios.load(simd));
        Self {
            mirrored: Rays {
                origin: surface.leave(mirrored),
                direction: mirrored,
            },
            refracted: Rays {
                origin: surface.leave(refracted),
                direction: refracted,
            },
            passes: bits::<S>(passes),
        }
    }
}

impl Branch {
    /// What its ray brings with it, from a point where a ray came that brought the other, and whose
    /// radiance reaches the eye in part.
    #[inline(always)]
    fn way(&self, from: &Way, weight: Rgb) -> Way {
        Way {
            tree: from.tree,
            weight: weight * self.weight,
            absorption: self.absorption,
            bounce: from.bounce + 1,
            node: Sampler::child(from.node, self.number),
        }
    }
}

/// The rays that go on where how much goes which way depends on the angle.
fn branch_by_fresnel(
    point: &Point,
    shading: &Shading,
    numbers: impl Fn(Use) -> Option<[f64; 2]>,
    mut push: impl FnMut(Branch),
) {
    let direction = -point.view;
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
            let numbers = || numbers(Use::Refraction);
            let spread = spread(refracted, shading.refraction_spread, -point.normal, numbers);
            push(Branch {
                number: 0,
                ray: point.leave(spread),
                weight: (1.0 - reflectance) * shading.refraction,
                absorption: losses.refracted,
            });
        }
    }
    if shading.reflection_spread == shading.refraction_spread {
        by_mirror += by_glass;
        by_glass = Rgb::ZERO;
    }
    // The one pushed last is traced first.
    for (number, tangent, weight) in [
        (1, shading.refraction_spread, by_glass),
        (2, shading.reflection_spread, by_mirror),
    ] {
        if weight == Rgb::ZERO {
            continue;
        }
        let mirrored = mirror(direction.into(), point.normal.into()).into();
        let numbers = || numbers(Use::Reflection);
        let spread = spread(mirrored, tangent, point.normal, numbers);
        push(Branch {
            number,
            ray: point.leave(spread),
            weight,
            absorption: losses.mirrored,
        });
    }
}
