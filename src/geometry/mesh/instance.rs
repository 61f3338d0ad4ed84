//! Where a mesh stands in the world, and how rays meet it.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::Mesh;
use crate::geometry::transform::{exact_cross, normalise};
use crate::geometry::triangle::Sheared;
use crate::geometry::{Aabb, Affine, Chart, Hit, Ray, Surface};

/// How far from the centre of a mesh, in its unit space, lines start at most. The mesh is within √3.
const NEAR: f64 = 4.0;

/// An affine image of a mesh.
///
/// Part i is triangle i.
#[derive(Clone, Debug)]
pub struct Instance {
    mesh: Arc<Mesh>,
    /// From the unit space of the mesh to the world.
    frame: Affine,
    tags: Vec<u32>,
}

/// A ray's line in the unit space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshLine<'m> {
    mesh: &'m Mesh,
    line: Ray,
    sheared: Sheared,
    /// How far along the ray the line starts.
    start: f64,
}

impl PartialEq for Instance {
    fn eq(&self, other: &Self) -> bool {
        // A large mesh is seldom compared with its equal that is another.
        self.frame == other.frame
            && self.tags == other.tags
            && (Arc::ptr_eq(&self.mesh, &other.mesh) || self.mesh == other.mesh)
    }
}

impl Instance {
    /// A mesh as seen from a frame. Slot i of its materials is called `tags[i]`; without a tag it is
    /// called what the whole is.
    pub fn new(mesh: Arc<Mesh>, frame: &Affine, tags: Vec<u32>) -> Self {
        let frame = frame.around(mesh.centre, mesh.size);
        Self { mesh, frame, tags }
    }

    /// The mesh.
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// An axis-aligned box: around the mesh's own, tight where its edges stay along the axes.
    pub fn bounds(&self) -> Aabb {
        let [x, y, z] = self.frame.axes();
        let half = self.mesh.half;
        let half = half.x * x.abs() + half.y * y.abs() + half.z * z.abs();
        Aabb {
            min: self.frame.origin() - half,
            max: self.frame.origin() + half,
        }
    }

    /// The ray's line in the space of the mesh, or `None` if the mesh is behind the ray.
    ///
    /// It starts near the mesh, wherever the ray does: where the ray itself starts if that is near
    /// enough, else before all of the mesh.
    #[inline]
    pub fn line(&self, ray: &Ray) -> Option<MeshLine<'_>> {
        let line = self.frame.line(&ray.into());
        let [mut origin, direction] = [line.origin, line.direction].map(DVec3::from);
        let mut start = line.start;
        if start != 0.0 || NEAR * NEAR < origin.length_squared() {
            let speed = direction.length();
            let back = NEAR / speed;
            let closest = -origin.dot(direction) / (speed * speed);
            if start + closest + back < 0.0 {
                return None;
            }
            // An error in the distance moves the start along the line only.
            let step = closest - back;
            origin = DVec3::new(
                step.mul_add(direction.x, origin.x),
                step.mul_add(direction.y, origin.y),
                step.mul_add(direction.z, origin.z),
            );
            start += step;
        }
        Some(MeshLine {
            mesh: &self.mesh,
            line: Ray { origin, direction },
            sheared: Sheared::new(origin, direction),
            start,
        })
    }

    /// The nearest crossing with `0 < t < limit`, found by trying every triangle.
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let line = self.line(ray)?;
        let mut nearest = None;
        for triangle in 0..self.mesh.len() as u32 {
            line.meet(triangle, f64::INFINITY, &mut nearest);
        }
        line.hit(nearest?, limit)
    }

    /// The surface at a hit.
    pub fn surface(&self, ray: &Ray, hit: Hit) -> Surface {
        let triangle = self.mesh.triangles[hit.part as usize];
        let corners = self.mesh.corners(triangle);
        let weights = self.weights(ray, hit);
        let sides = opposite(corners);
        let across = exact_cross(sides[2], -sides[1]);
        // Corners in a row leave the plane open: it faces the ray.
        let outward = if across == DVec3::ZERO {
            -normalise(self.frame.line(&ray.into()).direction.into()).unwrap_or(DVec3::NEG_Z)
        } else {
            across
        };
        let surface = self.frame.surface(outward.into(), |margin| {
            // A corner's weight is the place's distance from the side opposite, over the height.
            let margin = margin.largest() / across.length();
            let least = sides.map(|side| (margin * side.length()).min(0.25));
            weighted(inside(weights, least), corners).into()
        });
        let mut surface = Surface::from(surface);
        if let [Some(a), Some(b), Some(c)] = self.mesh.normals.at(hit.part, triangle) {
            let normal = self.frame.gradient(weighted(weights, [a, b, c]));
            surface.shading = normalise(normal).unwrap_or(surface.normal);
        }
        surface
    }

    /// The texture coordinates at a hit: those of the corners, interpolated.
    pub fn chart(&self, ray: &Ray, hit: Hit) -> Chart {
        let triangle = self.mesh.triangles[hit.part as usize];
        let values = self.mesh.uvs.at(hit.part, triangle);
        let values = values.map(|uv| uv.unwrap_or(DVec2::ZERO));
        let [a, b, c] = self.weights(ray, hit);
        let sides = opposite(self.mesh.corners(triangle));
        let across = exact_cross(sides[2], -sides[1]);
        // A weight grows from its side, within the plane.
        let slopes = sides.map(|side| {
            let slope = across.cross(side) / across.length_squared();
            if slope.is_finite() {
                slope
            } else {
                DVec3::ZERO
            }
        });
        let gradient = |of: fn(DVec2) -> f64| weighted(values.map(of), slopes);
        Chart {
            uv: a * values[0] + b * values[1] + c * values[2],
            gradients: [gradient(|uv| uv.x), gradient(|uv| uv.y)],
        }
        .with_gradients(|gradient| self.frame.gradient(gradient))
    }

    /// The tag of the material at a hit.
    pub fn tag(&self, hit: Hit) -> Option<u32> {
        self.tags.get(self.mesh.slot(hit.part) as usize).copied()
    }

    /// The tags that its triangles have, `None` for those without, in no order and perhaps several
    /// times.
    pub fn tags(&self) -> impl Iterator<Item = Option<u32>> {
        let tag = |slot: u32| self.tags.get(slot as usize).copied();
        self.mesh.slots().map(tag)
    }

    /// What the corners count at a hit.
    fn weights(&self, ray: &Ray, hit: Hit) -> [f64; 3] {
        let corners = self.mesh.corners(self.mesh.triangles[hit.part as usize]);
        let line = self.line(ray);
        let crossing = line.and_then(|line| line.sheared.crossing(corners));
        crossing.map_or([1.0 / 3.0; 3], |crossing| crossing.weights)
    }
}

