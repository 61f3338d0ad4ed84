//! The lesson above the picture: what to do, and a hint after a while.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::{Focus, Row, title};
use crate::app::{App, tutor};
use crate::text_width::wrap;
use crate::theme;

/// Draws the lesson, if there is one and room for it.
pub(super) fn render(app: &App, area: Rect, buffer: &mut Buffer) {
    let shown = tutor::shown(&app.tutor, &app.shared).filter(|_| !area.is_empty());
    let Some(shown) = shown else { return };
    title(
        &shown.title,
        ":tutor skip  :tutor off",
        Focus::Here,
        area,
        buffer,
    );
    let lines = wrap(&shown.words, usize::from(area.width));
    for (at, words) in (1..area.height).zip(&lines) {
        Row::new(buffer, area, at).put(words, Style::new());
    }
    let last = area.height - 1;
    if let Some(hint) = &shown.hint
        && lines.len() < usize::from(last)
    {
        Row::new(buffer, area, last)
            .put("Hint: ", theme::WARNING)
            .put(hint, Style::new());
    }
}
