//! What is drawn before the contents of a panel that covers others: empty cells, and a frame.

use ratatui::buffer::Buffer;
use ratatui::layout::{Margin, Position, Rect};
use ratatui::style::Style;
use ratatui::symbols::border::ROUNDED;
use ratatui::text::Line;
use ratatui::widgets::Widget;

/// Empties the cells of an area, as far as they exist.
pub(super) fn clear(area: Rect, buffer: &mut Buffer) {
    for at in area.intersection(buffer.area).positions() {
        buffer[at].reset();
    }
}

/// Clears an area, as far as it exists, and draws a frame within its edge, with a title at the left
/// and a note at the right of its top. A title that has no room is cut at its end, a note at its
/// beginning, and a note covers a title. Returns the area inside the frame.
pub(super) fn frame(
    title: &str,
    note: &str,
    style: Style,
    area: Rect,
    buffer: &mut Buffer,
) -> Rect {
    let inner = area.inner(Margin::new(1, 1));
    let area = area.intersection(buffer.area);
    clear(area, buffer);
    for at in area.positions() {
        if let Some(symbol) = edge(at, area) {
            buffer[at].set_symbol(symbol).set_style(style);
        }
    }
    let top = Rect {
        height: 1,
        ..area.inner(Margin::new(1, 0))
    };
    Line::from(title).render(top, buffer);
    Line::from(note).right_aligned().render(top, buffer);
    inner
}

/// The symbol of a cell of an area, if it is at the edge.
fn edge(at: Position, area: Rect) -> Option<&'static str> {
    let is_right = at.x + 1 == area.right();
    let is_bottom = at.y + 1 == area.bottom();
    let symbol = match (at.x == area.x, at.y == area.y) {
        (true, true) => ROUNDED.top_left,
        (true, false) if is_bottom => ROUNDED.bottom_left,
        (false, true) if is_right => ROUNDED.top_right,
        (false, false) if is_right && is_bottom => ROUNDED.bottom_right,
        (true, false) => ROUNDED.vertical_left,
        (false, true) => ROUNDED.horizontal_top,
        (false, false) if is_right => ROUNDED.vertical_right,
        (false, false) if is_bottom => ROUNDED.horizontal_bottom,
        (false, false) => return None,
    };
    Some(symbol)
}

#[cfg(test)]
mod tests {
    use ratatui::buffer::Cell;

    use super::*;

    /// A frame in a buffer of dots that it fills but for one cell at each side.
    fn framed(title: &str, note: &str, width: u16, height: u16) -> String {
        let mut buffer = Buffer::empty(Rect::new(0, 0, width + 2, height + 2));
        for cell in &mut buffer.content {
            cell.set_symbol(".");
        }
        let area = Rect::new(1, 1, width, height);
        let inner = frame(title, note, Style::new(), area, &mut buffer);
        let sides = [width, height].map(|side| u32::from(side.saturating_sub(2)));
        assert_eq!(inner.area(), sides[0] * sides[1]);
        let symbols = buffer.content.iter().map(Cell::symbol);
        let symbols: Vec<_> = symbols.collect();
        let lines = symbols.chunks(usize::from(width) + 2).map(<[_]>::concat);
        lines.collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn a_frame_is_drawn_within_the_edge_of_its_area() {
        assert_eq!(
            framed(" Keys ", "1 of 9", 16, 4),
            "\
..................
.╭ Keys ──1 of 9╮.
.│              │.
.│              │.
.╰──────────────╯.
.................."
        );
    }

    #[test]
    fn a_frame_fits_in_every_area() {
        assert_eq!(framed("a", "", 4, 2), "......\n.╭a─╮.\n.╰──╯.\n......");
        assert_eq!(framed("abcd", "", 4, 1), "......\n.╭ab╮.\n......");
        assert_eq!(framed("ab", "1234", 4, 1), "......\n.╭34╮.\n......");
        assert_eq!(framed("a", "b", 1, 3), "...\n.╭.\n.│.\n.╰.\n...");
        assert_eq!(framed("a", "b", 0, 2), "..\n..\n..\n..");
    }

    #[test]
    fn what_is_outside_of_the_screen_is_left_out() {
        let mut buffer = Buffer::empty(Rect::new(0, 0, 3, 2));
        let inner = frame("a", "", Style::new(), Rect::new(1, 0, 4, 4), &mut buffer);
        assert_eq!(inner, Rect::new(2, 1, 2, 2));
        let symbols: String = buffer.content.iter().map(Cell::symbol).collect();
        assert_eq!(symbols, " ╭╮ ╰╯");
    }
}
