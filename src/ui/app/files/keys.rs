//! Keys of the page of recently used scenes.

use crossterm::event::KeyCode;

use super::other_scene::open_recent;
use crate::app::room::Row;
use crate::keymap::{Context, Key, Scope, c, key};

use KeyCode::{Enter, Esc};

const RECENT: Scope = Scope::These(&[Context::Recent]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(RECENT, "accept", &[key(Enter)], "open it").requests(open_recent),
    Key::new(RECENT, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(RECENT, "back", &[key(Esc), c('q')], "close").does(|shared| shared.overlays.page = None),
];
