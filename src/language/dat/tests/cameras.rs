//! Edits of the camera.

use glam::DVec3;

use super::views::{BODY, MISSING};
use super::{read, spelled};
use crate::node::Node;
use crate::tests::Random;
use scene::{Camera, Focus, Lens, Size};
use text::{apply, parse_number, spell_like};

/// The text after edits that change its camera by `change`.
fn rewritten(text: &str, change: impl FnOnce(&mut Camera)) -> String {
    let mut text = spelled(text);
    let (source, lowered) = read(&text);
    let before = lowered.scene.expect("no errors").camera;
    let mut camera = before;
    change(&mut camera);
    let edits = source.view_edits(&before, &camera);
    apply(&mut text, &edits);
    check_alike(&text, &camera);
    text
}

/// Checks that the text describes a camera, up to rounding of its angle.
#[track_caller]
fn check_alike(text: &str, camera: &Camera) {
    let found = read(text).1.scene.expect("no errors").camera;
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-13 * b.abs();
    let lens = match (found.lens, camera.lens) {
        (Lens::Perspective(a), Lens::Perspective(b))
        | (Lens::Orthographic(a), Lens::Orthographic(b)) => near(a, b),
        _ => false,
    };
    assert!(
        lens && near(found.pixel_aspect, camera.pixel_aspect),
        "{text}\n{found:?}\n{camera:?}"
    );
    let rest = Camera {
        lens: camera.lens,
        pixel_aspect: camera.pixel_aspect,
        // Infinity is written as a large number.
        depths: camera.depths.map(|depth| depth.min(1e30)),
        ..found
    };
    let camera = Camera {
        depths: camera.depths.map(|depth| depth.min(1e30)),
        ..*camera
    };
    assert_eq!(rest, camera, "{text}");
    assert_eq!(
        found.depths.map(|depth| depth.min(1e30)),
        camera.depths,
        "{text}"
    );
}

#[test]
fn view_edits_change_the_records_of_the_view() {
    let view = |camera: &str, resolution: &str, viewport: &str| {
        format!("# é\r\ncamera {camera}\r\n\tresolution {resolution} \r\nviewport {viewport}\r\n")
    };
    let check = |view: String, change: fn(&mut Camera), expected: String| {
        let after = rewritten(&format!("{view}{BODY}"), change);
        assert_eq!(after, spelled(&format!("{expected}{BODY}")));
    };
    let eye = "perspective 0 0 5.0  0 0 0  0 1 0  1 0 100";
    let pixels = "0.01 0.01";
    let nothing: fn(&mut Camera) = |_| ();
    check(
        view(eye, pixels, "80 60"),
        nothing,
        view(eye, pixels, "80 60"),
    );
    check(
        view(eye, pixels, "80 60"),
        |c| c.eye.z = 4.0,
        view(
            "perspective 0 0 4.0  0 0 0  0 1 0  1 0 100",
            pixels,
            "80 60",
        ),
    );
    check(
        view(eye, pixels, "80 60"),
        |c| (c.target.x, c.up) = (-0.5, DVec3::Z),
        view(
            "perspective 0 0 5.0  -0.5 0 0  0 0 1  1 0 100",
            pixels,
            "80 60",
        ),
    );
    check(
        view(eye, pixels, "80 60"),
        |c| c.depths = [0.5, 200.0],
        view(
            "perspective 0 0 5.0  0 0 0  0 1 0  1 0.5 200",
            pixels,
            "80 60",
        ),
    );
    check(
        view(eye, pixels, "80 60"),
        |c| c.size.width = 90,
        view(eye, pixels, "90 60"),
    );
    let side = "orthographic 0 0 5  0 0 0  0 1 0  1 0 100";
    check(
        view(side, pixels, "80 60"),
        |c| c.lens = Lens::Orthographic(1.2),
        view(side, "0.02 0.02", "80 60"),
    );
    // An angle is expressed by the focal length: half of 60 rows of 0.01 over tan 45°.
    check(
        view(eye, pixels, "80 60"),
        |c| c.lens = Lens::Perspective(90.0),
        view(
            "perspective 0 0 5.0  0 0 0  0 1 0  0.3 0 100",
            pixels,
            "80 60",
        ),
    );
}

