//! Features of `.xml` that the others lack: components that are absent from the text.

use super::*;
use crate::language::Node;
use crate::ui::app::Provenance;

const SCENE: &str = r#"<xml>
  <scene>
    <object name="all">
      <object type="sphere" name="ball" material='m'>
        <scale value="2"/>
      </object>
    </object>
    <material name="m"/>
  </scene>
  <camera>
    <position z="9"/>
    <target/>
  </camera>
</xml>
"#;

/// Opens the interface with the cursor on a node.
fn at(node: Node) -> App {
    let mut app = opened_as("scene.xml", SCENE).0;
    app.select(node);
    app
}

/// The lines that keys change.
fn changed(node: Node, said: &str) -> String {
    let mut app = at(node);
    press(&mut app, said);
    let text = app.document.text().to_owned();
    let lines = text
        .lines()
        .filter(|&line| !SCENE.lines().any(|old| old == line));
    let changed: Vec<_> = lines.map(str::trim).collect();
    press(&mut app, "<Esc>uuu");
    assert_eq!(app.document.text(), SCENE);
    changed.join("|")
}

#[test]
fn defaults_are_shown_and_written_when_typed() {
    let rows = at(Node::Object(1)).fields();
    let scale = rows.iter().find(|row| row.field.key == "scale");
    let scale = scale.expect("it is scaled");
    assert_eq!(scale.literals, ["1", "1", "1", "2"]);
    let [unsaid, said] = [Provenance::Default, Provenance::Text];
    assert_eq!(scale.sources, [unsaid, unsaid, unsaid, said]);
    let ball = |keys: &str| changed(Node::Object(1), keys);
    assert_eq!(
        ball("ejjj<Tab>i<Back>3<Enter>"),
        r#"<scale value="2" y="3"/>"#
    );
    assert_eq!(ball("ejjjl"), r#"<scale value="2" x="1.1"/>"#);
    assert_eq!(ball("ejjjll"), r#"<scale value="2" x="1.2"/>"#);
    assert_eq!(
        ball("eji<Back><Back><Back><Back>a&b<Enter>"),
        r#"<object type="sphere" name="a&amp;b" material='m'>"#
    );
}

#[test]
fn nudging_a_material_cycles_through_existing_names() {
    let text = SCENE.replace("name=\"m\"/>", "name=\"m\"/><material name=\"n &amp; o\"/>");
    let mut app = opened_as("scene.xml", &text).0;
    app.select(Node::Object(1));
    let material = |app: &App| app.fields()[2].literals[0].clone();
    press(&mut app, "ejj");
    for (keys, expected) in [("l", "n & o"), ("l", "m"), ("h", "n & o")] {
        press(&mut app, keys);
        assert_eq!(material(&app), expected);
    }
    assert!(app.document.text().contains("material='n &amp; o'"));
    app.select(Node::Object(0));
    press(&mut app, "jjl");
    assert!(app.document.text().contains(r#"name="all" material="m">"#));
}

#[test]
fn a_missing_parameter_is_added() {
    assert_eq!(
        changed(Node::Material(0), "ejji<Back><Back><Back>1<Enter>"),
        r#"<material name="m">|<diffuse r="1" g="0.5" b="0.5"/>|</material>"#
    );
}

#[test]
fn the_camera_is_edited_and_saved() {
    assert_eq!(changed(Node::View, "ejjjl"), r#"<fov value="41"/>"#);
    assert_eq!(
        changed(Node::View, ":size 320x210<Enter>"),
        r#"<width value="320"/>|<height value="210"/>"#
    );
    let mut app = at(Node::View);
    press(&mut app, "vllS");
    assert_eq!(app.pictures.view, None);
    let text = app.document.text();
    let position = text.lines().find(|line| line.contains("<position z="));
    assert!(position.is_some_and(|line| line.contains(" x=")), "{text}");
}

#[test]
fn a_colour_pasted_onto_a_missing_one_is_written_at_once() {
    let mut app = at(Node::Material(0));
    press(&mut app, "ejj");
    app.update(Msg::Paste("#ff8000".to_owned()));
    let text = app.document.text();
    assert!(
        text.contains(r#"<diffuse r="1" g="0.502" b="0"/>"#),
        "{text}"
    );
    press(&mut app, "<Esc>u");
    assert_eq!(app.document.text(), SCENE);
}

/// A text that is not XML has no nodes, and no key has any effect on it.
#[test]
fn a_text_that_is_not_xml_does_no_harm() {
    for text in ["", "<xml>", "<xml><scene></xml>", "<scene/>"] {
        let mut app = opened_as("scene.xml", text).0;
        assert!(app.nodes().is_empty() && 0 < app.error_count(), "{text}");
        for keys in [
            "jkgG",
            "e",
            "jk<Tab>hl",
            "i1<Enter>",
            "<Esc>",
            "nN",
            "/x<Enter>",
            "v",
            "hjkl+-[]f0S",
            "<Esc>",
            "p",
            "<Enter>",
            "<Esc>",
            "o ",
            "!",
            "j<Enter>",
            "<Esc>",
            "u",
            ":size 9x9<Enter>",
            ":view save<Enter>",
            "b",
            "<Esc>",
        ] {
            press(&mut app, keys);
            assert!(app.fields().is_empty() && app.cursor.parts().is_empty());
            let _ = (app.areas(), app.raster(), app.outlined_objects());
        }
        assert_eq!(app.document.text(), text);
    }
}
