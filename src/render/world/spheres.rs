//! The spheres of a scene, laid out in the order of the tree's traversal.

use std::ops::Range;

use glam::DVec3;

use geometry::lanes::{Eight, Four, Lanes, Rows, Run, Several, Simd, SimdMask, Vector, bits};
use geometry::{IsCancelled, Ray, Rays, Shape, Solid, Sphere, may_meet};
use scene::Objects;

/// Three coordinates of the centre, and the radius.
const NUMBERS: usize = 4;

/// Centres and radii; the radius is NaN for other shapes.
#[derive(Debug)]
pub(crate) struct Spheres(Rows<f64, NUMBERS>);

/// The spheres of a run.
#[derive(Clone, Copy)]
pub(crate) struct SphereRun<'s> {
    rows: Run<'s, f64, NUMBERS>,
    length: usize,
}

/// What a ray may meet in a run.
#[derive(Clone, Copy)]
pub(crate) struct MayMeet {
    /// A mask of the spheres that it may meet.
    pub(crate) spheres: u32,
    /// A mask of the other shapes.
    pub(crate) others: u32,
}

impl Spheres {
    /// Collects the spheres among the objects with these numbers, in this order, which is visited in
    /// these runs. `None` once `cancelled` returns true.
    pub(crate) fn new(
        objects: &Objects,
        order: &[u32],
        runs: &[Range<usize>],
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        let numbers = |place: usize| match &objects[order[place] as usize].shape {
            Shape::Solid(Solid::Sphere(Sphere { centre, radius })) => {
                [centre.x, centre.y, centre.z, *radius]
            }
            _ => [0.0, 0.0, 0.0, f64::NAN],
        };
        Rows::new(runs, numbers, cancelled).map(Self)
    }

    /// The run with these places in the order.
    #[inline(always)]
    pub(crate) fn run(&self, places: &Range<usize>) -> SphereRun<'_> {
        SphereRun {
            rows: self.0.run(places),
            length: places.len(),
        }
    }
}

impl SphereRun<'_> {
    /// The sphere at a place, counted from the start of the run; `None` for other shapes.
    #[inline(always)]
    pub(crate) fn at(self, at: usize) -> Option<Sphere> {
        let number = |row| self.rows.number(row, at);
        let radius = number(3);
        (!radius.is_nan()).then(|| Sphere {
            centre: DVec3::new(number(0), number(1), number(2)),
            radius,
        })
    }

    /// What a ray may meet.
    #[inline(always)]
    pub(crate) fn may_meet<S: Simd>(self, simd: S, ray: &Ray) -> MayMeet {
        if self.length <= Four::<S>::COUNT {
            self.in_lanes::<S, Four<S>>(simd, ray)
        } else {
            self.in_lanes::<S, Eight<S>>(simd, ray)
        }
    }

    #[inline(always)]
    fn in_lanes<S: Simd, V: Several<S, Number = f64> + Lanes<Mask: SimdMask<S>>>(
        self,
        simd: S,
        ray: &Ray,
    ) -> MayMeet {
        let radius: V = self.rows.row(simd, 3);
        let centre = Vector {
            x: self.rows.row(simd, 0),
            y: self.rows.row(simd, 1),
            z: self.rows.row(simd, 2),
        };
        let rays = Rays {
            origin: Vector::all(radius, ray.origin),
            direction: Vector::all(radius, ray.direction),
        };
        let all = (1 << self.length) - 1;
        MayMeet {
            spheres: bits::<S>(may_meet(centre, radius, &rays)) & all,
            others: bits::<S>(!radius.equals(radius)) & all,
        }
    }
}
