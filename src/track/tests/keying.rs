//! Keys written into the text of a track.

use super::*;
use language::Node;
use text::apply;

/// The text of a track with the value of a component's field keyed, and the name of the field.
fn keyed(track: &str, place: (Node, usize, usize), frame: u32) -> (String, String) {
    let (source, scene) = scene(Language::Ray, RAY);
    let (read, findings) = read(track);
    let (bound, more) = bind(&read, &source, &scene.camera);
    assert_eq!((findings.errors(), more.errors()), (0, 0), "{track}");
    let keyed = key_field(track, (&read, &bound), &source, place, frame).expect("it is keyed");
    let mut text = track.to_owned();
    apply(&mut text, &keyed.edits);
    check(&text);
    (text, keyed.what)
}

/// Checks that a text is a track without errors.
fn check(text: &str) {
    let (source, scene) = scene(Language::Ray, RAY);
    let (_, findings) = bound(&source, &scene, text);
    assert_eq!(findings, Findings::default(), "{text}");
}

const LAMP: (Node, usize, usize) = (Node::Light(0), 0, 1);

#[test]
fn the_first_key_of_a_field_begins_a_track_of_it() {
    for (track, expected) in [
        (
            "frames = 9\n",
            "frames = 9\n\n[[track]]\nthing = \"the lamp\"\nfield = \"position\"\nkeys = [{ frame = 4, value = [0, 5, 0] }]\n",
        ),
        (
            "frames = 9 # nine",
            "frames = 9 # nine\n\n[[track]]\nthing = \"the lamp\"\nfield = \"position\"\nkeys = [{ frame = 4, value = [0, 5, 0] }]\n",
        ),
        (
            "frames = 9\r\n",
            "frames = 9\r\n\r\n[[track]]\r\nthing = \"the lamp\"\r\nfield = \"position\"\r\nkeys = [{ frame = 4, value = [0, 5, 0] }]\r\n",
        ),
        // Of a field whose other component has a track, only this component.
        (
            "frames = 9\n[[track]]\nthing = 'the lamp'\nfield = 'position x'\nkeys = [{frame = 0, value = 1}]\n",
            "frames = 9\n[[track]]\nthing = 'the lamp'\nfield = 'position x'\nkeys = [{frame = 0, value = 1}]\n\
             \n[[track]]\nthing = \"the lamp\"\nfield = \"position y\"\nkeys = [{ frame = 4, value = 5 }]\n",
        ),
    ] {
        assert_eq!(keyed(track, LAMP, 4).0, expected);
    }
    assert_eq!(keyed(BEGUN, LAMP, 0).1, "the lamp position");
}

/// A track of the lamp's position, or a component, with these keys.
fn lamp(field: &str, keys: &str) -> String {
    format!(
        "frames = 9\n[[track]] # moves\nthing = 'the lamp'\nfield = '{field}'\nkeys = {keys}\n\n[orbit]\nkeys = [{{frame = 0, azimuth = 3}}]\n"
    )
}

#[test]
fn keys_are_written_between_their_neighbours_in_their_style() {
    let vector = "[0, 5, 0]";
    for (field, keys, frame, expected) in [
        // In a line.
        (
            "position y",
            "[{frame = 0, value = 1}, {frame = 8, value = 2}]",
            4,
            "[{frame = 0, value = 1}, { frame = 4, value = 5 }, {frame = 8, value = 2}]",
        ),
        (
            "position y",
            "[{frame = 0, value = 1}, {frame = 2, value = 2}]",
            4,
            "[{frame = 0, value = 1}, {frame = 2, value = 2}, { frame = 4, value = 5 }]",
        ),
        (
            "position y",
            "[{frame = 6, value = 1},]",
            8,
            "[{frame = 6, value = 1}, { frame = 8, value = 5 },]",
        ),
        (
            "position y",
            "[ {frame = 6, value = 1} ]",
            4,
            "[ { frame = 4, value = 5 }, {frame = 6, value = 1} ]",
        ),
        // The value of the key that is there.
        (
            "position y",
            "[{frame = 4, value = 1, easing = 'hold'}]",
            4,
            "[{frame = 4, value = 5, easing = 'hold'}]",
        ),
        (
            "position y",
            "[{frame = 4, value = 5}]",
            4,
            "[{frame = 4, value = 5}]",
        ),
        // The easing of the key before.
        (
            "position y",
            "[{frame = 0, value = 1, easing = 'smooth'}, {frame = 8, value = 2, easing = 'hold'}]",
            4,
            "[{frame = 0, value = 1, easing = 'smooth'}, { frame = 4, value = 5, easing = \"smooth\" }, {frame = 8, value = 2, easing = 'hold'}]",
        ),
        // Each in its line; comments stay where they are.
        (
            "position",
            "[\n  # first\n  {frame = 0, value = [1, 1, 1]}, # begins\n  {frame = 8, value = [2, 2, 2]}, # ends\n]",
            4,
            "[\n  # first\n  {frame = 0, value = [1, 1, 1]}, # begins\n  { frame = 4, value = V },\n  {frame = 8, value = [2, 2, 2]}, # ends\n]",
        ),
        (
            "position",
            "[\n  {frame = 0, value = [1, 1, 1]}, # begins\n  {frame = 2, value = [2, 2, 2]}, # ends\n]",
            4,
            "[\n  {frame = 0, value = [1, 1, 1]}, # begins\n  {frame = 2, value = [2, 2, 2]}, # ends\n  { frame = 4, value = V },\n]",
        ),
        (
            "position",
            "[\n  {frame = 0, value = [1, 1, 1]},\n  {frame = 2, value = [2, 2, 2]} # ends\n]",
            4,
            "[\n  {frame = 0, value = [1, 1, 1]},\n  {frame = 2, value = [2, 2, 2]}, # ends\n  { frame = 4, value = V }\n]",
        ),
        (
            "position",
            "[\n  {frame = 2, value = [2, 2, 2]}\n]",
            4,
            "[\n  {frame = 2, value = [2, 2, 2]},\n  { frame = 4, value = V }\n]",
        ),
        (
            "position",
            "[\n  {frame = 2, value = [2, 2, 2]}]",
            4,
            "[\n  {frame = 2, value = [2, 2, 2]},\n  { frame = 4, value = V }]",
        ),
    ] {
        let track = lamp(field, keys);
        let (text, what) = keyed(&track, LAMP, frame);
        assert_eq!(text, lamp(field, &expected.replace('V', vector)));
        assert_eq!(what, format!("the lamp {field}"));
    }
}

