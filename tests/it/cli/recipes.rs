//! The recipes of tests/recipes, run as they are: each makes the picture of a single render.

use std::path::Path;

use super::*;

/// Runs a recipe with the program on the path, and returns the picture.
fn cooked(place: &Place, recipe: &str, options: &str) -> Vec<u8> {
    assert!(cook(place, recipe, ["ball.ray", "out.png", "3"], options));
    place.read("out.png")
}

/// Runs a recipe with the program on the path; whether it succeeds.
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
    // Names mean nothing to a shell, and a dot in that of a folder begins no extension.
    let scene = "my scene.ray";
    place.write(scene, BALL);
    fs::create_dir(place.at("a.b")).expect("it is new");
    // Of another picture.
    place.write("out.again.x.0-2.part", "");
    for picture in ["a;touch x;.png", "out.again.png", "a.b/out.png"] {
        assert!(
            cook(&place, recipe, [scene, picture, "2"], MORE),
            "{picture}"
        );
        assert!(place.read(picture) == place.read("more.png"), "{picture}");
    }
    assert!(!cook(&place, recipe, [scene, "a.b/out", "2"], MORE));
    assert!(!place.at("x").exists());
    assert_counts(recipe, &["ball.ray", "out.png"]);
}

/// Runs a recipe with numbers that are none; no command in them is run.
fn assert_counts(recipe: &str, before: &[&str]) {
    let place = Place::new();
    // The scheduler does nothing.
    place.write("sbatch", "#!/bin/sh\n");
    let executable = std::os::unix::fs::PermissionsExt::from_mode(0o700);
    fs::set_permissions(place.at("sbatch"), executable).expect("it is ours");
    for (shards, tries) in [
        ("BASH_VERSINFO[$(touch x)0]", "3"),
        ("3", "BASH_VERSINFO[$(touch x)0]"),
        ("0x3", "3"),
        ("-1", "3"),
        ("1e3", "3"),
        ("99999999999999999999", "3"),
        ("", "3"),
    ] {
        if shards == "3" && !recipe.ends_with("merge.sbatch") {
            continue;
        }
        let path = std::env::var("PATH").expect("a path");
        let folder = place.directory.path().display();
        let mut command = Command::new("bash");
        let recipes = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recipes");
        command
            .arg(recipes.join(recipe))
            .args(before)
            .arg(shards)
            .env("PATH", format!("{folder}:{path}"))
            .env("TRIES", tries)
            .current_dir(place.directory.path());
        let output = command.output().expect("it starts");
        assert!(!output.status.success(), "{recipe} {shards} {tries}");
        assert!(!place.at("x").exists(), "{recipe} {shards} {tries}");
    }
}

/// Scenes are untrusted.
#[test]
fn pods_may_do_nothing_but_compute() {
    let recipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recipes/kubernetes.yaml");
    let text = fs::read_to_string(recipe).expect("it is there");
    for line in [
        "activeDeadlineSeconds: 86400",
        "automountServiceAccountToken: false",
        "runAsNonRoot: true",
        "allowPrivilegeEscalation: false",
        "readOnlyRootFilesystem: true",
        "drop: [ALL]",
        "ephemeral-storage: 64Mi",
    ] {
        assert!(text.lines().any(|found| found.trim() == line), "{line}");
    }
}

#[test]
fn recipes_for_slurm_check_their_numbers() {
    assert_counts("slurm/submit.sh", &["ball.ray", "out.png"]);
    assert_counts("slurm/merge.sbatch", &["here", "ball.ray", "out.png"]);
}

#[test]
fn a_loop_renders_shards() {
    assert_cooks("loop.sh");
}

/// GNU parallel would evaluate what is in braces.
#[test]
fn braces_are_refused_for_gnu_parallel() {
    let recipe = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recipes/parallel.sh");
    for words in [
        ["a{= die =}.ray", "out.png", "2", "--resume"],
        ["a.ray", "{#}.png", "2", "--resume"],
        ["a.ray", "out.png", "2", "{}"],
    ] {
        let output = Command::new("bash").arg(&recipe).args(words).output();
        let output = output.expect("it starts");
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(said, "names and options must not contain {\n", "{words:?}");
        assert_eq!(output.status.code(), Some(2), "{words:?}");
    }
}

/// Where GNU parallel is installed.
#[test]
fn gnu_parallel_renders_shards() {
    let version = Command::new("parallel").arg("--version").output();
    if version.is_ok_and(|version| version.stdout.starts_with(b"GNU parallel")) {
        assert_cooks("parallel.sh");
    }
}
