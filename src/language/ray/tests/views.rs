//! View comments: their meaning, their errors, and edits of the camera.

use glam::DVec3;

use super::{read, scene, shown, spelled};
use scene::{Camera, Lens, Size};
use text::apply;

/// A unit sphere at the origin: its box is ±1, centred at 0, with a half diagonal of √3.
const BODY: &str = "HEAD 1 sphere 0 0 0 1 MAT";

/// The camera of [`BODY`] after a first line, and the diagnostics.
fn seen(line: &str) -> (Option<Camera>, Vec<String>) {
    let text = spelled(&format!("{line}\n{BODY}"));
    let (_, lowered) = read(&text);
    let said = shown(&text, &lowered);
    (lowered.scene.map(|scene| scene.camera), said)
}

fn default_camera() -> Camera {
    let (camera, said) = seen("");
    assert_eq!(said, [""; 0]);
    camera.expect("no errors")
}

#[test]
fn the_default_view_frames_the_scene() {
    let camera = default_camera();
    // √3 / sin 22.5° = 4.526066876…, and (0.4, 0.3, 1) has length √1.25 = 1.118033988…
    let distance = 3.0_f64.sqrt() / 0.382_683_432_365_089_8;
    let eye = distance / 1.25_f64.sqrt() * DVec3::new(0.4, 0.3, 1.0);
    assert!(
        camera.eye.distance(eye) < 1e-14 * distance,
        "{}",
        camera.eye
    );
    assert_eq!(
        (camera.target, camera.up, camera.lens),
        (DVec3::ZERO, DVec3::Y, Lens::Perspective(45.0))
    );
    assert_eq!((camera.size.width, camera.size.height), (800, 600));
}

#[test]
fn a_trailing_f_is_ignored_in_the_effective_comment() {
    let (camera, said) = seen("// view: fov 40f");
    assert_eq!(
        camera.map(|camera| camera.lens),
        Some(Lens::Perspective(40.0))
    );
    let ignored = "1:14 warning: view fov: the `f` at the end of `40f` is ignored";
    assert_eq!(said, [ignored]);
    let (_, said) = seen("// view: fov 40f up 0 1");
    assert_eq!(
        said,
        ["1:24 warning: view up z: missing; the whole comment is ignored"]
    );
    let (_, said) = seen("// view: size 8f 6");
    let ignored =
        "1:15 warning: view size width: `8f` is not a number; the whole comment is ignored";
    assert_eq!(said, [ignored]);
}

#[test]
fn scenes_of_any_size_have_a_default_view() {
    for radius in [1e-150, 5e-120, 1e120, 9.9e149] {
        let camera = scene(&spelled(&format!("HEAD 1 sphere 0 0 0 {radius:e} MAT"))).camera;
        let expected = default_camera().eye;
        let error = (camera.eye / radius).distance(expected);
        assert!(error < 1e-14 * expected.length(), "{radius:e}: {error}");
    }
}

#[test]
fn the_default_view_aims_at_the_centre_of_the_tight_box() {
    // A box rotated by 45° about z: its diagonals lie along x and y, from −√½ to √½ and 0 to √2.
    let half = 0.5_f64.sqrt();
    let text = format!("HEAD 1 box 0 0 5 {half} {half} 0 -{half} {half} 0 0 0 1 1 1 2 MAT");
    let target = scene(&spelled(&text)).camera.target;
    let expected = DVec3::new(0.0, half, 6.0);
    assert!(target.distance(expected) < 1e-15, "{target}");
}

