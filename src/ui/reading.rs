//! The content of the scene's file, read and parsed beside the interface: for a text of millions of
//! objects that takes longer than a key may wait.

use std::cell::LazyCell;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use super::heap;
use super::msg::Msg;
use crate::document::{Document, Merge, Merged, Snapshot};
use crate::file;
use crate::file::{FileId, ReadError};
use crate::language;
use crate::language::Lowered;
use crate::memory;
use crate::memory::OutOfMemory;
use crate::scene::Meshes;
use crate::text::{Edit, Findings, smallest_edit};
use crate::watch::{Method, Watcher};

/// What a text is compared with and understood by.
#[derive(Clone, Debug)]
pub struct Known {
    /// The text under edit, and the one last saved or loaded.
    pub scene: Snapshot,
    /// The text that is being written to the file.
    pub saving: Option<Arc<String>>,
    /// The meshes that are read so far.
    pub meshes: Meshes,
}

/// The content of a file.
#[derive(Debug)]
pub struct Reading {
    /// What was known when it was asked for.
    pub known: Known,
    /// What has changed; `None` if it is the text last saved, or the one being saved.
    pub news: Option<Box<News>>,
    /// Where it was read, as far as that is known.
    pub place: Option<Place>,
}

/// Where a scene's file was read.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The absolute path of its folder.
    pub folder: PathBuf,
    /// Which folder that was.
    pub id: FileId,
}

impl Place {
    /// Where the file of this path is now.
    pub fn of(path: &Path) -> Option<Self> {
        let folder = file::directory_of(path);
        Some(Self {
            id: FileId::of(folder)?,
            // A relative path leads elsewhere once the current folder is moved.
            folder: std::path::absolute(folder).ok()?.components().collect(),
        })
    }
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
        let is_own = |own: &Arc<String>| **own == text;
        let news = if is_own(&known.scene.saved) || known.saving.as_ref().is_some_and(is_own) {
            None
        } else {
            Some(Box::new(News::new(text, &known)?))
        };
        Ok(Self {
            known,
            news,
            place: None,
        })
    }
}

