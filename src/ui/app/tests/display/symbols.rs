//! Symbols of lights, cameras and groups: when they are shown, where, and picking them.

use super::rows::{scene, scripts};
use crate::language::Node;
use crate::ui::app::{display, inspect};

const RAY: &str = "\
// view: eye 0 0 10 target 0 0 0 up 0 1 0 fov 60 size 400 300
0 0 0
2
0 0 0  1 1 1
2 1 0  1 1 1
1
sphere -2 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

const DAT: &str = "\
camera perspective 0 0 10  0 0 0  0 1 0  1 0 100
light ID 1 pnt  0 0 0  0 0 0  1 1 1  1 0 0  0 shadow_on
light ID 2 inf  0 0 0  0 0 -1  1 1 1  1 0 0  0 shadow_on
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  -2 0 0  1
";

const XML: &str = "\
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

    a_symbol_moves_with_its_light: {
        let mut session = scene("a.ray", RAY).session();
        session.run("[light 1]");
        let before = display::symbols(&session.app.shared)[0].cell;
        session.run("mx1");
        let moved = display::symbols(&session.app.shared)[0].cell;
        assert!(before.0 < moved.0 && before.1 == moved.1, "{before:?} {moved:?}");
        session.run("<Esc>");
        assert_eq!(display::symbols(&session.app.shared)[0].cell, before);
    };
}

#[test]
fn symbols_are_where_things_are_and_are_picked_before_objects() {
    for (name, text, node, across) in [
        ("a.ray", RAY, "light 1", 0.0),
        ("a.dat", DAT, "light 1", 0.0),
        ("a.xml", XML, "object 1", 2.0),
    ] {
        let mut session = scene(name, text).session();
        session.run("@shows 0");
        session.app.shared.select(Node::Object(1));
        session.run("i");
        let size = session.app.shared.raster().expect("there is room").1;
        let symbols = display::symbols(&session.app.shared);
        let symbol = symbols
            .iter()
            .find(|symbol| symbol.node.to_string() == node);
        let cell = symbol.expect("it is shown").cell;
        // At the origin the picture is 2 · 10 · tan 30° high.
        let unit = f64::from(size.height) / (20.0 * (30.0_f64).to_radians().tan());
        let column = (f64::from(size.width) / 2.0 + across * unit) as u16;
        assert_eq!(cell, (column, size.height as u16 / 4), "{name}");
        // Beside the symbol, and then too far from it.
        let object = Node::Object(session.app.shared.source().object(0)).to_string();
        for (away, picked) in [(1, node), (2, &object)] {
            let place = (cell.0 + away, cell.1);
            session.run("i");
            inspect::place_cross(&mut session.app.shared, place);
            session.run(&format!(
                r"
                <Enter> | at {picked} | mode SELECT
                i
                @down picture {},{}
                <Enter> | at {picked} | mode SELECT
            ",
                place.0, place.1
            ));
        }
    }
}
