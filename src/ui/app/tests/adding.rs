//! Adding things in the selected material and into empty texts, and changing the type of lights.

use super::*;
use crate::language::Node::{self, Light, Material, Object};

#[track_caller]
fn added(name: &str, text: &str, node: Node, said: &str) -> App {
    let (mut app, _) = opened_as(name, text);
    app.select(node);
    press(&mut app, said);
    assert_eq!(app.error_count(), 0, "{said}: {}", app.document.text());
    app
}

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

#[test]
fn new_things_take_the_material_of_the_selection() {
    for (name, text, node, written) in [
        (
            "a.ray",
            RAY,
            Object(1),
            "0.25 0 0  .5 .4 .3  0.10 0 0  1  0  0  1.50",
        ),
        (
            "a.ray",
            RAY,
            Object(0),
            "0 0 0  .5 .5 .5  0 0 0  1  0  0  1",
        ),
        ("a.ray", RAY, Light(0), "0.1 0.1 0.1  0.6 0.6 0.6"),
        ("a.dat", DAT, Object(0), "obj cylinder ID 4 mat ID 2"),
        ("a.dat", DAT, Object(2), "obj cylinder ID 4 mat ID 2"),
        ("a.dat", DAT, Material(0), "obj cylinder ID 4 mat ID 1"),
    ] {
        let app = added(name, text, node, "acylinder<Enter>");
        assert!(
            app.document.text().contains(written),
            "{}",
            app.document.text()
        );
    }
    for (node, written) in [
        (Object(0), "name=\"plane\" material=\"red\""),
        (Material(1), "name=\"plane\" material=\"red\""),
        (Material(0), "name=\"plane\" material=\"grey\""),
    ] {
        let app = added("a.xml", XML, node, "aplane<Enter>");
        assert!(
            app.document.text().contains(written),
            "{}",
            app.document.text()
        );
    }
}

#[test]
fn no_number_is_written_as_minus_0() {
    for axis in ["0 0 1", "0 1 0", "1 0 0", "0 0 -1"] {
        let cylinder = format!("cylinder ID 1 mat ID 2  0 0 0  {axis}  1 2");
        let text = DAT.replace("sphere ID 1 mat ID 2  0 0 0  1", &cylinder);
        for kind in ["box", "quadric", "ellipsoid"] {
            let said = format!("c{kind}<Enter>");
            let app = added("a.dat", &text, Object(0), &said);
            let changed = app.document.text();
            assert!(changed.contains(&format!("obj {kind} ID 1")), "{changed}");
            assert!(
                changed.split_whitespace().all(|word| word != "-0"),
                "{changed}"
            );
        }
    }
}

#[test]
fn lights_change_their_type_and_keep_what_both_share() {
    for (name, text, node, said, old, new) in [
        (
            "a.dat",
            DAT,
            Light(0),
            "cinf<Enter>",
            "ID 1 pnt",
            "ID 1 inf",
        ),
        (
            "a.dat",
            DAT,
            Light(0),
            "camb<Enter>",
            "ID 1 pnt",
            "ID 1 amb",
        ),
        (
            "a.dat",
            DAT,
            Light(0),
            "c<Down><Enter>",
            "ID 1 pnt",
            "ID 1 inf",
        ),
        // A light without a place or a direction gets a direction.
        (
            "a.dat",
            DAT,
            Light(1),
            "cinf<Enter>",
            "amb  0 0 0  0 0 0",
            "inf  0 0 0  0 0 -1",
        ),
        (
            "a.xml",
            XML,
            Light(0),
            "cambient<Enter>",
            "type=\"point\"",
            "type=\"ambient\"",
        ),
    ] {
        let mut app = added(name, text, node, said);
        assert_eq!(app.document.text(), text.replacen(old, new, 1), "{said}");
        press(&mut app, "u");
        assert_eq!(app.document.text(), text);
    }
    let app = added("a.ray", RAY, Light(0), "c");
    assert_eq!(words(&app), "light 1 has only one type");
}

