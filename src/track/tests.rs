//! Values on paper, and errors beside the text that causes them.

use std::sync::Arc;

use proptest::prelude::*;

use super::*;
use crate::language::{Language, Source};
use crate::scene::{Camera, Meshes, Scene};

const SCENE: &str = "\
0.1 0.2 0.3
2  1 2 3  .5 .5 .5   -1 0 0  1 1 1
1 sphere 0 0 0 1.50  1 1 1 0 0 0 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 45 size 8 6
";

fn scene(text: &str) -> (Source, Scene) {
    let mut source = Source::new(Language::Ray, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("it fits");
    let scene = lowered.scene.expect("it is valid");
    (source, scene)
}

/// The texts that a track makes of [`SCENE`], a frame each.
fn texts(track: &str) -> Vec<String> {
    let (track, findings) = read(track);
    assert_eq!(findings.errors(), 0, "{findings:?}");
    let (mut source, scene) = scene(SCENE);
    let (bound, findings) = bind(&track, &source, &scene.camera);
    assert_eq!(findings.errors(), 0, "{findings:?}");
    let frames = 0..track.frames;
    let text = |frame| {
        let edits = bound.edits(&source, frame);
        let inverse = source.change(&edits);
        let text = String::clone(source.text());
        source.revert(&inverse);
        text
    };
    frames.map(text).collect()
}

/// What is wrong with a track of [`SCENE`]: line, column and message, each of the first finding.
fn fault(track: &str) -> String {
    let (parsed, mut findings) = read(track);
    let (source, scene) = scene(SCENE);
    findings.append(bind(&parsed, &source, &scene.camera).1);
    let finding = findings.sorted();
    let finding = finding.first().expect("a finding");
    let before = &track[..finding.span.start()];
    let line = 1 + before.matches('\n').count();
    let column = 1 + before.len() - before.rfind('\n').map_or(0, |at| at + 1);
    format!("{line}:{column} {}", finding.message)
}

#[test]
fn easings_pass_at_their_speeds() {
    for (easing, quarter, half) in [
        (Easing::Linear, 0.25, 0.5),
        // 3 t² − 2 t³ at ¼: 3/16 − 2/64.
        (Easing::Smooth, 0.156_25, 0.5),
        (Easing::Hold, 0.0, 0.0),
    ] {
        assert_eq!(easing.at(0.0), 0.0, "{easing:?}");
        assert_eq!(
            (easing.at(0.25), easing.at(0.5)),
            (quarter, half),
            "{easing:?}"
        );
        assert_eq!(Easing::named(easing.name()), Some(easing));
    }
}

#[test]
fn a_frame_is_the_text_with_other_literals() {
    let texts = texts(
        r#"
frames = 5
[[track]]
thing = "light 1"
field = "position y"
keys = [{ frame = 1, value = 2 }, { frame = 3, value = 4, easing = "hold" }, { frame = 4, value = 0 }]
[[track]]
thing = "object 1"
field = "radius"
keys = [{ frame = 0, value = 1.5 }, { frame = 4, value = 2.5, easing = "smooth" }]
"#,
    );
    let expected = [
        ("2", "1.50"),
        ("2", "1.75"),
        ("3", "2.00"),
        ("4", "2.25"),
        ("0", "2.50"),
    ];
    for (text, (y, radius)) in texts.iter().zip(expected) {
        let edited = SCENE
            .replace("1 2 3", &format!("1 {y} 3"))
            .replace("1.50", radius);
        assert_eq!(*text, edited);
    }
    assert_eq!(texts.len(), 5);
}

/// The camera of a frame is written into the text, so that it means the same when read again.
#[test]
fn cameras_are_edits_of_the_view() {
    let orbit =
        "frames = 3\n[orbit]\nkeys = [{ frame = 0, azimuth = 0 }, { frame = 2, azimuth = 180 }]";
    let raised = "frames = 1\n[orbit]\nkeys = [{ frame = 0, elevation = 30, distance = 2 }]";
    let moved = "frames = 2\n[camera]\nkeys = [{ frame = 0, eye = [0, 0, 5], fov = 45 }, \
                 { frame = 1, eye = [1, 2, 3], fov = 30 }]";
    let camera = |text: &str| -> Camera { scene(text).1.camera };
    let eyes = |track: &str| -> Vec<_> {
        let texts = texts(track).into_iter();
        texts.map(|text| camera(&text).eye.to_array()).collect()
    };
    let near = |found: Vec<[f64; 3]>, expected: &[[f64; 3]]| {
        assert_eq!(found.len(), expected.len());
        for (found, expected) in found.as_flattened().iter().zip(expected.as_flattened()) {
            assert!(
                (found - expected).abs() < 1e-12,
                "{found} is not {expected}"
            );
        }
    };
    near(
        eyes(orbit),
        &[[0.0, 0.0, 5.0], [5.0, 0.0, 0.0], [0.0, 0.0, -5.0]],
    );
    near(eyes(raised), &[[0.0, 1.0, 3.0_f64.sqrt()]]);
    assert_eq!(eyes(moved), [[0.0, 0.0, 5.0], [1.0, 2.0, 3.0]]);
    assert_eq!(texts(moved)[0], SCENE);
    assert!(texts(moved)[1].contains("eye 1 2 3 target 0 0 0 up 0 1 0 fov 30 size 8 6"));
}

#[test]
fn errors_are_at_their_places() {
    let track = |thing: &str, field: &str, keys: &str| {
        format!(
            "frames = 9\n[[track]]\nthing = \"{thing}\"\nfield = \"{field}\"\nkeys = [{keys}]\n"
        )
    };
    let key = "{ frame = 0, value = 1 }";
    for (text, expected) in [
        ("frames = ", "1:10 "),
        ("[[track]]\n", "1:1 `frames` is missing"),
        (
            "frames = 0",
            "1:10 this is not a whole number from 1 to 1000000",
        ),
        ("frames = 9\nfsp = 3", "2:1 unknown entry `fsp`"),
        (
            "frames = 9\nfps = 300",
            "2:7 this is not a whole number from 1 to 100",
        ),
        ("frames = 9", "1:1 nothing changes between the frames"),
        ("frames = 9\n[camera]\nkeys = []", "3:8 "),
        (
            &track("light 3", "position", "{ frame = 0, value = [1, 2, 3] }"),
            "3:9 nothing in the scene is called `light 3`",
        ),
        (
            &track("light 1", "positron", key),
            "4:9 light 1 has no field called `positron`",
        ),
        (
            &track("light 1", "position", key),
            "5:30 light 1 position: has 1 number",
        ),
        (
            &track("object 1", "radius", "{ frame = 0, value = -1 }"),
            "5:30 object 1 (sphere) radius: must be greater than 0",
        ),
        (
            &track(
                "object 1",
                "radius",
                "{ frame = 0, value = 1, easing = \"slow\" }",
            ),
            "5:42 unknown easing `slow`",
        ),
        (
            &track("object 1", "radius", &format!("{key}, {key}")),
            "5:45 frame 0 has two keys",
        ),
        (
            &track("object 1", "radius", "{ frame = 9, value = 1 }"),
            "5:19 frame 9 is behind the end: there are 9 frames",
        ),
        (
            &track("view", "size", key),
            "4:9 the size of the picture cannot change",
        ),
    ] {
        let found = fault(text);
        assert!(found.starts_with(expected), "{text}\n{found}");
    }
}

proptest! {
    /// At the frame of a key its value counts to the bit, and between two keys no number leaves them.
    #[test]
    fn values_are_exact_at_keys_and_never_beyond_them(
        values in prop::collection::vec(prop::num::f64::NORMAL, 1..6),
        gaps in prop::collection::vec(1..9_u32, 6),
        easing in prop::sample::select(&Easing::ALL[..]),
    ) {
        let mut frame = 0;
        let keys: Vec<_> = values.iter().zip(&gaps).map(|(&value, gap)| {
            frame += gap;
            Key { frame, value: Value::Numbers(vec![value]), easing, span: Span::at(0) }
        }).collect();
        let track = Keys::new(keys.clone()).expect("they ascend");
        for key in &keys {
            prop_assert_eq!(track.at(key.frame), key.value.clone());
        }
        for pair in keys.windows(2) {
            let [from, to] = [&pair[0], &pair[1]].map(|key| match &key.value {
                Value::Numbers(numbers) => numbers[0],
                Value::Word(_) => f64::NAN,
            });
            for frame in pair[0].frame..pair[1].frame {
                let between = track.numbers_at(frame)[0];
                prop_assert!(from.min(to) <= between && between <= from.max(to));
            }
        }
    }
}
