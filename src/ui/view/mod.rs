//! Drawing: one panel a file, composed here.
//!
//! Views read the app and write cells. They know no threads, channels or locks, never change the
//! app and never panic, whatever the size of the screen. Text from files reaches the screen
//! through [`row`], which shows control characters instead of sending them.

mod dialog;
mod dither;
pub(crate) mod errors;
mod fields;
mod help;
pub mod layout;
mod list;
mod picture;
mod row;
mod status;
mod theme;

#[cfg(test)]
mod tests;

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::ui::app::App;
use crate::ui::terminal::ColourDepth;
use layout::LEAST;

/// What pixels are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Glyphs {
    /// Two pixels a cell in their own colours.
    HalfBlocks,
    /// Two pixels a cell, in a pattern of the 256 colours.
    HalfBlocksOf256,
    /// Two pixels a cell, in a pattern of the sixteen colours.
    HalfBlocksOf16,
    /// One of a few characters a cell, by brightness: for terminals without colours.
    Characters,
}

impl Glyphs {
    /// What suits a terminal of so many colours.
    pub fn for_depth(depth: ColourDepth) -> Self {
        match depth {
            ColourDepth::Mono => Self::Characters,
            ColourDepth::Palette16 => Self::HalfBlocksOf16,
            ColourDepth::Palette256 => Self::HalfBlocksOf256,
            ColourDepth::TrueColour => Self::HalfBlocks,
        }
    }
}

/// Draws the whole screen.
pub fn draw(app: &App, glyphs: Glyphs, frame: &mut Frame) {
    let area = frame.area();
    render(app, glyphs, area, frame.buffer_mut());
}

fn render(app: &App, glyphs: Glyphs, area: Rect, buffer: &mut Buffer) {
    let area = area.intersection(buffer.area);
    let areas = app.areas_in(area, app.zoom_now());
    if areas.status.is_empty() {
        too_small(area, buffer);
        return;
    }
    picture::render(app, glyphs, areas.picture, buffer);
    rule(app, areas.rule, buffer);
    if !areas.list.is_empty() {
        list::render(app, areas.list, buffer);
        fields::render(app, areas.fields, buffer);
    }
    errors::render(app, areas.errors, buffer);
    status::render(app, glyphs, areas.status, buffer);
    match &app.prompt {
        Some(prompt) if areas.hint.is_empty() => {
            status::render_prompt(prompt, areas.status, buffer);
        }
        _ => status::render_hint(app, areas.hint, buffer),
    }
    let bars = areas.hint.height + areas.status.height;
    let (body, _) = layout::split_bottom(area, bars);
    help::render(app, body, buffer);
    dialog::render(app, body, buffer);
}

/// Draws the line between the picture and the panels, which tells a stale picture from afar.
fn rule(app: &App, area: Rect, buffer: &mut Buffer) {
    let style = if 0 < app.error_count() {
        theme::WARNING
    } else {
        theme::DIM
    };
    let symbol = if area.width < area.height {
        "│"
    } else {
        "─"
    };
    for position in area.positions() {
        if let Some(cell) = buffer.cell_mut(position) {
            cell.set_symbol(symbol).set_style(style);
        }
    }
}

/// Says that there is no room, in what room there is.
fn too_small(area: Rect, buffer: &mut Buffer) {
    let (width, height) = LEAST;
    let text = format!("needs {width}×{height}");
    let line = Rect::new(0, 0, text.chars().count() as u16, 1);
    row::Row::new(buffer, layout::centred(area, line), 0).put(&text, Style::new());
}
