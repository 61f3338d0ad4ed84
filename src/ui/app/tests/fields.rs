//! Entering words, choosing them from lists, sliders and frames.

use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

use super::*;
use crate::language::Node;
use crate::ui::layout::field_rows;

pub(super) const DOWN: MouseEventKind = MouseEventKind::Down(MouseButton::Left);
pub(super) const DRAG: MouseEventKind = MouseEventKind::Drag(MouseButton::Left);
pub(super) const UP: MouseEventKind = MouseEventKind::Up(MouseButton::Left);

pub(super) fn mouse(app: &mut App, kind: MouseEventKind, (column, row): (u16, u16)) {
    app.update(Msg::Mouse(MouseEvent {
        kind,
        column,
        row,
        modifiers: KeyModifiers::NONE,
    }));
}

/// The text after keys on a node of a scene.
fn after(name: &str, text: &str, node: Node, said: &str) -> String {
    let mut app = opened_as(name, text).0;
    app.select(node);
    press(&mut app, said);
    app.document.text().to_owned()
}

#[test]
fn a_typed_word_replaces_the_old_one_unless_the_cursor_is_moved() {
    let dat = |said: &str| after("scene.dat", dat::SCENE, Node::Light(0), said);
    let source = |word: &str| dat::SCENE.replace("ID 1 inf", &format!("ID 1 {word}"));
    for (said, word) in [
        ("e<Enter>amb<Enter>", "amb"),
        ("eip<Enter>", "pnt"),
        ("e<Enter><Back>pnt<Enter>", "pnt"),
        ("e<Enter><Enter>", "inf"),
        ("e<Enter><Left><Right><Back><Enter>", "inf"),
    ] {
        assert_eq!(dat(said), source(word), "{said}");
    }
    let xml = "<xml><scene><object name='ball' type='sphere'/></scene>\
               <camera><position z='9'/></camera></xml>";
    let renamed = |said: &str| after("scene.xml", xml, Node::Object(0), said);
    assert_eq!(renamed("ej<Enter>x<Enter>"), xml.replace("'ball'", "'x'"));
}

#[test]
fn a_number_keeps_its_text_with_the_cursor_at_the_end() {
    assert_eq!(typed("jjjej<Enter>5<Enter>"), "1.55 // the radius");
}

const XML: &str = r#"<xml>
  <scene>
    <object type="sphere" name="ball" material="clay"/>
    <object type="sphere" name="bare"/>
    <material type="blinn" name="clay"/> <!-- warm -->
    <material type="blinn" name="glass"/>
  </scene>
  <camera>
    <position z="9"/>
  </camera>
</xml>
"#;

/// The file, the text, the node, keys in EDIT without the last Enter, and what they replace by what.
type Choice = (
    &'static str,
    &'static str,
    Node,
    &'static str,
    &'static str,
    &'static str,
);

const CHOICES: &[Choice] = &[
    (
        "a.dat",
        dat::SCENE,
        Node::Object(0),
        "<Enter><Down>",
        "mat ID 1  0 0 0",
        "mat ID 7  0 0 0",
    ),
    (
        "a.dat",
        dat::SCENE,
        Node::Object(0),
        "<Enter><Ctrl-n><Ctrl-p><Up>",
        "mat ID 1  0 0 0",
        "mat ID 7  0 0 0",
    ),
    (
        "a.dat",
        dat::SCENE,
        Node::Object(0),
        "<Enter>7",
        "mat ID 1  0 0 0",
        "mat ID 7  0 0 0",
    ),
    (
        "a.dat",
        dat::SCENE,
        Node::Light(0),
        "<Enter>pn",
        "ID 1 inf",
        "ID 1 pnt",
    ),
    (
        "a.dat",
        dat::SCENE,
        Node::Object(2),
        "<Enter>uni",
        "difference",
        "union",
    ),
    (
        "a.dat",
        dat::SCENE,
        Node::Object(2),
        "jj<Enter>1",
        "ID 1 ID 2\n",
        "ID 1 ID 1\n",
    ),
    (
        "a.dat",
        dat::SCENE,
        Node::View,
        "<Enter>or",
        "perspective",
        "orthographic",
    ),
    (
        "a.xml",
        XML,
        Node::Object(0),
        "jj<Enter>gl",
        "material=\"clay\"",
        "material=\"glass\"",
    ),
    (
        "a.xml",
        XML,
        Node::Object(0),
        "jj<Enter>warm<Ctrl-u><Down>",
        "material=\"clay\"",
        "material=\"glass\"",
    ),
    (
        "a.xml",
        XML,
        Node::Object(1),
        "jj<Enter>glass",
        "name=\"bare\"",
        "name=\"bare\" material=\"glass\"",
    ),
    (
        "a.xml",
        XML,
        Node::Material(0),
        "<Enter>ph",
        "\"blinn\" name=\"clay\"",
        "\"phong\" name=\"clay\"",
    ),
];

