//! Labelled values, a line each.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::row::Row;
use crate::text::{concise, rounded};
use crate::ui::theme;

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
        if let Some([red, green, blue]) = value.colour {
            row.put("██", Style::new().fg(Color::Rgb(red, green, blue)));
            row.skip(1);
        }
        row.put(&value.text, Style::new());
    }
}

/// Numbers with at most so many decimals.
pub(super) fn numbers(of: &[f64], decimals: usize) -> String {
    let numbers: Vec<_> = of.iter().map(|&of| number(of, decimals)).collect();
    numbers.join(" ")
}

/// A number with at most so many decimals; in scientific notation if all would be zero.
pub(super) fn number(of: f64, decimals: usize) -> String {
    let rounded = rounded(of, decimals);
    if rounded == 0.0 && of != 0.0 && of.is_finite() {
        format!("{of:.1e}")
    } else {
        concise(rounded)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_rounded_but_never_to_nothing() {
        for (of, decimals, expected) in [
            (0.0, 3, "0"),
            (-0.0, 3, "0"),
            (1.23456, 3, "1.235"),
            (-2.0, 3, "-2"),
            (0.00012, 3, "1.2e-4"),
            (f64::INFINITY, 3, "inf"),
        ] {
            assert_eq!(number(of, decimals), expected);
        }
        assert_eq!(numbers(&[1.0, 0.25], 1), "1 0.2");
    }
}
