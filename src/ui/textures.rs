//! The thread that reads the picture files of a scene's textures, and has them watched.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use super::msg::Msg;
use crate::assets::{Assets, Wanted};
use crate::watch::{Method, Watcher};

/// The thread's handle. Its end is not waited for: nothing is lost with it.
pub(super) struct Textures {
    orders: Sender<Wanted>,
}

impl Textures {
    /// Starts the thread; `send` is called on it, and on that of the watcher.
    pub(super) fn start(
        folders: &[PathBuf],
        method: Method,
        send: impl Fn(Msg) + Send + Sync + 'static,
    ) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel();
        let assets = Assets::new(folders);
        let send = Arc::new(send);
        thread::Builder::new()
            .name("textures".to_owned())
            .spawn(move || work(&inbox, assets, method, &send))?;
        Ok(Self { orders })
    }

    /// Has pictures read; of several orders that wait, only the last one is carried out.
    pub(super) fn order(&self, wanted: Wanted) -> Result<(), String> {
        let sent = self.orders.send(wanted);
        sent.map_err(|_| "the thread that reads textures has ended".to_owned())
    }
}

fn work<S: Fn(Msg) + Send + Sync + 'static>(
    inbox: &Receiver<Wanted>,
    mut assets: Assets,
    method: Method,
    send: &Arc<S>,
) {
    let mut watched = Vec::new();
    // Kept for its end, which is that of the watch.
    let mut _watcher = None;
    while let Ok(first) = inbox.recv() {
        let wanted = inbox.try_iter().last().unwrap_or(first);
        let places = assets.places(&wanted);
        if places != watched {
            // Before the reading: what changes after it is noticed.
            _watcher = None;
            match watch(&places, method, send) {
                Ok(watcher) => _watcher = watcher,
                Err(reason) => send(Msg::Failed(reason)),
            }
            watched = places;
        }
        let loaded = assets.read(&wanted);
        send(Msg::Textures(wanted, loaded));
    }
}

fn watch<S: Fn(Msg) + Send + Sync + 'static>(
    places: &[PathBuf],
    method: Method,
    send: &Arc<S>,
) -> Result<Option<Watcher>, String> {
    if places.is_empty() {
        return Ok(None);
    }
    let send = Arc::clone(send);
    let watcher = Watcher::new(places, method, move || send(Msg::TexturesChanged));
    watcher.map(Some).map_err(|error| {
        format!("changes of the scene's textures go unnoticed: {error}; try --poll")
    })
}
