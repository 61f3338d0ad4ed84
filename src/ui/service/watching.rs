//! Watchers of files, whose notices become messages.

use std::path::PathBuf;

use crate::msg::{Msg, Polled};
use watch::{Method, Notice, Watcher};

/// Watches some files at a time. Messages are sent from the watcher's thread too.
pub(super) struct Watching<S> {
    what: Polled,
    method: Method,
    send: S,
    /// The files that are watched.
    pub(super) paths: Vec<PathBuf>,
    /// Stops watching when dropped.
    watcher: Option<Watcher>,
}

impl<S: Fn(Msg) + Clone + Send + 'static> Watching<S> {
    /// Watches nothing yet.
    pub(super) fn new(what: Polled, method: Method, send: S) -> Self {
        Self {
            what,
            method,
            send,
            paths: Vec::new(),
            watcher: None,
        }
    }

    /// Watches these files from now on, instead of those before. Returns whether they are watched; if
    /// not, says why.
    pub(super) fn watch(&mut self, paths: Vec<PathBuf>) -> bool {
        let what = self.what;
        self.paths.clear();
        // The old watcher ends first, so that its notices are not taken for those of the new files.
        if self.watcher.take().is_some() {
            (self.send)(Msg::Polled(what, None));
        }
        if paths.is_empty() {
            return true;
        }
        let send = self.send.clone();
        let notify = move |notice| {
            send(match notice {
                Notice::Changed => what.changed(),
                Notice::Polled(reason) => Msg::Polled(what, reason),
            });
        };
        match Watcher::new(&paths, self.method, notify) {
            Ok(watcher) => {
                self.watcher = Some(watcher);
                self.paths = paths;
                true
            }
            Err(error) => {
                let reason = match (what, &paths[0]) {
                    (Polled::Assets, _) => "cannot watch the scene's files for changes".to_owned(),
                    (_, path) => format!("{}: cannot watch for changes", path.display()),
                };
                (self.send)(Msg::Failed(format!("{reason}: {error}")));
                false
            }
        }
    }
}

impl Polled {
    /// What to report if the files may have changed.
    fn changed(self) -> Msg {
        match self {
            Self::Scene => Msg::FileChanged,
            Self::Assets => Msg::AssetsChanged,
            Self::Track => Msg::TrackChanged,
        }
    }
}
