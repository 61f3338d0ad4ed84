//! A scene prepared for tracing.
//!
//! It has a tree over the objects, and one over the triangles of each mesh, shared by its instances
//! and kept as long as the mesh is in the scene.

mod dependencies;
mod intersect;
mod nearby;
mod packets;
mod picking;
mod projection;
mod shading_point;
mod spheres;
mod standing;
mod structures;
mod surfaces;

pub(crate) use dependencies::Dependencies;
pub(crate) use intersect::{Crossed, Nearest, NearestHits, Occlusion};
pub(crate) use nearby::Nearby;
pub use picking::{
    SurfacePoint, camera_axes, distance_to_surface, pixel_width, project_line, project_point,
    surface_under,
};
pub(crate) use projection::Projection;
pub use standing::{summit, surrounds, top_at};
#[cfg(test)]
pub(crate) use structures::Search;
pub(crate) use structures::{Structures, instances};
pub(crate) use surfaces::HitPoints;

use std::cell::Cell;
use std::ops::Range;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use self::spheres::Spheres;
use super::job::Settings;
use super::light::{Emitters, ManyLights, PreviousEmitters, Sky, SphereLights, faded};
use super::material::{Textures, environment_place};
use super::simd_level::level;
use crate::light::light_sphere;
use accel::{Bvh, RUN};
use geometry::lanes::Level;
use geometry::{IsCancelled, Ray};
use scene::{FalloffRule, GlossRule, Images, Integrator, Light, Object, Objects, Rgb, Scene};

/// Up to this many objects are intersected without a tree. Measured with single rays: with two
/// solids, no tree is 1.5 times as fast; with six to eleven, a tree is 1.2 to 1.7 times as fast. With
/// packets of eight and eleven solids, a tree is 1.1 times as fast.
pub(super) const MOST_WITHOUT_TREE: usize = 4;

/// The same for paths, whose packets spread after the first bounce: without a tree, eight objects take
/// 8 % less time and twelve 6 % less. More were not measured.
pub(super) const MOST_WITHOUT_TREE_FOR_PATHS: usize = 16;

/// Cancellation is polled once in this many objects.
const POLLED: usize = 1 << 12;

/// The order of objects without a tree.
const FILE_ORDER: [u32; MOST_WITHOUT_TREE_FOR_PATHS] =
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15];

/// The runs in which objects without a tree are visited.
pub(super) fn runs_in_file_order(count: usize) -> impl Iterator<Item = Range<usize>> {
    let starts = (0..count).step_by(RUN);
    starts.map(move |start| start..count.min(start + RUN))
}

/// Up to how many objects are intersected without a tree.
fn most_without_tree(integrator: Integrator) -> usize {
    match integrator {
        Integrator::Path | Integrator::Photon => MOST_WITHOUT_TREE_FOR_PATHS,
        Integrator::Whitted => MOST_WITHOUT_TREE,
    }
}

/// What paths sample of the light of a scene: lights, objects and the environment.
type Sampled = (Arc<ManyLights>, Arc<Emitters>, Arc<Sky>);

/// Prepares what paths sample of the light of a scene, or keeps what is the same in a previous world,
/// of which `known` gives the objects with other shapes. `None` once `cancelled` returns true.
fn sampled(
    (scene, lights, textures): (&Scene, &[Light], &Textures),
    previous: Option<&World>,
    known: Option<(&World, &[u32])>,
    cancelled: IsCancelled<'_>,
) -> Option<Sampled> {
    let sky = previous.map(|world| (&world.sky, &world.textures));
    let sky = Sky::build(scene, textures, sky, cancelled)?;
    let known = known.map(|(world, changed)| PreviousEmitters {
        emitters: &world.emitters,
        textures: &world.textures,
        changed,
    });
    let emitters = Emitters::build(scene, textures, known, cancelled)?;
    let known = previous.map(|world| &world.many_lights);
    let many_lights = ManyLights::build(lights, known, cancelled)?;
    Some((many_lights, emitters, sky))
}