#[test]
fn names_and_words_are_chosen_from_a_filtered_list_in_one_undo_step() {
    for &(name, text, node, said, old, new) in CHOICES {
        assert!(text.contains(old), "{old}");
        let mut app = opened_as(name, text).0;
        app.select(node);
        press(&mut app, "e");
        press(&mut app, said);
        let chosen = text.replacen(old, new, 1);
        if node != Node::View {
            assert_eq!(app.document.text(), chosen, "{said}: tried out");
        }
        press(&mut app, "<Enter>");
        assert_eq!(app.document.text(), chosen, "{said}");
        assert!(app.overlays.menu.is_none() && app.mode == Mode::Edit);
        press(&mut app, "u");
        assert_eq!(app.document.text(), text, "{said}");
        press(&mut app, "<Ctrl-r>u");
        press(&mut app, said);
        press(&mut app, "<Esc>");
        assert_eq!(app.document.text(), text, "{said}: every byte is back");
        press(&mut app, "u");
        assert_eq!(words(&app), "nothing to undo");
    }
}

#[test]
fn a_new_name_creates_what_it_names_in_the_same_step() {
    let material = "mat ID 7  0 0 1  .1 .5 .4 9  0 0 1\n";
    let dat = dat::SCENE
        .replace(
            material,
            &format!("{material}mat ID 42  0.8 0.8 0.8  0.2 0.7 0.3 20  0 0 1\n"),
        )
        .replace("mat ID 1  0 0 0", "mat ID 42  0 0 0");
    let xml = XML.replace("material=\"clay\"", "material=\"a &amp; b\"").replace(
        "name=\"glass\"/>\n",
        "name=\"glass\"/>\n    <material type=\"blinn\" name=\"a &amp; b\">\n      <diffuse r=\"0.7\" g=\"0.7\" b=\"0.7\"/>\n      <specular value=\"0.3\"/>\n    </material>\n",
    );
    for (name, text, said, after) in [
        ("a.dat", dat::SCENE, "e<Enter>422<Back>", dat.as_str()),
        ("a.xml", XML, "ejj<Enter>a & b", xml.as_str()),
    ] {
        let mut app = opened_as(name, text).0;
        app.select(Node::Object(0));
        press(&mut app, said);
        let menu = app.overlays.menu.as_ref().expect("it is open");
        let offered = menu.shown().last().expect("there is one").words.clone();
        assert_eq!(offered, "new: create this material");
        press(&mut app, "<Down><Enter>");
        assert_eq!(app.document.text(), after);
        press(&mut app, "u");
        assert_eq!(app.document.text(), text);
    }
}

#[test]
fn a_new_texture_stands_before_its_use_and_marked_things_follow() {
    let textures = "texture ID 1 checker 8 8  1 1 1  0 0 0\nuse colour ID 1 mat ID 1\n";
    let text = dat::SCENE.replace("obj sphere ID 1", &format!("{textures}obj sphere ID 1"));
    let mut app = opened_as("a.dat", &text).0;
    app.select(Node::Material(0));
    press(&mut app, "e");
    let fields = app.fields();
    let field = fields.iter().position(|row| row.field.key == "texture");
    app.cursor.field = field.expect("it uses one");
    press(&mut app, "<Enter>5<Enter>");
    let created = textures.replace(
        "\nuse colour ID 1",
        "\ntexture ID 5 checker 8 8  0.8 0.8 0.8  0.2 0.2 0.2\nuse colour ID 5",
    );
    assert_eq!(app.document.text(), text.replace(textures, &created));
    press(&mut app, "u<Esc>");
    app.select(Node::Object(0));
    press(&mut app, "  ke<Enter>42");
    let marked = |id: &str| {
        let first = app
            .document
            .text()
            .contains(&format!("ID 1 mat ID {id}  0 0 0"));
        first
            && app
                .document
                .text()
                .contains(&format!("ID 2 mat ID {id}  .5 0 0"))
    };
    assert!(marked("42"), "{}", app.document.text());
    press(&mut app, "<Back><Back>7<Enter>");
    let both = text.replace("mat ID 1  0 0 0  1", "mat ID 7  0 0 0  1");
    assert_eq!(app.document.text(), both);
}

