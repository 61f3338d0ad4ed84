//! Render settings that darken a picture most of which is above 1.

use super::outlook::setting;
use super::rendering::RenderKey;
use crate::scene::{EXPOSURES, Emitter, FalloffRule, Rendering, Rgb, Scene};
use crate::text::concise;

/// How many stops a picture may miss white by with a falloff, to be suggested.
const NEAR: f64 = 2.5;

/// How many stops too bright the estimate for a falloff may be, to be suggested first.
const ROUGHLY: f64 = 1.0;

/// The render settings, with their values, that bring the 99th percentile of a picture to about 1, the
/// most likely first: `falloff square` where the lights of the scene, if that is at hand, are bright enough
/// for it, a `depth` by which it was seen to be about 1, and an exposure. A falloff that would leave the
/// picture too bright comes last. The picture was traced with `asked`, and its 99th percentile is `over`
/// stops above 1.
pub fn darkening(
    scene: Option<&Scene>,
    asked: &Rendering,
    over: f64,
    depth: Option<u32>,
) -> Vec<(RenderKey, String)> {
    let own = asked.exposure.unwrap_or_default();
    let stops = (2.0 * (own - over)).floor() / 2.0;
    let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
    let left = scene.and_then(fading).map(|stops| over + stops);
    let left = left.filter(|left| asked.falloff != Some(FalloffRule::Square) && left.abs() < NEAR);
    let falloff = left.and_then(|_| setting("falloff", FalloffRule::Square.name()));
    let exposure = setting("exposure", &concise(stops));
    let depth = depth.map(|depth| setting("depth", &depth.to_string()));
    let mut cures = [falloff, depth.flatten(), exposure];
    if left.is_some_and(|left| ROUGHLY < left) {
        cures.rotate_left(1);
    }
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
