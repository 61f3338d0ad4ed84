//! The lines of the help page.

use super::rows::ROWS;
use crate::app::{Shared, list};
use crate::keymap::{self, Context, HelpLine};

/// Minimum width of a column of the help page if there are several.
const HELP_COLUMN: u16 = 56;

/// Maximum number of columns of the help page.
const MOST_COLUMNS: usize = 3;

/// The columns of the help page on a screen of this width.
pub(crate) fn help_columns(shared: &Shared, width: u16) -> Vec<Vec<HelpLine>> {
    let help = shared.overlays.page(Context::Help);
    let search = help.map_or("", |help| help.filter.input.value());
    let commands = ROWS
        .iter()
        .map(|row| (row.usage(), row.words, row.synonyms));
    let lines = shared.keymap.help(search, shared.mode, commands.collect());
    let count = usize::from(width.saturating_sub(2) / HELP_COLUMN).clamp(1, MOST_COLUMNS);
    keymap::in_columns(lines, count)
}

/// Scrolls the help page no further than to its end.
pub(crate) fn scroll_help(shared: &mut Shared) {
    if shared.overlays.page(Context::Help).is_none() {
        return;
    }
    let columns = help_columns(shared, shared.terminal.0);
    let longest = columns.iter().map(Vec::len).max().unwrap_or(0);
    let last = longest.saturating_sub(list::help_rows(shared));
    if let Some(help) = shared.overlays.page_mut(Context::Help) {
        help.filter.at = help.filter.at.min(last);
    }
}
