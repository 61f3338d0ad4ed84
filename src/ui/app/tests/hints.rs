//! The hints for keys: only those that would do something.

use super::*;
use crate::language::Node;

/// The hints after keys on a node of [`SCENE`].
fn hints(node: Node, said: &str) -> Vec<&'static str> {
    let mut app = open(SCENE);
    app.select(node);
    press(&mut app, said);
    app.hints().into_iter().map(|(_, words)| words).collect()
}

#[test]
fn keys_are_hinted_only_where_they_do_something() {
    use Node::{Ambient, Object, View};
    for (node, said, words, is_hinted) in [
        (Object(0), "e", "colour", false),
        (Object(0), "ejj", "colour", true),
        (Object(0), "e", "step", true),
        (Object(0), "e", "orthonormalise", false),
        (Object(0), "", "move it", true),
        (Ambient, "", "move it", false),
        (View, "", "move it", false),
        (Object(0), "", "undo", false),
        (Object(0), "D", "undo", true),
        (Object(0), "", "save", false),
        (Object(0), "D", "save", true),
        (View, "v", "reset", false),
        (View, "vh", "reset", true),
        (View, "vh0", "save view", false),
        (View, "vh", "save view", true),
    ] {
        let hints = hints(node, said);
        assert_eq!(
            hints.contains(&words),
            is_hinted,
            "{said} {words}: {hints:?}"
        );
    }
}

#[test]
fn an_oblique_frame_hints_how_to_correct_it() {
    let oblique = SCENE.replace(
        "sphere\n4 0 0\n1\n",
        "box\n4 0 0 1 .1 0 0 1 0 0 0 1 1 1 1\n",
    );
    let mut app = open(&oblique);
    app.select(Node::Object(1));
    press(&mut app, "e");
    let is_hinted = |app: &App| {
        let mut hints = app.hints().into_iter();
        hints.any(|(key, words)| (key.as_str(), words) == ("O", "orthonormalise"))
    };
    assert!(is_hinted(&app));
    press(&mut app, "O");
    assert!(!is_hinted(&app), "{}", app.document.text());
}

#[test]
fn words_have_no_steps() {
    let (mut app, _) = opened_as("scene.dat", dat::SCENE);
    app.select(Node::Light(0));
    press(&mut app, "e");
    let hints: Vec<_> = app.hints().into_iter().map(|(_, words)| words).collect();
    assert!(
        hints.contains(&"nudge") && !hints.contains(&"step"),
        "{hints:?}"
    );
}
