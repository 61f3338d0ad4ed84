//! Keys of the page of the sample scenes.

use crossterm::event::KeyCode;

use super::page::open_chosen;
use crate::app::room::Row;
use crate::keymap::{Context, Key, Scope, c, key};

use KeyCode::{Enter, Esc};

const SAMPLES: Scope = Scope::These(&[Context::Samples]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(SAMPLES, "accept", &[key(Enter)], "open a copy").requests(open_chosen),
    Key::new(SAMPLES, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(SAMPLES, "back", &[key(Esc), c('q')], "close").does(|shared| shared.overlays.page = None),
];
