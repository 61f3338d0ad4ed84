//! What the interface knows.

use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use tui_input::Input;

use super::assets::Assets;
use super::opening::Unread;
use super::picture::Picture;
use super::saving::Saves;
use crate::document::{Document, Merge, Side};
use crate::file::{ReadError, Version};
use crate::language::Node;
use crate::language::table::Field;
use crate::render::{Aov, Filter, Progress};
use crate::scene::{Camera, Images, Integrator, Meshes, Scene, Size};
use crate::text::{Diagnostic, Findings, Severity};
use crate::ui::keymap::Action;
use crate::ui::msg::{Destination, ExportId};
use crate::ui::reading::Place;
use crate::ui::recovery::{Claim, Offer, Since};
use crate::ui::terminal::Mouse;
use crate::ui::view::layout::Zoom;

/// What keys mean; the status line always shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mode {
    /// Choosing a thing in the list or in the picture.
    Select,
    /// Moving the camera.
    View,
    /// Changing the selected thing's fields.
    Edit,
    /// Watching the full-size trace.
    Trace,
    /// Moving a cross over the picture to pick what lies under it.
    Pick,
}

/// The interface's whole state.
#[derive(Debug)]
pub struct App {
    /// Where the scene is read from and saved to; `None` for the embedded one until it is saved.
    pub path: Option<PathBuf>,
    /// The text.
    pub document: Document,
    /// The scene is yet to be read, and the text empty.
    pub unread: Option<Unread>,
    /// Why it could not be read: the program ends.
    pub unreadable: Option<ReadError>,
    /// What is wrong with the text as it stands.
    pub diagnostics: Findings,
    /// The scene of the last text that had no errors: what the pictures show.
    pub scene: Option<Arc<Scene>>,
    /// The pictures that its textures show, as far as they are read.
    pub images: Images,
    /// The meshes of its objects, as far as they are read.
    pub meshes: Meshes,
    /// The working view, where it differs from the scene's camera.
    pub view: Option<Camera>,
    /// How pictures are traced, as far as the user says so.
    pub quality: Quality,
    /// What pictures show instead of light.
    pub aov: Option<Aov>,
    /// What keys mean.
    pub mode: Mode,
    /// How much of the screen the picture takes, outside of the full-size trace.
    pub zoom: Zoom,
    /// The selected thing.
    pub selected: Node,
    /// The first row of the list that is shown.
    pub list_top: usize,
    /// The selected field of the selected thing.
    pub field: usize,
    /// The first field that is shown.
    pub field_top: usize,
    /// The selected component of that field.
    pub component: usize,
    /// How far one nudge goes.
    pub stride: Stride,
    /// A value being typed.
    pub typing: Option<Typing>,
    /// A line being typed at the bottom.
    pub prompt: Option<Prompt>,
    /// What was last searched for in the list.
    pub searched: String,
    /// A question that must be answered first.
    pub dialog: Option<Dialog>,
    /// The help page.
    pub help: Option<Help>,
    /// The list of diagnostics has the keys, with the cursor on this one. Errors are shown even
    /// without.
    pub errors: Option<usize>,
    /// The last thing worth saying.
    pub message: Option<Message>,
    /// What was shown before a key took it away.
    pub past_message: Option<Message>,
    /// How the file on disk stands to the text.
    pub disk: Disk,
    /// What is wrong with the file on disk while it is [`Disk::Broken`].
    pub broken: Option<Broken>,
    /// Whether the selected object's outline is marked while choosing.
    pub outline: Outline,
    /// The cell of the picture that the cross of [`Mode::Pick`] is on, from its upper left corner.
    pub cross: (u16, u16),
    /// The preview.
    pub preview: Picture,
    /// The full-size trace, once it was asked for.
    pub trace: Option<Picture>,
    /// The export under way.
    pub export: Option<Export>,
    /// Bytes sent to the terminal during the last second, while a picture waits for a slow link.
    pub net: Option<usize>,
    /// Who has the mouse.
    pub mouse: Mouse,
    /// Size of the terminal in cells.
    pub terminal: (u16, u16),
    /// How the files that the scene names stand.
    pub(super) assets: Assets,
    /// The saves under way.
    pub(super) saves: Saves,
    /// What a sequence of messages has led to so far.
    pub(super) pending: Pending,
}

