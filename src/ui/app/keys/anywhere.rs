//! Keys that are the same in all modes, or in many.

use crossterm::event::KeyCode;

use crate::app::room::Row;
use crate::app::shared::Border;
use crate::app::{
    Page, back, display, exports, files, history, list, panels, suggesting, text, trace,
};
use crate::keymap::{Context, Key, Mode, Scope, alt, c, ctrl, key};
use crate::msg::Effect;

use Context::In;
use KeyCode::{Char, Esc, F};
use Scope::{Always, Everywhere, Sceneless, These};

/// Where panels are on screen or can be.
const PANELS: Scope = These(&[
    In(Mode::Select),
    In(Mode::Edit),
    In(Mode::View),
    In(Mode::Fly),
    In(Mode::Inspect),
    In(Mode::Compare),
    Context::Errors,
    In(Mode::Sequence),
]);
const TRACE: &[Context] = &[In(Mode::Trace)];
const ERRORS: &[Context] = &[Context::Errors];
/// Where the editor is worth a hint: it opens at what is under the cursor.
const WITH_EDITOR: &[Context] = &[In(Mode::Inspect), Context::Rays, Context::Errors];
/// What Esc leaves.
const LEAVABLE: &[Context] = &[
    In(Mode::Edit),
    In(Mode::View),
    In(Mode::Fly),
    In(Mode::Trace),
    In(Mode::Inspect),
    In(Mode::Compare),
    Context::Rays,
];
/// Where the full-size trace is not on screen.
const OUTSIDE_TRACE: &[Context] = &[
    In(Mode::Select),
    In(Mode::Edit),
    In(Mode::View),
    In(Mode::Fly),
    In(Mode::Inspect),
    In(Mode::Compare),
    Context::Errors,
    Context::Rays,
];

/// The most useful first.
#[rustfmt::skip]
pub(crate) const KEYS: &[Row] = &[
    Key::new(Everywhere, "back", &[key(Esc)], "back").hint_in(LEAVABLE, 80, "back").hint_in(ERRORS, 80, "close").does(back::go_back),
    Key::new(Sceneless, "help", &[c('?')], "help").lasting("help").does(|shared| shared.overlays.open_page(Page::reading(Context::Help))),
    Key::new(Sceneless, "command", &[c(':')], "command").lasting("command").does(|shared| shared.open_palette_with("")),
    Key::new(Everywhere, "save", &[c('w')], "save the scene").hint(100, "save").requests(files::save_key).when(|shared| !shared.is_saved()),
    Key::new(Everywhere, "export", &[c('b')], "export what is shown").hint(120, "export").requests(exports::export_default),
    Key::new(Everywhere, "trace", &[key(F(5)), c('r')], "trace at full size").hint_in(OUTSIDE_TRACE, 130, "trace").requests(trace::start),
];

/// Keys used less often. Those that start a comparison are listed between these and [`KEYS`].
#[rustfmt::skip]
pub(crate) const OTHERS: &[Row] = &[
    Key::new(Everywhere, "undo", &[c('u')], "undo").also("revert").hint(110, "undo").requests(history::undo).when(|shared| shared.document.undoable().is_some()),
    Key::new(Everywhere, "redo", &[ctrl('r')], "redo").requests(history::redo),
    Key::new(Everywhere, "history", &[c('U')], "undo history as pictures").does(history::list_steps),
    Key::new(Everywhere, "errors", &[c('!')], "errors and warnings").does(list::toggle_errors),
    Key::new(Sceneless, "messages", &[c('M')], "messages so far").does(|shared| shared.overlays.open_page(Page::reading(Context::Messages))),
    Key::new(Everywhere, "editor", &[c('E')], "open the editor at the selected item").hint_in(WITH_EDITOR, 30, "editor").requests(files::open_editor),
    Key::new(PANELS, "panels", &[c('z')], "show or hide the panels").does(panels::toggle_zoom),
    Key::new(Everywhere, "larger-panels", &[c('{')], "larger panels").requests(|shared| panels::resize_by_key(shared, Border::Panels, 2)),
    Key::new(Everywhere, "smaller-panels", &[c('}')], "smaller panels").requests(|shared| panels::resize_by_key(shared, Border::Panels, -2)),
    Key::new(Everywhere, "smaller-list", &[alt(Char('{'))], "smaller list, larger fields").requests(|shared| panels::resize_by_key(shared, Border::List, -1)),
    Key::new(Everywhere, "larger-list", &[alt(Char('}'))], "larger list, smaller fields").requests(|shared| panels::resize_by_key(shared, Border::List, 1)),
    Key::new(Everywhere, "darker", &[c('<')], "darker display, by half a stop").also("brightness exposure").does(|shared| display::expose(shared, -1)),
    Key::new(Everywhere, "brighter", &[c('>')], "brighter display").also("brightness exposure").does(|shared| display::expose(shared, 1)),
    Key::new(Everywhere, "denoise", &[c('~')], "reduce noise on screen, or no longer").requests(display::toggle_denoising),
    Key::new(Everywhere, "integrator", &[c('P')], "next integrator: Whitted, paths, photons").hint_in(TRACE, 90, "integrator").does(text::next_integrator),
    Key::new(Everywhere, "cure", &[c('C')], "apply the suggested render setting").does(suggesting::cure),
    Key::new(Always, "redraw", &[ctrl('l')], "redraw the screen").requests(|_| vec![Effect::Repaint]),
    Key::new(Always, "suspend", &[ctrl('z')], "suspend").requests(|_| vec![Effect::Suspend]),
    Key::new(Sceneless, "quit", &[c('q')], "quit").lasting("quit").requests(files::quit_key),
    Key::new(Always, "interrupt", &[ctrl('c')], "quit; press twice to quit at once").requests(files::interrupt),
];
