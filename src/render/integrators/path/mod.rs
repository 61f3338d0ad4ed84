//! Path tracing (Kajiya, "The Rendering Equation", 1986): an unbiased estimate of radiance over up
//! to `depth` bounces, without ambient light. Next event estimation samples all lights at each bounce,
//! or one of them where there are many; for a light with a size it is combined with BSDF sampling by
//! multiple importance sampling (Veach and Guibas, "Optimally Combining Sampling Techniques for Monte
//! Carlo Rendering", 1995).

mod emission;
mod emitter_samples;
mod light_samples;
mod reference;
mod shadow_rays;
mod vertices;
mod wave;

pub(crate) use emission::emission;
pub(crate) use emitter_samples::{
    EmitterArrival, add_emitting_objects, add_sky, aim_at_object, aim_at_sky, samples_emitters,
};
pub(crate) use light_samples::{add_light, add_one_of_many, choose_light};
#[cfg(test)]
pub(crate) use reference::radiance_alone;
pub(crate) use vertices::{Aimed, Vertices};
pub(crate) use wave::{PathWave, add_caustics, by_paths, shade_and_continue, trace_rays};

use super::light_component::LightComponent;
use super::probe::{BounceStage, Probe, RAY_BUDGET, Sample};
use crate::light::SphereLight;
use crate::material::{Bsdf, BsdfSample, Scattered, Scattering, transmitted};
use crate::sampling::power_heuristic;
use crate::world::{Nearest, World};
use geometry::Ray;
use scene::Rgb;

/// Paths with a throughput below this are subject to Russian roulette. Squared error × time with
/// 1/4, relative to 1/16, is .78 in a room lit by a panel, .82 in `lamp.xml`, .96 in `neon.xml`, .95 in
/// `still-life.dat`. 1/3 gains up to .05 more in closed rooms and loses in open scenes; with equal
/// numbers of samples it adds twice as much noise.
const FAINT: f64 = 1.0 / 4.0;

/// The same where no light is sampled at random, so that roulette would add most of the noise:
/// `mirrors.ray` takes 1.10 with 1/32 and 1.26 with 1/4, `glass.ray` 1.08 and 1.10.
const FAINT_BY_POINT_LIGHTS: f64 = 1.0 / 16.0;

/// The state of a path.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Path {
    pub(crate) ray: Ray,
    /// Weight of the incoming radiance in the pixel.
    pub(crate) throughput: Rgb,
    /// Absorption per unit of length up to the next hit.
    pub(crate) absorption: Rgb,
    /// The last scattering; `None` after mirrors and boundaries.
    pub(crate) chosen: Option<Scattering>,
    /// Whether it was ever scattered other than by mirrors and boundaries.
    pub(crate) was_scattered: bool,
    pub(crate) bounce: u32,
}

/// What the ray of a path leads to.
#[derive(Clone, Copy, Debug)]
pub(crate) enum PathHit {
    /// Nothing but the background or environment, with this radiance.
    Nothing(Rgb),
    /// A light with a size.
    Light {
        /// Its index.
        number: u32,
        light: SphereLight,
        distance: f64,
        radiance: Rgb,
        /// The multiple importance sampling weight.
        weight: f64,
    },
    /// A surface.
    Surface(Nearest),
}

/// Whether a path goes on from a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Continuation {
    /// It does, having survived Russian roulette with this probability.
    Goes {
        survival: f64,
    },
    /// No direction leads on.
    Nowhere,
    /// It would exceed the maximum number of bounces.
    Depth,
    /// The budget of rays is spent.
    Budget,
    /// The throughput overflowed, because materials reflect more than they receive.
    Overflow,
    /// It did not survive Russian roulette, with this probability.
    Roulette {
        survival: f64,
    },
    Cancelled,
}

/// Finds what a path's ray leads to, given the nearest object that it hits, and reduces the
/// throughput by absorption up to there.
pub(crate) fn classify_hit(
    probe: &Probe<'_>,
    path: &mut Path,
    sample: &Sample,
    nearest: Option<Nearest>,
) -> PathHit {
    let world = probe.world;
    let distance = nearest.map_or_else(|| path.reach(sample), |nearest| nearest.hit.t);
    if let Some((number, light, distance)) = world.sphere_lights.nearest(&path.ray, distance) {
        path.throughput *= transmitted(path.absorption, distance);
        return PathHit::Light {
            radiance: light.scale * light.radiance(),
            weight: if probe.photon_map.is_some() && path.is_caustic() {
                // Photons carry it.
                0.0
            } else {
                path.weight_of_chance(world, (number, &light))
            },
            number,
            light,
            distance,
        };
    }
    let Some(nearest) = nearest else {
        return PathHit::Nothing(world.around(&path.ray, path.bounce, sample.screen));
    };
    path.throughput *= transmitted(path.absorption, nearest.hit.t);
    PathHit::Surface(nearest)
}

