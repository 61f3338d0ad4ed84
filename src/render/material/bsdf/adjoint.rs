//! Photons at mirrors and boundaries: the adjoint of how paths go on there.
//!
//! A path's radiance is not scaled by the square of the indices at a boundary, and its directions
//! follow shading normals; the factors on a photon's flux make both estimate the same light (Veach,
//! "Robust Monte Carlo Methods for Light Transport Simulation", 1997, chapter 5). With l the
//! direction toward where a photon came from, v that in which it leaves, H the normal that turns it
//! and G the geometric one, they are |l·H| |v·G| / (|l·G| |v·H|), and at a boundary the square of the
//! index on the side of l over that on the side of v. Directions that facets fold back to the surface
//! are taken as if that were symmetric, which it is for cones.

use glam::DVec3;

use super::Bsdf;
use crate::material::{Point, Refraction, folded, reflect, refraction_indices, spread, strength};
use crate::sampling::{Purpose, Sampler};
use geometry::{Ray, Side};
use scene::Rgb;

/// How a photon goes on from a surface.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AdjointSample {
    pub(crate) ray: Ray,
    /// Factor on its power.
    pub(crate) weight: Rgb,
    /// Absorption per unit of length on the way to this surface: that of a path which leaves it in
    /// the opposite direction.
    pub(crate) absorption: Rgb,
}

/// A photon that meets a specular surface.
struct Meeting<'a> {
    bsdf: &'a Bsdf<'a>,
    point: &'a Point,
    /// The normal that turns it.
    facet: DVec3,
    /// By which cones spread its direction.
    numbers: [f64; 2],
}

impl Bsdf<'_> {
    /// Samples how a photon that arrives at a point after some bounces goes on; `None` where it ends.
    pub(crate) fn sample_adjoint(
        &self,
        point: &Point,
        sampler: Sampler,
        bounce: u32,
    ) -> Option<AdjointSample> {
        let tint = self.material.dielectric.tint;
        let of_mirror = strength(self.mirror);
        let total = of_mirror + strength(tint);
        let kept = total.min(1.0);
        let [choice, way, ..] = sampler.four(bounce, Purpose::Bounce);
        if kept <= choice || kept == 0.0 {
            return None;
        }
        let [u, v, ..] = sampler.four(bounce, Purpose::Spread);
        let meeting = Meeting {
            bsdf: self,
            point,
            facet: self.facet(point, sampler, bounce),
            numbers: [u, v],
        };
        let by_mirror = kept * (of_mirror / total);
        if choice < by_mirror {
            let to = meeting.mirrored(self.material.mirror.spread);
            meeting.reflected(to, self.mirror / by_mirror)
        } else {
            meeting.at_boundary(tint / (kept - by_mirror), way)
        }
    }
}

impl Meeting<'_> {
    /// Reflects or refracts a photon whose power is multiplied by `weight`, by a number in 0..1.
    fn at_boundary(&self, weight: Rgb, way: f64) -> Option<AdjointSample> {
        let Self { bsdf, point, .. } = self;
        let dielectric = &bsdf.material.dielectric;
        let is_cone = bsdf.facets.is_none() && dielectric.spread != 0.0;
        let plain = self.refraction(-point.view);
        // A path reflects by the angle at which it arrives, which differs from the photon's if a
        // cone lies between.
        let chance = if is_cone {
            0.25 + 0.5 * plain.reflectance
        } else {
            plain.reflectance
        };
        if way < chance {
            let to = self.mirrored(dielectric.spread);
            let met = if is_cone { self.refraction(-to) } else { plain };
            return self.reflected(to, weight * (met.reflectance / chance));
        }
        // The axis of a path's cone.
        let axis = self.scattered(point.view, dielectric.spread, point.normal);
        let met = if is_cone {
            self.refraction(-axis)
        } else {
            plain
        };
        let to = match bsdf.facets {
            Some(_) => self.scattered(met.refracted?, 0.0, -point.normal),
            None => met.refracted?,
        };
        let opposite = self.side_of_path(to);
        if opposite == point.side {
            return None;
        }
        let [index_from, index_to] = refraction_indices(bsdf.material, point.side);
        let ratio = index_from / index_to;
        let passing = (1.0 - met.reflectance) / (1.0 - chance);
        let by_facet = axis.dot(self.facet).abs() / to.dot(self.facet).abs();
        let weight = weight * (passing * ratio * ratio * by_facet);
        let absorption = bsdf.material.losses(opposite).refracted;
        self.leaving(to, weight, absorption)
    }

    /// Reflects a photon.
    fn reflected(&self, to: DVec3, weight: Rgb) -> Option<AdjointSample> {
        let side = self.point.side;
        let losses = self.bsdf.material.losses(side);
        let is_reflected = self.side_of_path(to) == side;
        is_reflected.then(|| self.leaving(to, weight, losses.mirrored))?
    }

    fn leaving(&self, to: DVec3, weight: Rgb, absorption: Rgb) -> Option<AdjointSample> {
        let geometric = self.point.surface.normal;
        let factor = to.dot(geometric).abs() / self.point.view.dot(geometric).abs();
        factor.is_finite().then(|| AdjointSample {
            ray: self.point.leave(to),
            weight: weight * factor,
            absorption,
        })
    }

    fn refraction(&self, direction: DVec3) -> Refraction {
        let material = self.bsdf.material;
        let indices = refraction_indices(material, self.point.side);
        Refraction::new(
            direction,
            self.facet,
            indices,
            material.dielectric.reflectance,
        )
    }

    /// The direction of a reflected photon.
    fn mirrored(&self, tangent: f64) -> DVec3 {
        let mirrored = reflect(-self.point.view, self.facet);
        self.scattered(mirrored, tangent, self.point.normal)
    }

    /// Spreads a direction in a cone, or folds back that which a facet leads to.
    fn scattered(&self, direction: DVec3, tangent: f64, outward: DVec3) -> DVec3 {
        match self.bsdf.facets {
            Some(_) => folded(direction, outward, (self.point.view, self.point.normal)),
            None => spread(direction, tangent, outward, || Some(self.numbers)),
        }
    }

    /// The side at which a path arrives along the way on which a photon leaves.
    fn side_of_path(&self, to: DVec3) -> Side {
        Side::hit(-to, self.point.surface.normal)
    }
}
