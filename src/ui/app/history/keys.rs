//! Keys of the page of the undo history.

use crossterm::event::KeyCode;

use super::page::go_to_chosen;
use super::undoing::{redo, undo};
use crate::app::room::Row;
use crate::keymap::{Context, Key, Scope, c, ctrl, key};

use KeyCode::{Enter, Esc};

const STEPS: Scope = Scope::These(&[Context::History]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(STEPS, "accept", &[key(Enter)], "go there").does(go_to_chosen),
    Key::new(STEPS, "undo", &[c('u')], "undo").requests(undo).when(|shared| shared.document.undoable().is_some()),
    Key::new(STEPS, "redo", &[ctrl('r')], "redo").requests(redo),
    Key::new(STEPS, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(STEPS, "back", &[key(Esc), c('q'), c('U')], "close").does(|shared| shared.overlays.page = None),
];
