//! Scripts of keys: each of `tests/keys` ends in the screen beside it, on every machine.
//!
//! With `UPDATE_FRAMES` set, the screens are written instead of compared.

use std::fs;
use std::path::{Path, PathBuf};

use super::*;

const DEFAULT: &str = include_str!("../../scenes/default.ray");

/// The last screen after the keys of a script, and the place where they were pressed.
fn played(keys: &Path, size: &str) -> (String, Place) {
    let place = Place::new();
    place.write("default.ray", DEFAULT);
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
    assert_eq!(place.names(), ["ball.ray", "default.ray", "screen.txt"]);
}

#[test]
fn the_picture_in_the_readme_can_be_made_again() {
    let (screen, _) = played(&root().join("scenes/interface.keys"), "80x24");
    assert!(
        screen.contains("EDIT") && screen.contains("the glas"),
        "{screen}"
    );
}

#[test]
fn an_error_in_a_script_is_reported_at_its_place() {
    let place = Place::new();
    for (keys, reason) in [
        ("j\n Entr", "bad.keys:2:2: unknown key Entr"),
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
