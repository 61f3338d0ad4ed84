//! Where the picture and the panels are: side by side, one above the other, or the picture alone.
//!
//! The shape of the picture and that of the screen decide: of the arrangements that leave the
//! panels usable, the one with the largest picture is taken, and the cells that a picture of this
//! shape cannot fill go to the panels.

#[cfg(test)]
mod tests;

use ratatui::layout::Rect;

use super::layout::{NOTES, ROOMY, raster, split_bottom, split_right, split_top};
use scene::Size;

/// Share of the screen that the picture takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Zoom {
    /// The picture with the list and the fields.
    #[default]
    Panels,
    /// Only the picture, without list and fields.
    Picture,
}

/// What the arrangement depends on besides the size of the screen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shape {
    /// Share of the screen that the picture takes.
    pub zoom: Zoom,
    /// Size of the output, whose aspect ratio the picture has.
    pub output: Size,
    /// Number of fields of the selected node: in a column, the list gets the lines that they do
    /// not need.
    pub fields: usize,
    /// Number of lines of the whole list: the fields follow where it ends.
    pub lines: usize,
    /// Whether lines below the fields explain the current one. Otherwise, where room is short, the list
    /// gets more of it.
    pub explains: bool,
    /// The sizes of the panels that the user chose.
    pub panels: PanelSizes,
}

/// Sizes of the panels chosen by the user, in cells; `None` leaves them to [`arrange`]. A size that
/// does not fit is adjusted when the screen is divided, and kept for a larger screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PanelSizes {
    /// Width of the panels beside the picture.
    pub beside: Option<u16>,
    /// Height of the panels below the picture.
    pub below: Option<u16>,
    /// Height of the list above the fields.
    pub list_height: Option<u16>,
    /// Width of the list beside the fields.
    pub list_width: Option<u16>,
}

impl PanelSizes {
    /// The sizes as text, a name and a number a line; sizes that are `None` are omitted.
    pub fn to_text(self) -> String {
        let sizes = [self.beside, self.below, self.list_height, self.list_width];
        let lines = SIZE_NAMES.iter().zip(sizes);
        lines
            .filter_map(|(name, size)| Some(format!("{name} {}\n", size?)))
            .collect()
    }

    /// The sizes in such a text; what is not understood is ignored.
    pub fn of_text(text: &str) -> Self {
        let size = |name: &str| {
            let mut lines = text.lines().filter_map(|line| line.split_once(' '));
            let (_, size) = lines.find(|(of, _)| *of == name)?;
            size.parse().ok()
        };
        let [beside, below, list_height, list_width] = SIZE_NAMES.map(size);
        Self {
            beside,
            below,
            list_height,
            list_width,
        }
    }
}

const SIZE_NAMES: [&str; 4] = ["beside", "below", "list-height", "list-width"];

/// The area of each panel; empty for a panel that does not fit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Areas {
    /// The lesson above all others; empty unless [`Areas::below`] put them there.
    pub lesson: Rect,
    /// The picture with its margins.
    pub picture: Rect,
    /// The line between columns: of the picture and the panels, or of the list and the fields.
    pub rule: Rect,
    /// The cells between picture and panels, which resize them when dragged: the rule beside the
    /// picture, the panels' title lines below it.
    pub border: Rect,
    /// The list, starting with its title line.
    pub list: Rect,
    /// The fields, starting with their title line.
    pub fields: Rect,
    /// Whether lines below the fields explain the current one.
    pub explains: bool,
    /// The errors, below the picture; empty unless [`Areas::make_room`] was called.
    pub errors: Rect,
    /// The line of key hints.
    pub hint: Rect,
    /// The status line at the bottom.
    pub status: Rect,
}

/// Minimum size, in cells, for all panels with room for their text.
const FULL: (u16, u16) = (80, 24);
/// Minimum size for panels at all, and for a line of hints.
const STACKED: (u16, u16) = (40, 16);
/// Minimum size for anything other than a notice.
pub const MIN_SIZE: (u16, u16) = (20, 6);

/// Width of panels beside the picture if every cell of it would enlarge the picture; narrower ones
/// would cut numbers of six characters.
const SNUG: u16 = 32;
/// Minimum width of the list, and of all panels that the user narrows.
const NARROW: u16 = 26;
/// Width up to which panels take columns that the picture cannot use.
const WIDE: u16 = 60;
/// Minimum width of a picture beside panels.
const PICTURE: u16 = 20;
/// Height of a title, eight fields and two lines of notes.
const LOW: u16 = 11;
/// Minimum height of panels below the picture.
const LOWEST: u16 = 7;
/// Minimum height of a list above fields.
const LIST: u16 = 4;
/// Height of a list with ten lines, which it gets before the fields' last lines.
const LONG: u16 = 11;
/// Height of a short list, over which menus and the colour picker have room.
const MENU: u16 = 16;
/// Width of a screen from which panels beside the picture are snug rather than narrow.
const ROOMY_WIDTH: u16 = 72;

