//! The scene's file: its path, how it relates to the text, and what is kept beside it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::journal::Journal;
use crate::msg::{Effect, Timer};
use crate::scene_reading::{Baseline, SceneFolder};
use crate::text_width::file_name;
use file::ReadError;
use language::Language;
use scene::Camera;
use text::Findings;

/// The scene's file, and the state of reading it.
#[derive(Debug, Default)]
pub struct Disk {
    /// The path of the scene; `None` for the embedded one until it is saved.
    pub path: Option<PathBuf>,
    /// How the file relates to the text.
    pub state: OnDisk,
    /// How far the scene's first text has been read.
    pub first: FirstReading,
    /// The state of waiting for a file that was read but could not be used.
    pub(crate) settle: Settle,
    /// Who requested the next reading of the file.
    pub(crate) requester: Requester,
    /// Another scene that is to replace this one, and the revision and the working view that may be
    /// given up for it.
    pub(crate) requested: Option<(PathBuf, GivenUp)>,
    /// Where the file was read last.
    pub(crate) place: Option<SceneFolder>,
    /// The last text without errors, while the current one has some.
    pub(crate) sound: Option<Arc<String>>,
    /// The saved text before a text was taken from the file while an input was open: what is typed is
    /// meant as a change of that.
    pub(crate) before_input: Option<Arc<String>>,
    /// The journal of unsaved edits.
    pub(crate) journal: Journal,
    /// The scenes on the page of recently used ones, the newest first.
    pub(crate) recent: Vec<PathBuf>,
}

/// How the file on disk relates to the text.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum OnDisk {
    /// It holds what was last read or written.
    #[default]
    Known,
    /// It holds something else; the user has to decide.
    Changed,
    /// It has errors, and is not taken until they are corrected because there are unsaved edits.
    Faulty(Faulty),
    /// It cannot be read.
    Unreadable,
    /// It does not exist any more.
    Missing,
    /// It has never existed: the text is a template, perhaps edited.
    New,
}

/// A file on disk with errors, kept apart from unsaved edits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Faulty {
    /// The content of the file.
    pub(crate) text: Arc<String>,
    /// Its errors and warnings.
    pub(crate) diagnostics: Findings,
}

/// How far the scene's first text has been read.
#[derive(Debug, Default)]
pub enum FirstReading {
    /// It is here.
    #[default]
    Done,
    /// It is being read from a file of this many bytes, and the text is empty.
    Pending(u64),
    /// It cannot be read: the program ends.
    Failed(ReadError),
}

/// The revision of the text and the working view when another scene was requested.
pub(crate) type GivenUp = (u64, Option<Camera>);

/// Who requested a reading of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Requester {
    /// The interface, because the file may have changed.
    #[default]
    Interface,
    /// The user, who gets an answer even if nothing has changed.
    User,
}

/// The state of waiting for a file that is being written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Settle {
    /// The file is not known to be changing.
    #[default]
    Idle,
    /// The file must remain unchanged for a while.
    Waiting,
    /// The next reading is accepted.
    Final,
}

impl Disk {
    /// Creates the initial state.
    pub(crate) fn new(path: Option<PathBuf>, state: OnDisk, first: FirstReading) -> Self {
        Self {
            path,
            state,
            first,
            ..Self::default()
        }
    }

    /// The scene's name on screen.
    pub fn name(&self) -> String {
        self.path
            .as_ref()
            .map_or_else(|| "(no file)".to_owned(), |path| file_name(path))
    }

    /// Whether the scene has not been read: there is nothing to show or to edit.
    pub fn is_opening(&self) -> bool {
        !matches!(self.first, FirstReading::Done)
    }

    /// Returns why the scene's first text could not be read, if that is so.
    pub fn take_failure(&mut self) -> Option<ReadError> {
        match std::mem::take(&mut self.first) {
            FirstReading::Failed(error) => Some(error),
            other => {
                self.first = other;
                None
            }
        }
    }

    /// Whether a path is the scene's, spelled with or without a leading `./`.
    pub(crate) fn is_own(&self, path: &Path) -> bool {
        let plain = |path| Path::strip_prefix(path, ".").unwrap_or(path);
        self.path.as_deref().map(plain) == Some(plain(path))
    }

    /// Reads the file, to be compared with `baseline`; no effect for a scene without a file, and
    /// while another scene is read, which that would supersede.
    pub(crate) fn read(&self, baseline: Baseline) -> Vec<Effect> {
        let path = self.path.clone().filter(|_| self.requested.is_none());
        let read = path.map(|path| Effect::Read(path, baseline));
        read.into_iter().collect()
    }

    /// Waits for the file to settle.
    pub(crate) fn wait(&mut self, time: Duration) -> Vec<Effect> {
        self.settle = Settle::Waiting;
        vec![Effect::Later(time, Timer::Settled)]
    }

    /// Requests another scene to replace this one, with what may be given up for it.
    pub(crate) fn request(&mut self, path: PathBuf, language: Language, now: GivenUp) -> Effect {
        self.requested = Some((path.clone(), now));
        Effect::Open(path, language)
    }

    /// Ends a request for this path; returns what may be given up.
    pub(crate) fn take_request(&mut self, path: &Path) -> Option<GivenUp> {
        let request = self.requested.take_if(|(requested, _)| requested == path);
        request.map(|(_, now)| now)
    }

    /// Turns to the file of another scene.
    pub(crate) fn replace(&mut self, path: Option<PathBuf>, state: OnDisk) {
        let journal = std::mem::take(&mut self.journal).renewed();
        *self = Self {
            journal,
            ..Self::new(path, state, FirstReading::Done)
        };
    }
}
