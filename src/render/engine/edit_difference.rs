//! What differs between two pictures, so that an edit of a material or of a light's colour retraces only some
//! of them (cf. Brière and Poulin, "Hierarchical View-dependent Structures for Interactive Scene
//! Manipulation", 1996, who store whole ray trees).

use std::ops::BitOr;
use std::sync::Arc;

use rayon::prelude::*;

use crate::job::Job;
use crate::world::{Dependencies, World};
use geometry::Shape;
use scene::blocks::BLOCK;
use scene::{Integrator, Light, Material, Object, Scene};

/// Returns the difference between two jobs with their worlds; `None` if more than materials,
/// colours of lights and the number of samples differ.
pub(crate) fn edit_difference(
    before: (&Job, &World),
    after: (&Job, &World),
) -> Option<Dependencies> {
    let ((job, world), (new_job, new_world)) = (before, after);
    let (scene, new_scene) = (&*world.scene, &*new_world.scene);
    let is_alike = job.settings.trace_alike(&new_job.settings)
        && job.frames == new_job.frames
        && job.camera == new_job.camera
        && job.images == new_job.images
        && world.has_shapes_of(new_world)
        && world.ambient == new_world.ambient
        // Every path may have asked for any of them.
        && (job.settings.integrator == Integrator::Whitted
            || Arc::ptr_eq(&world.emitters, &new_world.emitters)
                && Arc::ptr_eq(&world.sky, &new_world.sky))
        && scene.textures == new_scene.textures
        && scene.setting == new_scene.setting
        && scene.lights.len() == new_scene.lights.len();
    if !is_alike {
        return None;
    }
    // Photons may have come from anywhere.
    if job.settings.integrator == Integrator::Photon && scene != new_scene {
        return None;
    }
    let mut touched = Dependencies::default();
    for (number, (light, new)) in scene.lights.iter().zip(&new_scene.lights).enumerate() {
        if light == new {
            continue;
        }
        let colour = new.colour;
        // BSDF samples may hit any light.
        if *new != (Light { colour, ..*light }) || job.settings.integrator.traces_paths() {
            return None;
        }
        touched |= Dependencies::light(number);
    }
    Some(touched | repainted(scene, new_scene))
}

/// The objects, with the same shapes in two scenes, that have different materials. Equal materials
/// may have different numbers.
fn repainted(scene: &Scene, new_scene: &Scene) -> Dependencies {
    let [materials, new_materials] = [&scene.materials, &new_scene.materials];
    let changed: Vec<_> = materials.differences(new_materials, Material::ne).collect();
    let has_changed = |number, _| changed.binary_search(&(number as usize)).is_ok();
    let differ = |number, new| materials[number as usize] != new_materials[new as usize];
    let of_block = |number: u32, block: &[Object], new: &[Object], differ: &Differ| {
        let pairs = (number * BLOCK as u32..).zip(block.iter().zip(new));
        let repainted = pairs.filter(|(_, (object, new))| looks_other(object, new, differ));
        repainted.fold(Dependencies::default(), |touched, (number, _)| {
            touched | Dependencies::object(number)
        })
    };
    let blocks = scene.objects.blocks().par_iter();
    let blocks = blocks.zip(new_scene.objects.blocks()).enumerate();
    let blocks = blocks.map(|(number, pair)| (number as u32, pair));
    let touched = blocks.map(|(number, (block, new))| {
        if !Arc::ptr_eq(block, new) {
            of_block(number, block, new, &differ)
        } else if changed.is_empty() {
            Dependencies::default()
        } else {
            of_block(number, block, new, &has_changed)
        }
    });
    touched.reduce(Dependencies::default, Dependencies::bitor)
}

/// Whether a material of a scene differs from one of a new scene, by their numbers.
type Differ<'a> = dyn Fn(u32, u32) -> bool + 'a;

/// Whether the materials of two objects of the same shape differ.
fn looks_other(object: &Object, new: &Object, differ: &Differ) -> bool {
    match &object.shape {
        Shape::Csg(csg) => csg.tags().any(|tag| differ(tag, tag)),
        Shape::Mesh(instance) => instance.tags().any(|tag| match tag {
            Some(tag) => differ(tag, tag),
            None => differ(object.material, new.material),
        }),
        _ => differ(object.material, new.material),
    }
}
