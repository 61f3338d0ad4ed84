//! Keys of the pages: errors, saved views, recent scenes, undo history, help and messages.

use crossterm::event::KeyCode;

use crate::ui::app::room::Row;
use crate::ui::app::{camera, history, list};
use crate::ui::keymap::{Context, Key, Scope, c, ctrl, key};

use KeyCode::{Enter, Esc};
use Scope::These;

const ERRORS: Scope = These(&[Context::Errors]);
const VIEWS_PAGE: Scope = These(&[Context::Views]);
const RECENT: Scope = These(&[Context::Recent]);
const STEPS: Scope = These(&[Context::Steps]);
const HELP: Scope = These(&[Context::Help]);
const MESSAGES: Scope = These(&[Context::Messages]);

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(ERRORS, "accept", &[key(Enter)], "go to the item").hint(10, "go there").does(list::go_to_error),
    Key::new(VIEWS_PAGE, "accept", &[key(Enter)], "go there").requests(list::choose),
    Key::new(VIEWS_PAGE, "delete-view", &[c('d')], "delete it").does(camera::delete_view),
    Key::new(VIEWS_PAGE, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(VIEWS_PAGE, "back", &[key(Esc), c('q'), c('V')], "close").does(|shared| shared.overlays.page = None),
    Key::new(RECENT, "accept", &[key(Enter)], "open it").requests(list::choose),
    Key::new(RECENT, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(RECENT, "back", &[key(Esc), c('q')], "close").does(|shared| shared.overlays.page = None),
    Key::new(STEPS, "accept", &[key(Enter)], "go there").requests(list::choose),
    Key::new(STEPS, "undo", &[c('u')], "undo").requests(history::undo).when(|shared| shared.document.undoable().is_some()),
    Key::new(STEPS, "redo", &[ctrl('r')], "redo").requests(history::redo),
    Key::new(STEPS, "search", &[c('/')], "filter").does(|shared| shared.overlays.open_search()),
    Key::new(STEPS, "back", &[key(Esc), c('q'), c('U')], "close").does(|shared| shared.overlays.page = None),
    Key::new(HELP, "search", &[c('/')], "search").does(|shared| shared.overlays.open_search()),
    Key::new(MESSAGES, "back", &[key(Esc), c('q'), c('M')], "close").does(|shared| shared.overlays.past = None),
    Key::new(HELP, "back", &[key(Esc), c('q'), c('?')], "close").does(|shared| shared.overlays.help = None),
];
