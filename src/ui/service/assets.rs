//! The thread that reads and watches the files that a scene names: pictures and meshes.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use super::answering::Answering;
use crate::assets::{Assets, Wanted};
use crate::file;
use crate::ui::msg::{Msg, Polled};
use crate::watch::{Method, Notice, Watcher};

/// Starts the thread. `send` is called on it and on the watcher's thread. Nothing waits for its end, as it
/// has no work that could be lost.
pub(crate) fn assets(
    folders: &[PathBuf],
    method: Method,
    send: impl Fn(Msg) + Send + Sync + 'static,
) -> io::Result<Answering<Wanted>> {
    let mut thread = AssetThread {
        assets: Assets::new(folders),
        method,
        watched: Vec::new(),
        watcher: None,
        send: Arc::new(send),
    };
    Answering::latest("assets", "reads the scene's files", move |wanted| {
        thread.answer(&wanted);
    })
}

/// State of the thread.
struct AssetThread<S> {
    assets: Assets,
    method: Method,
    /// The files that `watcher` watches.
    watched: Vec<PathBuf>,
    /// Stops watching when dropped.
    watcher: Option<Watcher>,
    send: Arc<S>,
}

impl<S: Fn(Msg) + Send + Sync + 'static> AssetThread<S> {
    fn answer(&mut self, wanted: &Wanted) {
        file::regain_folder();
        self.watch(wanted);
        self.read(wanted);
        // Reading has revealed the material libraries of the meshes. They are read again, because they
        // may have changed before they were watched.
        if self.watch(wanted) {
            self.read(wanted);
        }
    }

    fn read(&mut self, wanted: &Wanted) {
        let loaded = self.assets.read(wanted);
        (self.send)(Msg::AssetsRead(wanted.clone(), loaded));
    }

    /// Watches the files of the scene from now on. Returns whether the set of files changed; always
    /// `false` if they cannot be watched, so that the next request tries again.
    fn watch(&mut self, wanted: &Wanted) -> bool {
        let places = self.assets.places(wanted);
        if places == self.watched {
            return false;
        }
        if self.watcher.take().is_some() {
            (self.send)(Msg::Polled(Polled::Assets, None));
        }
        self.watched.clear();
        if !places.is_empty() {
            let send = Arc::clone(&self.send);
            let notify = move |notice| {
                send(match notice {
                    Notice::Changed => Msg::AssetsChanged,
                    Notice::Polled(reason) => Msg::Polled(Polled::Assets, reason),
                });
            };
            match Watcher::new(&places, self.method, notify) {
                Ok(watcher) => self.watcher = Some(watcher),
                Err(error) => {
                    (self.send)(Msg::Failed(format!(
                        "cannot watch the scene's files for changes: {error}"
                    )));
                    return false;
                }
            }
        }
        self.watched = places;
        true
    }
}

#[cfg(all(test, unix))]
mod tests;