#[test]
fn the_first_thing_brings_a_scene_with_it() {
    for (name, text, said, node) in [
        ("a.ray", "", "asphere<Enter>", Object(0)),
        ("a.ray", "// mine\n", "acone<Enter>", Object(0)),
        ("a.ray", "\n", "alight<Enter>", Light(0)),
        ("a.dat", "", "abox<Enter>", Object(0)),
        ("a.dat", "# mine", "aspot<Enter>", Light(0)),
        ("a.xml", "", "asphere<Enter>", Object(0)),
        ("a.xml", "<!-- mine -->", "aphong<Enter>", Material(0)),
    ] {
        let mut app = added(name, text, Node::View, said);
        assert_eq!(app.cursor.selected(), node, "{name} {said}");
        assert!(app.document.text().starts_with(text.trim_end()), "{name}");
        press(&mut app, "u");
        assert_eq!(app.document.text(), text, "{name} {said}");
    }
    let (mut app, _) = opened_as("a.dat", "");
    press(&mut app, "aunion<Enter>");
    assert_eq!(app.document.text(), "");
    assert!(words(&app).contains("mark them first"), "{}", words(&app));
}

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

#[test]
fn fields_of_new_solids_share_lines_as_in_their_neighbours() {
    let material = "  0 0 0  .5 .5 .5\n  0.2 0.2 0.2\n  20\n  0.1 0 1\n";
    for (kind, shape) in [
        ("cone", "  X\n  0 0 1\n  1 0 0\n  0 1 0\n  2 2 4\n"),
        ("ellipsoid", "  X\n  1 0 0\n  0 1 0\n  0 0 1\n  2 2 2\n"),
        ("sphere", "  X\n  2\n"),
    ] {
        let app = added("a.ray", LINES, Object(0), &format!("a{kind}<Enter>"));
        let text = app.document.text();
        let object = &text[text.rfind(&format!("  {kind}\n")).expect("it is there")..];
        let centre = object.lines().nth(1).expect("a second line");
        let expected = format!("  {kind}\n{shape}{material}").replace("  X", centre);
        assert_eq!(object, expected);
    }
}

#[test]
fn an_object_and_its_material_open_an_empty_scene_once() {
    for text in [
        "<xml><scene/></xml>",
        "<xml>\n  <scene>\n  </scene>\n</xml>\n",
    ] {
        let app = added("a.xml", text, Node::View, "asphere<Enter>");
        assert_eq!(app.document.text().matches("</scene>").count(), 1, "{text}");
        assert!(app.document.text().contains("material=\"blinn\""), "{text}");
        assert!(app.document.text().contains("name=\"blinn\""), "{text}");
    }
}

#[test]
fn a_mesh_is_added_once_its_file_is_named() {
    let app = added("a.xml", XML, Object(0), "amesh<Enter>");
    assert_eq!(app.document.text(), XML);
    let prompt = app.overlays.prompt.as_ref().expect("it is asked for");
    assert_eq!(prompt.input.value(), "mesh ");
}

#[test]
fn adding_says_the_keys_that_suit_what_is_added() {
    for (name, text, said, words_after) in [
        ("a.ray", RAY, "alight<Enter>", "added: light; m moves it"),
        (
            "a.dat",
            DAT,
            "asphere<Enter>",
            "added: sphere; m moves it, s scales it",
        ),
        (
            "a.dat",
            DAT,
            "abox<Enter>",
            "added: box; m moves it, t rotates it, s scales it",
        ),
        (
            "a.dat",
            DAT,
            "adistant<Enter>",
            "added: distant light; t rotates it",
        ),
        ("a.dat", DAT, "amaterial<Enter>", "added: material"),
    ] {
        let (mut app, _) = opened_as(name, text);
        press(&mut app, said);
        assert_eq!(words(&app), words_after);
    }
}
