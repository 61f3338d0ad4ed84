//! The recipes of tests/recipes, run as they are: each makes the picture of a single render.

use std::path::Path;

use super::*;

/// Runs a recipe with the program on the path, and returns the picture.
#[cfg(unix)]
fn cooked(place: &Place, recipe: &str, options: &str) -> Vec<u8> {
    let folder = Path::new(BINARY).parent().expect("it is in a folder");
    let path = std::env::var("PATH").expect("a path");
    let recipe = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/recipes")
        .join(recipe);
    let mut command = Command::new("bash");
    command
        .arg(recipe)
        .args(["ball.ray", "out.png", "3"])
        .args(options.split_ascii_whitespace())
        .env("PATH", format!("{}:{path}", folder.display()))
        .current_dir(place.directory.path());
    let output = command.output().expect("it starts");
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    place.read("out.png")
}

#[cfg(unix)]
fn assert_cooks(recipe: &str) {
    const OPTIONS: &str = "--size 100x40 --spp 4";
    let place = Place::new();
    place.stderr(&format!("render ball.ray -o whole.png {OPTIONS}"), 0);
    let whole = place.read("whole.png");
    assert!(cooked(&place, recipe, OPTIONS) == whole);
    // Run again after one shard was lost.
    fs::remove_file(place.at("out.1-3.part")).expect("it is there");
    fs::remove_file(place.at("out.png")).expect("it is there");
    let _ = fs::remove_file(place.at("out.joblog"));
    assert!(cooked(&place, recipe, OPTIONS) == whole);
}

#[test]
#[cfg(unix)]
fn a_loop_renders_shards() {
    assert_cooks("loop.sh");
}

/// Where GNU parallel is installed.
#[test]
#[cfg(unix)]
fn gnu_parallel_renders_shards() {
    let version = Command::new("parallel").arg("--version").output();
    if version.is_ok_and(|version| version.stdout.starts_with(b"GNU parallel")) {
        assert_cooks("parallel.sh");
    }
}
