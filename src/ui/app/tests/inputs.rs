//! Inputs that are open while another program saves the file.

use super::*;
use crate::document::Side;

/// A ball, its material and a view without a name.
const XML: &str = "\
<xml><scene>
<object type=\"sphere\" name=\"ball\" material=\"red\"/>
<material type=\"blinn\" name=\"red\"><diffuse r=\"1\" g=\"0.5\" b=\"0\"/></material>
<light type=\"point\" name=\"lamp\"><intensity value=\"0.5\"/><position x=\"1\" y=\"2\" z=\"3\"/></light>
</scene>
<camera><position x=\"0\" y=\"-9\" z=\"2\"/><width value=\"8\"/><height value=\"6\"/></camera>
</xml>
";

/// Opens a scene, opens an input, lets another program replace `old` by `new`, and types on.
fn open_during(scene: &str, opening: &str, [old, new]: [&str; 2], typed: &str) -> App {
    let name = if scene == XML { "a.xml" } else { "scene.ray" };
    let mut app = opened_as(name, scene).0;
    press(&mut app, "ggj");
    press(&mut app, opening);
    assert!(app.has_input(), "{opening}");
    read(&mut app, name, &scene.replace(old, new));
    press(&mut app, typed);
    app
}

const RADIUS: [&str; 2] = ["1.5 //", "1.7 //"];
const NAME: [&str; 2] = ["\"ball\"", "\"globe\""];
const MATERIAL: [&str; 2] = ["\"red\"", "\"crimson\""];
const KIND: [&str; 2] = ["\"sphere\"", "\"plane\""];
const TYPE: [&str; 2] = ["\"blinn\"", "\"phong\""];

/// Opens the radius of the first object.
const OPEN_RADIUS: &str = "jjjej<Enter>";

#[test]
fn an_input_accepted_as_it_was_opened_changes_nothing() {
    for (scene, opening, theirs, accept) in [
        (SCENE, OPEN_RADIUS, RADIUS, "<Enter>"),
        (SCENE, OPEN_RADIUS, RADIUS, "<Tab>"),
        (SCENE, OPEN_RADIUS, RADIUS, "<Down>"),
        (SCENE, OPEN_RADIUS, RADIUS, "<Up>"),
        (SCENE, OPEN_RADIUS, RADIUS, "<Back>5<Enter>"),
        (SCENE, "jjj  ej<Enter>", RADIUS, "<Enter>"),
        (XML, "GR", NAME, "<Enter>"),
        (XML, "GR", NAME, " <Back>ball<Enter>"),
        (XML, "GkR", MATERIAL, "<Enter>"),
        (XML, "Gkc", TYPE, "<Enter>"),
    ] {
        let app = open_during(scene, opening, theirs, accept);
        let [old, new] = theirs;
        let expected = scene.replace(old, new);
        assert_eq!(app.document.text(), expected, "{opening}{accept}");
        assert!(!app.document.is_dirty() && app.overlays.dialog.is_none());
        assert!(!app.has_input(), "{opening}{accept}");
    }
}

#[test]
fn an_input_that_was_changed_asks_about_what_the_file_has_changed_too() {
    for (scene, opening, theirs, typed, mine) in [
        (SCENE, OPEN_RADIUS, RADIUS, "<Ctrl-u>2<Enter>", "2 //"),
        (SCENE, OPEN_RADIUS, RADIUS, "<Ctrl-u>2<Tab>", "2 //"),
        (SCENE, "jjjej2", RADIUS, "<Enter>", "2 //"),
        (XML, "GR", NAME, "moon<Enter>", "\"moon\""),
        (XML, "GkR", MATERIAL, "blue<Enter>", "\"blue\""),
    ] {
        let [old, new] = theirs;
        for (key, chosen) in [("M", mine), ("T", new)] {
            let mut app = open_during(scene, opening, theirs, typed);
            let Some(Dialog::Conflict { merge, .. }) = &app.overlays.dialog else {
                panic!("{opening}{typed}: {:?}", app.overlays.dialog);
            };
            assert!(!merge.conflicts.is_empty());
            press(&mut app, &format!("{key}<Enter>"));
            let expected = scene.replace(old, chosen);
            assert_eq!(app.document.text(), expected, "{opening}{typed}{key}");
            assert_eq!(**app.document.saved(), scene.replace(old, new));
            assert_eq!(app.disk.state, OnDisk::Known);
        }
    }
}

/// A question that was put off returns with the next save, compared with what was seen in the input.
#[test]
fn a_conflict_of_an_input_can_be_put_off() {
    let theirs = SCENE.replace(RADIUS[0], RADIUS[1]);
    let mut app = open_during(SCENE, OPEN_RADIUS, RADIUS, "<Ctrl-u>2<Enter><Esc>");
    assert_eq!(app.disk.state, OnDisk::Changed);
    let effects = press(&mut app, "w");
    assert!(wants(&effects, |effect| matches!(effect, Effect::Read(..))));
    outside(&mut app, &theirs);
    let Some(Dialog::Conflict { merge, .. }) = &app.overlays.dialog else {
        panic!("{:?}", app.overlays.dialog);
    };
    let [conflict] = &merge.conflicts[..] else {
        panic!("{:?}", merge.conflicts);
    };
    assert_eq!(conflict.decision, None::<Side>);
    assert_eq!(
        [&conflict.base, &conflict.mine, &conflict.theirs],
        ["1.5", "2", "1.7"]
    );
}

#[test]
fn an_input_is_merged_with_changes_of_the_file_elsewhere() {
    let elsewhere = ["4 0 0", "5 0 0"];
    for (opening, typed) in [(OPEN_RADIUS, "<Ctrl-u>2<Enter>"), ("jjjej2", "<Enter>")] {
        let app = open_during(SCENE, opening, elsewhere, typed);
        assert!(app.overlays.dialog.is_none());
        assert_eq!(changed_lines(&app), ["2 // the radius", "5 0 0"]);
    }
    // What is typed back to what it was is no change.
    let app = open_during(SCENE, "jjjej1", RADIUS, ".5<Enter>");
    assert!(app.overlays.dialog.is_none());
    assert_eq!(changed_lines(&app), ["1.7 // the radius"]);
    // Nor is what a save wrote meanwhile a change of another program.
    let mut app = open(SCENE);
    press(&mut app, "jjjejlw<Enter>");
    let text = app.document.shared_text();
    saving::saved(&mut app, 1, "scene.ray", &text);
    press(&mut app, "<Ctrl-u>2<Enter>");
    assert!(app.overlays.dialog.is_none());
    assert_eq!(changed_lines(&app), ["2 // the radius"]);
}

#[test]
fn choosing_the_type_that_something_has_is_no_edit() {
    let mut app = open(SCENE);
    press(&mut app, "jjjc<Enter>");
    assert_eq!(app.document.text(), SCENE);
    assert_eq!(app.document.undoable(), None);
    // Neither is choosing the one that the file has given it since, nor the one before.
    for chosen in ["sphere", "plane"] {
        let app = open_during(XML, "Gc", KIND, &format!("{chosen}<Enter>"));
        let theirs = XML.replace(KIND[0], KIND[1]);
        assert_eq!(app.document.text(), theirs, "{chosen}");
        assert!(app.overlays.menu.is_none());
    }
}
