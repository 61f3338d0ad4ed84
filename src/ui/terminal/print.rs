//! A screen as text with escape codes, one line for each row, to print in a terminal.

use ratatui::buffer::Buffer;
use unicode_width::UnicodeWidthStr;

use super::colour::ColourDepth;
use super::pen::{Pen, Style};

/// Encodes a screen in the colours that its cells have.
pub(crate) fn printed(cells: &Buffer) -> Vec<u8> {
    let mut out = Vec::new();
    for y in 0..cells.area.height {
        let mut pen = Pen::UNKNOWN;
        let mut x = 0;
        while x < cells.area.width {
            let cell = &cells[(x, y)];
            let [fg, bg] = [cell.fg, cell.bg].map(|colour| ColourDepth::TrueColour.ink(colour));
            pen.apply(&Style::exactly(fg, bg, cell.modifier), &mut out);
            out.extend_from_slice(cell.symbol().as_bytes());
            // The cells below the rest of a wide character are not shown.
            x += (cell.symbol().width() as u16).max(1);
        }
        pen.reset(&mut out);
        out.push(b'\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;
    use ratatui::style::Color;

    #[test]
    fn each_row_is_a_line_that_ends_in_the_default_style() {
        let mut cells = Buffer::empty(Rect::new(0, 0, 2, 2));
        cells.set_string(0, 0, "ab", Color::Red);
        cells.set_string(0, 1, "界", Color::Rgb(1, 2, 3));
        let text = String::from_utf8(printed(&cells)).expect("text");
        let rows = ["\x1b[31mab", "\x1b[38;2;1;2;3m界"];
        assert_eq!(
            text,
            rows.map(|row| format!("\x1b[m{row}\x1b[m\n")).concat()
        );
    }
}
