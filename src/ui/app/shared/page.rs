//! Pages with a list to choose from: saved views, recently used scenes, the undo history.

use std::path::PathBuf;

use super::filter::Filter;
use super::steps::Steps;
use crate::language::SavedView;

/// A page with a list to choose from.
#[derive(Debug)]
pub struct Page {
    /// What is listed.
    pub list: List,
    /// The typed filter, and the cursor among the rows shown.
    pub filter: Filter,
    /// Whether keys are typed into the search.
    pub focus: PageFocus,
}

/// The effect of keys on a page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PageFocus {
    /// Keys scroll the page or close it.
    #[default]
    Lines,
    /// Keys are typed into the search.
    Search,
}

/// What a page lists.
#[derive(Debug)]
pub enum List {
    /// The saved views of the text of this revision.
    Views(Vec<SavedView>, u64),
    /// Recently used scenes, the newest first.
    Recent(Vec<PathBuf>),
    /// The steps of the undo history.
    Steps(Steps),
}

impl Page {
    /// A page with its cursor on the first row.
    pub(crate) fn new(list: List) -> Self {
        Self {
            list,
            filter: Filter::default(),
            focus: PageFocus::default(),
        }
    }

    /// The page of recently used scenes; `None` without any.
    pub(crate) fn recent(scenes: Vec<PathBuf>) -> Option<Self> {
        (!scenes.is_empty()).then(|| Self::new(List::Recent(scenes)))
    }

    /// The rows shown, each with its index in the list.
    pub fn rows(&self) -> Vec<(usize, String)> {
        let all: Vec<_> = match &self.list {
            List::Views(views, _) => views.iter().map(|view| view.name.clone()).collect(),
            List::Recent(paths) => paths
                .iter()
                .map(|path| path.display().to_string())
                .collect(),
            List::Steps(steps) => steps.rows.iter().map(|(_, name)| name.clone()).collect(),
        };
        let shown = self.filter.shown(all.iter().map(|row| (row.as_str(), "")));
        let row = |index: usize| Some((index, all.get(index)?.clone()));
        shown.into_iter().filter_map(row).collect()
    }

    /// The index in the list of the row under the cursor; `None` without rows.
    pub(crate) fn chosen(&self) -> Option<usize> {
        self.rows().get(self.filter.at).map(|&(index, _)| index)
    }

    /// Moves the cursor to a row by its index in the list, if that is shown.
    pub(crate) fn choose(&mut self, index: usize) {
        let mut rows = self.rows().into_iter();
        if let Some(at) = rows.position(|(row, _)| row == index) {
            self.filter.at = at;
        }
    }

    /// Moves the cursor.
    pub(crate) fn go(&mut self, rows: isize) {
        self.filter.go(rows, self.rows().len());
    }
}
