//! The edges of objects in a cell as one of the lines that every font has.

use super::cell::index;
use crate::app::CellImage;

/// A line through a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Line {
    Middle,
    Bottom,
    Upright,
    Rising,
    Falling,
}

impl Line {
    pub(super) fn symbol(self) -> &'static str {
        match self {
            Self::Middle => "-",
            Self::Bottom => "_",
            Self::Upright => "|",
            Self::Rising => "/",
            Self::Falling => "\\",
        }
    }
}

/// The least length of an edge, in sides of pixels: less is the corner of an edge in a cell beside.
const SHORTEST: f32 = 1.4;

/// What an edge is made of: the sides between pixels that differ, with the weight of each.
#[derive(Debug, Default)]
struct Sides {
    /// The weights of sides between neighbours in a row, and in a column.
    across: f32,
    down: f32,
    /// Sums of the places of their centres, from the top left corner of the cell, and of products.
    x: f32,
    y: f32,
    xx: f32,
    yy: f32,
    xy: f32,
}

impl Sides {
    fn add(&mut self, [x, y]: [f32; 2], weight: f32) {
        self.x += weight * x;
        self.y += weight * y;
        self.xx += weight * x * x;
        self.yy += weight * y * y;
        self.xy += weight * x * y;
    }

    /// The line that comes closest to them.
    fn line(&self) -> Option<Line> {
        let (across, down) = (self.across, self.down);
        let length = across + down;
        if length < SHORTEST {
            return None;
        }
        let (x, y) = (self.x / length, self.y / length);
        let spread = |sum: f32, one: f32, other: f32| sum - one * other * length;
        let (xx, yy) = (spread(self.xx, x, x), spread(self.yy, y, y));
        let xy = spread(self.xy, x, y);
        let is_level = across == 0.0 || 2.0 * across < down && yy < 0.3 * length;
        // Below this, the sides do not lean to either side.
        let upright = 0.12 * (xx * yy).max(0.0).sqrt().max(0.3);
        Some(if is_level {
            if 3.0 <= y { Line::Bottom } else { Line::Middle }
        } else if 5.0 * down <= across || xy.abs() < upright && down < across {
            Line::Upright
        } else if xy.abs() < upright {
            Line::Middle
        } else if 0.0 < xy {
            Line::Falling
        } else {
            Line::Rising
        })
    }
}

/// The line of the edges in the cell at a place, if there are any. An edge between two cells belongs
/// to the left or upper one.
pub(super) fn line(shown: &CellImage, (column, row): (u16, u16)) -> Option<Line> {
    let (left, top) = (2 * u32::from(column), 4 * u32::from(row));
    let mut sides = Sides::default();
    for at in 0..8 {
        let (x, y) = (at % 2, at / 2);
        let pixel = |x: u32, y: u32| index(shown, left + x, top + y);
        let Some(here) = pixel(x, y) else {
            continue;
        };
        let weight = |other: Option<usize>| other.map_or(0.0, |other| edge(shown, here, other));
        let (right, below) = (weight(pixel(x + 1, y)), weight(pixel(x, y + 1)));
        let (x, y) = (x as f32, y as f32);
        sides.across += right;
        sides.add([x + 1.0, y + 0.5], right);
        sides.down += below;
        sides.add([x + 0.5, y + 1.0], below);
    }
    sides.line()
}

/// How much of an edge is between two pixels, from 0 to 1.
fn edge(shown: &CellImage, one: usize, other: usize) -> f32 {
    let object = |at: usize| shown.objects.get(at);
    if object(one) == object(other) {
        0.0
    } else {
        1.0
    }
}
