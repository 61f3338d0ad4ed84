//! Cells that are left to a picture in real pixels, which the terminal puts there.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::ui::app::App;
use crate::ui::terminal::Pixmap;
use crate::ui::theme;

/// The symbol of cells that are left to the terminal's own picture, a private character.
const LEFT: &str = "\u{f8ff}";

/// The number of cells that are left to the terminal's own picture.
pub(super) fn left_in(cells: Rect, buffer: &Buffer) -> usize {
    let cells = cells.intersection(buffer.area).positions();
    cells.filter(|&at| buffer[at].symbol() == LEFT).count()
}

/// Blanks the cells that are left to the terminal's own picture.
pub(super) fn blank(cells: Rect, buffer: &mut Buffer) {
    for at in cells.intersection(buffer.area).positions() {
        if buffer[at].symbol() == LEFT {
            buffer[at].set_symbol(" ");
        }
    }
}

/// The current picture with its outline, for a terminal that shows pictures.
pub fn pixmap(app: &App) -> Pixmap {
    let shown = &app.picture().shown;
    let pixels = shown.pixels.iter().enumerate().map(|(at, &pixel)| {
        if shown.is_outlined(at) {
            theme::OUTLINE
        } else {
            pixel
        }
    });
    Pixmap {
        size: shown.size,
        pixels: pixels.collect(),
    }
}

/// Leaves cells to the terminal's own picture.
pub(super) fn leave(cells: Rect, buffer: &mut Buffer) {
    for at in cells.intersection(buffer.area).positions() {
        buffer[at].reset();
        buffer[at].set_symbol(LEFT);
    }
}
