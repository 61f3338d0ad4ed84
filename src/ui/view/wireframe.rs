//! Wireframes in braille: eight dots per cell, in a single ink, so that a step of the camera sends
//! few bytes over a slow link.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::symbols::braille::BRAILLE;

use super::row::Row;
use crate::theme;
use render::{WireLine, Wireframe};

/// Columns and rows of dots in a cell.
const DOTS: [usize; 2] = [2, 4];
/// Dots per pixel, in both directions.
const PER_PIXEL: f64 = 2.0;

/// Draws the lines over the cells of the picture; those of the `outlined` objects, ascending, stand
/// out. Says how many objects are drawn if not all are.
pub(super) fn paint(wireframe: &Wireframe, outlined: &[u32], area: Rect, buffer: &mut Buffer) {
    let [columns, rows] = [area.width, area.height].map(usize::from);
    // The dots of each cell, row by row from the lowest bit, and whether any of them are outlined.
    let mut cells = vec![(0_u8, false); columns * rows];
    for line in &wireframe.lines {
        let is_outlined = outlined.binary_search(&line.object).is_ok();
        for [x, y] in dots(line) {
            let (column, row) = (x / DOTS[0], y / DOTS[1]);
            if column < columns && row < rows {
                let cell = &mut cells[row * columns + column];
                cell.0 |= 1 << (DOTS[0] * (y % DOTS[1]) + x % DOTS[0]);
                cell.1 |= is_outlined;
            }
        }
    }
    for (position, (mask, is_outlined)) in area.positions().zip(cells) {
        let Some(cell) = buffer.cell_mut(position) else {
            continue;
        };
        cell.reset();
        if mask != 0 {
            cell.set_char(BRAILLE[usize::from(mask)]);
        }
        if is_outlined {
            cell.set_style(theme::OUTLINED);
        }
    }
    if wireframe.drawn < wireframe.seen {
        let text = format!(" {} of {} objects ", wireframe.drawn, wireframe.seen);
        Row::new(buffer, area, 0).put(&text, theme::DIM);
    }
}

/// The dots of a line, one for each step along its longer direction.
fn dots(line: &WireLine) -> impl Iterator<Item = [usize; 2]> {
    let [start, end] = line.ends.map(|end| end.map(|at| PER_PIXEL * at));
    let run = [end[0] - start[0], end[1] - start[1]];
    let steps = run[0].abs().max(run[1].abs()).ceil().max(1.0);
    (0..=steps as usize).map(move |step| {
        let share = step as f64 / steps;
        // A line along the right or lower edge of the picture is inside it.
        [0, 1].map(|axis| (start[axis] + share * run[axis]) as usize)
    })
}

#[cfg(test)]
mod tests {
    use ratatui::style::Color;

    use super::*;
    use crate::view::tests::lines;

    fn painted(wires: &[([[f64; 2]; 2], u32)], outlined: &[u32], drawn: usize) -> Buffer {
        let wire = |&(ends, object)| WireLine { ends, object };
        let wireframe = Wireframe {
            lines: wires.iter().map(wire).collect(),
            drawn,
            seen: 3,
        };
        let mut buffer = Buffer::empty(Rect::new(0, 0, 16, 3));
        paint(&wireframe, outlined, buffer.area, &mut buffer);
        buffer
    }

    #[test]
    fn lines_are_drawn_in_braille_dots() {
        let across = [[0.0, 0.0], [2.0, 0.0]];
        let down = [[3.0, 0.0], [3.0, 3.5]];
        let diagonal = [[4.0, 0.0], [6.0, 2.0]];
        let buffer = painted(&[(across, 0), (down, 0), (diagonal, 0)], &[], 3);
        assert_eq!(lines(&buffer), ["⠉⠉⠁⡇⠑⢄", "   ⡇  ⠁", ""]);
        // A line on the right edge of the picture has no cell of its own.
        let edge = [[16.0, 0.0], [16.0, 5.0]];
        assert_eq!(lines(&painted(&[(edge, 0)], &[], 3)), [""; 3]);
    }

    #[test]
    fn only_outlined_objects_are_styled() {
        let at = |x| [[x, 0.0], [x, 0.0]];
        let buffer = painted(&[(at(0.0), 4), (at(1.0), 7), (at(1.0), 1)], &[2, 7], 3);
        let inks = [0, 1].map(|x| buffer[(x, 0)].style().fg);
        assert_eq!(inks, [Some(Color::Reset), theme::OUTLINED.fg]);
    }

    #[test]
    fn objects_left_out_are_counted() {
        for (drawn, shown) in [(2, " 2 of 3 objects"), (3, "")] {
            assert_eq!(lines(&painted(&[], &[], drawn))[0], shown);
        }
    }
}
