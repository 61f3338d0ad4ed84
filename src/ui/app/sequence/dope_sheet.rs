//! The places on the sheet of a track: the name of each row, and the cells of the frames.
//!
//! Everything here is arithmetic on rectangles and is valid for any size from 0×0.

use ratatui::layout::Rect;

/// The most columns of a name.
const MOST: u16 = 22;

/// The places of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct DopeSheet {
    /// The names.
    pub(crate) names: Rect,
    /// The frames: the first column is the first frame, the last column the last.
    pub(crate) frames: Rect,
    /// The number of the last frame.
    last: u32,
}

impl DopeSheet {
    /// Divides an area whose first line is a title.
    pub(crate) fn new(area: Rect, last: u32) -> Self {
        let title = area.height.min(1);
        let names = Rect {
            y: area.y + title,
            height: area.height - title,
            width: (area.width / 2).min(MOST),
            ..area
        };
        Self {
            names,
            frames: Rect {
                x: names.right(),
                width: area.width - names.width,
                ..names
            },
            last,
        }
    }

    /// The column of a frame within those of the frames.
    pub(crate) fn column(&self, frame: u32) -> u16 {
        let most = u64::from(self.frames.width.saturating_sub(1));
        let last = u64::from(self.last.max(1));
        let frame = u64::from(frame.min(self.last));
        ((frame * most + last / 2) / last) as u16
    }

    /// The frame in a column of the screen, or the nearest one.
    pub(crate) fn frame(&self, column: u16) -> u32 {
        let most = u64::from(self.frames.width.saturating_sub(1).max(1));
        let column = u64::from(column.saturating_sub(self.frames.x)).min(most);
        ((column * u64::from(self.last) + most / 2) / most) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_those_of_their_frames() {
        for (width, last) in [(0, 9), (1, 0), (20, 0), (40, 9), (42, 47), (30, 999_999)] {
            let sheet = DopeSheet::new(Rect::new(3, 2, width, 5), last);
            let Rect { x, width, .. } = sheet.frames;
            assert_eq!(sheet.names.width + width, sheet.frames.right() - 3);
            for column in x..sheet.frames.right() {
                let frame = sheet.frame(column);
                assert!(frame <= last);
                if u32::from(width) <= last {
                    assert_eq!(x + sheet.column(frame), column);
                }
            }
            if u32::from(width) > last {
                let frames = (0..=last).map(|frame| sheet.frame(x + sheet.column(frame)));
                assert!(frames.eq(0..=last), "{width} {last}");
            }
            assert!(width < 2 || last == 0 || sheet.frame(sheet.frames.right() - 1) == last);
        }
    }
}
