//! The recipes of tests/recipes, run as they are: each makes the picture of a single render.

use std::path::Path;

use super::*;

/// Runs a recipe with the program on the path, and returns the picture.
#[cfg(unix)]
fn cooked(place: &Place, recipe: &str, options: &str) -> Vec<u8> {
    assert!(cook(place, recipe, ["ball.ray", "out.png", "3"], options));
    place.read("out.png")
}

/// Runs a recipe with the program on the path; whether it succeeds.
#[cfg(unix)]
fn cook(place: &Place, recipe: &str, arguments: [&str; 3], options: &str) -> bool {
    let folder = Path::new(BINARY).parent().expect("it is in a folder");
    let path = std::env::var("PATH").expect("a path");
    let recipe = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/recipes")
        .join(recipe);
    let mut command = Command::new("bash");
    command
        .arg(recipe)
        .args(arguments)
        .args(options.split_ascii_whitespace())
        .env("PATH", format!("{}:{path}", folder.display()))
        .current_dir(place.directory.path());
    let output = command.output().expect("it starts");
    eprintln!("{}", String::from_utf8_lossy(&output.stderr));
    output.status.success()
}

#[cfg(unix)]
fn assert_cooks(recipe: &str) {
    const OPTIONS: &str = "--size 100x40 --spp 4";
    const MORE: &str = "--size 100x40 --spp 8";
    let place = Place::new();
    place.stderr(&format!("render ball.ray -o whole.png {OPTIONS}"), 0);
    let whole = place.read("whole.png");
    assert!(cooked(&place, recipe, OPTIONS) == whole);
    // Run again after one shard was lost.
    fs::remove_file(place.at("out.1-3.part")).expect("it is there");
    fs::remove_file(place.at("out.png")).expect("it is there");
    assert!(cooked(&place, recipe, OPTIONS) == whole);
    // With more samples, it goes on from there; of another scene, nothing is taken over.
    place.stderr(&format!("render ball.ray -o more.png {MORE}"), 0);
    assert!(cooked(&place, recipe, MORE) == place.read("more.png"));
    place.write("ball.ray", format!("{BALL}// another\n"));
    let three = ["ball.ray", "out.png", "3"];
    assert!(!cook(&place, recipe, three, MORE));
    // Names mean nothing to a shell.
    let (scene, picture) = ("my scene.ray", "a;touch x;.png");
    place.write(scene, BALL);
    assert!(cook(&place, recipe, [scene, picture, "2"], MORE));
    assert!(place.read(picture) == place.read("more.png"));
    assert!(!place.at("x").exists());
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
