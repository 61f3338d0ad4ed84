//! The undo history as a page: its steps in order, each with a small picture of the text after it,
//! and a large one of the selected text.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use unicode_width::UnicodeWidthStr;

use super::inks::Inks;
use super::row::Row;
use super::{page, picture};
use crate::app::{App, Page, Rank, Shared, Thumbnail, history};
use crate::history_scene::NoPicture;
use crate::layout::{centred, raster};
use crate::text_width::{visible, wrap};
use crate::theme;
use document::Document;

/// Draws the page.
pub(super) fn render(app: &App, page: &Page, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    let shared = &app.shared;
    let area = area.intersection(buffer.area);
    let states: Vec<_> = shared.document.states().map(|state| state.id).collect();
    let present = format!(" {} of {} ", shared.document.present(), states.len() - 1);
    let title = if shared.pictures.view.is_some() {
        "Undo history, from the moved view"
    } else {
        page.title
    };
    page::frame(title, &present, area, buffer);
    let strip = history::history_layout(shared, area);
    let rows = page.shown();
    for (row, place) in strip.rows(page.filter.at, rows.len()) {
        let Some((index, name)) = rows.get(row) else {
            continue;
        };
        let entry = Entry {
            name,
            at: *index,
            is_here: row == page.filter.at,
        };
        let id = states.get(*index);
        let known = id.and_then(|id| app.thumbnails.get(*id, Rank::Row));
        let thumbnail = strip.thumbnail.map(|(width, height)| Rect {
            x: place.x + 2,
            width: width.min(place.width.saturating_sub(2)),
            height,
            ..place
        });
        if let Some(thumbnail) = thumbnail {
            show(shared, known, thumbnail, inks, buffer);
        }
        let indent = thumbnail.map_or(2, |thumbnail| thumbnail.right() + 1 - place.x);
        entry.render(&shared.document, indent, place, buffer);
    }
    let chosen = rows.get(page.filter.at).map(|(index, _)| *index);
    let chosen = chosen.and_then(|index| states.get(index));
    if let (Some(large), Some(id)) = (strip.large, chosen) {
        show(
            shared,
            app.thumbnails.get(*id, Rank::Large),
            large,
            inks,
            buffer,
        );
    }
    page::foot(app, page, rows.len(), strip.foot, buffer);
}

/// A step in the list.
struct Entry<'a> {
    name: &'a str,
    at: usize,
    is_here: bool,
}

impl Entry<'_> {
    /// Draws the name, behind the picture.
    fn render(&self, document: &Document, indent: u16, place: Rect, buffer: &mut Buffer) {
        let style = match self.at {
            _ if self.is_here => theme::BOLD,
            at if document.present() < at => theme::DIM,
            _ => Style::new(),
        };
        let when = history::when(document, self.at);
        let when_style = if self.at == document.present() {
            theme::ACCENT
        } else {
            theme::DIM
        };
        let mark = if self.is_here { "▸ " } else { "  " };
        let mut row = Row::new(buffer, place, 0);
        row.put(mark, style);
        if place.height == 1 {
            row.put_in(
                self.name,
                row.room().saturating_sub(when.width() + 2),
                style,
            );
            let right = place.right().saturating_sub(when.width() as u16);
            row.skip_to(right).put(&when, when_style);
            return;
        }
        let width = usize::from(place.width.saturating_sub(indent));
        let lines = wrap(&visible(self.name), width);
        let count = usize::from(place.height - 1);
        for (line, words) in (0..).zip(lines.iter().take(count)) {
            Row::new(buffer, place, line).skip(indent).put(words, style);
        }
        let line = lines.len().min(count) as u16;
        Row::new(buffer, place, line)
            .skip(indent)
            .put(&when, when_style);
    }
}

/// Draws a picture, or why there is none.
pub(super) fn show(
    shared: &Shared,
    known: Option<&Thumbnail>,
    place: Rect,
    inks: &mut Inks,
    buffer: &mut Buffer,
) {
    let words = match known {
        Some(Ok(shown)) => {
            if let Some((cells, size)) = raster(place, shown.size) {
                picture::paint(&shown.resampled(size), inks, cells, buffer);
            }
            return;
        }
        Some(Err(NoPicture::Errors)) => "errors",
        Some(Err(NoPicture::Failed(reason))) => reason,
        None if shared.is_large() => "",
        None => "…",
    };
    let width = words.width().min(usize::from(place.width)) as u16;
    let line = centred(place, Rect::new(0, 0, width, 1));
    let style = match known {
        Some(Err(_)) => theme::WARNING,
        _ => theme::DIM,
    };
    Row::new(buffer, line, 0).put(words, style);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::Context;
    use crate::view::tests::{app, drawn, inked, press};

    /// The page after a duplication, which was undone, and a nudge that is then undone as well.
    fn lines(has_colours: bool, width: u16, height: u16) -> Vec<String> {
        let mut app = app();
        app.shared.has_colours = has_colours;
        press(&mut app, "jjjDelluU");
        let panel = |app: &App, inks: &mut Inks, area: Rect, buffer: &mut Buffer| {
            let page = app.shared.overlays.page(Context::History);
            render(app, page.expect("it is open"), inks, area, buffer);
        };
        drawn(&app, inked(panel), width, height)
    }

    #[test]
    fn without_colours_or_room_there_are_only_names() {
        for (has_colours, width, height) in [(false, 70, 12), (true, 70, 10), (false, 100, 40)] {
            let lines = lines(has_colours, width, height);
            for (at, begin, end) in [
                (1, "as opened", "1 step back"),
                (2, "▸ duplicated object 1 (sphere)", "now"),
                (3, "", "1 step ahead"),
            ] {
                let row = lines[at].trim_matches(['│', ' ']);
                assert!(row.starts_with(begin) && row.ends_with(end), "{lines:#?}");
            }
            assert!(lines[3].contains("0.2, 2 nudges "), "{lines:#?}");
        }
    }

    /// Three rows and one at the side.
    #[test]
    fn pictures_are_announced_until_they_are_traced() {
        let text = lines(true, 90, 30).join("\n");
        assert_eq!(text.matches('…').count(), 4, "{text}");
    }
}
