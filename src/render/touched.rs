//! What pixels depend on, so that an edit of a material or of a light's colour needs only some of
//! them traced anew (Brière and Poulin, "Hierarchical View-dependent Structures for Interactive Scene
//! Manipulation", 1996, who keep whole trees of rays).

use std::ops::{BitOr, BitOrAssign};

use super::frame::Job;
use super::world::World;
use crate::geometry::Shape;
use crate::scene::{Integrator, Light, Object, Scene};

/// A set of objects and lights, perhaps with some more than were put in: several share a bit.
///
/// A pixel depends on the materials of the objects that its rays come to and that its shadow rays are
/// blocked by or go through, and on the colours of the lights that reach what it shows. A shadow ray
/// that one object blocks depends on no other.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Touched(u64);

impl Touched {
    /// The empty set.
    pub(crate) const NOTHING: Self = Self(0);

    /// An object, by its number.
    #[inline]
    pub(crate) fn object(number: u32) -> Self {
        Self(1 << (number % u64::BITS))
    }

    /// A light, by its number. Lights begin at the other end: few of both share no bit.
    #[inline]
    pub(crate) fn light(number: usize) -> Self {
        Self(1 << 63 >> (number as u32 % u64::BITS))
    }

    /// Whether they may have something in common.
    pub(crate) fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }

    /// What is not the same in two jobs with their worlds. `None` if it is more than materials and
    /// colours of lights.
    pub(crate) fn between(before: (&Job, &World), after: (&Job, &World)) -> Option<Self> {
        let ((job, world), (new_job, new_world)) = (before, after);
        let (scene, new_scene) = (&*world.scene, &*new_world.scene);
        let is_alike = job.settings == new_job.settings
            && job.frames == new_job.frames
            && job.camera == new_job.camera
            && job.images == new_job.images
            && world.has_shapes_of(new_world)
            && scene.ambient == new_scene.ambient
            && scene.textures == new_scene.textures
            && scene.setting == new_scene.setting
            && scene.lights.len() == new_scene.lights.len();
        if !is_alike {
            return None;
        }
        let mut touched = Self::default();
        for (number, (light, new)) in scene.lights.iter().zip(&new_scene.lights).enumerate() {
            if light == new {
                continue;
            }
            let colour = new.colour;
            // Paths meet lights by chance, too.
            if *new != (Light { colour, ..*light }) || job.settings.integrator == Integrator::Path {
                return None;
            }
            touched |= Self::light(number);
        }
        let objects = scene.objects.iter().zip(new_scene.objects.iter());
        for (number, (object, new)) in (0..).zip(objects) {
            if looks_other((object, scene), (new, new_scene)) {
                touched |= Self::object(number);
            }
        }
        Some(touched)
    }
}

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

/// Whether an object, whose shape is the same in two scenes, is made of something else. Scenes may
/// number equal materials otherwise.
fn looks_other((object, scene): (&Object, &Scene), (new, new_scene): (&Object, &Scene)) -> bool {
    let differ = |material: u32, new_material: u32| {
        scene.materials[material as usize] != new_scene.materials[new_material as usize]
    };
    match &object.shape {
        Shape::Csg(csg) => csg.tags().any(|tag| differ(tag, tag)),
        Shape::Mesh(instance) => instance.tags().any(|tag| match tag {
            Some(tag) => differ(tag, tag),
            None => differ(object.material, new.material),
        }),
        _ => differ(object.material, new.material),
    }
}
