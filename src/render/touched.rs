//! Dependencies of pixels, so that an edit of a material or of a light's colour retraces only some
//! of them (cf. Brière and Poulin, "Hierarchical View-dependent Structures for Interactive Scene
//! Manipulation", 1996, who store whole ray trees).

use std::ops::{BitOr, BitOrAssign};
use std::sync::Arc;

use rayon::prelude::*;

use super::frame::Job;
use super::world::World;
use crate::geometry::Shape;
use crate::scene::blocks::BLOCK;
use crate::scene::{Integrator, Light, Material, Object, Scene};

/// A conservative set of objects and lights, in which several share a bit.
///
/// A pixel depends on the materials of the objects that its rays hit and that its shadow rays are
/// blocked by or pass through, and on the colours of the lights that contribute to it. A shadow ray
/// blocked by one object depends on no other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Touched(u64);

impl Touched {
    /// The empty set.
    pub(crate) const NOTHING: Self = Self(0);

    /// The set of one object, by its number.
    #[inline]
    pub(crate) fn object(number: u32) -> Self {
        Self(1 << (number % u64::BITS))
    }

    /// The set of one light, by its number, counted from the other end to avoid shared bits.
    #[inline]
    pub(crate) fn light(number: usize) -> Self {
        Self(1 << 63 >> (number as u32 % u64::BITS))
    }

    /// The set as bits, each of which stands for some objects and lights.
    pub(crate) fn bits(self) -> u64 {
        self.0
    }

    /// The set with these bits.
    pub(crate) fn of_bits(bits: u64) -> Self {
        Self(bits)
    }

    /// Whether two sets may intersect.
    pub(crate) fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// Returns the difference between two jobs with their worlds; `None` if more than materials,
    /// colours of lights and the number of samples differ.
    pub(crate) fn between(before: (&Job, &World), after: (&Job, &World)) -> Option<Self> {
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
        let mut touched = Self::default();
        for (number, (light, new)) in scene.lights.iter().zip(&new_scene.lights).enumerate() {
            if light == new {
                continue;
            }
            let colour = new.colour;
            // BSDF samples may hit any light.
            if *new != (Light { colour, ..*light }) || job.settings.integrator.traces_paths() {
                return None;
            }
            touched |= Self::light(number);
        }
        Some(touched | repainted(scene, new_scene))
    }
}

/// The objects, with the same shapes in two scenes, that have different materials. Equal materials
/// may have different numbers.
fn repainted(scene: &Scene, new_scene: &Scene) -> Touched {
    let [materials, new_materials] = [&scene.materials, &new_scene.materials];
    let changed: Vec<_> = materials.differences(new_materials, Material::ne).collect();
    let has_changed = |number, _| changed.binary_search(&(number as usize)).is_ok();
    let differ = |number, new| materials[number as usize] != new_materials[new as usize];
    let of_block = |number: u32, block: &[Object], new: &[Object], differ: &Differ| {
        let pairs = (number * BLOCK as u32..).zip(block.iter().zip(new));
        let repainted = pairs.filter(|(_, (object, new))| looks_other(object, new, differ));
        repainted.fold(Touched::default(), |touched, (number, _)| {
            touched | Touched::object(number)
        })
    };
    let blocks = scene.objects.blocks().par_iter();
    let blocks = blocks.zip(new_scene.objects.blocks()).enumerate();
    let blocks = blocks.map(|(number, pair)| (number as u32, pair));
    let touched = blocks.map(|(number, (block, new))| {
        if !Arc::ptr_eq(block, new) {
            of_block(number, block, new, &differ)
        } else if changed.is_empty() {
            Touched::default()
        } else {
            of_block(number, block, new, &has_changed)
        }
    });
    touched.reduce(Touched::default, Touched::bitor)
}

/// Whether a material of a scene differs from one of a new scene, by their numbers.
type Differ<'a> = dyn Fn(u32, u32) -> bool + 'a;

impl BitOr for Touched {
    type Output = Self;

    #[inline]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitOrAssign for Touched {
    #[inline]
    fn bitor_assign(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

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
