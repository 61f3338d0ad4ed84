//! The page of the messages so far.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::page;
use super::row::Row;
use crate::app::{Message, Page, Shared};
use crate::text_width::{visible, wrap};
use crate::theme;
use text::Severity;

/// Draws the messages so far, the newest first.
pub(super) fn render(shared: &Shared, page: &Page, area: Rect, buffer: &mut Buffer) {
    let past = &shared.overlays.messages;
    let count = past.past().len();
    let top = page.filter.at.min(count.saturating_sub(1));
    let place = format!(" {} of {count} ", (top + 1).min(count));
    let area = area.intersection(buffer.area);
    let inner = page::frame("Messages, newest first", &place, area, buffer);
    let width = usize::from(inner.width).saturating_sub(SIGN + 2);
    let lines = past.past().skip(top).flat_map(|message| {
        let text = visible(&message.text).into_owned();
        let lines = wrap(&text, width).into_iter().enumerate();
        lines.map(move |(index, line)| (message, index, line))
    });
    for (row, (message, index, line)) in (0..inner.height).zip(lines) {
        let style = theme::severity(message.severity);
        let sign = if index == 0 { sign(message) } else { "" };
        let mut row = Row::new(buffer, inner, row);
        row.skip(1).put(&format!("{sign:SIGN$}"), style);
        row.put(&line, style);
    }
}

/// Width of the words for a severity, with a gap.
const SIGN: usize = 9;

fn sign(message: &Message) -> &'static str {
    match message.severity {
        None => "info",
        Some(Severity::Note) => "note",
        Some(Severity::Warning) => "warning",
        Some(Severity::Error) => "error",
    }
}

#[cfg(test)]
mod tests {
    use ratatui::buffer::Buffer;
    use ratatui::layout::Rect;

    use crate::app::{Page, Shared};
    use crate::keymap::Context;
    use crate::msg::Msg;
    use crate::view::tests::{app, drawn};

    #[test]
    fn the_newest_message_comes_first_and_long_ones_are_wrapped() {
        let mut app = app();
        for reason in ["one", "two words"] {
            app.update(Msg::Failed(reason.to_owned()));
            app.shared.overlays.message = None;
        }
        let inside = |line: &String| line.trim_matches('│').trim().to_owned();
        let shown = |at| -> Vec<_> {
            let mut page = Page::reading(Context::Messages);
            page.filter.at = at;
            let draw = |shared: &Shared, area: Rect, buffer: &mut Buffer| {
                super::render(shared, &page, area, buffer);
            };
            let lines = drawn(&app.shared, draw, 18, 6);
            lines.iter().map(inside).collect()
        };
        let newest = ["error    two", "words", "error    one"];
        assert_eq!(shown(0)[1..4], newest);
        assert_eq!(shown(1)[1], "error    one");
    }
}
