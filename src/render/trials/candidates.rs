//! The settings that may mend a picture.

use super::fault::Fault;
use crate::render::frame::Settings;
use crate::render::lights::faded;
use crate::scene::{FalloffRule, Integrator, Material, Rendering, Rgb, Scene};

/// How much less than it receives a surface that sends all of it back may send back by rounding.
const ROUNDING: f64 = 1e-6;

/// The settings to try, the last one first: whatever may mend one fault or another.
pub(super) fn candidates(scene: &Scene, settings: &Settings) -> Vec<Rendering> {
    let traces_paths = settings.integrator.traces_paths();
    let mut left: Vec<Rendering> = Vec::new();
    if traces_paths {
        let depths = depths(scene).take_while(|depth| *depth < settings.depth);
        left.extend(depths.map(|depth| Rendering {
            depth: Some(depth),
            ..Rendering::default()
        }));
        left.reverse();
    }
    let other = match settings.integrator {
        Integrator::Whitted => is_lit_by_paths(scene).then_some(Integrator::Path),
        Integrator::Path | Integrator::Photon => {
            (scene.ambient_light() != Rgb::ZERO).then_some(Integrator::Whitted)
        }
    };
    left.extend(other.map(|integrator| Rendering {
        integrator: Some(integrator),
        ..Rendering::default()
    }));
    let fades = faded(&scene.lights, FalloffRule::Square).is_some();
    let rule = match settings.falloff {
        FalloffRule::None => FalloffRule::Square,
        FalloffRule::Square => FalloffRule::None,
    };
    left.extend(fades.then(|| Rendering {
        falloff: Some(rule),
        ..Rendering::default()
    }));
    left
}

/// Whether a candidate may mend what is wrong.
pub(super) fn may_mend(change: &Rendering, fault: Option<Fault>) -> bool {
    let fades = change.falloff == Some(FalloffRule::Square);
    match fault {
        Some(Fault::Black(_)) => change.integrator.is_some() || change.falloff.is_some() && !fades,
        Some(Fault::Burnt) => change.depth.is_some() || fades,
        Some(Fault::Unlit) => change.integrator.is_some(),
        Some(Fault::WithoutPhotons | Fault::FewerPhotons) | None => fades,
    }
}

/// The depths that may help, the smallest first: where surfaces send back all that they receive, or more.
/// What comes from all around them may be too much after a single bounce.
fn depths(scene: &Scene) -> impl Iterator<Item = u32> {
    let albedo = scene.materials.iter().map(Material::sent_on);
    let albedo = albedo.map(Rgb::max_element).fold(0.0, f64::max);
    let is_around = scene.setting.environment.colour != Rgb::ZERO;
    let first = (1.0 - ROUNDING <= albedo).then_some(if is_around { 1 } else { 2 });
    std::iter::successors(first, |depth: &u32| depth.checked_mul(2))
}

/// Whether there is light that only paths carry to other surfaces.
fn is_lit_by_paths(scene: &Scene) -> bool {
    scene.setting.environment.colour != Rgb::ZERO || glows(scene)
}

/// Whether a material glows.
pub(super) fn glows(scene: &Scene) -> bool {
    let glows = |material: &Material| material.emission != Rgb::ZERO;
    scene.materials.iter().any(glows)
}

/// These settings with a candidate.
pub(super) fn changed(settings: Settings, change: &Rendering) -> Settings {
    let integrator = change.integrator.unwrap_or(settings.integrator);
    // Another depth than the default was asked for, by whichever integrator.
    let own = if settings.depth == settings.integrator.default_depth() {
        integrator.default_depth()
    } else {
        settings.depth
    };
    Settings {
        integrator,
        depth: change.depth.unwrap_or(own),
        falloff: change.falloff.unwrap_or(settings.falloff),
        ..settings
    }
}