impl MeshLine<'_> {
    /// The line in the space of its triangles.
    pub(super) fn sheared(&self) -> &Sheared {
        &self.sheared
    }

    /// The line as a ray, of any speed, among [`Mesh::triangle_bounds`].
    pub fn ray(&self) -> &Ray {
        &self.line
    }

    /// How far along [`Self::ray`] anything nearer than `limit` along the world's ray can be.
    pub fn limit(&self, limit: f64) -> f64 {
        (limit - self.start).next_up()
    }

    /// Makes the crossing of a triangle the `nearest`, a distance along [`Self::ray`], if it is up
    /// to `limit` and before the one so far; of equal ones the first triangle's counts. Returns how
    /// far there may be a nearer one.
    #[inline]
    pub fn meet(&self, triangle: u32, limit: f64, nearest: &mut Option<Hit>) -> f64 {
        let corners = self.mesh.corners(self.mesh.triangles[triangle as usize]);
        let best = nearest.map_or((limit, u32::MAX), |hit| (hit.t, hit.part));
        if let Some(crossing) = self.sheared.crossing(corners)
            && (crossing.t, triangle) < best
            && 0.0 < self.start + crossing.t
        {
            *nearest = Some(Hit {
                t: crossing.t,
                part: triangle,
            });
            return crossing.t;
        }
        best.0
    }

    /// The hit of the world's ray at 0 < t < `limit` that a crossing is.
    pub fn hit(&self, nearest: Hit, limit: f64) -> Option<Hit> {
        let t = self.start + nearest.t;
        (t < limit).then_some(Hit { t, ..nearest })
    }
}

/// The sides of a triangle opposite its corners, in the order of its corners.
fn opposite([a, b, c]: [DVec3; 3]) -> [DVec3; 3] {
    [c - b, a - c, b - a]
}

/// Weights that add up to 1, none of them below its least.
fn inside(weights: [f64; 3], least: [f64; 3]) -> [f64; 3] {
    let raised: [f64; 3] = std::array::from_fn(|i| weights[i].max(least[i]));
    let sum: f64 = raised.iter().sum();
    raised.map(|weight| weight / sum)
}

fn weighted([u, v, w]: [f64; 3], [a, b, c]: [DVec3; 3]) -> DVec3 {
    u * a + v * b + w * c
}
