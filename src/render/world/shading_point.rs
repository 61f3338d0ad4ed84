//! Where a ray hits an object: the point, and the material there with its maps applied.

use std::borrow::Cow;

use glam::DVec3;

use super::World;
use super::intersect::Nearest;
use crate::material::Point;
use geometry::{Ray, Side};
use scene::Material;

impl World {
    /// Returns the point where a ray hits an object, and its material there, which is in `mapped` if
    /// it has maps.
    pub(crate) fn shading_point<'m>(
        &'m self,
        ray: &Ray,
        nearest: Nearest,
        mapped: &'m mut Option<Material>,
    ) -> (Point, &'m Material) {
        let shape = &self.scene.objects[nearest.object as usize].shape;
        let surface = shape.surface(ray, nearest.hit);
        let (material, bumped) = self.material(nearest, || (*ray, surface.shading));
        let normal = bumped.unwrap_or(surface.shading);
        // Bumps do not affect which side is seen.
        let side = Side::hit(ray.direction, surface.normal);
        let point = Point {
            surface,
            normal: side.turn(normal),
            side,
            view: -ray.direction,
        };
        let material = match material {
            Cow::Borrowed(material) => material,
            Cow::Owned(material) => mapped.insert(material),
        };
        (point, material)
    }

    /// Returns the material of an object at a hit with its maps applied, and the shading normal if
    /// it has bumps; `coming` holds the ray's direction and the normal without bumps.
    #[inline]
    pub(crate) fn material(
        &self,
        nearest: Nearest,
        coming: impl Fn() -> (Ray, DVec3),
    ) -> (Cow<'_, Material>, Option<DVec3>) {
        let object = &self.scene.objects[nearest.object as usize];
        let material = &self.scene.materials[object.material_at(nearest.hit) as usize];
        let Some(maps) = &material.maps else {
            return (Cow::Borrowed(material), None);
        };
        let (ray, normal) = coming();
        let chart = object.shape.chart(&ray, nearest.hit);
        let applied = self.textures.applied(maps, material, chart.uv);
        let bumped = maps.bump;
        let bumped = bumped.map(|bump| self.textures.bumped(bump, &chart, normal));
        (Cow::Owned(applied), bumped)
    }
}
