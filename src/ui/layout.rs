//! The cells of the picture, and of lines in lists and fields, shared by drawing, the mouse and the
//! size of the preview so that all three agree.
//!
//! Everything here is arithmetic on rectangles and is valid for any size from 0×0.

use ratatui::layout::{Position, Rect};

use scene::Size;

/// Returns the largest picture with the aspect ratio of `output` inside `area`, at two pixels per
/// cell, one above the other: its cells, centred, and its size in pixels. `None` if there is no
/// cell.
pub fn raster(area: Rect, output: Size) -> Option<(Rect, Size)> {
    if area.is_empty() || output.pixels() == 0 {
        return None;
    }
    let (across, down) = (u64::from(area.width), 2 * u64::from(area.height));
    let (width, height) = (u64::from(output.width), u64::from(output.height));
    let (width, height) = if down * width < across * height {
        (rounded_ratio(down * width, height).clamp(1, across), down)
    } else {
        (across, rounded_ratio(across * height, width).clamp(1, down))
    };
    let cells = Rect::new(0, 0, width as u16, height.div_ceil(2) as u16);
    let [width, height] = [width, height].map(|side| side as u32);
    let size = Size { width, height };
    Some((centred(area, cells), size))
}

/// Returns the first line to show so that line `at` is among the `rows` visible lines, with two
/// lines of context if there is room, scrolling as little as possible from `top`.
pub fn first_shown(top: usize, at: usize, count: usize, rows: usize) -> usize {
    let context = (rows.saturating_sub(1) / 2).min(2);
    let lowest = (at + context + 1).saturating_sub(rows);
    let highest = at.saturating_sub(context);
    top.clamp(lowest.min(highest), highest)
        .min(count.saturating_sub(rows))
}

/// The part of a panel below its title line.
pub fn contents(panel: Rect) -> Rect {
    split_top(panel, 1).1
}

/// The line at `index` below the top of an area; empty if it is not inside.
pub fn nth_line(area: Rect, index: u16) -> Rect {
    let y = area.y.saturating_add(index);
    Rect::new(area.x, y, area.width, 1).intersection(area)
}

/// Returns the list line under a cell, if `first` is the first one shown. The caller checks that
/// the line exists.
pub fn list_row_at(list: Rect, first: usize, column: u16, row: u16) -> Option<usize> {
    let lines = contents(list);
    let is_inside = lines.contains(Position::new(column, row));
    is_inside.then(|| first + usize::from(row - lines.y))
}

/// The lines that show fields, and those below that explain the selected one, if it is explained.
pub fn split_fields(fields: Rect, explains: bool) -> (Rect, Rect) {
    let lines = contents(fields);
    let notes = match lines.height {
        _ if !explains => 0,
        0..6 => 0,
        6..ROOMY => 2,
        _ => NOTES,
    };
    split_bottom(lines, notes)
}

/// The lines that show fields.
pub fn field_rows(fields: Rect, explains: bool) -> Rect {
    split_fields(fields, explains).0
}

/// The cells of a field's name, including two for a sign and a gap at its end, and of each of its
/// components in a line of the fields panel.
pub fn field_columns(line: Rect, components: usize) -> (Rect, Vec<Rect>) {
    let widest = if line.width < 42 { 11 } else { 13 };
    let key = (line.width / 3).clamp(6, widest).min(line.width);
    // The remainder of three equal columns widens the name.
    let key = (key + (line.width - key) % 3).min(widest);
    // Numbers that stand far apart are not read as one value.
    let numbers = (line.width - key).min(3 * WIDEST_NUMBER);
    let name = Rect { width: key, ..line };
    // Two components are as wide as two of three, so that numbers align in columns.
    let each = match components {
        0 | 1 => numbers,
        several => numbers / several.max(3) as u16,
    };
    let column = |at| Rect::new(line.x + key + at * each, line.y, each, line.height);
    (name, (0..components as u16).map(column).collect())
}

/// The columns that a literal of this width covers beside its own; `None` if its own has room for it
/// and a gap. Columns after its own are covered before those in front of it.
pub fn widened(columns: &[Rect], component: usize, width: usize, line: Rect) -> Option<Rect> {
    let own = columns.get(component)?;
    let needed = u16::try_from(width + 1).unwrap_or(u16::MAX);
    if needed <= own.width {
        return None;
    }
    let mut ends = columns.iter().skip(component + 1).map(|column| column.x);
    let end = ends.find(|end| needed <= end - own.x);
    // What a division into columns has left over is part of the last one.
    let end = end.unwrap_or_else(|| line.right());
    let mut starts = columns[..=component].iter().rev().map(|column| column.x);
    let start = starts.find(|start| needed <= end - start);
    let start = start.or_else(|| columns.first().map(|first| first.x))?;
    Some(Rect::new(start, own.y, end - start, own.height))
}

