//! Random sequences of changes by keys: no text on the way has an error, and undo and redo restore
//! every byte.

use std::sync::Arc;

use super::*;
use language::Source;
use scene::Meshes;

/// The number of sequences in each scene.
const SEQUENCES: usize = 10;
/// The number of changes in a sequence.
const CHANGES: usize = 12;

const SCENES: [(&str, &str); 6] = [
    ("a.ray", include_str!("../../../../../scenes/default.ray")),
    ("b.ray", include_str!("../../../../../scenes/example.ray")),
    (
        "a.dat",
        include_str!("../../../../../scenes/still-life.dat"),
    ),
    ("b.dat", include_str!("../../../../../scenes/pool.dat")),
    ("a.xml", include_str!("../../../../../scenes/courtyard.xml")),
    ("b.xml", include_str!("../../../../../scenes/carousel.xml")),
];

/// Changes of whatever is selected; what means nothing there changes nothing.
const KEYS: &str = "\
    d dy <Space><Space>dy D <Space><Space>D J K yGp y<Space><Space>jjp \
    R<Ctrl-u>900<Enter> R<Ctrl-u>1<Enter> c<Enter> cj<Down><Enter> \
    asphere<Enter> abox<Enter> alight<Enter> amaterial<Enter> <Space><Space>aunion<Enter> \
    h mx1<Enter> tz30<Enter> s2<Enter> elL<Esc> e3<Enter><Esc> u <Ctrl-r>";

#[test]
fn random_sequences_by_keys_leave_no_error_and_are_undone_to_the_byte() {
    let mut below = random(19);
    let all: Vec<_> = KEYS.split(' ').collect();
    let mut changed = 0;
    for (name, text) in SCENES {
        for _ in 0..SEQUENCES {
            let (mut app, _) = opened_as(name, text);
            for _ in 0..CHANGES {
                let node = app.shared.nodes().get(below(app.shared.nodes().len()));
                app.shared.select(node.expect("there is a view"));
                let keys = all[below(all.len())];
                let before = app.shared.document.shared_text();
                press(&mut app, keys);
                settle(&mut app);
                if *before != app.shared.document.text() {
                    changed += 1;
                    check_text(&app, &format!("{name} {node:?} {keys}"));
                }
            }
            let last = app.shared.document.shared_text();
            to_the_end(&mut app, "u", "nothing to undo");
            assert_eq!(app.shared.document.text(), text, "{name}: undone");
            to_the_end(&mut app, "<Ctrl-r>", "nothing to redo");
            // What was undone on the way is ahead of the last text.
            while app.shared.document.text() != *last && app.shared.document.undo().is_some() {}
            assert_eq!(app.shared.document.text(), *last, "{name}: redone");
        }
    }
    let least = SCENES.len() * SEQUENCES * CHANGES / 3;
    assert!(least < changed, "{changed}");
}

/// Leaves questions, menus and modes.
#[track_caller]
fn settle(app: &mut App) {
    for _ in 0..4 {
        press(app, "<Esc>");
    }
    assert_eq!(app.shared.context(), keymap::Context::In(Mode::Select));
    assert_eq!(app.shared.typed_line(), None);
}

/// Checks that the text has no error, also if it is read anew.
#[track_caller]
fn check_text(app: &App, said: &str) {
    let text = app.shared.document.shared_text();
    assert_eq!(app.shared.error_count(), 0, "{said}\n{text}");
    let mut source = Source::new(app.shared.document.language(), Arc::clone(&text));
    let lowered = source.lower(&Meshes::default());
    let found = lowered.expect("there is memory").diagnostics;
    assert_eq!(found.errors(), 0, "{said}\n{text}");
}

/// Presses a key until it says that there is nothing left.
fn to_the_end(app: &mut App, key: &str, end: &str) {
    while words(app) != end {
        press(app, key);
        assert_eq!(
            app.shared.error_count(),
            0,
            "{}",
            app.shared.document.text()
        );
    }
}
