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
    let end = "error: frame 1 was not rendered: its scene has 1 error\n";
    assert!(said.ends_with(end), "{said}");
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

/// The same frames in another format, or with other digits, have lines of their own in the list.
#[test]
fn pictures_with_other_names_are_finished_too() {
    let place = Place::with_box();
    let render = |name: &str| {
        let line = format!("render box.ray --turntable 2 -o {name} --size 8x6 --spp 1");
        place.stderr(&line, 0)
    };
    for name in ["t.%d.png", "t.%d.bmp", "t.%03d.png"] {
        assert_eq!(render(name), "", "{name}");
    }
    for name in ["t.%d.png", "t.%d.bmp", "t.%03d.png"] {
        assert_eq!(render(name), "note: 2 frames were already finished\n");
    }
}

#[test]
fn only_lists_of_frames_are_appended_to() {
    let place = Place::with_box();
    let line = "render box.ray --turntable 2 -o t.%d.bmp --size 8x6 --spp 1";
    place.stderr(line, 0);
    let list = place.read("t.frames");
    // What a killed process leaves: nothing, a part of the first line, a part of a later one.
    for length in [0, 9, list.len() - 5] {
        place.write("t.frames", &list[..length]);
        place.stderr(line, 0);
        let skipped = place.stderr(line, 0);
        assert_eq!(
            skipped, "note: 2 frames were already finished\n",
            "{length}"
        );
    }
    for content in [&b"my notes\n"[..], b"\xff\xfe", b"halflight part 1\n"] {
        place.write("t.frames", content);
        let said = place.stderr(line, 73);
        assert_eq!(
            said,
            "error: t.frames: exists, but is not a list of finished frames; move it away, or name \
             the pictures differently\n"
        );
        assert!(place.read("t.frames") == content);
    }
    fs::remove_file(place.at("t.frames")).expect("it is there");
    std::os::unix::fs::symlink("box.ray", place.at("t.frames")).expect("it is new");
    let said = place.stderr(line, 2);
    assert!(said.contains("it is a file of the sequence"), "{said}");
    fs::remove_file(place.at("t.frames")).expect("it is there");
    let made = Command::new("mkfifo").arg(place.at("t.frames")).status();
    assert!(made.expect("it starts").success());
    let said = place.stderr(line, 73);
    assert!(said.contains("is a pipe, where the list"), "{said}");
}

/// A tiny frame, and one that takes minutes.
#[test]
fn signals_keep_finished_frames() {
    let place = Place::with_box();
    fs::create_dir(place.at("shots")).expect("it is new");
    place.write("shots/a.ray", BALL);
    place.write("shots/b.ray", BOX.replace("size 40 30", "size 900 900"));
    let list = place.at("f.frames");
    for (signal, options, without, code) in [
        ("TERM", "", "", 75),
        ("USR1", "--again", "without --again ", 75),
        ("INT", "--again", "without --again ", 130),
    ] {
        let line = format!("render shots -o f%d.bmp --spp 512 {options}");
        let length = fs::metadata(&list).map_or(0, |list| list.len());
        let child = parts::begun(&place, &line, &list, length);
        parts::send(signal, &child);
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(code), "{output:?}");
        assert_eq!(
            String::from_utf8_lossy(&output.stderr),
            format!(
                "error: stopped by SIG{signal} at frame 1; finished frames are kept: rerun \
                 {without}to continue\n"
            )
        );
        let said = place.stderr("render shots -o f%d.bmp --spp 512 --frames 0", 0);
        assert_eq!(said, "note: 1 frame was already finished\n");
    }
}

#[test]
fn progress_tells_frames_and_the_end_apart() {
    let place = Place::with_box();
    let events = |options: &str| {
        let line = format!("render box.ray --size 70x40 --spp 4 --progress json {options}");
        let said = place.stderr(&line, 0);
        let lines = said.lines().filter(|line| line.starts_with('{'));
        let objects = lines.map(|line| serde_json::from_str(line).expect("JSON"));
        let objects: Vec<serde_json::Value> = objects.collect();
        let finished = objects
            .into_iter()
            .filter(|object| object["event"] != "progress");
        finished.collect::<Vec<_>>()
    };
    for options in ["-o t%d.bmp --turntable 2", "-o t.gif --turntable 2"] {
        let said = events(options);
        let frames: Vec<_> = said.iter().map(|object| &object["frame"]).collect();
        assert_eq!(said.len(), 3, "{said:?}");
        assert_eq!(frames[..2], [0, 1]);
        assert!(said[..2].iter().all(|object| object["event"] == "frame"));
        assert_eq!(
            (&said[2]["event"], &said[2]["frames"]),
            (&"done".into(), &2.into())
        );
    }
    // A picture that is kept in a part has the same figures.
    let [whole, resumed] = ["-o a.bmp", "-o b.bmp --resume"].map(events);
    assert_eq!((whole.len(), resumed.len()), (1, 1));
    for key in ["event", "done", "spp", "noise", "rays", "left"] {
        assert!(!whole[0][key].is_null());
        assert_eq!(whole[0][key], resumed[0][key], "{key}");
    }
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
    // Whoever finished them.
    for options in ["0/3", "0/1"] {
        let said = place.stderr(&format!("{line} {options}"), 0);
        assert!(said.ends_with("already finished\n"), "{said}");
    }
    assert!(!place.at("t.frames").exists());
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
        (
            "render box.ray -o a.png --frames 0-1",
            "--frames needs --turntable",
        ),
        (
            "render box.ray -o a.png --again",
            "--again needs --turntable",
        ),
        ("render box.ray -o a.gif --fps 5", "--fps needs --turntable"),
        ("render box.ray -o a.y4m", "y4m needs --turntable"),
        ("render box.ray -o a%05d.png", "a%05d.png needs --turntable"),
        (
            "render box.ray -o a%d.png --turntable 2 --fps 5",
            "--fps is for .y4m and .gif",
        ),
        (
            "render box.ray -o a.gif --turntable 2 --again",
            "--again has no finished frames to go by",
        ),
        (
            "render box.ray -o a.y4m --turntable 2 --resume",
            "--resume has no finished frames to go by",
        ),
        (
            "render box.ray -o a%d.png --turntable 2 --resume --again",
            "cannot be used with",
        ),
        (
            "render . -o a.png",
            ". is a folder, which makes a sequence, but a.png has no placeholder",
        ),
        (
            "render . -o -",
            "-o - takes a sequence with --format y4m or gif",
        ),
        (
            "render . -o a%d.png --turntable 2",
            "--turntable needs one scene, but . is a folder",
        ),
        (
            "render . -o a%d.png --track a.toml",
            "--track needs one scene, but . is a folder",
        ),
        ("render . -o a%02d/x.png", "has %d in the name of a folder"),
        (
            "render . -o a%3d.png",
            "has a % that does not begin %d or, with",
        ),
        ("render . -o a%05d%05d.png", "has more than one %"),
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
