//! Saves of common editors, step by step: a reader that reads the file only when notified must end
//! up with its final content.

mod folders;
mod links;

use std::fs::{self, File, FileTimes};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, SystemTime};

use halflight::watch::{Method, Notice, Watcher};
use tempfile::TempDir;

/// The timeout for a notice that must arrive.
const PATIENCE: Duration = Duration::from_secs(20);

/// The time without a notice after which none is expected. On a slower machine a test checks less
/// but does not fail.
const QUIET: Duration = Duration::from_millis(40);

/// More notices than any case should cause.
const MANY: usize = 400;

const POLL: Method = Method::Poll(Duration::from_millis(10));

/// An operation of an editor on files of the test's directory.
#[derive(Clone, Copy, Debug)]
enum Step {
    /// Creates or truncates a file and keeps it open.
    Open(&'static str),
    /// Appends to the open file.
    Put(&'static str),
    /// Syncs and closes the open file.
    Close,
    /// Opens, writes and closes a file.
    Save(&'static str, &'static str),
    Rename(&'static str, &'static str),
    Remove(&'static str),
    Duplicate(&'static str, &'static str),
    Directory(&'static str),
    RemoveDirectory(&'static str),
    /// Creates a symbolic link: its target, its name.
    Link(&'static str, &'static str),
}

use Step::{Close, Directory, Duplicate, Link, Open, Put, Remove, RemoveDirectory, Rename, Save};

/// A watched file in a directory of its own, and a reader that looks when notified.
struct Watched {
    directory: TempDir,
    path: PathBuf,
    held: Option<File>,
    notices: Receiver<()>,
    seen: Option<String>,
    count: usize,
    _watcher: Watcher,
}

impl Watched {
    /// Takes `steps`, then watches `name`.
    fn new(name: &str, method: Method, steps: &[Step]) -> Self {
        // Not in the system's temporary directory, where some editors save differently.
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        for &step in steps {
            take(directory.path(), &mut None, step);
        }
        let path = directory.path().join(name);
        let (sender, notices) = mpsc::channel();
        // The receiver may be dropped first when the test ends.
        let notify = move |notice| {
            assert_eq!(notice, Notice::Changed);
            let _ = sender.send(());
        };
        let watcher = Watcher::new(std::slice::from_ref(&path), method, notify).expect("a watcher");
        Self {
            seen: fs::read_to_string(&path).ok(),
            directory,
            path,
            held: None,
            notices,
            count: 0,
            _watcher: watcher,
        }
    }

    fn take(&mut self, step: Step) {
        take(self.directory.path(), &mut self.held, step);
    }

    fn look(&mut self) {
        self.count += 1;
        assert!(self.count < MANY, "endless notices");
        self.seen = fs::read_to_string(&self.path).ok();
    }

    /// Handles every notice until none has arrived for a while.
    fn settle(&mut self) {
        while self.notices.recv_timeout(QUIET).is_ok() {
            self.look();
        }
    }

    /// Takes steps, settling after each, so that each must be noticed separately; then handles
    /// notices until the reader has seen `content`.
    fn expect(&mut self, steps: &[Step], content: &str) {
        for &step in steps {
            self.take(step);
            self.settle();
        }
        self.wait(Some(content), steps);
    }

    /// Handles notices until the file is gone.
    fn expect_none(&mut self) {
        self.wait(None, &[]);
    }

    fn wait(&mut self, content: Option<&str>, steps: &[Step]) {
        while self.seen.as_deref() != content {
            let notice = self.notices.recv_timeout(PATIENCE);
            notice.unwrap_or_else(|_| panic!("{steps:?}: saw only {:?}", self.seen));
            self.look();
        }
    }
}

fn take(directory: &Path, held: &mut Option<File>, step: Step) {
    let at = |name: &str| directory.join(name);
    let done = match step {
        Open(name) => File::create(at(name)).map(|file| *held = Some(file)),
        Put(text) => {
            let file = held.as_mut().expect("a held file");
            file.write_all(text.as_bytes())
        }
        Close => held.take().expect("a held file").sync_all(),
        Save(name, text) => fs::write(at(name), text),
        Rename(from, to) => fs::rename(at(from), at(to)),
        Remove(name) => fs::remove_file(at(name)),
        Duplicate(from, to) => fs::copy(at(from), at(to)).map(|_| ()),
        Directory(name) => fs::create_dir(at(name)),
        RemoveDirectory(name) => fs::remove_dir_all(at(name)),
        Link(target, name) => std::os::unix::fs::symlink(target, at(name)),
    };
    done.unwrap_or_else(|error| panic!("{step:?}: {error}"));
}

/// Ways to save `new` to `s.ray`.
const SAVES: &[&[Step]] = &[
    // vim, backupcopy=no
    &[
        Save("4913", ""),
        Remove("4913"),
        Rename("s.ray", "s.ray~"),
        Open("s.ray"),
        Put("new"),
        Close,
        Remove("s.ray~"),
    ],
    // vim, backupcopy=yes
    &[
        Save(".s.ray.swp", "x"),
        Duplicate("s.ray", "s.ray~"),
        Open("s.ray"),
        Put("new"),
        Close,
        Remove("s.ray~"),
    ],
    // nano, a shell's `>`
    &[Open("s.ray"), Put("new"), Close],
    // a program that writes slowly
    &[Open("s.ray"), Put("n"), Put("e"), Put("w"), Close],
    // emacs
    &[
        Save(".#s.ray", ""),
        Save("#s.ray#", "ne"),
        Rename("s.ray", "s.ray~"),
        Save("s.ray", "new"),
        Remove("#s.ray#"),
        Remove(".#s.ray"),
    ],
    // sed -i, and this program
    &[
        Open("sedXyZ123"),
        Put("new"),
        Close,
        Rename("sedXyZ123", "s.ray"),
    ],
    // mv
    &[Save("other", "new"), Rename("other", "s.ray")],
    // cp
    &[Save("other", "new"), Duplicate("other", "s.ray")],
    // deleted and created again
    &[Remove("s.ray"), Save("s.ray", "new")],
];

#[test]
fn repeated_saves_of_every_editor_are_noticed() {
    for steps in SAVES {
        let mut watched = Watched::new("s.ray", Method::Native, &[Save("s.ray", "old")]);
        watched.expect(steps, "new");
        watched.expect(&[Save("s.ray", "old")], "old");
        watched.expect(steps, "new");
    }
}

#[test]
fn polling_notices_the_saves_of_every_editor() {
    for steps in SAVES {
        let mut watched = Watched::new("s.ray", POLL, &[Save("s.ray", "old")]);
        watched.expect(steps, "new");
        watched.expect(&[Save("s.ray", "old")], "old");
    }
}

#[test]
fn the_creation_of_a_missing_file_is_noticed() {
    for method in [Method::Native, POLL] {
        let mut watched = Watched::new("s.ray", method, &[]);
        watched.expect(&[Save("s.ray", "new")], "new");
    }
}

/// Watches files of a directory; the receiver gets each notice.
fn watch(directory: &Path, names: &[&str], method: Method) -> (Watcher, Receiver<()>) {
    let paths: Vec<_> = names.iter().map(|name| directory.join(name)).collect();
    let (sender, notices) = mpsc::channel();
    let notify = move |notice| {
        assert_eq!(notice, Notice::Changed);
        let _ = sender.send(());
    };
    let watcher = Watcher::new(&paths, method, notify).expect("a watcher");
    (watcher, notices)
}

#[test]
fn each_of_several_files_is_noticed() {
    for method in [Method::Native, POLL] {
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        let at = directory.path();
        take(at, &mut None, Directory("d"));
        // The directory of the last one does not exist yet.
        let (_watcher, notices) = watch(at, &["a", "d/b", "e/c"], method);
        for step in [
            Save("a", "1"),
            Save("d/b", "1"),
            Directory("e"),
            Save("e/c", "1"),
            Remove("a"),
            Save("e/c", "22"),
        ] {
            take(at, &mut None, step);
            // An empty directory has no content to compare.
            if step_is_noticed(step, method) {
                notices.recv_timeout(PATIENCE).expect("a notice");
            }
            while notices.recv_timeout(QUIET).is_ok() {}
        }
    }
}

fn step_is_noticed(step: Step, method: Method) -> bool {
    method == Method::Native || !matches!(step, Directory(_))
}

#[test]
fn other_files_are_not_noticed() {
    let mut watched = Watched::new("s.ray", Method::Native, &[Save("s.ray", "old")]);
    let others = [
        "4913",
        ".s.ray.swp",
        "s.ray~",
        ".#s.ray",
        "#s.ray#",
        "sedXyZ123",
        "S.raz",
    ];
    for name in others {
        watched.take(Save(name, "noise"));
        watched.take(Remove(name));
    }
    watched.settle();
    assert_eq!(watched.count, 0);
    watched.expect(&[Save("s.ray", "new")], "new");
}

#[test]
fn reading_the_file_is_not_noticed() {
    let mut watched = Watched::new("s.ray", Method::Native, &[]);
    for content in ["1", "2", "3", "4", "5", "6", "7", "8", "9", "10"] {
        watched.expect(&[Save("s.ray", content)], content);
    }
    watched.settle();
    // Created or truncated, written, closed: a save causes three notices, rarely four.
    assert!(watched.count <= 40, "{} notices", watched.count);
    for _ in 0..100 {
        fs::read_to_string(&watched.path).expect("there");
    }
    let before = watched.count;
    watched.settle();
    assert_eq!(watched.count, before);
}

#[test]
fn polling_notices_saves_within_a_second_and_backdated_files() {
    let mut watched = Watched::new("s.ray", POLL, &[Save("s.ray", "0")]);
    for content in ["1", "2", "3"] {
        watched.expect(&[Save("s.ray", content)], content);
    }
    let old = file_from_1970(&watched, "4");
    fs::rename(old, &watched.path).expect("renamed");
    watched.expect(&[], "4");
}

/// Creates a file with a modification time in 1970.
fn file_from_1970(watched: &Watched, content: &str) -> PathBuf {
    let path = watched.directory.path().join("other");
    fs::write(&path, content).expect("written");
    let file = File::options().write(true).open(&path).expect("opened");
    let date = FileTimes::new().set_modified(SystemTime::UNIX_EPOCH);
    file.set_times(date).expect("dated");
    path
}
