//! `convert`: files, losses on standard error and exit codes.

use super::*;

/// A scene that `.xml` cannot hold: its ambient colours are no diffuse ones.
const LOSSY: &str = "\
1 1 1
1 0 9 0 0 0 0
1 sphere 0 0 0 1  1 1 1 0.5 0.5 0.5 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 8 6
";

fn place() -> Place {
    let place = Place::new();
    place.write("lossy.ray", LOSSY);
    place
}

/// Runs a conversion; returns standard output, standard error and the exit code.
fn run(place: &Place, words: &str) -> (String, String, Option<i32>) {
    let ran = place.run(&format!("convert {words}"));
    let [printed, said] =
        [ran.stdout, ran.stderr].map(|text| String::from_utf8(text).expect("text"));
    (printed, said, ran.status.code())
}

#[test]
fn a_converted_scene_gives_the_same_picture() {
    let place = place();
    assert_eq!(
        run(&place, "ball.ray -o ball.dat"),
        (String::new(), String::new(), Some(0))
    );
    let compared = place.run("compare ball.ray ball.dat");
    assert_eq!(compared.status.code(), Some(0));
    let (printed, ..) = run(&place, "ball.ray -o - --to dat");
    assert_eq!(printed.into_bytes(), place.read("ball.dat"));
}

#[test]
fn losses_are_warnings_at_their_places() {
    let place = place();
    let (printed, said, code) = run(&place, "lossy.ray -o - --to xml");
    assert!(printed.starts_with("<xml>"), "{printed}");
    assert_eq!(code, Some(0));
    for part in [
        "warning: lossy.ray:3:19: object 1 (sphere): an ambient colour other than the diffuse one",
        "not in .xml",
        "help: written as emission",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn strict_conversions_write_nothing_that_loses_something() {
    let place = place();
    let (printed, said, code) = run(&place, "lossy.ray -o lossy.xml --strict");
    assert_eq!((&*printed, code), ("", Some(65)));
    assert!(said.contains("error: lossy.ray:3:19: "), "{said}");
    assert!(
        said.ends_with("error: nothing was written: there is 1 error\n"),
        "{said}"
    );
    assert!(!place.names().contains(&"lossy.xml".to_owned()));
    assert_eq!(run(&place, "ball.ray -o ball.dat --strict").2, Some(0));
}

#[test]
fn a_scene_in_the_same_language_is_copied() {
    let place = place();
    let commented = format!("{LOSSY}// the end\r\n");
    place.write("lossy.ray", &commented);
    assert_eq!(run(&place, "lossy.ray -o copy.ray --strict").2, Some(0));
    assert_eq!(place.read("copy.ray"), commented.as_bytes());
}

#[test]
fn wrong_conversions_are_refused() {
    let place = place();
    place.write("faulty.ray", "1 1 1 0");
    place.write(
        "map.dat",
        "mat ID 0  1 1 1  0 1 0 1  0 0 1\ntexture ID 0 image 1 1 map.xml\nuse colour ID 0 mat ID 0\n\
         obj sphere ID 0 mat ID 0  0 0 0 1\n",
    );
    place.write("map.xml", "P3 1 1 255 0 0 0");
    for (words, code, message) in [
        (
            "ball.ray -o ball.ray",
            2,
            "cannot overwrite ball.ray: it is the scene itself",
        ),
        (
            "map.dat -o map.xml",
            2,
            "cannot overwrite map.xml: the scene uses it",
        ),
        ("ball.ray -o -", 2, "name the language with --to"),
        (
            "ball.ray -o ball.txt",
            2,
            "scenes end in .ray, .dat, .xml or .test; --to names another language",
        ),
        (
            "ball.ray -o ball.dat --to pov",
            2,
            "[possible values: ray, dat, xml, test]",
        ),
        ("ball.ray", 2, "--output <FILE>"),
        ("none.ray -o a.dat", 66, "no such file"),
        ("ball.ray -o none/a.dat", 73, "none"),
        ("faulty.ray -o a.dat", 65, "nothing was written: there "),
    ] {
        let (printed, said, found) = run(&place, words);
        assert_eq!((&*printed, found), ("", Some(code)), "{words}: {said}");
        assert!(said.contains(message), "{words}: {said}");
    }
    assert_eq!(place.read("ball.ray"), BALL.as_bytes());
}

#[test]
fn files_named_from_another_folder_are_pointed_out() {
    let place = place();
    fs::create_dir(place.at("new")).expect("created");
    place.write(
        "map.dat",
        "camera perspective 0 0 8  0 0 0  0 1 0  1 0 100\nresolution .01 .01\nviewport 100 80\n\
         mat ID 0  1 1 1  0 1 0 1  0 0 1\ntexture ID 0 image 1 1 map.ppm\nuse colour ID 0 mat ID 0\n\
         obj sphere ID 0 mat ID 0  0 0 0 1\n",
    );
    place.write("map.ppm", b"P6 1 1 255 abc");
    let warning = "the new scene looks for it in its own folder";
    let (_, said, code) = run(&place, "map.dat -o new/map.xml --strict");
    assert!(code == Some(65) && said.contains(warning), "{said}");
    assert!(!place.at("new/map.xml").exists());
    let (_, said, code) = run(&place, "map.dat -o new/map.xml");
    assert!(code == Some(0) && said.contains(warning), "{said}");
    place.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    for (scene, there, is_named) in [
        ("a.obj", "new/a.xml", true),
        ("a.obj", "new/a.test", false),
        ("map.dat", "new/map.test", false),
        ("map.dat", "new/map.ray", false),
    ] {
        let (_, said, code) = run(&place, &format!("{scene} -o {there}"));
        assert!(
            code == Some(0) && said.contains(warning) == is_named,
            "{there}: {said}"
        );
    }
    place.write("new/map.ppm", b"P6 1 1 255 abc");
    for there in ["new/map.xml", "map.xml"] {
        let (_, said, _) = run(&place, &format!("map.dat -o {there}"));
        assert!(!said.contains(warning), "{said}");
    }
}
