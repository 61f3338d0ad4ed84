//! The rows of keys: what each does, whether it would do something now, and what is said of it.

mod anywhere;
mod camera;
mod compare;
mod display;
mod edit;
mod inspect;
mod lists;
mod pages;
mod questions;
mod row;
mod select;
mod sequence;
#[cfg(test)]
mod tests;
mod trace;
mod transform;

use super::App;
use crate::ui::keymap::{Entry, Keymap, RowId};
use crate::ui::msg::Effect;
use row::{Row, Step};

/// All rows, one slice a file. A key that is not bound where it is pressed is answered with the first
/// row that has it elsewhere, so that their order matters. Ctrl-H, Ctrl-I, Ctrl-M and Ctrl-[ send the
/// same bytes as Backspace, Tab, Enter and Esc, and are therefore never bound.
const ROWS: &[&[Row]] = &[
    lists::KEYS,
    questions::KEYS,
    pages::KEYS,
    select::KEYS,
    transform::KEYS,
    sequence::KEYS,
    inspect::KEYS,
    edit::KEYS,
    camera::KEYS,
    compare::KEYS,
    display::KEYS,
    trace::KEYS,
    anywhere::KEYS,
];

fn rows() -> impl Iterator<Item = &'static Row> {
    ROWS.iter().copied().flatten()
}

impl Default for Keymap {
    fn default() -> Self {
        Self::new(rows().map(|row| row.key))
    }
}

impl App {
    /// Does what the keys of a row do.
    pub(super) fn act(&mut self, RowId(at): RowId) -> Vec<Effect> {
        match rows().nth(at).map(|row| row.step) {
            Some(Step::Does(step)) => {
                step(self);
                Vec::new()
            }
            Some(Step::Requests(step)) => step(self),
            None => Vec::new(),
        }
    }

    /// The hints for the keys that do something now, the most useful first.
    pub fn hints(&self) -> Vec<Entry> {
        let acts = |RowId(at): RowId| rows().nth(at).is_some_and(|row| (row.acts)(self));
        self.keymap.hints(self.context(), acts)
    }
}
