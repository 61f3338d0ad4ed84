//! Files that are polled, because the system cannot notify of their changes.

use super::Shared;
use super::messages::About;
use crate::text::Severity;
use crate::ui::msg::Polled;

impl Shared {
    /// Whether files are polled although the system was to notify of changes.
    pub fn polls(&self) -> bool {
        !self.polled.is_empty()
    }

    /// Records why files are polled from now on, or that they no longer are.
    pub(super) fn polled(&mut self, what: Polled, reason: Option<String>) {
        if let Some(reason) = reason {
            self.polled.insert(what, reason);
            self.complain_of_polling();
        } else {
            self.polled.remove(&what);
            self.overlays.end_complaint(About::Polling(what));
        }
    }

    /// Says why files are polled.
    pub(super) fn complain_of_polling(&mut self) {
        for (what, reason) in self.polled.clone() {
            let files = match what {
                Polled::Scene => self.disk.name(),
                Polled::Assets => "the scene's files".to_owned(),
                Polled::Track => "the track".to_owned(),
            };
            let words = format!("{reason}: polling {files} instead");
            self.overlays
                .complain(About::Polling(what), Severity::Warning, &words);
        }
    }
}
