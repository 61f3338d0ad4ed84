//! Render settings that darken a picture most of which is above 1.

use super::outlook::setting;
use super::rendering::RenderKey;
use crate::scene::{EXPOSURES, Emitter, FalloffRule, Rendering, Rgb, Scene};
use crate::text::concise;

/// How many stops a picture may miss white by with a falloff, to be suggested.
const NEAR: f64 = 2.5;

/// The render settings, with their values, that bring the 99th percentile of a picture to about 1, the
/// most likely first: `falloff square` where the lights of the scene, if that is at hand, are bright enough
/// for it, a `depth` by which it was seen to be about 1, and an exposure. The picture was traced with
/// `asked`, and its 99th percentile is `over` stops above 1.
pub fn darkening(
    scene: Option<&Scene>,
    asked: &Rendering,
    over: f64,
    depth: Option<u32>,
) -> Vec<(RenderKey, String)> {
    let own = asked.exposure.unwrap_or_default();
    let stops = (2.0 * (own - over)).floor() / 2.0;
    let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
    let fades = asked.falloff != Some(FalloffRule::Square)
        && scene
            .and_then(fading)
            .is_some_and(|stops| (over + stops).abs() < NEAR);
    let falloff = fades.then(|| setting("falloff", FalloffRule::Square.name()));
    let exposure = setting("exposure", &concise(stops));
    let depth = depth.map(|depth| setting("depth", &depth.to_string()));
    let cures = [falloff.flatten(), depth.flatten(), exposure];
    cures.into_iter().flatten().collect()
}

/// By about how many stops the middle of a scene darkens if its point lights fade by the square of the
/// distance; `None` without any that do not fade yet.
fn fading(scene: &Scene) -> Option<f64> {
    let bounds = scene.bounds();
    let middle = (!bounds.is_empty()).then(|| bounds.centre())?;
    let steady = scene
        .lights
        .iter()
        .filter_map(|light| match &light.emitter {
            Emitter::Point {
                position, falloff, ..
            } if falloff.radial[1..] == [0.0; 2] && light.colour != Rgb::ZERO => {
                Some(position.distance(middle))
            }
            _ => None,
        });
    let distance = steady.reduce(f64::min)?;
    Some(-2.0 * libm::log2(distance))
}