/// Continues a path in a sampled direction, if there is one, the depth and the budget allow it
/// and it survives Russian roulette by its numbers for the bounce.
fn continue_path(
    probe: &mut Probe<'_>,
    path: &mut Path,
    next: Option<BsdfSample>,
    [.., chance]: [f64; 4],
) -> Continuation {
    let Some(next) = next else {
        return Continuation::Nowhere;
    };
    if probe.depth <= path.bounce {
        return Continuation::Depth;
    }
    if path.bounce + 1 == RAY_BUDGET {
        probe.counts.over_budget += 1;
        return Continuation::Budget;
    }
    if path.bounce % 64 == 63 && (probe.cancelled)() {
        return Continuation::Cancelled;
    }
    let faint = if probe.world.samples_lights {
        FAINT
    } else {
        FAINT_BY_POINT_LIGHTS
    };
    path.advance(next, faint, chance)
}

/// Whether the light with this index, which has a size and which a path hits, is part of the light
/// gathered. Where it could have been sampled from the first surface, it is that surface's direct
/// light.
fn gathers(component: LightComponent, number: u32, path: &Path) -> bool {
    let from_first = path.bounce == 1 && path.chosen.is_some();
    match component {
        LightComponent::Direct(wanted) => from_first && wanted == number,
        LightComponent::Indirect if from_first => false,
        component => component.glow(path.bounce),
    }
}

/// The density with which a path at a bounce goes on in a direction, per steradian; 0 at the last
/// bounce, after which no BSDF sample can hit a light.
pub(crate) fn density_of(
    probe: &Probe<'_>,
    bsdf: &Bsdf<'_>,
    scattered: Scattered,
    bounce: u32,
) -> f64 {
    match probe.stage(bounce) {
        BounceStage::Inner => bsdf.lobes_chance * scattered.density,
        BounceStage::Last => 0.0,
    }
}

impl Path {
    /// Starts a path along a camera ray.
    pub(crate) fn new(sample: &Sample) -> Self {
        Self {
            ray: sample.ray,
            throughput: Rgb::ONE,
            absorption: Rgb::ZERO,
            chosen: None,
            was_scattered: false,
            bounce: 0,
        }
    }

    /// The length up to which its ray is followed.
    pub(crate) fn reach(&self, sample: &Sample) -> f64 {
        if self.bounce == 0 {
            sample.reach
        } else {
            f64::INFINITY
        }
    }

    /// What arrives in the pixel if it meets nothing, given the radiance there.
    pub(crate) fn of_nothing(&self, world: &World, radiance: Rgb) -> Rgb {
        let densities = self.densities_of(&world.sky);
        let weight = densities.map_or(1.0, |densities| densities.weight);
        self.throughput * radiance * weight
    }

    /// Whether it goes on from a mirror or boundary after it was scattered otherwise.
    fn is_caustic(&self) -> bool {
        self.was_scattered && self.chosen.is_none()
    }

    /// The multiple importance sampling weight of a light hit by a BSDF sample.
    fn weight_of_chance(&self, world: &World, (number, light): (u32, &SphereLight)) -> f64 {
        self.chosen.map_or(1.0, |chosen| {
            let by_light = chosen.density_of(world, (number, light));
            power_heuristic(chosen.density, by_light)
        })
    }

    /// Continues a path; if its throughput is below `faint`, `chance`, a number in 0..1, decides by
    /// Russian roulette (Arvo and Kirk, "Particle Transport and Image Synthesis", 1990).
    fn advance(&mut self, next: BsdfSample, faint: f64, chance: f64) -> Continuation {
        self.throughput *= next.weight;
        if !self.throughput.is_finite() {
            return Continuation::Overflow;
        }
        let survival = self.throughput.abs().max_element() / faint;
        if survival < 1.0 {
            if survival <= chance {
                return Continuation::Roulette { survival };
            }
            self.throughput /= survival;
        }
        self.ray = next.ray;
        self.absorption = next.absorption;
        self.chosen = next.chosen;
        self.was_scattered |= next.chosen.is_some();
        self.bounce += 1;
        Continuation::Goes {
            survival: survival.min(1.0),
        }
    }
}

impl Scattering {
    /// The density by which the light with this index, which has a size, would have been sampled in the
    /// direction of its sphere, per steradian.
    pub(crate) fn density_of(&self, world: &World, (number, light): (u32, &SphereLight)) -> f64 {
        let density = light.density(self.point);
        if world.many_lights.is_empty() {
            density
        } else {
            let at = (self.point, self.normal);
            world.many_lights.chance(number, at) * density
        }
    }
}
