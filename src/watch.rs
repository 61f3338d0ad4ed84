//! Tells when one of some files may have changed on disk. Knows nothing of what is in them.
//!
//! Editors save in many ways: in place, by moving the old file away, by renaming a new one over
//! it. A notice bound to the file itself is lost with the old file, so directories are watched and
//! notices picked by name: the directory of the path, those of what its links lead to, and the
//! ones above, to notice a directory that goes and comes back.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use notify::event::{AccessKind, AccessMode};
use notify::{Event, EventKind, RecommendedWatcher, RecursiveMode, Watcher as _};

use crate::file;

/// Links followed before a chain of them counts as endless.
const MAX_LINKS: usize = 40;

/// Bytes of a file that polling compares: of longer ones, which only meshes are, a change of length
/// or at the beginning is noticed.
const COMPARED: u64 = 1 << 28;

/// Watches paths until it is dropped.
#[derive(Debug)]
pub struct Watcher {
    inbox: Sender<Notice>,
    thread: Option<JoinHandle<()>>,
}

/// How changes are noticed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// The system's own notices.
    Native,
    /// Comparing contents at this interval: for network file systems, which send no notices.
    Poll(Duration),
}

impl Watcher {
    /// Calls `changed` from another thread whenever something happened to a file under `paths`, to
    /// the name itself or to what a symbolic link there leads to. What happened, and to which, is
    /// for the caller to see: it compares contents. Reading a file is nothing that happens to it.
    ///
    /// Changes made after this returns are noticed; more calls than changes may come. If a path's
    /// directory is missing, or goes and comes back, it is watched from then on, as long as the
    /// directory above is there.
    pub fn new(
        paths: &[PathBuf],
        method: Method,
        changed: impl Fn() + Send + 'static,
    ) -> Result<Self, notify::Error> {
        let paths = paths.iter().map(std::path::absolute);
        let paths: Vec<_> = paths.collect::<io::Result<_>>()?;
        let (inbox, notices) = mpsc::channel();
        let builder = thread::Builder::new().name("watch".to_owned());
        let thread = match method {
            Method::Native => {
                let mut places = Places::new(paths, inbox.clone())?;
                builder.spawn(move || places.follow(&notices, changed))?
            }
            Method::Poll(interval) => {
                let first = fingerprints(&paths);
                builder.spawn(move || poll(&paths, first, interval, &notices, changed))?
            }
        };
        Ok(Self {
            inbox,
            thread: Some(thread),
        })
    }
}

impl Drop for Watcher {
    fn drop(&mut self) {
        // An error means that the thread is gone already; so does one from joining it.
        let _ = self.inbox.send(Notice::Stop);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// What the watching thread is told.
enum Notice {
    System(notify::Result<Event>),
    Stop,
}

/// What an event means for the watched paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Meaning {
    Nothing,
    /// A file may have changed.
    File,
    /// A directory on the way to one came or went: watches on it may be dead.
    Directory,
}

/// The names that lead to the files, and the system's watches on the directories that hold them.
struct Places {
    paths: Vec<PathBuf>,
    system: RecommendedWatcher,
    names: Names,
    watched: BTreeSet<PathBuf>,
}

impl Places {
    fn new(paths: Vec<PathBuf>, inbox: Sender<Notice>) -> notify::Result<Self> {
        let system = notify::recommended_watcher(move |event| {
            // The receiver is gone only while the watcher is being dropped.
            let _ = inbox.send(Notice::System(event));
        })?;
        let mut places = Self {
            names: Names::of(&paths),
            paths,
            system,
            watched: BTreeSet::new(),
        };
        let homes: BTreeSet<_> = places.paths.iter().map(|path| directory_of(path)).collect();
        for home in homes {
            match places.system.watch(&home, RecursiveMode::NonRecursive) {
                Ok(()) => {
                    places.watched.insert(home);
                }
                // One that is missing may come.
                Err(error) if home.is_dir() => return Err(error),
                Err(_) => {}
            }
        }
        places.renew(Meaning::File);
        Ok(places)
    }

    fn follow(&mut self, notices: &Receiver<Notice>, changed: impl Fn()) {
        while let Ok(Notice::System(event)) = notices.recv() {
            let meaning = self.names.meaning(event);
            if meaning != Meaning::Nothing {
                // Watches first: what happens after the reader has looked must not be missed.
                self.renew(meaning);
                changed();
            }
        }
    }