#[test]
fn a_view_has_any_parts_in_any_order() {
    let default = default_camera();
    let eye = DVec3::new(1.0, 2.0, 3.0);
    let size = |width, height| Size { width, height };
    for (line, camera) in [
        ("// view: eye 1 2 3", Camera { eye, ..default }),
        ("//view:eye 1 2 3", Camera { eye, ..default }),
        (
            "// \u{A0}\tview:\u{A0}eye\u{A0}1 2 3",
            Camera { eye, ..default },
        ),
        (
            "// view: target 1 2 3",
            Camera {
                target: eye,
                ..default
            },
        ),
        (
            "// view: up 0 0 5",
            Camera {
                up: 5.0 * DVec3::Z,
                ..default
            },
        ),
        (
            "// view: size 64 48",
            Camera {
                size: size(64, 48),
                ..default
            },
        ),
        (
            "// view: size 4294967295 1 eye 1 2 3 up 1 0 0",
            Camera {
                eye,
                up: DVec3::X,
                size: size(u32::MAX, 1),
                ..default
            },
        ),
        (
            "// view: fov 30 target 0 0 1 eye 1 2 3",
            Camera {
                eye,
                target: DVec3::Z,
                lens: Lens::Perspective(30.0),
                ..default
            },
        ),
        ("// view:", default),
        // None of these is a view comment.
        ("\\\\ view: eye 1 2 3", default),
        ("// a view: eye 1 2 3", default),
        ("// View: eye 1 2 3", default),
        ("// views: eye 1 2 3", default),
    ] {
        assert_eq!(seen(line), (Some(camera), vec![]), "{line}");
    }
}

#[test]
fn a_missing_eye_depends_on_the_angle_of_view() {
    let (camera, _) = seen("// view: fov 90");
    let distance = camera.expect("no errors").eye.length();
    // √3 / sin 45° = √6
    assert!((distance - 6.0_f64.sqrt()).abs() < 1e-14);
}

#[test]
fn a_malformed_view_is_ignored_entirely_with_a_warning() {
    let default = default_camera();
    for (line, warning) in [
        (
            "// view: eye 1 2 3 zoom 4",
            "1:20 warning: view: unknown word `zoom`",
        ),
        (
            "// view: from the top",
            "1:10 warning: view: unknown word `from`",
        ),
        (
            "// view: EYE 1 2 3",
            "1:10 warning: view: unknown word `EYE`",
        ),
        ("// view: 1 2 3", "1:10 warning: view: unknown word `1`"),
        ("// view: eye 1 2", "1:17 warning: view eye z: missing"),
        ("// view: eye 1 fov 30", "1:16 warning: view eye y: missing"),
        (
            "// view: eye 1 2 x",
            "1:18 warning: view eye z: `x` is not a number",
        ),
        (
            "// view: eye 1 2 1e999",
            "1:18 warning: view eye z: `1e999` is too large",
        ),
        (
            "// view: fov 30 fov 40",
            "1:17 warning: view fov: given twice",
        ),
        (
            "// view: fov 0",
            "1:14 warning: view fov: must be greater than 0 and less than 180",
        ),
        ("// view: fov 180", "1:14 warning: view fov: must be"),
        (
            "// view: fov 30 size 0 600",
            "1:22 warning: view size width: must be a whole number",
        ),
        (
            "// view: size 8 6.5",
            "1:17 warning: view size height: must be a whole number",
        ),
        (
            "// view: size 8 4294967296",
            "1:17 warning: view size height: must be 4294967295 at most",
        ),
        (
            "// view: up 0 0 0",
            "1:13 warning: view up: must not be zero",
        ),
    ] {
        let (camera, said) = seen(line);
        assert_eq!(camera, Some(default), "{line}");
        assert!(
            said.len() == 1 && said[0].starts_with(warning),
            "{line}: {said:?}"
        );
    }
}

#[test]
fn the_first_well_formed_view_counts() {
    let (camera, said) = seen("// view: fov\n1 1 1 // view: fov 30\n// view: fov 60\n//");
    assert_eq!(
        camera, None,
        "the values before the comment are read as well"
    );
    assert_eq!(
        said[..2],
        [
            "1:13 warning: view fov: missing; the whole comment is ignored",
            "3:1 warning: view: already given, this comment is ignored"
        ]
    );
    let text = spelled(&format!("{BODY} // view: fov 30\n// view: fov 60"));
    let (_, lowered) = read(&text);
    assert_eq!(
        lowered.scene.map(|scene| scene.camera.lens),
        Some(Lens::Perspective(30.0))
    );
}

