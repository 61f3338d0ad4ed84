//! Points on the triangles of a mesh.

use glam::{DVec2, DVec3};

use super::Instance;
use crate::lanes::{Eight, Lanes, Row, Simd, Vector, each_bit};
use crate::transform::{exact_cross_each, normalised};
use crate::triangle::Shears;
use crate::{Chart, Hit, Hits, Ray, Rays, Shaded, Surface};

impl Instance {
    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let corners = self.mesh().vertices(hit.part).map(Vector::from);
        let normals = self
            .has_normals()
            .then(|| self.normals(hit.part).map(Vector::from));
        self.on_triangles(&ray.into(), corners, normals).into()
    }

    /// The same for a packet of eight rays; lanes without a hit are undefined.
    #[inline(always)]
    pub fn surfaces<S: Simd>(&self, rays: &Rays<Eight<S>>, hits: &Hits) -> Shaded<Eight<S>> {
        let simd = rays.origin.x.simd;
        let part = |lane: usize| hits.hit(lane).part;
        let corners = |lane: usize| self.mesh().vertices(part(lane));
        let corners = gathered(simd, hits.lanes, corners);
        let normals = |lane: usize| self.normals(part(lane));
        let normals = (self.has_normals()).then(|| gathered(simd, hits.lanes, normals));
        self.on_triangles(rays, corners, normals)
    }

    /// The surfaces where rays meet triangles, from the vertices in unit space and the normals there;
    /// normals that are zero do not count.
    #[inline(always)]
    fn on_triangles<N: Lanes>(
        &self,
        rays: &Rays<N>,
        corners: [Vector<N>; 3],
        normals: Option<[Vector<N>; 3]>,
    ) -> Shaded<N> {
        let weights = self.weights(rays, corners);
        let sides = opposite(corners);
        let across = exact_cross_each(sides[2], -sides[1]);
        let zero = across.x.all(0.0);
        let is_collinear = across.abs().largest().equals(zero);
        let outward = if N::any(is_collinear) {
            // Collinear vertices do not determine the plane: it faces the ray.
            let away = Vector::all(zero, DVec3::NEG_Z);
            let along = normalised(self.frame().line(rays).direction, away);
            Vector::select(is_collinear, -along, across)
        } else {
            across
        };
        let surface = self.frame().surface(
            outward,
            #[inline(always)]
            |margin| {
                // A barycentric coordinate is the distance from the opposite side over the height.
                let (margin, most) = (margin.largest() / across.length(), zero.all(0.25));
                let [a, b, c] = sides;
                let least = Vector {
                    x: most.smaller(margin * a.length()),
                    y: most.smaller(margin * b.length()),
                    z: most.smaller(margin * c.length()),
                };
                inside(weights, least).combine(corners)
            },
        );
        let shading = match normals {
            Some(normals) => {
                let normal = self.frame().gradients(weights.combine(normals));
                normalised(normal, surface.normal)
            }
            None => surface.normal,
        };
        Shaded { surface, shading }
    }

    /// The barycentric coordinates where rays meet triangles, from the vertices in unit space.
    #[inline(always)]
    fn weights<N: Lanes>(&self, rays: &Rays<N>, corners: [Vector<N>; 3]) -> Vector<N> {
        let (line, is_ahead) = self.approach(rays);
        let middle = Vector::all(line.start, DVec3::splat(1.0 / 3.0));
        let crossing = Shears::new(line.direction).crossing(line.origin, corners);
        match crossing {
            Some((crossing, crosses)) => {
                let [x, y, z] = crossing.weights;
                Vector::select(crosses & is_ahead, Vector { x, y, z }, middle)
            }
            None => middle,
        }
    }

    /// Whether some vertices have normals.
    fn has_normals(&self) -> bool {
        !self.mesh().normals.values.is_empty()
    }

    /// The normals at the vertices of a triangle, zero unless it has all three.
    pub(super) fn normals(&self, triangle: u32) -> [DVec3; 3] {
        let mesh = self.mesh();
        match mesh.normals.at(triangle, mesh.triangles[triangle as usize]) {
            [Some(a), Some(b), Some(c)] => [a, b, c],
            _ => [DVec3::ZERO; 3],
        }
    }

    /// The texture coordinates at a hit, interpolated from the vertices.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        let mesh = self.mesh();
        let values = mesh.uvs.at(hit.part, mesh.triangles[hit.part as usize]);
        let values = values.map(|uv| uv.unwrap_or(DVec2::ZERO));
        let corners = mesh.vertices(hit.part).map(Vector::from);
        let weights = self.weights(&ray.into(), corners);
        let sides = opposite(corners);
        let across: DVec3 = exact_cross_each(sides[2], -sides[1]).into();
        // The gradients of the barycentric coordinates, within the plane.
        let slopes = sides.map(|side| {
            let slope = across.cross(side.into()) / across.length_squared();
            if slope.is_finite() {
                slope
            } else {
                DVec3::ZERO
            }
        });
        let gradient = |of: fn(DVec2) -> f64| {
            let values = DVec3::from_array(values.map(of));
            Vector::from(values)
                .combine(slopes.map(Vector::from))
                .into()
        };
        Chart {
            uv: weights.x * values[0] + weights.y * values[1] + weights.z * values[2],
            gradients: [gradient(|uv| uv.x), gradient(|uv| uv.y)],
        }
        .with_gradients(|gradient| self.frame().gradient(gradient))
    }
}

/// Three vectors of the triangle in each lane, of which there is at least one; others repeat the first.
#[inline(always)]
pub(crate) fn gathered<S: Simd>(
    simd: S,
    lanes: u32,
    of: impl Fn(usize) -> [DVec3; 3],
) -> [Vector<Eight<S>>; 3] {
    let mut gathered = of(lanes.trailing_zeros() as usize).map(Vector::<Row>::repeat);
    for lane in each_bit(lanes) {
        let [a, b, c] = of(lane);
        gathered[0].set(lane, a);
        gathered[1].set(lane, b);
        gathered[2].set(lane, c);
    }
    let [a, b, c] = gathered;
    [a.load(simd), b.load(simd), c.load(simd)]
}

/// The sides of triangles, each opposite the vertex of the same index.
#[inline(always)]
fn opposite<N: Lanes>([a, b, c]: [Vector<N>; 3]) -> [Vector<N>; 3] {
    [c - b, a - c, b - a]
}

/// Raises weights to their minima and scales the sum to 1.
#[inline(always)]
fn inside<N: Lanes>(weights: Vector<N>, least: Vector<N>) -> Vector<N> {
    let raised = least.larger(weights);
    raised.over(raised.sum())
}
