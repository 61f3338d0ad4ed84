//! A scene made ready for rays: which object a ray meets first, and how much light passes.
//!
//! A tree over the objects; and one over the triangles of each mesh, which its instances share and
//! which lives as long as the mesh is in the scene.

use std::sync::Arc;

use glam::DVec2;
use rayon::prelude::*;

use super::lights::SphereLights;
use super::mapped::{MappedTextures, environment_place};
use super::structures::{Search, Structures};
use super::texture::Textures;
use crate::accel::Bvh;
use crate::geometry::{Aabb, Hit, Ray, Shape, ulp};
use crate::scene::{Images, Material, Object, Rgb, Scene};

/// Up to this many objects every ray tries every one. Measured on the scenes of `scenes/`: with two
/// solids that is half as fast again as a tree, with six to eleven a tree is 1.2 to 1.7 times as
/// fast.
const FEW: usize = 4;

/// Objects whose boxes are made without asking whether to stop: less than half a millisecond.
const QUIET: usize = 16_384;

/// A scene and its acceleration structure.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) scene: Arc<Scene>,
    pub(crate) textures: Textures,
    pub(crate) mapped: MappedTextures,
    /// The lights that have a size.
    pub(crate) spheres: SphereLights,
    tree: Option<Arc<Bvh>>,
    structures: Structures,
    /// For each object whether it is a mesh that lets no light through anywhere; none at all if
    /// there is no such mesh.
    opaque: Vec<bool>,
}

/// The first object on a ray's way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Its index.
    pub(crate) object: u32,
    /// Where it is met.
    pub(crate) hit: Hit,
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
        let spheres = SphereLights::new(&scene.lights, &cancelled)?;
        let opaque = opaque_meshes(&scene);
        if let Some(previous) = previous.filter(|world| same_shapes(&world.scene, &scene)) {
            return Some(Self {
                scene,
                textures,
                mapped,
                spheres,
                tree: previous.tree.clone(),
                structures: previous.structures.clone(),
                opaque,
            });
        }
        let known = previous.map(|world| &world.structures);
        let structures = Structures::build(&scene.objects, known, &cancelled)?;
        let tree = if scene.objects.len() <= FEW {
            None
        } else {
            let boxes = boxes(&scene.objects, &cancelled)?;
            Some(Arc::new(Bvh::build(&boxes, cancelled)?))
        };
        Some(Self {
            scene,
            textures,
            mapped,
            spheres,
            tree,
            structures,
            opaque,
        })
    }

    /// The nearest object on the ray nearer than `limit`; of those that are met within 64 ulp of
    /// the least distance, the first of the file, so that touching solids show no speckle.
    pub(crate) fn nearest(&self, ray: &Ray, mut limit: f64) -> Option<Nearest> {
        let reach = ray.origin.length();
        let window = |t: f64| 64.0 * ulp(reach.max(t));
        let mut best: Option<Nearest> = None;
        let mut tied = false;
        self.visit(ray, limit, |object| {
            let Some(hit) = self.hit(object, ray, limit, Search::Nearest) else {
                return limit;
            };
            match best {
                Some(before) if before.hit.t <= hit.t => tied = true,
                Some(before) => tied = before.hit.t <= hit.t + window(hit.t),
                None => {}
            }
            if best.is_none_or(|before| hit.t < before.hit.t) {
                best = Some(Nearest { object, hit });
                limit = limit.min((hit.t + window(hit.t)).next_up());
            }
            limit
        });
        // Which of several hits in the window comes first depends on the order of the walk until
        // the least distance is known, so ties are settled by a second walk. They are rare.
        if tied {
            self.first_in_file(ray, limit)
        } else {
            best
        }
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

    /// The part of light that passes along the ray up to `distance`: the product of kt over every
    /// solid whose surface the way crosses, each once, in file order. `crossed` is scratch space:
    /// objects and their materials.
    pub(crate) fn transmittance(
        &self,
        ray: &Ray,
        distance: f64,
        crossed: &mut Vec<(u32, u32)>,
    ) -> f64 {
        crossed.clear();
        let mut blocked = false;
        self.visit(ray, distance, |object| {
            // Of an opaque mesh any hit says as much as the nearest.
            let search = match self.opaque.get(object as usize) {
                Some(true) => Search::Any,
                _ => Search::Nearest,
            };
            let Some(hit) = self.hit(object, ray, distance, search) else {
                return distance;
            };
            let material = self.scene.objects[object as usize].material_at(hit);
            if transmission(&self.scene, material) == 0.0 {
                blocked = true;
                return -1.0;
            }
            crossed.push((object, material));
            distance
        });
        if blocked {
            return 0.0;
        }
        crossed.sort_unstable();
        crossed
            .iter()
            .map(|&(_, material)| transmission(&self.scene, material))
            .product()
    }

    fn first_in_file(&self, ray: &Ray, limit: f64) -> Option<Nearest> {
        let mut first: Option<Nearest> = None;
        self.visit(ray, limit, |object| {
            if first.is_none_or(|before| object < before.object)
                && let Some(hit) = self.hit(object, ray, limit, Search::Nearest)
            {
                first = Some(Nearest { object, hit });
            }
            limit
        });
        first
    }

    /// Where an object is met; shapes other than meshes always say where first.
    #[inline]
    fn hit(&self, object: u32, ray: &Ray, limit: f64, search: Search) -> Option<Hit> {
        match &self.scene.objects[object as usize].shape {
            Shape::Mesh(instance) => self.structures.hit(object, instance, ray, limit, search),
            shape => shape.hit(ray, limit),
        }
    }

    fn visit(&self, ray: &Ray, limit: f64, mut visit: impl FnMut(u32) -> f64) {
        match &self.tree {
            Some(tree) => tree.traverse(ray, limit, visit),
            None => {
                for object in 0..self.scene.objects.len() as u32 {
                    if visit(object) < 0.0 {
                        return;
                    }
                }
            }
        }
    }
}

/// The box of each object; `None` if `cancelled` said so.
fn boxes(objects: &[Object], cancelled: impl Fn() -> bool) -> Option<Vec<Aabb>> {
    let mut boxes = Vec::with_capacity(objects.len());
    for part in objects.chunks(QUIET) {
        if cancelled() {
            return None;
        }
        boxes.par_extend(part.par_iter().map(|object| object.shape.bounds()));
    }
    Some(boxes)
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
    for (number, object) in scene.objects.iter().enumerate() {
        let Shape::Mesh(instance) = &object.shape else {
            continue;
        };
        let of_tag = |tag: Option<u32>| transmission(scene, tag.unwrap_or(object.material));
        if instance.tags().all(|tag| of_tag(tag) == 0.0) {
            opaque.resize(scene.objects.len(), false);
            opaque[number] = true;
        }
    }
    opaque
}

fn same_shapes(a: &Arc<Scene>, b: &Arc<Scene>) -> bool {
    Arc::ptr_eq(a, b)
        || (a.objects.len() == b.objects.len()
            && a.objects
                .iter()
                .zip(&b.objects)
                .all(|(a, b)| a.shape == b.shape))
}
