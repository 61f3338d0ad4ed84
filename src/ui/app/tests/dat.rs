//! Features of `.dat` that `.ray` lacks: words and references in fields, hidden objects.

use super::*;
use crate::language::Node;

/// Two materials and three objects, one of which combines the others.
pub(super) const SCENE: &str = "\
camera perspective 0 -9 0  0 0 0  0 0 1  1 0.1 100
resolution .01 .01
viewport 40 30
light ID 1 inf 0 0 0  0 1 -1  1 1 1  1 0 0 0 shadow_on
mat ID 1  1 0 0  .1 .5 .4 9  0 0 1
mat ID 7  0 0 1  .1 .5 .4 9  0 0 1
obj sphere ID 1 mat ID 1  0 0 0  1
obj sphere ID 2 mat ID 7  .5 0 0  1
obj CSG ID 3 difference ID 1 ID 2
obj sphere ID 4 mat ID 7  3 0 0  1
";

/// Opens the interface with the cursor on a node.
fn at(node: Node) -> App {
    let mut app = opened_as("scene.dat", SCENE).0;
    app.select(node);
    app
}

/// The lines that keys change.
fn changed(node: Node, said: &str) -> Vec<String> {
    let mut app = at(node);
    press(&mut app, said);
    let text = app.document.text();
    let lines = text
        .lines()
        .filter(|&line| !SCENE.lines().any(|old| old == line));
    let changed = lines.map(str::to_owned).collect();
    press(&mut app, "<Esc>uuu");
    assert_eq!(app.document.text(), SCENE);
    changed
}

#[test]
fn a_choice_is_nudged_and_typed() {
    let light = |source: &str, shadow: &str| {
        [format!(
            "light ID 1 {source} 0 0 0  0 1 -1  1 1 1  1 0 0 0 {shadow}"
        )]
    };
    assert_eq!(changed(Node::Light(0), "el"), light("amb", "shadow_on"));
    assert_eq!(changed(Node::Light(0), "eh"), light("pnt", "shadow_on"));
    let typed = "eii<Back><Back><Back><Back>am<Enter>";
    assert_eq!(changed(Node::Light(0), typed), light("amb", "shadow_on"));
    assert_eq!(
        changed(Node::Light(0), "ekkjjjjjjjjl"),
        light("inf", "shadow_off")
    );
    let typed = "ei<Back><Back><Back>sun<Enter>";
    assert!(changed(Node::Light(0), typed).is_empty());
    let mut app = at(Node::Light(0));
    press(&mut app, typed);
    let refused = app
        .cursor
        .typing
        .as_ref()
        .and_then(|typing| typing.refused.clone());
    let refused = refused.expect("sun is not a source");
    assert!(
        refused.expected.contains("pnt or inf or amb"),
        "{refused:?}"
    );
}

#[test]
fn the_courses_word_for_an_intersection_is_known_and_kept() {
    let combined = |word: &str| format!("obj CSG ID 3 {word} ID 1 ID 2");
    let scene = SCENE.replace(&combined("difference"), &combined("intersect"));
    for (said, word) in [
        ("", "intersect"),
        ("el", "difference"),
        ("eh", "union"),
        ("elh", "intersection"),
        ("elu", "intersect"),
        ("eiu<Enter>", "union"),
        (
            "elii<Back><Back><Back><Back><Back><Back><Back><Back><Back><Back><Back>intersect<Enter>",
            "intersect",
        ),
    ] {
        let (mut app, _) = opened_as("scene.dat", &scene);
        assert!(app.diagnostics.is_empty(), "{:?}", app.diagnostics);
        app.select(Node::Object(2));
        press(&mut app, said);
        let text = app.document.text();
        assert!(text.contains(&combined(word)), "{said}: {text}");
    }
}

#[test]
fn an_f_suffix_is_dropped_by_the_next_edit() {
    let scene = SCENE.replace("3 0 0  1\n", "3 0 0  0.50f\n");
    for (said, radius) in [
        ("e", "0.50f"),
        ("ejjl", "0.60"),
        ("ejji<Enter>", "0.50f"),
        ("ejj2F<Enter>", "2"),
        ("ejjlu", "0.50f"),
    ] {
        let (mut app, _) = opened_as("scene.dat", &scene);
        app.select(Node::Object(3));
        press(&mut app, said);
        let text = app.document.text();
        let said_so = format!("3 0 0  {radius}\n");
        assert!(text.ends_with(&said_so), "{said}: {text}");
    }
}

