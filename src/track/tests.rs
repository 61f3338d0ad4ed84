mod keying;

use std::sync::Arc;

use glam::DVec3;
use proptest::prelude::*;

use super::*;
use language::{Language, Source};
use scene::{Camera, Lens, Meshes, Scene};
use text::{Diagnostic, Findings, Position};

/// Lowers a valid scene.
fn scene(language: Language, text: &str) -> (Source, Scene) {
    let mut source = Source::new(language, Arc::new(text.to_owned()));
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let scene = lowered
        .scene
        .unwrap_or_else(|| panic!("{:?}", lowered.diagnostics));
    (source, scene)
}

/// Reads a track and binds it to a scene.
fn bound(source: &Source, scene: &Scene, track: &str) -> (Bound, Findings) {
    let (track, mut findings) = read(track);
    let (bound, more) = bind(&track, source, &scene.camera);
    findings.append(more);
    (bound, findings.sorted())
}

/// The text of a frame, and its scene.
fn frame(language: Language, text: &str, track: &str, frame: u32) -> (String, Scene) {
    let (mut source, before) = scene(language, text);
    let (bound, findings) = bound(&source, &before, track);
    assert_eq!(findings, Findings::default(), "{track}");
    let edits = bound.edits(&source, frame);
    let inverse = source.change(&edits);
    let lowered = source.lower(&Meshes::default()).expect("there is memory");
    let edited = source.text().to_string();
    source.revert(&inverse);
    assert_eq!(**source.text(), *text);
    (edited, lowered.scene.expect("it is valid"))
}

fn keys(easing: Easing, numbers: &[(u32, f64)]) -> Keys {
    let keys = numbers.iter().map(|&(frame, number)| Key {
        frame,
        value: Value::Numbers(vec![number]),
        easing,
        span: Span::default(),
    });
    Keys::new(keys.collect()).expect("they ascend")
}

#[test]
fn easings_pass_through_numbers_known_on_paper() {
    for (easing, expected) in [
        (Easing::Linear, [0.0, 2.0, 4.0, 6.0, 8.0]),
        (Easing::Smooth, [0.0, 1.25, 4.0, 6.75, 8.0]),
        (Easing::Hold, [0.0, 0.0, 0.0, 0.0, 8.0]),
    ] {
        let keys = keys(easing, &[(10, 0.0), (14, 8.0)]);
        let values = [10, 11, 12, 13, 14].map(|frame| keys.numbers_at(frame)[0]);
        assert_eq!(values, expected, "{easing:?}");
        for (outside, value) in [(0, 0.0), (9, 0.0), (15, 8.0), (u32::MAX, 8.0)] {
            assert_eq!(keys.numbers_at(outside), [value], "{easing:?}");
        }
        assert_eq!(Easing::named(easing.name()), Some(easing));
    }
    // The easing of a key is that of the interval behind it.
    let (track, findings) = read(
        "frames = 9\n[camera]\nkeys = [{frame = 0, fov = 10, easing = 'hold'}, {frame = 4, fov = 20}, \
         {frame = 8, fov = 40}]",
    );
    assert_eq!(findings, Findings::default());
    let camera = track.camera.expect("a camera");
    let values = [3, 4, 6].map(|frame| camera.parameters[0].1.numbers_at(frame)[0]);
    assert_eq!(values, [10.0, 20.0, 30.0]);
}

proptest! {
    #![proptest_config(repeatable::config())]

    #[test]
    fn a_key_has_its_value_at_its_frame_and_no_other_goes_beyond(
        numbers in prop::collection::btree_map(0_u32..1000, any::<f64>(), 1..8),
        easing in prop::sample::select(&Easing::ALL[..]),
        asked in 0_u32..1000,
    ) {
        let numbers: Vec<_> = numbers.into_iter().filter(|(_, number)| number.is_finite()).collect();
        prop_assume!(!numbers.is_empty());
        let keys = keys(easing, &numbers);
        for &(frame, number) in &numbers {
            prop_assert_eq!(keys.numbers_at(frame)[0].to_bits(), number.to_bits());
        }
        let after = numbers.partition_point(|&(frame, _)| frame <= asked);
        let ends = [after.saturating_sub(1), after.min(numbers.len() - 1)].map(|at| numbers[at].1);
        let between = keys.numbers_at(asked)[0];
        prop_assert!(ends[0].min(ends[1]) <= between && between <= ends[0].max(ends[1]));
    }
}

