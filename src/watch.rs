//! Notifies when one of several files may have changed on disk. Independent of their content.
//!
//! Editors save in many ways: in place, by moving the old file away, by renaming a new one over
//! it. A watch on the file itself is lost with the old file, so directories are watched and notices
//! filtered by name. Folders and links on the path come and go likewise: every directory that the
//! system visits to find the file is watched, starting at the root.

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

/// The number of symbolic links followed before a chain counts as endless.
const MAX_LINKS: usize = 40;

/// How many bytes of a file polling compares. In longer files, which only meshes are, it detects
/// changes of the length or of this beginning.
const COMPARED: u64 = 1 << 28;

/// Watches paths until dropped.
#[derive(Debug)]
pub struct Watcher {
    inbox: Sender<WatchMessage>,
    thread: Option<JoinHandle<()>>,
}

/// How changes are detected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// By notifications of the system.
    Native,
    /// By comparing contents at this interval, for network file systems without notifications.
    Poll(Duration),
}

impl Watcher {
    /// Calls `changed` from another thread whenever a file at one of `paths` may have changed: the
    /// name itself or the target of a symbolic link. The caller finds out which, and how, by
    /// comparing contents. Reading a file is not a change.
    ///
    /// All changes after this returns are noticed; there may be more calls than changes. Folders
    /// and links on the way to a path need not exist, and may be replaced.
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
                // The watcher of the system panics if it cannot start its thread: this one ends at once, and
                // leaves its stack to that.
                thread::Builder::new()
                    .spawn(|| {})?
                    .join()
                    .unwrap_or_default();
                let mut places = WatchedPaths::new(paths, inbox.clone())?;
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
        // An error of either call means that the thread has ended already.
        let _ = self.inbox.send(WatchMessage::Stop);
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// A message to the watching thread.
enum WatchMessage {
    System(notify::Result<Event>),
    Stop,
}

/// The meaning of an event for the watched paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Meaning {
    Nothing,
    /// A file may have changed.
    File,
    /// A directory on the way to a file appeared or disappeared: its watch may be dead.
    Directory,
}

/// The names on the paths to the files, and the system's watches on the directories they are in.
struct WatchedPaths {
    /// The paths as given. A relative one changes its meaning if the current directory is moved.
    paths: Vec<PathBuf>,
    /// The last absolute paths.
    absolute: Vec<PathBuf>,
    system: RecommendedWatcher,
    names: Names,
    watched: BTreeSet<PathBuf>,
}

impl WatchedPaths {
    fn new(paths: Vec<PathBuf>, inbox: Sender<WatchMessage>) -> notify::Result<Self> {
        let system = notify::recommended_watcher(move |event| {
            // The receiver is gone only while the watcher is being dropped.
            let _ = inbox.send(WatchMessage::System(event));
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

    fn follow(&mut self, notices: &Receiver<WatchMessage>, changed: impl Fn()) {
        while let Ok(WatchMessage::System(event)) = notices.recv() {
            let meaning = self.names.meaning(event);
            if meaning != Meaning::Nothing {
                // Watches first, so that no change after the caller has looked is missed.
                // Directories that cannot be watched now are tried again at the next notice.
                let _ = self.renew(meaning);
                changed();
            }
        }
    }

    /// Resolves the paths again and watches the directories on them. Fails if a file's own
    /// directory cannot be watched; some of those above it never can.
    fn renew(&mut self, mut meaning: Meaning) -> notify::Result<()> {
        loop {
            if meaning == Meaning::Directory {
                // The same path may now be a different directory.
                for directory in std::mem::take(&mut self.watched) {
                    let _ = self.system.unwatch(&directory);
                }
            }
            self.names = self.look();
            let outcome = self.watch();
            // What appeared before its directory was watched caused no notice.
            if self.look() == self.names {
                return outcome;
            }
            meaning = Meaning::Directory;
        }
    }

    /// Finds the current names on the paths to the files.
    fn look(&mut self) -> Names {
        for (path, absolute) in self.paths.iter().zip(&mut self.absolute) {
            // A removed current directory has no path; a new one may appear at its old path.
            if let Ok(now) = std::path::absolute(path) {
                *absolute = now;
            }
        }
        Names::of(&self.absolute)
    }

    /// Watches the directories of the names, parents first: from then on a parent's watch reports
    /// if the directory is replaced.
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

/// The names on the paths to the files.
#[derive(PartialEq, Eq)]
struct Names {
    /// The names by their directory, which exists and has a canonical path: the system would use a
    /// single watch for two paths of the same directory.
    holders: BTreeMap<PathBuf, BTreeMap<OsString, Meaning>>,
}

impl Names {
    /// Finds the names on the way to `paths`, as far as the directories exist.
    fn of(paths: &[PathBuf]) -> Self {
        let mut names = Self {
            holders: BTreeMap::new(),
        };
        for path in paths {
            names.add_path(path);
        }
        names
    }

    /// Resolves a path like the system, name by name.
    fn add_path(&mut self, path: &Path) {
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
                // The beginning of an absolute path, possibly of a link's target.
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

    /// The meaning of an event. Compares only the last component: the system may spell a directory
    /// differently. If two directories have a name in common, the file is read needlessly, no more.
    fn meaning(&self, event: notify::Result<Event>) -> Meaning {
        let Ok(event) = event else {
            return Meaning::File;
        };
        if event.need_rescan() {
            return Meaning::Directory;
        }
        // Reading is not a change: the program's own reading must not trigger another.
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

/// Compares contents, not times: these may have a resolution of a second, and be set back.
fn poll(
    paths: &[PathBuf],
    first: Vec<Option<u64>>,
    interval: Duration,
    notices: &Receiver<WatchMessage>,
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

/// Hashes of the files' contents; `None` for a file that cannot be read.
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
