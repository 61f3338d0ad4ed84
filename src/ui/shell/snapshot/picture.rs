//! A picture of a screen: half blocks as two squares of colour, characters in a small font.

use ratatui::buffer::{Buffer, Cell};
use ratatui::style::Modifier;

use super::font::{self, HEIGHT, WIDTH};
use crate::terminal::colour_on_screen;
use crate::theme::Theme;
use render::Frame;
use scene::Size;

/// The side of a dot of the font, in pixels.
const DOT: usize = 2;

/// The ink and the paper of a dark terminal where no colours are set.
const DARK: [[u8; 3]; 2] = [[204, 204, 204], [16, 16, 20]];
/// The same of a light one.
const LIGHT: [[u8; 3]; 2] = [[36, 36, 40], [255, 255, 255]];

/// Draws a screen on a terminal for a theme.
pub(in crate::shell) fn drawn(cells: &Buffer, theme: Theme) -> Frame {
    let plain = match theme {
        Theme::Dark | Theme::Mono => DARK,
        Theme::Light => LIGHT,
    };
    let (columns, rows) = (cells.area.width as usize, cells.area.height as usize);
    let (width, height) = (columns * WIDTH * DOT, rows * HEIGHT * DOT);
    let mut pixels = vec![plain[1]; width * height];
    for row in 0..rows {
        for column in 0..columns {
            let tile = tile(&cells[(column as u16, row as u16)], plain);
            for y in 0..HEIGHT * DOT {
                let from = ((row * HEIGHT * DOT) + y) * width + column * WIDTH * DOT;
                for x in 0..WIDTH * DOT {
                    pixels[from + x] = tile[y / DOT][x / DOT];
                }
            }
        }
    }
    let [width, height] = [width, height].map(|side| side as u32);
    Frame::drawn(Size { width, height }, pixels)
}

/// The dots of a cell.
fn tile(cell: &Cell, [ink, paper]: [[u8; 3]; 2]) -> [[[u8; 3]; WIDTH]; HEIGHT] {
    let mut ink = colour_on_screen(cell.fg).unwrap_or(ink);
    let mut paper = colour_on_screen(cell.bg).unwrap_or(paper);
    if cell.modifier.contains(Modifier::REVERSED) {
        std::mem::swap(&mut ink, &mut paper);
    }
    if cell.modifier.contains(Modifier::DIM) {
        ink = mixed(ink, paper);
    }
    let character = cell.symbol().chars().next().unwrap_or(' ');
    let mut shape = font::shape(character);
    if cell.modifier.contains(Modifier::UNDERLINED) {
        shape[HEIGHT - 2] = [true; WIDTH];
    }
    shape.map(|line| line.map(|is_ink| if is_ink { ink } else { paper }))
}

fn mixed(ink: [u8; 3], paper: [u8; 3]) -> [u8; 3] {
    std::array::from_fn(|channel| ink[channel].midpoint(paper[channel]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::layout::Rect;
    use ratatui::style::{Color, Style};

    /// The colour of the pixel in the middle of a dot.
    fn dot(frame: &Frame, x: usize, y: usize) -> [u8; 3] {
        frame.pixels[y * DOT * frame.size.width as usize + x * DOT]
    }

    #[test]
    fn a_half_block_is_two_pixels_of_exact_colour() {
        let mut cells = Buffer::empty(Rect::new(0, 0, 2, 1));
        let colours = Style::new().fg(Color::Rgb(1, 2, 3)).bg(Color::Rgb(4, 5, 6));
        cells.set_string(1, 0, "▀", colours);
        let frame = drawn(&cells, Theme::Dark);
        assert_eq!((frame.size.width, frame.size.height), (24, 24));
        for x in WIDTH..2 * WIDTH {
            for y in 0..HEIGHT {
                let expected = if y < HEIGHT / 2 { [1, 2, 3] } else { [4, 5, 6] };
                assert_eq!(dot(&frame, x, y), expected, "{x} {y}");
            }
        }
        assert_eq!(dot(&frame, 0, 0), DARK[1]);
        assert_eq!(dot(&drawn(&cells, Theme::Light), 0, 0), LIGHT[1]);
    }

    #[test]
    fn reverse_video_exchanges_the_colours() {
        let mut cells = Buffer::empty(Rect::new(0, 0, 1, 1));
        cells.set_string(0, 0, "l", Style::new().add_modifier(Modifier::REVERSED));
        let frame = drawn(&cells, Theme::Dark);
        assert_eq!(dot(&frame, 0, 0), DARK[0]);
        assert!(frame.pixels.contains(&DARK[1]));
    }
}