/// An arrangement of picture and panels, with the width or height of the panels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Arrangement {
    Beside(u16),
    Below(u16),
}

/// What is above the picture and the panels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Above {
    /// Nothing.
    #[default]
    Nothing,
    /// A lesson.
    Lesson,
}

impl Above {
    /// Its place, and the screen below it: four lines where the panels keep their room, otherwise two or
    /// none.
    pub fn split(self, area: Rect) -> (Rect, Rect) {
        let lines = match (self, area.height) {
            (Self::Nothing, _) | (_, 0..12) => 0,
            (_, 12..20) => 2,
            _ => 4,
        };
        split_top(area, lines)
    }
}

/// Divides the screen. All areas lie inside `area` and are disjoint, except for the border; below
/// [`MIN_SIZE`] all are empty.
pub fn arrange(area: Rect, shape: &Shape) -> Areas {
    let fits = |(width, height)| width <= area.width && height <= area.height;
    if !fits(MIN_SIZE) {
        return Areas::default();
    }
    let (rest, status) = split_bottom(area, 1);
    let (body, hint) = split_bottom(rest, u16::from(fits(STACKED)));
    let bars = Areas {
        picture: body,
        hint,
        status,
        explains: shape.explains,
        ..Areas::default()
    };
    if shape.zoom == Zoom::Picture || !fits(STACKED) {
        return bars;
    }
    let low = if fits(FULL) || STACKED.1 + 8 <= body.height {
        LOW
    } else {
        (body.height / 2).clamp(LOWEST, LOW)
    };
    match chosen(body, shape, low) {
        Arrangement::Beside(width) => side_by_side(bars, width, shape),
        Arrangement::Below(height) => stacked(bars, height, shape),
    }
}

/// Moves the border between picture and panels by some cells, towards the picture if positive.
/// Returns the panels' new sizes; `None` if there is no border.
pub fn resized(areas: &Areas, shape: &Shape, cells: i32) -> Option<PanelSizes> {
    let moved = |size: u16| size.saturating_add_signed(cells.clamp(-999, 999) as i16);
    let mut panels = shape.panels;
    if areas.list.is_empty() {
        return None;
    }
    if is_beside(areas) {
        panels.beside = Some(moved(areas.list.width));
    } else {
        let height = areas.fields.bottom() - areas.list.y;
        panels.below = Some(moved(height));
    }
    Some(panels)
}

/// Moves the border between list and fields by some cells, towards the fields if positive. Returns
/// the panels' new sizes; `None` if there is no such border.
pub fn divided(areas: &Areas, shape: &Shape, cells: i32) -> Option<PanelSizes> {
    let moved = |size: u16| size.saturating_add_signed(cells.clamp(-999, 999) as i16);
    let mut panels = shape.panels;
    if areas.list.is_empty() || areas.fields.is_empty() {
        return None;
    }
    if areas.is_column() {
        panels.list_height = Some(moved(areas.list.height));
    } else {
        panels.list_width = Some(moved(areas.list.width));
    }
    Some(panels)
}

/// Whether the panels are beside the picture.
fn is_beside(areas: &Areas) -> bool {
    areas.list.y == areas.picture.y
}

impl Areas {
    /// Where the border must be to be under a cell, as cells towards the picture.
    pub fn dragged(&self, (column, row): (u16, u16)) -> i32 {
        if is_beside(self) {
            i32::from(self.border.x) - i32::from(column)
        } else {
            i32::from(self.border.y) - i32::from(row)
        }
    }

    /// The cells between list and fields, which resize these when dragged: the fields' title line
    /// below the list, the rule beside it.
    pub fn divider(&self) -> Rect {
        if self.list.is_empty() {
            Rect::default()
        } else if self.is_column() {
            split_bottom(self.fields, self.fields.height.saturating_sub(1)).0
        } else {
            self.rule
        }
    }

    /// Where the divider must be to be under a cell, as cells towards the fields.
    pub fn divided_at(&self, (column, row): (u16, u16)) -> i32 {
        if self.is_column() {
            i32::from(row) - i32::from(self.fields.y)
        } else {
            i32::from(column) - i32::from(self.rule.x)
        }
    }

    /// Whether the list is above the fields.
    fn is_column(&self) -> bool {
        self.list.y < self.fields.y
    }

    /// The lines that errors may take below the picture, of which it keeps at least half.
    pub fn room_for_errors(&self) -> Rect {
        let lines = (self.picture.height / 2).clamp(5, 12);
        split_bottom(self.picture, lines).1
    }

    /// Puts a lesson above the areas, which were arranged without its lines.
    #[must_use]
    pub fn below(self, lesson: Rect) -> Self {
        Self { lesson, ..self }
    }

    /// Gives lines below the picture to the errors.
    #[must_use]
    pub fn make_room(self, lines: u16) -> Self {
        let (picture, errors) = split_bottom(self.picture, lines);
        Self {
            picture,
            errors,
            ..self
        }
    }
}

