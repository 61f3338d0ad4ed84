//! The sheet of a track: its rows with a mark at each key, and the frame that is shown.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::{self, Focus, Row};
use crate::app::{App, DopeSheet, OpenTrack};
use crate::theme;

/// Draws the sheet of the open track.
pub(crate) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let Some(open) = &app.sequence.open else {
        return;
    };
    let seconds = f64::from(open.frame) / f64::from(open.rate());
    let right = format!("{seconds:.2} s, {} fps", open.rate());
    row::title(&open.name(), &right, Focus::Here, area, buffer);
    let sheet = DopeSheet::new(area, open.last());
    let rows: Vec<_> = open.track.rows().collect();
    let lines = usize::from(sheet.names.height);
    let shown = if lines < rows.len() {
        lines.saturating_sub(1)
    } else {
        rows.len()
    };
    for (line, (name, frames)) in (0..).zip(rows.iter().take(shown)) {
        let mut row = Row::new(buffer, sheet.names, line);
        row.skip(1);
        let room = row.room().saturating_sub(1);
        row.put_in(name, room, Style::new());
        keys(&sheet, frames, line, buffer);
    }
    if shown < rows.len() {
        let more = format!("{} more", rows.len() - shown);
        let mut row = Row::new(buffer, sheet.names, shown as u16);
        row.skip(1).put(&more, theme::DIM);
    }
    cursor(&sheet, open, shown as u16, buffer);
}

/// Draws the keys of a row, and the line between them.
fn keys(sheet: &DopeSheet, frames: &[u32], line: u16, buffer: &mut Buffer) {
    let columns: Vec<u16> = frames.iter().map(|&frame| sheet.column(frame)).collect();
    if let [first, .., last] = columns[..] {
        let mut row = Row::new(buffer, sheet.frames, line);
        row.skip(first);
        row.put(&"─".repeat(usize::from(last - first)), theme::DIM);
    }
    for column in columns {
        let mut row = Row::new(buffer, sheet.frames, line);
        row.skip(column).put("◆", theme::ACCENT);
    }
}

/// Marks the column of the frame that is shown, down to the line below the rows.
fn cursor(sheet: &DopeSheet, open: &OpenTrack, lines: u16, buffer: &mut Buffer) {
    let column = sheet.frames.x + sheet.column(open.frame);
    for y in sheet.frames.y..sheet.frames.bottom().min(sheet.frames.y + lines.max(1)) {
        if let Some(cell) = buffer.cell_mut((column, y)) {
            if cell.symbol() != "◆" {
                cell.set_symbol("│");
            }
            cell.set_style(theme::CURSOR);
        }
    }
}
