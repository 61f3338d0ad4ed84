//! The colour picker.

use super::fields::{DOWN, DRAG, UP, mouse};
use super::*;
use crate::language::Node;
use crate::ui::keymap::Context;
use crate::ui::layout::{picker_lines, swatch_cells};

const XML: &str = r#"<xml>
  <scene>
    <object type="sphere" name="ball" material="clay"/>
    <material type="blinn" name="clay">
      <diffuse r="0.5" g="0.25" b="0" value="0.5"/>
    </material>
    <background r="0.2" g="0.4" b="0.4"/>
  </scene>
  <camera>
    <position z="9"/>
  </camera>
</xml>
"#;

/// The text after keys on a field of a node.
fn picked(name: &str, text: &str, (node, key): (Node, &str), said: &str) -> App {
    let mut app = opened_as(name, text).0;
    app.select(node);
    press(&mut app, "e");
    let rows = app.fields();
    let field = rows.iter().position(|row| row.field.key == key);
    app.cursor.field = field.expect("it has this field");
    press(&mut app, said);
    app
}

#[test]
fn a_colour_is_picked_in_one_undo_step_and_put_back_by_esc() {
    type Case<'c> = (&'c str, &'c str, (Node, &'c str), &'c str, &'c str, &'c str);
    let kd = (Node::Object(0), "kd");
    let rgb = (Node::Material(0), "RGB");
    let diffuse = (Node::Material(0), "diffuse");
    let background = (Node::Background, "background");
    let cases: [Case; 12] = [
        // A grey takes a saturation, and keeps the hue chosen before.
        ("a.ray", SCENE, kd, "jL", ".45 .45 .45", ".45 .36 .36"),
        ("a.ray", SCENE, kd, "LLLLLLjL", ".45 .45 .45", ".36 .45 .36"),
        ("a.ray", SCENE, kd, "jjLLL", ".45 .45 .45", "1.05 1.05 1.05"),
        (
            "a.ray",
            SCENE,
            kd,
            "jj<Alt-l>",
            ".45 .45 .45",
            ".452 .452 .452",
        ),
        ("a.ray", SCENE, kd, "jj;l", ".45 .45 .45", ".65 .65 .65"),
        ("a.ray", SCENE, kd, "jjHHHH", ".45 .45 .45", ".00 .00 .00"),
        // The first colour of the scene is that of its ambient light.
        ("a.ray", SCENE, kd, "jjjl", ".45 .45 .45", ".10 .10 .10"),
        ("a.ray", SCENE, kd, "jjjlh", ".45 .45 .45", ".50 .50 .50"),
        (
            "a.dat",
            dat::SCENE,
            rgb,
            "LLLLLL",
            "mat ID 1  1 0 0",
            "mat ID 1  0 1 0",
        ),
        (
            "a.dat",
            dat::SCENE,
            rgb,
            "kHHHHHH",
            "mat ID 1  1 0 0",
            "mat ID 1  0 0 1",
        ),
        // The factor stays.
        (
            "a.xml",
            XML,
            diffuse,
            "jH",
            "r=\"0.5\" g=\"0.25\" b=\"0\" value",
            "r=\"0.5\" g=\"0.30\" b=\"0.1\" value",
        ),
        (
            "a.xml",
            XML,
            background,
            "jH",
            "r=\"0.2\" g=\"0.4\" b=\"0.4\"",
            "r=\"0.28\" g=\"0.4\" b=\"0.4\"",
        ),
    ];
    for (name, text, place, said, old, new) in cases {
        assert!(text.contains(old), "{old}");
        let mut app = picked(name, text, place, "c");
        assert_eq!(app.context(), Context::Colour);
        press(&mut app, said);
        let chosen = text.replacen(old, new, 1);
        assert_eq!(app.document.text(), chosen, "{said}: tried out");
        press(&mut app, "<Enter>");
        assert_eq!(app.context(), Context::In(Mode::Edit));
        press(&mut app, "u");
        assert_eq!(app.document.text(), text, "{said}");
        press(&mut app, "<Ctrl-r>");
        assert_eq!(app.document.text(), chosen, "{said}");
        let mut app = picked(name, text, place, "c");
        press(&mut app, said);
        press(&mut app, "<Esc>u");
        assert_eq!(app.document.text(), text, "{said}: every byte is back");
        assert_eq!(words(&app), "nothing to undo");
    }
}

