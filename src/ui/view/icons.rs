//! Icons of lights, the camera and groups over the picture.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};

use super::inks::Glyphs;
use crate::ui::app::{App, IconKind};
use crate::ui::theme;

/// Draws the icons over the cells of the picture; that of the selected node stands out.
pub(super) fn render(app: &App, glyphs: Glyphs, cells: Rect, buffer: &mut Buffer) {
    for icon in app.icons() {
        let (symbol, plain, style) = match icon.kind {
            IconKind::Light => ("✶", "*", theme::WARNING),
            IconKind::Camera => ("◎", "@", theme::ACCENT),
            IconKind::Group => ("◇", "#", theme::GOOD),
        };
        let place = (cells.x + icon.cell.0, cells.y + icon.cell.1);
        // The picture may have another size than at the last step.
        if !cells.contains(place.into()) {
            continue;
        }
        let Some(cell) = buffer.cell_mut(place) else {
            continue;
        };
        let style = if app.cursor.selected() == icon.node {
            theme::chip(style)
        } else {
            style.bg(Color::Black)
        };
        cell.set_symbol(match glyphs {
            Glyphs::Characters => plain,
            Glyphs::HalfBlocks | Glyphs::HalfBlocksOf256 | Glyphs::HalfBlocksOf16 => symbol,
        });
        cell.set_style(Style::reset());
        cell.set_style(style);
    }
}

#[cfg(test)]
mod tests {
    use ratatui::style::Modifier;

    use super::*;
    use crate::language::{Language, Node};
    use crate::ui::msg::Msg;
    use crate::ui::view::tests::app_of;

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
    fn the_icon_of_the_selected_light_stands_out() {
        for (glyphs, symbol) in [(Glyphs::HalfBlocks, "✶"), (Glyphs::Characters, "*")] {
            let mut app = app_of(Language::Ray, TWO_LIGHTS);
            // From the view to the first light.
            for key in ['j', 'j'] {
                app.update(Msg::Key(crossterm::event::KeyCode::Char(key).into()));
            }
            assert_eq!(app.cursor.selected(), Node::Light(0));
            let (cells, _) = app.raster().expect("there is room");
            let mut buffer = Buffer::empty(cells);
            render(&app, glyphs, cells, &mut buffer);
            let icons = buffer.content.iter().filter(|cell| cell.symbol() == symbol);
            let reversed: Vec<_> = icons
                .map(|cell| cell.modifier.contains(Modifier::REVERSED))
                .collect();
            assert_eq!(reversed, [true, false]);
        }
    }
}
