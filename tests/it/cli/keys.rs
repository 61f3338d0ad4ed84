//! Scripts of keys: each of `tests/keys` ends in the screen beside it, on every machine.
//!
//! With `UPDATE_FRAMES` set, the screens are written instead of compared.

use std::fs;
use std::path::{Path, PathBuf};

use super::*;

const DEFAULT: &str = include_str!("../../../scenes/default.ray");
const TRACK: &str = include_str!("../../../scenes/default.toml");

/// The last screen after the keys of a script, and the place where they were pressed.
fn played(keys: &Path, size: &str) -> (String, Place) {
    let place = Place::new();
    place.write("default.ray", DEFAULT);
    place.write("default.toml", TRACK);
    let ran = Command::new(BINARY)
        .current_dir(place.at("."))
        .args(["--screen", size, "--dump-frame", "screen.txt", "--keys"])
        .arg(keys)
        .output()
        .expect("it starts");
    let errors = String::from_utf8_lossy(&ran.stderr).into_owned();
    assert!(ran.status.success(), "{}: {errors}", keys.display());
    let screen = String::from_utf8(place.read("screen.txt")).expect("text");
    (screen, place)
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn each_script_ends_in_its_screen() {
    let folder = fs::read_dir(root().join("tests/keys")).expect("a folder");
    let paths = folder.map(|entry| entry.expect("an entry").path());
    let is_script = |path: &PathBuf| path.extension().is_some_and(|name| name == "keys");
    for keys in paths.filter(is_script) {
        let (screen, _) = played(&keys, "80x24");
        let kept = keys.with_extension("txt");
        if std::env::var_os("UPDATE_FRAMES").is_some() {
            fs::write(&kept, &screen).expect("writable");
        }
        let expected = fs::read_to_string(&kept).unwrap_or_default();
        assert_eq!(screen, expected, "{}:\n{screen}", keys.display());
    }
}

#[test]
fn saved_edits_reach_the_file_and_nothing_else_is_written() {
    let (_, place) = played(&root().join("tests/keys/view.keys"), "80x24");
    let saved = String::from_utf8(place.read("default.ray")).expect("text");
    assert_ne!(saved, DEFAULT);
    let names = ["ball.ray", "default.ray", "default.toml", "screen.txt"];
    assert_eq!(place.names(), names);
}

/// The keys of the tutorial: the indented lines after its heading.
fn tutorial() -> String {
    let page = fs::read_to_string(root().join("scenes/README.md")).expect("a page");
    let heading = "## From an empty file to the default scene\n";
    let (_, steps) = page.split_once(heading).expect("the tutorial is there");
    let is_key = |line: &&str| line.starts_with("       ");
    steps.lines().filter(is_key).collect::<Vec<_>>().join("\n")
}

#[test]
fn the_tutorial_builds_the_default_scene() {
    let place = Place::new();
    place.write("default.ray", DEFAULT);
    place.write("tutorial.keys", tutorial());
    place.run("evening.ray --keys tutorial.keys --screen 112x40");
    let compared = place.run("compare evening.ray default.ray --size 80x60 --spp 1");
    let figures = String::from_utf8_lossy(&compared.stdout);
    assert_eq!(compared.status.code(), Some(0), "{figures}");
    let evening = String::from_utf8(place.read("evening.ray")).expect("text");
    assert!(
        evening.contains("// view front: eye 0.6 3.1 9.6 "),
        "{evening}"
    );
}

/// Lights, a mesh, values of their own, motions, copies, a name and a view, without an editor.
#[test]
fn twenty_steps_build_a_scene_of_commands() {
    let place = Place::new();
    place.write("steps.keys", include_str!("evening.keys"));
    place.run("evening.test --keys steps.keys --screen 112x40");
    let evening = String::from_utf8(place.read("evening.test")).expect("text");
    assert_eq!(evening, include_str!("evening.test"));
}

#[test]
fn a_script_sees_no_scenes_of_other_runs() {
    let place = Place::new();
    place.write("recent.keys", "\":recent\" Enter");
    let (screen, _) = played(&place.at("recent.keys"), "100x30");
    assert!(screen.contains("no recently used scenes"), "{screen}");
}

/// An outline that changes cannot be drawn there, and must not be waited for.
#[test]
fn edits_in_a_terminal_without_room_for_the_picture_are_taken() {
    let place = Place::new();
    place.write("tiny.keys", "G resize 2x6 d resize 80x24");
    let (screen, _) = played(&place.at("tiny.keys"), "80x24");
    assert!(screen.contains("[+]"), "{screen}");
}

#[test]
fn a_screen_has_the_colours_of_its_terminal() {
    let place = Place::new();
    place.write("default.ray", DEFAULT);
    for (colours, codes) in [("mono", 0..30), ("16", 0..108), ("256", 0..256)] {
        let words = format!("default.ray --color {colours} --screen 60x20 --dump-frame a.ansi");
        place.stderr(&words, 0);
        let screen = String::from_utf8(place.read("a.ansi")).expect("text");
        let styles = screen.split("\x1b[").skip(1);
        for style in styles.filter_map(|style| style.split_once('m')) {
            assert!(!style.0.contains("8;2;"), "{colours}: {style:?}");
            assert!(
                colours == "256" || !style.0.contains("8;5;"),
                "{colours}: {style:?}"
            );
            let mut numbers = style.0.split(';').filter_map(|code| code.parse().ok());
            assert!(
                numbers.all(|code: i32| codes.contains(&code)),
                "{colours}: {style:?}"
            );
        }
    }
}

#[test]
fn a_screen_never_replaces_a_file_that_the_scene_uses() {
    let place = Place::new();
    let text = TEXTURED.replace("skin.ppm", "skin.png");
    place.write("a.dat", &text);
    place.write("skin.png", SKIN);
    place.write("dump.keys", "dump skin.png");
    for words in ["--dump-frame skin.png", "--keys dump.keys"] {
        let errors = place.stderr(&format!("a.dat {words}"), 73);
        assert!(errors.contains("skin.png: the scene uses it"), "{errors}");
        assert_eq!(place.read("skin.png"), SKIN.as_bytes());
    }
}

/// The interface does not read the files of a text with errors.
#[test]
fn a_screen_never_replaces_a_file_that_a_scene_with_errors_uses() {
    const MESH: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n";
    const XML: &str = "<xml><scene><object type=\"obj\" name=\"a.obj\"/></scene><camera><fov \
                       value=\"x\"/></camera></xml>";
    let place = Place::new();
    place.write("a.obj", MESH);
    place.write("a.mtl", "newmtl a\nmap_Kd skin.png\n");
    let textured = TEXTURED.replace("skin.ppm", "skin.png");
    for (name, text) in [
        ("a.dat", textured.replace("obj sphere", "obj sphre")),
        ("b.dat", textured.replace("image 1 1", "image 1 x")),
        ("c.xml", XML.to_owned()),
    ] {
        place.write(name, text);
        place.write("skin.png", SKIN);
        let errors = place.stderr(&format!("{name} --dump-frame skin.png"), 73);
        assert!(errors.contains("skin.png: the scene uses it"), "{errors}");
        assert_eq!(place.read("skin.png"), SKIN.as_bytes());
        place.stderr(&format!("{name} --dump-frame other.png"), 0);
    }
}

#[test]
fn a_wait_shows_the_next_frame_of_a_sequence_that_plays() {
    let place = Place::new();
    let last = |keys: &str| {
        place.write("a.keys", keys);
        played(&place.at("a.keys"), "80x24").0
    };
    let stepped = last("T wait l l wait");
    let playing = last("T wait Space wait wait");
    for screen in [stepped, playing] {
        let mut words = screen.split_ascii_whitespace();
        assert!(words.any(|word| word == "(3/48)"), "{screen}");
    }
}

#[test]
fn a_byte_order_mark_before_a_script_is_no_key() {
    let place = Place::new();
    let [plain, marked] = ["j", "\u{feff}j"].map(|keys| {
        place.write("a.keys", keys);
        played(&place.at("a.keys"), "80x24").0
    });
    assert_eq!(marked, plain);
}

#[test]
fn an_error_in_a_script_is_reported_at_its_place() {
    let place = Place::new();
    for (keys, reason) in [
        ("j\n Entr", "bad.keys:2:2: unknown key Entr"),
        ("\u{feff}Entr", "bad.keys:1:1: unknown key Entr"),
        (
            "q j",
            "bad.keys:1:3: the interface has ended before this step",
        ),
    ] {
        place.write("bad.keys", keys);
        let ran = Command::new(BINARY)
            .current_dir(place.at("."))
            .args(["ball.ray", "--keys", "bad.keys"])
            .output()
            .expect("it starts");
        let errors = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(65), "{errors}");
        assert!(errors.contains(reason), "{errors}");
    }
}
