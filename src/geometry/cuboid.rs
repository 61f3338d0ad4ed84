//! Affine images of the cube [0, 1]³.

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{End, Ends, slab};
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

/// An affine image of the cube [0, 1]³.
///
/// Parts 2i and 2i + 1 are the faces at coordinate i = 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cuboid(pub Affine);

impl Cuboid {
    /// The tight axis-aligned box: each corner is the sum of the edges that point toward it.
    pub fn bounds(&self) -> Aabb {
        let origin = self.0.origin();
        let [u, v, w] = self.0.axes();
        let zero = DVec3::ZERO;
        Aabb {
            min: origin + (u.min(zero) + v.min(zero) + w.min(zero)),
            max: origin + (u.max(zero) + v.max(zero) + w.max(zero)),
        }
    }

    /// Intersects lines with the box, in each lane: the overlap of three slabs.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let found = slab(line.origin.x, line.direction.x, [0, 1])?
            .overlap(slab(line.origin.y, line.direction.y, [2, 3])?)?
            .overlap(slab(line.origin.z, line.direction.z, [4, 5])?)?
            .shifted(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surface at a hit, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let position = self.0.positions(rays, at.t);
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
                x: x.put(position.x, margin.x),
                y: y.put(position.y, margin.y),
                z: z.put(position.z, margin.z),
            },
        )
    }

    /// The texture coordinates at a hit: the face's two coordinates as fractions of its edges.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, |position| {
            Chart::of_face(position, (hit.part / 2) as usize % 3)
        })
    }
}

/// Whether a part is the low or the high face across an axis, in each lane.
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

    /// The outward normal's coordinate on this axis.
    #[inline(always)]
    fn outward(self) -> N {
        let zero = self.zero;
        N::select(
            self.high,
            zero.all(1.0),
            N::select(self.low, zero.all(-1.0), zero),
        )
    }

    /// Moves a coordinate onto the face, or at least a margin away from both faces of the axis.
    #[inline(always)]
    fn put(self, position: N, margin: N) -> N {
        let one = position.all(1.0);
        let inside = position.larger(margin).smaller(one - margin);
        N::select(self.high, one, N::select(self.low, self.zero, inside))
    }
}