/// The structures by which rays search the objects of a scene.
struct Shapes {
    tree: Option<Arc<Bvh>>,
    spheres: Arc<Spheres>,
    structures: Structures,
}

/// Prepares the structures of objects, or keeps those of a previous world, from which only the shapes of
/// the objects in `changed` differ, if it is known which. `None` once `cancelled` returns true.
fn prepared_shapes(
    objects: &Objects,
    integrator: Integrator,
    previous: Option<&World>,
    changed: Option<&[u32]>,
    cancelled: IsCancelled<'_>,
) -> Option<Shapes> {
    let needs_tree = most_without_tree(integrator) < objects.len();
    let is_same = |previous: &&World| {
        changed.is_some_and(<[u32]>::is_empty) && previous.tree.is_some() == needs_tree
    };
    if let Some(previous) = previous.filter(is_same) {
        return Some(Shapes {
            tree: previous.tree.clone(),
            spheres: Arc::clone(&previous.spheres),
            structures: previous.structures.clone(),
        });
    }
    let known = previous.map(|world| &world.structures);
    let structures = Structures::build(objects, known, cancelled)?;
    let tree = if needs_tree {
        Some(Arc::new(tree(objects, previous, changed, cancelled)?))
    } else {
        None
    };
    let order = match &tree {
        Some(tree) => tree.order(),
        None => &FILE_ORDER[..objects.len()],
    };
    let runs = match &tree {
        Some(tree) => tree.runs(cancelled)?,
        None => runs_in_file_order(objects.len()).collect(),
    };
    let spheres = Arc::new(Spheres::new(objects, order, &runs, cancelled)?);
    Some(Shapes {
        tree,
        spheres,
        structures,
    })
}

/// The tree over objects: that of a previous world, adapted, if few shapes differ. `None` once `cancelled`
/// returns true.
fn tree(
    objects: &Objects,
    previous: Option<&World>,
    changed: Option<&[u32]>,
    cancelled: IsCancelled<'_>,
) -> Option<Bvh> {
    let bounds = |object: u32| objects[object as usize].shape.bounds();
    let known = previous.and_then(|world| world.tree.as_ref());
    // Once cancelled, none is adapted, and none is built.
    let adapted = known.and_then(|tree| {
        if let Some(changed) = changed {
            return tree.refitted(changed, bounds, cancelled);
        }
        let before = &previous?.scene.objects;
        let (removed, inserted) = replaced(before, objects, cancelled)?;
        tree.spliced(removed, inserted, bounds, cancelled)
    });
    match adapted {
        Some(tree) => Some(tree),
        None => Bvh::over(objects.len(), bounds, cancelled),
    }
}

/// The settings that the preparation of a scene depends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct WorldSettings {
    pub(crate) integrator: Integrator,
    pub(crate) falloff: FalloffRule,
    pub(crate) gloss: GlossRule,
}

impl WorldSettings {
    /// The part of a picture's settings that the preparation of its scene depends on.
    pub(crate) fn of(settings: &Settings) -> Self {
        Self {
            integrator: settings.integrator,
            falloff: settings.falloff,
            gloss: settings.gloss,
        }
    }
}

/// A scene and its acceleration structures.
#[derive(Clone, Debug)]
pub(crate) struct World {
    pub(crate) scene: Arc<Scene>,
    pub(crate) textures: Textures,
    /// The sum of all ambient light.
    pub(crate) ambient: Rgb,
    /// The lights if a rule makes them fade; otherwise they are the scene's.
    pub(super) faded: Option<Vec<Light>>,
    /// The rule that blurs reflections and refractions.
    pub(crate) gloss: GlossRule,
    /// The lights with a size.
    pub(crate) sphere_lights: SphereLights,
    /// The lights of which paths choose one at each surface.
    pub(crate) many_lights: Arc<ManyLights>,
    /// The objects that emit light, for paths.
    pub(crate) emitters: Arc<Emitters>,
    /// The environment, for paths.
    pub(crate) sky: Arc<Sky>,
    /// Whether paths ask for emitters or the environment.
    pub(crate) has_emitters: bool,
    /// Whether paths sample light at random: of emitters, the environment, lights with a size or one of
    /// many lights.
    pub(crate) samples_lights: bool,
    /// The vector instructions to trace with.
    pub(crate) level: Level,
    pub(crate) tree: Option<Arc<Bvh>>,
    /// Indexed by position in [`World::order`].
    pub(crate) spheres: Arc<Spheres>,
    pub(crate) structures: Structures,
    /// For each object, whether it is a mesh that blocks all light; empty without such meshes.
    pub(crate) opaque: Vec<bool>,
}

