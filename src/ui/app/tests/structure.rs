//! Changing the structure of scenes by keys: a text and keys in, a text out.

use super::*;
use crate::language::Node;

/// Three objects and two lights.
const RAY: &str = "\
0.1 0.1 0.1
2
5 5 5  1 1 1 // the lamp
-5 5 5  1 1 1
3
// the moon
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1

sphere 4 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

const DAT: &str = "\
mat ID 1  1 1 1  .3 .5 .2 9  0 0 1
mat ID 2  1 0 0  .3 .5 .2 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 2  1 0 0  1
obj CSG ID 3 union ID 1 ID 2
obj sphere ID 4 mat ID 1  3 0 0  1
render 2 ID 3 ID 4
";

const XML: &str = "\
<xml>
  <scene>
    <object type=\"sphere\" name=\"a\" material=\"m\"/>
    <object type=\"sphere\" name=\"b\"/>
    <material name=\"m\"/>
  </scene>
</xml>
";

const GROUPED: &str = "\
<xml>
  <scene>
    <object name=\"group\">
      <object type=\"sphere\" name=\"a\"/>
    </object>
  </scene>
</xml>
";

/// Opens a text, selects a node, types keys, and returns the interface.
fn after(name: &str, text: &str, node: Node, said: &str) -> App {
    let (mut app, _) = opened_as(name, text);
    assert_eq!(app.error_count(), 0, "{name}");
    app.select(node);
    press(&mut app, said);
    app
}

/// Checks what keys do to a text by replacements, and that `u` undoes it in one step.
#[track_caller]
fn check_in(name: &str, text: &str, node: Node, said: &str, changes: &[(&str, &str)]) {
    let mut app = after(name, text, node, said);
    let expected = changes.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    });
    assert_eq!(app.document.text(), expected, "{said}: {}", words(&app));
    assert_eq!(app.error_count(), 0);
    press(&mut app, "u");
    assert_eq!(app.document.text(), text, "{said}: undone");
    press(&mut app, "<Ctrl-r>");
    assert_eq!(app.document.text(), expected, "{said}: redone");
}

use Node::{Light, Material, Object};

const MOON: &str = "// the moon\nsphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
const SECOND: &str = "sphere 4 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";
const THIRD: &str = "sphere 8 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1\n";

#[test]
fn ray_scenes_are_restructured_by_keys() {
    #[track_caller]
    fn check(node: Node, said: &str, changes: &[(&str, &str)]) {
        check_in("scene.ray", RAY, node, said, changes);
    }
    check(Object(1), "d", &[(SECOND, ""), ("\n3\n", "\n2\n")]);
    check(
        Object(1),
        "D",
        &[(SECOND, &format!("{SECOND}\n{SECOND}")), ("\n3\n", "\n4\n")],
    );
    check(
        Object(2),
        "D",
        &[(THIRD, &format!("{THIRD}{THIRD}")), ("\n3\n", "\n4\n")],
    );
    check(
        Object(2),
        "K",
        &[
            (SECOND, THIRD),
            (&format!("\n{THIRD}{THIRD}"), &format!("\n{THIRD}{SECOND}")),
        ],
    );
    check(
        Object(1),
        "J",
        &[
            (SECOND, THIRD),
            (&format!("\n{THIRD}{THIRD}"), &format!("\n{THIRD}{SECOND}")),
        ],
    );
    check(
        Light(1),
        "d",
        &[("-5 5 5  1 1 1\n", ""), ("\n2\n", "\n1\n")],
    );
    check(
        Object(1),
        "yjp",
        &[(THIRD, &format!("{THIRD}{SECOND}")), ("\n3\n", "\n4\n")],
    );
    check(
        Object(0),
        "  d",
        &[(MOON, ""), ("\n3\n", "\n1\n"), (SECOND, "")],
    );
}

#[test]
fn a_field_is_set_in_all_marked_things() {
    let (mut app, _) = opened_as("scene.ray", RAY);
    app.select(Object(0));
    press(&mut app, "  kej2<Enter>");
    let radii = app
        .document
        .text()
        .replace("0 0 0 1  0 0 0", "0 0 0 2  0 0 0");
    let expected = RAY
        .replace("0 0 0 1  0 0 0", "0 0 0 2  0 0 0")
        .replace("4 0 0 1  0 0 0", "4 0 0 2  0 0 0");
    assert_eq!((app.document.text(), &*radii), (&*expected, &*expected));
    press(&mut app, "u");
    assert_eq!(app.document.text(), RAY);
}

