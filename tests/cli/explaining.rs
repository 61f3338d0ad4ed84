//! `explain`: verdicts, places and exit codes.

use super::*;

const SCENE: &str = "\
.1 .1 .1
1  0 10 3  1 1 1
2
sphere 0 0 0 1  .2 .2 .2 .7 .7 .7 0 0 0 1 0 0 1
sphere 0 5 2 1  .2 .2 .2 .7 .7 .7 0 0 0 1 0 0 1
// view: eye 0 0 5 target 0 0 0 up 0 1 0 fov 40 size 40 30
";

fn scene() -> Place {
    let place = Place::new();
    place.write("a.ray", SCENE);
    place.write("broken.ray", "1 1 1 1");
    place
}

/// What an explanation prints.
fn explained(place: &Place, words: &str) -> String {
    let ran = place.run(&format!("explain {words}"));
    let errors = String::from_utf8_lossy(&ran.stderr);
    assert_eq!((&*errors, ran.status.code()), ("", Some(0)), "{words}");
    String::from_utf8(ran.stdout).expect("text")
}

#[test]
fn a_pixel_in_shadow_is_said_to_be_so_with_its_places() {
    let printed = explained(&scene(), "a.ray 20 15");
    let verdict = "\
pixel 20,15 of a.ray, sample 0: 0.02 0.02 0.02, alone displayed as 5 5 5
verdict: in the shadow of object 2 (sphere, line 5) from light 1 (line 2)  [a.ray:5:1]
  help: move the light or what is in between
also: object 1 (sphere, line 4) lit by ambient light (0.02)  [a.ray:4:1]

camera ray hits the front of object 1 (sphere, line 4) at t 4";
    assert!(printed.starts_with(verdict), "{printed}");
    assert!(printed.contains("\n  ambient 0.02\n"), "{printed}");
    let blocked = "blocked by object 2 (sphere, line 5)  [a.ray:2:4]";
    assert!(printed.contains(blocked), "{printed}");
}

#[test]
fn json_has_all_digits() {
    let printed = explained(&scene(), "a.ray 20 15 --json");
    let object: serde_json::Value = serde_json::from_str(&printed).expect("JSON");
    assert_eq!(object["verdict"], "shadow");
    assert_eq!(object["verdicts"][0]["place"]["line"], 5);
    let surface = &object["rays"][0]["end"]["surface"];
    assert_eq!(surface["object"], "object 1 (sphere)");
    assert_eq!(
        surface["lights"][0]["crossed"][0]["object"],
        "object 2 (sphere)"
    );
    assert_eq!(surface["lights"][0]["dark"], "blocked");
    assert_eq!(object["radiance"], object["rays"][0]["contribution"]);
}

#[test]
fn what_cannot_be_explained_has_the_exit_codes_of_render() {
    let place = scene();
    for (words, code, reason) in [
        (
            "a.ray 40 0",
            2,
            "pixel 40,0 is outside the picture of 40x30: X is 0 to 39, Y is 0 to 29",
        ),
        ("a.ray 10 15 --size 20x15", 2, "Y is 0 to 14"),
        ("broken.ray 0 0", 65, "broken.ray:1:7"),
        ("none.ray 0 0", 66, "none.ray: no such file"),
    ] {
        let ran = place.run(&format!("explain {words}"));
        let errors = String::from_utf8_lossy(&ran.stderr);
        assert_eq!(ran.status.code(), Some(code), "{words}: {errors}");
        assert!(errors.contains(reason), "{words}: {errors}");
    }
}
