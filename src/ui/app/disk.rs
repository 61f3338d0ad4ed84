//! The scene's file: its path, how it relates to the text, and what is kept beside it.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::journal::Journal;
use crate::file::ReadError;
use crate::text::Findings;
use crate::ui::msg::{Effect, Timer};
use crate::ui::reading::{Baseline, Place};

/// The scene's file, and the state of reading it.
#[derive(Debug, Default)]
pub struct Disk {
    /// The path of the scene; `None` for the embedded one until it is saved.
    pub path: Option<PathBuf>,
    /// How the file relates to the text.
    pub state: OnDisk,
    /// The file's content and errors while it is [`OnDisk::Broken`].
    pub(super) broken: Option<Broken>,
    /// Set until the scene is read; the text is empty meanwhile.
    pub unread: Option<Unread>,
    /// Why the scene could not be read: the program ends.
    pub unreadable: Option<ReadError>,
    /// The state of waiting for a file that was read but could not be used.
    settle: Settle,
    /// Who requested the next reading of the file.
    reader: Reader,
    /// Where the file was read last.
    place: Option<Place>,
    /// The last text without errors, while the current one has some.
    pub(super) sound: Option<Arc<String>>,
    /// The journal of unsaved edits.
    pub(super) journal: Journal,
}

/// How the file on disk relates to the text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OnDisk {
    /// It holds what was last read or written.
    #[default]
    Known,
    /// It holds something else; the user has to decide.
    Changed,
    /// It cannot be read, or it has errors and is not taken until they are corrected, because there
    /// are unsaved edits.
    Broken,
    /// It does not exist.
    Missing,
}

/// A file on disk with errors, kept apart from unsaved edits.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Broken {
    /// The content of the file.
    pub(super) text: Arc<String>,
    /// Its errors and warnings.
    pub(super) diagnostics: Findings,
}

/// A scene that is being read for the first time.
#[derive(Debug)]
pub struct Unread {
    /// Length of its file in bytes.
    pub bytes: u64,
}

/// Who requested a reading of the file.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Reader {
    /// The interface, because the file may have changed.
    #[default]
    Interface,
    /// The user, who gets an answer even if nothing has changed.
    User,
}

/// The state of waiting for a file that is being written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Settle {
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
    pub(super) fn new(path: Option<PathBuf>, state: OnDisk, unread: Option<Unread>) -> Self {
        Self {
            path,
            state,
            unread,
            ..Self::default()
        }
    }

    /// The scene's name on screen.
    pub fn name(&self) -> String {
        self.path.as_ref().map_or_else(
            || "(no file)".to_owned(),
            |path| {
                let name = path.file_name().unwrap_or(path.as_os_str());
                name.to_string_lossy().into_owned()
            },
        )
    }

    /// Whether the scene is still being read: there is nothing to show or to edit.
    pub fn is_opening(&self) -> bool {
        self.unread.is_some()
    }

    /// Whether a path is the scene's, spelled with or without a leading `./`.
    pub(super) fn is_own(&self, path: &Path) -> bool {
        let plain = |path| Path::strip_prefix(path, ".").unwrap_or(path);
        self.path.as_deref().map(plain) == Some(plain(path))
    }

    /// Reads the file, to be compared with `baseline`; no effect for a scene without a file.
    pub(super) fn read(&self, baseline: Baseline) -> Vec<Effect> {
        let path = self.path.clone();
        let read = path.map(|path| Effect::Read(path, baseline));
        read.into_iter().collect()
    }

    /// Reads the file, which may have to settle again.
    pub(super) fn read_again(&mut self, baseline: Baseline) -> Vec<Effect> {
        self.settle = Settle::Idle;
        self.read(baseline)
    }

    /// Reads the file and accepts what it holds.
    pub(super) fn read_finally(&mut self, baseline: Baseline) -> Vec<Effect> {
        self.settle = Settle::Final;
        self.read(baseline)
    }

    /// Makes the next reading answer the user.
    pub(super) fn answer_user(&mut self) {
        self.reader = Reader::User;
    }

    /// Returns who requested this reading.
    pub(super) fn take_reader(&mut self) -> Reader {
        std::mem::take(&mut self.reader)
    }

    /// Waits for the file to settle.
    pub(super) fn wait(&mut self, time: Duration) -> Vec<Effect> {
        self.settle = Settle::Waiting;
        vec![Effect::Later(time, Timer::Settled)]
    }

    /// Whether the file is still settling.
    pub(super) fn is_waiting(&self) -> bool {
        self.settle == Settle::Waiting
    }

    /// Ends the wait, and returns how far the file had settled.
    pub(super) fn take_settle(&mut self) -> Settle {
        std::mem::take(&mut self.settle)
    }

    /// Sets the file's state and forgets its errors.
    pub(super) fn set_state(&mut self, state: OnDisk) {
        self.state = state;
        self.broken = None;
    }

    /// Records where the file was read and returns the previous place.
    pub(super) fn move_to(&mut self, place: Place) -> Option<Place> {
        self.place.replace(place)
    }

    /// Records that the scene has another file.
    pub(super) fn rename(&mut self, path: PathBuf) {
        self.path = Some(path);
        self.place = None;
    }
}
