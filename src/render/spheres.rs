//! The spheres among a scene's objects, side by side in the order that the tree visits them in.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::accel::RUN;
use crate::geometry::lanes::{Eight, Lanes, Simd, SimdBase, Vector, bits};
use crate::geometry::{Hits, Rays, Shape, sphere_hits};
use crate::scene::Object;

/// Centres and radii by place; the radius is NaN where an object is no sphere, and after the last.
#[derive(Clone, Debug)]
pub(crate) struct Spheres {
    x: Vec<f64>,
    y: Vec<f64>,
    z: Vec<f64>,
    radius: Vec<f64>,
}

impl Spheres {
    /// Those among the objects with these numbers, in their order.
    pub(crate) fn new(objects: &[Object], order: &[u32]) -> Self {
        // Zeros are memory that nobody has touched yet; the threads below do.
        let untouched = || vec![0.0; order.len() + RUN];
        let mut spheres = Self {
            x: untouched(),
            y: untouched(),
            z: untouched(),
            radius: untouched(),
        };
        spheres.radius[order.len()..].fill(f64::NAN);
        let x = spheres.x.par_iter_mut();
        let rest = spheres.y.par_iter_mut().zip(&mut spheres.z);
        let places = x.zip(rest).zip(&mut spheres.radius).zip(order);
        places.for_each(|(((x, (y, z)), radius), &object)| {
            *radius = f64::NAN;
            if let Shape::Sphere(sphere) = &objects[object as usize].shape {
                [*x, *y, *z] = sphere.centre.to_array();
                *radius = sphere.radius;
            }
        });
        spheres
    }

    /// Centre and radius of the sphere at a place; `None` if the object there is none.
    #[inline]
    pub(crate) fn at(&self, place: usize) -> Option<(DVec3, f64)> {
        let radius = self.radius[place];
        let centre = DVec3::new(self.x[place], self.y[place], self.z[place]);
        (!radius.is_nan()).then_some((centre, radius))
    }

    /// Where a ray, the same in each lane, meets spheres of a run before a limit, and a bit for each
    /// place of the run that is no sphere.
    #[expect(
        clippy::inline_always,
        reason = "a caller compiled for wider vectors must take this with it"
    )]
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(
        &self,
        ray: &Rays<Eight<S>>,
        limit: f64,
        places: &Range<usize>,
    ) -> (Option<Hits>, u32) {
        let simd = ray.origin.x.simd;
        let run = places.start..places.start + RUN;
        let all = (1 << places.len()) - 1;
        let radius = Eight::from_slice(simd, &self.radius[run.clone()]);
        let spheres = bits::<S>(radius.equals(radius)) & all;
        if spheres == 0 {
            return (None, all);
        }
        let centre = Vector {
            x: Eight::from_slice(simd, &self.x[run.clone()]),
            y: Eight::from_slice(simd, &self.y[run.clone()]),
            z: Eight::from_slice(simd, &self.z[run]),
        };
        let limits = Eight::splat(simd, limit);
        let hits = sphere_hits(centre, radius, ray, limits, spheres);
        (hits, all & !spheres)
    }
}
