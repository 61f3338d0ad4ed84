//! What every action that edits the text does in each language: a text and keys in, a text or a
//! message out, as tables.

mod dat;
mod ray;
mod xml;

use super::*;
use crate::language::Neighbour::{Next, Previous};
use crate::language::Node;
use crate::ui::app::command;
use crate::ui::keymap::Action as A;
use crate::ui::keymap::Stride::{Coarse, Fine, Plain};
use crate::ui::keymap::Tool::{Move, Rotate, Scale};
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
    /// An action of a key.
    Key(A),
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

/// Whether an action itself changes the text. What only begins or continues a change belongs to the
/// rows of that change: adding to those of each thing that can be added. Undo ends every row, and
/// merges have tests of their own.
fn edits(action: A) -> bool {
    match action {
        A::Visibility
        | A::Delete
        | A::Duplicate
        | A::Reorder(_)
        | A::Insert
        | A::Rename
        | A::Retype
        | A::Transform(_)
        | A::Choose
        | A::Type
        | A::Colour
        | A::Orthonormalise
        | A::Nudge(..)
        | A::SaveView
        | A::DeleteView
        | A::Cure => true,
        A::Move(_)
        | A::Page(_)
        | A::First
        | A::Last
        | A::Cycle(_)
        | A::Go(_)
        | A::Back
        | A::Accept
        | A::Fold(_)
        | A::Search
        | A::SearchAgain(_)
        | A::Command
        | A::Outline
        | A::Symbols
        | A::Mark
        | A::Add
        | A::Copy
        | A::Solo
        | A::Step(..)
        | A::Steps
        | A::Lock(_)
        | A::Snap
        | A::Stride(_)
        | A::Component(_)
        | A::Orbit(..)
        | A::Pan(..)
        | A::Dolly(_)
        | A::Turn(..)
        | A::Advance(_)
        | A::Roll(_)
        | A::Widen(_)
        | A::ResetView
        | A::FrameSelected
        | A::LightView
        | A::SavedViews
        | A::Cross(..)
        | A::Pin
        | A::Flip
        | A::Wipe
        | A::SlideWipe(_)
        | A::Difference
        | A::Worst(_)
        | A::OnTrack(_)
        | A::Explain
        | A::Sample(_)
        | A::Stop
        | A::Pause
        | A::Magnify(_)
        | A::Scroll(..)
        | A::OneToOne
        | A::Region
        | A::Corner(..)
        | A::OtherCorner
        | A::Export
        | A::Save
        | A::Undo
        | A::Redo
        | A::Editor
        | A::Errors
        | A::Messages
        | A::Help
        | A::Zoom
        | A::Resize(_)
        | A::Divide(_)
        | A::Show(_)
        | A::Share(_)
        | A::Expose(_)
        | A::Denoise
        | A::Wireframe
        | A::Integrator
        | A::Repaint
        | A::Suspend
        | A::Quit
        | A::Interrupt
        | A::Mine
        | A::Theirs
        | A::AllMine
        | A::AllTheirs
        | A::No => false,
    }
}

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
    let keys = keymap::Keymap::default().actions(Mode::Select).into_iter();
    let keys = keys.map(|named| named.action).chain([A::DeleteView]);
    let keys: Vec<_> = keys.filter(|action| edits(*action)).map(Key).collect();
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
        for doing in keys.iter().copied().chain(commands).chain(additions) {
            let mut doings = rows.iter().map(|row| row.doing);
            assert!(doings.any(|row| row == doing), "{name} lacks {doing:?}");
        }
    }
}
