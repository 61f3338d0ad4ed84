//! The system's watches on the directories on the way to files, and polling where it has too few.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender};
use std::time::{Duration, Instant};

use notify::{Config, ErrorKind, RecursiveMode};

use super::names::{Meaning, Names};
use super::notice::{Notice, WatchMessage};
use super::polling::Seen;

/// The interval of polling while the system has too few watches.
const INTERVAL: Duration = Duration::from_millis(500);

/// Paths to files, and the system's watches on the directories that they lead through.
pub(super) struct WatchedPaths<S> {
    /// The paths as given. A relative one changes its meaning if the current directory is moved.
    paths: Vec<PathBuf>,
    /// The last absolute paths.
    absolute: Vec<PathBuf>,
    inbox: Sender<WatchMessage>,
    /// `None` if the system refuses one.
    system: Option<S>,
    names: Names,
    watched: BTreeSet<PathBuf>,
    polled: Option<Polled>,
}

/// Files that are polled.
struct Polled {
    /// Why.
    reason: String,
    /// The files when they were looked at last.
    last: Vec<Seen>,
}

/// Why a directory is not watched.
#[derive(Debug)]
enum Unwatched {
    /// The system has no watches left.
    Limit,
    /// The system sends no notifications at all.
    System(notify::Error),
    /// The directory cannot be watched, for this reason.
    Directory(String),
}

impl<S: notify::Watcher> WatchedPaths<S> {
    /// Watches paths from now on; events go to `inbox`.
    pub(super) fn new(paths: Vec<PathBuf>, inbox: Sender<WatchMessage>) -> Self {
        let absolute = paths.iter().map(|path| file::absolute(path));
        let absolute: Vec<_> = absolute.collect();
        let mut places = Self {
            names: Names::of(&absolute),
            absolute,
            paths,
            inbox,
            system: None,
            watched: BTreeSet::new(),
            polled: None,
        };
        places.renew(Meaning::File);
        places
    }

