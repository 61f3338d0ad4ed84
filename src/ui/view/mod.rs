//! Drawing: one panel a file, composed here.
//!
//! Views read the app and write cells. They know no threads, channels or locks, never change the
//! app and never panic, whatever the size of the screen. Text from files reaches the screen
//! through [`row`], which shows control characters instead of sending them.

mod characters;
mod dialog;
mod dither;
pub(crate) mod errors;
mod fields;
mod help;
pub mod layout;
mod list;
mod message;
mod oklab;
mod palette;
mod picture;
mod row;
mod status;
mod theme;

#[cfg(test)]
mod tests;

use ratatui::Frame;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::app::App;
use super::terminal::ColourDepth;
use layout::LEAST;
use palette::Palette;

/// What pixels are made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Glyphs {
    /// Two pixels a cell in their own colours.
    HalfBlocks,
    /// Two pixels a cell, in a pattern of the 256 colours.
    HalfBlocksOf256,
    /// Two pixels a cell, in a pattern of the sixteen colours.
    HalfBlocksOf16,
    /// A character a cell, by brightness: for terminals without colours.
    Characters,
}

impl Glyphs {
    /// What colours the picture is made of.
    fn name(self) -> &'static str {
        let depth = match self {
            Self::HalfBlocks => ColourDepth::TrueColour,
            Self::HalfBlocksOf256 => ColourDepth::Palette256,
            Self::HalfBlocksOf16 => ColourDepth::Palette16,
            Self::Characters => ColourDepth::Mono,
        };
        depth.name()
    }

    fn for_depth(depth: ColourDepth) -> Self {
        match depth {
            ColourDepth::Mono => Self::Characters,
            ColourDepth::Palette16 => Self::HalfBlocksOf16,
            ColourDepth::Palette256 => Self::HalfBlocksOf256,
            ColourDepth::TrueColour => Self::HalfBlocks,
        }
    }
}

/// What pictures are drawn with: the glyphs, and what was worked out about the colours they have.
#[derive(Debug)]
pub struct Inks {
    glyphs: Glyphs,
    palette: Option<Palette>,
}

impl Inks {
    /// What suits a terminal of so many colours.
    pub fn for_depth(depth: ColourDepth) -> Self {
        Self::new(Glyphs::for_depth(depth))
    }

    fn new(glyphs: Glyphs) -> Self {
        let palette = match glyphs {
            Glyphs::HalfBlocksOf256 => Some(Palette::of_256()),
            Glyphs::HalfBlocksOf16 => Some(Palette::of_16()),
            Glyphs::HalfBlocks | Glyphs::Characters => None,
        };
        Self { glyphs, palette }
    }

    /// The colour of a pixel at a place.
    fn colour(&mut self, colour: [u8; 3], x: u32, y: u32) -> Color {
        match &mut self.palette {
            Some(palette) => Color::Indexed(palette.at(colour, x, y)),
            None => Color::Rgb(colour[0], colour[1], colour[2]),
        }
    }
}

/// Draws the whole screen.
pub fn draw(app: &App, inks: &mut Inks, frame: &mut Frame) {
    let area = frame.area();
    render(app, inks, area, frame.buffer_mut());
}

fn render(app: &App, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    let area = area.intersection(buffer.area);
    let areas = app.areas_in(area, app.zoom_now());
    if areas.status.is_empty() {
        too_small(area, buffer);
        return;
    }
    picture::render(app, inks, areas.picture, buffer);
    rule(app, areas.rule, buffer);
    if !areas.list.is_empty() && !app.is_opening() {
        list::render(app, areas.list, buffer);
        fields::render(app, areas.fields, buffer);
    }
    errors::render(app, areas.errors, buffer);
    status::render(app, inks.glyphs, areas.status, buffer);
    match &app.prompt {
        Some(prompt) if areas.hint.is_empty() => {
            status::render_prompt(prompt, areas.status, buffer);
        }
        _ => status::render_hint(app, areas.hint, buffer),
    }
    let bars = areas.hint.height + areas.status.height;
    let (body, _) = layout::split_bottom(area, bars);
    help::render(app, body, buffer);
    if let Some(message) = status::long_message(app, inks.glyphs, areas.status.width) {
        message::render(message, body, buffer);
    }
    dialog::render(app, body, buffer);
}

/// Draws the line between the picture and the panels, which shows from afar that a picture is stale.
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

/// Shows that the screen is too small, in what room there is.
fn too_small(area: Rect, buffer: &mut Buffer) {
    let (width, height) = LEAST;
    let text = format!("needs {width}×{height}");
    let line = Rect::new(0, 0, text.chars().count() as u16, 1);
    row::Row::new(buffer, layout::centred(area, line), 0).put(&text, Style::new());
}
