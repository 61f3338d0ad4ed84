//! The spheres of a scene, as arrays in the order of the tree's traversal.

use std::ops::Range;

use glam::DVec3;
use rayon::prelude::*;

use crate::accel::RUN;
use crate::geometry::lanes::{Eight, Lanes, Simd, SimdBase, Vector, bits};
use crate::geometry::{Hits, Rays, Shape, Solid, Sphere, sphere_hits};
use crate::scene::Objects;

/// Centres and radii by position; the radius is NaN for other shapes and in the padding at the end.
#[derive(Clone, Debug)]
pub(crate) struct Spheres(Vec<[f64; 4]>);

impl Spheres {
    /// Collects the spheres among the objects with these numbers, in this order.
    pub(crate) fn new(objects: &Objects, order: &[u32]) -> Self {
        // Zeroed memory is untouched; the threads below touch it first.
        let mut spheres = vec![[0.0; 4]; order.len() + RUN];
        let (inside, after) = spheres.split_at_mut(order.len());
        after.fill([0.0, 0.0, 0.0, f64::NAN]);
        let places = inside.par_iter_mut().zip(order);
        places.for_each(|(place, &object)| {
            *place = match &objects[object as usize].shape {
                Shape::Solid(Solid::Sphere(Sphere { centre, radius })) => {
                    [centre.x, centre.y, centre.z, *radius]
                }
                _ => [0.0, 0.0, 0.0, f64::NAN],
            };
        });
        Self(spheres)
    }

    /// Returns the centre and radius of the sphere at a position; `None` for other shapes.
    #[inline]
    pub(crate) fn at(&self, place: usize) -> Option<(DVec3, f64)> {
        let [x, y, z, radius] = self.0[place];
        (!radius.is_nan()).then_some((DVec3::new(x, y, z), radius))
    }

    /// Intersects a ray, equal in each lane, with the spheres of a run before a limit; also returns
    /// a bit for each position of the run that holds another shape.
    #[inline(always)]
    pub(crate) fn hits<S: Simd>(
        &self,
        ray: &Rays<Eight<S>>,
        limit: f64,
        places: &Range<usize>,
    ) -> (Option<Hits>, u32) {
        let simd = ray.origin.x.simd;
        // The padding is as long as a run.
        let run: &[[f64; 4]; RUN] = self.0[places.start..]
            .first_chunk()
            .expect("the padding holds a full run");
        let radius = row(simd, run, 3);
        let all = (1 << places.len()) - 1;
        let spheres = bits::<S>(radius.equals(radius)) & all;
        if spheres == 0 {
            return (None, all);
        }
        let centre = Vector {
            x: row(simd, run, 0),
            y: row(simd, run, 1),
            z: row(simd, run, 2),
        };
        let limits = Eight::splat(simd, limit);
        let hits = sphere_hits(centre, radius, ray, limits, spheres);
        (hits, all & !spheres)
    }
}

/// One coordinate of each sphere.
#[inline(always)]
fn row<S: Simd>(simd: S, spheres: &[[f64; 4]; RUN], number: usize) -> Eight<S> {
    let mut row = [0.0; RUN];
    for (own, sphere) in row.iter_mut().zip(spheres) {
        *own = sphere[number];
    }
    Eight::load_array(simd, row)
}
