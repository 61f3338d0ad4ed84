//! Messages, which report everything that happens to the interface, and effects, which request
//! everything that it does.

use std::any::Any;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use crossterm::event::{KeyEvent, MouseEvent};

use super::arrange::PanelSizes;
use super::history_scene::{HistoryScene, HistoryText, NoPicture};
use super::located::{Located, Search};
use super::recovery::{Claim, Found, Sought};
use super::reel::{Reel, ReelProgress};
use super::reference::{Pair, ReferenceId, ReferenceRead, ReferenceSource};
use super::scene_reading::{Baseline, Opened, Reading};
use super::terminal::{ColourDepth, Mouse};
use assets::{Loaded, Wanted};
use compare::Comparison;
use document::Snapshot;
use file::{ReadError, Version};
use language::Language;
use link::{Abilities, Follow, ToEditor};
use render::{Explanation, Frame, Job};
use scene::Viewpoint;

/// The picture that a frame belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Target {
    /// The preview beside the list.
    Preview,
    /// The full-size trace.
    Trace,
    /// An export, traced in the background.
    Export,
    /// The picture that is compared with the reference, traced as that was.
    Compared,
    /// The scene that pictures are compared with.
    Reference,
    /// A picture on the page of the undo history, traced in the background.
    Thumbnail,
    /// A small picture by which a cure of the preview is tried, traced in the background.
    Trial,
}

/// What is to be explained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question {
    /// The picture.
    pub target: Target,
    /// The generation of its frames.
    pub generation: u64,
    /// Column and row of the pixel.
    pub pixel: [u32; 2],
    /// The index of the sample.
    pub sample: u32,
}

/// Identifies an export of the session. If an export is cancelled while its file is being written,
/// that file is still reported later.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ExportId(pub u32);

/// Identifies a save of the session; starts at 1 and increases.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct SaveId(pub u32);

/// Everything that can change the state: input, results of effects, timers, signals.
#[derive(Debug)]
pub enum Msg {
    /// A key was pressed.
    Key(KeyEvent),
    /// Text was pasted, possibly of several lines.
    Paste(String),
    /// A mouse event over a cell.
    Mouse(MouseEvent),
    /// The new size of the terminal, in cells.
    Resize(u16, u16),
    /// Rendering has started; the generation of the picture.
    Started(Target, u64),
    /// Rendering cannot start; the reason.
    Refused(Target, String),
    /// A newer frame is available.
    Frame(Target, Arc<Frame>),
    /// The renderer of this picture has ended unexpectedly: it panicked or could not start threads.
    Ended(Target),
    /// The result of [`Effect::Explain`]; `None` if the picture has been replaced.
    Explained(Question, Option<Box<Explanation>>),
    /// The result of [`Effect::Locate`], by its ticket; `None` if there is too little memory.
    Located(u64, Option<Box<Located>>),
    /// The scene file may have changed.
    FileChanged,
    /// The system cannot notify of all changes of these files, for this reason, and they are polled;
    /// `None`: it can, or they are no longer watched.
    Polled(Polled, Option<String>),
    /// The result of [`Effect::Read`] for this path.
    Read(PathBuf, Result<Reading, ReadError>),
    /// The result of [`Effect::Open`] for this path.
    Opened(PathBuf, Result<Opened, ReadError>),
    /// The result of [`Effect::Recall`], if an earlier run left something.
    Recalled(Recalled),
    /// The result of [`Effect::Derive`], by its ticket.
    Derived(u64, Result<HistoryScene, NoPicture>),
    /// The result of [`Effect::ReadAssets`].
    AssetsRead(Wanted, Loaded),
    /// A file that the scene names may have changed.
    AssetsChanged,
    /// Cells hold another number of pixels.
    Grid {
        /// Pixels side by side.
        across: u16,
        /// Pixels one above the other.
        down: u16,
    },
    /// The delay set by [`Effect::Later`] has elapsed.
    Elapsed(Timer),
    /// The result of [`Effect::Save`].
    Saved(SaveId, SaveOutcome),
    /// Backups of the scene file left by interrupted saves.
    BackupsFound(Vec<PathBuf>),
    /// The result of an export.
    Exported(ExportId, Result<Exported, String>),
    /// How far the export of a sequence is.
    Filmed(ExportId, ReelProgress),
    /// A picture of a sequence was written.
    FrameExported(Exported),
    /// The file of an export exists, and this session did not write it; the reason why it is kept.
    Taken(ExportId, String),
    /// The result of [`Effect::ListFolder`]: the names in the folder, sorted; those of folders end
    /// in `/`.
    Listed(PathBuf, Vec<String>),
    /// The result of [`Effect::ReadReference`], or the reason why there is none.
    ReferenceRead(ReferenceId, Result<ReferenceRead, String>),
    /// The result of [`Effect::Compare`]; `None` for pictures of different sizes.
    Compared(Pair, Option<Arc<Comparison>>),
    /// The result of [`Effect::ReadTrack`] for this path; no text if there is no such file.
    TrackRead(PathBuf, Result<Option<String>, ReadError>),
    /// The track file read last may have changed.
    TrackChanged,
    /// The result of [`Effect::WriteTrack`].
    TrackWritten(SaveOutcome),
    /// Something happened to the buffer that an editor has of the scene.
    Buffer(BufferNews),
    /// The external editor has ended.
    EditorClosed(Result<(), String>),
    /// The result of [`Effect::ListRecent`].
    RecentListed(Vec<PathBuf>),
    /// Unsaved edits of an earlier run were found.
    Recovered(Found),
    /// The text of this revision was stored for recovery, or the reason why not.
    Kept(u64, Result<(), String>),
    /// The process received a request to stop until continued.
    Suspend,
    /// The process was continued.
    Continued,
    /// The process was interrupted by a signal.
    Interrupt,
    /// The process received a signal that requests its end.
    Terminate {
        /// The signal's number, such as 15 for SIGTERM.
        signal: u8,
    },
    /// The terminal is gone.
    HangUp,
    /// The terminal appears to show fewer colours than pictures need; the detected depth.
    FewColours(ColourDepth),
    /// A worker panicked, or the environment failed in another way; the message.
    Failed(String),
}

