//! The comparison: its panel, and what marks the compared pictures.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::Inks;
use super::row::{Focus, Row, put_at, title};
use crate::app::{App, Compare, Contrast, compare};
use crate::framing::clear;
use crate::theme;
use ::compare::{Comparison, Difference};

/// Width of the names of the panel, with a gap.
const NAMES: u16 = 11;

/// Draws what is compared, how it differs, and the worst pixels.
pub(super) fn render(app: &App, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    clear(area, buffer);
    let (compared, view) = (&app.compare, app.compare.view.name());
    title("comparison", &view, Focus::Here, area, buffer);
    let mut lines = Lines {
        area,
        at: 1,
        buffer,
    };
    let spp = compared.progress().map(|progress| progress.spp);
    let spp = spp.map_or_else(String::new, |spp| format!(", {spp} spp"));
    let name = app.shared.disk.name();
    lines.put("live", &format!("{name}{spp}"), Style::new());
    if let Some(reference) = &compared.reference {
        lines.put("reference", &reference.name, Style::new());
    }
    if let Some(unlike) = compare::unlike(&app.compare, &app.shared) {
        lines.put("", &unlike, theme::WARNING);
    }
    lines.at += 1;
    let Some(found) = compared.figures() else {
        lines.put("", "still being traced", theme::DIM);
        return;
    };
    let style = figures_style(&app.compare);
    if !compared.are_figures_final() {
        lines.put("", "so far:", style);
    }
    lines.put("differing", &found.differing_words(), style);
    for (name, figure) in found.figures() {
        lines.put(name, &figure, style);
    }
    lines.at += 1;
    scale(app.compare.view, &mut lines, inks);
    worst(app, found, &mut lines, inks);
}

/// The style of how the pictures differ: figures that may still change are dim.
pub(super) fn figures_style(compared: &Compare) -> Style {
    if compared.are_figures_final() {
        Style::new()
    } else {
        theme::DIM
    }
}

/// The lines of the panel that are still free.
struct Lines<'b> {
    area: Rect,
    at: u16,
    buffer: &'b mut Buffer,
}

impl Lines<'_> {
    /// Begins the next line.
    fn row(&mut self) -> Row<'_> {
        let at = self.at;
        self.at += 1;
        Row::new(self.buffer, self.area, at)
    }

    /// Draws a name and what it stands for.
    fn put(&mut self, name: &str, text: &str, style: Style) {
        let column = self.area.x + NAMES;
        let mut row = self.row();
        row.skip(1).put(name, theme::DIM);
        row.skip_to(column).put(text, style);
    }
}

/// Draws what the colours of differences stand for, in levels of 255.
fn scale(view: Contrast, lines: &mut Lines, inks: &mut Inks) {
    const STEPS: u8 = 16;
    // The levels at a quarter, a half, three quarters and the end; those of a heat map are logarithmic.
    let (levels, marks) = match view {
        Contrast::Difference(gain) => {
            let most = f64::from(u8::MAX) / f64::from(gain);
            let level = move |share: f64| share * most;
            (
                Box::new(level) as Box<dyn Fn(f64) -> f64>,
                [0.0, 0.5 * most, most],
            )
        }
        Contrast::Heat => {
            let level = |share: f64| libm::expm1(share * libm::log1p(64.0));
            (Box::new(level) as _, [0.0, level(0.5), 64.0])
        }
        _ => return,
    };
    let column = lines.area.x + NAMES;
    let mut row = lines.row();
    row.skip(1).put("scale", theme::DIM).skip_to(column);
    for step in 0..=STEPS {
        let level = levels(f64::from(step) / f64::from(STEPS)).round() as u8;
        let colour = view.colour_of(level);
        let style = Style::new().fg(inks.colour(colour));
        row.put("█", style);
    }
    let [least, middle, most] = marks.map(|mark| format!("{mark:.0}"));
    let half = usize::from(STEPS) / 2;
    let words = format!("{least:<half$}{middle:<half$}{most}+ of 255");
    lines.put("", &words, theme::DIM);
    lines.at += 1;
}

/// Draws the worst pixels with their colours in both pictures.
fn worst(app: &App, found: &Comparison, lines: &mut Lines, inks: &mut Inks) {
    if found.worst.is_empty() {
        lines.put("", "no pixel differs", theme::GOOD);
        return;
    }
    lines.put("worst pixels", "", theme::DIM);
    for worst in &found.worst {
        let is_here = app.compare.cross == Some((worst.x, worst.y));
        let style = if is_here { theme::BOLD } else { Style::new() };
        let column = lines.area.x + NAMES;
        let mut row = lines.row();
        row.put(if is_here { "▸" } else { " " }, style);
        row.put(&format!("{},{}", worst.x, worst.y), style);
        row.skip_to(column);
        for colour in worst.colours {
            let style = Style::new().fg(inks.colour(colour));
            row.put("██", style).skip(1);
        }
        row.put(&format!("by {}", worst.largest()), style);
    }
}

/// Draws the line of a wipe, and the cross with the colours there, over the cells of the picture.
pub(super) fn mark(app: &App, cells: Rect, buffer: &mut Buffer) {
    let cell = |[column, row]: [f64; 2]| {
        let inside = |at: f64, cells: u16| (0.0..f64::from(cells)).contains(&at);
        let is_inside = inside(column, cells.width) && inside(row / 2.0, cells.height);
        is_inside.then_some((cells.x + column as u16, cells.y + (row / 2.0) as u16))
    };
    if let Some(column) = compare::wipe_on_screen(&app.compare, &app.shared) {
        // At the right edge it is beyond the last cell.
        let column = column.round().min(f64::from(cells.width) - 1.0);
        if let Some((x, _)) = cell([column, 0.0]) {
            let style = Style::new().fg(theme::OUTLINE.into());
            for y in cells.top()..cells.bottom() {
                put_at((x, y), "│", style, buffer);
            }
        }
    }
    let Some(Difference { x, y, colours }) = app.compare.at_cross() else {
        return;
    };
    if let Some(place) = compare::cross_on_screen(&app.compare, &app.shared).and_then(cell) {
        put_at(place, "┼", theme::CROSS, buffer);
    }
    let [live, reference] =
        colours.map(|[red, green, blue]: [u8; 3]| format!("{red} {green} {blue}"));
    let text = format!(" {x},{y}: {live}, reference {reference} ");
    Row::new(buffer, cells, 0).put(&text, theme::chip(theme::ACCENT));
}
