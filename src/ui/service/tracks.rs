//! The thread that reads and watches a track file.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::Receiver;

use crate::file::{self, ReadError};
use crate::ui::event::Work;
use crate::ui::msg::{Msg, Polled};
use crate::ui::queue::{Ended, Service};
use crate::watch::{Method, Notice, Watcher};

/// Handle of the thread. Nothing waits for its end, as it has no work that could be lost.
pub(crate) struct TrackReader(Service<(PathBuf, Work)>);

impl TrackReader {
    /// Starts the thread. `send` is called on it and on the watcher's thread.
    pub(crate) fn start(
        method: Method,
        send: impl Fn(Msg) + Send + Sync + 'static,
    ) -> io::Result<Self> {
        let send = Arc::new(send);
        let service = Service::start("tracks", "reads tracks", move |inbox| {
            follow(inbox, method, &send);
        });
        service.map(Self)
    }

    /// Reads a track and watches it from now on; of several pending requests only the last is
    /// carried out.
    pub(crate) fn read(&self, path: PathBuf, work: Work) -> Result<(), Ended> {
        self.0.request((path, work))
    }
}

fn follow<S>(inbox: &Receiver<(PathBuf, Work)>, method: Method, send: &Arc<S>)
where
    S: Fn(Msg) + Send + Sync + 'static,
{
    // Stops watching when dropped.
    let mut watched: Option<(PathBuf, Watcher)> = None;
    while let Ok(first) = inbox.recv() {
        let (path, work) = inbox.try_iter().last().unwrap_or(first);
        if watched.as_ref().is_none_or(|(known, _)| *known != path) {
            if watched.take().is_some() {
                send(Msg::Polled(Polled::Track, None));
            }
            let notify = Arc::clone(send);
            let notify = move |notice| {
                notify(match notice {
                    Notice::Changed => Msg::TrackChanged,
                    Notice::Polled(reason) => Msg::Polled(Polled::Track, reason),
                });
            };
            match Watcher::new(std::slice::from_ref(&path), method, notify) {
                Ok(watcher) => watched = Some((path.clone(), watcher)),
                Err(error) => send(Msg::Failed(format!(
                    "{}: cannot watch for changes: {error}",
                    path.display()
                ))),
            }
        }
        file::regain_folder();
        let text = read(&path);
        send(Msg::TrackRead(path, text));
        drop(work);
    }
}

/// The text of a file; `None` if there is no such file.
fn read(path: &Path) -> Result<Option<String>, ReadError> {
    match file::read_small_text(path) {
        Ok(text) => Ok(Some(text)),
        Err(ReadError::NotFound { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
