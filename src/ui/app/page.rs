//! Pages with a list to choose from: saved views, recently used scenes.

use std::path::PathBuf;

use tui_input::Input;

use super::cursor::moved;
use crate::language::SavedView;

/// A page with a list to choose from.
#[derive(Debug)]
pub struct Page {
    /// What is listed.
    pub list: List,
    /// The row of the cursor among those shown.
    pub at: usize,
    /// Only rows containing this text are shown.
    pub search: Input,
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
}

impl Page {
    /// A page with its cursor on the first row.
    pub(in crate::ui) fn new(list: List) -> Self {
        Self {
            list,
            at: 0,
            search: Input::default(),
            focus: PageFocus::default(),
        }
    }

    /// The page of recently used scenes; `None` without any.
    pub(super) fn recent(scenes: Vec<PathBuf>) -> Option<Self> {
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
        };
        let search = self.search.value().to_lowercase();
        let is_found = |(_, row): &(usize, String)| row.to_lowercase().contains(&search);
        all.into_iter().enumerate().filter(is_found).collect()
    }

    /// The index in the list of the row under the cursor; `None` without rows.
    pub(super) fn chosen(&self) -> Option<usize> {
        self.rows().get(self.at).map(|&(index, _)| index)
    }

    /// Moves the cursor.
    pub(super) fn go(&mut self, rows: isize) {
        self.at = moved(self.at, rows, self.rows().len());
    }
}
