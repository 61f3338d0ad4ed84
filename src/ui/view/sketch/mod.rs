//! Pictures by shape, for terminals with 16 colours or none: areas in calm shades, and the edges of
//! objects where the shades of both sides would not tell them apart.
//!
//! A cell has two by four pixels, which are square. What covers most of it gives its shade, so that
//! edges do not blur; the shades use the whole range from the darkest to the brightest part of the
//! picture.

mod cell;
mod edge;
mod range;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Modifier, Style};

use super::few_colours::Palette;
use super::inks::Inks;
use crate::app::{CellImage, Grid};
use crate::theme;
use cell::{Areas, Cell};
use edge::Line;
use range::Range;

/// The same as pixels in each cell of a picture.
pub(super) const GRID: Grid = Grid {
    across: SKETCH.0,
    down: SKETCH.1,
};

/// The number of pixels in a cell of a sketch across and down.
pub const SKETCH: (u16, u16) = (2, 4);

/// The shades without colours in equal steps of lightness, from black to white.
const SHADES: [&str; 7] = [" ", ".", ":", "░", "▒", "▓", "█"];

/// The blocks with these quarters, row by row from the lowest bit.
const QUARTERS: [&str; 16] = [
    " ", "▘", "▝", "▀", "▖", "▌", "▞", "▛", "▗", "▚", "▐", "▜", "▄", "▙", "▟", "█",
];

/// Draws a picture of [`GRID`] over its cells.
pub(super) fn paint(shown: &CellImage, inks: &mut Inks, area: Rect, buffer: &mut Buffer) {
    if shown.pixels.is_empty() {
        return;
    }
    let range = Range::of(&shown.pixels);
    for position in area.intersection(buffer.area).positions() {
        let place = (position.x - area.x, position.y - area.y);
        let Some(cell) = Cell::at(shown, place) else {
            continue;
        };
        let line = edge::line(shown, place);
        let (symbol, style) = match inks.palette() {
            None => (shade(&cell, line, range), marked(&cell)),
            Some(palette) => coloured(&cell, line, range, palette),
        };
        buffer[position].set_symbol(symbol).set_style(style);
    }
}

/// The picture of a sketch that shows one of half blocks.
pub(super) fn finer(shown: &CellImage) -> CellImage {
    let mut finer = shown.resampled(GRID.size(shown.size));
    if !shown.outline.is_empty() {
        let width = finer.size.width as usize;
        let half = |at: usize| at / width / 2 * (width / 2) + at % width / 2;
        let pixels = 0..finer.pixels.len();
        finer.outline = pixels.map(|at| shown.is_outlined(half(at))).collect();
    }
    finer
}

/// The character of a cell without colours: both of its areas where one is nearly black and the
/// other nearly white, otherwise a line where an edge is, or a shade.
fn shade(cell: &Cell, line: Option<Line>, range: Range) -> &'static str {
    const ENDS: [f32; 2] = [0.3, 0.7];
    if let Some(Areas { colours, quarters }) = cell.areas {
        let [first, second] = colours.map(|colour| range.share(colour));
        if first < ENDS[0] && ENDS[1] < second {
            return QUARTERS[QUARTERS.len() - 1 - quarters];
        }
        if second < ENDS[0] && ENDS[1] < first {
            return QUARTERS[quarters];
        }
    }
    if let Some(line) = line {
        return line.symbol();
    }
    let steps = SHADES.len();
    let step = range.share(cell.colour) * steps as f32;
    SHADES[(step as usize).min(steps - 1)]
}

/// The style of an outline without colours.
fn marked(cell: &Cell) -> Style {
    let mark = cell.is_outlined.then_some(Modifier::REVERSED);
    Style::reset().add_modifier(mark.unwrap_or_default())
}

/// The character of a cell in few colours: both of its areas if their colours differ, otherwise a
/// line where an edge is, or a shade.
fn coloured(
    cell: &Cell,
    line: Option<Line>,
    range: Range,
    palette: &mut Palette,
) -> (&'static str, Style) {
    let style = |ink: u8, paper: u8| {
        let [ink, paper] = [ink, paper].map(Palette::colour);
        Style::reset().fg(ink).bg(paper)
    };
    let colour = range.stretched(cell.colour);
    let areas = cell.areas.filter(|_| !cell.is_outlined);
    if let Some(Areas { colours, quarters }) = areas {
        let [first, second] = colours.map(|colour| palette.nearest(range.stretched(colour)));
        if first != second {
            return (QUARTERS[quarters], style(first, second));
        }
    }
    let outline = Style::new().fg(theme::OUTLINE.into());
    let Some(line) = line else {
        let tint = palette.tint(colour);
        let outline = cell.is_outlined.then_some(outline);
        return (
            tint.symbol(),
            tint.style().patch(outline.unwrap_or_default()),
        );
    };
    let paper = palette.nearest(colour);
    let style = if cell.is_outlined {
        let bold = outline.add_modifier(Modifier::BOLD);
        style(paper, paper).patch(bold)
    } else {
        style(palette.contrast(paper), paper)
    };
    (line.symbol(), style)
}

#[cfg(test)]
mod tests;