impl World {
    /// Prepares a scene. Keeps the tree of `previous` if the shapes are the same, and the
    /// structures of its meshes in any case. `None` once `cancelled` returns true.
    pub(crate) fn build(
        scene: Arc<Scene>,
        images: &Images,
        settings: WorldSettings,
        previous: Option<&Self>,
        cancelled: IsCancelled<'_>,
    ) -> Option<Self> {
        let textures = Textures::new(&scene.textures, images);
        let ambient = scene.ambient_light();
        let WorldSettings {
            integrator,
            falloff,
            gloss,
        } = settings;
        let faded = faded(&scene.lights, falloff);
        let lights = faded.as_deref().unwrap_or(&scene.lights);
        let sphere_lights = SphereLights::new(lights, cancelled)?;
        let level = level();
        let opaque = opaque_meshes(&scene);
        let changed = previous
            .and_then(|world| changed_shapes(&world.scene.objects, &scene.objects, cancelled));
        let known = previous.zip(changed.as_deref());
        let (many_lights, emitters, sky) = if integrator == Integrator::Whitted {
            let each = ManyLights::none(lights);
            (Arc::new(each), Arc::default(), Arc::new(Sky::unsampled()))
        } else {
            sampled((&scene, lights, &textures), previous, known, cancelled)?
        };
        let has_emitters = !emitters.is_empty() || !sky.is_unsampled();
        let samples_lights = has_emitters
            || !many_lights.is_empty()
            || lights.iter().any(|light| light_sphere(light).is_some());
        let shapes = prepared_shapes(
            &scene.objects,
            integrator,
            previous,
            changed.as_deref(),
            cancelled,
        )?;
        Some(Self {
            scene,
            textures,
            ambient,
            faded,
            gloss,
            sphere_lights,
            many_lights,
            emitters,
            sky,
            has_emitters,
            samples_lights,
            level,
            tree: shapes.tree,
            spheres: shapes.spheres,
            structures: shapes.structures,
            opaque,
        })
    }

    /// The lights, in file order.
    #[inline]
    pub(crate) fn lights(&self) -> &[Light] {
        self.faded.as_deref().unwrap_or(&self.scene.lights)
    }

    /// Whether both worlds have the same shapes, judging by the structures they share.
    pub(crate) fn has_shapes_of(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.spheres, &other.spheres)
    }

    /// Returns the radiance of a ray that hits nothing: the background at `screen`, in the unit
    /// square, for camera rays, and otherwise the environment.
    #[inline]
    pub(crate) fn around(&self, ray: &Ray, bounce: u32, screen: DVec2) -> Rgb {
        if bounce != 0 {
            return self.environment(ray.direction);
        }
        let background = &self.scene.setting.background;
        // The same test within `colour` costs each background pixel 13 ns.
        if background.texture.is_none() {
            return background.colour;
        }
        self.textures.colour(*background, screen)
    }

    /// The radiance of the environment from a direction.
    #[inline]
    pub(crate) fn environment(&self, toward: DVec3) -> Rgb {
        let environment = &self.scene.setting.environment;
        if environment.texture.is_none() {
            return environment.colour;
        }
        self.textures
            .colour(*environment, environment_place(toward))
    }

    /// Object numbers in the order of traversal.
    pub(crate) fn order(&self) -> &[u32] {
        match &self.tree {
            Some(tree) => tree.order(),
            None => &FILE_ORDER[..self.scene.objects.len()],
        }
    }

    /// The rule that makes a light fade, if it does not fade by itself.
    pub(crate) fn rule_of(&self, light: u32) -> FalloffRule {
        let light = light as usize;
        match &self.faded {
            Some(faded) if faded[light] != self.scene.lights[light] => FalloffRule::Square,
            Some(_) | None => FalloffRule::None,
        }
    }

    /// The transmitted fraction of light at a material.
    #[inline]
    pub(crate) fn transmission(&self, material: u32) -> f64 {
        transmission(&self.scene, material)
    }
}

