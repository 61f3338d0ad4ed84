//! The state of SEQUENCE: the track over the scene, and the frame that is looked at.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::text_width::file_name;
use text::{Findings, Position};
use track::{Bound, Track};

/// Frames per second of a track that does not say how many.
const RATE: u32 = 24;

/// What SEQUENCE plays.
#[derive(Debug, Default)]
pub struct Sequence {
    /// The track that is open.
    pub open: Option<OpenTrack>,
    /// The track file that is being read in order to be opened.
    pub(crate) asked: Option<PathBuf>,
    /// The file that cannot be read or played, as long as it cannot.
    pub(crate) wrong: Option<PathBuf>,
    /// The text's revision when that file was read last.
    pub(crate) judged: u64,
    /// The text being written to the track file, and what to say once it is.
    pub(crate) writing: Option<(Arc<String>, String)>,
}

/// A track, and the frame that is looked at.
#[derive(Debug)]
pub struct OpenTrack {
    /// Path of its file.
    pub path: PathBuf,
    /// The text of the file, as read or written last; `None` as long as there is no file.
    pub(crate) held: Option<Arc<String>>,
    /// Whether the file holds by now what cannot be played.
    pub is_refused: bool,
    /// What the text says.
    pub track: Track,
    /// The number of the frame.
    pub frame: u32,
    /// Whether the frames follow each other by themselves.
    pub is_playing: bool,
    /// The track in the text without the frame; `None` until a frame is shown.
    pub(crate) bound: Option<Bound>,
    /// The texts before each key written, the newest last.
    pub(crate) before: Vec<Arc<String>>,
}

impl Sequence {
    /// The open track, if it is this file.
    pub(crate) fn open_at(&mut self, path: &Path) -> Option<&mut OpenTrack> {
        self.open.as_mut().filter(|open| open.path == path)
    }
}

impl OpenTrack {
    /// The name of its file.
    pub fn name(&self) -> String {
        file_name(&self.path)
    }

    /// The number of the last frame.
    pub fn last(&self) -> u32 {
        self.track.frames.saturating_sub(1)
    }

    /// Frames per second.
    pub fn rate(&self) -> u32 {
        self.track.rate.unwrap_or(RATE)
    }

    /// The time of a frame.
    pub(crate) fn period(&self) -> Duration {
        Duration::from_secs(1) / self.rate()
    }

    /// The frame some frames on; the last one is followed by the first while it plays, and by none
    /// otherwise.
    pub(crate) fn frame_after(&self, frames: i32) -> u32 {
        let next = i64::from(self.frame) + i64::from(frames);
        if self.is_playing {
            next.rem_euclid(i64::from(self.last()) + 1) as u32
        } else {
            next.clamp(0, i64::from(self.last())) as u32
        }
    }

    /// The next frame with a key.
    pub(super) fn next_key(&self) -> Option<u32> {
        self.keys().filter(|&frame| self.frame < frame).min()
    }

    /// The previous frame with a key.
    pub(super) fn previous_key(&self) -> Option<u32> {
        self.keys().filter(|&frame| frame < self.frame).max()
    }

    fn keys(&self) -> impl Iterator<Item = u32> {
        let frames = self.track.rows().flat_map(|(_, frames)| frames);
        frames.filter(|&frame| frame <= self.last())
    }
}

/// The first error in a track file in a line, and how many more there are.
pub(super) fn complaint(name: &str, text: &str, findings: &Findings) -> String {
    let Some(error) = findings.first_error() else {
        return String::new();
    };
    let Position { line, column } = Position::of(text, error.span.start());
    let hint = error.hint.as_ref().map(|hint| format!("; {hint}"));
    let more = match findings.errors() - 1 {
        0 => String::new(),
        more => format!(" (and {more} more)"),
    };
    format!(
        "{name}:{line}:{column}: {}: expected {}{}{more}",
        error.message,
        error.expected,
        hint.unwrap_or_default(),
    )
}
