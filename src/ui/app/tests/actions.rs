//! What every action that edits the text does in each language: a text and keys in, a text or a
//! message out, as tables.

mod dat;
mod ray;
mod xml;

use super::*;
use crate::language::Node;
use crate::ui::app::command;
use crate::ui::keymap::{Keymap, NamedHere, Section};
use Node::{Light, Material, Object, Texture, View};

/// A row of a table: what is selected, and what keys do then.
struct Row {
    doing: Doing,
    node: Node,
    keys: &'static str,
    outcome: Outcome,
}

/// What a row is about.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    /// What keys of this name do.
    Key(&'static str),
    /// A command of the palette.
    Command(&'static str),
    /// A thing that can be added.
    Add(&'static str),
    /// Typing a word in place of another.
    Word,
}

/// What keys do.
enum Outcome {
    /// The text after replacements, which one undo takes back.
    Becomes(&'static [(&'static str, &'static str)]),
    /// The text stays the same, and this message says why.
    Says(&'static str),
}

use Doing::{Add, Command, Key, Word};
use Outcome::{Becomes, Says};

const fn row(doing: Doing, node: Node, keys: &'static str, outcome: Outcome) -> Row {
    Row {
        doing,
        node,
        keys,
        outcome,
    }
}

const LANGUAGES: [(&str, &str, &[Row]); 3] = [
    ("scene.ray", ray::TEXT, ray::ROWS),
    ("scene.dat", dat::TEXT, dat::ROWS),
    ("scene.xml", xml::TEXT, xml::ROWS),
];

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
    let mut wrong = Vec::new();
    for (name, text, rows) in LANGUAGES {
        for row in rows {
            let keys = row.keys;
            let (mut app, _) = opened_as(name, text);
            assert_eq!(app.reported.len(), 0, "{name}");
            app.select(row.node);
            press(&mut app, keys);
            let changed = app.document.text().to_owned();
            let (expected, reason) = match row.outcome {
                Becomes(changes) => (replaced(text, changes), None),
                Says(reason) => (text.to_owned(), Some(reason)),
            };
            let said = words(&app).to_owned();
            if changed != expected || reason.is_some_and(|reason| reason != said) {
                wrong.push(format!("{name} {keys}: {said:?}\n{changed}"));
            }
            assert_eq!(app.error_count(), 0, "{name} {keys}");
            if reason.is_some() {
                continue;
            }
            let step = app.document.undoable().map(ToString::to_string);
            assert!(
                step.is_some_and(|step| step != "edit"),
                "{name} {keys}: unnamed"
            );
            press(&mut app, "u");
            assert_eq!(app.document.text(), text, "{name} {keys}: undone");
            press(&mut app, "<Ctrl-r>");
            assert_eq!(app.document.text(), changed, "{name} {keys}: redone");
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[track_caller]
fn replaced(text: &str, changes: &[(&str, &str)]) -> String {
    changes.iter().fold(text.to_owned(), |text, (old, new)| {
        assert!(text.contains(old), "{old}");
        text.replacen(old, new, 1)
    })
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
    for (name, text, rows) in LANGUAGES {
        let (app, _) = opened_as(name, text);
        let additions = app.source().additions().iter();
        let additions = additions.map(|addition| Add(addition.name));
        let commands = EDITING.iter().map(|&command| Command(command));
        let keys = EDITING_KEYS.iter().map(|&key| Key(key));
        for doing in keys.chain(commands).chain(additions) {
            let mut doings = rows.iter().map(|row| row.doing);
            assert!(doings.any(|row| row == doing), "{name} lacks {doing:?}");
        }
    }
}
