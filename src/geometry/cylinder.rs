//! Affine images of the cylinder x² + y² ≤ 1, 0 ≤ z ≤ 1.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{End, Ends, ball, slab};
use super::transform::normalised;
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

const BASE: u32 = 1;
const TOP: u32 = 2;

/// An affine image of the cylinder x² + y² ≤ 1, 0 ≤ z ≤ 1.
///
/// Part 0 is the side, 1 the base at z = 0, 2 the top at z = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder(pub Affine);

impl Cylinder {
    /// The tight axis-aligned box: of the base and of the top.
    pub fn bounds(&self) -> Aabb {
        let base = self.0.origin();
        let [_, _, axis] = self.0.axes();
        let half = self.0.reach_of_disc([0, 1]);
        Aabb {
            min: base + axis.min(DVec3::ZERO) - half,
            max: base + axis.max(DVec3::ZERO) + half,
        }
    }

    /// Where the lines cross the cylinder, in each lane: where they are inside the endless side, which
    /// is a circle in the plane, and between the caps.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let found = slab(line.origin.z, line.direction.z, [BASE, TOP])?
            .overlap(inside_side(line.origin.flat(), line.direction.flat())?)?
            .after(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surfaces at hits, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let (zero, one) = (at.t.all(0.0), at.t.all(1.0));
        let place = self.0.places(rays, at.t);
        let flat = place.flat();
        let on_base = at.part.equals(one);
        let on_top = at.part.equals(at.part.all(TOP.into()));
        let on_cap = on_base | on_top;
        let radial = normalised(flat, DVec3::X);
        let outward = Vector {
            x: N::select(on_cap, zero, radial.x),
            y: N::select(on_cap, zero, radial.y),
            z: N::select(on_top, one, N::select(on_base, -one, zero)),
        };
        self.0.surface(
            outward,
            #[inline(always)]
            |margin| {
                let across = flat.within(one - (margin.x + margin.y));
                let height = place.z.larger(margin.z).smaller(one - margin.z);
                Vector {
                    x: N::select(on_cap, across.x, radial.x),
                    y: N::select(on_cap, across.y, radial.y),
                    z: N::select(on_top, one, N::select(on_base, zero, height)),
                }
            },
        )
    }

    /// The texture coordinates at a hit: around the side and up it, or across the disc.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, |place| match hit.part {
            BASE | TOP => Chart::of_disc(place),
            _ => Chart::of_side(place),
        })
    }
}

/// Where lines in the plane are inside the unit circle. A line along the cylinder's axis is a point
/// there: always inside or never.
#[inline(always)]
fn inside_side<N: Lanes>(origin: Vector<N>, direction: Vector<N>) -> Option<Ends<N>> {
    let (zero, one) = (origin.x.all(0.0), origin.x.all(1.0));
    let crossed = ball(origin, direction, one);
    let stays = direction.length_squared().equals(zero);
    if !N::any(stays) {
        return crossed;
    }
    let inside = stays & origin.length_squared().up_to(one);
    let stay = Ends::everywhere(zero, inside);
    match crossed {
        Some(crossed) => Ends::select(stays, stay, crossed).if_any(),
        None => stay.if_any(),
    }
}
