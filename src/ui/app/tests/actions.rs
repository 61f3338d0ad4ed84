//! What every action that edits the text does in each language: a text and keys in, a text or a
//! message out, as tables.
//!
//! A row names what it is about: keys by their name, a command after `:`, a thing after `add`, or a
//! `word` that is typed; then come the node that is selected, the keys, and how they change the text
//! in one step, or what is said instead. Lines that begin with `|` or `&` continue a row. Parts of the
//! text and changes of it that several rows need have names.

mod dat;
mod ray;
mod xml;

use super::scripts::scene;
use super::*;
use crate::app::command;
use crate::keymap::Keymap;
use language::Node;

const LANGUAGES: [(&str, &str, &str, &str); 3] = [
    ("scene.ray", ray::TEXT, ray::NAMES, ray::ROWS),
    ("scene.dat", dat::TEXT, dat::NAMES, dat::ROWS),
    ("scene.xml", xml::TEXT, xml::NAMES, xml::ROWS),
];

/// The rows of a table, each on a line.
fn rows(table: &str) -> Vec<String> {
    let mut rows: Vec<String> = Vec::new();
    for line in table.lines().map(str::trim) {
        match rows.last_mut() {
            Some(row) if line.starts_with(['|', '&']) => *row = format!("{row} {line}"),
            _ if line.is_empty() || line.starts_with("//") => {}
            _ => rows.push(line.to_owned()),
        }
    }
    rows
}

#[test]
fn every_action_edits_as_its_rows_say_and_is_undone_in_one_step() {
    for (name, text, names, table) in LANGUAGES {
        let names = names.lines().filter_map(|line| line.split_once(" | "));
        let stage = names.fold(scene(name, text), |stage, (name, part)| {
            stage.with(name.trim(), part)
        });
        let stage = stage.after("| not reported");
        for row in rows(table) {
            let columns: Vec<_> = row.splitn(4, " | ").collect();
            let [_, node, keys, outcome] = columns[..] else {
                panic!("{row}");
            };
            let checks = match outcome.strip_prefix("says ") {
                Some(_) => format!("text opened | {outcome} | not errors"),
                None => format!("text {outcome} | undoable | not undoable edit | undoes"),
            };
            stage.session().run(&format!("[{node}] {keys} | {checks}"));
        }
    }
}

/// What changes the text of a scene, by itself: every key of a mode, pressed at an object or at one of its
/// fields, and every command.
fn editing(name: &str, text: &str) -> Vec<String> {
    let stage = || {
        let (mut app, _) = opened_as(name, text);
        app.shared.select(Node::Object(0));
        app
    };
    let edits = |app: &App| app.shared.document.undoable().is_some();
    let mut found = Vec::new();
    for mode in [Mode::Select, Mode::Edit] {
        for action in Keymap::default().actions(mode) {
            let mut app = stage();
            app.go(mode);
            if action.mode == mode && app.shared.mode == mode {
                app.act(action.row);
                found.extend(edits(&app).then(|| action.name.to_owned()));
            }
        }
    }
    for command in command::ROWS {
        let arguments = match command.usage().split_once(' ').map(|(_, usage)| usage) {
            Some("WxH") => "9x5",
            Some("KEY [VALUE|default]") => "depth 3",
            Some("[FILE]") => "a.obj",
            _ => "",
        };
        let mut app = stage();
        press(&mut app, &format!(":{} {arguments}<Enter>", command.name()));
        found.extend(edits(&app).then(|| format!(":{}", command.name())));
    }
    found
}

#[test]
fn everything_that_edits_has_a_row_in_every_language() {
    for (name, text, _, table) in LANGUAGES {
        let (app, _) = opened_as(name, text);
        let additions = app.shared.source().additions().iter();
        let additions = additions.map(|addition| format!("add {}", addition.name));
        let editing = editing(name, text);
        for known in ["duplicate", "reorder-down", "nudge-up", ":size"] {
            assert!(
                editing.iter().any(|found| found == known),
                "{name}: {known}"
            );
        }
        let elsewhere = LANGUAGES.iter().flat_map(|(.., table)| rows(table));
        let elsewhere = elsewhere.filter_map(|row| Some(row.split_once(" | ")?.0.to_owned()));
        let elsewhere = elsewhere.filter(|doing| !doing.starts_with("add ") && doing != "word");
        for doing in editing.into_iter().chain(additions).chain(elsewhere) {
            let begins = format!("{doing} | ");
            let has_row = rows(table).iter().any(|row| row.starts_with(&begins));
            assert!(has_row, "{name} lacks {doing}");
        }
    }
}
