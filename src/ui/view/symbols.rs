//! Symbols of lights, the camera and groups over the picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::row::put_at;
use crate::app::{Shared, SymbolKind, display};
use crate::terminal::ColourDepth;
use crate::theme;

/// Draws the symbols over the cells of the picture; that of the selected node stands out.
pub(super) fn render(shared: &Shared, depth: ColourDepth, cells: Rect, buffer: &mut Buffer) {
    for symbol in display::symbols(shared) {
        let (sign, plain, style) = match symbol.kind {
            SymbolKind::Light => ("✶", "*", theme::WARNING),
            SymbolKind::Camera => ("◎", "@", theme::ACCENT),
            SymbolKind::Group => ("◇", "#", theme::GOOD),
        };
        let place = (cells.x + symbol.cell.0, cells.y + symbol.cell.1);
        // The picture may have another size than at the last step.
        if !cells.contains(place.into()) {
            continue;
        }
        let style = if shared.cursor.selected() == symbol.node {
            theme::chip(style)
        } else {
            style.bg(Color::Black)
        };
        let sign = match depth {
            ColourDepth::Mono => plain,
            ColourDepth::TrueColour | ColourDepth::Palette256 | ColourDepth::Palette16 => sign,
        };
        put_at(place, sign, Style::reset().patch(style), buffer);
    }
}

#[cfg(test)]
mod tests {
    use ratatui::style::Modifier;

    use super::*;
    use crate::view::tests::{app_of, press};
    use language::{Language, Node};

    const TWO_LIGHTS: &str = "\
// view: eye 0 0 10 target 0 0 0 up 0 1 0 fov 60 size 400 300
0 0 0
2
0 0 0  1 1 1
1 0 0  1 1 1
1
sphere 0 0 0 1  0 0 0 .5 .5 .5 0 0 0 1 0 0 1
";

    #[test]
    fn the_symbol_of_the_selected_light_stands_out() {
        for (depth, sign) in [(ColourDepth::TrueColour, "✶"), (ColourDepth::Mono, "*")] {
            let mut app = app_of(Language::Ray, TWO_LIGHTS);
            // From the view to the first light.
            press(&mut app, "jj");
            assert_eq!(app.shared.cursor.selected(), Node::Light(0));
            let (cells, _) = app.shared.raster().expect("there is room");
            let mut buffer = Buffer::empty(cells);
            render(&app.shared, depth, cells, &mut buffer);
            let signs = buffer.content.iter().filter(|cell| cell.symbol() == sign);
            let is_reversed = signs.map(|cell| cell.modifier.contains(Modifier::REVERSED));
            assert_eq!(is_reversed.collect::<Vec<_>>(), [true, false]);
        }
    }
}
