//! The thread that reads the files that a scene names, pictures and meshes, and has them watched.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use super::msg::Msg;
use crate::assets::{Assets, Wanted};
use crate::watch::{Method, Watcher};

/// The thread's handle. Its end is not waited for: nothing is lost with it.
pub(super) struct AssetReader {
    orders: Sender<Wanted>,
}

impl AssetReader {
    /// Starts the thread; `send` is called on it, and on that of the watcher.
    pub(super) fn start(
        folders: &[PathBuf],
        method: Method,
        send: impl Fn(Msg) + Send + Sync + 'static,
    ) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel();
        let work = Work {
            assets: Assets::new(folders),
            method,
            watched: Vec::new(),
            watcher: None,
            send: Arc::new(send),
        };
        thread::Builder::new()
            .name("assets".to_owned())
            .spawn(move || work.follow(&inbox))?;
        Ok(Self { orders })
    }

    /// Has files read; of several orders that wait, only the last one is carried out.
    pub(super) fn order(&self, wanted: Wanted) -> Result<(), String> {
        let sent = self.orders.send(wanted);
        sent.map_err(|_| "the thread that reads the scene's files has ended".to_owned())
    }
}

/// What the thread has.
struct Work<S> {
    assets: Assets,
    method: Method,
    /// What `watcher` watches.
    watched: Vec<PathBuf>,
    /// Its end is that of the watch.
    watcher: Option<Watcher>,
    send: Arc<S>,
}

impl<S: Fn(Msg) + Send + Sync + 'static> Work<S> {
    fn follow(mut self, inbox: &Receiver<Wanted>) {
        while let Ok(first) = inbox.recv() {
            let wanted = inbox.try_iter().last().unwrap_or(first);
            self.watch(&wanted);
            self.read(&wanted);
            // Now it is known which libraries of materials the meshes name. They are read again,
            // for what changed before they were watched.
            if self.watch(&wanted) {
                self.read(&wanted);
            }
        }
    }

    fn read(&mut self, wanted: &Wanted) {
        let loaded = self.assets.read(wanted);
        (self.send)(Msg::AssetsRead(wanted.clone(), loaded));
    }

    /// Watches the files that matter: what changes from here on is noticed. Whether they are others
    /// than before, which it is not where they can't be watched: the next order tries again.
    fn watch(&mut self, wanted: &Wanted) -> bool {
        let places = self.assets.places(wanted);
        if places == self.watched {
            return false;
        }
        drop(self.watcher.take());
        self.watched.clear();
        if !places.is_empty() {
            let send = Arc::clone(&self.send);
            match Watcher::new(&places, self.method, move || send(Msg::AssetsChanged)) {
                Ok(watcher) => self.watcher = Some(watcher),
                Err(error) => {
                    (self.send)(Msg::Failed(format!(
                        "changes of the scene's files go unnoticed: {error}; try --poll"
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
