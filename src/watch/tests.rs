//! A system that has few watches.

use std::cell::{Cell, RefCell};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::{fs, io};

use notify::{Config, Error, EventHandler, RecursiveMode, WatcherKind};

use super::names::Meaning;
use super::system::WatchedPaths;
use super::*;

thread_local! {
    /// How many directories can be watched; `None`: the system refuses to notify at all.
    static LIMIT: Cell<Option<usize>> = const { Cell::new(None) };
    /// A directory that cannot be watched.
    static CLOSED: RefCell<PathBuf> = RefCell::default();
    static WATCHED: RefCell<BTreeSet<PathBuf>> = RefCell::default();
}

struct Few;

impl notify::Watcher for Few {
    fn new<F: EventHandler>(_: F, _: Config) -> notify::Result<Self> {
        let refused = || Error::io(io::Error::other("too many users"));
        LIMIT.get().map(|_| Self).ok_or_else(refused)
    }

    fn watch(&mut self, path: &Path, _: RecursiveMode) -> notify::Result<()> {
        WATCHED.with_borrow_mut(|watched| {
            if CLOSED.with_borrow(|closed| closed == path) {
                return Err(Error::io(io::ErrorKind::PermissionDenied.into()));
            }
            if LIMIT.get() <= Some(watched.len()) {
                return Err(Error::new(notify::ErrorKind::MaxFilesWatch));
            }
            watched.insert(path.to_owned());
            Ok(())
        })
    }

    fn unwatch(&mut self, path: &Path) -> notify::Result<()> {
        WATCHED.with_borrow_mut(|watched| watched.remove(path));
        Ok(())
    }

    fn kind() -> WatcherKind {
        WatcherKind::NullWatcher
    }
}

const LIMIT_REACHED: &str = "the file-watch limit is reached";

/// A file in a folder of its own, and its path.
fn scene() -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = fs::canonicalize(folder.path()).expect("it is there");
    let path = path.join("a.ray");
    fs::write(&path, "old").expect("written");
    (folder, path)
}

fn watched(path: &Path) -> WatchedPaths<Few> {
    WATCHED.take();
    WatchedPaths::new(vec![path.to_owned()], mpsc::channel().0)
}

/// All folders above a file.
fn above(path: &Path) -> BTreeSet<PathBuf> {
    path.ancestors().skip(1).map(Path::to_owned).collect()
}

#[test]
fn few_watches_go_to_the_folder_of_the_file_and_it_is_polled_until_there_are_more() {
    let (_folder, path) = scene();
    for (limit, reason, held) in [
        (
            None,
            "the system sends no change notifications: too many users",
            0,
        ),
        (Some(0), LIMIT_REACHED, 0),
        (Some(1), LIMIT_REACHED, 1),
        (Some(2), LIMIT_REACHED, 2),
    ] {
        LIMIT.set(limit);
        let mut places = watched(&path);
        let is_own = |watched: &BTreeSet<PathBuf>| watched.contains(path.parent().expect("one"));
        assert_eq!(places.reason(), Some(reason));
        assert_eq!(WATCHED.with_borrow(BTreeSet::len), held);
        assert_eq!(WATCHED.with_borrow(is_own), 0 < held);
        for content in ["new", "newer"] {
            assert!(!places.poll());
            fs::write(&path, content).expect("written");
            assert!(places.poll());
        }
        LIMIT.set(Some(99));
        fs::write(&path, "newest").expect("written");
        assert!(places.poll());
        assert_eq!(places.reason(), None);
        assert_eq!(WATCHED.with_borrow(BTreeSet::clone), above(&path));
    }
}

#[test]
fn a_watch_that_cannot_be_renewed_is_told() {
    let (folder, path) = scene();
    LIMIT.set(Some(99));
    let mut places = watched(&path);
    assert_eq!(places.reason(), None);
    let count = above(&path).len();
    LIMIT.set(Some(count));
    let elsewhere = folder.path().join("x/y");
    fs::create_dir_all(&elsewhere).expect("created");
    fs::rename(&path, elsewhere.join("a.ray")).expect("moved");
    std::os::unix::fs::symlink("x/y/a.ray", &path).expect("linked");
    places.renew(Meaning::File);
    assert_eq!(places.reason(), Some(LIMIT_REACHED));
    LIMIT.set(Some(99));
    places.renew(Meaning::Directory);
    assert_eq!(places.reason(), None);
}

#[test]
fn only_the_folder_of_the_file_must_be_open_to_watches() {
    let (_folder, path) = scene();
    LIMIT.set(Some(99));
    let own = path.parent().expect("a folder");
    for (closed, is_polled) in [(own, true), (own.parent().expect("another"), false)] {
        CLOSED.replace(closed.to_owned());
        let reason = watched(&path).reason().map(str::to_owned);
        let expected = "the folder cannot be watched: permission denied";
        assert_eq!(reason.as_deref(), is_polled.then_some(expected));
    }
    CLOSED.take();
}
