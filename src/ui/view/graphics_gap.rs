//! Cells that are left to a picture in real pixels, which the terminal puts there.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::app::App;
use crate::terminal::Pixmap;
use crate::theme;

/// The symbol of cells that are left to the terminal's own picture, a private character.
const LEFT: &str = "\u{f8ff}";

/// The number of cells that are left to the terminal's own picture.
pub(super) fn left_in(cells: Rect, buffer: &Buffer) -> usize {
    let cells = cells.intersection(buffer.area).positions();
    cells.filter(|&at| buffer[at].symbol() == LEFT).count()
}

/// Blanks the cells that are left to the terminal's own picture.
pub(super) fn blank(cells: Rect, buffer: &mut Buffer) {
    for at in cells.intersection(buffer.area).positions() {
        if buffer[at].symbol() == LEFT {
            buffer[at].set_symbol(" ");
        }
    }
}

/// The current picture with its outline, for a terminal that shows pictures.
pub fn pixmap(app: &App) -> Pixmap {
    let shown = &app.shared.picture().shown;
    let pixels = shown.pixels.iter().enumerate().map(|(at, &pixel)| {
        if shown.is_outlined(at) {
            theme::OUTLINE
        } else {
            pixel
        }
    });
    Pixmap {
        size: shown.size,
        pixels: pixels.collect(),
    }
}

/// Leaves cells to the terminal's own picture.
pub(super) fn leave(cells: Rect, buffer: &mut Buffer) {
    for at in cells.intersection(buffer.area).positions() {
        buffer[at].reset();
        buffer[at].set_symbol(LEFT);
    }
}

#[cfg(test)]
mod tests {
    use crate::app::display;
    use ratatui::backend::TestBackend;
    use ratatui::layout::Rect;
    use ratatui::terminal::Terminal;

    use crate::app::{App, Page};
    use crate::keymap::Context;
    use crate::terminal::ColourDepth;
    use crate::view::tests::{app, frame, lines, retype, show};
    use crate::view::{Drawing, Inks, draw};

    /// The cells left to a picture by the terminal, and whether any half blocks are drawn.
    fn left(app: &mut App) -> (Option<Rect>, bool) {
        app.shared.terminal = (100, 30);
        let mut inks = Inks::for_depth(ColourDepth::TrueColour);
        inks.drawing = Drawing::Picture;
        let mut terminal = Terminal::new(TestBackend::new(100, 30)).expect("cannot fail");
        let mut left = None;
        let drawn = terminal.draw(|frame| left = draw(app, &mut inks, frame));
        let text = lines(drawn.expect("cannot fail").buffer).concat();
        // The mark of what is left is not shown.
        assert!(!text.contains('\u{f8ff}'));
        (left, text.contains('▀'))
    }

    #[test]
    fn cells_are_left_to_a_picture_unless_a_panel_is_over_it() {
        let mut app = app();
        assert_eq!(left(&mut app), (None, false), "there is no picture yet");
        let frame_window = display::frame_window(&app.shared).expect("there is room");
        show(&mut app, frame(8, 6), &frame_window);
        let cells = app.shared.raster().map(|(cells, _)| cells);
        assert_eq!(left(&mut app), (cells, false));
        let page = Page::of(Context::Recent, "Recent scenes", vec!["a.ray".to_owned()]);
        app.shared.overlays.open_page(page);
        assert_eq!(left(&mut app), (None, true));
        app.shared.overlays.page = None;
        assert_eq!(left(&mut app), (cells, false));
        // A few words over it are drawn on top.
        retype(&mut app, " 0.25 ", " -1 ");
        let (place, has_blocks) = left(&mut app);
        assert!(place.is_some() && !has_blocks);
    }
}
