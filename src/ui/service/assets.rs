//! The thread that reads and watches the files that a scene names: pictures and meshes.

use std::io;
use std::path::PathBuf;

use super::answering::Answering;
use super::watching::Watching;
use crate::msg::{Msg, Polled};
use assets::{Assets, Wanted};
use watch::Method;

/// Starts the thread. `send` is called on it and on the watcher's thread. Nothing waits for its end, as it
/// has no work that could be lost.
pub(crate) fn assets(
    folders: &[PathBuf],
    method: Method,
    send: impl Fn(Msg) + Clone + Send + 'static,
) -> io::Result<Answering<Wanted>> {
    let mut thread = AssetThread {
        assets: Assets::new(folders),
        watching: Watching::new(Polled::Assets, method, send.clone()),
        send,
    };
    Answering::latest("assets", "reads the scene's files", move |wanted| {
        thread.answer(&wanted);
    })
}

/// State of the thread.
struct AssetThread<S> {
    assets: Assets,
    watching: Watching<S>,
    send: S,
}

impl<S: Fn(Msg) + Clone + Send + 'static> AssetThread<S> {
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
        places != self.watching.paths && self.watching.watch(places)
    }
}

#[cfg(test)]
mod tests;
