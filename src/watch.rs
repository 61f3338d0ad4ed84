//! Tells when one of some files may have changed on disk. Knows nothing of what is in them.
//!
//! Editors save in many ways: in place, by moving the old file away, by renaming a new one over
//! it. A notice bound to the file itself is lost with the old file, so directories are watched and
//! notices picked by name. Folders and links on the way come and go just so: every directory that
//! the system looks into to find the file is watched, from the root on.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::{OsStr, OsString};
use std::fs;
use std::hash::{DefaultHasher, Hasher};
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};
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
    /// Changes made after this returns are noticed; more calls than changes may come. The folders
    /// and links on the way to a path need not be there, and may be replaced.
    pub fn new(
        paths: &[PathBuf],
        method: Method,
        changed: impl Fn() + Send + 'static,
    ) -> Result<Self, notify::Error> {
        let paths = paths.to_vec();
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
    /// As they were given. A relative one leads elsewhere once the current directory is moved.
    paths: Vec<PathBuf>,
    /// Where they were last.
    absolute: Vec<PathBuf>,
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
        let absolute = paths.iter().map(std::path::absolute);
        let absolute: Vec<_> = absolute.collect::<io::Result<_>>()?;
        let mut places = Self {
            names: Names::of(&absolute),
            absolute,
            paths,
            system,
            watched: BTreeSet::new(),
        };
        places.renew(Meaning::File)?;
        Ok(places)
    }

    fn follow(&mut self, notices: &Receiver<Notice>, changed: impl Fn()) {
        while let Ok(Notice::System(event)) = notices.recv() {
            let meaning = self.names.meaning(event);
            if meaning != Meaning::Nothing {
                // Watches first: what happens after the reader has looked must not be missed.
                // Directories that can't be watched now are tried again at the next notice.
                let _ = self.renew(meaning);
                changed();
            }
        }
    }

    /// Finds the ways to the files anew and watches the directories on them. It is an error if a
    /// file's own can't be watched; some of those above never can.
    fn renew(&mut self, mut meaning: Meaning) -> notify::Result<()> {
        loop {
            if meaning == Meaning::Directory {
                // The same path may be another directory now.
                for directory in std::mem::take(&mut self.watched) {
                    let _ = self.system.unwatch(&directory);
                }
            }
            self.names = self.look();
            let outcome = self.watch();
            // What came before its directory was watched was not told.
            if self.look() == self.names {
                return outcome;
            }
            meaning = Meaning::Directory;
        }
    }

    /// Finds the names on the ways to the files as they are now.
    fn look(&mut self) -> Names {
        for (path, absolute) in self.paths.iter().zip(&mut self.absolute) {
            // A current directory that was removed has no path; where it was another one may come.
            if let Ok(now) = std::path::absolute(path) {
                *absolute = now;
            }
        }
        Names::of(&self.absolute)
    }

    /// Watches the directories that hold names, each after the one above it, which tells when it is
    /// replaced from then on.
    fn watch(&mut self) -> notify::Result<()> {
        let holders = &self.names.holders;
        let system = &mut self.system;
        self.watched.retain(|directory| {
            let is_wanted = holders.contains_key(directory);
            if !is_wanted {
                let _ = system.unwatch(directory);
            }
            is_wanted
        });
        let mut outcome = Ok(());
        for (directory, names) in holders {
            if self.watched.contains(directory) {
                continue;
            }
            match system.watch(directory, RecursiveMode::NonRecursive) {
                Ok(()) => {
                    self.watched.insert(directory.clone());
                }
                Err(error) if names.values().any(|&name| name == Meaning::File) => {
                    outcome = Err(error);
                }
                Err(_) => {}
            }
        }
        outcome
    }
}

/// Which names matter on the ways to the files.
#[derive(PartialEq, Eq)]
struct Names {
    /// The names by the directory that holds them, which is there and has no links on its way: the
    /// system would take two paths of a directory for one watch.
    holders: BTreeMap<PathBuf, BTreeMap<OsString, Meaning>>,
}

impl Names {
    /// The names on the ways to `paths`, as far as there are directories.
    fn of(paths: &[PathBuf]) -> Self {
        let mut names = Self {
            holders: BTreeMap::new(),
        };
        for path in paths {
            names.add_way(path);
        }
        names
    }

    /// Goes to a file as the system does, name by name.
    fn add_way(&mut self, path: &Path) {
        let mut directory = PathBuf::new();
        let mut ahead = path.to_owned();
        let mut links = 0;
        while let Some(next) = ahead.components().next() {
            let rest: PathBuf = ahead.components().skip(1).collect();
            ahead = match next {
                Component::Normal(name) => {
                    let is_last = rest.as_os_str().is_empty();
                    let meaning = if is_last {
                        Meaning::File
                    } else {
                        Meaning::Directory
                    };
                    self.add(&directory, name, meaning);
                    let place = directory.join(name);
                    match fs::read_link(&place) {
                        Ok(target) if links < MAX_LINKS => {
                            links += 1;
                            target.join(rest)
                        }
                        Err(_) if !is_last && place.is_dir() => {
                            directory = place;
                            rest
                        }
                        _ => return,
                    }
                }
                Component::ParentDir => {
                    directory.pop();
                    rest
                }
                Component::CurDir => rest,
                // Here an absolute path begins, perhaps a link's.
                Component::RootDir | Component::Prefix(_) => {
                    directory.push(next);
                    rest
                }
            };
        }
    }

    fn add(&mut self, directory: &Path, name: &OsStr, meaning: Meaning) {
        let names = self.holders.entry(directory.to_owned()).or_default();
        let known = names.entry(name.to_owned()).or_insert(meaning);
        *known = meaning.max(*known);
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
        // Reading is not a change; our own reading must not make us read again.
        let written = EventKind::Access(AccessKind::Close(AccessMode::Write));
        if event.kind.is_access() && event.kind != written {
            return Meaning::Nothing;
        }
        let names = event.paths.iter().filter_map(|path| path.file_name());
        let meanings = names.flat_map(|name| {
            let holders = self.holders.values();
            holders.filter_map(move |names| names.get(name))
        });
        meanings.copied().max().unwrap_or(Meaning::Nothing)
    }
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
