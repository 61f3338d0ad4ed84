//! Changes of structure among very many objects: from the key to its answer and to the picture.

use std::time::{Duration, Instant};

use crate::desk::{Desk, Drawn};
use crate::figures::{SECOND, first, times_row};

/// A change of the first sphere, and what takes it back.
struct Change {
    name: &'static str,
    /// What is typed before.
    before: &'static str,
    key: &'static str,
    back: &'static str,
    back_name: &'static str,
    /// Whether the picture changes.
    is_seen: bool,
}

const CHANGES: [Change; 5] = [
    Change {
        name: "delete",
        before: "",
        key: "d",
        back: "u",
        back_name: "undo deletion",
        is_seen: true,
    },
    Change {
        name: "add",
        before: "asphere",
        key: "\r",
        back: "u",
        back_name: "undo addition",
        is_seen: true,
    },
    Change {
        name: "move step",
        before: "m",
        key: "L",
        back: "\x1b",
        back_name: "cancel move",
        is_seen: true,
    },
    Change {
        name: "duplicate",
        before: "",
        key: "D",
        back: "u",
        back_name: "undo duplicate",
        is_seen: false,
    },
    Change {
        name: "reorder",
        before: "",
        key: "J",
        back: "u",
        back_name: "undo reorder",
        is_seen: false,
    },
];

/// Times of keys.
#[derive(Default)]
struct Times {
    answered: Vec<Duration>,
    pictured: Vec<Duration>,
}

/// Measures changes of the selected sphere, and undoes them. After `wait` the picture has settled.
pub(super) fn measure(desk: &mut Desk, name: &str, target: &str, wait: Duration) {
    for change in &CHANGES {
        let (mut done, mut undone) = (Times::default(), Times::default());
        for _ in 0..7 {
            if !change.before.is_empty() {
                desk.press(change.before);
                desk.record(Instant::now() + SECOND / 2);
                desk.rest();
                desk.look();
            }
            done.take(desk, change.key, wait);
            undone.take(desk, change.back, wait);
        }
        for (name_of, times) in [(change.name, done), (change.back_name, undone)] {
            let field = "p95 <= 16, max 33";
            times_row(
                &format!("{name}: {name_of} to list"),
                &times.answered,
                field,
            );
            if change.is_seen {
                times_row(
                    &format!("{name}: {name_of} to picture"),
                    &times.pictured,
                    target,
                );
            }
        }
    }
}

impl Times {
    fn take(&mut self, desk: &mut Desk, key: &str, wait: Duration) {
        let pressed = desk.press(key);
        desk.record(pressed + wait);
        let drawn = desk.look();
        self.answered.extend(first(&drawn, pressed, |_| true));
        self.pictured
            .extend(first(&drawn, pressed, Drawn::is_new_picture));
    }
}
