//! Exporting a track in the interface.

use super::*;

/// Plays keys over the scene with its track, and asserts the exit code.
#[track_caller]
fn play(place: &Place, keys: &str) -> String {
    place.write("play.keys", keys);
    let line = "still.ray --screen 100x24 --keys play.keys --dump-frame screen.txt";
    place.stderr(line, 0);
    String::from_utf8(place.read("screen.txt")).expect("text")
}

/// The interface and the command line write the same files.
#[test]
fn an_exported_sequence_is_that_of_a_render() {
    let place = Place::with_moves();
    fs::create_dir(place.at("ui")).expect("it is new");
    for (name, size, frames) in [
        ("a.gif", "", &["a.gif"][..]),
        ("a.y4m", " 16x12 2", &["a.y4m"]),
        ("a%d.png", " 16x12 4", &["a0.png", "a8.png"]),
        ("a.%03d.exr", " 16x12 2", &["a.000.exr", "a.005.exr"]),
        ("%d.bmp", "", &["0.bmp", "1.bmp", "8.bmp"]),
    ] {
        let keys = format!(
            ": \"track moves.toml\" Enter wait l l : \"export ui/{name}{size}\" Enter wait"
        );
        let screen = play(&place, &keys);
        assert!(
            screen.contains(&format!("wrote ui/{name}: 9 frames")),
            "{screen}"
        );
        assert!(screen.contains("SEQUENCE   frame 2 (3/9)"), "{screen}");
        let options = match size.trim().split_once(' ') {
            Some((size, spp)) => format!(" --size {size} --spp {spp}"),
            None => String::new(),
        };
        place.stderr(
            &format!("render still.ray --track moves.toml -o {name}{options}"),
            0,
        );
        for frame in frames {
            let same = place.read(&format!("ui/{frame}")) == place.read(frame);
            assert!(same, "{frame}");
        }
    }
}

#[test]
fn the_default_is_a_gif_beside_the_scene() {
    let place = Place::with_moves();
    let screen = play(&place, ": \"track moves.toml\" Enter wait b wait");
    assert!(
        screen.contains("wrote still.gif: 9 frames, 20×15, 16 spp"),
        "{screen}"
    );
    place.stderr("render still.ray --track moves.toml -o a.gif", 0);
    assert!(place.read("still.gif") == place.read("a.gif"));
}

#[test]
fn no_file_of_others_is_replaced_and_no_part_of_one_is_left() {
    let place = Place::with_moves();
    place.write("a5.png", "theirs");
    fs::create_dir(place.at("full")).expect("it is new");
    for (command, said) in [
        (
            "export a%d.png 8x6 1",
            "a5.png exists: use :export! a%d.png to overwrite it",
        ),
        ("export none/a.gif", "none/a.gif: no such folder"),
        (
            "export moves.toml",
            "moves.toml has no placeholder for the frame number",
        ),
        (
            "export! still.ray",
            "still.ray has no placeholder for the frame number",
        ),
    ] {
        let before = place.names();
        let screen = play(
            &place,
            &format!(": \"track moves.toml\" Enter wait : \"{command}\" Enter wait M"),
        );
        assert!(screen.contains(said), "{command}: {screen}");
        let mut names = place.names();
        names.retain(|name| !["play.keys", "screen.txt"].contains(&name.as_str()));
        let mut before = before;
        before.retain(|name| !["play.keys", "screen.txt"].contains(&name.as_str()));
        assert_eq!(names, before, "{command}");
    }
    assert_eq!(place.read("a5.png"), b"theirs");
    // A shorter track: no other file is replaced, and none is left.
    place.write(
        "moves.toml",
        "frames = 3\n[[track]]\nthing = \"object 1\"\nfield = \"radius\"\n\
         keys = [{ frame = 0, value = 0.4 }, { frame = 2, value = 0.1 }]\n",
    );
    let screen = play(
        &place,
        ": \"track moves.toml\" Enter wait : \"export! a%d.png 8x6 1\" Enter wait",
    );
    assert!(screen.contains("wrote a%d.png: 3 frames"), "{screen}");
    assert_eq!(place.read("a5.png"), b"theirs");
    let names = place.names();
    assert!(names.iter().all(|name| !name.starts_with('.')), "{names:?}");
}

/// A sequence needs every file of its scene.
#[test]
fn a_sequence_without_all_files_is_not_written() {
    let place = Place::new();
    place.write("still.ray", BALL);
    place.write("a.dat", TEXTURED);
    place.write(
        "a.toml",
        "frames = 2\n[orbit]\nkeys = [{ frame = 0, azimuth = 0 }, { frame = 1, azimuth = 90 }]\n",
    );
    place.write("play.keys", "T wait : \"export a.gif 8x6 1\" Enter wait M");
    let line = "a.dat --screen 100x24 --keys play.keys --dump-frame screen.txt";
    place.stderr(line, 0);
    let screen = String::from_utf8(place.read("screen.txt")).expect("text");
    assert!(
        screen.contains("frame 0: a sequence needs every file of its scene"),
        "{screen}"
    );
    assert!(!place.at("a.gif").exists());
}