#[test]
fn an_unusable_view_is_reported_at_its_parts() {
    for (line, diagnostic) in [
        (
            "// view: eye 1 2 3 target 1 2 3",
            "1:14 error: view target: coincides with the eye",
        ),
        (
            "// view: fov 9 target 1 2 3 eye 1 2 3",
            "1:23 error: view target: coincides with the eye",
        ),
        (
            "// view: fov 9 eye 0 0 0",
            "1:20 error: view target: coincides with the eye",
        ),
        (
            "// view: eye 0 5 0",
            "1:1 warning: view up: is parallel to the direction of view",
        ),
        (
            "// view: eye 0 0 5 up 0 0 -2",
            "1:23 warning: view up: is parallel to the direction of view",
        ),
        (
            "// view: eye 0 0 1e308 target 0 0 -1e308 up 0 0 1",
            "1:45 warning: view up: is",
        ),
        (
            "// view: fov 1e-310",
            "2:24 error: view: the scene is too large for a default view",
        ),
    ] {
        let (camera, said) = seen(line);
        assert_eq!(
            camera.is_none(),
            diagnostic.contains("error"),
            "{line}: {said:?}"
        );
        assert!(
            said.len() == 1 && said[0].starts_with(diagnostic),
            "{line}: {said:?}"
        );
    }
}

#[test]
fn a_view_is_checked_despite_other_errors() {
    let text = spelled("// view: eye 1 1 1 target 1 1 1\nHEAD 1 sphere 0 0 0 -1 MAT");
    let (_, lowered) = read(&text);
    assert_eq!(
        shown(&text, &lowered),
        [
            "1:14 error: view target: coincides with the eye",
            "2:39 error: object 1 (sphere) radius: must be greater than 0",
        ]
    );
}

/// The text after edits that change its camera by `change`.
fn rewritten(text: &str, change: impl FnOnce(&mut Camera)) -> String {
    let mut text = spelled(text);
    let (source, lowered) = read(&text);
    let before = lowered.scene.expect("no errors").camera;
    let mut camera = before;
    change(&mut camera);
    let edits = source.view_edits(&before, &camera);
    apply(&mut text, &edits);
    assert_eq!(scene(&text).camera, camera, "{text}");
    text
}

#[test]
fn view_edits_replace_and_add_parts() {
    let check = |line: &str, change: fn(&mut Camera), expected: &str| {
        let after = rewritten(&format!("{line}{BODY}"), change);
        assert_eq!(after, spelled(&format!("{expected}{BODY}")), "{line}");
    };
    check("", |_| (), "");
    check("// view: eye 1 2.0 3\n", |_| (), "// view: eye 1 2.0 3\n");
    check(
        "// view: eye 1 2.0 3\n",
        |c| c.eye.y = 2.5,
        "// view: eye 1 2.5 3\n",
    );
    check(
        "// view: eye 1 2.00 3  \r\n",
        |c| (c.eye.y, c.up) = (3.0, DVec3::Z),
        "// view: eye 1 3.00 3 up 0 0 1  \r\n",
    );
    check(
        "// one\n// view: size 8 6\n// \u{A0}\n",
        |c| c.size.height = 7,
        "// one\n// view: size 8 7\n// \u{A0}\n",
    );
    check(
        "// view: zoom\n",
        |c| c.target.x = 0.5,
        "// view: target 0.5 0 0\n// view: zoom\n",
    );
    check("\n", |c| c.eye = DVec3::Z * 4.0, "// view: eye 0 0 4\n\n");
    check("\r", |c| c.eye = DVec3::Z * 4.0, "// view: eye 0 0 4\r\r");
    check(
        "\r\n",
        |c| c.eye = DVec3::Z * 4.0,
        "// view: eye 0 0 4\r\n\r\n",
    );
    check(
        "\u{FEFF}",
        |c| c.up = DVec3::X,
        "\u{FEFF}// view: up 1 0 0\n",
    );
    check(
        "// view: size 8 6 fov 30.0 eye 0 0 9\n",
        |c| (c.lens, c.eye.z, c.size.width) = (Lens::Perspective(31.0), 8.0, 16),
        "// view: size 16 6 fov 31.0 eye 0 0 8\n",
    );
}

#[test]
fn a_new_angle_pins_a_missing_eye() {
    let text = rewritten(BODY, |camera| camera.lens = Lens::Perspective(30.0));
    assert!(text.starts_with("// view: eye "), "{text}");
    assert!(text.contains(" fov 30\n"), "{text}");
}
