//! A list that typing filters, shared by menus and pages.

use crossterm::event::KeyEvent;
use tui_input::Input;

use super::cursor::moved;
use super::line;
use crate::matching::{self, Likeness, Searched};

/// A typed text that filters the rows of a list, and the cursor among the rows that it leaves.
#[derive(Debug, Default)]
pub struct Filter {
    /// Only rows that answer this text are shown.
    pub input: Input,
    /// The place of the cursor among the rows shown.
    pub at: usize,
    /// Its place while all rows are shown.
    home: usize,
}

impl Filter {
    /// No filter, with the cursor on a row.
    pub(crate) fn at(at: usize) -> Self {
        Self {
            input: Input::default(),
            at,
            home: at,
        }
    }

    /// The text typed, in lower case and without surrounding blanks.
    fn typed(&self) -> String {
        self.input.value().trim().to_lowercase()
    }

    /// The indices of the rows shown, given the name and the description of each: the best answers to the
    /// typed text first, each with whether it is only a guess at what that means.
    pub(crate) fn shown<'r>(
        &self,
        rows: impl Iterator<Item = (&'r str, &'r str)>,
    ) -> Vec<(usize, bool)> {
        let rows = rows.enumerate().map(|(index, (name, words))| {
            let row = Searched {
                name,
                words,
                ..Searched::default()
            };
            (row, index)
        });
        let ranked = matching::ranked(rows, self.input.value()).into_iter();
        // What begins otherwise is hardly meant, and would be chosen.
        let ranked = ranked.filter(|&(likeness, _)| likeness < Likeness::MisspeltStart);
        let shown = ranked.map(|(likeness, index)| (index, likeness.is_guess()));
        shown.collect()
    }

    /// Handles a key other than those that end the list, of which `count` rows are shown: arrows,
    /// Tab, Ctrl-N and Ctrl-P move around the end, others edit the text.
    pub(crate) fn key(&mut self, key: KeyEvent, count: usize) {
        let Some(rows) = line::rows(key) else {
            let before = self.typed();
            line::edit(&mut self.input, key);
            if self.typed() != before {
                self.go_to_best();
            }
            return;
        };
        let at = self.at as isize + rows;
        self.at = at.rem_euclid(count.max(1) as isize) as usize;
    }

    /// Inserts pasted text.
    pub(crate) fn insert(&mut self, text: &str) {
        line::insert(&mut self.input, text);
        self.go_to_best();
    }

    /// Moves the cursor to the row that answers the typed text best.
    fn go_to_best(&mut self) {
        self.at = if self.typed().is_empty() {
            self.home
        } else {
            0
        };
    }

    /// Moves the cursor among `count` rows, as far as they go.
    pub(crate) fn go(&mut self, rows: isize, count: usize) {
        self.at = moved(self.at, rows, count);
    }
}

#[cfg(test)]
mod tests {
    use crossterm::event::{KeyCode, KeyModifiers};

    use super::*;

    #[test]
    fn rows_that_begin_with_the_typed_text_come_first() {
        let rows = [
            ("box", "six faces"),
            ("sphere", "round"),
            ("Ellipsoid", "a sphere"),
            ("hemisphere", ""),
        ];
        for (typed, shown) in [
            ("", vec![0, 1, 2, 3]),
            (" SPH", vec![1, 3, 2]),
            ("ell", vec![2]),
            ("elipsoid", vec![2]),
            ("cone", vec![]),
        ] {
            let filter = Filter {
                input: Input::from(typed),
                ..Filter::default()
            };
            let found = filter.shown(rows.into_iter()).into_iter();
            let found: Vec<_> = found.map(|(index, _)| index).collect();
            assert_eq!(found, shown, "{typed}");
        }
    }

    #[test]
    fn keys_move_around_the_end_or_filter() {
        let mut filter = Filter::at(2);
        filter.go(-2, 3);
        let control = |c| KeyEvent::new(KeyCode::Char(c), KeyModifiers::CONTROL);
        let mut at = |key| {
            filter.key(key, 3);
            filter.at
        };
        assert_eq!(at(KeyCode::Up.into()), 2);
        assert_eq!(at(control('n')), 0);
        assert_eq!(at(KeyCode::Tab.into()), 1);
        assert_eq!(at(control('p')), 0);
        assert_eq!(at(KeyCode::BackTab.into()), 2);
        assert_eq!(at(KeyCode::Char('x').into()), 0);
        assert_eq!(at(KeyCode::Left.into()), 0);
        assert_eq!(at(KeyCode::Delete.into()), 2, "all rows are shown again");
    }
}