/// What happens to the buffer that an editor has of the scene. Changes of its text are reported as those
/// of the file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum BufferNews {
    /// It is open from now on, or followed at another time.
    Opened {
        /// The short name of the editor.
        editor: String,
        /// What the editor can be asked for.
        can: Abilities,
        /// Whether its text is the outside text, rather than that of the file.
        is_followed: bool,
        /// Whether it differs from the file.
        is_changed: bool,
    },
    /// It was written to the file.
    Saved,
    /// It was closed: the file is the outside text again.
    Closed,
    /// The editor is gone without having closed it.
    Left,
    /// The editor's cursor is elsewhere.
    Cursor {
        /// The offset in the text, in bytes.
        at: usize,
        /// The version of that text.
        version: u64,
    },
    /// The editor has answered a request for edits.
    Answered {
        /// The version that they were edits of.
        base: u64,
        /// Whether it says that it made them.
        is_made: bool,
        /// The version of the buffer when the answer came.
        version: u64,
    },
}

/// Purpose of a timer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Timer {
    /// The scene file has not changed for a while.
    Settled,
    /// The time for a second Ctrl-C.
    Interrupt,
    /// The time for a second click.
    Click,
    /// Collects further edits before storing them for recovery, or retries after a failure.
    Keep,
    /// Files that are being written.
    Writing,
    /// The time of a frame of a track that plays.
    Frame,
    /// The time to read a message while another waits.
    Message,
    /// Collects further edits before sending them to an editor's buffer, or limits the wait for its answer.
    Push,
    /// The time for a step of a lesson before its hint.
    Lesson,
}

/// Result of a save.
#[derive(Debug)]
pub enum SaveOutcome {
    /// The file now holds this text.
    Saved {
        /// Path of the file.
        path: PathBuf,
        /// The text that was written, now the file's content.
        text: Arc<String>,
    },
    /// The file holds text that this session neither wrote nor read: nothing was written.
    ChangedOnDisk,
    /// The file's folder does not exist: nothing was written; says so.
    NoFolder(String),
    /// Nothing was written; the reason.
    Failed(String),
}

