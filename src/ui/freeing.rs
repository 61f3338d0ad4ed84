//! The thread that frees unneeded values: for a large scene this takes longer than a key may wait.

use std::any::Any;
use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Sender};
use std::thread;

/// Handle of the thread. Nothing waits for its end, as it has no work that could be lost.
pub(super) struct Freeing {
    unneeded: Sender<Arc<dyn Any + Send + Sync>>,
}

impl Freeing {
    /// Starts the thread, which ends when this is dropped.
    pub(super) fn start() -> io::Result<Self> {
        let (unneeded, inbox) = mpsc::channel();
        thread::Builder::new()
            .name("freeing".to_owned())
            .spawn(move || inbox.into_iter().for_each(drop))?;
        Ok(Self { unneeded })
    }

    /// Frees a value on the thread.
    pub(super) fn request(&self, unneeded: Arc<dyn Any + Send + Sync>) -> Result<(), String> {
        let sent = self.unneeded.send(unneeded);
        sent.map_err(|_| "the thread that frees memory has ended".to_owned())
    }
}
