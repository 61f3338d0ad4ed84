//! Sequences: turns of a view, scenes of a folder, and files that hold all frames.

use super::*;

/// A box that looks different from every side, seen from (0, 0, 5).
const BOX: &str = "\
1 1 1
1 9 0 9 .5 .5 .5
2 box -.5 -.5 -.5 1 0 0 0 1 0 0 0 1 1 1 1  .2 .1 .1 .5 .5 .5 0 0 0 1 0 0 1
  sphere .5 .5 .5 .3  .1 .2 .1 .5 .5 .5 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 40 30
";

impl Place {
    fn with_box() -> Self {
        let place = Self::new();
        place.write("box.ray", BOX);
        place
    }
}

/// A quarter turn brings the eye to (5, 0, 0), as if the scene had said so.
#[test]
fn a_turntable_goes_round_the_target() {
    let place = Place::with_box();
    place.stderr("render box.ray --turntable 4 -o turn.%02d.bmp --spp 2", 0);
    for (frame, eye) in [(0, "0 0 5"), (1, "5 0 0"), (2, "0 0 -5"), (3, "-5 0 0")] {
        place.write("side.ray", BOX.replace("eye 0 0 5", &format!("eye {eye}")));
        place.stderr("render side.ray -o side.bmp --spp 2", 0);
        let name = format!("turn.{frame:02}.bmp");
        let line = format!("compare {name} side.bmp --tolerance 1 --max-differing 12");
        assert_eq!(place.run(&line).status.code(), Some(0), "{name}");
    }
    // The first frame is the scene itself.
    place.stderr("render box.ray -o whole.bmp --spp 2", 0);
    assert!(place.read("turn.00.bmp") == place.read("whole.bmp"));
}

#[test]
fn the_scenes_of_a_folder_are_frames_in_the_order_of_their_names() {
    let place = Place::with_box();
    fs::create_dir(place.at("shots")).expect("it is new");
    place.write("shots/b.ray", BALL);
    place.write("shots/a.ray", BOX);
    place.write("shots/readme.txt", "no scene");
    place.stderr("render shots -o f%d.ppm --frames 1", 0);
    place.stderr("render shots -o f%d.ppm", 0);
    for (scene, frame) in [("box.ray", "f0.ppm"), ("ball.ray", "f1.ppm")] {
        place.stderr(&format!("render {scene} -o one.ppm"), 0);
        assert!(place.read(frame) == place.read("one.ppm"), "{frame}");
    }
    let said = place.stderr("render shots -o f%d.ppm --frames 1-2", 2);
    assert_eq!(
        said,
        "error: --frames 1-2: there are 2 frames in all, numbered from 0\n"
    );
    // An invalid scene names itself, after the frames before it.
    place.write("shots/a2.ray", "1 1 1\n");
    let said = place.stderr("render shots -o g%d.ppm", 65);
    assert!(said.contains("shots/a2.ray:"), "{said}");
    assert!(place.at("g0.ppm").exists() && !place.at("g1.ppm").exists());
}

#[test]
fn finished_frames_are_skipped_unless_anything_has_changed() {
    let place = Place::with_box();
    let line = "render box.ray --turntable 3 -o t.%d.png --size 20x15";
    let skipped = |line: &str| place.stderr(line, 0);
    assert_eq!(skipped(line), "");
    assert_eq!(skipped(line), "note: 3 frames were already finished\n");
    let pictures: Vec<_> = (0..3)
        .map(|frame| place.read(&format!("t.{frame}.png")))
        .collect();
    // A picture that is gone, and one that was changed.
    fs::remove_file(place.at("t.0.png")).expect("it is there");
    place.write("t.1.png", "no picture");
    assert_eq!(skipped(line), "note: 1 frame was already finished\n");
    for (frame, picture) in pictures.iter().enumerate() {
        assert!(place.read(&format!("t.{frame}.png")) == *picture);
    }
    assert_eq!(skipped(&format!("{line} --again")), "");
    assert_eq!(skipped(&format!("{line} --spp 2")), "");
    place.write("box.ray", BOX.replace(".5 .5 .5 .3", ".5 .5 .5 .4"));
    assert_eq!(skipped(&format!("{line} --spp 2")), "");
    assert_eq!(
        skipped(&format!("{line} --spp 2")),
        "note: 3 frames were already finished\n"
    );
}

#[test]
fn shards_of_a_sequence_have_every_nth_frame() {
    let place = Place::with_box();
    let line = "render box.ray --turntable 5 -o t.%d.bmp --size 20x15 --shard";
    place.stderr(&format!("{line} 1/2"), 0);
    let frames = |place: &Place| -> Vec<_> {
        let names = place.names().into_iter();
        names.filter(|name| name.contains(".bmp")).collect()
    };
    assert_eq!(frames(&place), ["t.1.bmp", "t.3.bmp"]);
    place.stderr(&format!("{line} 0/2"), 0);
    assert_eq!(frames(&place).len(), 5);
}

