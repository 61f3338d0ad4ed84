//! Affine images of the cylinder x² + y² ≤ 1, 0 ≤ z ≤ 1.

#![expect(
    clippy::inline_always,
    reason = "a caller compiled for wider vectors must take these with it"
)]

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{Ends, ball, slab};
use super::transform::normalise;
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surface};

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
        slab(line.origin.z, line.direction.z, [BASE, TOP])?
            .overlap(inside_side(line.origin.flat(), line.direction.flat())?)?
            .after(line.start)
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let place = self.0.place(ray.at(hit.t));
        let flat = place.with_z(0.0);
        match hit.part {
            BASE | TOP => {
                let z = if hit.part == TOP { 1.0 } else { 0.0 };
                let outward = DVec3::new(0.0, 0.0, 2.0 * z - 1.0);
                self.0.surface(outward, |margin| {
                    let rim = 1.0 - (margin.x + margin.y);
                    flat.clamp_length_max(rim).with_z(z)
                })
            }
            _ => {
                let outward = normalise(flat).unwrap_or(DVec3::X);
                self.0.surface(outward, |margin| {
                    outward.with_z(place.z.max(margin.z).min(1.0 - margin.z))
                })
            }
        }
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
