//! Sampling of objects that emit light: from a point, one of their parts is chosen
//! through a [`tree`], and a direction toward it ([`aim`]). Of many lights, one is chosen likewise
//! ([`many`]).
//!
//! Parts are triangles, squares and balls. Emission of other solids, of the inside of balls, and
//! what is too weak or small to count are left to BSDF sampling: their density is 0 here.

mod aim;
mod cone;
mod many;
mod split;
#[cfg(test)]
mod tests;
mod tree;

use std::sync::Arc;

use glam::DVec3;
use rayon::prelude::*;

use crate::material::{Textures, strength};
use crate::sampling::Fours;
use aim::{Aim, Flats};
use cone::{Cone, Reach};
use geometry::lanes::{Lanes, Row, Simd, Vector, WIDTH, bits, each_bit, mask};
use geometry::{Hit, Instance, IsCancelled, Patch, Ray, Shape, Side};
pub(crate) use many::ManyLights;
use scene::{Faces, Material, Object, Rgb, Scene, Tinted};
use tree::Tree;

/// Points of an object at which a texture of its emission is looked up; at least one for each part.
const LOOKED_UP: u32 = 1024;

/// The parts of objects that emit light.
#[derive(Clone, Debug, Default)]
pub(crate) struct Emitters {
    /// In ascending order.
    parts: Vec<Part>,
    tree: Tree,
    glows: Vec<Glow>,
}

/// A part of an object's surface, as in [`Hit::part`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Part {
    object: u32,
    part: u32,
}

/// The emission of an object that emits light.
#[derive(Clone, Debug, PartialEq)]
struct Glow {
    object: u32,
    /// One for each of its materials.
    sources: Vec<Source>,
    /// Its only part; `None` for a mesh.
    patch: Option<Patch>,
}

/// The emission of a material.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Source {
    emission: Tinted,
    faces: Faces,
}

/// An emitter, with the probability of its choice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Picked {
    emitter: u32,
    chance: f64,
}

/// A direction toward a part of an emitter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Choice {
    /// Index of the object.
    pub(crate) object: u32,
    /// The part of its surface.
    pub(crate) part: u32,
    /// The unit vector toward the chosen point.
    pub(crate) toward: DVec3,
    /// The distance within which a ray hits the part, if nothing is in between.
    pub(crate) reach: f64,
    /// The probability density of the choice per steradian.
    pub(crate) density: f64,
    /// The side of the part that it hits.
    pub(crate) side: Side,
}

/// Directions toward parts of emitters, in lanes: see [`Choice`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Choices {
    /// The lanes with a direction.
    pub(crate) lanes: u32,
    /// The indices of the object and of the part of its surface.
    pub(crate) parts: [(u32, u32); WIDTH],
    pub(crate) toward: Vector<Row>,
    pub(crate) reach: Row,
    pub(crate) density: Row,
    /// The lanes that hit the front of the part.
    front: u32,
}

impl Default for Choices {
    fn default() -> Self {
        Self {
            lanes: 0,
            parts: [(0, 0); WIDTH],
            toward: Vector::repeat(DVec3::ZERO),
            reach: Row::all(f64::INFINITY),
            density: Row::all(0.0),
            front: 0,
        }
    }
}

impl Choices {
    fn set(&mut self, lane: usize, choice: Choice) {
        self.lanes |= 1 << lane;
        self.parts[lane] = (choice.object, choice.part);
        self.toward.set(lane, choice.toward);
        self.reach.0[lane] = choice.reach;
        self.density.0[lane] = choice.density;
        self.front |= u32::from(choice.side == Side::Front) << lane;
    }

    /// The side of the part that the direction in a lane hits.
    #[inline]
    pub(crate) fn side(&self, lane: usize) -> Side {
        if self.front >> lane & 1 == 1 {
            Side::Front
        } else {
            Side::Back
        }
    }
}

/// The lanes whose emitters are triangles of one mesh, the first found: a batch rarely has several.
/// Their vertices are read lane after lane, so that the waits for memory overlap.
#[derive(Default)]
struct MeshLanes<'s> {
    /// The mesh, with the index of its object.
    mesh: Option<(u32, &'s Instance)>,
    lanes: u32,
    triangles: [u32; WIDTH],
}

impl<'s> MeshLanes<'s> {
    /// Whether a part of an object is a triangle of the mesh, in which case it is taken into a lane.
    #[inline(always)]
    fn take(&mut self, scene: &'s Scene, lane: usize, (object, part): (u32, u32)) -> bool {
        if self.mesh.is_none()
            && let Shape::Mesh(instance) = &scene.objects[object as usize].shape
        {
            self.mesh = Some((object, instance.as_ref()));
        }
        let takes = self.mesh.is_some_and(|(mesh, _)| mesh == object);
        if takes {
            self.lanes |= 1 << lane;
            self.triangles[lane] = part;
        }
        takes
    }
}

