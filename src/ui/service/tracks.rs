//! The thread that reads and watches a track file.

use std::io;
use std::path::{Path, PathBuf};

use super::answering::Answering;
use super::watching::Watching;
use crate::msg::{Msg, Polled};
use file::ReadError;
use watch::Method;

/// Starts the thread, which reads a track and watches it from then on. `send` is called on it and on the
/// watcher's thread. Nothing waits for its end, as it has no work that could be lost.
pub(crate) fn tracks(
    method: Method,
    send: impl Fn(Msg) + Clone + Send + 'static,
) -> io::Result<Answering<PathBuf>> {
    let mut watching = Watching::new(Polled::Track, method, send.clone());
    Answering::latest("tracks", "reads tracks", move |path: PathBuf| {
        if !watching.paths.contains(&path) {
            watching.watch(vec![path.clone()]);
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
