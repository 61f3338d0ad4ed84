//! The history of messages, a page over the picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::text::Line;
use ratatui::widgets::{Block, BorderType, Clear, Widget};

use super::row::Row;
use crate::text::Severity;
use crate::ui::app::{Message, Shared};
use crate::ui::text_width::{visible, wrap};
use crate::ui::theme;

/// Draws the messages so far, the newest first, if their page is open.
pub(crate) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let Some(top) = shared.overlays.past else {
        return;
    };
    let past = &shared.overlays.messages;
    let count = past.past().len();
    let top = top.min(count.saturating_sub(1));
    let page = area.intersection(buffer.area);
    Clear.render(page, buffer);
    let place = format!(" {} of {count} ", (top + 1).min(count));
    let block = Block::bordered()
        .border_type(BorderType::Rounded)
        .border_style(theme::DIM)
        .title(" Messages, newest first ")
        .title_top(Line::from(place).right_aligned());
    let inner = block.inner(page);
    block.render(page, buffer);
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
        Some(Severity::Warning) => "warning",
        Some(Severity::Error) => "error",
    }
}

#[cfg(test)]
mod tests {
    use crate::ui::app::App;
    use crate::ui::msg::Msg;
    use crate::ui::view::tests::{app, drawn};

    #[test]
    fn the_newest_message_comes_first_and_long_ones_are_wrapped() {
        let mut app = app();
        for reason in ["one", "two words"] {
            app.update(Msg::Failed(reason.to_owned()));
            app.shared.overlays.message = None;
        }
        let inside = |line: &String| line.trim_matches('│').trim().to_owned();
        let shown = |app: &App| -> Vec<_> {
            let lines = drawn(&app.shared, super::render, 18, 6);
            lines.iter().map(inside).collect()
        };
        app.shared.overlays.past = Some(0);
        let newest = ["error    two", "words", "error    one"];
        assert_eq!(shown(&app)[1..4], newest);
        app.shared.overlays.past = Some(1);
        assert_eq!(shown(&app)[1], "error    one");
    }
}
