//! Everything that can happen to the interface, and everything it asks for.

use std::any::Any;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{KeyEvent, MouseEvent};

use super::reading::{Known, Reading};
use super::recovery::{Claim, Found, Sought};
use super::terminal::{ColourDepth, Mouse};
use crate::assets::{Loaded, Wanted};
use crate::document::Snapshot;
use crate::file::{ReadError, Version};
use crate::render::{Frame, Job};

/// Which picture a frame belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// The preview beside the list.
    Preview,
    /// The full-size trace of F5.
    Trace,
    /// An export in the background.
    Export,
}

/// Which of the session's exports: a file that is being written when its export is cancelled is
/// reported later.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExportId(pub u32);

/// Which of the session's saves, from 1; a later one is greater.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct SaveId(pub u32);

/// One event.
#[derive(Debug)]
pub enum Msg {
    /// A key was pressed.
    Key(KeyEvent),
    /// Text was pasted.
    Paste(String),
    /// The mouse did something over a cell.
    Mouse(MouseEvent),
    /// The terminal has a new size, in cells.
    Resize(u16, u16),
    /// A picture was begun; its generation.
    Started(Target, u64),
    /// A picture can't be begun; why.
    Refused(Target, String),
    /// A newer frame is there.
    Frame(Target, Arc<Frame>),
    /// The renderer of this picture has ended by itself: it panicked, or could not start threads.
    Ended(Target),
    /// Something happened to the scene file.
    FileChanged,
    /// The file of this name was read.
    Read(PathBuf, Result<Reading, ReadError>),
    /// The files that the scene names were read.
    AssetsRead(Wanted, Loaded),
    /// Something happened to one of their files.
    AssetsChanged,
    /// The time that [`Effect::Later`] asked for has passed.
    Elapsed(Timer),
    /// The scene was written, or not.
    Saved(SaveId, SaveOutcome),
    /// Copies of the scene's file from before interrupted saves.
    BackupsFound(Vec<PathBuf>),
    /// An export ended.
    Exported(ExportId, Result<Exported, String>),
    /// The external editor has ended.
    EditorClosed(Result<(), String>),
    /// Edits of an earlier run that were never saved were found.
    Recovered(Found),
    /// The text of this revision is kept for the next run; or why not.
    Kept(u64, Result<(), String>),
    /// Someone outside asks the process to stop for a while.
    Suspend,
    /// The process goes on after a stop.
    Continued,
    /// Someone outside interrupts the process.
    Interrupt,
    /// The process was asked to end.
    Terminate {
        /// The number of the signal that asked.
        signal: u8,
    },
    /// The terminal is gone.
    HangUp,
    /// The terminal shows fewer colours than pictures have, for all that is known; which.
    FewColours(ColourDepth),
    /// A worker panicked, or the world around failed otherwise; the message.
    Failed(String),
}

/// What a while was awaited for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timer {
    /// The scene file to be quiet.
    Settled,
    /// A second Ctrl-C.
    Interrupt,
    /// A second click.
    Click,
    /// More edits, which are kept together; or another try to keep them.
    Keep,
    /// Files that are being written.
    Writing,
}

/// What became of a save.
#[derive(Debug)]
pub enum SaveOutcome {
    /// The file holds this text now.
    Saved {
        /// Where.
        path: PathBuf,
        /// What.
        text: Arc<String>,
    },
    /// The file holds something that neither we wrote nor read: nothing was written.
    ChangedOnDisk,
    /// Nothing was written; why.
    Failed(String),
}

/// Something that touches the world.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Trace this picture from here on: [`Msg::Started`], [`Msg::Frame`]; or [`Msg::Refused`].
    Trace(Target, Job),
    /// Trace it no longer.
    Stop(Target),
    /// Write a frame to a picture file: [`Msg::Exported`].
    WriteImage(ExportId, Arc<Frame>, Destination),
    /// Say whether a picture can be written there, if not: [`Msg::Exported`].
    CheckTarget(ExportId, Destination),
    /// Read the scene file: [`Msg::Read`].
    Read(PathBuf, Known),
    /// Free what is no longer needed: of a large scene that takes longer than a key may wait.
    Free(Arc<dyn Any + Send + Sync>),
    /// Write the scene file: [`Msg::Saved`].
    Save {
        /// Which.
        id: SaveId,
        /// Where.
        path: PathBuf,
        /// What.
        text: Arc<String>,
        /// What may be overwritten.
        guard: Guard,
    },
    /// Say why no scene can be written there, if so: [`Msg::Failed`].
    CheckPlace(PathBuf),
    /// Say whether copies are left of what the file held before a save: [`Msg::BackupsFound`].
    FindBackups(PathBuf),
    /// Watch this file from here on: [`Msg::FileChanged`].
    Watch(PathBuf),
    /// Read the files that the scene names and watch them from here on: [`Msg::AssetsRead`],
    /// [`Msg::AssetsChanged`].
    ReadAssets(Wanted),
    /// Send [`Msg::Elapsed`] after a while; the same timer set again restarts.
    Later(Duration, Timer),
    /// Keep unsaved edits for the next run: [`Msg::Kept`].
    WriteRecovery {
        /// The scene; `None` is the one without a file.
        scene: Option<PathBuf>,
        /// The text that they started from, and the text under edit.
        known: Snapshot,
        /// The revision of the text under edit.
        revision: u64,
    },
    /// Forget what this run has kept for the next one.
    DropRecovery,
    /// Look for edits that an earlier run kept: [`Msg::Recovered`] if there are any.
    LookForKept(Sought),
    /// Forget what an earlier run kept once this run's edits are kept or forgotten.
    AdoptKept(Arc<Claim>),
    /// Forget what an earlier run kept.
    DropKept(Arc<Claim>),
    /// Lend the terminal to the user's editor, at a line: [`Msg::EditorClosed`].
    OpenEditor {
        /// The file.
        path: PathBuf,
        /// The line, from 1.
        line: usize,
    },
    /// Take the mouse or leave it to the terminal.
    SetMouse(Mouse),
    /// Redraw the whole screen.
    Repaint,
    /// Take the terminal back from the program that ran in between.
    TakeTerminal,
    /// Stop the process until it is continued.
    Suspend,
    /// End.
    Quit,
}

/// What a save may overwrite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Guard {
    /// A file that holds this text, or none.
    Holding(Arc<String>),
    /// None.
    Absent,
    /// Any.
    Anything,
}

/// Where a picture is to be written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Destination {
    /// The file.
    pub path: PathBuf,
    /// What becomes of a file that is there already.
    pub existing: Existing,
    /// The scene's own file, which no picture may replace.
    pub scene: Option<PathBuf>,
    /// The files that the scene names: no picture may replace them either.
    pub named: Vec<PathBuf>,
}

/// A picture that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// Where.
    pub path: PathBuf,
    /// The file as it was then; `None` for what is not a file.
    pub version: Option<Version>,
}

/// What becomes of a file that stands where a picture is to be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It stays, and nothing is written.
    Kept,
    /// The picture takes its place if it still is this version, which this session has written.
    Own(Version),
    /// The picture takes its place.
    Overwritten,
}