/// How pictures are traced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Quality {
    /// Samples a pixel of the full-size trace and of exports.
    pub spp: u32,
    /// Bounces; the integrator's [`default_depth`](crate::render::default_depth) if `None`.
    pub depth: Option<u32>,
    /// How light is gathered; the scene says so if `None`.
    pub integrator: Option<Integrator>,
    /// What pixels of the full-size trace and of exports are filtered by.
    pub filter: Filter,
}

/// How far one nudge goes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Stride {
    /// A tenth of the field's step.
    Fine,
    /// The field's step.
    #[default]
    Plain,
    /// Ten steps.
    Coarse,
}

/// Whether the selected object is marked in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Outline {
    /// While choosing.
    #[default]
    Marked,
    /// Never.
    Hidden,
}

/// A value being typed into a component.
#[derive(Debug, Default)]
pub struct Typing {
    /// The line.
    pub input: Input,
    /// Why the last try was refused: the parser's own message.
    pub refused: Option<Diagnostic>,
}

/// A line being typed at the bottom.
#[derive(Debug)]
pub struct Prompt {
    /// What it is for.
    pub kind: PromptKind,
    /// The line.
    pub input: Input,
}

/// What a prompt's line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PromptKind {
    /// A command, after `:`.
    Command,
    /// A part of a name to jump to, after `/`.
    Search,
}

/// A question.
#[derive(Debug)]
pub enum Dialog {
    /// Quit though edits are unsaved or an export is under way?
    Quit,
    /// The text under edit and another one changed the same places.
    Conflict {
        /// What to decide.
        merge: Merge,
        /// The conflict the cursor is on.
        at: usize,
        /// Where the other text comes from.
        from: Outside,
    },
    /// The edits of an earlier run that were never saved: take them?
    Recover(Box<Offer>),
}

/// Where a text comes from that is merged with the one under edit.
#[derive(Clone, Debug)]
pub enum Outside {
    /// The scene's file.
    File,
    /// A journal.
    Kept(Arc<Claim>, Since),
}

impl Outside {
    /// The side of the user's own unsaved edits.
    pub fn mine(&self) -> Side {
        match self {
            Self::File => Side::Mine,
            Self::Kept(..) => Side::Theirs,
        }
    }
}

/// The help page.
#[derive(Debug, Default)]
pub struct Help {
    /// The first line shown; at most [`crate::ui::keymap::help`]'s last.
    pub top: usize,
    /// Only lines that hold this are shown.
    pub search: Input,
    /// Whether keys are typed into the search.
    pub focus: HelpFocus,
}

/// What keys do on the help page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum HelpFocus {
    /// They scroll.
    #[default]
    Lines,
    /// They are typed into the search.
    Search,
}

/// Something worth saying.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// `None` for success.
    pub severity: Option<Severity>,
    /// What.
    pub text: String,
}

/// How the file on disk stands to the text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Disk {
    /// It holds what was last read or written.
    #[default]
    Known,
    /// It holds something else, which waits for a decision.
    Changed,
    /// It holds something with errors, which waits until it has none because there are unsaved
    /// edits.
    Broken,
    /// It is not there.
    Missing,
}

/// A file on disk with errors that unsaved edits are kept apart from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Broken {
    /// What it holds.
    pub text: Arc<String>,
    /// What is wrong with it.
    pub diagnostics: Findings,
}

