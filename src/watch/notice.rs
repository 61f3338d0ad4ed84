//! What the watching thread receives and reports.

use notify::Event;

/// What a watcher reports.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Notice {
    /// A file may have changed.
    Changed,
    /// The system cannot notify of all changes, for this reason, and the files are polled; `None`: it
    /// can again.
    Polled(Option<String>),
}

/// A message to the watching thread.
pub(super) enum WatchMessage {
    System(notify::Result<Event>),
    Stop,
}
