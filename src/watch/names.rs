//! The names on the way to watched files, and what the system's events say about them.

use std::collections::BTreeMap;
use std::ffi::{OsStr, OsString};
use std::fs;
use std::path::{Component, Path, PathBuf};

use notify::event::{AccessKind, AccessMode};
use notify::{Event, EventKind};

/// The number of symbolic links followed before a chain counts as endless.
const MAX_LINKS: usize = 40;

/// The meaning of an event for the watched paths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Meaning {
    Nothing,
    /// A file may have changed.
    File,
    /// A directory on the way to a file appeared or disappeared: its watch may be dead.
    Directory,
}

/// The names on the paths to the files.
#[derive(PartialEq, Eq)]
pub(super) struct Names {
    /// The names by their directory, which exists and has a canonical path: the system would use a
    /// single watch for two paths of the same directory.
    pub(super) holders: BTreeMap<PathBuf, BTreeMap<OsString, Meaning>>,
}

impl Names {
    /// Finds the names on the way to `paths`, as far as the directories exist.
    pub(super) fn of(paths: &[PathBuf]) -> Self {
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
    pub(super) fn meaning(&self, event: notify::Result<Event>) -> Meaning {
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
