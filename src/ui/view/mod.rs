//! Drawing: one file per panel, composed here.
//!
//! Views read the app and write cells. They use no threads, channels or locks, never change the app
//! and never panic, regardless of the size of the screen. Text from files reaches the screen
//! through [`row`], which shows control characters instead of sending them.

mod comparison;
mod completions;
mod current;
mod dialog;
mod errors;
mod few_colours;
mod fields;
mod graphics_gap;
mod help;
mod histogram;
mod history;
mod inks;
mod labelled;
mod list;
mod menu;
mod message;
mod mosaic;
mod oklab;
mod page;
mod past_messages;
mod picker;
mod picture;
mod pixel;
mod rays;
mod row;
mod samples;
mod sequence;
mod sketch;
mod status;
mod symbols;
mod tiles;
mod tutor;
mod values;
mod whereabouts;
mod wireframe;

#[cfg(test)]
mod tests;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::terminal::Frame;

use super::app::{App, Page};
use super::arrange::MIN_SIZE;
use super::keymap::{Context, Mode};
use super::{layout, theme};
pub use graphics_gap::pixmap;
pub use inks::{Drawing, Inks};
pub use mosaic::Mosaic;
pub use sketch::SKETCH;

/// Draws the whole screen. Returns the cells that are left to the terminal's own picture: none if
/// anything but marks and words of the picture is over it, which is then drawn in half blocks.
pub fn draw(app: &App, inks: &mut Inks, frame: &mut Frame) -> Option<Rect> {
    let area = frame.area();
    let buffer = frame.buffer_mut();
    let mut left = render(app, inks, area, buffer);
    if left.is_none() && inks.drawing == Drawing::Picture {
        buffer.reset();
        inks.drawing = Drawing::HalfBlocks;
        render(app, inks, area, buffer);
        inks.drawing = Drawing::Picture;
    }
    if let Some(cells) = left {
        left = Some(cells.intersection(buffer.area));
        graphics_gap::blank(cells, buffer);
    }
    inks.theme(app.shared.theme).apply(buffer);
    left
}

/// Draws the whole screen; returns the cells that are left to a picture if nothing is over it.
fn render(app: &App, inks: &mut Inks, area: Rect, buffer: &mut Buffer) -> Option<Rect> {
    let area = area.intersection(buffer.area);
    let areas = app.shared.areas_in(area, app.shared.zoom_now());
    if areas.status.is_empty() {
        too_small(area, buffer);
        return None;
    }
    let left = picture::render(app, inks, areas.picture, buffer);
    let left = left.map(|cells| (cells, graphics_gap::left_in(cells, buffer)));
    rule(areas.rule, buffer);
    tutor::render(app, areas.lesson, buffer);
    if app.shared.context() == Context::Rays {
        rays::render(&app.shared, buffer);
    } else if !areas.list.is_empty() && app.shared.mode == Mode::Compare {
        comparison::render(app, inks, areas.list.union(areas.fields), buffer);
    } else if !areas.list.is_empty() && !app.shared.disk.is_opening() {
        list::render(&app.shared, areas.list, buffer);
        match app.shared.mode {
            Mode::Inspect => pixel::render(&app.shared, areas.fields, buffer),
            Mode::Sequence => sequence::render(app, areas.fields, buffer),
            _ => fields::render(&app.shared, areas.fields, buffer),
        }
    } else if app.shared.mode == Mode::Inspect {
        pixel::render_over(&app.shared, areas.picture, buffer);
    }
    whereabouts::render(app, [areas.list, areas.fields, areas.picture], buffer);
    histogram::render(&app.shared, areas.picture, buffer);
    errors::render(&app.shared, areas.errors, buffer);
    let status = current::render(&app.shared, &areas, buffer);
    status::render(app, inks.depth, status, buffer);
    match &app.shared.overlays.prompt {
        Some(prompt) if areas.hint.is_empty() => {
            status::render_prompt(prompt, areas.status, buffer);
        }
        _ => status::render_hint(app, areas.hint, buffer),
    }
    let bars = areas.hint.height + areas.status.height;
    let (body, _) = layout::split_bottom(area, bars);
    if let Some(page) = &app.shared.overlays.page {
        render_page(app, page, inks, body, buffer);
    }
    if let Some(refused) = current::refusal(&app.shared, &areas) {
        message::render(&refused, body, buffer);
    } else if let Some(message) = status::long_message(app, inks.depth, status.width) {
        message::render(message, body, buffer);
    }
    menu::render(&app.shared, areas.list, body, buffer);
    picker::render(&app.shared, inks, areas.list, body, buffer);
    completions::render(&app.shared, body, buffer);
    dialog::render(app, areas.picture, body, buffer);
    let (cells, count) = left?;
    (graphics_gap::left_in(cells, buffer) == count).then_some(cells)
}

fn render_page(app: &App, page: &Page, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    match page.context {
        Context::Help => help::render(&app.shared, page, area, buffer),
        Context::Messages => past_messages::render(&app.shared, page, area, buffer),
        Context::History => history::render(app, page, inks, area, buffer),
        Context::Samples => samples::render(app, page, inks, area, buffer),
        _ => page::render(app, page, area, buffer),
    }
}

/// Draws the line between columns.
fn rule(area: Rect, buffer: &mut Buffer) {
    for position in area.positions() {
        row::put_at(position, "│", theme::DIM, buffer);
    }
}

/// Draws the notice that the screen is too small, as far as it fits.
fn too_small(area: Rect, buffer: &mut Buffer) {
    let (width, height) = MIN_SIZE;
    let text = format!("needs {width}×{height}");
    let line = Rect::new(0, 0, text.chars().count() as u16, 1);
    row::Row::new(buffer, layout::centred(area, line), 0).put(&text, Style::new());
}
