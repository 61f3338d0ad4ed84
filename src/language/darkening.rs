//! Render settings that darken a picture most of which is above 1.

use super::outlook::setting;
use super::rendering::RenderKey;
use crate::scene::{EXPOSURES, Emitter, FalloffRule, Rendering, Rgb, Scene};
use crate::text::concise;

/// A falloff is suggested if, by the estimate, it brings the 99th percentile within this many stops of 1.
const NEAR: f64 = 2.5;

/// It is suggested last if the estimate is more than this many stops above 1.
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::*;
    use crate::language::{Language, Source};
    use crate::scene::Meshes;

    /// A ball in a light at a distance of 4, which would darken it by four stops.
    const BALL: &str = "0 0 0  1  4 0 0  1 1 1  1\n\
                        sphere 0 0 0 1  0 0 0  .5 .5 .5  0 0 0  1 0 0 1";

    #[test]
    fn a_falloff_that_leaves_too_much_light_comes_last() {
        let mut source = Source::new(Language::Ray, Arc::new(BALL.to_owned()));
        let lowered = source.lower(&Meshes::default()).expect("it fits");
        let scene = lowered.scene.expect("it has no errors");
        let cures = |over: f64| {
            let cures = darkening(Some(&scene), &Rendering::default(), over, Some(2));
            let cures = cures.iter();
            let cures: Vec<_> = cures
                .map(|(key, value)| format!("{} {value}", key.name()))
                .collect();
            cures.join(", ")
        };
        assert_eq!(cures(4.0), "falloff square, depth 2, exposure -4");
        assert_eq!(cures(5.0), "falloff square, depth 2, exposure -5");
        assert_eq!(cures(5.5), "depth 2, exposure -5.5, falloff square");
        assert_eq!(cures(6.5), "depth 2, exposure -6.5");
        assert_eq!(cures(1.5), "depth 2, exposure -1.5");
    }
}
