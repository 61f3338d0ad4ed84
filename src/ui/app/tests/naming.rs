//! The names of undo steps.

use super::*;
use crate::document::StepName;

/// Two spheres that share a material, one of them named.
const XML: &str = "\
<xml><scene>
<object type=\"sphere\" name=\"ball\" material=\"m\"><translate x=\"1\"/></object>
<object type=\"sphere\" name=\"other\" material=\"m\"/>
<material type=\"blinn\" name=\"m\"><diffuse r=\"1\" g=\"0.5\" b=\"0\"/></material>
<light type=\"point\" name=\"lamp\"><intensity value=\"0.5\"/><position x=\"1\" y=\"2\" z=\"3\"/></light>
</scene>
<camera><position x=\"0\" y=\"-9\" z=\"2\"/><width value=\"8\"/><height value=\"6\"/></camera>
</xml>
";

/// Two spheres, each with a material.
const DAT: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
mat ID 2  1 0 0  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 4 mat ID 2  3 0 0  1
render 2 ID 1 ID 4
";

/// The names of the steps that can be undone.
fn names(app: &App) -> Vec<String> {
    let past = app.document.states().take(app.document.present() + 1);
    let names = past.filter_map(|state| state.name.map(StepName::to_string));
    names.collect()
}

#[test]
fn each_kind_of_action_names_its_step() {
    for (scene, said, expected) in [
        (
            SCENE,
            "jjjelll",
            "object 1 (sphere) centre x: 0 → 0.3, 3 nudges",
        ),
        (SCENE, "jjjejl", "object 1 (sphere) radius: 1.5 → 1.6"),
        (
            SCENE,
            "jjje2 3 4<Enter>",
            "object 1 (sphere) centre: 0 0 0 → 2 3 4",
        ),
        (SCENE, "jjjd", "deleted object 1 (sphere)"),
        (SCENE, "jjjD", "duplicated object 1 (sphere)"),
        (SCENE, "jjjJ", "moved down: object 2 (sphere)"),
        (SCENE, "jjjyp", "pasted: object 2 (sphere)"),
        (
            SCENE,
            "jjjR<Ctrl-u>ball<Enter>",
            "renamed object 1 (sphere) to ball",
        ),
        (SCENE, "jjjmx2<Enter>", "moved object 1 (sphere) along x: 2"),
        (
            SCENE,
            "jjjml<Enter>",
            "moved object 1 (sphere): 0.2 right, 0.0 up",
        ),
        (
            SCENE,
            "jjj  tz30<Enter>",
            "rotated 2 marked items: object 1 (sphere), object 2 (sphere) about z: 30°",
        ),
        (SCENE, "jjjs2<Enter>", "scaled object 1 (sphere): ×2"),
        (
            SCENE,
            "jjj  ej2<Enter>",
            "changed radius of object 1 (sphere), object 2 (sphere)",
        ),
        (SCENE, "jjjabox<Enter>", "added box"),
        (SCENE, "jjjccone<Enter>", "changed to cone: object 1 (cone)"),
        (SCENE, "vlS", "wrote the view"),
        (SCENE, "vl:view save side<Enter>", "saved the view side"),
        (SCENE, ":size 8x6<Enter>", "set the size to 8x6"),
        (
            SCENE,
            "jjjejjjcjL<Enter>",
            "object 1 (sphere) kd: .45 .45 .45 → .45 .36 .36",
        ),
        (DAT, "Gh", "hidden object 4 (sphere)"),
        (XML, "Gd", "deleted other (sphere)"),
        (XML, "GkkRn<Enter>", "renamed m (blinn) to n"),
        (XML, "jjejl", "changed environment environment"),
        (XML, "jjjejjl", "changed lamp (point) intensity red"),
    ] {
        let name = match scene {
            DAT => "scene.dat",
            XML => "scene.xml",
            _ => "scene.ray",
        };
        let mut app = opened_as(name, scene).0;
        press(&mut app, "ggj");
        press(&mut app, said);
        let named = names(&app);
        assert_eq!(named, [expected], "{said}: {}", words(&app));
        press(&mut app, "u");
        assert_eq!(words(&app), format!("undone: {expected}"));
        press(&mut app, "<Ctrl-r>");
        assert_eq!(words(&app), format!("redone: {expected}"));
        assert_eq!(names(&app), named, "{said}: redone");
    }
}

#[test]
fn merges_are_named_after_what_they_changed() {
    let mut app = open(SCENE);
    press(&mut app, "jjjel<Esc>");
    outside(&mut app, &SCENE.replace("1.5 //", "2.5 //"));
    let expected = [
        "object 1 (sphere) centre x: 0 → 0.1",
        "merged the file: object 1 (sphere) radius",
    ];
    assert_eq!(names(&app), expected);
    press(&mut app, "u");
    assert_eq!(words(&app), format!("undone: {}", expected[1]));
    // A text taken as it is has no history.
    let mut app = open(SCENE);
    outside(&mut app, &SCENE.replace("1.5 //", "2.5 //"));
    assert_eq!(names(&app), [""; 0]);
}