/// Files that are watched together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Polled {
    /// The scene's file.
    Scene,
    /// The files that the scene names.
    Assets,
    /// The track file.
    Track,
}

/// A side effect requested by a step.
#[derive(Clone, Debug)]
pub enum Effect {
    /// Starts tracing this picture, reported by [`Msg::Started`] and [`Msg::Frame`], or by
    /// [`Msg::Refused`].
    Trace(Target, Job),
    /// Starts the full-size trace from what an earlier run left of it, or a render of the picture with
    /// this path, reported by [`Msg::Recalled`], and otherwise as [`Effect::Trace`].
    Recall(Job, Origin, PathBuf),
    /// Stops tracing this picture and forgets it.
    Stop(Target),
    /// Explains a sample of a pixel of this frame, reported by [`Msg::Explained`] unless another
    /// question follows at once.
    Explain(Question, Arc<Frame>),
    /// Locates something in the picture, reported by [`Msg::Located`] unless another search follows at once.
    Locate(Box<Search>),
    /// Stops tracing this picture; [`Effect::Trace`] of the same continues it.
    Halt(Target),
    /// Pauses the tracing of this picture until [`Effect::Resume`] or [`Effect::Trace`].
    Pause(Target),
    /// Continues a paused picture.
    Resume(Target),
    /// Derives the scene of a text of the history, reported by [`Msg::Derived`].
    Derive(Box<HistoryText>),
    /// Writes a frame to a picture file, reported by [`Msg::Exported`] or
    /// [`Msg::Taken`].
    WriteImage(ExportId, Arc<Frame>, Destination),
    /// Traces and writes a sequence, reported by [`Msg::Filmed`] and [`Msg::Exported`], or by
    /// [`Msg::Taken`]. [`Effect::Stop`] of [`Target::Export`] cancels it.
    Film(ExportId, Box<Reel>, Destination),
    /// Checks whether a picture can be written there; a failure is reported by [`Msg::Exported`]
    /// or [`Msg::Taken`].
    CheckTarget(ExportId, Destination),
    /// Reads the scene file, reported by [`Msg::Read`].
    Read(PathBuf, Baseline),
    /// Reads another scene, which is to replace this one; reported by [`Msg::Opened`].
    Open(PathBuf, Language),
    /// Frees a value on another thread: for a large scene this takes longer than a key may wait.
    Free(Arc<dyn Any + Send + Sync>),
    /// Writes the scene file, reported by [`Msg::Saved`].
    Save {
        /// Repeated in [`Msg::Saved`].
        id: SaveId,
        /// Path of the file.
        path: PathBuf,
        /// The text to write.
        text: Arc<String>,
        /// What may be overwritten.
        guard: Guard,
    },
    /// Checks whether a scene can be written there; a failure is reported by [`Msg::Failed`].
    CheckPlace(PathBuf),
    /// Looks for backups left by an interrupted save, reported by [`Msg::BackupsFound`].
    FindBackups(PathBuf),
    /// Remembers a scene as the one used last.
    NoteRecent(PathBuf),
    /// Lists recently used scenes that still exist, reported by [`Msg::RecentListed`].
    ListRecent,
    /// Keeps the sizes of the panels for other sessions.
    KeepPanels(PanelSizes),
    /// Keeps where a lesson is for other sessions.
    KeepLesson(String),
    /// Lists a folder, reported by [`Msg::Listed`].
    ListFolder(PathBuf),
    /// Watches this file from now on, reported by [`Msg::FileChanged`].
    Watch(PathBuf),
    /// Reads the files that the scene names and watches them from now on, reported by
    /// [`Msg::AssetsRead`] and [`Msg::AssetsChanged`].
    ReadAssets(Wanted),
    /// Reads what pictures are to be compared with, reported by [`Msg::ReferenceRead`].
    ReadReference(ReferenceId, ReferenceSource),
    /// Measures how pictures differ, reported by [`Msg::Compared`].
    Compare(Pair),
    /// Reads a track file, reported by [`Msg::TrackRead`], and watches it from now on instead of the
    /// one before, reported by [`Msg::TrackChanged`].
    ReadTrack(PathBuf),
    /// Writes a track file, reported by [`Msg::TrackWritten`].
    WriteTrack {
        /// Path of the file.
        path: PathBuf,
        /// The text to write.
        text: Arc<String>,
        /// What may be overwritten.
        guard: Guard,
    },
    /// Sends [`Msg::Elapsed`] after a delay. Setting the same timer again restarts it.
    Later(Duration, Timer),
    /// Stores unsaved edits for recovery, reported by [`Msg::Kept`].
    WriteRecovery {
        /// Path of the scene; `None` for a scene without a file.
        scene: Option<PathBuf>,
        /// The text under edit and the saved text that it derives from.
        known: Snapshot,
        /// Revision of the text under edit.
        revision: u64,
    },
    /// Deletes the recovery data of this run.
    DropRecovery,
    /// Looks for unsaved edits of an earlier run, reported by [`Msg::Recovered`] if there are any.
    LookForKept(Sought),
    /// Deletes the recovery data of an earlier run once the edits of this run are stored or
    /// discarded.
    AdoptKept(Arc<Claim>),
    /// Deletes the recovery data of an earlier run.
    DropKept(Arc<Claim>),
    /// Lends the terminal to the user's editor, reported by [`Msg::EditorClosed`].
    OpenEditor {
        /// Path of the file to open.
        path: PathBuf,
        /// Line number, from 1.
        line: usize,
    },
    /// Sends a message to the editor that has the scene open.
    Tell(ToEditor),
    /// Forgets the buffer of an editor that is gone.
    ForgetBuffer,
    /// Follows editors' buffers at another time.
    FollowBuffers(Follow),
    /// Offers text to the terminal's clipboard (OSC 52), which may ignore it.
    CopyText(String),
    /// Takes the mouse or leaves it to the terminal.
    SetMouse(Mouse),
    /// Redraws the whole screen.
    Repaint,
    /// Takes the terminal back from another program.
    TakeTerminal,
    /// Stops the process until it is continued.
    Suspend,
    /// Ends the session; running saves and exports are awaited for a limited time.
    Quit,
}

