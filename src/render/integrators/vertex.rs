//! Surfaces that paths reach.

use crate::material::{Bsdf, BsdfSample, Point};
use crate::sampling::Sampler;
use crate::world::{Nearest, World};
use geometry::Ray;
use scene::Material;

/// A surface that a path reached.
pub(crate) struct Vertex<'m> {
    pub(crate) nearest: Nearest,
    pub(crate) point: Point,
    pub(crate) material: &'m Material,
    pub(crate) bsdf: Bsdf<'m>,
}

impl<'m> Vertex<'m> {
    /// Where a ray hit, with the material there.
    #[inline(always)]
    pub(crate) fn new(
        world: &World,
        nearest: Nearest,
        point: Point,
        material: &'m Material,
    ) -> Self {
        Self {
            nearest,
            bsdf: Bsdf::at(&point, material, world.gloss),
            point,
            material,
        }
    }

    /// Samples the continuation of a path that arrived along a ray, by its numbers for the bounce;
    /// `None` at its end.
    pub(crate) fn sample(
        &self,
        ray: &Ray,
        numbers: [f64; 4],
        at: (Sampler, u32),
    ) -> Option<BsdfSample> {
        self.bsdf.sample(ray, &self.point, numbers, at)
    }
}
