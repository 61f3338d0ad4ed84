//! Affine images of the cone x² + y² ≤ (1 − z)², 0 ≤ z ≤ 1.

use glam::DVec3;

use super::lanes::{Lanes, Vector};
use super::line::{End, Ends, half_line, roots, slab};
use super::transform::normalised;
use super::{Aabb, Affine, Chart, Hit, Ray, Rays, Surfaces};

const SIDE: u32 = 0;
const BASE: u32 = 1;

/// An affine image of the cone x² + y² ≤ (1 − z)², 0 ≤ z ≤ 1.
///
/// Part 0 is the side, 1 the base at z = 0; the apex is at z = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone(pub Affine);

impl Cone {
    /// The tight axis-aligned box, around the base and the apex.
    pub fn bounds(&self) -> Aabb {
        let base = self.0.origin();
        let [_, _, axis] = self.0.axes();
        let half = self.0.reach_of_disc([0, 1]);
        Aabb {
            min: base + axis.min(-half),
            max: base + axis.max(half),
        }
    }

    /// Intersects lines with the cone, in each lane: the overlap of the infinite side and the slab
    /// from base to apex, which excludes the second nappe above the apex.
    #[inline(always)]
    pub(super) fn ends<N: Lanes>(&self, rays: &Rays<N>) -> Option<Ends<N>> {
        let line = self.0.line(rays);
        let from_apex = line.origin - Vector::all(line.start, DVec3::Z);
        let found = slab(line.origin.z, line.direction.z, [BASE, SIDE])?
            .overlap(inside_side(from_apex, line.direction)?)?
            .shifted(line.start)?;
        self.0.clipped(found, rays, || self.bounds())
    }

    /// The surface at a hit, in each lane. At the apex it has the normal of an arbitrary
    /// generatrix.
    #[inline(always)]
    pub(super) fn surface<N: Lanes>(&self, rays: &Rays<N>, at: End<N>) -> Surfaces<N> {
        let (zero, one) = (at.t.all(0.0), at.t.all(1.0));
        let position = self.0.positions(rays, at.t);
        let flat = position.flat();
        let on_base = at.part.equals(at.part.all(BASE.into()));
        let radial = normalised(flat, Vector::all(flat.x, DVec3::X));
        let outward = Vector {
            x: N::select(on_base, zero, radial.x),
            y: N::select(on_base, zero, radial.y),
            z: N::select(on_base, -one, one),
        };
        self.0.surface(
            outward,
            #[inline(always)]
            |margin| {
                // All three margins away from the apex, a ray that leaves inward starts inside.
                let rim = one - margin.sum();
                let across = flat.clamp_length_max(rim);
                let z = position.z.larger(margin.z).smaller(rim);
                let around = radial.scaled(one - z);
                Vector {
                    x: N::select(on_base, across.x, around.x),
                    y: N::select(on_base, across.y, around.y),
                    z: N::select(on_base, zero, z),
                }
            },
        )
    }

    /// The texture coordinates at a hit: around and along the side, or across the base.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        self.0.chart(ray, hit, |position| match hit.part {
            BASE => Chart::of_disc(position),
            _ => Chart::of_side(position),
        })
    }
}

/// The interval where lines, relative to the apex, are inside the infinite cone x² + y² ≤ z²; of
/// two intervals the one in the lower nappe.
///
/// With the indefinite product ⟨u, v⟩ = ux vx + uy vy − uz vz a line is inside where
/// a t² + 2 b t + c ≤ 0, a = ⟨d, d⟩, b = ⟨o, d⟩, c = ⟨o, o⟩. By Lagrange's identity the
/// discriminant follows from the cross product n = o × d: b² − ac = nx² + ny² − nz², computed as
/// a sum times a difference, exact relative to the line's distance from the apex.
#[inline(always)]
fn inside_side<N: Lanes>(origin: Vector<N>, direction: Vector<N>) -> Option<Ends<N>> {
    let discriminant = indefinite_square(origin.cross(direction));
    let a = indefinite_square(direction);
    let b = origin.x * direction.x + origin.y * direction.y - origin.z * direction.z;
    let c = indefinite_square(origin);
    let (before, after) = (a.all(f64::NEG_INFINITY), a.all(f64::INFINITY));
    let zero = a.all(0.0);
    // A line steeper than the side always crosses it: a negative discriminant is rounding.
    let root = zero.larger(discriminant).sqrt();
    let [first, second] = roots(a, b, c, root);
    let (flatter, rises) = (zero.below(a), zero.below(direction.z));
    let enter = N::select(flatter, first, N::select(rises, before, second));
    let exit = N::select(flatter, second, N::select(rises, first, after));
    let missed = flatter & discriminant.below(zero);
    // A line parallel to a generatrix crosses the side at most once.
    let parallel = a.equals(zero);
    let crossed = Ends::between(enter, exit, SIDE, !missed & !parallel);
    if !N::any(parallel) {
        return crossed.if_any();
    }
    match half_line(b, c, SIDE) {
        Some(once) => Ends::select(parallel, once, crossed).if_any(),
        None => crossed.if_any(),
    }
}

/// Returns x² + y² − z².
#[inline(always)]
fn indefinite_square<N: Lanes>(v: Vector<N>) -> N {
    let radius = v.flat().length_squared().sqrt();
    (radius - v.z) * (radius + v.z)
}
