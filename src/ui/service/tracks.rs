//! The thread that reads and watches a track file.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::answering::Answering;
use crate::file::{self, ReadError};
use crate::ui::msg::{Msg, Polled};
use crate::watch::{Method, Notice, Watcher};

/// Starts the thread, which reads a track and watches it from then on. `send` is called on it and on the
/// watcher's thread. Nothing waits for its end, as it has no work that could be lost.
pub(crate) fn tracks(
    method: Method,
    send: impl Fn(Msg) + Send + Sync + 'static,
) -> io::Result<Answering<PathBuf>> {
    let send = Arc::new(send);
    // Stops watching when dropped.
    let mut watched: Option<(PathBuf, Watcher)> = None;
    Answering::latest("tracks", "reads tracks", move |path: PathBuf| {
        if watched.as_ref().is_none_or(|(known, _)| *known != path) {
            if watched.take().is_some() {
                send(Msg::Polled(Polled::Track, None));
            }
            let notify = Arc::clone(&send);
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
    })
}

/// The text of a file; `None` if there is no such file.
fn read(path: &Path) -> Result<Option<String>, ReadError> {
    match file::read_small_text(path) {
        Ok(text) => Ok(Some(text)),
        Err(ReadError::NotFound { .. }) => Ok(None),
        Err(error) => Err(error),
    }
}
