//! Affine images of the cylinder x² + y² ≤ 1, 0 ≤ z ≤ 1.

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
    /// The tight axis-aligned box, around the base and the top.
    pub fn bounds(&self) -> Aabb {
        let base = self.0.origin();
        let [_, _, axis] = self.0.axes();
        let half = self.0.reach_of_disc([0, 1]);
        Aabb {
            min: base + axis.min(DVec3::ZERO) - half,
            max: base + axis.max(DVec3::ZERO) + half,
        }
    }

    /// Intersects lines with the cylinder, in each lane: the overlap of the infinite side, a circle
    /// in the xy plane, and the slab between the caps.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let found = slab(line.origin.z, line.direction.z, [BASE, TOP])?
            .overlap(inside_side(line.origin.flat(), line.direction.flat())?)?
            .shifted(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surface at a hit, in each lane.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let (zero, one) = (at.t.all(0.0), at.t.all(1.0));
        let position = self.0.positions(rays, at.t);
        let flat = position.flat();
        let on_base = at.part.equals(one);
        let on_top = at.part.equals(at.part.all(TOP.into()));
        let on_cap = on_base | on_top;
        let radial = normalised(flat, Vector::all(flat.x, DVec3::X));
        let outward = Vector {
            x: N::select(on_cap, zero, radial.x),
            y: N::select(on_cap, zero, radial.y),
            z: N::select(on_top, one, N::select(on_base, -one, zero)),
        };
        self.0.surface(
            outward,
            #[inline(always)]
            |margin| {
                let across = flat.clamp_length_max(one - (margin.x + margin.y));
                let height = position.z.larger(margin.z).smaller(one - margin.z);
                Vector {
                    x: N::select(on_cap, across.x, radial.x),
                    y: N::select(on_cap, across.y, radial.y),
                    z: N::select(on_top, one, N::select(on_base, zero, height)),
                }
            },
        )
    }

    /// The texture coordinates at a hit: around and along the side, or across a cap.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, |position| match hit.part {
            BASE | TOP => Chart::of_disc(position),
            _ => Chart::of_side(position),
        })
    }
}

/// The interval where lines in the xy plane are inside the unit circle. A line along the cylinder's
/// axis projects to a point, always or never inside.
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