const RAY: &str = "\
.1 .1 .1
1  0 5 0  .5 .5 .5 // the lamp
2 sphere 0 0 0 1.00  1 1 1 0 0 0 0 0 0 1 0 0 1 // a ball
box 0 -1 0  1 0 0  0 1 0  0 0 1  1 1 1  0 0 0 1 1 1 0 0 0 1 0 0 1
";

const DAT: &str = "\
camera perspective 0 0 8  0 0 0  0 1 0  1 0 100
resolution .01 .01
viewport 100 80
light ID 7 pnt 0 4 0  0 0 0  1 1 1  1 0 0  0 shadow_on
mat ID 3  1 0 0  .1 .5 .5 20  0 0 1
mat ID 4  0 1 0  .1 .5 .5 20  0 0 1
obj sphere ID 2 mat ID 3  0 0 0  1
";

const XML: &str = "\
<xml><scene>
<object type=\"sphere\" name=\"a ball\" material=\"red\"><rotate z=\"1\" angle=\"12\"/><rotate x=\"1\" \
angle=\"5\"/></object>
<object type=\"sphere\"/>
<material type=\"blinn\" name=\"red\"><diffuse r=\"0.5\" g=\"0\" b=\"0\"/></material>
<material type=\"blinn\" name=\"blue\"/>
<light type=\"point\" name=\"key\"><position z=\"9\"/></light>
</scene><camera><position z=\"9\"/></camera></xml>
";

#[test]
fn a_frame_is_the_text_edited_by_hand() {
    use Language::{Dat, Ray, Xml};
    #[rustfmt::skip]
    let cases = [
        (Ray, ["light 1", "position"], ["[0, 5, 0]", "[2, 5.5, 0]"], ["0 5 0", "1 5.25 0"]),
        (Ray, ["ambient", "colour"], ["[0, 0, 0]", "[1, 1, 1]"], [".1 .1 .1", ".5 .5 .5"]),
        (Ray, ["object 1", "radius"], ["1", "2"], ["1.00", "1.50"]),
        (Ray, ["object 1 (sphere)", "radius"], ["[3]", "3"], ["1.00", "3.00"]),
        (Ray, ["a ball", "centre x"], ["-1", "2"], ["sphere 0 0", "sphere 0.5 0"]),
        (Ray, ["the lamp", "colour green"], ["0.5", "1"], [".5 .5 .5", ".5 .75 .5"]),
        (Dat, ["light 7", "position"], ["[0, 4, 0]", "[1, 4, 0]"], ["pnt 0", "pnt 0.5"]),
        (Dat, ["object 2", "mat"], ["4", "3"], ["mat ID 3  0 0 0", "mat ID 4  0 0 0"]),
        (Dat, ["light 7", "source"], ["'inf'", "'pnt'"], ["pnt", "inf"]),
        (Dat, ["view", "focal"], ["1", "3"], ["0 1 0  1 0", "0 1 0  2 0"]),
        (Xml, ["a ball", "material"], ["'blue'", "'red'"], ["material=\"red\"", "material=\"blue\""]),
        (Xml, ["a ball", "rotate 1 angle"], ["12", "14"], ["angle=\"12\"", "angle=\"13\""]),
        (Xml, ["a ball", "rotate 2"], ["[0, 1, 0]", "[1, 1, 0]"], ["x=\"1\" angle=\"5\"", "x=\"0.5\" angle=\"5\" y=\"1\" z=\"0\""]),
        (Xml, ["red", "diffuse"], ["[1, 0, 0]", "[0, 0, 0]"], ["", ""]),
        (Xml, ["red", "diffuse red"], ["1", "0.5"], ["r=\"0.5\"", "r=\"0.75\""]),
        (Xml, ["key", "position"], ["[0, 0, 9]", "[2, 0, 9]"], ["<position z=\"9\"", "<position z=\"9\" x=\"1\" y=\"0\""]),
        (Xml, ["object 2", "material"], ["'blue'", "'red'"], ["sphere\"/>", "sphere\" material=\"blue\"/>"]),
        (Xml, ["view", "fov"], ["40", "50"], ["</camera>", "<fov value=\"45\"/></camera>"]),
    ];
    for (language, [thing, field], [first, second], [old, new]) in cases {
        let text = text_of(language);
        let (edited, _) = frame(language, text, &two_keys(thing, field, first, second), 2);
        assert_eq!(edited, text.replacen(old, new, 1), "{thing} {field}");
    }
}

