//! The undo history as a page: its steps, and jumping to any.

use ratatui::layout::Rect;

use super::Shared;
use super::page::{List, Page};
use super::steps::Steps;
use crate::ui::history_layout::HistoryLayout;
use crate::ui::layout::split_bottom;

/// Objects and bytes of text beyond which only the selected step has a picture: each one takes a
/// second or more to derive.
const MOST_OBJECTS: usize = 200_000;
const MOST_BYTES: usize = 16 << 20;

impl Shared {
    /// Opens the page of the undo history at the present text.
    pub(super) fn list_steps(&mut self) {
        self.document.end_step();
        let steps = Steps::of(&self.document);
        if steps.rows.len() < 2 {
            self.overlays.say("nothing has been changed yet");
            return;
        }
        let present = steps.present;
        let mut page = Page::new(List::Steps(steps));
        page.filter.at = present;
        self.overlays.page = Some(page);
    }

    /// Goes to a text of the history by undo or redo; every step in between can be redone or undone
    /// as ever.
    pub(super) fn go_to_state(&mut self, at: usize) {
        let present = self.document.present();
        let steps = present.abs_diff(at);
        if steps == 0 {
            self.overlays.say("this is the present text");
            return;
        }
        let is_back = at < present;
        for _ in 1..steps {
            if is_back {
                self.undo_text();
            } else {
                self.redo_text();
            }
        }
        if 1 < steps {
            self.relower();
        }
        let done = if is_back {
            self.step_back()
        } else {
            self.step_forward()
        };
        let done = if steps == 1 {
            done
        } else {
            let verb = if is_back { "undone" } else { "redone" };
            let name = Steps::of(&self.document).rows.into_iter().nth(at);
            name.map(|(_, name)| format!("{steps} steps {verb}, to: {name}"))
        };
        self.overlays.say(done.unwrap_or_default());
    }

    /// The places on the page of the history in an area above the status line.
    pub fn history_layout(&self, body: Rect) -> HistoryLayout {
        if self.has_colours {
            HistoryLayout::with_pictures(body)
        } else {
            HistoryLayout::with_names(body)
        }
    }

    /// The rows that Page Down moves on the page of the history.
    pub(super) fn step_rows(&self) -> isize {
        let strip = self.history_layout(self.body());
        (strip.list.height / strip.height) as isize
    }

    /// The area above the status line.
    pub(super) fn body(&self) -> Rect {
        let (columns, lines) = self.terminal;
        let areas = self.areas();
        let bars = areas.hint.height + areas.status.height;
        split_bottom(Rect::new(0, 0, columns, lines), bars).0
    }

    /// The page of the history, if it is open.
    pub fn open_steps(&self) -> Option<(&Page, &Steps)> {
        let page = self.overlays.page.as_ref()?;
        match &page.list {
            List::Steps(steps) => Some((page, steps)),
            List::Views(..) | List::Recent(_) => None,
        }
    }

    /// Whether the scene is too large for many pictures.
    pub fn is_large(&self) -> bool {
        let objects = self.scene.as_ref().map_or(0, |scene| scene.objects.len());
        MOST_OBJECTS < objects || MOST_BYTES < self.document.text().len()
    }
}
