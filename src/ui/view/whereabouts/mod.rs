//! The panel that tells where the selected thing is, and the arrow towards it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::{Focus, Row, put_at, title};
use crate::app::{App, whereabouts};
use crate::framing::clear;
use crate::layout::{contents, over_picture};
use crate::text_width::wrap;
use crate::theme;

/// Columns of labels with the gaps around them.
const LABEL: u16 = 9;

/// Draws the panel in place of the fields, while those are edited in place of the list, and without
/// panels over the picture.
pub(super) fn render(app: &App, areas: [Rect; 3], buffer: &mut Buffer) {
    let Some(replaces_list) = whereabouts::locates(&app.shared) else {
        return;
    };
    let [list, fields, picture] = areas;
    let area = match (replaces_list, list.is_empty()) {
        (_, true) => over_picture(picture, crate::app::inspect::free_side(&app.shared)).1,
        (true, _) => list,
        _ => fields,
    };
    clear(area, buffer);
    let name = app.shared.source().name(app.shared.cursor.selected());
    title("where is it?", &name, Focus::Elsewhere, area, buffer);
    let room = contents(area);
    let width = usize::from(room.width.saturating_sub(LABEL));
    let mut at = 0;
    for (label, words) in whereabouts::lines(&app.whereabouts, &app.shared) {
        for (index, words) in wrap(&words, width).iter().enumerate() {
            if room.height <= at {
                return;
            }
            let mut row = Row::new(buffer, room, at);
            row.skip(1)
                .put(if index == 0 { label } else { "" }, theme::DIM);
            row.skip_to(room.x + LABEL).put(words, Style::new());
            at += 1;
        }
    }
    if at < room.height {
        let words = format!("{} closes", app.shared.key_for("back"));
        Row::new(buffer, room, room.height - 1)
            .skip(1)
            .put(&words, theme::DIM);
    }
}

/// Draws the arrow at the edge of the picture.
pub(super) fn mark(app: &App, cells: Rect, buffer: &mut Buffer) {
    let Some(whereabouts::Arrow { sign, place }) = whereabouts::arrow(&app.shared) else {
        return;
    };
    let at = |part: f64, cells: u16| (part * f64::from(cells.saturating_sub(1))).round() as u16;
    let place = (
        cells.x + at(place[0], cells.width),
        cells.y + at(place[1], cells.height),
    );
    if cells.contains(place.into()) {
        put_at(place, sign, theme::chip(theme::ACCENT), buffer);
    }
}