/// IDs are not numbers: between 4 and 3 there are none.
#[test]
fn words_and_ids_change_at_their_keys() {
    for (value, next) in [("4", "3"), ("'4'", "'3'")] {
        let track = two_keys("object 2", "mat", value, next);
        for (number, id) in [(0, 4), (3, 4), (4, 3)] {
            let (edited, _) = frame(Language::Dat, DAT, &track, number);
            let object = format!("obj sphere ID 2 mat ID {id}  0 0 0");
            assert!(edited.contains(&object), "{value} {number}: {edited}");
        }
    }
}

fn text_of(language: Language) -> &'static str {
    match language {
        Language::Ray => RAY,
        Language::Dat => DAT,
        Language::Xml => XML,
        Language::Cse167 => Language::Cse167.template(),
    }
}

/// A track of five frames that sets a field at the first and the last.
fn two_keys(thing: &str, field: &str, first: &str, last: &str) -> String {
    format!(
        "frames = 5\n[[track]]\nthing = '{thing}'\nfield = '{field}'\n\
         keys = [{{frame = 0, value = {first}}}, {{frame = 4, value = {last}}}]\n"
    )
}

#[test]
fn several_tracks_edit_one_text() {
    let track = two_keys("key", "position x", "0", "4")
        + "[[track]]\nthing = 'key'\nfield = 'position y'\nkeys = [{frame = 0, value = 1}]\n\
           [[track]]\nthing = 'view'\nfield = 'position'\nkeys = [{frame = 0, value = [0, 1, 9]}]\n\
           [orbit]\nkeys = [{frame = 0, fov = 30}]";
    let (source, scene) = scene(Language::Xml, XML);
    let (_, findings) = bound(&source, &scene, &track);
    let messages: Vec<_> = findings.iter().map(|found| &*found.message).collect();
    assert_eq!(messages, ["the camera moves this field already"]);
    let (edited, _) = frame(Language::Xml, XML, &track.replace("[orbit]", "[camera]"), 1);
    let expected = XML
        .replacen("<position z=\"9\"", "<position z=\"9\" x=\"1\" y=\"1\"", 1)
        .replace(
            "<camera><position z=\"9\"/>",
            "<camera><position z=\"9\" x=\"0\" y=\"1\"/><fov value=\"30\"/>",
        );
    assert_eq!(edited, expected);
}

