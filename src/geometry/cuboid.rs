//! Affine images of the cube [0, 1]³.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{End, Ends, slab};
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

/// An affine image of the cube [0, 1]³.
///
/// Parts 2i and 2i + 1 are the faces where coordinate i is 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid(pub Affine);

impl Cuboid {
    /// The tight axis-aligned box: a corner of it is the sum of the edges that point its way.
    pub fn bounds(&self) -> Aabb {
        let origin = self.0.origin();
        let [u, v, w] = self.0.axes();
        let zero = DVec3::ZERO;
        Aabb {
            min: origin + (u.min(zero) + v.min(zero) + w.min(zero)),
            max: origin + (u.max(zero) + v.max(zero) + w.max(zero)),
        }
    }

    /// Where the lines cross the box, in each lane: where they are between all three pairs of faces.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let found = slab(line.origin.x, line.direction.x, [0, 1])?
            .overlap(slab(line.origin.y, line.direction.y, [2, 3])?)?
            .overlap(slab(line.origin.z, line.direction.z, [4, 5])?)?
            .after(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surfaces at hits, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let place = self.0.places(rays, at.t);
        let x = Face::new(at.part, [0, 1]);
        let y = Face::new(at.part, [2, 3]);
        let z = Face::new(at.part, [4, 5]);
        let outward = Vector {
            x: x.outward(),
            y: y.outward(),
            z: z.outward(),
        };
        self.0.surface(
            outward,
            #[inline(always)]
            |margin| Vector {
                x: x.put(place.x, margin.x),
                y: y.put(place.y, margin.y),
                z: z.put(place.z, margin.z),
            },
        )
    }

    /// The texture coordinates at a hit: the face's two coordinates as fractions of its edges.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, |place| {
            Chart::of_face(place, (hit.part / 2) as usize % 3)
        })
    }
}

/// Which of the two faces across an axis a part is, if it is one.
#[derive(Clone, Copy)]
struct Face<N: Lanes> {
    low: N::Mask,
    high: N::Mask,
    zero: N,
}

impl<N: Lanes> Face<N> {
    #[inline(always)]
    fn new(part: N, [low, high]: [u32; 2]) -> Self {
        Self {
            low: part.equals(part.all(low.into())),
            high: part.equals(part.all(high.into())),
            zero: part.all(0.0),
        }
    }

    /// The normal's coordinate.
    #[inline(always)]
    fn outward(self) -> N {
        let zero = self.zero;
        N::select(
            self.high,
            zero.all(1.0),
            N::select(self.low, zero.all(-1.0), zero),
        )
    }

    /// A place's coordinate: that of the face itself, or at least a margin from faces beside it.
    #[inline(always)]
    fn put(self, place: N, margin: N) -> N {
        let one = place.all(1.0);
        let inside = place.larger(margin).smaller(one - margin);
        N::select(self.high, one, N::select(self.low, self.zero, inside))
    }
}
