//! The places on the page of the undo history: a list of steps with small pictures, and the picture
//! of the selected one beside it.
//!
//! Everything here is arithmetic on rectangles and is valid for any size from 0×0.

use ratatui::layout::{Margin, Rect};

use super::layout::{first_shown, split_bottom, split_right};

/// Lines and columns of the smallest list that has pictures.
const LEAST: (u16, u16) = (40, 8);

/// Columns of the smallest page with a large picture.
const LEAST_WITH_LARGE: u16 = 64;

/// Columns of the list beside a large picture.
const LIST: u16 = 44;

/// Lines of a list from which the pictures in it are larger.
const TALL: u16 = 35;

/// The places on the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct HistoryLayout {
    /// All rows that are shown.
    pub list: Rect,
    /// Lines of a row, of which the last one separates pictures.
    pub height: u16,
    /// Columns and lines of the picture in a row; `None` without pictures.
    pub thumbnail: Option<(u16, u16)>,
    /// The large picture, if there is room for it.
    pub large: Option<Rect>,
    /// The lines for hints below.
    pub foot: Rect,
}

impl HistoryLayout {
    /// Divides a page, inside its frame.
    pub fn with_pictures(page: Rect) -> Self {
        let plain = Self::with_names(page);
        let body = plain.list;
        if body.width < LEAST.0 || body.height < LEAST.1 {
            return plain;
        }
        let thumbnail = if body.height < TALL { (11, 4) } else { (16, 6) };
        let has_large = LEAST_WITH_LARGE <= body.width;
        let (beside, large) = split_right(body, body.width.saturating_sub(LIST + 1));
        let (beside, _) = split_right(beside, 1);
        Self {
            list: if has_large { beside } else { body },
            height: thumbnail.1 + 1,
            thumbnail: Some(thumbnail),
            large: has_large.then_some(large),
            ..plain
        }
    }

    /// Divides a page of names alone, inside its frame.
    pub fn with_names(page: Rect) -> Self {
        let (list, foot) = split_bottom(page.inner(Margin::new(1, 1)), 2);
        Self {
            list,
            height: 1,
            thumbnail: None,
            large: None,
            foot,
        }
    }

    /// The rows that are shown of `count`, so that row `at` is among them, each with its place.
    pub fn rows(&self, at: usize, count: usize) -> impl Iterator<Item = (usize, Rect)> + use<> {
        let (list, height) = (self.list, self.height.max(1));
        let shown = usize::from(list.height / height);
        let top = first_shown(0, at, count, shown);
        let rows = (top..count).zip(0..shown as u16);
        rows.map(move |(row, at)| {
            let y = list.y + at * height;
            (row, Rect { y, height, ..list })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_need_room_and_rows_stay_on_the_page() {
        for (size, height, has_thumbnails, has_large) in [
            ((80, 22), 5, true, true),
            ((120, 40), 7, true, true),
            ((60, 22), 5, true, false),
            ((80, 10), 1, false, false),
            ((40, 22), 1, false, false),
            ((1, 1), 1, false, false),
            ((0, 0), 1, false, false),
        ] {
            let page = Rect::new(3, 2, size.0, size.1);
            let strip = HistoryLayout::with_pictures(page);
            let has = [strip.thumbnail.is_some(), strip.large.is_some()];
            assert_eq!(strip.height, height, "{size:?}");
            assert_eq!(has, [has_thumbnails, has_large], "{size:?}");
            for place in [strip.list, strip.large.unwrap_or_default(), strip.foot] {
                let is_inside = place.is_empty() || place.intersection(page) == place;
                assert!(is_inside, "{size:?}: {place:?}");
            }
            for at in [0, 3, 8] {
                let rows: Vec<_> = strip.rows(at, 9).collect();
                let is_listed = |row: &Rect| row.intersection(strip.list) == *row;
                assert!(rows.iter().all(|(_, row)| is_listed(row)));
                let is_shown = rows.iter().any(|(row, _)| *row == at);
                assert_eq!(is_shown, strip.height <= strip.list.height, "{size:?} {at}");
            }
        }
    }
}
