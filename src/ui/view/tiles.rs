//! Pictures drawn as mosaics.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::inks::Inks;
use super::mosaic::{MOST, Mosaic};
use crate::scene::Size;
use crate::ui::app::CellImage;
use crate::ui::theme;

/// Draws the pixels of a picture over its cells as a mosaic. Cells that lack pixels at the right or
/// lower edge repeat the last ones.
pub(super) fn paint(
    shown: &CellImage,
    mosaic: Mosaic,
    inks: &mut Inks,
    area: Rect,
    buffer: &mut Buffer,
) {
    let (across, down) = mosaic.grid();
    let Size { width, height } = shown.size;
    let pixel = |x: u32, y: u32| {
        let at = y.min(height - 1) as usize * width as usize + x.min(width - 1) as usize;
        if shown.is_outlined(at) {
            theme::OUTLINE
        } else {
            shown.pixels[at]
        }
    };
    for position in area.intersection(buffer.area).positions() {
        let (column, row) = (position.x - area.x, position.y - area.y);
        let mut pixels = [[0; 3]; MOST];
        for (at, shown) in (0..u32::from(across * down)).zip(&mut pixels) {
            let x = u32::from(column * across) + at % u32::from(across);
            let y = u32::from(row * down) + at / u32::from(across);
            *shown = pixel(x, y);
        }
        let tile = mosaic.tile(&pixels);
        let (x, y) = (u32::from(column), 2 * u32::from(row));
        let style = Style::reset()
            .fg(inks.colour(tile.ink, x, y))
            .bg(inks.colour(tile.paper, x, y + 1));
        buffer[position].set_char(tile.symbol).set_style(style);
    }
}

#[cfg(test)]
mod tests {
    use ratatui::style::Color;

    use super::*;
    use crate::render::NO_OBJECT;
    use crate::ui::terminal::ColourDepth;

    #[test]
    fn a_mosaic_shows_more_pixels_and_repeats_the_last_ones() {
        let [a, b] = [[250, 0, 0], [0, 0, 250]];
        // Three columns and five rows: the second column and row of cells lack pixels.
        let size = Size {
            width: 3,
            height: 5,
        };
        let picture = CellImage {
            size,
            pixels: [[a, b, a]; 4]
                .concat()
                .into_iter()
                .chain([b, a, b])
                .collect(),
            objects: vec![NO_OBJECT; size.pixels()],
            outline: Vec::new(),
        };
        let area = Rect::new(1, 1, 2, 2);
        let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 4));
        let mut inks = Inks::for_depth(ColourDepth::TrueColour);
        paint(&picture, Mosaic::Octant, &mut inks, area, &mut buffer);
        let rgb = |[red, green, blue]: [u8; 3]| Color::Rgb(red, green, blue);
        let cell = |x, y| {
            let cell = &buffer[(x, y)];
            (cell.symbol(), cell.fg, cell.bg)
        };
        assert_eq!(cell(1, 1), ("▌", rgb(a), rgb(b)));
        assert_eq!(cell(1, 2), ("▌", rgb(b), rgb(a)));
        assert_eq!((cell(2, 1).0, cell(2, 1).2), (" ", rgb(a)));
        assert_eq!((cell(2, 2).0, cell(2, 2).2), (" ", rgb(b)));
        assert_eq!(cell(3, 1).0, " ");
    }
}
