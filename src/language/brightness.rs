//! Render settings that darken a picture most of which is above 1, or brighten a black one.

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

/// The exposure that brings the brightest channel of a black picture to about 1, with its value; `None`
/// if there is no light in it. The picture was traced with `asked`.
pub fn brightening(asked: &Rendering, brightest: f64) -> Option<(RenderKey, String)> {
    let own = asked.exposure.unwrap_or_default();
    let stops = (2.0 * (own - libm::log2(brightest))).floor() / 2.0;
    let stops = stops.clamp(*EXPOSURES.start(), *EXPOSURES.end());
    let helps = 0.0 < brightest && own < stops;
    helps
        .then(|| setting("exposure", &concise(stops)))
        .flatten()
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

    #[test]
    fn a_black_picture_is_brightened_until_its_brightest_channel_is_about_1() {
        for (own, brightest, expected) in [
            (None, 1e-3, Some("9.5")),
            (Some(-12.0), 0.000_976_562_5, Some("-2")),
            (None, f64::from(f32::MIN_POSITIVE), Some("100")),
            (Some(100.0), 1e-3, None),
            (None, 0.0, None),
        ] {
            let asked = Rendering {
                exposure: own,
                ..Rendering::default()
            };
            let cure = brightening(&asked, brightest);
            let value = cure
                .as_ref()
                .map(|(key, value)| (key.name(), value.as_str()));
            assert_eq!(
                value,
                expected.map(|value| ("exposure", value)),
                "{brightest}"
            );
        }
    }
}
