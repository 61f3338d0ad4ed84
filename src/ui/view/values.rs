//! The values of pixels, written into them where they are large enough.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::row::Row;
use crate::app::{FrameWindow, Window};
use render::Frame;

/// The smallest pixel, in cells, into which its 8-bit colour is written.
const SMALLEST: (u16, u16) = (12, 3);

/// The height in cells from which its linear values are written too.
const ROOMY: u16 = 5;

/// Writes the values of a frame's pixels into them, if their cells have room.
pub(super) fn render(frame: &Frame, frame_window: &FrameWindow, cells: Rect, buffer: &mut Buffer) {
    let Some(Window { whole, part, fills }) = frame_window.window else {
        return;
    };
    let width = (fills.width / part.width) as u16 / frame_window.grid.across;
    let height = (fills.height / part.height) as u16 / frame_window.grid.down;
    if width < SMALLEST.0 || height < SMALLEST.1 || frame.whole() != whole {
        return;
    }
    // The first whole cell of a pixel: pixels need not begin at the edges of cells.
    let begin = |number: usize, fills: u32, of: u32, across: u16| {
        (number as u32 * fills / of).div_ceil(across.into()) as u16
    };
    for (row, y) in (part.y..part.y + part.height).enumerate() {
        for (column, x) in (part.x..part.x + part.width).enumerate() {
            let pixel = Rect {
                x: cells.x + begin(column, fills.width, part.width, frame_window.grid.across),
                y: cells.y + begin(row, fills.height, part.height, frame_window.grid.down),
                width,
                height,
            };
            // A pixel that is cut off is too small to be read.
            let Some(at) = frame.index_of([x, y]) else {
                continue;
            };
            if cells.intersection(pixel) == pixel
                && let Some(colour) = frame.pixels.get(at)
            {
                write(lines(frame, at, height), *colour, pixel, buffer);
            }
        }
    }
}

/// The 8-bit colour of a pixel, and its linear values if there is room.
fn lines(frame: &Frame, at: usize, height: u16) -> Vec<String> {
    let [red, green, blue] = frame.pixels[at];
    let mut lines = vec![format!("{red} {green} {blue}")];
    if let Some(values) = frame.values.get(at)
        && ROOMY <= height
    {
        lines.extend(values.map(|value| format!("{value:.3}")));
    }
    lines
}

/// Writes lines into the middle of a pixel, in black or white.
fn write(lines: Vec<String>, colour: [u8; 3], pixel: Rect, buffer: &mut Buffer) {
    let [red, green, blue] = colour.map(u32::from);
    let ink = match 2 * (299 * red + 587 * green + 114 * blue) {
        ..=255_000 => Color::White,
        _ => Color::Black,
    };
    let style = Style::reset().fg(ink).bg(colour.into());
    let top = (pixel.height - lines.len() as u16) / 2;
    for (line, text) in (top..).zip(lines) {
        let left = pixel.width.saturating_sub(text.len() as u16) / 2;
        Row::new(buffer, pixel, line).skip(left).put(&text, style);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::Grid;
    use crate::layout::tests::size;
    use crate::view::tests::lines as lines_of;
    use render::Region;
    use scene::Size;

    /// A part of a picture where it fills so many pixels of the screen.
    fn window(whole: Size, part: Region, fills: Size) -> FrameWindow {
        FrameWindow {
            window: Some(Window { whole, part, fills }),
            ..FrameWindow::whole(fills)
        }
    }

    /// What is written into the pixels of a part of a picture that fills so many cells.
    fn written(part: &str, (columns, rows): (u16, u16)) -> Vec<String> {
        let whole = size(4, 3);
        let mut frame = Frame::drawn(whole, (0..12).map(|at| [20 * at, 7, 255]).collect());
        frame.values = vec![[0.5, -1.0, 12.3456]; 12];
        let part = Region::parse(part).expect("a region");
        let window = window(whole, part, size(columns.into(), 2 * u32::from(rows)));
        let mut buffer = Buffer::empty(Rect::new(0, 0, columns, rows));
        render(&frame, &window, buffer.area, &mut buffer);
        lines_of(&buffer)
    }

    #[test]
    fn values_are_written_where_they_fit() {
        let low = ["", "  20 7 255    40 7 255", ""];
        assert_eq!(written("1,0,2,1", (24, 3)), low);
        let roomy = ["", " 200 7 255", "   0.500", "   -1.000", "   12.346", ""];
        assert_eq!(written("2,2,1,1", (12, 6)), roomy);
        assert_eq!(written("2,2,1,1", (11, 6)), [""; 6]);
        assert_eq!(written("2,2,1,1", (12, 2)), [""; 2]);
    }

    /// On a grid of 5 by 10 pixels a cell, a pixel of the picture is 12.8 cells wide.
    #[test]
    fn values_stay_in_their_pixels_where_these_begin_within_cells() {
        let whole = size(16, 1);
        let frame = Frame::drawn(whole, (0..16).map(|at| [at, 0, 0]).collect());
        let window = FrameWindow {
            grid: Grid {
                across: 5,
                down: 10,
            },
            ..window(whole, Region::whole(whole), size(1024, 64))
        };
        let mut buffer = Buffer::empty(Rect::new(0, 0, 205, 6));
        render(&frame, &window, buffer.area, &mut buffer);
        for x in 0..205 {
            if let Color::Rgb(pixel, ..) = buffer[(x, 2)].bg {
                let edges = [u32::from(x) * 5, u32::from(x) * 5 + 4];
                assert_eq!(edges.map(|edge| edge / 64), [u32::from(pixel); 2], "{x}");
            }
        }
    }

    #[test]
    fn the_ink_contrasts_with_the_pixel() {
        let ink = |colour| {
            let mut buffer = Buffer::empty(Rect::new(0, 0, 12, 3));
            write(vec!["x".to_owned()], colour, buffer.area, &mut buffer);
            buffer[(5, 1)].fg
        };
        assert_eq!(ink([0, 0, 255]), Color::White);
        assert_eq!(ink([0, 255, 0]), Color::Black);
    }
}
