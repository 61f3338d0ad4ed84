//! What the scene's file says, understood beside the interface: for a text of millions of objects
//! that takes longer than a key may wait.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use super::msg::Msg;
use crate::document::{Document, Merge, Merged, Snapshot};
use crate::file::ReadError;
use crate::format;
use crate::memory::{self, OutOfMemory};
use crate::scene::{self, Lowered, Meshes};
use crate::text::{Edit, Findings, smallest_edit};

/// What a text is compared with and understood by.
#[derive(Clone, Debug)]
pub struct Known {
    /// The text under edit, and the one last saved or loaded.
    pub scene: Snapshot,
    /// The meshes that are read so far.
    pub meshes: Meshes,
}

/// What a file says.
#[derive(Debug)]
pub struct Reading {
    /// What was known when it was asked for.
    pub known: Known,
    /// What it says; `None` if that is the text last saved.
    pub news: Option<Box<News>>,
}

/// A text that is not the one last saved.
#[derive(Debug)]
pub enum News {
    /// There are no unsaved edits.
    Text(Document, Meaning),
    /// It is merged with unsaved edits.
    Merged(Merged, Meaning),
    /// Unsaved edits changed the same places.
    Conflict(Merge),
    /// It has errors, and there are unsaved edits.
    Broken(Arc<String>, Findings),
}

/// What a text means.
#[derive(Debug)]
pub struct Meaning {
    /// All of it.
    pub lowered: Lowered,
    /// What leads to the text from the one under edit.
    pub edit: Option<Edit>,
}

impl Reading {
    /// Understands a text, unless that takes more memory than there is.
    pub fn new(text: String, known: Known) -> Result<Self, OutOfMemory> {
        let news = if text == *known.scene.saved {
            None
        } else {
            Some(Box::new(News::new(text, &known)?))
        };
        Ok(Self { known, news })
    }
}

impl News {
    fn new(text: String, known: &Known) -> Result<Self, OutOfMemory> {
        let before = &known.scene;
        // A document keeps the text that was saved beside the one under edit.
        format::fits(before.format, &text, text.len())?;
        let document = Document::new(before.format, text);
        scene::fits(document.text(), document.tree())?;
        let lowered = scene::lower(document.text(), document.tree(), &known.meshes);
        let edit = |text: &str| smallest_edit(before.text(), text);
        if before.edited.is_none() {
            let edit = edit(document.text());
            return Ok(Self::Text(document, Meaning { lowered, edit }));
        }
        if lowered.scene.is_none() {
            return Ok(Self::Broken(document.shared_text(), lowered.diagnostics));
        }
        let merged = match before.merge(document) {
            Ok(merged) => merged,
            Err(merge) => return Ok(Self::Conflict(merge)),
        };
        let (text, tree) = (merged.document.text(), merged.document.tree());
        scene::fits(text, tree)?;
        let lowered = scene::lower(text, tree, &known.meshes);
        let edit = edit(text);
        Ok(Self::Merged(merged, Meaning { lowered, edit }))
    }

    /// Whether the text read has errors.
    pub fn is_broken(&self) -> bool {
        match self {
            Self::Text(_, meaning) => meaning.lowered.scene.is_none(),
            Self::Broken(..) => true,
            Self::Merged(..) | Self::Conflict(_) => false,
        }
    }
}

/// What was read of a file, and what is needed to understand it.
type Order = (PathBuf, Result<String, ReadError>, Known);

/// The handle of the thread that understands what the files' thread has read. It is another one, so
/// that no save and nothing kept for the next run waits for it; its end is not waited for.
pub(super) struct Understanding {
    orders: Sender<Order>,
}

impl Understanding {
    /// Starts the thread; `send` is called on it.
    pub(super) fn start(send: impl Fn(Msg) + Send + 'static) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel();
        let work = move || {
            // An edit may lower a large scene on the threads that all share, and would wait there.
            let cores = thread::available_parallelism().map_or(1, usize::from);
            let pool = rayon::ThreadPoolBuilder::new().num_threads(memory::threads(cores));
            let pool = pool.build();
            while let Some((path, read, known)) = last(&inbox) {
                let understand = |text| match &pool {
                    Ok(pool) => pool.install(|| Reading::new(text, known)),
                    Err(_) => Reading::new(text, known),
                };
                let reading = read.and_then(|text| {
                    understand(text).map_err(|reason| ReadError::NoMemory {
                        path: path.clone(),
                        reason,
                    })
                });
                send(Msg::Read(path, reading));
            }
        };
        thread::Builder::new()
            .name("reading".to_owned())
            .spawn(work)?;
        Ok(Self { orders })
    }

    /// Has it send what was read of a file; of several orders that wait, only the last is worth it.
    pub(super) fn order(
        &self,
        path: PathBuf,
        read: Result<String, ReadError>,
        known: Known,
    ) -> Result<(), String> {
        let sent = self.orders.send((path, read, known));
        sent.map_err(|_| "the thread that understands scenes has ended".to_owned())
    }
}

/// The last order of those that wait, once there is one; `None` at the end.
fn last(inbox: &Receiver<Order>) -> Option<Order> {
    let first = inbox.recv().ok()?;
    Some(inbox.try_iter().last().unwrap_or(first))
}