#[test]
fn what_cannot_be_chosen_or_created_stays_in_the_list() {
    let mut app = opened_as("a.dat", dat::SCENE).0;
    app.select(Node::Object(0));
    press(&mut app, "e<Enter>glass<Enter>");
    let menu = app.overlays.menu.as_ref().expect("it is open");
    assert!(menu.shown().is_empty(), "an ID is a number");
    press(&mut app, "<Esc>");
    app.select(Node::Object(2));
    press(&mut app, "j<Enter>99<Enter>");
    assert!(app.overlays.menu.is_some(), "there is no plain object");
    press(&mut app, "<Esc>");
    assert_eq!(app.document.text(), dat::SCENE);
}

#[test]
fn a_choice_overtaken_by_the_file_is_kept() {
    let mut app = opened_as("scene.dat", dat::SCENE).0;
    app.select(Node::Object(0));
    press(&mut app, "e<Enter><Down>");
    read(&mut app, "scene.dat", &dat::SCENE.replace("3 0 0", "5 0 0"));
    press(&mut app, "<Up>");
    assert!(words(&app).contains("changed on disk"), "{}", words(&app));
    assert!(app.overlays.menu.is_none());
    let both = dat::SCENE.replace("3 0 0", "5 0 0");
    assert_eq!(
        app.document.text(),
        both.replacen("mat ID 1  0", "mat ID 7  0", 1)
    );
}

#[test]
fn the_mouse_chooses_in_a_list_and_closes_it() {
    let mut app = opened_as("a.dat", dat::SCENE).0;
    app.select(Node::Object(0));
    press(&mut app, "e<Enter>");
    let list = app.areas().list;
    let click = |app: &mut App, column, row| mouse(app, DOWN, (column, row));
    let chosen = dat::SCENE.replacen("mat ID 1  0", "mat ID 7  0", 1);
    click(&mut app, list.x + 2, list.y + 3);
    assert_eq!(app.document.text(), chosen);
    click(&mut app, list.x + 2, list.y + 3);
    assert!(app.overlays.menu.is_none(), "the second click chooses");
    press(&mut app, "<Enter>1");
    click(&mut app, 1, 1);
    assert!(app.overlays.menu.is_none());
    assert_eq!(app.document.text(), chosen);
}

#[test]
fn a_slider_is_dragged_in_one_undo_step() {
    let shiny = XML.replace(
        "type=\"blinn\" name=\"clay\"",
        "type=\"microfacet\" name=\"clay\"",
    );
    let written = shiny.replace(
        "name=\"clay\"/>",
        "name=\"clay\"><roughness value=\"1\"/></material>",
    );
    let ray = |kr: &str| SCENE.replacen("5 0.50 0 1", &format!("5 {kr} 0 1"), 1);
    let dat = |kd: &str| dat::SCENE.replacen(".1 .5 .4 9", &format!(".1 {kd} .4 9"), 1);
    let xml = |value: &str| written.replace("value=\"1\"", &format!("value=\"{value}\""));
    // A default is written beside its element's start.
    let inserted = shiny.replace(
        "name=\"clay\"/>",
        "name=\"clay\">\n      <metallic value=\"1\"/>\n    </material>",
    );
    for (name, text, node, key, [first, last]) in [
        (
            "a.ray",
            SCENE.to_owned(),
            Node::Object(0),
            "kr",
            [ray("0.00"), ray("1.00")],
        ),
        (
            "a.dat",
            dat::SCENE.to_owned(),
            Node::Material(0),
            "Kd",
            [dat(".0"), dat("1.0")],
        ),
        (
            "a.xml",
            written.clone(),
            Node::Material(0),
            "roughness",
            [xml("0"), xml("1")],
        ),
        (
            "a.xml",
            shiny.clone(),
            Node::Material(0),
            "metallic",
            [shiny.clone(), inserted],
        ),
    ] {
        let mut app = opened_as(name, &text).0;
        app.select(node);
        let keys = app.fields();
        let field = keys.iter().position(|row| row.field.key == key);
        let field = field.expect("it has this field");
        let lines = field_rows(app.areas().fields);
        let line = ratatui::layout::Rect {
            y: lines.y + (field - app.cursor.field_top) as u16,
            height: 1,
            ..lines
        };
        let bar = app.slider(field, line).expect("it is a slider");
        mouse(&mut app, DOWN, (bar.x + 2, bar.y));
        mouse(&mut app, DRAG, (bar.right() + 9, bar.y));
        assert_eq!(app.document.text(), last, "{key}");
        mouse(&mut app, DRAG, (0, bar.y));
        assert_eq!(app.document.text(), first, "{key}");
        mouse(&mut app, DRAG, (bar.right() - 1, bar.y));
        mouse(&mut app, UP, (bar.right() - 1, bar.y));
        mouse(&mut app, DRAG, (bar.x, bar.y));
        assert_eq!(app.document.text(), last, "{key}: it was let go");
        assert_eq!((app.mode, app.cursor.field), (Mode::Edit, field));
        if last != text {
            press(&mut app, "u");
        }
        assert_eq!(app.document.text(), text, "{key}");
    }
}

