//! Files that are polled, because the system cannot notify of their changes.

use crate::app::Shared;
use crate::app::shared::messages::About;
use crate::msg::Polled;
use text::Severity;

/// Whether files are polled although the system was to notify of changes.
pub(crate) fn polls(shared: &Shared) -> bool {
    !shared.polled.is_empty()
}

/// Records why files are polled from now on, or that they no longer are.
pub(crate) fn polled(shared: &mut Shared, what: Polled, reason: Option<String>) {
    if let Some(reason) = reason {
        shared.polled.insert(what, reason);
        complain_of_polling(shared);
    } else {
        shared.polled.remove(&what);
        shared.overlays.end_complaint(About::Polling(what));
    }
}

/// Says why files are polled.
pub(super) fn complain_of_polling(shared: &mut Shared) {
    for (what, reason) in shared.polled.clone() {
        let files = match what {
            Polled::Scene => shared.disk.name(),
            Polled::Assets => "the scene's files".to_owned(),
            Polled::Track => "the track".to_owned(),
        };
        let words = format!("{reason}: polling {files} instead");
        shared
            .overlays
            .complain(About::Polling(what), Severity::Warning, &words);
    }
}
