//! Render settings that darken a picture most of which is above 1.

use super::outlook::setting;
use super::rendering::RenderKey;
use crate::scene::{EXPOSURES, FalloffRule, Rendering};
use crate::text::concise;

/// A falloff is suggested if it brings the 99th percentile within this many stops of 1.
const NEAR: f64 = 2.5;

/// It is suggested last if it leaves more than this many stops above 1.
const ROUGHLY: f64 = 1.0;

/// The render settings, with their values, that bring the 99th percentile of a picture to about 1, the
/// most likely first: `falloff square` if a trial with it left the 99th percentile near 1, `falloff` stops
/// above; a `depth` at which a trial was about 1; and an exposure. A falloff that still leaves the picture
/// too bright comes last. The picture was traced with `asked`, and its 99th percentile is `over` stops
/// above 1.
pub fn darkening(
    asked: &Rendering,
    over: f64,
    falloff: Option<f64>,
    depth: Option<u32>,
) -> Vec<(RenderKey, String)> {
    let own = asked.exposure.unwrap_or_default();
    let stops = (2.0 * (own - over)).floor() / 2.0;
    let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
    // It brightens whatever is within a distance of 1 of a light, and hardly darkens what is just beyond.
    let left = falloff.filter(|left| left.abs() < NEAR && *left <= 0.5 * over);
    let falloff = left.and_then(|_| setting("falloff", FalloffRule::Square.name()));
    let exposure = setting("exposure", &concise(stops));
    let depth = depth.map(|depth| setting("depth", &depth.to_string()));
    let mut cures = [falloff, depth.flatten(), exposure];
    if left.is_some_and(|left| ROUGHLY < left) {
        cures.rotate_left(1);
    }
    cures.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_falloff_that_leaves_too_much_light_comes_last() {
        for (over, falloff, expected) in [
            (4.0, Some(0.5), "falloff square, depth 2, exposure -4"),
            (4.0, Some(-2.4), "falloff square, depth 2, exposure -4"),
            (5.5, Some(1.5), "depth 2, exposure -5.5, falloff square"),
            (3.0, Some(-2.5), "depth 2, exposure -3"),
            (6.5, Some(2.5), "depth 2, exposure -6.5"),
            (1.5, Some(1.0), "depth 2, exposure -1.5"),
            (1.5, None, "depth 2, exposure -1.5"),
        ] {
            let cures = darkening(&Rendering::default(), over, falloff, Some(2));
            let cures = cures.iter();
            let cures: Vec<_> = cures
                .map(|(key, value)| format!("{} {value}", key.name()))
                .collect();
            assert_eq!(cures.join(", "), expected, "{over} {falloff:?}");
        }
    }
}