#[test]
fn missing_records_are_added_at_the_beginning() {
    for (before, added, change) in [
        (
            "",
            "camera ",
            (|c: &mut Camera| c.eye = DVec3::new(0.0, 0.0, 4.0)) as fn(&mut Camera),
        ),
        ("resolution 0.02 0.01\nviewport 64 48\n", "camera ", |c| {
            c.eye = DVec3::new(0.0, 0.0, 4.0);
        }),
        (
            "camera perspective 0 0 5  0 0 0  0 1 0  1 0 100\n",
            "viewport 64 600\n",
            |c| c.size.width = 64,
        ),
        (
            "camera orthographic 0 0 5  0 0 0  0 1 0  1 0 100\nviewport 64 48\n",
            "resolution 0.125 0.125\n",
            |c| c.lens = Lens::Orthographic(6.0),
        ),
    ] {
        for mark in ["", "\u{FEFF}"] {
            let text = format!("{mark}{before}{BODY}");
            let after = rewritten(&text, change);
            let start = format!("{mark}{added}");
            assert!(after.starts_with(&start), "{after}");
            assert!(
                after.ends_with(&spelled(&format!("{before}{BODY}"))),
                "{after}"
            );
        }
    }
    let crlf = rewritten(&format!("# one\r\n{BODY}"), |c| c.up = DVec3::X);
    assert!(
        crlf.starts_with("camera perspective ") && crlf.contains("\r\n# one\r\n"),
        "{crlf}"
    );
}

/// View edits change only tokens of the view's records, and give the text that camera.
#[test]
fn view_edits_make_the_text_describe_the_camera() {
    let mut random = Random(5);
    for _ in 0..3_000 {
        let mut number = || (random.next() as f64 / 1e18 - 9.0) * 1.5;
        let perspective = 0.0 < number();
        let mut lines = vec![
            format!(
                "camera {} {} {} {}  {} {} {}  {} {} {}  {} {} {}",
                if perspective {
                    "perspective"
                } else {
                    "orthographic"
                },
                number(),
                number(),
                number(),
                number(),
                number(),
                number(),
                number(),
                number(),
                number(),
                number().abs() + 0.1,
                number(),
                number().abs() + 20.0
            ),
            format!(
                "resolution {} {}",
                number().abs() + 0.01,
                number().abs() + 0.01
            ),
            format!(
                "viewport {} {}",
                number().abs() as u32 + 1,
                number().abs() as u32 + 1
            ),
        ];
        lines.retain(|_| number() < 6.0);
        let text = spelled(&format!("# one\n{}\n{BODY}", lines.join("\n")));
        let (source, lowered) = read(&text);
        let before = lowered.scene.expect("no errors").camera;
        let new = Camera {
            eye: DVec3::new(number(), number(), number()),
            target: DVec3::new(before.target.x, number(), before.target.z),
            up: DVec3::new(number(), before.up.y, number()),
            lens: match before.lens {
                Lens::Perspective(_) => Lens::Perspective(number().abs() + 1.0),
                Lens::Orthographic(_) => Lens::Orthographic(number().abs() + 1.0),
            },
            pixel_aspect: number().abs() + 0.5,
            depths: [number().abs(), number().abs() + 20.0],
            focus: Focus::PINHOLE,
            size: Size {
                width: number().abs() as u32 + 1,
                height: number().abs() as u32 + 1,
            },
        };
        let mut camera = before;
        let changed = random.next();
        let choose = |bit: u32| changed & (1 << bit) != 0;
        if choose(0) {
            camera.eye = new.eye;
        }
        if choose(1) {
            camera.target = new.target;
        }
        if choose(2) {
            camera.up = new.up;
        }
        if choose(3) {
            camera.lens = new.lens;
        }
        if choose(4) {
            camera.pixel_aspect = new.pixel_aspect;
        }
        if choose(5) {
            camera.depths = new.depths;
        }
        if choose(6) {
            camera.size = new.size;
        }
        let edits = source.view_edits(&before, &camera);
        assert_eq!(edits.is_empty(), camera == before, "{text}");
        let mut after = text.clone();
        apply(&mut after, &edits);
        check_alike(&after, &camera);
        // Everything except the view is unchanged.
        assert_eq!(without_view(&after), without_view(&text));
        for edit in &edits {
            let node = source.node_at(edit.span);
            assert!(
                edit.span.is_empty() || node == Some(Node::View),
                "{edit:?}\n{text}"
            );
        }
    }
}

