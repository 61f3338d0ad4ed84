//! Keys of everything with lines: the list, the fields, and the pages.

use crossterm::event::KeyCode;

use crate::app::room::Row;
use crate::app::{edit, list};
use crate::keymap::{Context, Key, Mode, Scope, alt, c, key};

use Context::In;
use KeyCode::{Char, Down, End, Enter, Home, PageDown, PageUp, Up};
use Scope::{PagesAnd, These};

/// What has lines.
const LISTS: Scope = PagesAnd(&[
    In(Mode::Select),
    In(Mode::Edit),
    Context::Errors,
    Context::Colour,
    Context::Conflict,
    Context::Rays,
]);
/// What may have more lines than fit.
const LONG_LISTS: Scope = PagesAnd(&[In(Mode::Select), Context::Errors, Context::Rays]);
const SELECT: &[Context] = &[In(Mode::Select)];
const MOVED: &[Context] = &[Context::Errors, Context::Rays];
const EDIT: &[Context] = &[In(Mode::Edit)];
const COLOUR: &[Context] = &[Context::Colour];
const PAGES: &[Context] = Context::PAGES;
const CONFLICT: &[Context] = &[Context::Conflict];

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(LISTS, "down", &[c('j'), key(Down)], "down").also("next below scroll navigate cursor")
        .hint_in(SELECT, 0, "select").hint_in(MOVED, 0, "move").hint_in(EDIT, 0, "field").hint_in(COLOUR, 10, "row").hint_in(PAGES, 0, "down").hint_in(CONFLICT, 0, "down")
        .does(|shared| list::move_cursor(shared, 1)),
    Key::new(LISTS, "up", &[c('k'), key(Up)], "up").also("previous above scroll navigate cursor")
        .hint_in(SELECT, 0, "select").hint_in(MOVED, 0, "move").hint_in(EDIT, 0, "field").hint_in(COLOUR, 10, "row").hint_in(PAGES, 0, "up").hint_in(CONFLICT, 0, "up")
        .does(|shared| list::move_cursor(shared, -1)),
    Key::in_turn(LONG_LISTS, "first", [c('g'), c('g')], "first").also("top beginning start home").does(|shared| list::move_cursor(shared, isize::MIN)),
    Key::new(LONG_LISTS, "last", &[c('G'), key(End)], "last").also("end bottom").does(|shared| list::move_cursor(shared, isize::MAX)),
    Key::new(LONG_LISTS, "first", &[key(Home)], "first").also("top beginning start home").does(|shared| list::move_cursor(shared, isize::MIN)),
    Key::new(LONG_LISTS, "page-down", &[key(PageDown)], "page down").also("scroll").does(|shared| list::turn_page(shared, 1)),
    Key::new(LONG_LISTS, "page-up", &[key(PageUp)], "page up").also("scroll").does(|shared| list::turn_page(shared, -1)),
];

/// The keys that repeat a change on what the cursor of the list or of the fields is on. In EDIT, a point
/// begins to type a number.
#[rustfmt::skip]
pub(crate) const REPEAT: &[Row] = &[
    Key::new(These(&[In(Mode::Select)]), "repeat", &[c('.')], "repeat the last change here").also("again").does(edit::repeat),
    Key::new(These(EDIT), "repeat", &[alt(Char('.'))], "repeat the last change here").also("again").does(edit::repeat),
];

/// The keys of the list of errors.
#[rustfmt::skip]
pub(crate) const ERRORS: &[Row] = &[
    Key::new(These(&[Context::Errors]), "accept", &[key(Enter)], "go to the item").hint(10, "go there").does(list::go_to_error),
];
