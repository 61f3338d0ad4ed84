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
pixel 20,15 of a.ray, sample 0: 0.02 0.02 0.02, 8-bit 5 5 5
verdict: in the shadow of object 2 (sphere, line 5) from light 1 (line 2)  [a.ray:5:1]
  help: move the light, or what is in between
also: object 1 (sphere, line 4) lit by ambient light (0.02)  [a.ray:4:1]

camera ray hits the front of object 1 (sphere, line 4) at t 4";
    assert!(printed.starts_with(verdict), "{printed}");
    assert!(printed.contains("\n  ambient 0.02\n"), "{printed}");
    let blocked = "blocked by object 2 (sphere, line 5)  [a.ray:2:4]";
    assert!(printed.contains(blocked), "{printed}");
}

/// An octahedron with smooth normals: one of its faces bends toward the light, which is behind its plane.
#[test]
fn a_facet_behind_whose_plane_the_light_is_is_said_to_be_so() {
    let place = Place::new();
    place.write(
        "o.obj",
        "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
         vn 1 0 0\nvn -1 0 0\nvn 0 1 0\nvn 0 -1 0\nvn 0 0 1\nvn 0 0 -1\n\
         f 1//1 3//3 5//5\nf 3//3 2//2 5//5\nf 2//2 4//4 5//5\nf 4//4 1//1 5//5\n\
         f 3//3 1//1 6//6\nf 2//2 3//3 6//6\nf 4//4 2//2 6//6\nf 1//1 4//4 6//6\n",
    );
    place.write(
        "a.xml",
        "<xml><scene>\n<object type='obj' name='o.obj' material='m'/><material name='m'/>\n\
         <light type='direct' name='d'><intensity/><direction x='-1' y='-.4' z='-.4'/></light>\n\
         </scene><camera><position z='5'/></camera></xml>",
    );
    let printed = explained(&place, "a.xml 95 54");
    let verdict = "verdict: this facet of o.obj (obj, line 2) faces away from d (direct, line 3), \
                   although its smooth normal faces the light  [a.xml:2:1]";
    assert!(printed.contains(verdict), "{printed}");
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
