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
const SELECT: &[Context] = &[In(Mode::Select)];
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
    Key::new(Everywhere, "back", &[key(Esc)], "back").also("leave close cancel return escape").hint_in(LEAVABLE, 80, "back").hint_in(ERRORS, 80, "close").does(back::go_back),
    Key::new(Sceneless, "help", &[c('?')], "help").also("manual documentation shortcuts keys keybindings cheatsheet tutorial guide instructions howto hotkeys lost stuck bindings controls keyboard").lasting("help").does(|shared| shared.overlays.open_page(Page::reading(Context::Help))),
    Key::new(Sceneless, "command", &[c(':')], "command").also("palette menu actions").lasting("command").does(|shared| shared.open_palette_with("")),
    Key::new(Everywhere, "save", &[c('w')], "save the scene").also("write store keep backup").hint(100, "save").stays().requests(files::save_key).when(|shared| !shared.is_saved()),
    Key::new(Everywhere, "export", &[c('b')], "export what is shown").also("screenshot image picture png jpg save render").hint_in(SELECT, 120, "export").stays().hint(120, "export").requests(exports::export_default),
    Key::new(Everywhere, "trace", &[key(F(5)), c('r')], "trace at full size").also("render final quality high resolution full start raytrace begin draw").hint_in(SELECT, 70, "trace").stays().hint_in(OUTSIDE_TRACE, 130, "trace").requests(trace::start),
];

/// Keys used less often. Those that start a comparison are listed between these and [`KEYS`].
#[rustfmt::skip]
pub(crate) const OTHERS: &[Row] = &[
    Key::new(Everywhere, "undo", &[c('u')], "undo").also("revert back mistake oops restore wrong").hint(110, "undo").requests(history::undo).when(|shared| shared.document.undoable().is_some()),
    Key::new(Everywhere, "redo", &[ctrl('r')], "redo").also("again repeat forward").requests(history::redo),
    Key::new(Everywhere, "history", &[c('U')], "undo history as pictures").also("undo timeline past steps versions").does(history::list_steps),
    Key::new(Everywhere, "errors", &[c('!')], "errors and warnings").also("problems warnings mistakes bugs issues diagnostics lint broken wrong").hint_in(SELECT, 90, "errors").stays().does(list::toggle_errors).when(|shared| !shared.wrong().findings.is_empty()),
    Key::new(Sceneless, "messages", &[c('M')], "messages so far").also("log notifications output history console").does(|shared| shared.overlays.open_page(Page::reading(Context::Messages))),
    Key::new(Everywhere, "editor", &[c('E')], "open the editor at the selected item").also("vim emacs nano vscode text source code file external open").hint_in(WITH_EDITOR, 30, "editor").requests(files::open_editor),
    Key::new(PANELS, "panels", &[c('z')], "show or hide the panels").also("fullscreen sidebar hide maximize zen distraction big menu").does(panels::toggle_zoom),
    Key::new(Everywhere, "larger-panels", &[c('{')], "larger panels").also("resize sidebar width wider layout").requests(|shared| panels::resize_by_key(shared, Border::Panels, 2)),
    Key::new(Everywhere, "smaller-panels", &[c('}')], "smaller panels").also("resize sidebar width narrower layout").requests(|shared| panels::resize_by_key(shared, Border::Panels, -2)),
    Key::new(Everywhere, "smaller-list", &[alt(Char('{'))], "smaller list, larger fields").requests(|shared| panels::resize_by_key(shared, Border::List, -1)),
    Key::new(Everywhere, "larger-list", &[alt(Char('}'))], "larger list, smaller fields").requests(|shared| panels::resize_by_key(shared, Border::List, 1)),
    Key::new(Everywhere, "darker", &[c('<')], "darker display, by half a stop").also("brightness exposure dim dark light").does(|shared| display::expose(shared, -1)),
    Key::new(Everywhere, "brighter", &[c('>')], "brighter display").also("brightness exposure bright lighten light gloomy underexposed").does(|shared| display::expose(shared, 1)),
    Key::new(Everywhere, "denoise", &[c('~')], "reduce noise on screen, or no longer").also("noise grain smooth clean noisy filter speckles fireflies").requests(display::toggle_denoising),
    Key::new(Everywhere, "integrator", &[c('P')], "next integrator: Whitted, paths, photons").also("path tracing pathtracer global illumination algorithm renderer bounce caustics gi bounces realistic reflections").hint_in(TRACE, 90, "integrator").does(text::next_integrator),
    Key::new(Everywhere, "cure", &[c('C')], "apply the suggested render setting").also("fix repair suggestion improve black noisy dark").does(suggesting::cure),
    Key::new(Always, "redraw", &[ctrl('l')], "redraw the screen").also("refresh repaint garbled glitch clear").requests(|_| vec![Effect::Repaint]),
    Key::new(Always, "suspend", &[ctrl('z')], "suspend").also("background pause shell stop terminal").requests(|_| vec![Effect::Suspend]),
    Key::new(Sceneless, "quit", &[c('q')], "quit").also("exit close leave end shutdown terminate").lasting("quit").requests(files::quit_key),
    Key::new(Always, "interrupt", &[ctrl('c')], "quit; press twice to quit at once").also("exit abort kill force close").requests(files::interrupt),
];
