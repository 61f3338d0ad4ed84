//! What every action that edits the text does in each language: a text and keys in, a text or a
//! message out, as tables.
//!
//! A row names what it is about: keys by their name, a command after `:`, a thing after `add`, or a
//! `word` that is typed; then come the node that is selected, the keys, and how they change the text
//! in one step, or what is said instead. Lines that begin with `|` or `&` continue a row.

mod dat;
mod ray;
mod xml;

use super::rows::scene;
use super::*;
use crate::ui::app::command;
use crate::ui::keymap::{Keymap, NamedHere, Section};

const LANGUAGES: [(&str, &str, &str); 3] = [
    ("scene.ray", ray::TEXT, ray::ROWS),
    ("scene.dat", dat::TEXT, dat::ROWS),
    ("scene.xml", xml::TEXT, xml::ROWS),
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

/// The names of keys that themselves change the text. What only begins or continues a change belongs
/// to the rows of that change: adding to those of each thing that can be added. Undo ends every row,
/// and merges have tests of their own.
const EDITING_KEYS: &[&str] = &[
    "visibility",
    "delete",
    "duplicate",
    "reorder-up",
    "reorder-down",
    "paste",
    "rename",
    "change-type",
    "move",
    "rotate",
    "scale",
    "choose",
    "type",
    "pick-colour",
    "orthonormalise",
    "nudge-up",
    "nudge-down",
    "nudge-up-coarse",
    "nudge-down-coarse",
    "nudge-up-fine",
    "nudge-down-fine",
    "write-view",
    "delete-view",
    "cure",
];
/// Those that leave it as it is.
const OTHER_KEYS: &[&str] = &[
    "back",
    "help",
    "command",
    "save",
    "export",
    "trace",
    "pin",
    "compare",
    "undo",
    "redo",
    "history",
    "errors",
    "messages",
    "editor",
    "track",
    "key",
    "panels",
    "larger-panels",
    "smaller-panels",
    "smaller-list",
    "larger-list",
    "darker",
    "brighter",
    "denoise",
    "integrator",
    "redraw",
    "suspend",
    "quit",
    "interrupt",
    "orbit-left",
    "orbit-down",
    "orbit-up",
    "orbit-right",
    "nearer",
    "farther",
    "pan-left",
    "pan-down",
    "pan-up",
    "pan-right",
    "fly",
    "turn-left",
    "turn-down",
    "turn-up",
    "turn-right",
    "forward",
    "backward",
    "camera",
    "frame-selection",
    "reset-view",
    "view-from-light",
    "saved-views",
    "narrower-view",
    "wider-view",
    "roll-left",
    "roll-right",
    "edit",
    "list",
    "flip",
    "wipe",
    "wipe-left",
    "wipe-right",
    "wipe-left-far",
    "wipe-right-far",
    "difference",
    "zoom-in",
    "zoom-out",
    "explain",
    "next-worst",
    "previous-worst",
    "show-light",
    "show-depth",
    "show-normals",
    "show-objects",
    "show-albedo",
    "show-cost",
    "show-samples",
    "show-noise",
    "next-share",
    "previous-share",
    "wireframe",
    "next-number",
    "smaller-steps",
    "larger-steps",
    "previous-number",
    "accept",
    "inspect",
    "cross-left",
    "cross-down",
    "cross-up",
    "cross-right",
    "cross-left-far",
    "cross-down-far",
    "cross-up-far",
    "cross-right-far",
    "solo",
    "fold",
    "unfold",
    "previous-sample",
    "next-sample",
    "down",
    "up",
    "first",
    "last",
    "page-down",
    "page-up",
    "search",
    "mine",
    "theirs",
    "all-mine",
    "all-theirs",
    "no",
    "copy",
    "mark",
    "add",
    "next-item",
    "fold-all",
    "unfold-all",
    "outline",
    "symbols",
    "next-match",
    "previous-match",
    "previous-item",
    "stop",
    "play",
    "next-frame",
    "previous-frame",
    "next-key",
    "previous-key",
    "frames-forward",
    "frames-back",
    "first-frame",
    "last-frame",
    "undo-key",
    "edit-track",
    "scroll-left",
    "scroll-down",
    "scroll-up",
    "scroll-right",
    "one-to-one",
    "pause",
    "region",
    "corner-left",
    "corner-down",
    "corner-up",
    "corner-right",
    "corner-left-far",
    "corner-down-far",
    "corner-up-far",
    "corner-right-far",
    "other-corner",
    "step-left",
    "step-down",
    "step-up",
    "step-right",
    "step-left-far",
    "step-down-far",
    "step-up-far",
    "step-right-far",
    "lock-x",
    "lock-y",
    "lock-z",
    "snap",
];

/// Commands that edit the text.
const EDITING: &[&str] = &["view save", "size", "set", "mesh"];
/// Those that leave it as it is.
const OTHERS: &[&str] = &[
    "w",
    "w!",
    "q",
    "q!",
    "wq",
    "e",
    "new",
    "recent",
    "history",
    "export",
    "export!",
    "export cancel",
    "render",
    "compare",
    "track",
    "until",
    "region",
    "zoom",
    "view light",
    "view reset",
    "show uv",
    "show side",
    "exposure",
    "transfer linear",
    "transfer srgb",
    "transfer scene",
    "falsecolour",
    "denoise",
    "histogram",
    "mouse",
    "theme dark",
    "theme light",
    "theme mono",
    "pixels",
    "help",
];

#[test]
fn every_action_edits_as_its_rows_say_and_is_undone_in_one_step() {
    for (name, text, table) in LANGUAGES {
        let stage = scene(name, text).after("| not reported");
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

#[test]
fn every_action_and_command_that_edits_has_a_row_in_every_language() {
    for section in Section::all() {
        for NamedHere { name, .. } in Keymap::default().actions_in(section) {
            let is_either = EDITING_KEYS.contains(&name) != OTHER_KEYS.contains(&name);
            assert!(is_either, "does the key {name} edit the text?");
        }
    }
    for command in command::all_described() {
        let name = command.name;
        let is_either = EDITING.contains(&name) != OTHERS.contains(&name);
        assert!(is_either, "does :{name} edit the text?");
    }
    for (name, text, table) in LANGUAGES {
        let (app, _) = opened_as(name, text);
        let additions = app.shared.source().additions().iter();
        let additions = additions.map(|addition| format!("add {}", addition.name));
        let commands = EDITING.iter().map(|command| format!(":{command}"));
        let keys = EDITING_KEYS.iter().map(ToString::to_string);
        for doing in keys.chain(commands).chain(additions) {
            let begins = format!("{doing} | ");
            let has_row = rows(table).iter().any(|row| row.starts_with(&begins));
            assert!(has_row, "{name} lacks {doing}");
        }
    }
}
