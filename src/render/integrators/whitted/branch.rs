//! Secondary rays of Whitted ray tracing.

use glam::DVec3;

use super::wave::{RayState, WhittedWave};
use crate::integrators::light_component::LightComponent;
use crate::integrators::probe::{Sample, SampleResult};
use crate::material::{
    Point, Refraction, facet, folded, fresnel, mirror, mirror_weight, reflect, refract_all,
    refraction_indices, spread,
};
use crate::sampling::{Purpose, Sampler};
use crate::world::HitPoints;
use geometry::lanes::{Eight, Row, Simd, WIDTH, bits};
use geometry::{Packet, Ray, Rays};
use scene::{GlossRule, Material, Reflectance, Rgb};

/// The secondary rays of a packet's points at perfect mirrors and clear boundaries, in each lane.
struct Specular<S: Simd> {
    mirrored: Rays<Eight<S>>,
    refracted: Rays<Eight<S>>,
    /// A bit for each lane without total internal reflection.
    passes: u32,
}

/// What a secondary ray is; its number among the point's rays selects its random numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Secondary {
    /// Refracted by a boundary.
    Refracted = 0,
    /// Reflected by a boundary.
    Boundary = 1,
    /// Reflected by a mirror, or by mirror and boundary in the same direction.
    Mirrored = 2,
}

impl Secondary {
    /// What the ray of a node is whose parent has this node.
    pub(crate) fn of(node: u32, parent: u32) -> Self {
        let is = |kind: &Self| kind.child(parent) == node;
        let kinds = [Self::Refracted, Self::Boundary, Self::Mirrored];
        kinds.into_iter().find(is).unwrap_or(Self::Mirrored)
    }

    /// The node of such a ray at the end of a ray with this node.
    fn child(self, node: u32) -> u32 {
        Sampler::child(node, self as u32)
    }
}

/// A secondary ray.
struct Branch {
    kind: Secondary,
    ray: Ray,
    /// Weight of its radiance in that of the point.
    weight: Rgb,
    /// Absorption per unit of length up to the next hit.
    absorption: Rgb,
}

impl WhittedWave<'_> {
    /// Adds the radiance of a packet's points to `seen` and pushes their secondary rays, the mirrored
    /// ray last because it is traced first. The next ray of each tree moves to the next front.
    #[inline(always)]
    pub(crate) fn branch_packet<S: Simd>(
        &mut self,
        simd: S,
        packet: usize,
        (depth, component, gloss): (u32, LightComponent, GlossRule),
        samples: &[Sample],
        seen: &mut [SampleResult],
    ) {
        let hit_points = &self.hit_points[packet];
        let first = packet * WIDTH;
        let packet = &self.front.rays[packet];
        let last = self.shaded.len().min(first + WIDTH);
        let all = &self.shaded[first..last];
        let states = &self.front.states[first..last];
        if hit_points.is_empty() {
            for state in states {
                self.trees[state.tree].move_on(None, &mut self.next);
            }
            return;
        }
        let mut specular = None;
        for (lane, (hit, state)) in all.iter().zip(states).enumerate() {
            let tree = &mut self.trees[state.tree];
            let material = hit.material.get(&self.mapped);
            if material.is_some() && component.surface(state.bounce) {
                seen[state.tree].radiance += hit.weight * hit.radiance;
            }
            let branching = material.filter(|material| {
                let mirrored = mirror_weight(material, hit_points.side(lane));
                let branches = mirrored != Rgb::ZERO || material.dielectric.tint != Rgb::ZERO;
                state.bounce != depth && branches
            });
            let mut pushed = None;
            if let Some(material) = branching {
                let found = || all.iter().map(|hit| hit.material.get(&self.mapped));
                let specular = match &specular {
                    Some(specular) => specular,
                    None => &*specular.insert(Specular::new(simd, packet, hit_points, found())),
                };
                let push = |branch: Branch| {
                    if branch.weight == Rgb::ZERO {
                        return;
                    }
                    let ray = (branch.ray, branch.state(state, hit.weight));
                    if let Some(before) = pushed.replace(ray) {
                        tree.pending.push(before);
                    }
                };
                let sampler = samples[state.tree].sampler;
                let numbers = |purpose| sampler.pair(state.node, purpose);
                if let Some(exponent) = material.facets(gloss) {
                    let point = hit_points.point(packet, lane);
                    let facet = facet(
                        point.normal,
                        point.view,
                        exponent,
                        numbers(Purpose::Reflection),
                    );
                    by_facet((&point, facet), material, push);
                } else {
                    specular.branch((packet, hit_points), lane, material, numbers, push);
                }
            }
            tree.move_on(pushed, &mut self.next);
        }
    }
}

