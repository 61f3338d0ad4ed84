//! The values of pixels, written into them where they are large enough.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::row::Row;
use crate::render::Frame;
use crate::ui::app::{Sight, Window};

/// The smallest pixel, in cells, into which its 8-bit colour is written.
const SMALLEST: (u16, u16) = (12, 3);

/// The height in cells from which its linear values are written too.
const ROOMY: u16 = 5;

/// Writes the values of a frame's pixels into them, if their cells have room.
pub(super) fn render(frame: &Frame, sight: &Sight, cells: Rect, buffer: &mut Buffer) {
    let Some(Window { whole, part, fills }) = sight.window else {
        return;
    };
    let width = (fills.width / part.width) as u16 / sight.grid.across;
    let height = (fills.height / part.height) as u16 / sight.grid.down;
    if width < SMALLEST.0 || height < SMALLEST.1 || frame.whole() != whole {
        return;
    }
    for (row, y) in (part.y..part.y + part.height).enumerate() {
        for (column, x) in (part.x..part.x + part.width).enumerate() {
            let pixel = Rect {
                x: cells.x + column as u16 * width,
                y: cells.y + row as u16 * height,
                width,
                height,
            };
            // A pixel that is cut off is too small to be read.
            let Some(at) = frame.index_of([x, y]) else {
                continue;
            };
            if cells.intersection(pixel) == pixel
                && let Some(colour) = frame.pixels.get(at)
            {
                write(lines(frame, at, height), *colour, pixel, buffer);
            }
        }
    }
}

/// The 8-bit colour of a pixel, and its linear values if there is room.
fn lines(frame: &Frame, at: usize, height: u16) -> Vec<String> {
    let [red, green, blue] = frame.pixels[at];
    let mut lines = vec![format!("{red} {green} {blue}")];
    if let Some(values) = frame.values.get(at)
        && ROOMY <= height
    {
        lines.extend(values.map(|value| format!("{value:.3}")));
    }
    lines
}

/// Writes lines into the middle of a pixel, in black or white.
fn write(lines: Vec<String>, colour: [u8; 3], pixel: Rect, buffer: &mut Buffer) {
    let [red, green, blue] = colour.map(u32::from);
    let is_bright = 255 * 1000 < 2 * (299 * red + 587 * green + 114 * blue);
    let ink = if is_bright {
        Color::Black
    } else {
        Color::White
    };
    let style = Style::reset().fg(ink);
    let top = (pixel.height - lines.len() as u16) / 2;
    for (line, text) in (top..).zip(lines) {
        let ground = Color::Rgb(colour[0], colour[1], colour[2]);
        let left = pixel.width.saturating_sub(text.len() as u16) / 2;
        Row::new(buffer, pixel, line)
            .skip(left)
            .put(&text, style.bg(ground));
    }
}
