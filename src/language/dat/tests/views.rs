//! Views: defaults for missing records, and unusable views.

use glam::DVec3;

use super::{read, spelled};
use crate::tests::shown;
use scene::{Camera, Focus, Lens, Size};

/// A unit sphere at the origin: its box is ±1, centred at 0, with a half diagonal of √3.
pub(super) const BODY: &str = "mat ID 0 MAT\nobj sphere ID 0 BALL 1\n";

/// The camera of [`BODY`] after some lines, and the diagnostics.
fn seen(lines: &str) -> (Option<Camera>, Vec<String>) {
    let text = spelled(&format!("{lines}{BODY}"));
    let (_, lowered) = read(&text);
    let said = shown(&text, &lowered);
    (lowered.scene.map(|scene| scene.camera), said)
}

pub(super) const MISSING: [&str; 3] = ["camera", "resolution", "viewport"];

/// Checks that exactly these records are reported as missing.
fn check_missing(said: &[String], words: &[&str]) {
    let expected: Vec<_> = words
        .iter()
        .map(|word| format!("1:1 warning: no `{word}` record"))
        .collect();
    assert_eq!(said, expected);
}

#[test]
fn the_default_view_frames_the_scene() {
    let (camera, said) = seen("");
    check_missing(&said, &MISSING);
    let camera = camera.expect("no errors");
    // √3 / sin 22.5°, and (0.4, −1, 0.3) has length √1.25.
    let distance = 3.0_f64.sqrt() / 0.382_683_432_365_089_8;
    let eye = distance / 1.25_f64.sqrt() * DVec3::new(0.4, -1.0, 0.3);
    assert!(camera.eye.distance(eye) < 1e-14 * distance, "{camera:?}");
    let size = Size {
        width: 800,
        height: 600,
    };
    let expected = Camera {
        eye: camera.eye,
        target: DVec3::ZERO,
        up: DVec3::Z,
        lens: Lens::Perspective(45.0),
        pixel_aspect: 1.0,
        depths: Camera::ALL_DEPTHS,
        focus: Focus::PINHOLE,
        size,
    };
    assert_eq!(camera, expected);
}

#[test]
fn a_missing_camera_keeps_resolution_and_viewport() {
    let (camera, said) = seen("resolution 0.02 0.01\nviewport 64 48\n");
    check_missing(&said, &MISSING[..1]);
    let camera = camera.expect("no errors");
    assert_eq!((camera.size.width, camera.size.height), (64, 48));
    assert_eq!(camera.pixel_aspect, 2.0);
    assert_eq!(camera.lens, Lens::Perspective(45.0));
}

#[test]
fn a_missing_resolution_gives_45_degrees_or_frames_the_scene() {
    let (camera, said) = seen("camera perspective 0 0 5 0 0 0 0 1 0 3 0 100\nviewport 64 48\n");
    check_missing(&said, &MISSING[1..2]);
    let camera = camera.expect("no errors");
    let Lens::Perspective(angle) = camera.lens else {
        panic!("{camera:?}");
    };
    assert!((angle - 45.0).abs() < 1e-13 && camera.pixel_aspect == 1.0);

    let (camera, _) = seen("camera orthographic 0 0 5 0 0 0 0 1 0 3 0 100\nviewport 64 48\n");
    let Some(Camera {
        lens: Lens::Orthographic(height),
        ..
    }) = camera
    else {
        panic!("{camera:?}");
    };
    assert!((height - 2.0 * 3.0_f64.sqrt()).abs() < 1e-14, "{height}");
}

#[test]
fn a_missing_viewport_is_800_by_600() {
    let (camera, said) =
        seen("camera orthographic 0 0 5 0 0 0 0 1 0 3 0 100\nresolution 0.5 0.25\n");
    check_missing(&said, &MISSING[2..]);
    let camera = camera.expect("no errors");
    assert_eq!((camera.size.width, camera.size.height), (800, 600));
    assert_eq!(camera.lens, Lens::Orthographic(150.0));
}

#[test]
fn unusable_views_are_reported_at_their_records() {
    for (view, expected) in [
        (
            "camera perspective 1 2 3  1 2 3  0 1 0  1 0 9\n",
            "1:20 error: view target: coincides with the eye",
        ),
        (
            "camera perspective 0 0 5  0 0 0  0 0 -3  1 0 9\n",
            "1:34 warning: view up: is parallel to the direction of view",
        ),
        (
            "camera perspective 0 0 5  0 0 0  0 0 0  1 0 9\n",
            "1:34 warning: view up: is parallel to the direction of view",
        ),
        (
            "viewport 4294967296 1\n",
            "1:10 error: viewport: must be 4294967295 at most",
        ),
    ] {
        let (_, said) = seen(view);
        let said: Vec<_> = said
            .into_iter()
            .filter(|line| !line.contains("warning: no `"))
            .collect();
        assert!(
            said.len() == 1 && said[0].starts_with(expected),
            "{view}: {said:?}"
        );
    }
}
