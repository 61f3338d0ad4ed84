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
            "render box.ray -o a.gif --turntable 2 --fps 51",
            "a .gif has at most 50 frames per second, not 51",
        ),
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