/// The cells of a slider behind a literal in a line of the fields panel; `None` if there is no room.
pub fn slider_cells(line: Rect, literal: &str) -> Option<Rect> {
    const NARROWEST: u16 = 6;
    let (_, columns) = field_columns(line, 3);
    let [number, first, last] = columns.as_slice() else {
        return None;
    };
    // The last cell keeps a gap to the border.
    let width = (last.right() - first.x).saturating_sub(1);
    let fits = literal.chars().count() < usize::from(number.width);
    (fits && NARROWEST <= width).then_some(Rect { width, ..*first })
}

/// Returns the field and component under a cell, if `first` is the first field shown. `components`
/// gives the number of components of each field. The name of a field counts as its first component.
pub fn field_at(
    (fields, explains): (Rect, bool),
    first: usize,
    components: impl Fn(usize) -> Option<usize>,
    at: (u16, u16),
) -> Option<(usize, usize)> {
    let rows = field_rows(fields, explains);
    let position = Position::new(at.0, at.1);
    if !rows.contains(position) {
        return None;
    }
    let below = position.y - rows.y;
    let (field, line) = (first + usize::from(below), nth_line(rows, below));
    let (_, columns) = field_columns(line, components(field)?);
    let component = columns.iter().position(|column| column.contains(position));
    Some((field, component.unwrap_or(0)))
}

/// The lines of the colour picker.
#[derive(Clone, Copy, Debug)]
pub struct PickerLines {
    /// The line of each bar, and the cells of the bar in it.
    pub bars: [[Rect; 2]; 3],
    /// The line of the old and the new colour.
    pub comparison: Rect,
    /// The cells of the numbers.
    pub numbers: Rect,
    /// The heading of the scene's colours.
    pub heading: Rect,
    /// The lines of the scene's colours.
    pub swatches: Rect,
}

/// Divides the panel of the colour picker. In a low panel lines share their place.
pub fn picker_lines(panel: Rect) -> PickerLines {
    const NAME: u16 = 12;
    const NUMBER: u16 = 8;
    let lines = contents(panel);
    let line = |at| split_top(split_top(lines, at).1, 1).0;
    let behind = |line, columns| split_right(line, panel.width.saturating_sub(columns)).1;
    let bars = [0, 1, 2].map(|at| {
        let right = behind(line(at), NAME);
        let width = right.width.saturating_sub(NUMBER);
        [line(at), Rect { width, ..right }]
    });
    if lines.height < 10 {
        return PickerLines {
            bars,
            comparison: line(3),
            numbers: behind(line(3), 20),
            heading: Rect::default(),
            swatches: split_top(lines, 4).1,
        };
    }
    PickerLines {
        bars,
        comparison: line(4),
        numbers: behind(line(5), 1),
        heading: line(7),
        swatches: split_top(lines, 8).1,
    }
}

/// The cells of one of the scene's colours, with the marker before it; `None` if they do not fit.
pub fn swatch_cells(swatches: Rect, index: usize) -> Option<Rect> {
    const WIDTH: u16 = 3;
    let across = usize::from(swatches.width / WIDTH);
    let row = index.checked_div(across)?;
    let x = swatches.x + WIDTH * (index % across) as u16;
    (row < usize::from(swatches.height)).then(|| Rect::new(x, swatches.y + row as u16, WIDTH, 1))
}

/// The column of a bar's marker for a number from 0 to 1.
pub fn marker_at(bar: Rect, share: f64) -> u16 {
    let last = f64::from(bar.width.saturating_sub(1));
    bar.x + (share.clamp(0.0, 1.0) * last).round() as u16
}

/// The number from 0 to 1 for a column of a bar, or the end nearest to it.
pub fn share_at(bar: Rect, column: u16) -> f64 {
    let last = bar.width.saturating_sub(1).max(1);
    f64::from(column.saturating_sub(bar.x).min(last)) / f64::from(last)
}

/// A rectangle with the width and height of `size`, centred in `area` and clipped to it.
pub fn centred(area: Rect, size: Rect) -> Rect {
    let (width, height) = (size.width.min(area.width), size.height.min(area.height));
    let x = area.x + (area.width - width) / 2;
    let y = area.y + (area.height - height) / 2;
    Rect::new(x, y, width, height)
}

/// Splits off the `lines` lines at the bottom, or fewer if the area has fewer.
pub fn split_bottom(area: Rect, lines: u16) -> (Rect, Rect) {
    split_top(area, area.height.saturating_sub(lines))
}

/// Splits off the `lines` lines at the top, or fewer if the area has fewer.
pub fn split_top(area: Rect, lines: u16) -> (Rect, Rect) {
    let upper = lines.min(area.height);
    let top = Rect::new(area.x, area.y, area.width, upper);
    let below = Rect::new(area.x, area.y + upper, area.width, area.height - upper);
    (top, below)
}

