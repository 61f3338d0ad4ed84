//! Pictures drawn as mosaics.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::inks::Inks;
use super::mosaic::{MOST, Mosaic};
use crate::app::CellImage;
use crate::theme;
use scene::Size;

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
        if tile.ink == tile.paper && inks.has_few() {
            let (symbol, style) = inks.flat(tile.paper);
            buffer[position].set_symbol(symbol).set_style(style);
            continue;
        }
        let style = Style::reset()
            .fg(inks.colour(tile.ink))
            .bg(inks.colour(tile.paper));
        buffer[position].set_char(tile.symbol).set_style(style);
    }
}

#[cfg(test)]
mod tests {
    use ratatui::style::Color;

    use super::*;
    use crate::terminal::ColourDepth;
    use crate::view::tests::cell_image;

    #[test]
    fn a_mosaic_shows_more_pixels_and_repeats_the_last_ones() {
        let [a, b] = [[250, 0, 0], [0, 0, 250]];
        // Three columns and five rows: the second column and row of cells lack pixels.
        let rows = [[a, b, a], [a, b, a], [a, b, a], [a, b, a], [b, a, b]];
        let picture = cell_image(3, 5, rows.concat());
        let mut buffer = Buffer::empty(Rect::new(0, 0, 4, 4));
        let mut inks = Inks::for_depth(ColourDepth::TrueColour);
        let area = Rect::new(1, 1, 2, 2);
        paint(&picture, Mosaic::Octant, &mut inks, area, &mut buffer);
        let [a, b] = [a, b].map(|[red, green, blue]| Color::Rgb(red, green, blue));
        for (at, symbol, ink, paper) in [
            ((1, 1), "▌", Some(a), b),
            ((1, 2), "▌", Some(b), a),
            ((2, 1), " ", None, a),
            ((2, 2), " ", None, b),
        ] {
            let cell = &buffer[at];
            assert_eq!((cell.symbol(), cell.bg), (symbol, paper), "{at:?}");
            assert!(ink.is_none_or(|ink| cell.fg == ink), "{at:?}");
        }
        assert_eq!(buffer[(3, 1)].symbol(), " ");
    }
}