#[test]
fn what_cannot_be_keyed_is_refused() {
    let (source, scene) = scene(Language::Ray, RAY);
    for (track, place, refused) in [
        (
            BEGUN,
            (Node::View, 0, 0),
            "the scene does not state its eye: set it first",
        ),
        (
            "frames = 9\n[[track]]\nthing = 'light 1'\nfield = 'position'\n[[track.keys]]\nframe = 0\nvalue = [0, 0, 0]",
            LAMP,
            "these keys are not written as keys = [{ frame = 0, … }]: add one in an editor",
        ),
    ] {
        let (read, _) = read(track);
        let (bound, _) = bind(&read, &source, &scene.camera);
        let keyed = key_field(track, (&read, &bound), &source, place, 4);
        assert_eq!(keyed.expect_err("it is refused").to_string(), refused);
    }
}

/// A camera like that of a scene, moved.
fn moved(base: &Camera, eye: [f64; 3], target: [f64; 3]) -> Camera {
    Camera {
        eye: eye.into(),
        target: target.into(),
        ..*base
    }
}

#[test]
fn a_keyed_camera_is_the_camera_of_its_frame() {
    let (source, scene) = scene(Language::Ray, RAY);
    let base = scene.camera;
    let tracks = [
        BEGUN.to_owned(),
        format!("{BEGUN}[camera]\nkeys = [{{ frame = 0, fov = 30 }}]\n"),
        format!("{BEGUN}[camera]\nkeys = [{{ frame = 7, eye = [1, 2, 3] }}]\n"),
        format!(
            "{BEGUN}[orbit]\nkeys = [{{ frame = 0, azimuth = 0 }}, {{ frame = 9, azimuth = 1 }}]\n"
        ),
        format!("{BEGUN}[orbit]\nkeys = [{{ frame = 7, distance = 2 }}]\n"),
    ];
    for track in tracks {
        for (eye, target) in [
            ([1.0, 2.0, 7.0], [0.0, 0.5, 0.0]),
            ([-3.0, 0.25, -1.0], base.target.to_array()),
        ] {
            let now = moved(&base, eye, target);
            let (before, _) = read(&track);
            let keyed = key_camera(&track, &before, [&base, &now], 7).expect("it is keyed");
            let mut text = track.clone();
            apply(&mut text, &keyed.edits);
            let (after, findings) = read(&text);
            assert_eq!(findings, Findings::default(), "{text}");
            let (_, findings) = bind(&after, &source, &base);
            assert_eq!(findings, Findings::default(), "{text}");
            let camera = after.camera.expect("it moves").at(7, &base);
            assert!(camera.eye.abs_diff_eq(now.eye, 1e-4), "{text}\n{camera:?}");
            assert!(camera.target.abs_diff_eq(now.target, 1e-4), "{text}");
        }
    }
}

#[test]
fn an_orbit_does_not_turn_back() {
    let (_, scene) = scene(Language::Ray, RAY);
    let base = scene.camera;
    let track = "frames = 9\n[orbit]\nkeys = [{ frame = 0, azimuth = 350 }]\n";
    let (read, _) = read(track);
    let now = base.about_target(20_f64.to_radians());
    let keyed = key_camera(track, &read, [&base, &now], 4).expect("it is keyed");
    let mut text = track.to_owned();
    apply(&mut text, &keyed.edits);
    let keys = "keys = [{ frame = 0, azimuth = 350 }, { frame = 4, azimuth = 380 }]\n";
    assert_eq!(text, format!("frames = 9\n[orbit]\n{keys}"));
}
