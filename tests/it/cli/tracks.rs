//! Tracks: fields and cameras that change from frame to frame.

use super::*;

/// A ball beside a box, with a lamp.
const STILL: &str = "\
.2 .2 .2
1  0 5 5  .8 .8 .8            // the lamp
2 sphere -0.50 0 0  .4        .2 .1 .1 .5 .5 .5 0 0 0 1 0 0 1
  box 0 -.4 -.4  1 0 0 0 1 0 0 0 1  .8 .8 .8  .1 .2 .1 .5 .5 .5 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 20 15
";

/// The ball rises, falls and rests; the lamp changes at once.
const MOVES: &str = "\
frames = 9
fps = 5

[[track]]
thing = \"object 1\"
field = \"centre\"
keys = [
    { frame = 0, value = [-0.5, 0, 0] },
    { frame = 2, value = [-0.5, 0.5, 0] },
    { frame = 4, value = [-0.5, 0, 0] },
    { frame = 6, value = [-0.5, 0.25, 0.5] },
]

[[track]]
thing = \"the lamp\"
field = \"colour red\"
keys = [{ frame = 0, value = 0.8, easing = \"hold\" }, { frame = 7, value = 0.5 }]
";

impl Place {
    pub(super) fn with_moves() -> Self {
        let place = Self::new();
        place.write("still.ray", STILL);
        place.write("moves.toml", MOVES);
        place
    }
}

const LINE: &str = "render still.ray --track moves.toml -o f%d.png";

#[test]
fn a_frame_is_the_picture_of_the_text_with_its_values() {
    let place = Place::with_moves();
    assert_eq!(place.stderr(LINE, 0), "");
    for (frame, centre, red) in [
        (0, "-0.50 0 0", ".8"),
        (1, "-0.50 0.25 0", ".8"),
        (5, "-0.50 0.125 0.25", ".8"),
        (8, "-0.50 0.25 0.5", ".5"),
    ] {
        let text =
            STILL
                .replace("-0.50 0 0", centre)
                .replacen(".8 .8 .8  ", &format!("{red} .8 .8  "), 1);
        place.write("one.ray", text);
        place.stderr("render one.ray -o one.png", 0);
        let name = format!("f{frame}.png");
        assert!(place.read(&name) == place.read("one.png"), "{name}");
    }
    assert!(!place.at("f9.png").exists());
}

#[test]
fn cameras_give_the_picture_of_their_view() {
    let place = Place::with_moves();
    let camera = "frames = 3\n[camera]\nkeys = [{ frame = 0, eye = [0, 0, 5], fov = 40 }, \
                  { frame = 2, eye = [2, 1, 4], fov = 60 }]";
    place.write("moves.toml", camera);
    place.stderr(LINE, 0);
    let view = STILL.replace("eye 0 0 5", "eye 1 0.5 4.5");
    place.write("one.ray", view.replace("fov 40", "fov 50"));
    place.stderr("render one.ray -o one.png", 0);
    assert!(place.read("f1.png") == place.read("one.png"));
    // An orbit once round is a turntable.
    let orbit =
        "frames = 4\n[orbit]\nkeys = [{ frame = 0, azimuth = 0 }, { frame = 4, azimuth = 360 }]";
    place.write("moves.toml", orbit);
    place.stderr(LINE, 0);
    place.stderr("render still.ray --turntable 4 -o t%d.png", 0);
    for frame in 0..4 {
        let line = format!("compare f{frame}.png t{frame}.png --tolerance 1");
        assert_eq!(place.run(&line).status.code(), Some(0), "{frame}");
    }
}

#[test]
fn only_frames_that_a_key_changes_are_rendered_again() {
    let place = Place::with_moves();
    let modified = |frame: u32| {
        let file = fs::metadata(place.at(&format!("f{frame}.png")));
        file.and_then(|file| file.modified()).expect("a picture")
    };
    let skipped = |count: u32| format!("note: {count} frames were already finished\n");
    place.stderr(LINE, 0);
    assert_eq!(place.stderr(LINE, 0), skipped(9));
    let before: Vec<_> = (0..9).map(modified).collect();
    // The key of frame 2 counts from 1 to 3.
    place.write(
        "moves.toml",
        MOVES.replace(
            "0.5, 0] },\n    { frame = 4",
            "0.75, 0] },\n    { frame = 4",
        ),
    );
    assert_eq!(place.stderr(LINE, 0), skipped(6));
    let after: Vec<_> = (0..9).map(modified).collect();
    let changed = (0..9).filter(|&frame| before[frame] != after[frame]);
    assert_eq!(changed.collect::<Vec<_>>(), [1, 2, 3]);
    // What is said otherwise, with the same values, changes nothing.
    let said = MOVES
        .replace("fps = 5", "fps = 6 # faster")
        .replace("the lamp", "light 1");
    place.write(
        "moves.toml",
        said.replace(
            "0.5, 0] },\n    { frame = 4",
            "0.75, 0] },\n    { frame = 4",
        ),
    );
    assert_eq!(place.stderr(LINE, 0), skipped(9));
    assert_eq!(place.stderr(&format!("{LINE} --again"), 0), "");
    assert_eq!(place.stderr(&format!("{LINE} --frames 2-4"), 0), skipped(3));
    place.write("still.ray", STILL.replace(".2 .2 .2", ".3 .2 .2"));
    assert_eq!(place.stderr(LINE, 0), "");
}

#[test]
fn frames_of_a_track_are_chosen_sharded_and_put_into_one_file() {
    let place = Place::with_moves();
    place.stderr(&format!("{LINE} --frames 2-6 --shard 1/3"), 0);
    let pictures = |place: &Place| -> Vec<_> {
        let names = place.names().into_iter();
        names.filter(|name| name.contains(".png")).collect()
    };
    assert_eq!(pictures(&place), ["f4.png"]);
    let said = place.stderr(&format!("{LINE} --frames 2-9"), 2);
    assert_eq!(
        said,
        "error: --frames 2-9: there are 9 frames in all, numbered from 0\n"
    );
    for (options, rate) in [("", "F5:1"), ("--fps 7", "F7:1")] {
        place.stderr(
            &format!("render still.ray --track moves.toml -o a.y4m {options}"),
            0,
        );
        let movie = place.read("a.y4m");
        let header = movie.split(|&byte| byte == b'\n').next().expect("a line");
        assert!(String::from_utf8_lossy(header).contains(rate), "{options}");
        assert_eq!(movie.len(), header.len() + 1 + 9 * (6 + 3 * 20 * 15));
    }
    for (line, expected) in [
        ("--turntable 3", "--turntable"),
        ("--stats -", "for single pictures"),
    ] {
        let said = place.stderr(&format!("{LINE} {line}"), 2);
        assert!(said.contains(expected), "{line}: {said}");
    }
    let said = place.stderr("render still.ray --track moves.toml -o a.png", 2);
    assert!(
        said.contains("no placeholder for the frame number"),
        "{said}"
    );
}

#[test]
fn errors_are_shown_beside_the_text() {
    let place = Place::with_moves();
    let wrong = MOVES
        .replace("object 1", "objct 1")
        .replace("colour red", "color red")
        .replace("frame = 4", "frame = 1");
    place.write("moves.toml", wrong);
    let said = place.stderr(LINE, 65);
    for expected in [
        "error: moves.toml:5:9: nothing in the scene is called `objct 1`\n",
        "5 | thing = \"objct 1\"\n",
        "help: did you mean object 1?\n",
        "error: moves.toml:10:15: frame 1 comes after frame 2\n",
        "error: moves.toml:16:9: light 1 has no field called `color red`\n",
        "error: nothing was rendered: the track has 3 errors\n",
    ] {
        assert!(said.contains(expected), "{expected}: {said}");
    }
    // Errors of the scene are shown with those of the track.
    place.write("still.ray", STILL.replace(" .4   ", " -1   "));
    let said = place.stderr(LINE, 65);
    assert!(
        said.contains("still.ray:3:") && said.contains("moves.toml:10:15"),
        "{said}"
    );
    // Values that are wrong only together are shown in the text of their frame.
    place.write("still.ray", STILL);
    place.write("moves.toml", "frames = 3\n[camera]\nkeys = [{ frame = 0, eye = [0, 0, 5] }, { frame = 2, eye = [0, 0, -5] }]");
    let said = place.stderr(LINE, 65);
    assert!(
        said.contains("still.ray:5:14: frame 1: view target: coincides with the eye"),
        "{said}"
    );
    assert!(place.at("f0.png").exists() && !place.at("f1.png").exists());
    // Warnings are said once, and refused if so wished.
    place.write("moves.toml", MOVES.replace("frame = 6", "frame = 16"));
    let said = place.stderr(&format!("{LINE} --again"), 0);
    assert_eq!(said.matches("warning:").count(), 1, "{said}");
    place.stderr(&format!("{LINE} --strict"), 65);
    place.stderr("render still.ray --track none.toml -o f%d.png", 66);
}

#[test]
fn the_example_track_renders() {
    let place = Place::new();
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes");
    let line = format!("render {scenes}/default.ray --track {scenes}/default.toml");
    let said = place.stderr(&format!("{line} -o f%02d.ppm --size 16x12 --shard 3/12"), 0);
    assert_eq!(said, "");
    let pictures: Vec<_> = [3, 15, 27, 39]
        .map(|frame| place.read(&format!("f{frame:02}.ppm")))
        .into();
    for (at, picture) in pictures.iter().enumerate() {
        assert!(pictures[..at].iter().all(|other| other != picture), "{at}");
    }
}

#[test]
fn a_track_is_not_overwritten_and_excludes_a_turntable() {
    let place = Place::with_moves();
    let line = "render still.ray --track moves.toml -o moves.toml --format gif";
    let said = place.stderr(line, 2);
    assert!(said.contains("cannot overwrite moves.toml"), "{said}");
}
