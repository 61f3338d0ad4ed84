//! Scattering of paths at surfaces: choice of the next direction, with its probability.

use glam::DVec3;

use super::lobes::{Lobes, strength};
use super::microfacet::Microfacets;
use super::optics::{Refraction, reflect, schlick, spread};
use super::probe::Point;
use super::sampler::{Sampler, Use};
use crate::geometry::Ray;
use crate::scene::{Highlight, Material, Rgb};

/// A material at a point: lobes, mirror and dielectric boundary.
pub(crate) struct Bsdf<'m> {
    material: &'m Material,
    pub(crate) lobes: Lobes,
    /// Probability of continuing by the lobes.
    pub(crate) lobes_chance: f64,
    /// Mirror reflectance, not counting the boundary.
    mirror: Rgb,
    mirror_chance: f64,
}

/// The continuation of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BsdfSample {
    pub(crate) ray: Ray,
    /// Factor on the throughput.
    pub(crate) weight: Rgb,
    /// Absorption per unit of length up to the next hit.
    pub(crate) absorption: Rgb,
    /// The point on the surface and the probability density of the direction per steradian; `None`
    /// for mirrors and boundaries.
    pub(crate) chosen: Option<(DVec3, f64)>,
}

impl<'m> Bsdf<'m> {
    #[inline(always)]
    pub(crate) fn at(point: &Point, material: &'m Material) -> Self {
        let is_lit = material.is_lit(point.side);
        let (lobes, of_lobes) = Lobes::of(point, material);
        let of_lobes = if is_lit { of_lobes } else { 0.0 };
        let mut mirror = material.mirror_tint(point.side);
        if let Highlight::Microfacet {
            roughness,
            metallic,
        } = material.highlight
            && is_lit
            && Microfacets::is_perfect(roughness * roughness)
        {
            let f0 = material.facets_reflectance(metallic);
            let cosine = point.normal.dot(point.view);
            mirror += f0 + (Rgb::ONE - f0) * schlick(cosine);
        }
        let total = of_lobes + strength(mirror) + strength(material.dielectric.tint);
        let chance = |strength: f64| if total == 0.0 { 0.0 } else { strength / total };
        Self {
            material,
            lobes,
            lobes_chance: chance(of_lobes),
            mirror,
            mirror_chance: chance(strength(mirror)),
        }
    }

    /// Samples a continuation for a path that arrived along `ray`; `None` ends the path.
    pub(crate) fn sample(
        &self,
        ray: &Ray,
        point: &Point,
        sampler: Sampler,
        bounce: u32,
    ) -> Option<BsdfSample> {
        let [choice, u, v, _] = sampler.four(bounce, Use::Bounce);
        let choice = self.in_order(choice);
        if choice < self.lobes_chance {
            let direction = self.lobes.choose(point, choice / self.lobes_chance, [u, v]);
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
        let losses = self.material.losses(point.side);
        let mirrored = reflect(ray.direction, point.normal);
        let choice = choice - self.lobes_chance;
        if choice < self.mirror_chance {
            let tangent = self.material.mirror.spread;
            let direction = spread(mirrored, tangent, point.normal, numbers);
            return specular(direction, self.mirror / self.mirror_chance, losses.mirrored);
        }
        let chance = 1.0 - self.lobes_chance - self.mirror_chance;
        let dielectric = &self.material.dielectric;
        if dielectric.tint == Rgb::ZERO || chance <= 0.0 {
            return None;
        }
        let weight = dielectric.tint / chance;
        let choice = (choice - self.mirror_chance) / chance;
        let tangent = dielectric.spread;
        let indices = self.material.indices(point.side);
        let Refraction {
            reflectance,
            refracted,
        } = Refraction::new(ray.direction, point.normal, indices, dielectric.reflectance);
        if let Some(refracted) = refracted.filter(|_| reflectance <= choice) {
            let direction = spread(refracted, tangent, -point.normal, numbers);
            return specular(direction, weight, losses.refracted);
        }
        let direction = spread(mirrored, tangent, point.normal, numbers);
        specular(direction, weight, losses.mirrored)
    }

    /// Rotates the number that chooses a component, so that their order is lobes, mirror, boundary;
    /// for a highlight that is not a lobe, the lobes come last.
    fn in_order(&self, choice: f64) -> f64 {
        let Highlight::Phong(_) = self.material.highlight else {
            return choice;
        };
        let turned = choice + self.lobes_chance;
        if turned < 1.0 { turned } else { turned - 1.0 }
    }
}