    /// Handles events, and polls where they do not suffice, until told to stop.
    pub(super) fn follow(&mut self, notices: &Receiver<WatchMessage>, notify: impl Fn(Notice)) {
        let mut told = None;
        let mut due = Instant::now() + INTERVAL;
        loop {
            if self.reason() != told.as_deref() {
                told = self.reason().map(str::to_owned);
                due = Instant::now() + INTERVAL;
                notify(Notice::Polled(told.clone()));
            }
            let left = due.saturating_duration_since(Instant::now());
            let message = match told {
                // Events may arrive without a pause.
                Some(_) if left.is_zero() => Err(RecvTimeoutError::Timeout),
                Some(_) => notices.recv_timeout(left),
                None => notices.recv().map_err(RecvTimeoutError::from),
            };
            match message {
                Ok(WatchMessage::System(event)) => {
                    let meaning = self.names.meaning(event);
                    if meaning != Meaning::Nothing {
                        // Watches first, so that no change after the caller has looked is missed.
                        self.renew(meaning);
                        notify(Notice::Changed);
                    }
                }
                Err(RecvTimeoutError::Timeout) => {
                    due = Instant::now() + INTERVAL;
                    if self.poll() {
                        notify(Notice::Changed);
                    }
                }
                Ok(WatchMessage::Stop) | Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Why the files are polled, if they are.
    pub(super) fn reason(&self) -> Option<&str> {
        self.polled.as_ref().map(|polled| polled.reason.as_str())
    }

    /// Tries again to watch all directories; returns whether a file has changed since it was compared
    /// last.
    pub(super) fn poll(&mut self) -> bool {
        let mut last = self.polled.as_ref().map(|polled| polled.last.clone());
        self.renew(Meaning::File);
        if self.polled.is_none() {
            // Directories may have been replaced unnoticed.
            self.renew(Meaning::Directory);
        }
        let is_changed = last
            .as_mut()
            .is_some_and(|last| Seen::have_changed(last, &self.paths));
        if let Some((polled, last)) = self.polled.as_mut().zip(last) {
            polled.last = last;
        }
        is_changed
    }

    /// Resolves the paths again and watches the directories on them; polls the files as long as not
    /// all can be watched that should be.
    pub(super) fn renew(&mut self, mut meaning: Meaning) {
        let reason = loop {
            if meaning == Meaning::Directory {
                // The same path may now be a different directory.
                for directory in std::mem::take(&mut self.watched) {
                    self.unwatch(&directory);
                }
            }
            self.names = self.look();
            let outcome = self.watch();
            // What appeared before its directory was watched caused no notice.
            if self.look() == self.names {
                break outcome.err();
            }
            meaning = Meaning::Directory;
        };
        self.polled = reason.map(|error| Polled {
            reason: error.reason(),
            last: match self.polled.take() {
                Some(polled) => polled.last,
                None => Seen::all(&self.paths),
            },
        });
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

    /// Watches the directories of the names: those of the files first, as these matter most where
    /// watches are few, then the others, parents first: from then on a parent's watch reports if the
    /// directory is replaced. Fails if a file's own directory cannot be watched, or another one for
    /// want of watches; some never can.
    fn watch(&mut self) -> Result<(), Unwatched> {
        let holders = &self.names.holders;
        let needless = self.watched.iter().filter(|at| !holders.contains_key(*at));
        for directory in needless.cloned().collect::<Vec<_>>() {
            self.watched.remove(&directory);
            self.unwatch(&directory);
        }
        let holders = self.names.holders.iter();
        let new = holders.filter(|(directory, _)| !self.watched.contains(*directory));
        let is_own = |names: &Vec<Meaning>| names.contains(&Meaning::File);
        let new = new.map(|(at, names)| (at.clone(), names.values().copied().collect()));
        let (own, above): (Vec<_>, Vec<_>) = new.partition(|(_, names)| is_own(names));
        self.start()?;
        let mut outcome = Ok(());
        for (directory, _) in &own {
            let watched = self.watch_one(directory);
            outcome = outcome.and(watched);
        }
        for (directory, _) in &above {
            if let Err(Unwatched::Limit) = self.watch_one(directory) {
                outcome = outcome.and(Err(Unwatched::Limit));
            }
        }
        if !above.is_empty() {
            // They may have been replaced before the others were watched.
            for (directory, _) in &own {
                if self.watched.remove(directory) {
                    self.unwatch(directory);
                    let watched = self.watch_one(directory);
                    outcome = outcome.and(watched);
                }
            }
        }
        outcome
    }

    /// Asks the system for notifications, if that was refused so far.
    fn start(&mut self) -> Result<(), Unwatched> {
        if self.system.is_none() {
            let inbox = self.inbox.clone();
            let send = move |event| {
                // The receiver is gone only while the watcher is being dropped.
                let _ = inbox.send(WatchMessage::System(event));
            };
            let system = S::new(send, Config::default());
            self.system = Some(system.map_err(Unwatched::System)?);
        }
        Ok(())
    }

    fn watch_one(&mut self, directory: &Path) -> Result<(), Unwatched> {
        let system = self.system.as_mut();
        let outcome = system.map(|system| system.watch(directory, RecursiveMode::NonRecursive));
        outcome.unwrap_or(Ok(())).map_err(Unwatched::of)?;
        self.watched.insert(directory.to_owned());
        Ok(())
    }

    fn unwatch(&mut self, directory: &Path) {
        if let Some(system) = &mut self.system {
            // It may be gone already.
            let _ = system.unwatch(directory);
        }
    }
}

impl Unwatched {
    fn of(error: notify::Error) -> Self {
        match error.kind {
            ErrorKind::MaxFilesWatch => Self::Limit,
            ErrorKind::Io(error) => Self::Directory(error.to_string()),
            _ => Self::Directory(error.to_string()),
        }
    }

    fn reason(&self) -> String {
        match self {
            Self::Limit => "the file-watch limit is reached".to_owned(),
            Self::System(error) => format!("the system sends no change notifications: {error}"),
            Self::Directory(reason) => format!("the folder cannot be watched: {reason}"),
        }
    }
}
