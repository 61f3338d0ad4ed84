//! What is recorded of a sample: plain data without references to the scene, which names objects,
//! materials, lights and textures by their numbers.

use glam::{DVec2, DVec3};

use super::ray_kind::RayKind;
use super::verdict::Finding;
use crate::sampling::Densities;
use geometry::{Ray, Side};
use scene::{Integrator, Material, Rgb};

/// The whole tree of rays behind one sample of a pixel.
///
/// [`Explanation::radiance`] is the sample's own value, bit for bit, and so is the sum of the
/// contributions of all rays, added in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// The pixel, from the left and from the top.
    pub pixel: [u32; 2],
    /// The index of the sample; 0 is the pixel's centre.
    pub sample: u32,
    /// The integrator.
    pub integrator: Integrator,
    /// The maximum number of bounces.
    pub depth: u32,
    /// Linear radiance of the sample.
    pub radiance: Rgb,
    /// The 8-bit colour of a pixel with this sample alone.
    pub displayed: [u8; 3],
    /// Why it is so, what explains it best first; never empty.
    pub verdicts: Vec<Finding>,
    /// The rays in the order in which they were traced, each after its parent; the camera ray is the
    /// first. Those that were never traced are last.
    pub rays: Vec<TracedRay>,
}

/// A ray of a sample, apart from shadow rays.
#[derive(Clone, Debug, PartialEq)]
pub struct TracedRay {
    /// The index of the ray at whose end it starts; `None` for the camera ray.
    pub parent: Option<usize>,
    /// What it is.
    pub kind: RayKind,
    /// The number of bounces before it.
    pub bounce: u32,
    /// The weight of its radiance in the sample.
    pub weight: Rgb,
    /// Where it starts: for the camera ray at the near limit.
    pub origin: DVec3,
    /// Its direction, of unit length.
    pub direction: DVec3,
    /// The length up to which it is followed; infinite except for the camera ray.
    pub reach: f64,
    /// Absorption per unit of length.
    pub absorption: Rgb,
    /// How a path chose it; `None` for the camera ray and in Whitted ray tracing.
    pub chosen: Option<Chosen>,
    /// What it led to.
    pub end: RayEnd,
    /// What its end adds to the sample, without the rays that start there.
    pub contribution: Rgb,
}

/// How a path chose to go on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Chosen {
    /// The probability of the component: lobes, mirror or boundary.
    pub chance: f64,
    /// The probability density of the direction per steradian, that of the component included;
    /// `None` for mirrors and boundaries.
    pub density: Option<f64>,
    /// The factor on the weight: reflectance over probability.
    pub factor: Rgb,
    /// The probability of surviving Russian roulette, by which the weight is divided; 1 without it.
    pub survival: f64,
}

/// What a ray led to.
#[derive(Clone, Debug, PartialEq)]
pub enum RayEnd {
    /// It hit nothing.
    Missed {
        /// The background or environment.
        radiance: Rgb,
        /// The densities of the ray's direction, where paths also ask for the environment.
        densities: Option<Densities>,
        /// The texture without an image that this comes from, if any.
        missing: Option<u32>,
    },
    /// A surface.
    Surface(Box<Shading>),
    /// A light with a size, which paths see.
    Light(LightHit),
    /// It was not traced because the sample's budget of rays was spent.
    OverBudget,
}

/// Where a path hit a light with a size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightHit {
    /// Index of the light in the scene.
    pub light: u32,
    /// The distance along the ray.
    pub t: f64,
    /// The fraction that absorption leaves along the ray.
    pub transmitted: Rgb,
    /// Emitted radiance.
    pub radiance: Rgb,
    /// The densities and the multiple importance sampling weight of the ray's direction; `None`
    /// where only the path can find the light: from the camera, mirrors and boundaries.
    pub densities: Option<Densities>,
}

