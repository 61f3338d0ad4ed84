//! Why a pixel is dark, bright or odd: a closed list.

use glam::DVec3;

use super::ray_kind::RayKind;
use scene::{FalloffRule, Rgb};

/// A verdict with the ray at whose end it was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// What was found.
    pub verdict: Verdict,
    /// Index of the ray in [`Explanation::rays`](super::Explanation::rays); 0 is the camera ray, others
    /// are seen in mirrors, through glass or by scattered light.
    pub ray: usize,
}

/// Why a pixel is dark, bright or odd, or what it mainly shows.
///
/// Objects are called as frames call them, lights and textures by their index in the scene.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The scene has no object.
    NoObjects,
    /// The ray hits nothing.
    Missed {
        /// The background, or the environment for other than camera rays.
        radiance: Rgb,
        /// The object that is hit in the opposite direction, behind the camera.
        behind: Option<u32>,
    },
    /// An object would be hit, but it is nearer than near or beyond far.
    Clipped {
        /// The object.
        object: u32,
        /// Its distance along the view.
        depth: f64,
        /// The limit that it exceeds.
        limit: DepthLimit,
        /// The value of the limit.
        at: f64,
    },
    /// The ray starts inside an opaque object: for ray 0, the camera is in it.
    Inside {
        /// The object.
        object: u32,
    },
    /// A texture has no image and shows magenta.
    MissingTexture {
        /// The texture.
        texture: u32,
        /// The object that uses it; `None` for the background or environment.
        object: Option<u32>,
    },
    /// The radiance is infinite or undefined.
    NotFinite,
    /// The displayed colour exceeds 1 and is clipped at 255.
    TooBright {
        /// The linear colour after exposure.
        exposed: Rgb,
    },
    /// The exposure darkens what would be seen without it.
    Underexposed {
        /// The exposure in stops, below 0.
        stops: f64,
        /// The linear colour before exposure.
        radiance: Rgb,
    },
    /// The material reflects, transmits and emits nothing.
    Black {
        /// The object.
        object: u32,
        /// Index of the material.
        material: u32,
    },
    /// A ray from a mirror or a boundary would exceed the maximum number of bounces.
    Depth {
        /// The object that asks for it.
        object: u32,
        /// The maximum number of bounces.
        depth: u32,
    },
    /// The budget of rays was spent.
    Budget {
        /// The number of rays that were not traced.
        untraced: usize,
    },
    /// Total internal reflection: no light passes the boundary of a transparent object.
    TotalReflection {
        /// The object.
        object: u32,
    },
    /// No light can light anything with this integrator.
    NoLights {
        /// Lights, emission or an environment that only the other integrator uses.
        others: bool,
    },
    /// The colour of lights is zero.
    SwitchedOff {
        /// The lights.
        lights: Vec<u32>,
        /// Whether that is true of all lights of the scene.
        all: bool,
    },
    /// A light is inside a closed object, which lets none of it out.
    Enclosed {
        /// The light.
        light: u32,
        /// The object.
        object: u32,
    },
    /// The surface is in shadow.
    Shadow {
        /// The light.
        light: u32,
        /// What blocks it or lets less than half of it pass, nearest to the surface first.
        blockers: Vec<u32>,
        /// The fraction that passes.
        transmittance: f64,
        /// The object in shadow.
        object: u32,
    },
    /// The surface is outside a spot light's cone, or near its edge.
    OutsideCone {
        /// The light.
        light: u32,
        /// The angle from the light's direction, in degrees.
        angle: f64,
        /// The factor of the cone.
        spot: f64,
    },
    /// The surface faces away from lights, or they graze it.
    FacesAway {
        /// The lights.
        lights: Vec<u32>,
        /// Whether that is true of all lights that are switched on.
        all: bool,
        /// N·L if a light still grazes the surface, else 0.
        cosine: f64,
        /// The object.
        object: u32,
    },
    /// The facet of a mesh faces away from a light that its smooth normal faces, so that the mesh itself
    /// blocks it.
    Facet {
        /// The light.
        light: u32,
        /// The object.
        object: u32,
    },
    /// A light is at the point itself, or has a size and the point is inside it.
    AtTheLight {
        /// The light.
        light: u32,
        /// The object.
        object: u32,
    },
    /// Attenuation leaves too little of a light.
    Attenuated {
        /// The light.
        light: u32,
        /// Its distance.
        distance: f64,
        /// The factor of attenuation.
        radial: f64,
        /// The rule that makes it fade, if it does not fade by itself.
        rule: FalloffRule,
    },
    /// The colour of a light is too dark to be seen.
    Dim {
        /// The light.
        light: u32,
        /// Its colour.
        colour: Rgb,
    },
    /// The material reflects too little of a light.
    NotReflected {
        /// The light.
        light: u32,
        /// The object.
        object: u32,
    },
    /// The surface does not show lights on this side, as the inside of glass.
    UnlitSide {
        /// The object.
        object: u32,
    },
    /// The surface reflects no ambient light.
    NoAmbient {
        /// The object.
        object: u32,
        /// Whether there is no ambient light at all, rather than none that the material reflects.
        none: bool,
    },
    /// Nothing is wrong: what the pixel mainly shows.
    Ordinary(Term),
}

