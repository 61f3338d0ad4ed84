//! The page of recently used scenes.

use std::path::PathBuf;

use crate::app::{Page, Shared};
use crate::keymap::Context;

/// Shows recently used scenes.
pub(crate) fn show_recent(shared: &mut Shared, scenes: Vec<PathBuf>) {
    if scenes.is_empty() {
        shared.overlays.page = None;
        shared.say("no recently used scenes");
    } else {
        list_recent(shared, scenes);
    }
}

/// Opens the page of recently used scenes.
pub(super) fn list_recent(shared: &mut Shared, scenes: Vec<PathBuf>) {
    let rows = scenes.iter().map(|path| path.display().to_string());
    let page = Page::of(Context::Recent, "Recent scenes", rows.collect());
    shared.overlays.open_page(page);
    shared.disk.recent = scenes;
}