/// The camera is written into the text, which then shows it.
#[test]
fn cameras_are_views_of_the_text() {
    let moves = "frames = 9\n[camera]\nkeys = [\
        {frame = 0, eye = [0, 0, 5], target = [0, 0, 0], up = [0, 1, 0], fov = 40},\
        {frame = 8, eye = [4, 2, 5], target = [0, 1, 0], up = [0, 0, 1], fov = 50}]";
    for language in Language::ALL {
        let text = text_of(language);
        let (edited, scene) = frame(language, text, moves, 4);
        assert_ne!(edited, text);
        let camera = scene.camera;
        assert_eq!(camera.eye, DVec3::new(2.0, 1.0, 5.0), "{edited}");
        assert_eq!(camera.target, DVec3::new(0.0, 0.5, 0.0));
        assert_eq!(camera.up, DVec3::new(0.0, 0.5, 0.5));
        let Lens::Perspective(fov) = camera.lens else {
            panic!("{camera:?}");
        };
        assert!((fov - 45.0).abs() < 1e-9, "{fov}");
    }
    // Parts that the track sets are written even if they are the defaults of the text at first.
    let (source, before) = scene(Language::Ray, RAY);
    let Camera { eye, target, .. } = before.camera;
    let track = format!(
        "frames = 2\n[camera]\nkeys = [{{frame = 0, eye = {:?}, target = {:?}}}]",
        eye.to_array(),
        target.to_array()
    );
    let (bound, _) = bound(&source, &before, &track);
    assert_eq!(bound.edits(&source, 0).len(), 1);
}

#[test]
fn an_orbit_goes_round_the_target() {
    let base = "// view: eye 0 0 5 target 0 0 0 up 0 2 0 fov 40 size 40 30\n";
    let text = base.to_owned() + RAY;
    let near = |camera: &Camera, eye: [f64; 3]| {
        assert!(
            camera.eye.distance(eye.into()) < 1e-12,
            "{camera:?} {eye:?}"
        );
    };
    for (keys, eye) in [
        ("{frame = 0, azimuth = 0}", [0.0, 0.0, 5.0]),
        ("{frame = 0, azimuth = 90}", [5.0, 0.0, 0.0]),
        (
            "{frame = 0, azimuth = 0}, {frame = 2, azimuth = 180}",
            [5.0, 0.0, 0.0],
        ),
        (
            "{frame = 0, elevation = 30, distance = 2}",
            [0.0, 1.0, 3.0_f64.sqrt()],
        ),
        ("{frame = 0, azimuth = -90, distance = 2}", [-2.0, 0.0, 0.0]),
        ("{frame = 0, target = [1, 1, 1]}", [1.0, 1.0, 6.0]),
        (
            "{frame = 0, up = [0, 0, 1], elevation = 0}",
            [0.0, 0.0, 0.0],
        ),
    ] {
        let track = format!("frames = 3\n[orbit]\nkeys = [{keys}]");
        let (_, scene) = frame(Language::Ray, &text, &track, 1);
        if eye == [0.0; 3] {
            // Seen from the pole, any direction across the axis will do.
            let camera = scene.camera;
            assert!((camera.eye.length() - 5.0).abs() < 1e-12 && camera.eye.z.abs() < 1e-12);
        } else {
            near(&scene.camera, eye);
        }
    }
}

