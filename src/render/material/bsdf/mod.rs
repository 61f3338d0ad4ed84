//! Scattering of paths at surfaces: choice of the next direction, with its probability.

mod adjoint;

use glam::DVec3;

use crate::material::lobes::{LobeSamples, Lobes, Scattered};
use crate::material::microfacet::Microfacets;
use crate::material::optics::{Refraction, facet, folded, reflect, schlick, spread, strength};
use crate::material::point::Point;
use crate::material::{facets_reflectance, refraction_indices};
use crate::sampling::{Purpose, Sampler};
use geometry::Ray;
use scene::{GlossRule, Highlight, Material, Rgb};

/// A material at a point: lobes, mirror and dielectric boundary.
pub(crate) struct Bsdf<'m> {
    pub(crate) material: &'m Material,
    pub(crate) lobes: Lobes,
    /// Probability of continuing by the lobes.
    pub(crate) lobes_chance: f64,
    /// Mirror reflectance, not counting the boundary.
    pub(crate) mirror: Rgb,
    mirror_chance: f64,
    /// The exponent by which mirror and boundary are spread, if it is that of the highlight.
    pub(crate) facets: Option<f64>,
}

/// The part of a BSDF by which a path goes on, each with a number in 0..1 for further choices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Component {
    Lobes(f64),
    Mirror,
    Boundary(f64),
}

/// The continuation of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BsdfSample {
    pub(crate) ray: Ray,
    /// Factor on the throughput.
    pub(crate) weight: Rgb,
    /// Absorption per unit of length up to the next hit.
    pub(crate) absorption: Rgb,
    /// How the direction was chosen; `None` for mirrors and boundaries.
    pub(crate) chosen: Option<Scattering>,
}

/// The choice of a direction among many.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scattering {
    /// The point on the surface.
    pub(crate) point: DVec3,
    /// Its shading normal.
    pub(crate) normal: DVec3,
    /// The probability density of the direction per steradian.
    pub(crate) density: f64,
}

impl BsdfSample {
    /// A continuation by the lobes at a point.
    #[inline(always)]
    pub(crate) fn by_lobes(point: &Point, ray: Ray, weight: Rgb, density: f64) -> Self {
        Self {
            ray,
            weight,
            absorption: Rgb::ZERO,
            chosen: Some(Scattering {
                point: point.surface.point,
                normal: point.normal,
                density,
            }),
        }
    }
}

impl<'m> Bsdf<'m> {
    #[inline(always)]
    pub(crate) fn at(point: &Point, material: &'m Material, gloss: GlossRule) -> Self {
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
            let f0 = facets_reflectance(material, metallic);
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
            facets: material.facets(gloss),
        }
    }

    /// Samples a continuation for a path that arrived along `ray`, by its numbers for the bounce; `None`
    /// ends the path.
    pub(crate) fn sample(
        &self,
        ray: &Ray,
        point: &Point,
        [u, v, choice, _]: [f64; 4],
        (sampler, bounce): (Sampler, u32),
    ) -> Option<BsdfSample> {
        let numbers = || {
            let [u, v, ..] = sampler.four(bounce, Purpose::Spread);
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
        let spreading = |direction, tangent, outward| match self.facets {
            Some(_) => folded(direction, outward, (point.view, point.normal)),
            None => spread(direction, tangent, outward, numbers),
        };
        let component = self.component(choice)?;
        let chance = self.chance(component);
        match component {
            Component::Lobes(choice) => {
                let direction = self.lobes.choose(point, choice, [u, v]);
                let Scattered { value, density } = self.lobes.scatter(point, direction);
                let LobeSamples {
                    weight,
                    density,
                    leads_on,
                } = LobeSamples::new(chance, (value.into(), density));
                let ray = || point.leave(direction);
                leads_on.then(|| BsdfSample::by_lobes(point, ray(), weight.into(), density))
            }
            Component::Mirror => {
                let losses = self.material.losses(point.side);
                let facet = self.facet(point, sampler, bounce);
                let mirrored = reflect(ray.direction, facet);
                let tangent = self.material.mirror.spread;
                let direction = spreading(mirrored, tangent, point.normal);
                specular(direction, self.mirror / chance, losses.mirrored)
            }
            Component::Boundary(choice) => {
                let losses = self.material.losses(point.side);
                let dielectric = &self.material.dielectric;
                let weight = dielectric.tint / chance;
                let tangent = dielectric.spread;
                let facet = self.facet(point, sampler, bounce);
                if let Some(refracted) = self.refracted(ray, (point, facet), choice) {
                    let direction = spreading(refracted, tangent, -point.normal);
                    return specular(direction, weight, losses.refracted);
                }
                let mirrored = reflect(ray.direction, facet);
                let direction = spreading(mirrored, tangent, point.normal);
                specular(direction, weight, losses.mirrored)
            }
        }
    }

    /// The component that a number in 0..1 chooses; `None` if there is none.
    pub(crate) fn component(&self, choice: f64) -> Option<Component> {
        let choice = self.in_order(choice);
        if choice < self.lobes_chance {
            return Some(Component::Lobes(choice / self.lobes_chance));
        }
        let choice = choice - self.lobes_chance;
        if choice < self.mirror_chance {
            return Some(Component::Mirror);
        }
        let chance = self.boundary_chance();
        let is_clear = self.material.dielectric.tint != Rgb::ZERO && 0.0 < chance;
        is_clear.then(|| Component::Boundary((choice - self.mirror_chance) / chance))
    }

    /// Whether light is scattered into many directions, beside mirror and boundary.
    pub(crate) fn scatters(&self) -> bool {
        0.0 < self.lobes_chance || self.lobes.gloss().is_some()
    }

    /// Whether photons that arrive at a point of it are kept.
    pub(crate) fn takes_photons(&self, point: &Point) -> bool {
        self.material.is_lit(point.side) && self.scatters()
    }

    /// Whether there is any component.
    pub(crate) fn can_go_on(&self) -> bool {
        let of_surface = self.lobes_chance + self.mirror_chance;
        0.0 < of_surface || self.material.dielectric.tint != Rgb::ZERO
    }

    /// The probability of going on by a component.
    pub(crate) fn chance(&self, component: Component) -> f64 {
        match component {
            Component::Lobes(_) => self.lobes_chance,
            Component::Mirror => self.mirror_chance,
            Component::Boundary(_) => self.boundary_chance(),
        }
    }

    fn boundary_chance(&self) -> f64 {
        1.0 - self.lobes_chance - self.mirror_chance
    }

    /// The normal by which mirror and boundary turn a path: that of the surface or of a facet.
    pub(crate) fn facet(&self, point: &Point, sampler: Sampler, bounce: u32) -> DVec3 {
        let Some(exponent) = self.facets else {
            return point.normal;
        };
        let [u, v, ..] = sampler.four(bounce, Purpose::Spread);
        facet(point.normal, point.view, exponent, Some([u, v]))
    }

    /// The refracted direction at a facet with this normal if a number in 0..1 lets a path pass the
    /// boundary, else `None`.
    pub(crate) fn refracted(
        &self,
        ray: &Ray,
        (point, facet): (&Point, DVec3),
        choice: f64,
    ) -> Option<DVec3> {
        let indices = refraction_indices(self.material, point.side);
        let model = self.material.dielectric.reflectance;
        let refraction = Refraction::new(ray.direction, facet, indices, model);
        let Refraction {
            reflectance,
            refracted,
        } = refraction;
        refracted.filter(|_| reflectance <= choice)
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