#[test]
fn one_file_holds_all_frames() {
    let place = Place::with_box();
    let options = "--turntable 3 --size 16x12";
    let output = place.run(&format!("render box.ray -o - --format y4m {options}"));
    assert_eq!(output.status.code(), Some(0));
    let header = b"YUV4MPEG2 W16 H12 F24:1 Ip A1:1 C444 XCOLORRANGE=LIMITED\n";
    assert_eq!(output.stdout.len(), header.len() + 3 * (6 + 3 * 16 * 12));
    assert!(output.stdout.starts_with(header));
    place.stderr(&format!("render box.ray -o a.y4m {options}"), 0);
    assert!(place.read("a.y4m") == output.stdout);
    place.stderr(&format!("render box.ray -o a.gif --fps 10 {options}"), 0);
    assert!(place.read("a.gif").starts_with(b"GIF89a"));
    for (line, expected) in [
        (
            "render box.ray -o a.png --turntable 3",
            "no placeholder for the frame number",
        ),
        (
            "render box.ray -o a.y4m --turntable 3 --shard 0/2",
            "one file per frame",
        ),
        ("render box.ray -o a.png --frames 0-1", "need --turntable"),
        ("render box.ray -o a.bmp --format y4m", "needs --turntable"),
        (
            "render box.ray -o a%d.png --turntable 3 --frames 2-1",
            "such as 0-99",
        ),
        (
            "render box.ray -o a%d.png --turntable 3 --stats -",
            "for single pictures",
        ),
        ("render . -o a%d.png --turntable 0", "--turntable"),
        (
            "render box.ray -o box.ray --format gif --turntable 2",
            "cannot overwrite box.ray: it is a file of the sequence",
        ),
    ] {
        let said = place.stderr(line, 2);
        assert!(said.contains(expected), "{line}: {said}");
    }
    fs::create_dir(place.at("empty")).expect("it is new");
    let said = place.stderr("render empty -o a%d.png", 2);
    assert_eq!(said, "error: empty: there are no scenes in this folder\n");
}

const TRACK: &str = "\
frames = 6
fps = 5

[[track]]
thing = \"object 2\"
field = \"radius\"
keys = [{ frame = 0, value = 0.3 }, { frame = 2, value = 0.5 }, { frame = 4, value = 0.3 }]

[camera]
keys = [{ frame = 3, eye = [0, 0, 5] }, { frame = 5, eye = [5, 0, 0] }]
";

/// A frame of a track is a scene like any other: with these values in its text.
#[test]
fn a_track_gives_the_pictures_of_edited_scenes() {
    let place = Place::with_box();
    place.write("box.toml", TRACK);
    let line = "render box.ray --track box.toml -o t%d.ppm --spp 2";
    place.stderr(line, 0);
    for (frame, radius, eye) in [
        (0, ".3", "0 0 5"),
        (1, "0.4", "0 0 5"),
        (2, "0.5", "0 0 5"),
        (4, ".3", "2.5 0 2.5"),
        (5, ".3", "5 0 0"),
    ] {
        let edited = BOX
            .replace(".5 .5 .5 .3 ", &format!(".5 .5 .5 {radius} "))
            .replace("eye 0 0 5", &format!("eye {eye}"));
        place.write("one.ray", edited);
        place.stderr("render one.ray -o one.ppm --spp 2", 0);
        assert!(
            place.read(&format!("t{frame}.ppm")) == place.read("one.ppm"),
            "{frame}"
        );
    }
    // A key that is changed changes the frames beside it only.
    place.write(
        "box.toml",
        TRACK.replace("frame = 4, value = 0.3", "frame = 4, value = 0.2"),
    );
    assert_eq!(
        place.stderr(line, 0),
        "note: 3 frames were already finished\n"
    );
    assert_eq!(
        place.stderr(line, 0),
        "note: 6 frames were already finished\n"
    );
    assert_eq!(place.stderr(&format!("{line} --again --frames 2-3"), 0), "");
    // A movie has the track's rate, unless another is asked for.
    for (options, rate) in [("", "F5:1"), ("--fps 7", "F7:1")] {
        let line =
            format!("render box.ray --track box.toml -o - --format y4m --size 8x6 {options}");
        let output = place.run(&line);
        let header = String::from_utf8_lossy(&output.stdout[..40]).into_owned();
        assert!(header.contains(rate), "{header}");
    }
}

#[test]
fn errors_in_tracks_are_shown_at_their_places() {
    let place = Place::with_box();
    for (track, code, expected) in [
        (
            TRACK.replace("object 2", "object 3"),
            65,
            "error: box.toml:5:9: nothing in the scene is called `object 3`",
        ),
        // Valid keys, but between them the camera passes through its target.
        (
            TRACK.replace("eye = [5, 0, 0]", "eye = [0, 0, -5]"),
            65,
            "note: the text is that of frame 4\n",
        ),
        (
            TRACK.replace("frames = 6", "frames = 4"),
            0,
            "warning: box.toml:7:",
        ),
    ] {
        place.write("box.toml", track);
        let line = "render box.ray --track box.toml -o t%d.ppm --size 8x6 --spp 1";
        let said = place.stderr(line, code);
        assert!(said.contains(expected), "{said}");
    }
    place.stderr("render box.ray --track none.toml -o t%d.ppm", 66);
    place.stderr(
        "render box.ray --track box.toml --turntable 3 -o t%d.ppm",
        2,
    );
    let said = place.stderr(
        "render box.ray --track box.toml -o box.toml --format gif",
        2,
    );
    assert!(said.contains("cannot overwrite box.toml"), "{said}");
}

/// The example in the repository.
#[test]
fn the_track_beside_the_default_scene_is_valid() {
    let place = Place::new();
    let scenes = concat!(env!("CARGO_MANIFEST_DIR"), "/scenes/default");
    let options = "--size 20x15 --spp 1 --frames 0-1 -o a%d.png";
    let said = place.stderr(
        &format!("render {scenes}.ray --track {scenes}.toml {options}"),
        0,
    );
    assert_eq!(said, "");
}
