//! Labelled values, a line each.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::Row;
use crate::theme;

/// Columns of labels with the gaps around them.
const LABEL: u16 = 10;

/// A value and what it is.
pub(super) struct Value {
    label: &'static str,
    text: String,
    /// The colour that the text describes.
    colour: Option<[u8; 3]>,
}

impl Value {
    pub(super) fn new(label: &'static str, text: impl Into<String>) -> Self {
        Self {
            label,
            text: text.into(),
            colour: None,
        }
    }

    /// A colour as exported.
    pub(super) fn of_colour(label: &'static str, colour: [u8; 3]) -> Self {
        let [red, green, blue] = colour;
        Self {
            label,
            text: format!("{red} {green} {blue} #{red:02x}{green:02x}{blue:02x}"),
            colour: Some(colour),
        }
    }
}

/// Draws as many values as there are lines.
pub(super) fn render(values: &[Value], area: Rect, buffer: &mut Buffer) {
    for (index, value) in (0..area.height).zip(values) {
        let mut row = Row::new(buffer, area, index);
        row.skip(1).put(value.label, theme::DIM);
        row.skip_to(area.x.saturating_add(LABEL));
        if let Some(colour) = value.colour {
            row.put("██", Style::new().fg(colour.into())).skip(1);
        }
        row.put(&value.text, Style::new());
    }
}