/// The arrangement with the largest picture, in the sizes that the user chose if any. Panels below the
/// picture have at least `low` lines, unless the user wants less.
fn chosen(body: Rect, shape: &Shape, low: u16) -> Arrangement {
    let beside = beside(body, shape);
    let below = Arrangement::Below(below(body, shape, low));
    let cells = |arrangement: Arrangement| {
        let picture = match arrangement {
            Arrangement::Beside(width) => split_right(body, width + 1).0,
            Arrangement::Below(height) => split_bottom(body, height).0,
        };
        raster(picture, shape.output).map_or(0, |(cells, _)| cells.area())
    };
    let best = match beside.map(Arrangement::Beside) {
        Some(beside) if cells(below) <= cells(beside) => beside,
        _ => below,
    };
    match best {
        Arrangement::Beside(width) => {
            let width = shape.panels.beside.unwrap_or(width);
            let most = (body.width - PICTURE - 1).max(NARROW);
            Arrangement::Beside(width.clamp(NARROW, most))
        }
        Arrangement::Below(height) => {
            let height = shape.panels.below.unwrap_or(height);
            let most = body.height.saturating_sub(5).max(LOWEST);
            Arrangement::Below(height.clamp(LOWEST, most))
        }
    }
}

/// The width of panels beside the picture; `None` if they do not fit there.
fn beside(body: Rect, shape: &Shape) -> Option<u16> {
    let is_roomy = LOW + LIST + 2 <= body.height && PICTURE + 1 + SNUG <= body.width;
    if !is_roomy {
        return None;
    }
    let least = if body.width < ROOMY_WIDTH {
        NARROW
    } else {
        SNUG
    };
    let (largest, _) = raster(split_right(body, least + 1).0, shape.output)?;
    Some((body.width - 1 - largest.width).clamp(least, WIDE))
}

/// The height of panels below the picture: the lines that a picture as wide as the screen leaves.
fn below(body: Rect, shape: &Shape, low: u16) -> u16 {
    let upper = split_bottom(body, low).0;
    let largest = raster(upper, shape.output).map_or(0, |(cells, _)| cells.height);
    body.height - largest
}

/// Places the picture on the left, and the list above the fields on the right.
fn side_by_side(bars: Areas, width: u16, shape: &Shape) -> Areas {
    let (left, panels) = split_right(bars.picture, width);
    let (picture, rule) = split_right(left, 1);
    let is_low = panels.height < LONG + LOW - 3;
    let (list, fields) = if is_low && !shape.explains && shape.panels.list_height.is_none() {
        // There is room for one of them.
        (panels, Rect::default())
    } else {
        column(panels, shape)
    };
    Areas {
        picture,
        rule,
        border: rule,
        list,
        fields,
        ..bars
    }
}

/// Places the picture above the panels, which are side by side if they are wide enough.
fn stacked(bars: Areas, height: u16, shape: &Shape) -> Areas {
    let (picture, panels) = split_bottom(bars.picture, height);
    let (border, _) = split_bottom(panels, panels.height.saturating_sub(1));
    let is_tall = 1 + LIST + LOW <= panels.height;
    let (list, rule, fields) = if panels.width < NARROW + 1 + SNUG && is_tall {
        let (list, fields) = column(panels, shape);
        (list, Rect::default(), fields)
    } else {
        let most = panels.width.saturating_sub(NARROW + 1).max(24);
        let width = match shape.panels.list_width {
            Some(list) => panels.width.saturating_sub(list.saturating_add(1)),
            None => panels.width * 6 / 10,
        };
        let (list, fields) = split_right(panels, width.clamp(24, most));
        let (list, rule) = split_right(list, 1);
        (list, rule, fields)
    };
    Areas {
        picture,
        rule,
        border,
        list,
        fields,
        ..bars
    }
}

/// Divides a column of panels: the list above the fields.
fn column(panels: Rect, shape: &Shape) -> (Rect, Rect) {
    // Small field counts share one height, so that the list seldom moves with the cursor.
    let fields = u16::try_from(shape.fields).unwrap_or(u16::MAX);
    let wanted = fields.saturating_add(1 + NOTES).max(1 + ROOMY);
    let most = (panels.height * 2 / 3).max(15);
    let most = most.min(panels.height.saturating_sub(1 + LIST));
    let height = if let Some(list) = shape.panels.list_height {
        let lowest = LOWEST.min(panels.height.saturating_sub(LIST));
        let list = list.clamp(LIST, (panels.height - lowest).max(LIST));
        panels.height.saturating_sub(list)
    } else {
        let mut height = wanted.min(most);
        if !shape.explains && panels.height.saturating_sub(height) < LONG {
            let least = fields.saturating_add(1).min(LOWEST);
            height = panels.height.saturating_sub(LONG).max(least).min(height);
        }
        // Below the end of a short list nothing is left empty.
        let list = u16::try_from(shape.lines).unwrap_or(u16::MAX);
        let list = list.saturating_add(1).max(MENU);
        height.max(panels.height.saturating_sub(list))
    };
    split_bottom(panels, height)
}