/// Divides the right of a picture's area, or its left, between a tree and the values of one of its
/// lines; in a narrow area, the lower half.
pub fn over_picture(area: Rect, side: Side) -> (Rect, Rect) {
    const WIDEST: u16 = 52;
    const VALUES: u16 = 10;
    let panel = if area.width < WIDEST {
        split_bottom(area, area.height.div_ceil(2)).1
    } else {
        let width = (area.width / 2).min(WIDEST);
        match side {
            Side::Right => split_right(area, width).1,
            Side::Left => Rect { width, ..area },
        }
    };
    split_bottom(panel, VALUES.min(panel.height / 2))
}

/// A side of the picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The left.
    Left,
    /// The right.
    Right,
}

/// Maximum width of one of three numbers, in columns.
const WIDEST_NUMBER: u16 = 12;

/// Number of lines that explain a field if there is room.
pub const NOTES: u16 = 4;
/// Minimum height of fields and notes together for all the notes to be shown.
pub const ROOMY: u16 = 12;

/// Splits off the `columns` columns on the right, or fewer if the area has fewer.
pub fn split_right(area: Rect, columns: u16) -> (Rect, Rect) {
    let width = columns.min(area.width);
    let left = Rect::new(area.x, area.y, area.width - width, area.height);
    let right = Rect::new(left.right(), area.y, width, area.height);
    (left, right)
}

fn rounded_ratio(a: u64, b: u64) -> u64 {
    (2 * a + b) / (2 * b)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A size in pixels.
    pub(crate) const fn size(width: u32, height: u32) -> Size {
        Size { width, height }
    }

    proptest! {
        #![proptest_config(repeatable::config())]

        #[test]
        fn a_raster_touches_two_sides_and_keeps_the_aspect_ratio(
            columns in 1u16..300, rows in 1u16..100, width in 1u32..100_000, height in 1u32..100_000
        ) {
            let area = Rect::new(3, 2, columns, rows);
            let (cells, pixels) = raster(area, size(width, height)).expect("there are cells");
            prop_assert_eq!(cells.intersection(area), cells);
            prop_assert_eq!(u32::from(cells.width), pixels.width);
            prop_assert_eq!(u32::from(cells.height), pixels.height.div_ceil(2));
            let (across, down) = (f64::from(columns), 2.0 * f64::from(rows));
            let aspect = f64::from(width) / f64::from(height);
            let best = (across.min(down * aspect), down.min(across / aspect));
            prop_assert!((f64::from(pixels.width) - best.0.max(1.0)).abs() <= 0.5);
            prop_assert!((f64::from(pixels.height) - best.1.max(1.0)).abs() <= 0.5);
        }

        #[test]
        fn the_selected_line_is_always_visible(
            top in 0usize..40, at in 0usize..30, count in 1usize..30, rows in 1usize..12
        ) {
            let at = at.min(count - 1);
            let first = first_shown(top, at, count, rows);
            prop_assert!(first <= at && at < first + rows);
            prop_assert_eq!(first_shown(first, at, count, rows), first);
        }
    }

    #[test]
    fn rasters_are_letterboxed() {
        let most = u32::MAX;
        for (columns, rows, output, cells, pixels) in table! {
            80, 20, size(800, 600) => Rect::new(13, 0, 53, 20), size(53, 40);
            40, 30, size(800, 600) => Rect::new(0, 7, 40, 15), size(40, 30);
            40, 20, size(1, 1000) => Rect::new(19, 0, 1, 20), size(1, 40);
            40, 20, size(1000, 1) => Rect::new(0, 9, 40, 1), size(40, 1);
            1, 1, size(most, most) => Rect::new(0, 0, 1, 1), size(1, 1);
        } {
            let found = raster(Rect::new(0, 0, columns, rows), output);
            assert_eq!(found, Some((cells, pixels)));
        }
        assert_eq!(raster(Rect::new(0, 0, 0, 9), size(4, 3)), None);
    }

    #[test]
    fn clicks_find_lines_and_components() {
        let (list, fields) = (Rect::new(45, 0, 35, 7), Rect::new(45, 7, 35, 15));
        assert_eq!(list_row_at(list, 4, list.x, list.y), None, "the title");
        assert_eq!(list_row_at(list, 4, list.x, list.y + 2), Some(5));
        let components = |field| [3, 1].get(field).copied();
        let click = |column, row| field_at((fields, true), 0, components, (column, row));
        assert_eq!(click(fields.x, fields.y + 1), Some((0, 0)), "the name");
        assert_eq!(click(fields.right() - 3, fields.y + 1), Some((0, 2)));
        assert_eq!(click(fields.right() - 3, fields.y + 2), Some((1, 0)));
        assert_eq!(click(fields.x, fields.y + 3), None, "no third field");
    }
}