#[test]
fn there_and_back_changes_nothing() {
    let text = SCENE.replacen(".45 .45 .45", "0.123456 0.7 .33", 1);
    let kd = (Node::Object(0), "kd");
    for said in ["clh", "cjlh", "cjjlh", "cjkjk<Enter>"] {
        assert_eq!(picked("a.ray", &text, kd, said).document.text(), text);
    }
}

#[test]
fn a_default_is_written_when_its_colour_is_picked() {
    let text = XML.replace("<diffuse r=\"0.5\" g=\"0.25\" b=\"0\" value=\"0.5\"/>", "");
    let app = picked("a.xml", &text, (Node::Material(0), "diffuse"), "cjL");
    let text = app.document.text();
    assert!(
        text.contains("<diffuse r=\"0.5\" g=\"0.4\" b=\"0.4\"/>"),
        "{text}"
    );
}

#[test]
fn a_pasted_colour_is_taken_and_marked_things_follow() {
    let mut app = picked("a.ray", SCENE, (Node::Object(0), "kd"), "<Esc>  ke");
    app.cursor.field = 3;
    press(&mut app, "c");
    app.update(Msg::Paste("#ff8000".to_owned()));
    let expected = SCENE.replace(".45 .45 .45", "1.00 .502 .00");
    assert_eq!(app.document.text(), expected);
    app.update(Msg::Paste("red".to_owned()));
    assert!(words(&app).contains("#rrggbb"), "{}", words(&app));
    press(&mut app, "<Esc>");
    assert_eq!(app.document.text(), SCENE);
}

#[test]
fn marked_things_get_the_channels_that_the_selected_one_has_already() {
    let text = SCENE.replacen(".45 .45 .45", ".45 .36 .36", 1);
    let mut app = picked("a.ray", &text, (Node::Object(0), "kd"), "");
    app.cursor.marks = [Node::Object(0), Node::Object(1)].into();
    press(&mut app, "cjjL<Enter>");
    let both = SCENE.replace(".45 .45 .45", ".65 .52 .52");
    assert_eq!(app.document.text(), both);
    press(&mut app, "u");
    assert_eq!(app.document.text(), text);
}

#[test]
fn fields_without_a_colour_say_so_and_the_palette_opens_the_picker() {
    let mut app = picked("a.ray", SCENE, (Node::Object(0), "radius"), "c");
    assert_eq!(words(&app), "radius is not a colour");
    app.cursor.field = 3;
    press(&mut app, "<Esc>:pick a col<Enter>");
    assert_eq!(app.context(), Context::Colour);
}

#[test]
fn a_colour_overtaken_by_the_file_is_kept() {
    let mut app = picked("scene.ray", SCENE, (Node::Object(0), "kd"), "cjL");
    outside(&mut app, &SCENE.replace("4 0 0", "5 0 0"));
    press(&mut app, "l");
    assert!(words(&app).contains("changed on disk"), "{}", words(&app));
    assert_eq!(app.context(), Context::In(Mode::Edit));
    assert!(app.document.text().contains(".45 .36 .36"));
}

#[test]
fn the_mouse_drags_bars_takes_swatches_and_confirms_beside_them() {
    let mut app = picked("a.ray", SCENE, (Node::Object(0), "kd"), "c");
    let lines = picker_lines(app.areas().list);
    let [[_, hue], [_, saturation], _] = lines.bars;
    let kd = |kd: &str| SCENE.replacen(".45 .45 .45", kd, 1);
    mouse(&mut app, DOWN, (saturation.right() - 1, saturation.y));
    assert_eq!(app.document.text(), kd(".45 .00 .00"));
    // A drag stays on its bar.
    mouse(&mut app, DRAG, (saturation.x, hue.y));
    assert_eq!(app.document.text(), SCENE);
    mouse(&mut app, DRAG, (saturation.right() + 5, saturation.y));
    mouse(&mut app, UP, (saturation.right() + 5, saturation.y));
    assert_eq!(app.document.text(), kd(".45 .00 .00"));
    let swatch = swatch_cells(lines.swatches, 1).expect("there are two");
    mouse(&mut app, DOWN, (swatch.x + 1, swatch.y));
    assert_eq!(app.document.text(), kd("1.00 1.00 1.00"));
    mouse(&mut app, DOWN, (1, 1));
    assert_eq!(app.context(), Context::In(Mode::Edit));
    assert_eq!(app.document.text(), kd("1.00 1.00 1.00"));
    press(&mut app, "u");
    assert_eq!(app.document.text(), SCENE);
}
