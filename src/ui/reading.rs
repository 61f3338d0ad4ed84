//! What the scene's file says, understood beside the interface: for a text of millions of objects
//! that takes longer than a key may wait.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use super::msg::Msg;
use crate::document::Document;
use crate::file::ReadError;
use crate::format::Format;
use crate::scene::{self, Lowered, Meshes};
use crate::text::{Edit, smallest_edit};

/// What a text is compared with and understood by.
#[derive(Clone, Debug)]
pub struct Known {
    /// Its language.
    pub format: Format,
    /// The text last saved or loaded.
    pub saved: Arc<String>,
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
pub struct News {
    /// The text and its tree.
    pub document: Document,
    /// What it means.
    pub lowered: Lowered,
    /// What leads to it from the text last saved.
    pub edit: Option<Edit>,
}

impl Reading {
    /// Understands a text.
    pub fn new(text: String, known: Known) -> Self {
        let news = (text != *known.saved).then(|| {
            let document = Document::new(known.format, text);
            Box::new(News {
                lowered: scene::lower(document.text(), document.tree(), &known.meshes),
                edit: smallest_edit(&known.saved, document.text()),
                document,
            })
        });
        Self { known, news }
    }

    /// Whether it is the same with what is known by now.
    pub fn holds(&self, now: &Known) -> bool {
        Arc::ptr_eq(&self.known.saved, &now.saved)
            && (self.news.is_none() || self.known.meshes == now.meshes)
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
            // An edit of a large scene copies it on the threads that all share, and would wait there.
            let pool = rayon::ThreadPoolBuilder::new().build();
            while let Some((path, read, known)) = last(&inbox) {
                let understand = |text| match &pool {
                    Ok(pool) => pool.install(|| Reading::new(text, known)),
                    Err(_) => Reading::new(text, known),
                };
                let reading = read.map(understand);
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