#[test]
fn nudging_a_reference_cycles_through_existing_ids() {
    let ball = |material: u8| [format!("obj sphere ID 1 mat ID {material}  0 0 0  1")];
    assert_eq!(changed(Node::Object(0), "el"), ball(7));
    assert_eq!(changed(Node::Object(0), "eh"), ball(7));
    assert_eq!(changed(Node::Object(0), "e7<Enter>"), ball(7));
    assert!(changed(Node::Object(0), "e5<Enter>").is_empty());
    let combined = changed(Node::Object(2), "ejl");
    assert_eq!(combined, ["obj CSG ID 3 difference ID 2 ID 2"]);
}

#[test]
fn objects_are_hidden_and_shown_by_the_render_record() {
    assert_eq!(changed(Node::Object(3), "h"), ["render 1 ID 3"]);
    let mut app = at(Node::Object(0));
    press(&mut app, "h");
    assert_eq!(
        (app.document.text(), words(&app)),
        (
            SCENE,
            "object 1 (sphere) is part of object 3 (CSG): h there shows or hides it"
        )
    );
    let mut app = at(Node::Object(3));
    assert_eq!(app.source().drawn(3), Some(1));
    press(&mut app, "h");
    assert_eq!(
        (app.source().drawn(3), words(&app)),
        (None, "hidden: object 4 (sphere)")
    );
    assert_eq!(app.scene.as_ref().map(|scene| scene.objects.len()), Some(1));
    press(&mut app, "h");
    assert_eq!(app.source().drawn(3), Some(1));
    press(&mut app, "h");
    app.select(Node::Object(2));
    press(&mut app, "h");
    assert_eq!(words(&app), "the last visible object cannot be hidden");
    app.select(Node::Light(0));
    press(&mut app, "h");
    assert_eq!(words(&app), "only objects can be shown or hidden");
}

#[test]
fn a_combination_shows_its_parts() {
    assert_eq!(
        at(Node::Object(2)).cursor.parts(),
        [(1, Node::Object(0)), (1, Node::Object(1))]
    );
    assert_eq!(at(Node::Object(0)).cursor.parts(), []);
}

#[test]
fn saving_a_view_keeps_the_numbers_that_did_not_change() {
    let camera = |scene: &str, said: &str| {
        let (mut app, _) = opened_as("scene.dat", scene);
        press(&mut app, said);
        app.document.text().lines().next().map(str::to_owned)
    };
    let turned = camera(SCENE, "vlS").expect("a camera");
    assert!(turned.ends_with("  0 0 0  0 0 1  1 0.1 100"), "{turned}");
    assert!(!SCENE.contains(&turned), "{turned}");
    let exact = SCENE.replace("-9 0  0 0 0", "-9 0  0.123456789 0 0");
    let turned = camera(&exact, "vlS").expect("a camera");
    assert!(turned.contains("  0.123456789 0 0  0 0 1  1 "), "{turned}");
    let exact = SCENE.replace("0 -9 0", "0.123456789 -9 0");
    let nearer = camera(&exact, "v]S").expect("a camera");
    assert!(nearer.contains(" 0.123456789 -9 0  0 0 0 "), "{nearer}");
}

#[test]
fn square_pixels_stay_square() {
    let scene = SCENE.replace("resolution .01 .01\nviewport 40 30", "viewport 400 300");
    let (mut app, _) = opened_as("scene.dat", &scene);
    press(&mut app, "v]S");
    let text = app.document.text();
    let said = text
        .lines()
        .find_map(|line| line.strip_prefix("resolution "));
    let (across, up) = said
        .and_then(|said| said.split_once(' '))
        .expect("a record");
    assert_eq!(across, up);
}

#[test]
fn a_scene_keeps_its_language() {
    let mut app = at(Node::View);
    let effects = press(&mut app, ":w other.ray<Enter>");
    assert!(
        matches!(effects[..], [Effect::CheckPlace(_)]),
        "{effects:?}"
    );
    assert_eq!(words(&app), "other.ray: the name must end in .dat");
    // The prompt suggests a valid name.
    press(&mut app, "<Esc>:w mine<Enter>");
    let line = app
        .overlays
        .prompt
        .as_ref()
        .map(|prompt| prompt.input.value());
    assert_eq!(line, Some("w mine.dat"));
    // What is typed replaces it.
    let effects = press(&mut app, ":w other.DAT<Enter>");
    assert!(wants(&effects, |effect| matches!(
        effect,
        Effect::Save { .. }
    )));
}

#[test]
fn a_hidden_object_is_not_framed_in_silence() {
    let mut app = at(Node::Object(3));
    press(&mut app, "vf");
    let framed = app.camera();
    assert_eq!(words(&app), "");
    press(&mut app, "<Esc>hvf");
    assert!(
        words(&app).ends_with("is not drawn: this is the whole scene"),
        "{}",
        words(&app)
    );
    assert_ne!(app.camera(), framed);
}
