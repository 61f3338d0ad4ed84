//! The histogram over a corner of the picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::row::{Focus, Row, title};
use crate::app::Shared;
use crate::framing::clear;
use crate::theme;
use render::{HISTOGRAM_STOPS, Histogram};
use text::percentage;

/// Lines of its bars.
const HEIGHT: u16 = 4;

/// Bars in halves of a cell, which every font has.
const BARS: [&str; 3] = [" ", "▄", "█"];

/// Draws the histogram in the lower left corner of the picture, if it is on and fits.
pub(crate) fn render(shared: &Shared, area: Rect, buffer: &mut Buffer) {
    let Some(histogram) = &shared.pictures.histogram else {
        return;
    };
    let shown = histogram.histogram.as_ref();
    let width = shown.map_or(24, |shown| shown.bins.len()) as u16 + 2;
    let height = HEIGHT + 3;
    if area.width < width || area.height < height {
        return;
    }
    let panel = Rect::new(area.x, area.bottom() - height, width, height);
    let panel = panel.intersection(buffer.area);
    clear(panel, buffer);
    title("luminance", "EV", Focus::Elsewhere, panel, buffer);
    if let Some(shown) = shown {
        chart(shown, panel, buffer);
    } else {
        let mut row = Row::new(buffer, panel, 2);
        row.skip(1).put("only of light and albedo", theme::DIM);
    }
}

/// Draws the bars, their scale and the shares beyond its ends.
fn chart(histogram: &Histogram, panel: Rect, buffer: &mut Buffer) {
    let [first, last] = HISTOGRAM_STOPS;
    let bins = &histogram.bins;
    let most = bins.iter().copied().max().unwrap_or(0).max(1);
    let steps = u64::from(HEIGHT) * 2;
    let one = bins.len() * first.unsigned_abs() as usize / first.abs_diff(last) as usize;
    for line in 0..HEIGHT {
        let mut row = Row::new(buffer, panel, 1 + line);
        row.skip(1);
        let below = u64::from(HEIGHT - 1 - line) * 2;
        for (at, &count) in bins.iter().enumerate() {
            // Something is always visible of what is not nothing.
            let filled = (u64::from(count) * steps).div_ceil(u64::from(most));
            let style = match at {
                at if at < one => Style::new(),
                _ => theme::WARNING,
            };
            row.put(BARS[filled.saturating_sub(below).min(2) as usize], style);
        }
    }
    let mut scale = Row::new(buffer, panel, 1 + HEIGHT);
    scale.put(&format!(" {first}"), theme::DIM);
    scale.skip_to(panel.x + 1 + one as u16).put("0", theme::DIM);
    let end = format!("+{last}");
    scale.skip_to(panel.right() - 1 - end.len() as u16);
    scale.put(&end, theme::DIM);
    let mut shares = Row::new(buffer, panel, 2 + HEIGHT);
    shares.put(&format!(" {} dark", percentage(histogram.dark)), theme::DIM);
    let style = if 0.0 < histogram.clipped {
        theme::WARNING
    } else {
        theme::DIM
    };
    let clipped = format!("{} >1", percentage(histogram.clipped));
    shares.skip_to(panel.right() - 1 - clipped.len() as u16);
    shares.put(&clipped, style);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::ShownHistogram;
    use crate::view::tests::{app, drawn};

    /// A pixel of each of these luminances and three of ¼; 0.001 is below the scale.
    #[test]
    fn bars_stand_over_their_stops_and_clipping_is_marked() {
        let values = [0.001, 0.25, 0.25, 0.25, 1.0, 1.0, 4.0, 4.0].map(|grey| [grey; 3]);
        let mut app = app();
        app.shared.pictures.histogram = Some(ShownHistogram::of(Histogram::of(&values, 0.0)));
        let expected = [
            "",
            "luminance ───────────── EV",
            "             █",
            "             █   █   █",
            "             █   █   █",
            "             █   █   █",
            " -8              0     +4",
            " 12 % dark        25 % >1",
        ];
        assert_eq!(drawn(&app.shared, render, 40, 8), expected);
        // Where it does not fit, it is left out.
        assert_eq!(drawn(&app.shared, render, 25, 8), [""; 8]);
        app.shared.pictures.histogram = Some(ShownHistogram::default());
        let line = drawn(&app.shared, render, 40, 8).swap_remove(3);
        assert_eq!(line, " only of light and albedo");
    }
}