#[test]
fn a_frame_is_orthonormalised_in_one_undo_step() {
    let ray = SCENE.replacen(
        "sphere\n0 0 0\n1.5 // the radius",
        "box\n0 0 0\n2 0 0 // vl\n0.5 1 0 0 0 2 1 1 1",
        1,
    );
    let dat = dat::SCENE.replacen(
        "obj sphere ID 1 mat ID 1  0 0 0  1",
        "obj box ID 1 mat ID 1  0 0 0  2 0 0  3 3 0  0 0 -1  1 1 1",
        1,
    );
    for (name, text, changes) in [
        (
            "a.ray",
            &ray,
            [("2 0 0 // vl\n0.5 1 0 0 0 2", "1 0 0 // vl\n0.0 1 0 0 0 1")],
        ),
        (
            "a.dat",
            &dat,
            [("3 3 0  0 0 -1", "0 4.242640687119285 0  0 0 -1")],
        ),
    ] {
        let straight = changes
            .iter()
            .fold(text.clone(), |text, (old, new)| text.replace(old, new));
        assert_ne!(straight, *text);
        let mut app = opened_as(name, text).0;
        app.select(Node::Object(0));
        press(&mut app, "eO");
        assert_eq!(app.document.text(), straight);
        press(&mut app, "O");
        assert_eq!(words(&app), "object 1 (box) is already orthonormal");
        press(&mut app, "u");
        assert_eq!(app.document.text(), text);
    }
}

#[test]
fn what_has_no_frame_says_so() {
    for (name, text, said) in [
        (
            "a.ray",
            SCENE,
            "object 1 (sphere) has no frame to orthonormalise",
        ),
        (
            "a.dat",
            dat::SCENE,
            "object 1 (sphere) has no frame to orthonormalise",
        ),
        ("a.xml", XML, "ball (sphere) has no frame to orthonormalise"),
    ] {
        let mut app = opened_as(name, text).0;
        app.select(Node::Object(0));
        press(&mut app, "eO");
        assert_eq!(words(&app), said);
        assert_eq!(app.document.text(), text);
    }
}

#[test]
fn a_longer_list_fills_the_fields_below_in_one_step() {
    let scene =
        "0 0 0 0 1 cylinder 0 0 0  0 0 1  1 0 0  0 1 0  1 1 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1";
    let turned = scene.replace("0 0 1  1 0 0  0 1 0", "1 0 0  0 1 0  0 0 1");
    let sized = scene.replace("1 1 1", "2 0.5 3");
    for (said, expected) in [
        ("ej1 0 0 0 1 0 0 0 1<Enter>", &turned),
        ("ejjjj2 1/2 3<Enter>", &sized),
        ("ejjjj2 1/2 3<Enter>u", &scene.to_owned()),
    ] {
        assert_eq!(
            &after("scene.ray", scene, Node::Object(0), said),
            expected,
            "{said}"
        );
    }
}

#[test]
fn an_arrow_keeps_the_value_and_goes_to_the_next_field() {
    let scene = "0 0 0 0 1 sphere 0 0 0 1 0 0 0 .5 .5 .5 0 0 0 1 0 0 1";
    let expected = scene.replace("0 0 0 1 0 0 0", "0 0 7 2 0 0 0");
    let said = "ej2<Up><Tab><Tab>7<Down>";
    assert_eq!(after("scene.ray", scene, Node::Object(0), said), expected);
}