#[test]
fn dat_scenes_are_restructured_by_keys() {
    #[track_caller]
    fn check(node: Node, said: &str, changes: &[(&str, &str)]) {
        check_in("scene.dat", DAT, node, said, changes);
    }
    let (first, second) = (
        "obj sphere ID 1 mat ID 1  0 0 0  1\n",
        "obj sphere ID 2 mat ID 2  1 0 0  1\n",
    );
    let tree = "obj CSG ID 3 union ID 1 ID 2\n";
    let last = "obj sphere ID 4 mat ID 1  3 0 0  1\n";
    check(Object(3), "d", &[(last, ""), ("2 ID 3 ID 4", "1 ID 3")]);
    check(
        Object(0),
        "dy",
        &[(first, ""), (tree, ""), ("2 ID 3 ID 4", "1 ID 4")],
    );
    check(
        Material(1),
        "dd",
        &[
            ("mat ID 2  1 0 0  .3 .5 .2 9  0 0 1\n", ""),
            (second, ""),
            (tree, ""),
            ("2 ID 3 ID 4", "1 ID 4"),
        ],
    );
    check(
        Object(3),
        "D",
        &[
            (last, &format!("{last}{}", last.replace("ID 4", "ID 5"))),
            ("2 ID 3 ID 4", "3 ID 3 ID 4 ID 5"),
        ],
    );
    check(
        Object(0),
        "R<Ctrl-u>9<Enter>",
        &[("sphere ID 1", "sphere ID 9"), ("union ID 1", "union ID 9")],
    );
    check(Object(3), "h", &[("2 ID 3 ID 4", "1 ID 3")]);
    check(
        Object(0),
        "J",
        &[(&format!("{first}{second}"), &format!("{second}{first}"))],
    );
}

#[test]
fn xml_scenes_are_restructured_by_keys() {
    #[track_caller]
    fn check(node: Node, said: &str, changes: &[(&str, &str)]) {
        check_in("scene.xml", XML, node, said, changes);
    }
    let (a, b) = (
        "    <object type=\"sphere\" name=\"a\" material=\"m\"/>\n",
        "    <object type=\"sphere\" name=\"b\"/>\n",
    );
    check(Object(1), "d", &[(b, "")]);
    check(
        Material(0),
        "dy",
        &[
            (" material=\"m\"", ""),
            ("    <material name=\"m\"/>\n", ""),
        ],
    );
    check(
        Object(1),
        "D",
        &[(b, &format!("{b}{}", b.replace("\"b\"", "\"b 2\"")))],
    );
    check(Object(0), "J", &[(&format!("{a}{b}"), &format!("{b}{a}"))]);
    check(
        Material(0),
        "R<Right>atte<Enter>",
        &[
            ("material=\"m\"", "material=\"matte\""),
            ("<material name=\"m\"", "<material name=\"matte\""),
        ],
    );
    check(
        Object(0),
        "yjp",
        &[(b, &format!("{b}{}", a.replace("\"a\"", "\"a 2\"")))],
    );
}

#[test]
fn the_written_thing_is_selected() {
    for (name, text, node, said, selected) in [
        ("scene.dat", DAT, Object(2), "D", Object(5)),
        ("scene.dat", DAT, Object(2), "yGp", Object(6)),
        ("scene.xml", GROUPED, Object(0), "D", Object(2)),
        ("scene.xml", GROUPED, Object(1), "D", Object(2)),
    ] {
        let app = after(name, text, node, said);
        assert_eq!(app.cursor.selected(), selected, "{node:?} {said}");
    }
    for (node, said, selected) in [
        (Object(1), "D", Object(2)),
        (Object(1), "K", Object(0)),
        (Object(1), "J", Object(2)),
        (Object(1), "d", Object(1)),
        (Object(2), "d", Object(1)),
        (Light(0), "D", Light(1)),
        (Object(0), "yGp", Object(3)),
    ] {
        let app = after("scene.ray", RAY, node, said);
        assert_eq!(app.cursor.selected(), selected, "{node:?} {said}");
    }
}

