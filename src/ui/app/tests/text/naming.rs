//! The names of undo steps.

use super::scripts::{ray, scene, scripts};
use super::select::structure::DAT;

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

scripts! {
    each_kind_of_action_names_its_step: {
        let script = r"
            {1}      | steps {2}
            u        | says undone: {2}
            <Ctrl-r> | says redone: {2} | steps {2}
        ";
        ray().table(script, r"
            jjjelll                  | object 1 (sphere) centre x: 0 → 0.3, 3 nudges
            jjjejl                   | object 1 (sphere) radius: 1.5 → 1.6
            jjje2 3 4<Enter>         | object 1 (sphere) centre: 0 0 0 → 2 3 4
            jjjd                     | deleted object 1 (sphere)
            jjjD                     | duplicated object 1 (sphere)
            jjjJ                     | moved down: object 2 (sphere)
            jjjyp                    | pasted: object 2 (sphere)
            jjjR<Ctrl-u>ball<Enter>  | renamed object 1 (sphere) to ball
            jjjmx2<Enter>            | moved object 1 (sphere) along x: 2
            jjjml<Enter>             | moved object 1 (sphere): 0.2 right, 0.0 up
            jjj<Space><Space>tz30<Enter> | rotated 2 marked items: object 1 (sphere), object 2 (sphere) about z: 30°
            jjjs2<Enter>             | scaled object 1 (sphere): ×2
            jjj<Space><Space>ej2<Enter> | changed radius of object 1 (sphere), object 2 (sphere)
            jjjabox<Enter>           | added box
            jjjccone<Enter>          | changed to cone: object 1 (cone)
            vlS                      | wrote the view
            vl:view save side<Enter> | saved the view side
            :size 8x6<Enter>         | set the size to 8x6
            jjjejjjcjL<Enter>        | object 1 (sphere) kd: .45 .45 .45 → .45 .36 .36
        ");
        scene("scene.dat", DAT).after("ggj").table(script, "Gh | hidden object 4 (sphere)");
        scene("scene.xml", XML).after("ggj").table(script, r"
            Gd                       | deleted other (sphere)
            GkkRn<Enter>             | renamed m (blinn) to n
            jjejl                    | changed environment environment
            jjjejjl                  | changed lamp (point) intensity red
        ");
    };

    merges_are_named_after_what_they_changed: ray().play(r"
        jjjel<Esc>
        @file 1.5 // => 2.5 //
        | steps object 1 (sphere) centre x: 0 → 0.1; merged the file: object 1 (sphere) radius
        u | says undone: merged the file: object 1 (sphere) radius

        // A text taken as it is has no history.
        @file 1.5 // => 2.5 // | not steps
    ");
}