/// Errors and warnings with the part of the text that they mark.
#[test]
fn errors_are_at_the_text_that_causes_them() {
    let key = "keys = [{frame = 0, value = 1}]";
    let track = |head: &str| format!("frames = 5\n[[track]]\n{head}");
    let light = |keys: &str| {
        track(&format!(
            "thing = 'light 1'\nfield = 'position y'\nkeys = {keys}"
        ))
    };
    let value = |thing: &str, field: &str, value: &str| {
        track(&format!(
            "thing = '{thing}'\nfield = '{field}'\nkeys = [{{frame = 1, value = {value}}}]"
        ))
    };
    let camera = |keys: &str| format!("frames = 5\n[camera]\nkeys = {keys}");
    #[rustfmt::skip]
    let cases: &[(Language, String, &[&str])] = &[
        (Language::Ray, String::new(), &["1:1 error `frames` is missing | how many frames there are, such as frames = 120"]),
        (Language::Ray, "frames = 5".into(), &["1:1 warning nothing changes between the frames | [[track]], [camera] or [orbit]"]),
        (Language::Ray, "frames = 0".into(), &["1:10 error this is not a whole number from 1 to 1000000 | a whole number from 1 to 1000000"]),
        (Language::Ray, "frames = 5\nfps = 101\n[camara]\n[[track]]\n".to_owned() + key, &[
            "2:7 error this is not a whole number from 1 to 100 | a whole number from 1 to 100",
            "3:2 error unknown entry `camara` | frames, fps, track, camera or orbit | did you mean camera?",
            "4:1 error `thing` is missing | a name as in the list of the interface, such as thing = \"light 1\"",
            "4:1 error `field` is missing | the name of a field, such as field = \"position\"",
        ]),
        (Language::Ray, light("[]"), &["5:8 error there are no keys | keys such as [{ frame = 0, value = 1 }, { frame = 24, value = 2 }]"]),
        (Language::Ray, light("[{frame = 1, value = 1}, {frame = 1, value = 1}]"), &["5:42 error frame 1 has two keys | one key for each frame"]),
        (Language::Ray, light("[{frame = 2, value = 1}, {frame = 1, value = 1}]"), &["5:42 error frame 1 comes after frame 2 | frames in ascending order"]),
        (Language::Ray, light("[{frame = 5, value = 1}, {frame = 6, value = 1}]"), &["5:42 warning frame 6 is beyond the end: there are 5 frames | a frame from 0 to 4, or 5 to close a loop"]),
        (Language::Ray, light("[{frame = -1, value = 1}]"), &["5:18 error this is not a whole number from 0 to 1000000 | a whole number from 0 to 1000000"]),
        (Language::Ray, light("[{frame = 1, value = true}]"), &["5:29 error this is not a number | a number, an array of numbers, or a string"]),
        (Language::Ray, light("[{frame = 1, value = inf}]"), &["5:29 error this is not a finite number | a number, an array of numbers, or a string"]),
        (Language::Ray, light("[{frame = 1, value = 1, easing = 'smoth'}]"), &["5:41 error unknown easing `smoth` | \"linear\", \"smooth\" or \"hold\" | did you mean smooth?"]),
        (Language::Ray, light("[{frame = 1, value = 1, ease = 'hold'}]"), &["5:32 error unknown entry `ease` | frame, easing or value"]),
        (Language::Ray, value("lihgt 1", "position", "1"), &["3:9 error nothing in the scene is called `lihgt 1` | render, view, ambient, light 1, object 1 or object 2 | did you mean light 1?"]),
        (Language::Ray, value("light 1", "postion", "1"), &["4:9 error light 1 has no field called `postion` | position or colour | did you mean position?"]),
        (Language::Ray, value("light 1", "position", "[1, 2]"), &["5:29 error light 1 position: has 2 numbers | 3 numbers: x, y, z"]),
        (Language::Ray, value("light 1", "position y", "[1, 2, 3]"), &["5:29 error light 1 position: has 3 numbers | 1 number"]),
        (Language::Ray, value("light 1", "position", "'up'"), &["5:29 error light 1 position: is a word | a number"]),
        (Language::Ray, value("object 1", "radius", "0"), &["5:29 error object 1 (sphere) radius: must be greater than 0 | a number greater than 0"]),
        (Language::Ray, value("view", "fov", "40"), &["4:9 error the scene does not state its fov | a field that is in the text of the scene | move the view by [camera] or [orbit] instead"]),
        (Language::Ray, value("light 1", "position", "[1, 2, 3]") + "\n[[track]]\nthing = 'the lamp'\nfield = 'position x'\n" + key, &["8:9 error this field is already set by another track | one track for each field"]),
        (Language::Dat, value("object 2", "mat", "5"), &["5:29 error object 2 (sphere) mat: `5` is unknown | the number of one material"]),
        (Language::Dat, value("object 2", "mat", "3.5"), &["5:29 error object 2 (sphere) mat: is no ID | the number of one material"]),
        (Language::Dat, value("light 7", "source", "1"), &["5:29 error light 7 source: is a number | pnt or inf or amb"]),
        (Language::Xml, value("a ball", "rotate 1", "[1, 1]"), &["5:29 error a ball (sphere) rotate: has 2 numbers | 3 or 4 numbers: x, y, z, angle"]),
        (Language::Dat, value("light 7", "source", "'pn'"), &["5:29 error light 7 source: `pn` is unknown | pnt or inf or amb | did you mean pnt?"]),
        (Language::Xml, value("a ball", "rotate", "[0, 0, 1]"), &["4:9 error a ball (sphere) has 2 fields called `rotate` | rotate 1 or rotate 2"]),
        (Language::Xml, value("a ball", "material", "'read'"), &["5:29 error a ball (sphere) material: `read` is unknown | the name of one material | did you mean red?"]),
        (Language::Xml, value("view", "width", "40"), &["4:9 error the size of the picture cannot change between frames | another field | set it for all frames by --size"]),
        (Language::Ray, camera("[{frame = 0, fov = 180}]"), &["3:27 error fov: must be a number greater than 0 and less than 180 | a number greater than 0 and less than 180"]),
        (Language::Ray, camera("[{frame = 0, height = 2}]"), &["3:30 error height: the view is perspective | fov instead"]),
        (Language::Ray, camera("[{frame = 0, eye = [0, 0]}]"), &["3:27 error eye: must be three numbers, such as [0, 1, 5] | three numbers, such as [0, 1, 5]"]),
        (Language::Ray, camera("[{frame = 0, azimuth = 2}]"), &["3:21 error unknown entry `azimuth` | frame, easing, eye, target, up, fov or height"]),
        (Language::Ray, camera("[{frame = 0, fov = 2}]\n[orbit]\nkeys = [{frame = 0}]"), &["4:1 error the camera is already moved by another table | either [camera] or [orbit]"]),
        (Language::Xml, camera("[{frame = 0, fov = 2}]\n[[track]]\nthing = 'view'\nfield = 'fov'\nkeys = [{frame = 0, value = 2}]"), &["6:9 error the text does not state this field, and the camera moves | a field of the view that the text states, and the camera does not move"]),
    ];
    for (language, text, expected) in cases {
        let (source, scene) = scene(*language, text_of(*language));
        let (_, findings) = bound(&source, &scene, text);
        let shown: Vec<_> = findings.iter().map(|found| shown(text, found)).collect();
        assert_eq!(shown, *expected, "{text}");
    }
    // What is no TOML is reported where it goes wrong.
    let (_, findings) = read("frames = 5\nfps = = 2");
    assert_eq!(
        findings.iter().map(|found| found.span.start()).next(),
        Some(17)
    );
}

/// A diagnostic in one line.
fn shown(text: &str, found: &Diagnostic) -> String {
    let Position { line, column } = Position::of(text, found.span.start());
    let severity = if found.is_error() { "error" } else { "warning" };
    let hint = found.hint.iter().map(|hint| format!(" | {hint}"));
    format!(
        "{line}:{column} {severity} {} | {}{}",
        found.message,
        found.expected,
        hint.collect::<String>()
    )
}

#[test]
fn names_that_several_things_have_are_refused() {
    let text = XML.replace("name=\"blue\"", "name=\"a ball\"");
    let (source, scene) = scene(Language::Xml, &text);
    let track = two_keys("a ball", "diffuse red", "0", "1");
    let (_, findings) = bound(&source, &scene, &track);
    let shown: Vec<_> = findings.iter().map(|found| shown(&track, found)).collect();
    assert_eq!(
        shown,
        ["3:9 error 2 things are called `a ball` | material 2 or object 1"]
    );
    for (thing, field) in [
        ("material 2", "diffuse red"),
        ("a ball (blinn)", "diffuse red"),
    ] {
        let (_, findings) = bound(&source, &scene, &two_keys(thing, field, "0", "1"));
        assert_eq!(findings, Findings::default(), "{thing}");
    }
}
