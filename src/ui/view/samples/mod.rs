//! The sample scenes as a page: a small picture and a line of each, and a large picture of the selected one.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::history::show;
use super::inks::Inks;
use super::page;
use super::row::Row;
use crate::app::{App, Page, Rank, history, samples};
use crate::text_width::wrap;
use crate::theme;
use assets::SAMPLES;

/// Draws the page.
pub(super) fn render(app: &App, page: &Page, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    let shared = &app.shared;
    let area = area.intersection(buffer.area);
    // They need the files that they name beside them.
    let others = SAMPLES.len() - samples::shown_samples().count();
    let others = format!(" {others} more with pictures and meshes: halflight samples DIR ");
    page::frame(page.title, &others, area, buffer);
    let strip = history::history_layout(shared, area);
    let pictures = &app.gallery.pictures;
    let rows = page.shown();
    for (row, place) in strip.rows(page.filter.at, rows.len()) {
        let Some((index, _)) = rows.get(row) else {
            continue;
        };
        let Some(sample) = samples::shown_samples().nth(*index) else {
            continue;
        };
        let is_here = row == page.filter.at;
        let style = if is_here { theme::BOLD } else { Style::new() };
        let mark = if is_here { "▸ " } else { "  " };
        let mut line = Row::new(buffer, place, 0);
        line.put(mark, style);
        let Some((width, height)) = strip.thumbnail else {
            line.put(sample.name, style)
                .skip(2)
                .put(sample.words, theme::DIM);
            continue;
        };
        let thumbnail = Rect {
            x: place.x + 2,
            width: width.min(place.width.saturating_sub(2)),
            height,
            ..place
        };
        let known = pictures.get(*index, Rank::Row);
        show(shared, known, thumbnail, inks, buffer);
        let indent = thumbnail.right() + 1 - place.x;
        Row::new(buffer, place, 0)
            .skip(indent)
            .put(sample.name, style);
        let width = usize::from(place.width.saturating_sub(indent));
        let lines = wrap(sample.words, width);
        for (at, words) in (1..place.height - 1).zip(&lines) {
            Row::new(buffer, place, at)
                .skip(indent)
                .put(words, theme::DIM);
        }
    }
    if let (Some(large), Some((index, _))) = (strip.large, rows.get(page.filter.at)) {
        let known = pictures.get(*index, Rank::Large);
        show(shared, known, large, inks, buffer);
    }
    page::foot(app, page, rows.len(), strip.foot, buffer);
}
