//! The full text of a message that does not fit in the status line, shown above the keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::row::{Focus, Row, title};
use crate::app::Message;
use crate::framing::clear;
use crate::text_width::{visible, wrap};
use crate::{layout, theme};

/// Draws as much of a message as fits at the bottom of `area`.
pub(crate) fn render(message: &Message, area: Rect, buffer: &mut Buffer) {
    let text = visible(&message.text);
    let lines = wrap(&text, usize::from(area.width.saturating_sub(2)));
    let height = u16::try_from(lines.len() + 1).unwrap_or(u16::MAX);
    let (_, panel) = layout::split_bottom(area, height.min(area.height));
    clear(panel, buffer);
    title("", "", Focus::Elsewhere, panel, buffer);
    let style = theme::severity(message.severity);
    for (index, line) in (1..panel.height).zip(&lines) {
        Row::new(buffer, panel, index).skip(1).put(line, style);
    }
}