/// What is known from a world before, for whose emitters it may do.
#[derive(Clone, Copy)]
pub(crate) struct PreviousEmitters<'k> {
    pub(crate) emitters: &'k Arc<Emitters>,
    pub(crate) textures: &'k Textures,
    /// The objects whose shapes differ.
    pub(crate) changed: &'k [u32],
}

impl From<(u32, f64)> for Picked {
    fn from((emitter, chance): (u32, f64)) -> Self {
        Self { emitter, chance }
    }
}

impl Emitters {
    /// Collects the emitters of a scene, or returns those known if they are the same; `None` once
    /// `cancelled` returns true.
    pub(crate) fn build(
        scene: &Scene,
        textures: &Textures,
        known: Option<PreviousEmitters<'_>>,
        cancelled: IsCancelled<'_>,
    ) -> Option<Arc<Self>> {
        let glows = glows(scene);
        if let Some(known) = known
            && known.emitters.serve(&glows, textures, known)
        {
            return Some(Arc::clone(known.emitters));
        }
        let mut parts = Vec::new();
        let mut reaches = Vec::new();
        for glow in &glows {
            let object = &scene.objects[glow.object as usize];
            let found = (0..object.shape.patches())
                .into_par_iter()
                .filter_map(|part| Some((part, reach(scene, textures, object, part)?)));
            let found: Vec<_> = found.collect();
            if cancelled() {
                return None;
            }
            parts.extend(found.iter().map(|&(part, _)| Part {
                object: glow.object,
                part,
            }));
            reaches.extend(found.into_iter().map(|(_, reach)| reach));
        }
        parts.shrink_to_fit();
        let tree = Tree::build(&reaches, cancelled)?;
        Some(Arc::new(Self { parts, tree, glows }))
    }

    /// Whether there are none.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// A direction toward an emitter that was picked.
    fn choice(&self, Picked { emitter, chance }: Picked, aim: Aim) -> Choice {
        let Part { object, part } = self.parts[emitter as usize];
        Choice {
            object,
            part,
            toward: aim.toward,
            reach: aim.reach,
            density: chance * aim.density,
            side: aim.side,
        }
    }

    /// Chooses an emitter for each of several surfaces at points with normals, by the third of its numbers
    /// in 0..1, and a direction toward it by the first two.
    #[inline(always)]
    pub(crate) fn choose_together<S: Simd>(
        &self,
        simd: S,
        scene: &Scene,
        at: (&Vector<Row>, &Vector<Row>),
        numbers: &Fours,
        lanes: u32,
    ) -> Choices {
        let (from, _) = at;
        let picked = self.tree.choose_together(simd, at, &numbers.0[2], lanes);
        let mut flats = Flats::NONE;
        let mut chances = Row::all(0.0);
        let mut choices = Choices::default();
        let mut flat = 0;
        let mut in_mesh = MeshLanes::default();
        for lane in each_bit(lanes) {
            let Some(Picked { emitter, chance }) = picked[lane] else {
                continue;
            };
            let Part { object, part } = self.parts[emitter as usize];
            choices.parts[lane] = (object, part);
            chances.0[lane] = chance;
            if in_mesh.take(scene, lane, (object, part)) {
                continue;
            }
            let Some(patch) = self.patch(scene, emitter) else {
                continue;
            };
            if flats.set(lane, &patch) {
                flat |= 1 << lane;
            } else {
                let [u, v, ..] = numbers.lane(lane);
                if let Some(aim) = aim::aim(&patch, from.get(lane), [u, v]) {
                    choices.set(lane, self.choice(Picked { emitter, chance }, aim));
                }
            }
        }
        flat |= in_mesh.lanes;
        if flat != 0 {
            let mut flats = flats.load(simd);
            if let Some((_, instance)) = in_mesh.mesh {
                let triangles = instance.triangles(simd, &in_mesh.triangles, in_mesh.lanes);
                flats.put_triangles(mask(simd, in_mesh.lanes), &triangles);
            }
            let (aims, is_finite) = flats.aim(from.load(simd), numbers.pair(simd));
            let flat = flat & bits::<S>(is_finite);
            let chosen = mask(simd, flat);
            let density = chances.load(simd) * aims.density;
            choices.lanes |= flat;
            choices.front |= flat & bits::<S>(aims.is_front);
            let others = choices.toward.load(simd);
            choices.toward = Vector::select(chosen, aims.toward, others).store();
            let others = choices.reach.load(simd);
            choices.reach = Lanes::select(chosen, aims.reach, others).into();
            let others = choices.density.load(simd);
            choices.density = Lanes::select(chosen, density, others).into();
        }
        choices
    }

    /// The density of [`Emitters::choose_together`] per steradian for a direction in which a part of an object is
    /// hit at a point.
    pub(crate) fn density(
        &self,
        scene: &Scene,
        (from, normal): (DVec3, DVec3),
        toward: DVec3,
        (object, part): (u32, u32),
        at: DVec3,
    ) -> f64 {
        let Ok(emitter) = self.parts.binary_search(&Part { object, part }) else {
            return 0.0;
        };
        let patch = scene.objects[object as usize].shape.patch(part);
        let density = patch.map_or(0.0, |patch| aim::density(&patch, from, toward, at));
        density * self.tree.chance(emitter as u32, from, normal)
    }