impl<S: Simd> Specular<S> {
    #[inline(always)]
    fn new<'m>(
        simd: S,
        packet: &Packet,
        hit_points: &HitPoints,
        materials: impl Iterator<Item = Option<&'m Material>>,
    ) -> Self {
        let mut ratios = Row::all(1.0);
        for (lane, material) in materials.enumerate() {
            if let Some(material) = material {
                let [from, to] = refraction_indices(material, hit_points.side(lane));
                ratios.0[lane] = from / to;
            }
        }
        let surface = hit_points.surface.load(simd);
        let normal = hit_points.normal.load(simd);
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

    /// Pushes the secondary rays of the point in a lane.
    #[inline(always)]
    fn branch(
        &self,
        (packet, hit_points): (&Packet, &HitPoints),
        lane: usize,
        material: &Material,
        numbers: impl Fn(Purpose) -> Option<[f64; 2]>,
        mut push: impl FnMut(Branch),
    ) {
        let side = hit_points.side(lane);
        let point = || hit_points.point(packet, lane);
        let dielectric = &material.dielectric;
        let losses = material.losses(side);
        let mut by_mirror = mirror_weight(material, side);
        let mut by_boundary = Rgb::ZERO;
        if dielectric.tint != Rgb::ZERO {
            let passes = self.passes >> lane & 1 == 1;
            let ray = passes.then(|| self.refracted.ray(lane));
            let reflectance = match (ray, dielectric.reflectance) {
                (None, _) => 1.0,
                (Some(_), Reflectance::TotalOnly) => 0.0,
                (Some(ray), Reflectance::Schlick) => {
                    let point = point();
                    let [from, to] = refraction_indices(material, side);
                    let incident = point.view.dot(point.normal);
                    fresnel(from, incident, to, -ray.direction.dot(point.normal))
                }
            };
            by_boundary = reflectance * dielectric.tint;
            if let Some(ray) = ray {
                let numbers = || numbers(Purpose::Refraction);
                push(Branch {
                    kind: Secondary::Refracted,
                    ray: spread_ray(ray, dielectric.spread, -1.0, point, numbers),
                    weight: (1.0 - reflectance) * dielectric.tint,
                    absorption: losses.refracted,
                });
            }
        }
        if material.mirror.spread == dielectric.spread {
            // Both rays have the same direction and are traced as one.
            by_mirror += by_boundary;
            by_boundary = Rgb::ZERO;
        }
        // The last one pushed is traced first.
        for (kind, tangent, weight) in [
            (Secondary::Boundary, dielectric.spread, by_boundary),
            (Secondary::Mirrored, material.mirror.spread, by_mirror),
        ] {
            if weight == Rgb::ZERO {
                continue;
            }
            let numbers = || numbers(Purpose::Reflection);
            push(Branch {
                kind,
                ray: spread_ray(self.mirrored.ray(lane), tangent, 1.0, point, numbers),
                weight,
                absorption: losses.mirrored,
            });
        }
    }
}

/// Pushes the secondary rays of a point at a facet with this normal.
fn by_facet((point, facet): (&Point, DVec3), material: &Material, mut push: impl FnMut(Branch)) {
    let losses = material.losses(point.side);
    let dielectric = &material.dielectric;
    let leave =
        |direction, outward| point.leave(folded(direction, outward, (point.view, point.normal)));
    let mut mirrored = mirror_weight(material, point.side);
    if dielectric.tint != Rgb::ZERO {
        let indices = refraction_indices(material, point.side);
        let refraction = Refraction::new(-point.view, facet, indices, dielectric.reflectance);
        mirrored += refraction.reflectance * dielectric.tint;
        if let Some(refracted) = refraction.refracted {
            push(Branch {
                kind: Secondary::Refracted,
                ray: leave(refracted, -point.normal),
                weight: (1.0 - refraction.reflectance) * dielectric.tint,
                absorption: losses.refracted,
            });
        }
    }
    push(Branch {
        kind: Secondary::Mirrored,
        ray: leave(reflect(-point.view, facet), point.normal),
        weight: mirrored,
        absorption: losses.mirrored,
    });
}

/// Spreads a ray in a cone whose half angle has this tangent, on the side of the surface that its
/// normal times `side` points to.
#[inline(always)]
fn spread_ray(
    ray: Ray,
    tangent: f64,
    side: f64,
    point: impl Fn() -> Point,
    numbers: impl FnOnce() -> Option<[f64; 2]>,
) -> Ray {
    if tangent == 0.0 {
        return ray;
    }
    let point = point();
    point.leave(spread(ray.direction, tangent, side * point.normal, numbers))
}

impl Branch {
    /// Returns the state of its ray, given the state `from` of the incoming ray and the `weight` of
    /// the point's radiance in the pixel.
    #[inline(always)]
    fn state(&self, from: &RayState, weight: Rgb) -> RayState {
        RayState {
            tree: from.tree,
            weight: weight * self.weight,
            absorption: self.absorption,
            bounce: from.bounce + 1,
            node: self.kind.child(from.node),
        }
    }
}