/// Where a ray hit a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfaceHit {
    /// The object, as frames call it, see [`Job::numbers`](crate::Job::numbers).
    pub object: u32,
    /// Index of the material in the scene.
    pub material: u32,
    /// Whether the object has an inside, unlike a square or a mesh.
    pub solid: bool,
    /// The distance along the ray.
    pub t: f64,
    /// The point.
    pub point: DVec3,
    /// Unit geometric normal, outward.
    pub geometric: DVec3,
    /// Unit shading normal including bumps, turned toward the side that was hit.
    pub normal: DVec3,
    /// Texture coordinates.
    pub uv: DVec2,
    /// The side that was hit.
    pub side: Side,
}

/// The light that leaves a surface toward the start of a ray, part by part.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
    /// Where.
    pub hit: SurfaceHit,
    /// The material there, with its textures applied.
    pub material: Material,
    /// The texture without an image that the material uses there, if any.
    pub missing: Option<u32>,
    /// Whether this side shows emission and the light of lights.
    pub lit: bool,
    /// The fraction that absorption leaves along the ray.
    pub transmitted: Rgb,
    /// Emitted radiance, times the weight of multiple importance sampling if there are densities.
    pub emission: Rgb,
    /// The densities of the ray's direction, where paths also ask for this emission.
    pub densities: Option<Densities>,
    /// Reflected ambient light.
    pub ambient: Rgb,
    /// Each light in file order, apart from ambient light and those that are too many to list.
    pub lights: Vec<LightTerm>,
    /// The lights too many to list.
    pub unlisted: Unlisted,
    /// What emits light without being a light, as far as the path sampled it.
    pub emitters: Vec<EmitterTerm>,
    /// What photons carry.
    pub caustics: Rgb,
    /// Emission, ambient light, all lights, emitters and photons together.
    pub radiance: Rgb,
    /// Weight of the ray reflected by a mirror.
    pub mirror: Rgb,
    /// The boundary of a transparent solid.
    pub boundary: Option<Boundary>,
    /// Why no rays go on from there, where the material asks for some.
    pub stop: Option<Stop>,
}

/// Lights that are summed but not listed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unlisted {
    /// How many.
    pub lights: usize,
    /// Their reflected light.
    pub radiance: Rgb,
}

/// The boundary of a transparent solid where a ray hits it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boundary {
    /// Weight of both the refracted and the reflected light.
    pub tint: Rgb,
    /// Indices of refraction on the side of the ray and on the other.
    pub indices: [f64; 2],
    /// The fraction that is reflected; 1 on total internal reflection.
    pub reflectance: f64,
    /// Whether it is total internal reflection.
    pub total: bool,
}

/// Why no rays go on from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stop {
    /// They would exceed the maximum number of bounces.
    Depth,
    /// The path's budget of rays is spent.
    Budget,
    /// The path found no direction that leads on.
    Nowhere,
    /// The path's weight overflowed, because materials reflect more than they receive.
    Overflow,
    /// The path did not survive Russian roulette.
    Roulette {
        /// The probability of surviving.
        survival: f64,
    },
}

/// The light of one light at a point of a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct LightTerm {
    /// Index of the light in the scene.
    pub light: u32,
    /// The probability with which it was chosen among many lights, above 0; 1 if each is sampled.
    pub chance: f64,
    /// Unit vector toward the light, or the sampled point on it; NaN at the light itself.
    pub toward: DVec3,
    /// The distance to the light or the sampled point on it; infinite for directional light.
    pub distance: f64,
    /// N·L, the cosine between the shading normal and the light.
    pub cosine: f64,
    /// The factor of attenuation with the distance.
    pub radial: f64,
    /// The factor of a spot light's cone.
    pub spot: f64,
    /// The light that arrives without occlusion, attenuation included: intensity or irradiance.
    pub arriving: Rgb,
    /// The fraction that the surface reflects from there toward the ray, N·L included; 0 behind.
    pub reflected: Rgb,
    /// The densities of the direction, for a light with a size in path tracing.
    pub densities: Option<Densities>,
    /// The fraction that reaches the point past all objects; `None` if no shadow ray was traced.
    pub transmittance: Option<f64>,
    /// What the shadow ray crosses, nearest to the point first.
    pub crossed: Vec<Crossing>,
    /// Reflected radiance.
    pub radiance: Rgb,
    /// Why it is zero, where it is.
    pub dark: Option<UnlitReason>,
}

