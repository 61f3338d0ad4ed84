//! The lights that emit photons, and the objects that may turn these.

use glam::{DVec2, DVec3};

use super::aim::Aim;
use crate::light::{falloff_shares, luminous_sphere, radiant_intensity};
use crate::material::{Microfacets, strength};
use crate::sampling::{Purpose, Sampler, warp};
use crate::world::World;
use geometry::{Aabb, IsCancelled, Ray, Shape};
use scene::{Emitter, Falloff, Highlight, Light, Material, Object, Rgb};

/// Rows of cells in the projection map of a light, if there are few.
const ROWS: u32 = 128;

/// Cells of all projection maps together.
const CELLS: usize = 1 << 18;

/// Boxes around mirrors and boundaries, at most: beyond, those near each other in the order of
/// traversal share one.
const TARGETS: usize = 1024;

/// Pairs of lights and boxes, at most.
const PAIRS: usize = 1 << 22;

/// All that emits photons.
#[derive(Clone, Debug)]
pub(crate) struct Emission {
    sources: Vec<Source>,
    /// The sum of the strengths of all sources; 0 if there are none.
    pub(crate) power: f64,
}

/// A light that emits photons.
#[derive(Clone, Debug)]
struct Source {
    centre: DVec3,
    radius: f64,
    falloff: Falloff,
    /// Power per steradian, that of a spot along its axis.
    intensity: Rgb,
    aim: Aim,
    /// The sum of the strengths up to and including this source: each is that of its power.
    until: f64,
    is_sphere: bool,
}

/// A photon as it leaves a light.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Emitted {
    pub(crate) ray: Ray,
    /// Its power, as a multiple of the mean of all photons.
    pub(crate) power: Rgb,
    /// Whether a path meets the light only by another bounce.
    pub(crate) is_seen: bool,
}

impl Emission {
    /// Collects the lights of a world that emit photons toward mirrors and boundaries; `None` once
    /// `cancelled` returns true.
    pub(crate) fn of(world: &World, cancelled: IsCancelled<'_>) -> Option<Self> {
        let lights = || {
            let lights = world.lights().iter();
            lights.filter_map(|light| Some((light, radiant_intensity(light)?)))
        };
        let count = lights().count();
        let mut emission = Self {
            sources: Vec::new(),
            power: 0.0,
        };
        if count == 0 {
            return Some(emission);
        }
        let targets = targets(world, TARGETS.min(PAIRS / count).max(1));
        let rows = ((CELLS / count / 2) as f64).sqrt() as u32;
        let rows = if rows == 0 { 1 } else { 1 << rows.ilog2() }.min(ROWS);
        for (light, intensity) in lights() {
            if cancelled() {
                return None;
            }
            emission.add(light, intensity, &targets, rows);
        }
        Some(emission)
    }

    /// Adds a light unless it reaches no target.
    fn add(&mut self, light: &Light, intensity: Rgb, targets: &[Aabb], rows: u32) {
        let Emitter::Point {
            position,
            radius,
            falloff,
        } = light.emitter
        else {
            return;
        };
        let aim = Aim::new(position, radius, targets, rows);
        let power = strength(intensity) * aim.solid_angle();
        if 0.0 < power && power.is_finite() {
            self.power += power;
            self.sources.push(Source {
                centre: position,
                radius,
                falloff,
                intensity,
                aim,
                until: self.power,
                is_sphere: luminous_sphere(light).is_some(),
            });
        }
    }

    /// Emits a photon; `None` if nothing emits any.
    pub(crate) fn emit(&self, sampler: Sampler) -> Option<Emitted> {
        let [number, cell, u, v] = sampler.four(Sampler::ROOT, Purpose::Emission);
        let chosen = number * self.power;
        let at = self
            .sources
            .partition_point(|source| source.until <= chosen);
        let source = self.sources.get(at).or_else(|| self.sources.last())?;
        let direction = source.aim.choose([cell, u, v]);
        // A source is chosen by its strength.
        let power = source.intensity / strength(source.intensity);
        if !source.is_sphere {
            let [_, share] = falloff_shares(&source.falloff, 1.0, -direction);
            return Some(Emitted {
                ray: Ray {
                    origin: source.centre,
                    direction,
                },
                power: share * power,
                is_seen: false,
            });
        }
        // Uniform over the disc that the sphere shows in this direction.
        let [u, v, ..] = sampler.four(Sampler::ROOT, Purpose::Lens);
        let DVec2 { x, y } = warp::in_disc([u, v]);
        let height = (1.0 - x * x - y * y).max(0.0).sqrt();
        let [right, up] = warp::basis(direction);
        let aside = x * right + y * up + height * direction;
        Some(Emitted {
            ray: Ray {
                origin: source.centre + source.radius * aside,
                direction,
            },
            power,
            is_seen: true,
        })
    }
}

/// Boxes around the objects that may have a mirror or a boundary.
fn targets(world: &World, most: usize) -> Vec<Aabb> {
    let scene = &*world.scene;
    let mut turning = vec![false; scene.materials.len()];
    for (number, material) in scene.materials.numbered() {
        turning[number] = turns(material);
    }
    let objects = world.order().iter();
    let objects = objects.map(|&number| &scene.objects[number as usize]);
    let objects = objects.filter(|object| any(object, &turning));
    let boxes: Vec<_> = objects.map(|object| object.shape.bounds()).collect();
    let together = boxes.len().div_ceil(most).max(1);
    let union = |boxes: &[Aabb]| boxes.iter().copied().fold(Aabb::EMPTY, Aabb::union);
    boxes.chunks(together).map(union).collect()
}

/// Whether any of the materials of an object has a property.
fn any(object: &Object, has: &[bool]) -> bool {
    let has = |material: u32| has[material as usize];
    match &object.shape {
        Shape::Mesh(instance) => {
            let mut tags = instance.tags();
            tags.any(|tag| has(tag.unwrap_or(object.material)))
        }
        Shape::Csg(csg) => csg.tags().any(has),
        Shape::Solid(_) | Shape::Plane(_) => has(object.material),
    }
}

/// Whether a material may have a mirror or a boundary.
fn turns(material: &Material) -> bool {
    let is_mirror = match material.highlight {
        Highlight::Microfacet { roughness, .. } => {
            let maps = material.maps.as_ref();
            let is_mapped = maps.is_some_and(|maps| maps.roughness.is_some());
            is_mapped || Microfacets::is_perfect(roughness * roughness)
        }
        _ => false,
    };
    is_mirror || material.mirror.tint != Rgb::ZERO || material.dielectric.tint != Rgb::ZERO
}
