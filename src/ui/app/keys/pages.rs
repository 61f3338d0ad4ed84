//! Keys of the pages that are only read: the help and the messages.

use crossterm::event::KeyCode;

use crate::app::room::Row;
use crate::keymap::{Context, Key, Scope, c, key};

use KeyCode::Esc;
use Scope::These;

const HELP: Scope = These(&[Context::Help]);
const MESSAGES: Scope = These(&[Context::Messages]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(HELP, "search", &[c('/')], "search").also("find").does(|shared| shared.overlays.open_search()),
    Key::new(MESSAGES, "back", &[key(Esc), c('q'), c('M')], "close").does(|shared| shared.overlays.page = None),
    Key::new(HELP, "back", &[key(Esc), c('q'), c('?')], "close").does(|shared| shared.overlays.page = None),
];
