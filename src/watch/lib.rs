//! Notifies when one of several files may have changed on disk. Independent of their content.
//!
//! Editors save in many ways: in place, by moving the old file away, by renaming a new one over
//! it. A watch on the file itself is lost with the old file, so directories are watched and notices
//! filtered by name. Folders and links on the path come and go likewise: every directory that the
//! system visits to find the file is watched, starting at the root. Where the system has no more
//! watches, the files are polled until it has.

mod names;
mod notice;
mod polling;
mod system;
#[cfg(test)]
mod tests;

use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{self, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use notify::RecommendedWatcher;

pub use notice::Notice;
use notice::WatchMessage;
use polling::{fingerprints, poll};
use system::WatchedPaths;

/// Watches paths until dropped.
#[derive(Debug)]
pub struct Watcher {
    inbox: Sender<WatchMessage>,
    thread: Option<JoinHandle<()>>,
}

/// How changes are detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By notifications of the system; while that has too few watches, by comparing contents.
    Native,
    /// By comparing contents at this interval, for network file systems without notifications.
    Poll(Duration),
}

impl Watcher {
    /// Calls `notify` from another thread whenever a file at one of `paths` may have changed: the
    /// name itself or the target of a symbolic link. The caller finds out which, and how, by
    /// comparing contents. Reading a file is not a change.
    ///
    /// All changes after this returns are noticed; there may be more notices than changes. Folders
    /// and links on the way to a path need not exist, and may be replaced.
    ///
    /// # Errors
    ///
    /// Fails if there can be no thread.
    pub fn new(
        paths: &[PathBuf],
        method: Method,
        notify: impl Fn(Notice) + Send + 'static,
    ) -> io::Result<Self> {
        let paths = paths.to_vec();
        let (inbox, notices) = mpsc::channel();
        let builder = thread::Builder::new().name("watch".to_owned());
        let thread = match method {
            Method::Native => {
                // The watcher of the system panics if it cannot start its thread: this one ends at once, and
                // leaves its stack to that.
                thread::Builder::new()
                    .spawn(|| {})?
                    .join()
                    .unwrap_or_default();
                let mut places = WatchedPaths::<RecommendedWatcher>::new(paths, inbox.clone());
                builder.spawn(move || places.follow(&notices, notify))?
            }
            Method::Poll(interval) => {
                let first = fingerprints(&paths);
                builder.spawn(move || poll(&paths, first, interval, &notices, notify))?
            }
        };
        Ok(Self {
            inbox,
            thread: Some(thread),
        })
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        // An error of either call means that the thread has ended already.
        let _ = self.inbox.send(WatchMessage::Stop);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}