/// The transmitted fraction of light at a material.
fn transmission(scene: &Scene, material: u32) -> f64 {
    scene.materials[material as usize].shadow.transmittance()
}

/// Computes [`World::opaque`].
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

/// The run of objects removed from a list, or where and how many were inserted, if all others keep their
/// shapes; `None` otherwise, or if there are many, or once `cancelled` returns true.
fn replaced(
    before: &Objects,
    after: &Objects,
    cancelled: IsCancelled<'_>,
) -> Option<(Range<u32>, u32)> {
    /// The maximum number of objects removed or inserted.
    const MOST_REPLACED: usize = 16;
    let (removed, inserted) = (
        before.len().saturating_sub(after.len()),
        after.len().saturating_sub(before.len()),
    );
    if removed + inserted == 0 || MOST_REPLACED < removed + inserted {
        return None;
    }
    let compared = Cell::new(0);
    let is_other = differs_or_cancelled(&compared, cancelled);
    let first = before.differences(after, is_other).next();
    let first = first.unwrap_or_else(|| before.len().min(after.len()));
    let rest = (first + removed..before.len()).into_par_iter();
    let is_same = |number: usize| {
        let goes_on = !number.is_multiple_of(POLLED) || !cancelled();
        goes_on && before[number].shape == after[number - removed + inserted].shape
    };
    let start = first as u32;
    rest.all(is_same)
        .then_some((start..start + removed as u32, inserted as u32))
}

/// Whether shapes differ. Once `cancelled`, polled once in [`POLLED`] comparisons, returns true, the
/// shapes compared then count as different, which ends the comparison.
fn differs_or_cancelled<'c>(
    compared: &'c Cell<usize>,
    cancelled: IsCancelled<'c>,
) -> impl Fn(&Object, &Object) -> bool + Copy + 'c {
    move |a, b| {
        let number = compared.replace(compared.get() + 1);
        a.shape != b.shape || number.is_multiple_of(POLLED) && cancelled()
    }
}

/// Returns the objects whose shapes differ; `None` if too many, or if their counts differ, or once
/// `cancelled` returns true.
fn changed_shapes(a: &Objects, b: &Objects, cancelled: IsCancelled<'_>) -> Option<Vec<u32>> {
    /// Beyond this many changes a tree is rebuilt.
    const MOST_CHANGED: usize = 32;
    if a.len() != b.len() {
        return None;
    }
    let mut changed = Vec::new();
    let compared = Cell::new(0);
    let is_other = differs_or_cancelled(&compared, cancelled);
    for number in a.differences(b, is_other) {
        changed.push(number as u32);
        if MOST_CHANGED < changed.len() || cancelled() {
            return None;
        }
    }
    Some(changed)
}

#[cfg(test)]
mod tests {
    use super::*;
    use geometry::{Shape, Solid, Sphere};

    /// Equal spheres that share no memory with those of another call.
    fn spheres(count: usize) -> Objects {
        let sphere = Object {
            shape: Shape::Solid(Solid::Sphere(Sphere {
                centre: DVec3::ZERO,
                radius: 1.0,
            })),
            material: 0,
        };
        vec![sphere; count].into()
    }

    #[test]
    fn a_comparison_of_shapes_can_be_cancelled() {
        let (a, b) = (spheres(2 * POLLED), spheres(2 * POLLED));
        let changed = |cancelled| changed_shapes(&a, &b, &|| cancelled);
        assert_eq!(changed(false), Some(vec![]));
        assert_eq!(changed(true), None);
    }
}