/// An export under way.
#[derive(Debug)]
pub struct Export {
    /// Which.
    pub id: ExportId,
    /// What is being done.
    pub stage: Stage,
    /// Where to.
    pub destination: Destination,
    /// How large.
    pub size: Size,
    /// Samples a pixel.
    pub spp: u32,
    /// What it shows instead of light.
    pub aov: Option<Aov>,
    /// How far.
    pub progress: Option<Progress>,
    /// Seconds since its file began to be written.
    pub written_for: u32,
}

/// What an export is at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Its picture is traced.
    Tracing,
    /// Its file is written, which nothing stops.
    Writing,
}

/// A field of the selected thing as it is shown: see [`App::fields`].
#[derive(Clone, Debug, PartialEq)]
pub struct FieldRow {
    /// What it is.
    pub field: &'static Field,
    /// One literal a component.
    pub literals: Vec<String>,
    /// Where each of them comes from.
    pub sources: Vec<Provenance>,
}

impl FieldRow {
    /// Whether all its literals come from there.
    pub fn is_all(&self, source: Provenance) -> bool {
        self.sources.iter().all(|&of| of == source)
    }
}

/// Where a literal of a field comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// It stands in the text.
    Text,
    /// The text does not say it.
    Default,
    /// It is the working view's, which differs from the text's there.
    WorkingView,
}

/// What a sequence of messages has led to so far.
#[derive(Debug, Default)]
pub(super) struct Pending {
    /// The first key of two, until the second one comes.
    pub(super) prefix: Option<Action>,
    /// Ctrl-C was pressed a moment ago.
    pub(super) interrupt: bool,
    /// The file was read and could not be used as it was.
    pub(super) settle: Settle,
    /// The program ends once the text is saved and the export written.
    pub(super) quit: bool,
    /// Who wants the file to be read.
    pub(super) reader: Reader,
    /// Where the file was read last.
    pub(super) place: Option<Place>,
    /// The last text without errors, while the text has some.
    pub(super) sound: Option<Arc<String>>,
    /// What is kept for the next run.
    pub(super) keeping: Keeping,
    /// Edits of an earlier run, to be asked about once nothing else is asked.
    pub(super) offer: Option<Box<Offer>>,
    /// The journals that the user decides about another time.
    pub(super) put_off: Vec<String>,
    /// What was said to be wrong with journals.
    pub(super) complaints: Vec<String>,
    /// The export that was begun last.
    pub(super) export: ExportId,
    /// The pictures written so far, by their paths: as long as they are unchanged they may be
    /// overwritten.
    pub(super) written: HashMap<PathBuf, Version>,
    /// The scene or the view changed: pictures are to be traced again.
    pub(super) scene: bool,
    /// The component that was clicked a moment ago.
    pub(super) click: Option<(usize, usize)>,
    /// Where the pointer was when the camera was last dragged.
    pub(super) drag: Option<(u16, u16)>,
    /// The mode to go back to from the full-size trace.
    pub(super) before_trace: Option<Mode>,
}

/// What is kept for the next run, and whether that is to change.
#[derive(Debug, Default)]
pub(super) struct Keeping {
    /// The revision of the document whose text is kept.
    pub(super) revision: Option<u64>,
    /// The revision whose text is being written down.
    pub(super) ordered: Option<u64>,
    /// What the timer runs for.
    pub(super) awaits: Await,
    /// Why the last try failed, and how long the next one was put off.
    pub(super) trouble: Option<(Duration, String)>,
}

/// What the timer of kept edits runs for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Await {
    /// It does not.
    #[default]
    Nothing,
    /// Edits are to be kept in a moment.
    Edits,
    /// Another try for this revision.
    Retry(u64),
}

/// Who wants the file to be read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Reader {
    /// The interface, because it may have changed.
    #[default]
    Interface,
    /// The user, who gets an answer even if nothing changed.
    User,
}

/// How far the wait for a file that is being written has come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Settle {
    /// Nothing is awaited.
    #[default]
    Idle,
    /// The file is to be quiet for a while.
    Waiting,
    /// What is read next counts.
    Final,
}