/// The lines without records of a view.
fn without_view(text: &str) -> Vec<&str> {
    let is_other = |line: &&str| {
        let word = line.split_whitespace().next();
        word.is_none_or(|word| !MISSING.contains(&word))
    };
    text.split_inclusive('\n').filter(is_other).collect()
}

/// A value typed into a field of the view is the one in the text afterwards.
#[test]
fn fields_of_the_view_take_typed_values() {
    for kind in ["perspective", "orthographic"] {
        let text = spelled(&format!(
            "camera {kind} 1 2 3  4 5 6  0 0 1  2 0 100\nresolution 0.02 0.01\nviewport 80 60\n{BODY}"
        ));
        let (source, lowered) = read(&text);
        let camera = lowered.scene.expect("no errors").camera;
        let literals = source.view_literals(&camera);
        let placed = source.fields(Node::View);
        assert_eq!(literals.len(), placed.len());
        for (field, place) in placed.iter().enumerate() {
            for (component, span) in place.spans.iter().enumerate() {
                let own = span.of(&text);
                let key = place.field.key;
                assert_eq!(literals[field][component], own, "{kind} {key}");
                let typed: &[&str] = match key {
                    "projection" => continue,
                    "viewport" => &["7", "640"],
                    "focal" | "resolution" => &["0.3", "1", "1.7", "2.5", "0.013", "7.123"],
                    _ => &["0.25", "7", "1.5"],
                };
                for said in typed {
                    let at = (field, component);
                    let new = source
                        .view_with(&camera, at, said)
                        .unwrap_or_else(|must| panic!("{key}: {must}"));
                    let edits = source.view_edits(&camera, &new);
                    let mut after = text.clone();
                    apply(&mut after, &edits);
                    check_alike(&after, &new);
                    // A camera stores an angle or a height, not the two numbers that give it.
                    let is_lens = match kind {
                        "perspective" => key == "resolution" && component == 1,
                        _ => key == "focal",
                    };
                    if !is_lens {
                        let number = parse_number(said).expect("a number was typed");
                        let spelled = spell_like(own, number);
                        let expected =
                            format!("{}{spelled}{}", &text[..span.start()], &text[span.end()..]);
                        assert_eq!(after, expected, "{kind} {key}");
                    }
                }
            }
        }
    }
}

/// When the projection changes, the picture keeps its size at the target.
#[test]
fn a_projection_is_set_by_its_name() {
    let text = spelled(&format!("VIEW\n{BODY}"));
    let (source, lowered) = read(&text);
    let camera = lowered.scene.expect("no errors").camera;
    let new = source
        .view_with(&camera, (0, 0), "orthographic")
        .expect("a word");
    // The plane at distance 1 is 0.6 high; the target is at distance 5.
    let Lens::Orthographic(height) = new.lens else {
        panic!("{new:?}");
    };
    assert!((height - 3.0).abs() < 1e-14, "{height}");
    let mut after = text.clone();
    apply(&mut after, &source.view_edits(&camera, &new));
    check_alike(&after, &new);
    assert!(
        after.starts_with("camera orthographic 0 0 5  0 0 0  0 1 0  1 0 100\n"),
        "{after}"
    );
    let refused = source.view_with(&camera, (0, 0), "fisheye");
    assert_eq!(refused, Err("perspective or orthographic".to_owned()));
    let zero = source.view_with(&camera, (4, 0), "0");
    assert_eq!(zero, Err("greater than 0".to_owned()));
}
