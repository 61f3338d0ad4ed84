//! Descriptions of hits.

use glam::{DVec2, DVec3};

use super::record::{Boundary, Shading, SurfaceHit, Unlisted};
use crate::material::{
    Point, Refraction, environment_place, mirror_weight, refraction_indices, transmitted,
};
use crate::world::{Nearest, World};
use geometry::{Ray, Shape};
use scene::{Maps, Material, Rgb, Tinted};

/// Describes where a ray, on which there is absorption, hit a surface with a material; no light yet.
pub(super) fn shading(
    world: &World,
    (ray, absorption): (&Ray, Rgb),
    nearest: Nearest,
    point: &Point,
    material: &Material,
) -> Box<Shading> {
    Box::new(Shading {
        hit: surface_hit(world, ray, nearest, point),
        missing: missing_at(world, ray, nearest),
        lit: material.is_lit(point.side),
        transmitted: transmitted(absorption, nearest.hit.t),
        emission: Rgb::ZERO,
        densities: None,
        ambient: Rgb::ZERO,
        lights: Vec::new(),
        unlisted: Unlisted::default(),
        emitters: Vec::new(),
        caustics: Rgb::ZERO,
        radiance: Rgb::ZERO,
        mirror: mirror_weight(material, point.side),
        boundary: boundary(ray, point, material),
        stop: None,
        material: material.clone(),
    })
}

/// Describes where a ray hit a surface.
pub(super) fn surface_hit(world: &World, ray: &Ray, nearest: Nearest, point: &Point) -> SurfaceHit {
    let object = &world.scene.objects[nearest.object as usize];
    SurfaceHit {
        object: nearest.object,
        material: object.material_at(nearest.hit),
        solid: matches!(object.shape, Shape::Solid(_) | Shape::Csg(_)),
        t: nearest.hit.t,
        point: point.surface.point,
        geometric: point.surface.normal,
        normal: point.normal,
        uv: object.shape.chart(ray, nearest.hit).uv,
        side: point.side,
    }
}

/// The first texture without an image that the material at a hit uses there.
fn missing_at(world: &World, ray: &Ray, nearest: Nearest) -> Option<u32> {
    let object = &world.scene.objects[nearest.object as usize];
    let material = &world.scene.materials[object.material_at(nearest.hit) as usize];
    let maps = material.maps.as_deref()?;
    let place = object.shape.chart(ray, nearest.hit).uv;
    let mut used = textures(maps);
    used.find_map(|texture| world.textures.missing(texture, place))
}

/// The texture without an image that the background or environment comes from.
pub(super) fn missing_around(world: &World, ray: &Ray, bounce: u32, screen: DVec2) -> Option<u32> {
    let setting = &world.scene.setting;
    let missing = |around: Tinted, place| world.textures.missing(around.texture?, place);
    if bounce == 0 {
        missing(setting.background, screen)
    } else {
        missing(setting.environment, environment_place(ray.direction))
    }
}

/// What a material does with light at the boundary of a transparent solid; `None` if opaque.
fn boundary(ray: &Ray, point: &Point, material: &Material) -> Option<Boundary> {
    let tint = material.dielectric.tint;
    let indices = refraction_indices(material, point.side);
    let model = material.dielectric.reflectance;
    (tint != Rgb::ZERO).then(|| {
        let refraction = Refraction::new(ray.direction, point.normal, indices, model);
        Boundary {
            tint,
            indices,
            reflectance: refraction.reflectance,
            total: refraction.refracted.is_none(),
        }
    })
}

/// The texture of each slot.
fn textures(maps: &Maps) -> impl Iterator<Item = u32> {
    let Maps {
        ambient,
        diffuse,
        specular,
        exponent,
        roughness,
        metallic,
        mirror,
        dielectric,
        emission,
        bump,
    } = *maps;
    let slots = [
        diffuse,
        ambient,
        specular,
        exponent,
        roughness,
        metallic,
        mirror,
        dielectric,
        emission,
        bump.map(|bump| bump.texture),
    ];
    slots.into_iter().flatten()
}

/// The distance from the eye of a point on a camera ray, at distance `t` from the ray's start.
pub(super) fn depth(eye: DVec3, ray: &Ray, t: f64) -> f64 {
    (ray.origin - eye).dot(ray.direction) + t
}