impl News {
    fn new(text: String, known: &Known) -> Result<Self, OutOfMemory> {
        let before = &known.scene;
        // A document keeps the text that was saved beside the one under edit.
        language::fits(before.language, &text, text.len())?;
        let mut document = Document::new(before.language, text);
        let lowered = document.lower(&known.meshes)?;
        let edit = |text: &str| smallest_edit(before.text(), text);
        if before.edited.is_none() {
            let edit = edit(document.text());
            return Ok(Self::Text(document, Meaning { lowered, edit }));
        }
        if lowered.scene.is_none() {
            return Ok(Self::Broken(document.shared_text(), lowered.diagnostics));
        }
        let mut merged = match before.merge(document) {
            Ok(merged) => merged,
            Err(merge) => return Ok(Self::Conflict(merge)),
        };
        let lowered = merged.document.lower(&known.meshes)?;
        let edit = edit(merged.document.text());
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

/// A text from this many bytes on is understood on several threads.
const LARGE: usize = 1 << 20;

/// What the thread is asked to do.
enum Order {
    /// Watch this file in place of the one before.
    Watch(PathBuf),
    /// Read it.
    Read(PathBuf, Known),
}

/// The handle of the thread that has the scene's file watched, reads it and understands it. Nothing
/// else waits for it, neither a save nor the end of the program.
pub(super) struct Reader {
    orders: Sender<Order>,
}

impl Reader {
    /// Starts the thread; `send` is called on it, and on that of the watcher.
    pub(super) fn start(
        method: Method,
        send: impl Fn(Msg) + Clone + Send + 'static,
    ) -> io::Result<Self> {
        let (orders, inbox) = mpsc::channel();
        let work = move || {
            let mut watcher = None;
            let watch = |path| watch(path, method, &mut watcher, &send);
            follow(&inbox, watch, file::read_text, &send);
        };
        thread::Builder::new()
            .name("reading".to_owned())
            .spawn(work)?;
        Ok(Self { orders })
    }

    /// Has a file watched from here on: [`Msg::FileChanged`].
    pub(super) fn watch(&self, path: PathBuf) -> Result<(), String> {
        self.order(Order::Watch(path))
    }

    /// Has a file read: [`Msg::Read`]. Of several orders that wait only the last is carried out.
    pub(super) fn read(&self, path: PathBuf, known: Known) -> Result<(), String> {
        self.order(Order::Read(path, known))
    }

    fn order(&self, order: Order) -> Result<(), String> {
        let sent = self.orders.send(order);
        sent.map_err(|_| "the thread that reads scenes has ended".to_owned())
    }
}

/// Carries out orders until there are no more. A file that has changed while it was read is not
/// understood, only read again.
fn follow(
    inbox: &Receiver<Order>,
    mut watch: impl FnMut(PathBuf),
    read: impl Fn(&Path) -> Result<String, ReadError>,
    send: impl Fn(Msg),
) {
    // An edit may lower a large scene on the threads that all share, and would wait there.
    let pool = LazyCell::new(|| {
        let cores = thread::available_parallelism().map_or(1, usize::from);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(memory::threads(cores));
        pool.build()
    });
    while let Ok(first) = inbox.recv() {
        let mut orders = vec![first];
        orders.extend(inbox.try_iter());
        while let Some((path, known)) = last(orders, &mut watch) {
            let read = read(&path);
            orders = inbox.try_iter().collect();
            if orders.iter().any(|order| matches!(order, Order::Read(..))) {
                continue;
            }
            let understand = |text: String| {
                if text.len() < LARGE {
                    return Reading::new(text, known);
                }
                heap::keep_large();
                match &*pool {
                    Ok(pool) => pool.install(|| Reading::new(text, known)),
                    Err(_) => Reading::new(text, known),
                }
            };
            let reading = read.and_then(|text| {
                let place = Place::of(&path);
                let understood = understand(text).map_err(|reason| ReadError::NoMemory {
                    path: path.clone(),
                    reason,
                });
                understood.map(|reading| Reading { place, ..reading })
            });
            send(Msg::Read(path, reading));
        }
    }
}

/// Does what is to be watched; the last file that is to be read.
fn last(orders: Vec<Order>, mut watch: impl FnMut(PathBuf)) -> Option<(PathBuf, Known)> {
    let mut last = None;
    for order in orders {
        match order {
            // Before the file is read: what happens after that must not be missed.
            Order::Watch(path) => watch(path),
            Order::Read(path, known) => last = Some((path, known)),
        }
    }
    last
}

fn watch(
    path: PathBuf,
    method: Method,
    watcher: &mut Option<Watcher>,
    send: &(impl Fn(Msg) + Clone + Send + 'static),
) {
    // The old watch ends first: its notices would be taken for the new file's.
    drop(watcher.take());
    let path = [path];
    let changed = send.clone();
    match Watcher::new(&path, method, move || changed(Msg::FileChanged)) {
        Ok(new) => *watcher = Some(new),
        Err(error) => send(Msg::Failed(format!(
            "changes of {} go unnoticed: {error}; try --poll",
            path[0].display()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::Document;
    use crate::language::Language;
    use std::cell::{Cell, RefCell};

    fn order(name: &str) -> Order {
        let known = Known {
            scene: Document::new(Language::Ray, String::new()).snapshot(),
            saving: None,
            meshes: Meshes::default(),
        };
        Order::Read(name.into(), known)
    }

    /// The names that are read and those that come back, where `during` is ordered while the first
    /// one is read.
    fn followed(before: &[&str], during: Option<&str>) -> (Vec<PathBuf>, Vec<PathBuf>) {
        let (orders, inbox) = mpsc::channel();
        for name in before {
            orders.send(order(name)).expect("it is there");
        }
        let orders = Cell::new(Some(orders));
        let (read, sent) = (RefCell::new(Vec::new()), RefCell::new(Vec::new()));
        let reads = |path: &Path| {
            if let (Some(orders), Some(name)) = (orders.take(), during) {
                orders.send(order(name)).expect("it is there");
            }
            read.borrow_mut().push(path.to_owned());
            Ok(String::new())
        };
        follow(
            &inbox,
            |_| {},
            reads,
            |msg| match msg {
                Msg::Read(path, Ok(_)) => sent.borrow_mut().push(path),
                msg => panic!("{msg:?}"),
            },
        );
        (read.into_inner(), sent.into_inner())
    }

    #[test]
    fn only_the_last_of_the_files_that_wait_is_read() {
        let paths = |names: &[&str]| names.iter().map(PathBuf::from).collect::<Vec<_>>();
        assert_eq!(
            followed(&["a", "b", "a"], None),
            (paths(&["a"]), paths(&["a"]))
        );
    }

    #[test]
    fn a_file_that_changed_while_it_was_read_is_not_understood() {
        let (read, sent) = followed(&["a"], Some("a"));
        assert_eq!((read.len(), sent.len()), (2, 1));
    }
}
