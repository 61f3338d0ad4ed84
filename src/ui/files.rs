//! The thread that touches scene files and the edits kept for the next run, one task after the
//! other.

use std::collections::VecDeque;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::Duration;

use super::msg::{Guard, Msg, SaveOutcome};
use super::recovery::{self, Journal};
use crate::file::{self, ReadError};

/// How long the end of the program waits for a disk that does not answer.
const PATIENCE: Duration = Duration::from_secs(2);

/// Work for the thread.
pub(super) enum Task {
    Read(PathBuf),
    Save {
        path: PathBuf,
        text: String,
        guard: Guard,
    },
    /// Keep the unsaved edits of this scene, which is the one without a file if it has no path.
    Keep {
        scene: Option<PathBuf>,
        text: String,
    },
    /// Make what an earlier run kept this one's.
    Adopt {
        scene: Option<PathBuf>,
        place: PathBuf,
    },
    /// Forget what this run has kept.
    Forget,
    /// Forget what an earlier run kept.
    Discard(PathBuf),
}

/// The thread's handle.
pub(super) struct Files {
    tasks: Sender<Task>,
    /// Whether edits are kept, told at the end.
    kept: Receiver<bool>,
}

impl Files {
    /// Starts the thread; `send` is called on it.
    pub(super) fn start(send: impl Fn(Msg) + Send + 'static) -> io::Result<Self> {
        let (tasks, inbox) = mpsc::channel();
        let (tell, kept) = mpsc::channel();
        let work = move || {
            let mut journal = Journal::default();
            let mut waiting = VecDeque::new();
            while let Some(task) = next(&inbox, &mut waiting) {
                perform(task, &mut journal).into_iter().for_each(&send);
            }
            // A program that has lost its patience is gone.
            let _ = tell.send(journal.is_kept());
        };
        thread::Builder::new()
            .name("files".to_owned())
            .spawn(work)?;
        Ok(Self { tasks, kept })
    }

    /// Has a task done after those before.
    pub(super) fn order(&self, task: Task) -> Result<(), String> {
        let sent = self.tasks.send(task);
        sent.map_err(|_| "the thread that reads and writes files has ended".to_owned())
    }

    /// Waits until all is done; whether edits are kept for the next run.
    pub(super) fn finish(self) -> bool {
        drop(self.tasks);
        self.kept.recv_timeout(PATIENCE).unwrap_or(false)
    }
}

/// The next task; `None` at the end. One reading answers all that wait for it.
fn next(inbox: &Receiver<Task>, waiting: &mut VecDeque<Task>) -> Option<Task> {
    if waiting.is_empty() {
        waiting.push_back(inbox.recv().ok()?);
    }
    waiting.extend(inbox.try_iter());
    loop {
        let task = waiting.pop_front()?;
        let is_again = |later: &Task| match (&task, later) {
            (Task::Read(path), Task::Read(again)) => path == again,
            _ => false,
        };
        if !waiting.iter().any(is_again) {
            return Some(task);
        }
    }
}

fn perform(task: Task, journal: &mut Journal) -> Option<Msg> {
    let (done, words) = match task {
        Task::Read(path) => {
            let read = file::read_text(&path);
            return Some(Msg::Read(path, read));
        }
        Task::Save { path, text, guard } => return Some(Msg::Saved(save(path, text, &guard))),
        Task::Keep { scene, text } => (
            journal.write(scene, &text),
            "the unsaved edits can't be kept",
        ),
        Task::Adopt { scene, place } => {
            (journal.adopt(scene, place), "the kept edits can't be used")
        }
        Task::Forget => (journal.forget(), "the kept edits can't be removed"),
        Task::Discard(place) => (recovery::remove(&place), "the kept edits can't be removed"),
    };
    done.err()
        .map(|error| Msg::Failed(format!("{words}: {error}")))
}

/// Writes a scene, unless that would lose what somebody else wrote.
fn save(path: PathBuf, text: String, guard: &Guard) -> SaveOutcome {
    let folder = path
        .parent()
        .filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder.filter(|folder| !folder.exists()) {
        return SaveOutcome::Failed(format!("{}: no such folder", folder.display()));
    }
    let saved = file::replace_if(
        &path,
        |out| out.write_all(text.as_bytes()),
        || may_replace(&path, &text, guard),
    );
    match saved {
        Ok(()) => SaveOutcome::Saved { path, text },
        Err(Refusal::Changed(found)) => SaveOutcome::ChangedOnDisk(found),
        Err(Refusal::Other(reason)) => SaveOutcome::Failed(reason),
        Err(Refusal::Io(error)) => SaveOutcome::Failed(format!("{}: {error}", path.display())),
    }
}

/// Why a scene was not written.
enum Refusal {
    /// The file holds something else than what we know.
    Changed(String),
    Other(String),
    Io(io::Error),
}

impl From<io::Error> for Refusal {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

/// Whether what the file holds may be lost.
fn may_replace(path: &Path, text: &str, guard: &Guard) -> Result<(), Refusal> {
    let held = match guard {
        Guard::Anything => return Ok(()),
        Guard::Holding(held) => Some(held),
        Guard::Absent => None,
    };
    match (held, file::read_text(path)) {
        (_, Err(ReadError::NotFound { .. })) => Ok(()),
        (Some(held), Ok(found)) if found == *held || found == text => Ok(()),
        (Some(_), Ok(found)) => Err(Refusal::Changed(found)),
        (Some(_), Err(error)) => Err(Refusal::Other(error.to_string())),
        (None, _) => {
            let path = path.display();
            let reason = format!("{path} exists: :w! {path} overwrites it");
            Err(Refusal::Other(reason))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_is_waited_for_several_times_is_read_once() {
        let (tasks, inbox) = mpsc::channel();
        for name in ["a", "b", "a", "a", "b"] {
            tasks.send(Task::Read(name.into())).expect("it is there");
        }
        drop(tasks);
        let mut waiting = VecDeque::new();
        let mut names = Vec::new();
        while let Some(Task::Read(path)) = next(&inbox, &mut waiting) {
            names.push(path);
        }
        assert_eq!(names, ["a", "b"].map(PathBuf::from));
    }

    #[test]
    fn a_scene_is_not_saved_in_a_folder_that_is_not_there() {
        let place = tempfile::tempdir().expect("a folder");
        let path = place.path().join("none").join("x.ray");
        let outcome = save(path, String::new(), &Guard::Absent);
        assert!(
            matches!(outcome, SaveOutcome::Failed(said) if said.ends_with("none: no such folder"))
        );
    }
}
