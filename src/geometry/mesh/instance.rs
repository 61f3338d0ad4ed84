//! Meshes placed in the world, and their intersection with rays.

use std::sync::Arc;

use glam::DVec3;

use super::Mesh;
use crate::lanes::{Lanes, Vector};
use crate::line::Line;
use crate::triangle::{Sheared, Shears};
use crate::{Aabb, Affine, Hit, Ray, Rays};

/// The maximum distance of a line's start from the mesh's centre, in unit space. It is within √3.
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

/// A triangle of a mesh in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle {
    /// The tag of its slot, if it has its own.
    pub tag: Option<u32>,
    /// Its vertices, counter-clockwise seen from the front of the mesh.
    pub corners: [DVec3; 3],
    /// The normals there, of any length; `None` if one is missing.
    pub normals: Option<[DVec3; 3]>,
}

/// A ray in the unit space of a mesh.
#[derive(Clone, Copy, Debug)]
pub struct MeshLine<'m> {
    mesh: &'m Mesh,
    line: Ray,
    sheared: Sheared<f64>,
    /// The distance of the line's start along the ray.
    start: f64,
}

impl PartialEq for Instance {
    fn eq(&self, other: &Self) -> bool {
        // Equal large meshes are usually the same allocation.
        self.frame == other.frame
            && self.tags == other.tags
            && (Arc::ptr_eq(&self.mesh, &other.mesh) || self.mesh == other.mesh)
    }
}

impl Instance {
    /// Places a mesh in a frame. Material slot i has the tag `tags[i]`; slots beyond the end have
    /// no tag of their own.
    pub fn new(mesh: Arc<Mesh>, frame: &Affine, tags: Vec<u32>) -> Self {
        let frame = frame.around(mesh.centre, mesh.size);
        Self { mesh, frame, tags }
    }

    /// The mesh.
    #[inline(always)]
    pub fn mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// From the unit space of the mesh to the world.
    #[inline(always)]
    pub(crate) fn frame(&self) -> &Affine {
        &self.frame
    }

    /// The axis-aligned box around the image of the mesh's own box, tight if that is axis-aligned.
    pub fn bounds(&self) -> Aabb {
        let [x, y, z] = self.frame.axes();
        let half = self.mesh.half;
        let half = half.x * x.abs() + half.y * y.abs() + half.z * z.abs();
        Aabb {
            min: self.frame.origin() - half,
            max: self.frame.origin() + half,
        }
    }

    /// The triangles in the world: the tag of each, if it has its own, its vertices, and the normals
    /// there, of any length, if it has all three.
    pub fn placed_triangles(&self) -> impl Iterator<Item = Triangle> {
        let [x, y, z] = self.frame.axes();
        let place =
            move |corner: DVec3| self.frame.origin() + (corner.x * x + corner.y * y + corner.z * z);
        (0..self.mesh.len() as u32).map(move |triangle| {
            let normals = self.normals(triangle);
            let tag = self.tags.get(self.mesh.slot(triangle) as usize);
            Triangle {
                tag: tag.copied(),
                corners: self.mesh.vertices(triangle).map(place),
                normals: (!normals.contains(&DVec3::ZERO))
                    .then(|| normals.map(|normal| self.frame.gradient(normal))),
            }
        })
    }

    /// The edges of its triangles, three each; of more than `most` triangles only every second,
    /// third and so on.
    pub(crate) fn edges(&self, most: usize) -> impl Iterator<Item = [DVec3; 2]> {
        let step = self.mesh.len().div_ceil(most.max(1));
        let [x, y, z] = self.frame.axes();
        let place =
            move |corner: DVec3| self.frame.origin() + (corner.x * x + corner.y * y + corner.z * z);
        let shown = self.mesh.triangles.iter().step_by(step.max(1));
        shown.flat_map(move |triangle| {
            let [a, b, c] = self.mesh.corners(*triangle).map(place);
            [[a, b], [b, c], [c, a]]
        })
    }

