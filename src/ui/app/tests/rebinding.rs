//! Keys that the user has bound.

use super::*;
use crate::ui::app::command;
use crate::ui::keymap::{HelpLine, Keys, Section};

/// The interface with other keys in sections: `x` for undoing, none for what `u` did.
fn rebound() -> App {
    let mut app = open(SCENE);
    for (keys, name) in [("u", None), ("Ctrl-X u", Some("undo"))] {
        let keys = Keys::parse(keys).expect("keys");
        app.shared.keymap.bind(Section::Anywhere, keys, name);
    }
    app
}

#[test]
fn a_bound_key_acts_and_the_one_it_replaces_does_not() {
    let mut app = rebound();
    press(&mut app, "jjjjd");
    let deleted = app.shared.document.text().to_owned();
    press(&mut app, "u");
    assert_eq!(app.shared.document.text(), deleted);
    let words_of_u = "`u` in SEQUENCE (T): undo the last key; ? lists keys";
    assert_eq!(words(&app), words_of_u);
    press(&mut app, "<Ctrl-x>u");
    assert_eq!(app.shared.document.text(), SCENE);
}

#[test]
fn messages_name_the_bound_keys() {
    let mut app = open(SCENE);
    let select = Section::In(app.shared.context());
    for (keys, name) in [("x", None), ("F5", None), ("r", None), ("T", Some("trace"))] {
        let keys = Keys::parse(keys).expect("keys");
        app.shared.keymap.bind(select, keys, name);
    }
    assert_eq!(app.shared.key_for("trace"), "T");
    assert_eq!(app.shared.key_for("redo"), "Ctrl-R");
    assert_eq!(app.shared.key_for("stop"), ":cancel the export");
}

#[test]
fn what_is_said_after_keys_names_the_bound_ones() {
    for (section, keys, name, pressed, said) in [
        (
            "select",
            "Q",
            "back",
            " ",
            "1 item marked; Q clears the marks",
        ),
        (
            "select",
            "Q",
            "back",
            "/light<Enter>",
            "1 of 1; Q shows all",
        ),
        (
            "select",
            "Q",
            "search",
            "n",
            "nothing to search for: Q filters the list",
        ),
        (
            "select",
            "Q",
            "copy",
            "p",
            "nothing to paste: Q copies the selected item",
        ),
        (
            "select",
            "Q",
            "paste",
            "jjjy",
            "copied: object 1 (sphere); Q pastes it",
        ),
        ("select", "Q", "camera", "m", "Q moves the camera"),
        (
            "select",
            "Q",
            "solo",
            "jjjQ",
            "the preview shows only object 1 (sphere); Q shows everything",
        ),
        (
            "move",
            "Q",
            "accept",
            "jjjmw",
            "Q confirms the change first; Esc cancels it",
        ),
    ] {
        let mut app = open(SCENE);
        let section = Section::named(section).expect("a section");
        let keys = Keys::parse(keys).expect("keys");
        app.shared.keymap.bind(section, keys, Some(name));
        press(&mut app, pressed);
        assert_eq!(words(&app), said, "{pressed}");
    }
}

#[test]
fn help_hints_and_palette_show_the_bound_keys() {
    let mut app = rebound();
    let undo = HelpLine::Entry {
        keys: "Ctrl-X u".to_owned(),
        words: "undo",
    };
    assert!(
        command::help_columns(&app.shared, 80)
            .concat()
            .contains(&undo)
    );
    press(&mut app, "jjjD");
    let hints = app.hints();
    assert!(hints.contains(&("Ctrl-X u".to_owned(), "undo")));
    press(&mut app, ":undo");
    let found = command::completions(&app.shared).into_iter();
    let keys = found
        .filter(|found| found.shown == "undo")
        .map(|found| found.keys);
    assert_eq!(keys.collect::<Vec<_>>(), ["Ctrl-X u"]);
}
