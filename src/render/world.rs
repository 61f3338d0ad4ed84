//! A scene made ready for rays.
//!
//! A tree over the objects; and one over the triangles of each mesh, which its instances share and
//! which lives as long as the mesh is in the scene.

use std::sync::Arc;

use glam::DVec2;

use super::lights::SphereLights;
use super::mapped::{MappedTextures, environment_place};
use super::spheres::Spheres;
use super::structures::{Structures, instances};
use super::texture::Textures;
use crate::accel::Bvh;
use crate::geometry::Ray;
use crate::geometry::lanes::Level;
use crate::scene::{Images, Material, Object, Rgb, Scene};

/// Up to this many objects every ray tries every one. Measured with rays that go alone: with two
/// solids that is half as fast again as a tree, with six to eleven a tree is 1.2 to 1.7 times as
/// fast; with eleven and eight rays side by side a tree is 1.1 times as fast.
pub(super) const FEW: usize = 4;

/// The order of so few.
const FILE_ORDER: [u32; FEW] = [0, 1, 2, 3];

/// A scene and its acceleration structure.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) scene: Arc<Scene>,
    pub(crate) textures: Textures,
    pub(crate) mapped: MappedTextures,
    /// The lights that have a size.
    pub(crate) sphere_lights: SphereLights,
    /// The vectors that rays are traced with.
    pub(crate) level: Level,
    pub(crate) tree: Option<Arc<Bvh>>,
    /// By place in [`World::order`].
    pub(crate) spheres: Arc<Spheres>,
    pub(crate) structures: Structures,
    /// For each object whether it is a mesh that lets no light through anywhere; none at all if
    /// there is no such mesh.
    pub(crate) opaque: Vec<bool>,
}

impl World {
    /// Makes a scene ready, keeping the tree of `previous` if its shapes are the same, and the
    /// structures of the meshes it has as well. `None` if `cancelled` said so.
    pub(crate) fn build(
        scene: Arc<Scene>,
        images: &Images,
        previous: Option<&Self>,
        cancelled: impl Fn() -> bool + Sync,
    ) -> Option<Self> {
        let textures = Textures::new(&scene.textures, images);
        let mapped = MappedTextures::new(&scene.setting.textures, images);
        let sphere_lights = SphereLights::new(&scene.lights, &cancelled)?;
        let level = Level::new();
        let opaque = opaque_meshes(&scene);
        let changed = previous.and_then(|world| changed_shapes(&world.scene, &scene));
        if let Some(previous) = previous.filter(|_| changed.as_deref() == Some(&[])) {
            return Some(Self {
                scene,
                textures,
                mapped,
                sphere_lights,
                level,
                tree: previous.tree.clone(),
                spheres: Arc::clone(&previous.spheres),
                structures: previous.structures.clone(),
                opaque,
            });
        }
        let known = previous.map(|world| &world.structures);
        let structures = Structures::build(&scene.objects, known, &cancelled)?;
        let tree = if scene.objects.len() <= FEW {
            None
        } else {
            let objects = &scene.objects;
            let bounds = |object: u32| objects[object as usize].shape.bounds();
            let known = previous.and_then(|world| world.tree.as_ref());
            let refitted = known.zip(changed);
            let refitted = refitted.and_then(|(tree, changed)| tree.refitted(&changed, bounds));
            let tree = match refitted {
                Some(tree) => tree,
                None => Bvh::over(objects.len(), bounds, cancelled)?,
            };
            Some(Arc::new(tree))
        };
        let order = match &tree {
            Some(tree) => tree.order(),
            None => &FILE_ORDER[..scene.objects.len()],
        };
        let spheres = Arc::new(Spheres::new(&scene.objects, order));
        Some(Self {
            scene,
            textures,
            mapped,
            sphere_lights,
            level,
            tree,
            spheres,
            structures,
            opaque,
        })
    }

    /// Whether this is the world of the same shapes, which is built with those of the one before.
    pub(crate) fn has_shapes_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.spheres, &other.spheres)
    }

    /// What a ray that meets nothing brings: a camera ray the background at `screen`, a place in the
    /// unit square, others the environment.
    pub(crate) fn around(&self, ray: &Ray, bounce: u32, screen: DVec2) -> Rgb {
        let setting = &self.scene.setting;
        if bounce == 0 {
            return self.mapped.colour(setting.background, screen);
        }
        let environment = setting.environment;
        if environment.texture.is_none() {
            return environment.colour;
        }
        let place = environment_place(ray.direction);
        self.mapped.colour(environment, place)
    }

    /// The numbers of the objects in the order that they are visited in.
    pub(crate) fn order(&self) -> &[u32] {
        match &self.tree {
            Some(tree) => tree.order(),
            None => &FILE_ORDER[..self.scene.objects.len()],
        }
    }

    /// The part of light that goes through a material.
    #[inline]
    pub(crate) fn transmission(&self, material: u32) -> f64 {
        transmission(&self.scene, material)
    }
}

/// The part of light that goes through a material.
fn transmission(scene: &Scene, material: u32) -> f64 {
    match &scene.materials[material as usize] {
        Material::Phong(phong) => phong.transmission,
        // SPEC of `.xml`: anything blocks.
        Material::Utah(_) | Material::Flat(_) => 0.0,
    }
}

/// See [`World::opaque`].
fn opaque_meshes(scene: &Scene) -> Vec<bool> {
    let mut opaque = Vec::new();
    for (number, instance) in instances(&scene.objects) {
        let material = scene.objects[number].material;
        let of_tag = |tag: Option<u32>| transmission(scene, tag.unwrap_or(material));
        if instance.tags().all(|tag| of_tag(tag) == 0.0) {
            opaque.resize(scene.objects.len(), false);
            opaque[number] = true;
        }
    }
    opaque
}

/// The objects whose shapes are others; `None` where they are many, or not as many objects.
fn changed_shapes(a: &Arc<Scene>, b: &Arc<Scene>) -> Option<Vec<u32>> {
    /// A tree can follow fewer.
    const MANY: usize = 32;
    let mut changed = Vec::new();
    if Arc::ptr_eq(a, b) {
        return Some(changed);
    }
    if a.objects.len() != b.objects.len() {
        return None;
    }
    let is_other = |a: &Object, b: &Object| a.shape != b.shape;
    for number in a.objects.differences(&b.objects, is_other) {
        changed.push(number as u32);
        if MANY < changed.len() {
            return None;
        }
    }
    Some(changed)
}
