//! The thread that reads scene files, one after the other.

use std::any::Any;
use std::collections::VecDeque;
use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;

use super::msg::Msg;
use super::reading::{Known, Understanding};
use crate::file::{self, ReadError};

/// Work for the thread.
pub(super) enum Task {
    Read(PathBuf, Known),
    /// Have what was read understood.
    Understand(PathBuf, Result<String, ReadError>, Known),
    Free(Arc<dyn Any + Send + Sync>),
}

/// The thread's handle. Its end is not waited for: nothing is lost with it.
pub(super) struct Files {
    tasks: Sender<Task>,
}

impl Files {
    /// Starts the thread; `send` is called on it.
    pub(super) fn start(send: impl Fn(Msg) + Clone + Send + 'static) -> io::Result<Self> {
        let understanding = Understanding::start(send.clone())?;
        let (tasks, inbox) = mpsc::channel();
        let work = move || {
            let mut waiting = VecDeque::new();
            while let Some(task) = next(&inbox, &mut waiting) {
                let came = perform(task, &mut waiting, &understanding);
                came.into_iter().for_each(&send);
            }
        };
        thread::Builder::new()
            .name("files".to_owned())
            .spawn(work)?;
        Ok(Self { tasks })
    }

    /// Has a task done after those before.
    pub(super) fn order(&self, task: Task) -> Result<(), String> {
        let sent = self.tasks.send(task);
        sent.map_err(|_| "the thread that reads files has ended".to_owned())
    }
}

/// The next task; `None` at the end. One reading answers all that wait for it, and of a file that
/// changed while it was read only the next reading counts.
fn next(inbox: &Receiver<Task>, waiting: &mut VecDeque<Task>) -> Option<Task> {
    if waiting.is_empty() {
        waiting.push_back(inbox.recv().ok()?);
    }
    waiting.extend(inbox.try_iter());
    loop {
        let task = waiting.pop_front()?;
        let is_again = |later: &Task| match (&task, later) {
            (Task::Read(path, _) | Task::Understand(path, ..), Task::Read(again, _)) => {
                path == again
            }
            _ => false,
        };
        if !waiting.iter().any(is_again) {
            return Some(task);
        }
    }
}

fn perform(task: Task, waiting: &mut VecDeque<Task>, understanding: &Understanding) -> Option<Msg> {
    match task {
        Task::Read(path, known) => {
            let read = file::read_text(&path);
            // Unless the file has changed again by now.
            waiting.push_front(Task::Understand(path, read, known));
            None
        }
        Task::Free(unneeded) => {
            drop(unneeded);
            None
        }
        Task::Understand(path, read, known) => {
            let ordered = understanding.order(path, read, known);
            ordered.err().map(Msg::Failed)
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::document::Document;
    use crate::format::Format;
    use crate::scene::Meshes;

    fn known() -> Known {
        Known {
            scene: Document::new(Format::Ray, String::new()).snapshot(),
            meshes: Meshes::default(),
        }
    }

    #[test]
    fn a_file_that_is_waited_for_several_times_is_read_once() {
        let (tasks, inbox) = mpsc::channel();
        for name in ["a", "b", "a", "a", "b"] {
            let read = Task::Read(name.into(), known());
            tasks.send(read).expect("it is there");
        }
        drop(tasks);
        let mut waiting = VecDeque::new();
        let mut names = Vec::new();
        while let Some(Task::Read(path, _)) = next(&inbox, &mut waiting) {
            names.push(path);
        }
        assert_eq!(names, ["a", "b"].map(PathBuf::from));
    }

    #[test]
    fn a_file_that_changed_while_it_was_read_is_not_understood() {
        let (tasks, inbox) = mpsc::channel();
        let understand = |name: &str| Task::Understand(name.into(), Ok(String::new()), known());
        let read = Task::Read("a".into(), known());
        tasks.send(read).expect("it is there");
        drop(tasks);
        let mut waiting = VecDeque::from([understand("b"), understand("a")]);
        let mut left = std::iter::from_fn(|| next(&inbox, &mut waiting));
        assert!(matches!(left.next(), Some(Task::Understand(path, ..)) if path == Path::new("b")));
        assert!(matches!(left.next(), Some(Task::Read(path, _)) if path == Path::new("a")));
        assert!(left.next().is_none());
    }
}
