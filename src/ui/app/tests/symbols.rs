//! Symbols of lights, cameras and groups: when they are shown, where, and picking them.

use std::sync::Arc;

use super::moving::click;
use super::*;
use crate::language::Node;
use crate::render::NO_OBJECT;
use crate::ui::msg::Target;
use Node::{Light, Object};

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

/// The symbols that these keys show, after a node is selected.
fn shown(name: &str, text: &str, node: Node, said: &str) -> Vec<Node> {
    let (mut app, _) = opened_as(name, text);
    assert_eq!(app.error_count(), 0, "{name} {:?}", app.diagnostics);
    app.select(node);
    press(&mut app, said);
    app.symbols().iter().map(|symbol| symbol.node).collect()
}

#[test]
fn the_kind_of_the_selected_node_is_shown_and_all_kinds_while_picking() {
    for (name, text, node, said, expected) in [
        ("a.ray", RAY, Light(0), "", vec![Light(0), Light(1)]),
        ("a.ray", RAY, Object(0), "", vec![]),
        ("a.ray", RAY, Object(0), "i", vec![Light(0), Light(1)]),
        ("a.ray", RAY, Object(0), "O", vec![Light(0), Light(1)]),
        ("a.ray", RAY, Object(0), "OO", vec![]),
        ("a.ray", RAY, Light(0), "o", vec![]),
        ("a.ray", RAY, Light(0), "v", vec![]),
        ("a.ray", RAY, Light(0), "e", vec![]),
        ("a.ray", RAY, Light(0), "m", vec![Light(0), Light(1)]),
        // The camera is shown where the picture is seen from elsewhere.
        ("a.ray", RAY, Node::View, "", vec![]),
        ("a.ray", RAY, Node::View, "v-<Esc>", vec![Node::View]),
        ("a.dat", DAT, Light(0), "", vec![Light(0)]),
        ("a.dat", DAT, Node::View, "v-<Esc>", vec![Node::View]),
        ("a.xml", XML, Object(0), "", vec![Object(0)]),
        ("a.xml", XML, Light(0), "", vec![Light(0)]),
        ("a.xml", XML, Object(1), "i", vec![Light(0), Object(0)]),
        (
            "a.xml",
            XML,
            Object(1),
            "v-<Esc>O",
            vec![Light(0), Node::View, Object(0)],
        ),
    ] {
        assert_eq!(
            shown(name, text, node, said),
            expected,
            "{name} {node:?} {said}"
        );
    }
}

#[test]
fn nothing_is_shown_before_something_is_selected() {
    for (name, text) in [("a.ray", RAY), ("a.dat", DAT), ("a.xml", XML)] {
        assert!(opened_as(name, text).0.symbols().is_empty(), "{name}");
    }
}

#[test]
fn symbols_are_where_things_are_and_are_picked_before_objects() {
    for (name, text, node) in [
        ("a.ray", RAY, Light(0)),
        ("a.dat", DAT, Light(0)),
        ("a.xml", XML, Object(0)),
    ] {
        let (mut app, _) = opened_as(name, text);
        let (cells, size) = app.raster().expect("there is room");
        let everywhere = pictures::frame(size, vec![0; size.pixels()]);
        app.update(Msg::Frame(Target::Preview, Arc::new(everywhere)));
        app.picture_mut()
            .advance(&FrameWindow::whole(size), &[], usize::MAX);
        app.select(Object(1));
        press(&mut app, "i");
        let symbols = app.symbols();
        let symbol = symbols
            .iter()
            .find(|symbol| symbol.node == node)
            .expect("it is shown");
        let across = if name == "a.xml" { 2.0 } else { 0.0 };
        // At the origin the picture is 2 · 10 · tan 30° high.
        let unit = f64::from(size.height) / (20.0 * (30.0_f64).to_radians().tan());
        let column = (f64::from(size.width) / 2.0 + across * unit) as u16;
        assert_eq!(symbol.cell, (column, size.height as u16 / 4), "{name}");
        // Beside the symbol, and then too far from it.
        for (away, picked) in [(1, node), (2, Object(app.source().object(0)))] {
            let place = (symbol.cell.0 + away, symbol.cell.1);
            press(&mut app, "i");
            app.place_cross(place);
            press(&mut app, "<Enter>");
            assert_eq!(
                (app.cursor.selected(), app.mode),
                (picked, Mode::Select),
                "{name}"
            );
            press(&mut app, "i");
            click(&mut app, cells.x + place.0, cells.y + place.1);
            press(&mut app, "<Enter>");
            assert_eq!(
                (app.cursor.selected(), app.mode),
                (picked, Mode::Select),
                "{name}"
            );
        }
    }
}

#[test]
fn without_a_symbol_or_an_object_nothing_is_picked() {
    let (mut app, _) = opened_as("a.ray", RAY);
    let (_, size) = app.raster().expect("there is room");
    let nothing = pictures::frame(size, vec![NO_OBJECT; size.pixels()]);
    app.update(Msg::Frame(Target::Preview, Arc::new(nothing)));
    app.picture_mut()
        .advance(&FrameWindow::whole(size), &[], usize::MAX);
    press(&mut app, "i");
    app.place_cross((0, 0));
    press(&mut app, "<Enter>");
    assert_eq!((words(&app), app.mode), ("nothing there", Mode::Inspect));
}

#[test]
fn a_symbol_moves_with_its_light() {
    let (mut app, _) = opened_as("a.ray", RAY);
    app.select(Light(0));
    let cell = |app: &App| app.symbols()[0].cell;
    let before = cell(&app);
    press(&mut app, "mx1");
    let moved = cell(&app);
    assert!(
        before.0 < moved.0 && before.1 == moved.1,
        "{before:?} {moved:?}"
    );
    press(&mut app, "<Esc>");
    assert_eq!(cell(&app), before);
}