    /// Reads the links anew and watches the directories they lead to now. What can't be watched is
    /// tried again at the next notice.
    fn renew(&mut self, meaning: Meaning) {
        self.names = Names::of(&self.paths);
        let wanted: BTreeSet<_> = self.names.holders.keys().cloned().collect();
        if meaning == Meaning::Directory {
            // The same path may be another directory now.
            for directory in std::mem::take(&mut self.watched) {
                let _ = self.system.unwatch(&directory);
            }
        }
        for directory in self.watched.difference(&wanted) {
            let _ = self.system.unwatch(directory);
        }
        self.watched.retain(|directory| wanted.contains(directory));
        for directory in wanted {
            let known = self.watched.contains(&directory);
            if !known
                && self
                    .system
                    .watch(&directory, RecursiveMode::NonRecursive)
                    .is_ok()
            {
                self.watched.insert(directory);
            }
        }
    }
}

/// Which names matter, by the directory that holds them.
struct Names {
    holders: BTreeMap<PathBuf, BTreeMap<OsString, Meaning>>,
}

impl Names {
    /// The names on the way from `paths` through their links, and those of the directories they
    /// are in.
    fn of(paths: &[PathBuf]) -> Self {
        let mut names = Self {
            holders: BTreeMap::new(),
        };
        for path in paths {
            names.add_way(path);
        }
        names
    }

    fn add_way(&mut self, path: &Path) {
        let mut path = path.to_owned();
        for _ in 0..MAX_LINKS {
            self.add(&path, Meaning::File);
            let directory = directory_of(&path);
            self.add(&directory, Meaning::Directory);
            match fs::read_link(&path) {
                Ok(next) => path = directory.join(next),
                Err(_) => break,
            }
        }
    }

    fn add(&mut self, path: &Path, meaning: Meaning) {
        // A path ending in `..` has no name to wait for.
        if let Some(name) = path.file_name() {
            let holder = self.holders.entry(directory_of(path)).or_default();
            holder.entry(name.to_owned()).or_insert(meaning);
        }
    }

    /// Compares last names only: the system may spell a directory in another way than we do. Two
    /// directories with a name in common cost a needless look at the file, no more.
    fn meaning(&self, event: notify::Result<Event>) -> Meaning {
        let Ok(event) = event else {
            return Meaning::File;
        };
        if event.need_rescan() {
            return Meaning::Directory;
        }
        // Reading is no change; our own reading must not make us read again.
        let written = EventKind::Access(AccessKind::Close(AccessMode::Write));
        if event.kind.is_access() && event.kind != written {
            return Meaning::Nothing;
        }
        let meanings = event.paths.iter().filter_map(|path| {
            let name = path.file_name()?;
            self.holders.values().find_map(|names| names.get(name))
        });
        meanings.copied().max().unwrap_or(Meaning::Nothing)
    }
}

fn directory_of(path: &Path) -> PathBuf {
    // Only the root has no parent, and it holds itself.
    path.parent().unwrap_or(path).to_owned()
}

/// Compares contents, not dates: those can stand still within a second, and go back.
fn poll(
    paths: &[PathBuf],
    first: Vec<Option<u64>>,
    interval: Duration,
    notices: &Receiver<Notice>,
    changed: impl Fn(),
) {
    let mut last = first;
    while matches!(
        notices.recv_timeout(interval),
        Err(RecvTimeoutError::Timeout)
    ) {
        let now = fingerprints(paths);
        if now != last {
            last = now;
            changed();
        }
    }
}

/// Numbers that stand for files' contents; `None` for one that can't be read.
fn fingerprints(paths: &[PathBuf]) -> Vec<Option<u64>> {
    paths.iter().map(|path| fingerprint(path)).collect()
}

fn fingerprint(path: &Path) -> Option<u64> {
    struct Hashing(DefaultHasher);

    impl Write for Hashing {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.write(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    let file = file::open(path).ok()?;
    let mut hashing = Hashing(DefaultHasher::new());
    hashing.0.write_u64(file.metadata().ok()?.len());
    io::copy(&mut file.take(COMPARED), &mut hashing).ok()?;
    Some(hashing.0.finish())
}