/// What a save may overwrite.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Guard {
    /// A file with this text; a missing file is created.
    Holding(Arc<String>),
    /// Nothing: the file must not exist.
    Absent,
    /// Whatever the file holds, or nothing.
    Anything,
}

/// Destination of a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Destination {
    /// Path of the file.
    pub path: PathBuf,
    /// How an existing file is treated.
    pub existing: Existing,
    /// The scene's own file, which no picture may replace.
    pub scene: Option<PathBuf>,
    /// The files that the scene names, which no picture may replace either.
    pub named: Vec<PathBuf>,
    /// What the picture is made from, if its file says that and there is such a text.
    pub origin: Option<Origin>,
}

/// What a picture is made from, apart from the settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Origin {
    /// The text of the scene.
    pub text: Arc<String>,
    /// The paths of the files that were read for it, by name.
    pub found: BTreeMap<String, PathBuf>,
    /// What the working view replaces.
    pub view: Viewpoint,
}

/// What an earlier run left of a full-size trace.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Recalled {
    /// As many samples per pixel, from which it is continued.
    Continued(u32),
    /// More samples than it is to have: as many of those that are kept would be needed.
    More(u32),
    /// Nothing that can be read; the reason.
    Unreadable(String),
}

/// A picture that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Exported {
    /// Path of the file.
    pub path: PathBuf,
    /// Version of the file after writing; `None` for anything other than a regular file.
    pub version: Option<Version>,
}

/// How an existing file at the destination of a picture is treated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It is kept, and nothing is written.
    Kept,
    /// It is replaced if it still has this version, which this session wrote.
    Own(Version),
    /// It is replaced, whoever wrote it.
    Overwritten,
    /// It is kept, and the first free number is added to the name: `scene-2.bmp`.
    Numbered,
}