    /// Transforms a ray to the space of the mesh; `None` if the mesh is behind it.
    ///
    /// The line starts near the mesh: at the ray's own start if that is near enough, otherwise in
    /// front of the whole mesh.
    #[inline]
    pub fn line(&self, ray: &Ray) -> Option<MeshLine<'_>> {
        let (line, is_ahead) = self.approach(&ray.into());
        let Line { origin, start, .. } = line;
        is_ahead.then(|| {
            let sheared = Shears::new(line.direction).sheared(origin.into());
            let line = Ray {
                origin: origin.into(),
                direction: line.direction.into(),
            };
            MeshLine::from_parts(&self.mesh, line, sheared, start)
        })
    }

    /// The lines in each lane, and whether the mesh is not behind them.
    #[inline(always)]
    pub(super) fn approach<N: Lanes>(&self, rays: &Rays<N>) -> (Line<N>, N::Mask) {
        let line = self.frame.line(rays);
        let Line {
            origin,
            direction,
            start,
        } = line;
        let (zero, near) = (start.all(0.0), start.all(NEAR * NEAR));
        let stays = start.equals(zero) & !near.below(origin.length_squared());
        if !N::any(!stays) {
            return (line, stays);
        }
        let speed = direction.length();
        let back = start.all(NEAR) / speed;
        let closest = -origin.dot(direction) / (speed * speed);
        let is_behind = (start + closest + back).below(zero);
        // An error in the distance only moves the start along the line.
        let step = closest - back;
        let moved = Vector {
            x: step.mul_add(direction.x, origin.x),
            y: step.mul_add(direction.y, origin.y),
            z: step.mul_add(direction.z, origin.z),
        };
        let line = Line {
            origin: Vector::select(stays, origin, moved),
            direction,
            start: N::select(stays, start, start + step),
        };
        (line, stays | !is_behind)
    }

    /// The nearest hit with `0 < t < limit`, found by testing every triangle.
    pub fn hit(&self, ray: &Ray, limit: f64) -> Option<Hit> {
        let line = self.line(ray)?;
        let mut nearest = None;
        for triangle in 0..self.mesh.len() as u32 {
            line.meet(triangle, f64::INFINITY, &mut nearest);
        }
        line.hit(nearest?, limit)
    }

    /// The tag of the material at a hit.
    pub fn tag(&self, hit: Hit) -> Option<u32> {
        self.tags.get(self.mesh.slot(hit.part) as usize).copied()
    }

    /// The tags of the triangles, `None` for those without, unordered and possibly repeated.
    pub fn tags(&self) -> impl Iterator<Item = Option<u32>> {
        let tag = |slot: u32| self.tags.get(slot as usize).copied();
        self.mesh.slots().map(tag)
    }
}

impl<'m> MeshLine<'m> {
    #[inline(always)]
    pub(super) fn from_parts(mesh: &'m Mesh, line: Ray, sheared: Sheared<f64>, start: f64) -> Self {
        Self {
            mesh,
            line,
            sheared,
            start,
        }
    }

    /// The line prepared for tests against triangles.
    #[inline(always)]
    pub(super) fn sheared(&self) -> &Sheared<f64> {
        &self.sheared
    }

    /// The line as a ray in the space of [`Mesh::triangle_bounds`], its direction of any length.
    pub fn ray(&self) -> &Ray {
        &self.line
    }

    /// The maximum distance along [`Self::ray`] of hits nearer than `limit` along the world's ray.
    pub fn limit(&self, limit: f64) -> f64 {
        (limit - self.start).next_up()
    }

    /// Updates `nearest`, a distance along [`Self::ray`], if the line crosses a triangle at up to
    /// `limit` and before the nearest crossing so far; among equal distances the first triangle
    /// counts. Returns the limit for nearer crossings.
    #[inline(always)]
    pub fn meet(&self, triangle: u32, limit: f64, nearest: &mut Option<Hit>) -> f64 {
        let corners = self.sheared.corners(self.mesh.vertices(triangle));
        let best = nearest.map_or((limit, u32::MAX), |hit| (hit.t, hit.part));
        if let Some((crossing, _)) = self.sheared.crossing(corners)
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

    /// Converts a crossing into a hit of the world's ray with t < `limit`.
    pub fn hit(&self, nearest: Hit, limit: f64) -> Option<Hit> {
        let t = self.start + nearest.t;
        (t < limit).then_some(Hit { t, ..nearest })
    }
}
