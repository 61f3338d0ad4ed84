//! Pages over the screen, with lines to choose from or to read: saved views, recently used scenes, the undo
//! history, the messages so far, the help. What a page lists, and what choosing a row does, is up to its
//! room.

use super::filter::Filter;
use crate::keymap::Context;

/// A page over the screen.
#[derive(Debug)]
pub struct Page {
    /// Which page it is: the context of its keys.
    pub context: Context,
    /// The title of a page of rows.
    pub title: &'static str,
    /// The rows to choose from; none on a page that is only read.
    pub rows: Vec<String>,
    /// The typed filter or search, and the cursor among the rows that it leaves: on a page that is only
    /// read, the first line shown.
    pub filter: Filter,
    /// Whether keys are typed into the filter.
    pub focus: PageFocus,
}

/// The effect of keys on a page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PageFocus {
    /// Keys scroll the page or close it.
    #[default]
    Lines,
    /// Keys are typed into the filter.
    Search,
}

impl Page {
    /// A page of rows to choose from, with its cursor on the first.
    pub(crate) fn of(context: Context, title: &'static str, rows: Vec<String>) -> Self {
        Self {
            context,
            title,
            rows,
            filter: Filter::default(),
            focus: PageFocus::default(),
        }
    }

    /// A page that is only read, at its beginning.
    pub(crate) fn reading(context: Context) -> Self {
        Self::of(context, "", Vec::new())
    }

    /// Whether its lines are only read.
    pub(crate) fn is_read(&self) -> bool {
        matches!(self.context, Context::Help | Context::Messages)
    }

    /// Replaces the rows. The cursor stays in its place, or goes to the last row.
    pub(crate) fn list(&mut self, rows: Vec<String>) {
        self.rows = rows;
        let count = self.shown().len();
        self.filter.go(0, count);
    }

    /// The rows that the filter leaves, each with its index in the list.
    pub fn shown(&self) -> Vec<(usize, &str)> {
        let all = self.rows.iter().map(|row| (row.as_str(), ""));
        let shown = self.filter.shown(all).into_iter();
        let row = |(index, _): (usize, bool)| Some((index, self.rows.get(index)?.as_str()));
        shown.filter_map(row).collect()
    }

    /// The index in the list of the row under the cursor; `None` without rows.
    pub(crate) fn chosen(&self) -> Option<usize> {
        self.shown().get(self.filter.at).map(|&(index, _)| index)
    }

    /// Moves the cursor to a row by its index in the list, if that is shown.
    pub(crate) fn choose(&mut self, index: usize) {
        let mut rows = self.shown().into_iter();
        if let Some(at) = rows.position(|(row, _)| row == index) {
            self.filter.at = at;
        }
    }
}