/// The light, at a point of a surface, of an object that emits light or of the environment, by
/// next-event estimation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EmitterTerm {
    /// The object, as frames call it; `None` for the environment.
    pub object: Option<u32>,
    /// Unit vector toward the chosen point.
    pub toward: DVec3,
    /// The distance to it, or to what hides an object; else infinite.
    pub distance: f64,
    /// N·L, the cosine between the shading normal and that vector.
    pub cosine: f64,
    /// Emitted radiance; `None` if the point is hidden.
    pub emitted: Option<Rgb>,
    /// The fraction that the surface reflects from there toward the ray, N·L included; 0 behind.
    pub reflected: Rgb,
    /// The densities of the direction.
    pub densities: Densities,
    /// Reflected radiance.
    pub radiance: Rgb,
    /// Why it is zero, where it is.
    pub dark: Option<UnlitReason>,
}

/// An object that a shadow ray crosses.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The object, as frames call it.
    pub object: u32,
    /// Index of the material of the surface crossed first.
    pub material: u32,
    /// The distance from the point.
    pub t: f64,
    /// The fraction of light that it lets pass; 0 blocks.
    pub transmittance: f64,
}

/// Why a light adds nothing at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnlitReason {
    /// Its colour is zero.
    SwitchedOff,
    /// The surface does not show lights on this side, as the inside of glass.
    UnlitSide,
    /// The surface faces away from it.
    FacesAway,
    /// It is at the point itself, or the point is inside it.
    AtThePoint,
    /// The point is outside its cone.
    OutsideCone,
    /// Attenuation leaves nothing.
    Attenuated,
    /// The surface reflects none of its colour.
    NotReflected,
    /// Objects block it.
    Blocked,
    /// Another light with a size, which paths see, hides it.
    Hidden,
}

impl Explanation {
    /// For each ray, those that start at its end, in the order in which they were traced.
    pub fn children(&self) -> Vec<Vec<usize>> {
        children(&self.rays)
    }

    /// Calls the objects by other names.
    pub(super) fn rename(&mut self, name: impl Fn(u32) -> u32) {
        for ray in &mut self.rays {
            let RayEnd::Surface(shading) = &mut ray.end else {
                continue;
            };
            shading.hit.object = name(shading.hit.object);
            let crossed = shading.lights.iter_mut().flat_map(|term| &mut term.crossed);
            for crossing in crossed {
                crossing.object = name(crossing.object);
            }
            for term in &mut shading.emitters {
                term.object = term.object.map(&name);
            }
        }
        for finding in &mut self.verdicts {
            finding.verdict.rename(&name);
        }
    }
}

/// For each ray, those that start at its end, in order.
pub(super) fn children(rays: &[TracedRay]) -> Vec<Vec<usize>> {
    let mut children = vec![Vec::new(); rays.len()];
    for (number, ray) in rays.iter().enumerate() {
        if let Some(parent) = ray.parent {
            children[parent].push(number);
        }
    }
    children
}

impl TracedRay {
    /// A ray that is not traced yet, of no weight.
    pub(super) fn new(ray: &Ray, kind: RayKind, parent: Option<usize>) -> Self {
        Self {
            parent,
            kind,
            bounce: 0,
            weight: Rgb::ZERO,
            origin: ray.origin,
            direction: ray.direction,
            reach: f64::INFINITY,
            absorption: Rgb::ZERO,
            chosen: None,
            end: RayEnd::OverBudget,
            contribution: Rgb::ZERO,
        }
    }

    /// The surface it hit, if it hit one.
    pub fn shading(&self) -> Option<&Shading> {
        match &self.end {
            RayEnd::Surface(shading) => Some(shading),
            RayEnd::Missed { .. } | RayEnd::Light(_) | RayEnd::OverBudget => None,
        }
    }
}
