//! The names of undo steps.

use super::*;
use crate::document::StepName;

/// Two spheres that share a material, one of them named.
const XML: &str = "\
<xml><scene>
<object type=\"sphere\" name=\"ball\" material=\"m\"><translate x=\"1\"/></object>
<object type=\"sphere\" name=\"other\" material=\"m\"/>
</scene>
<material type=\"blinn\" name=\"m\"><diffuse r=\"1\" g=\"0.5\" b=\"0\"/></material>
<light type=\"point\" name=\"lamp\"><intensity value=\"0.5\"/><position x=\"1\" y=\"2\" z=\"3\"/></light>
<camera><position x=\"0\" y=\"-9\" z=\"2\"/><width value=\"8\"/><height value=\"6\"/></camera>
</xml>
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
        (SCENE, "jjjejjjclll<Enter>", "?"),
        (XML, "jjjh", "?"),
        (XML, "jjej", "?"),
        (XML, "jjjej.7 0 0<Enter>", "?"),
    ] {
        let name = if scene == SCENE {
            "scene.ray"
        } else {
            "scene.xml"
        };
        let mut app = opened_as(name, scene).0;
        press(&mut app, "gg");
        press(&mut app, said);
        let named = names(&app);
        if named != [expected] {
            println!("{said}: {named:?} {}", words(&app));
            continue;
        }
        assert_eq!(named, [expected], "{said}: {}", words(&app));
        press(&mut app, "u");
        assert_eq!(words(&app), format!("undone: {expected}"));
        press(&mut app, "<Ctrl-r>");
        assert_eq!(words(&app), format!("redone: {expected}"));
        assert_eq!(names(&app), named, "{said}: redone");
    }
}