/// A limit of the visible distances.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DepthLimit {
    /// The near limit.
    Near,
    /// The far limit.
    Far,
}

/// A part of a pixel's colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Term {
    /// Where it comes from.
    pub source: TermSource,
    /// What it adds to the sample.
    pub contribution: Rgb,
}

/// Where a part of a pixel's colour comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TermSource {
    /// The background or environment.
    Surroundings,
    /// Light of a light that an object reflects.
    Light {
        /// The light.
        light: u32,
        /// The object.
        object: u32,
    },
    /// Light that one object, or the environment, emits and another reflects.
    Emitter {
        /// The object that emits it; `None` for the environment.
        emitter: Option<u32>,
        /// The object that reflects it.
        object: u32,
    },
    /// Light that photons carried via mirrors and boundaries, and that an object reflects.
    Caustics {
        /// The object.
        object: u32,
    },
    /// Ambient light that an object reflects.
    Ambient {
        /// The object.
        object: u32,
    },
    /// What an object emits.
    Emission {
        /// The object.
        object: u32,
    },
    /// A light with a size, seen itself.
    LightItself {
        /// The light.
        light: u32,
    },
    /// What a ray from an object brings: reflected, refracted or scattered.
    Ray {
        /// What the ray is.
        kind: RayKind,
        /// The object that it starts from.
        object: u32,
        /// The object that it hits.
        seen: Option<u32>,
    },
}

impl Verdict {
    /// Calls the objects by other names.
    pub(super) fn rename(&mut self, name: &impl Fn(u32) -> u32) {
        let rename = |object: &mut u32| *object = name(*object);
        match self {
            Self::Missed { behind, .. } => behind.iter_mut().for_each(rename),
            Self::MissingTexture { object, .. } => object.iter_mut().for_each(rename),
            Self::Shadow {
                blockers, object, ..
            } => blockers.iter_mut().chain([object]).for_each(rename),
            Self::Clipped { object, .. }
            | Self::Inside { object }
            | Self::Black { object, .. }
            | Self::Depth { object, .. }
            | Self::TotalReflection { object }
            | Self::Enclosed { object, .. }
            | Self::FacesAway { object, .. }
            | Self::Facet { object, .. }
            | Self::AtTheLight { object, .. }
            | Self::NotReflected { object, .. }
            | Self::UnlitSide { object }
            | Self::NoAmbient { object, .. } => rename(object),
            Self::Ordinary(term) => term.source.rename(rename),
            Self::NoObjects
            | Self::NotFinite
            | Self::TooBright { .. }
            | Self::Underexposed { .. }
            | Self::Budget { .. }
            | Self::NoLights { .. }
            | Self::SwitchedOff { .. }
            | Self::OutsideCone { .. }
            | Self::Attenuated { .. }
            | Self::Dim { .. } => {}
        }
    }
}

impl TermSource {
    fn rename(&mut self, mut rename: impl FnMut(&mut u32)) {
        match self {
            Self::Light { object, .. }
            | Self::Caustics { object }
            | Self::Ambient { object }
            | Self::Emission { object } => {
                rename(object);
            }
            Self::Emitter { emitter, object } => {
                emitter.iter_mut().for_each(&mut rename);
                rename(object);
            }
            Self::Ray { object, seen, .. } => {
                rename(object);
                seen.iter_mut().for_each(rename);
            }
            Self::Surroundings | Self::LightItself { .. } => {}
        }
    }
}

/// The angle in degrees between a light's direction and the direction to a point, given the unit
/// vectors along and from the point to the light.
pub(super) fn angle(direction: DVec3, toward: DVec3) -> f64 {
    libm::acos((-direction.dot(toward)).clamp(-1.0, 1.0)).to_degrees()
}
