//! Adding things in the selected material and into empty texts, and changing the type of lights.

use super::scripts::{scene, scripts};

const RAY: &str = "\
0.1 0.1 0.1
1
5 5 5  1 1 1
2
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 4 0 0 1  0.25 0 0  .5 .4 .3 0.10 0 0 1 0 0 1.50
";

const DAT: &str = "\
light ID 1 pnt  5 5 5  0 0 0  1 1 1  1 0 0  0 shadow_on
light ID 2 amb  0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_on
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
mat ID 2  1 0 0  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 2  0 0 0  1
obj sphere ID 2 mat ID 1  1 0 0  1
obj CSG ID 3 union ID 1 ID 2
";

const XML: &str = "\
<xml>
  <scene>
    <object type=\"sphere\" name=\"a\" material=\"red\"/>
    <material type=\"blinn\" name=\"grey\"/>
    <material type=\"blinn\" name=\"red\"/>
    <light type=\"point\" name=\"lamp\"><position z=\"9\"/></light>
  </scene>
  <camera><position z=\"9\"/></camera>
</xml>
";

/// Solids of several lines, whose lengths and last numbers share lines.
const LINES: &str = "\
0.1 0.1 0.1
1
5 5 5  1 1 1
1
  cylinder // the ground
  0 -0.2 0
  0 0 1
  1 0 0
  0 1 0
  6 6 0.2
  0 0 0  .5 .5 .5
  0.2 0.2 0.2
  20
  0.1 0 1
";

scripts! {
    new_things_take_the_material_of_the_selection: {
        let script = "[{1}] acylinder<Enter> | text …{2}… | not errors";
        scene("a.ray", RAY).table(script, r"
            object 2   | 0.25 0 0  .5 .4 .3  0.10 0 0  1  0  0  1.50
            object 1   | 0 0 0  .5 .5 .5  0 0 0  1  0  0  1
            light 1    | 0.1 0.1 0.1  0.6 0.6 0.6
        ");
        scene("a.dat", DAT).table(script, r"
            object 1   | obj cylinder ID 4 mat ID 2
            object 3   | obj cylinder ID 4 mat ID 2
            material 1 | obj cylinder ID 4 mat ID 1
        ");
        scene("a.xml", XML).table(&script.replace("cylinder", "plane"), r#"
            object 1   | name="plane" material="red"
            material 2 | name="plane" material="red"
            material 1 | name="plane" material="grey"
        "#);
    };

    no_number_is_written_as_minus_0: for axis in ["0 0 1", "0 1 0", "1 0 0", "0 0 -1"] {
        let cylinder = format!("sphere ID 1 mat ID 2  0 0 0  1 => cylinder ID 1 mat ID 2  0 0 0  {axis}  1 2");
        scene("a.dat", DAT).but(&cylinder).table(r"
            [object 1] c{1}<Enter> | text …obj {1} ID 1… | not text …\s-0\s… | not text …\s-0\n… | not errors
        ", r"
            box
            quadric
            ellipsoid
        ");
    };

    lights_change_their_type_and_keep_what_both_share: {
        scene("a.dat", DAT).each(r"
            [light 1] camb<Enter>     | becomes ID 1 pnt => ID 1 amb
            [light 1] c<Down><Enter>  | becomes ID 1 pnt => ID 1 inf
            // A light without a place or a direction gets a direction.
            [light 2] cinf<Enter>     | becomes amb  0 0 0  0 0 0 => inf  0 0 0  0 0 -1
        ");
        scene("a.xml", XML).play(r#"
            [light 1] cambient<Enter> | becomes type="point" => type="ambient"
        "#);
    };

    the_first_thing_brings_a_scene_with_it: {
        for (name, text, said, node) in [
            ("a.ray", "", "sphere", "object 1"),
            ("a.ray", "// mine\n", "cone", "object 1"),
            ("a.ray", "\n", "light", "light 1"),
            ("a.dat", "", "box", "object 1"),
            ("a.dat", "# mine", "spot", "light 1"),
            ("a.xml", "", "sphere", "object 1"),
            ("a.xml", "<!-- mine -->", "phong", "material 1"),
        ] {
            scene(name, text).play(&format!(r"
                a{said}<Enter> | at {node} | not errors | text {}…
                u              | text opened
            ", text.trim_end()));
        }
        scene("a.dat", "").play("aunion<Enter> | text opened | says …mark them first…");
    };

    an_object_and_its_material_open_an_empty_scene_once: for text in
        ["<xml><scene/></xml>", "<xml>\n  <scene>\n  </scene>\n</xml>\n"]
    {
        scene("a.xml", text).play(r#"
            asphere<Enter> | not errors | text …</scene>… | not text …</scene>…</scene>…
            | text …material="blinn"… | text …name="blinn"…
        "#);
    };

    a_mesh_is_added_once_its_file_is_named: scene("a.xml", XML).play(r"
        [object 1] amesh<Enter> | text opened | prompt :mesh\s
    ");

    adding_says_the_keys_that_suit_what_is_added: {
        scene("a.ray", RAY).each("alight<Enter> | says Added light; m moves it");
        scene("a.dat", DAT).each(r"
            asphere<Enter>   | says Added sphere; m moves it, s scales it
            abox<Enter>      | says Added box; m moves it, t rotates it, s scales it
            adistant<Enter>  | says Added distant light; t rotates it
            amaterial<Enter> | says Added material
        ");
    };

    fields_of_new_solids_share_lines_as_in_their_neighbours: scene("a.ray", LINES)
        .with("material", "  0 0 0  .5 .5 .5\n  0.2 0.2 0.2\n  20\n  0.1 0 1\n")
        .table(r"
        [object 1] a{1}<Enter> | not errors | text …\n  {1}\n{2}{material}
    ", r"
        cone      | \s 0 -2.1 0\n  0 0 1\n  1 0 0\n  0 1 0\n  2 2 4\n
        ellipsoid | \s 0 -0.1 0\n  1 0 0\n  0 1 0\n  0 0 1\n  2 2 2\n
        sphere    | \s 0 -0.1 0\n  2\n
    ");
}