    /// The part of the surface that an emitter is.
    #[inline]
    fn patch(&self, scene: &Scene, emitter: u32) -> Option<Patch> {
        let Part { object, part } = self.parts[emitter as usize];
        match self.known_patch(object) {
            Some(patch) => Some(*patch),
            None => scene.objects[object as usize].shape.patch(part),
        }
    }

    /// The only part of an object, if it is not a mesh.
    fn known_patch(&self, object: u32) -> Option<&Patch> {
        let found = self.glows.binary_search_by_key(&object, |glow| glow.object);
        self.glows[found.ok()?].patch.as_ref()
    }

    /// Whether these emitters are those of a scene with these glows.
    fn serve(&self, glows: &[Glow], textures: &Textures, known: PreviousEmitters<'_>) -> bool {
        let is_same = |object: u32| {
            let found = self.glows.binary_search_by_key(&object, |glow| glow.object);
            found.is_err()
        };
        let has_texture = |glow: &Glow| {
            let mut sources = glow.sources.iter();
            sources.any(|source| source.emission.texture.is_some())
        };
        self.glows == glows
            && known.changed.iter().all(|&object| is_same(object))
            && (!glows.iter().any(has_texture) || textures.are_those_of(known.textures))
    }
}

/// The objects that emit light and have parts that can be chosen, in order.
fn glows(scene: &Scene) -> Vec<Glow> {
    let emits = |material: &Material| material.emission != Rgb::ZERO;
    if !(scene.materials.par_numbered()).any(|(_, material)| emits(material)) {
        return Vec::new();
    }
    let source = |material: u32| {
        let material = &scene.materials[material as usize];
        let maps = material.maps.as_ref();
        Source {
            emission: Tinted {
                colour: material.emission,
                texture: maps.and_then(|maps| maps.emission),
            },
            faces: material.lit,
        }
    };
    let glow = |(number, object): (usize, &Object)| {
        let sources: Vec<_> = match &object.shape {
            Shape::Mesh(instance) => instance
                .tags()
                .map(|tag| source(tag.unwrap_or(object.material)))
                .collect(),
            _ if emits(&scene.materials[object.material as usize]) => {
                vec![source(object.material)]
            }
            _ => return None,
        };
        let mut colours = sources.iter().map(|source| source.emission.colour);
        let is_bright = colours.any(|colour| colour != Rgb::ZERO);
        let is_mesh = matches!(object.shape, Shape::Mesh(_));
        (is_bright && 0 < object.shape.patches()).then(|| Glow {
            object: number as u32,
            sources,
            patch: if is_mesh { None } else { object.shape.patch(0) },
        })
    };
    scene.objects.par_numbered().filter_map(glow).collect()
}

/// What a part of an object can light; `None` if nothing.
fn reach(scene: &Scene, textures: &Textures, object: &Object, part: u32) -> Option<Reach> {
    let material = object.material_at(Hit { t: 0.0, part });
    let material = &scene.materials[material as usize];
    if material.emission == Rgb::ZERO {
        return None;
    }
    let patch = object.shape.patch(part)?;
    let maps = material.maps.as_ref();
    let texture = maps.and_then(|maps| maps.emission);
    let emission = Tinted {
        colour: material.emission,
        texture,
    };
    let radiance = match texture {
        None => strength(material.emission),
        Some(_) => mean(textures, emission, &object.shape, part, &patch),
    };
    let strength = radiance * patch.area();
    let cone = match &patch {
        Patch::Triangle(flat) | Patch::Parallelogram(flat) => {
            let cone = Cone::around(flat.normal.normalize_or_zero());
            match material.lit {
                Faces::Both => cone.two_sided(),
                Faces::Front => cone,
            }
        }
        Patch::Ball(_) => Cone::ALL,
    };
    let bounds = patch.bounds();
    (0.0 < strength && strength.is_finite() && bounds.is_bounded()).then_some(Reach {
        bounds,
        cone,
        strength,
    })
}

/// The mean strength of a texture over a part.
fn mean(textures: &Textures, emission: Tinted, shape: &Shape, part: u32, patch: &Patch) -> f64 {
    let count = f64::from(LOOKED_UP / shape.patches())
        .sqrt()
        .floor()
        .max(1.0);
    let size = patch.bounds().half_diagonal();
    let middle = |index: usize| (index as f64 + 0.5) / count;
    let side = count as usize;
    let mut sum = 0.0;
    for row in 0..side {
        for column in 0..side {
            let (point, normal) = aim::point(patch, [middle(column), middle(row)]);
            let ray = Ray {
                origin: point + size * normal,
                direction: -normal,
            };
            let uv = shape.chart(&ray, Hit { t: size, part }).uv;
            sum += strength(textures.colour(emission, uv));
        }
    }
    sum / (count * count)
}
