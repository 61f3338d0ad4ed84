//! Cancelling what is tried out while the file changes.

use super::*;
use crate::language::Node;
use crate::text::{Edit, Span};

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

/// Every attempt begins with the meaning of the text before the first one.
#[test]
fn an_attempt_keeps_nothing_of_the_one_before() {
    let text = "// view: eye 0 0 9 target 0 0 0\n.1 .1 .1  1  0 5 5  1 1 1  2\n\
        sphere 1 0 0 1  1 0 0  0 1 0  0 0 1  20 0 0 1\n\
        sphere 4 0 0 1  1 0 0  0 1 0  0 0 1  20 0 0 1\n";
    let put = |old: &str, new: &str| {
        let at = text.find(old).expect("it is there");
        Edit {
            span: Span::new(at, at + old.len()),
            text: new.to_owned(),
        }
    };
    let eye = || put("0 0 9", "0 0 8.5");
    let light = || put("0 5 5", "0 5.25 5");
    let [first, second] = [put("1 0 0 1", "2 0 0 1"), put("4 0 0 1", "5 0 0 1")];
    let mut app = open(text);
    let mut live_edit = app.begin_live_edit();
    for edits in [
        vec![eye(), first.clone()],
        vec![eye()],
        vec![light(), second.clone()],
        vec![light()],
        vec![first],
        vec![second],
        vec![eye()],
    ] {
        let tried = app.try_instead(&mut live_edit, |_| Ok(edits.clone()));
        assert_eq!(tried, Ok(()));
        let fresh = open(app.document.text());
        assert_eq!(app.scene, fresh.scene, "{edits:?}");
    }
    app.end_live_edit(live_edit);
    assert_eq!(app.scene, open(text).scene);
}