#[test]
fn what_cannot_be_done_is_said_and_changes_nothing() {
    for (name, text, node, said, reason) in [
        (
            "a.ray",
            SCENE,
            Light(0),
            "d",
            "the last light cannot be deleted: a .ray scene needs at least one",
        ),
        (
            "a.ray",
            RAY,
            Node::View,
            "d",
            "view cannot be copied, moved or deleted",
        ),
        (
            "a.ray",
            RAY,
            Node::View,
            "y",
            "view cannot be copied, moved or deleted",
        ),
        (
            "a.ray",
            RAY,
            Object(0),
            "K",
            "object 1 (sphere) is already the first",
        ),
        (
            "a.ray",
            RAY,
            Object(0),
            "p",
            "nothing to paste: y copies the selected item",
        ),
        (
            "a.ray",
            RAY,
            Object(0),
            "   d",
            "the last object cannot be deleted: a .ray scene needs at least one",
        ),
        (
            "a.dat",
            DAT,
            Object(0),
            "R<Ctrl-u>2<Enter>",
            "object 2 already exists",
        ),
        (
            "a.dat",
            DAT,
            Object(2),
            "K",
            "object 3 (CSG) must stay after object 2 (sphere), which it uses",
        ),
        (
            "a.xml",
            XML,
            Object(0),
            "h",
            "an .xml scene draws all of its objects",
        ),
    ] {
        let app = after(name, text, node, said);
        assert_eq!((app.document.text(), words(&app)), (text, reason), "{said}");
    }
}

#[test]
fn deleting_what_others_use_is_asked() {
    let mut app = after("scene.dat", DAT, Material(1), "d");
    assert_eq!(
        app.consequence(&[Material(1)]),
        "Delete material 2? 2 objects use it and will be deleted too."
    );
    press(&mut app, "n");
    assert_eq!(app.document.text(), DAT);
    assert!(app.overlays.dialog.is_none());
}

#[test]
fn copied_text_goes_to_the_clipboard_and_pasted_text_becomes_things() {
    let (mut app, _) = opened_as("scene.ray", RAY);
    app.select(Object(0));
    let copied = press(&mut app, "y");
    let moon = MOON.trim_end().to_owned();
    let is_moon = |effect: &Effect| matches!(effect, Effect::CopyText(text) if *text == moon);
    assert!(copied.iter().any(is_moon));
    app.select(Object(2));
    app.update(Msg::Paste(MOON.to_owned()));
    assert_eq!(app.nodes().len(), 9);
    assert!(app.document.text().ends_with(&format!("{THIRD}{MOON}")));
    app.update(Msg::Paste("1 2 3".to_owned()));
    assert_eq!(app.nodes().len(), 9);
}

#[test]
fn messages_about_marked_things_count_and_name_them() {
    for (said, done) in [
        (" d", "deleted: 1 marked item: object 1 (sphere)"),
        (
            "  d",
            "deleted: 2 marked items: object 1 (sphere), object 2 (sphere)",
        ),
        (" jD", "duplicated: 1 marked item: object 1 (sphere)"),
        ("d", "deleted: object 1 (sphere)"),
    ] {
        let app = after("scene.ray", RAY, Object(0), said);
        assert_eq!(words(&app), done, "{said:?}");
    }
    let mut app = after("scene.xml", XML, Material(0), "");
    press(&mut app, " d");
    let Some(Dialog::Delete(nodes)) = &app.overlays.dialog else {
        panic!("it is used");
    };
    let question = app.consequence(nodes);
    assert!(
        question.starts_with("Delete 1 marked item: m"),
        "{question}"
    );
}

#[test]
fn marks_end_when_their_indices_belong_to_others() {
    let mut app = after("scene.ray", RAY, Object(1), " ");
    assert_eq!(app.cursor.marks.len(), 1);
    press(&mut app, "<Esc>");
    assert!(app.cursor.marks.is_empty());
    press(&mut app, " ");
    outside(&mut app, SCENE);
    assert!(app.cursor.marks.is_empty());
}

#[test]
fn undo_and_redo_select_the_thing_that_they_change() {
    for (said, selected, done) in [
        ("du", Object(1), "undone: deleted object 2 (sphere)"),
        ("du<Ctrl-r>", Object(1), "redone: deleted object 2 (sphere)"),
        ("Du", Object(1), "undone: duplicated object 2 (sphere)"),
        (
            "Du<Ctrl-r>",
            Object(2),
            "redone: duplicated object 2 (sphere)",
        ),
    ] {
        let app = after("scene.ray", RAY, Object(1), said);
        assert_eq!(app.cursor.selected(), selected, "{said}");
        assert!(words(&app).starts_with(done), "{said}: {}", words(&app));
    }
}

#[test]
fn a_copied_combination_moves_as_a_whole() {
    let app = after("scene.dat", DAT, Object(2), "Dmx1<Enter>");
    let copy = "\
obj sphere ID 5 mat ID 1  1 0 0  1
obj sphere ID 6 mat ID 2  2 0 0  1
obj CSG ID 7 union ID 5 ID 6
";
    assert!(
        app.document.text().contains(copy),
        "{}",
        app.document.text()
    );
}
