//! Symbols of lights, cameras and groups: when they are shown, where, and picking them.

use super::scripts::{scene, scripts};

pub(super) const RAY: &str = "\
// view: eye 0 0 10 target 0 0 0 up 0 1 0 fov 60 size 400 300
0 0 0
2
0 0 0  1 1 1
2 1 0  1 1 1
1
sphere -2 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

pub(super) const DAT: &str = "\
camera perspective 0 0 10  0 0 0  0 1 0  1 0 100
light ID 1 pnt  0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_on
light ID 2 inf  0 0 0  0 0 -1  1 1 1  1 0 0  0 shadow_on
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  -2 0 0  1
";

pub(super) const XML: &str = "\
<xml>
  <scene>
    <object name=\"g\">
      <object type=\"sphere\" name=\"a\"/>
      <translate x=\"2\"/>
    </object>
    <light type=\"point\" name=\"l\">
      <position y=\"1\"/>
    </light>
  </scene>
  <camera>
    <position z=\"10\"/>
    <target value=\"0\"/>
    <fov value=\"60\"/>
  </camera>
</xml>
";

scripts! {
    the_kind_of_the_selected_node_is_shown_and_all_kinds_while_picking: {
        scene("a.ray", RAY).each(r"
            | not errors | not symbols
            [light 1]       | symbols light 1, light 2
            [object 1]      | not symbols
            [object 1] i    | symbols light 1, light 2
            [object 1] O    | symbols light 1, light 2
            [object 1] OO   | not symbols
            [light 1] o     | not symbols
            [light 1] v     | not symbols
            [light 1] e     | not symbols
            [light 1] m     | symbols light 1, light 2
            // The camera is shown where the picture is seen from elsewhere.
            [view]          | not symbols
            [view] v-<Esc>  | symbols view
        ");
        scene("a.dat", DAT).each(r"
            | not errors | not symbols
            [light 1]       | symbols light 1
            [view] v-<Esc>  | symbols view
        ");
        scene("a.xml", XML).each(r"
            | not errors | not symbols
            [object 1]      | symbols object 1
            [light 1]       | symbols light 1
            [object 2] i    | symbols light 1, object 1
            [object 2] v-<Esc>O | symbols light 1, view, object 1
        ");
    };

    without_a_symbol_or_an_object_nothing_is_picked: scene("a.ray", RAY).play(r"
        @shows none
        i
        @down picture 0,0
        <Enter> | says nothing there | mode INSPECT
    ");

    a_symbol_moves_with_its_light: scene("a.ray", RAY).play(r"
        [light 1]
        mx1   | symbol-cells light 1 49,16, light 2 …
        <Esc> | symbol-cells light 1 43,16, light 2 …
    ");

    // At the origin the picture is 2 · 10 · tan 30° high: 65 pixels, of which a cell has one across and two down.
    symbols_are_where_things_are_and_are_picked_before_objects: {
        let script = r"
            @shows 0
            [view] i  | symbol-cells …{1} {2}…
            // Beside the symbol, and then too far from it.
            @down picture {3}
            <Enter>   | at {1} | mode SELECT
            i
            @down picture {4}
            <Enter>   | at {5} | mode SELECT
        ";
        scene("a.ray", RAY).table(script, "light 1 | 43,16 | 44,16 | 45,16 | object 1");
        scene("a.dat", DAT).table(script, "light 1 | 43,16 | 44,16 | 45,16 | object 1");
        scene("a.xml", XML).table(script, "object 1 | 54,16 | 55,16 | 56,16 | object 2");
    };
}
