//! Cancelling what is tried out while the file changes.

use super::*;
use crate::language::Node;

/// Tries something out on the first object, lets another program change the file, and cancels; then
/// only the change of the file is there.
#[track_caller]
fn check_cancelled(name: &str, text: &str, said: &str, (old, new): (&str, &str)) {
    let mut app = opened_as(name, text).0;
    app.select(Node::Object(0));
    press(&mut app, said);
    assert_ne!(app.document.text(), text, "{said}");
    let theirs = text.replacen(old, new, 1);
    read(&mut app, name, &theirs);
    assert_ne!(app.document.text(), theirs, "{said}: {}", words(&app));
    press(&mut app, "<Esc>");
    assert_eq!(app.document.text(), theirs, "{said}");
    assert!(words(&app).contains("cancelled"), "{}", words(&app));
    assert_eq!(app.error_count(), 0);
}

#[test]
fn what_is_tried_out_can_be_cancelled_after_a_merge() {
    let moved = ("4 0 0", "5 0 0");
    check_cancelled("a.ray", SCENE, "mx3", moved);
    check_cancelled("a.ray", SCENE, "ejjjcjL", moved);
    let moved = ("3 0 0", "5 0 0");
    check_cancelled("a.dat", dat::SCENE, "e<Enter><Down>", moved);
}

#[test]
fn what_cannot_be_cancelled_after_a_merge_says_so() {
    let mut app = open(SCENE);
    app.select(Node::Object(0));
    press(&mut app, "mx3");
    outside(&mut app, &SCENE.replace("4 0 0", "5 0 0"));
    outside(&mut app, &SCENE.replace("4 0 0", "6 0 0"));
    let text = app.document.text().to_owned();
    press(&mut app, "<Esc>");
    assert_eq!(app.document.text(), text);
    assert!(words(&app).contains("is kept"), "{}", words(&app));
}
