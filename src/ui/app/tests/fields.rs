//! Entering words: the first character typed replaces the old one.

use super::*;
use crate::language::Node;

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
