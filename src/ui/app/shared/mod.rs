//! What all modes share: the text, its meaning, and one part for each concern.

pub(crate) mod after_leaving;
pub(crate) mod assets;
pub(crate) mod buffer;
pub(crate) mod change;
pub(crate) mod cursor;
pub(crate) mod disk;
pub(crate) mod field_row;
pub(crate) mod filter;
pub(crate) mod inspection;
pub(crate) mod jobs;
pub(crate) mod journal;
pub(crate) mod line;
pub(crate) mod live_edit;
pub(crate) mod menu;
pub(crate) mod messages;
pub(crate) mod overlays;
pub(crate) mod page;
pub(crate) mod palette;
pub(crate) mod picker;
pub(crate) mod queries;
pub(crate) mod rays;
pub(crate) mod rows;
pub(crate) mod suggestions;

use std::collections::BTreeMap;
use std::sync::Arc;

use crossterm::event::KeyEvent;

use assets::Assets;
use buffer::Buffer;
use cursor::{Cursor, moved};
use disk::Disk;
use inspection::Inspection;
use jobs::Jobs;
use live_edit::{LiveEdit, TransientEdit};
use overlays::{Overlays, PromptKind};
use palette::Palette;
use suggestions::Suggestions;

use super::pictures::Pictures;
use crate::arrange::{Above, Areas, PanelSizes, Zoom};
use crate::keymap::{Keymap, Mode};
use crate::msg::Polled;
use crate::pixels::Pixels;
use crate::terminal::Mouse;
use crate::theme::Theme;
use document::Document;
use language::Node;
use scene::Scene;
use text::{Findings, Severity};

/// A border that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Border {
    /// Between the picture and the panels.
    Panels,
    /// Between the list and the fields.
    List,
}

/// What all modes share: the text, its meaning, and one part for each concern, which owns its own
/// state.
#[derive(Debug)]
pub struct Shared {
    /// The text under edit, its history and its saved version.
    pub document: Document,
    /// The errors and warnings of the current text.
    pub diagnostics: Findings,
    /// The part of the diagnostics that was found in reading the text and its files.
    pub(crate) reported: Findings,
    /// The render settings suggested for the picture.
    pub suggestions: Suggestions,
    /// The scene of the last text without errors, which the pictures show.
    pub scene: Option<Arc<Scene>>,
    /// The files that the scene names.
    pub assets: Assets,
    /// The scene's own file, and what is kept beside it.
    pub disk: Disk,
    /// The buffer that an editor has of the scene.
    pub buffer: Option<Buffer>,
    /// The selection, the field and the value being typed.
    pub cursor: Cursor,
    /// The preview, the full-size trace and the working view.
    pub pictures: Pictures,
    /// The pixel that is inspected.
    pub inspection: Inspection,
    /// The edit of the text that MOVE tries out.
    pub(crate) motion: Option<LiveEdit>,
    /// The edit of the text that will be reverted: the frame that SEQUENCE shows.
    pub(crate) transient: Option<TransientEdit>,
    /// Whether the scene's file is being read; what it holds is compared with the text without a
    /// transient edit.
    pub(crate) awaits_reading: bool,
    /// Whether another scene was opened in this step.
    pub(crate) is_replaced: bool,
    /// Dialogs, help, errors, the line being typed, and messages.
    pub overlays: Overlays,
    /// Why files are polled that the system was to watch.
    pub(crate) polled: BTreeMap<Polled, String>,
    /// Completions and history of the command line.
    pub palette: Palette,
    /// Saves and exports under way.
    pub jobs: Jobs,
    /// The mode, which determines the meaning of keys.
    pub mode: Mode,
    /// The colours of everything but pictures.
    pub theme: Theme,
    /// What the user wants pixels of pictures to be drawn with.
    pub pixels: Pixels,
    /// What keys do.
    pub keymap: Keymap,
    /// The first of two keys, until the second arrives.
    pub(crate) prefix: Option<KeyEvent>,
    /// How much of the screen the picture takes, except in the full-size trace.
    pub zoom: Zoom,
    /// The sizes of the panels that the user chose.
    pub panels: PanelSizes,
    /// The sizes that were last kept for other sessions.
    pub(crate) kept_panels: PanelSizes,
    /// The border that is being dragged.
    pub(crate) resizing: Option<Border>,
    /// Who receives mouse events.
    pub mouse: Mouse,
    /// What is above the picture and the panels.
    pub(crate) above: Above,
    /// Whether the terminal shows pictures in colours.
    pub has_colours: bool,
    /// Size of the terminal in cells.
    pub terminal: (u16, u16),
}

impl Shared {
    /// Shows a message.
    pub(crate) fn say(&mut self, text: impl Into<String>) {
        self.overlays.show(None, text);
    }

    /// Shows a warning.
    pub(crate) fn warn(&mut self, text: impl Into<String>) {
        self.overlays.show(Some(Severity::Warning), text);
    }

    /// Shows an error.
    pub(crate) fn fail(&mut self, text: impl Into<String>) {
        self.overlays.show(Some(Severity::Error), text);
    }

    /// Goes to a mode that needs no more than the scene: SELECT, EDIT, VIEW or FLY. Stays if it cannot be
    /// entered now.
    pub(crate) fn enter(&mut self, mode: Mode) {
        self.document.end_step();
        if mode == Mode::Edit {
            self.cursor.select_marked(self.document.source());
        }
        if mode.moves_camera() && self.scene.is_none() {
            self.refuse_picture(Severity::Error, &self.no_picture());
        } else if mode == Mode::Edit && self.cursor.fields().is_empty() {
            self.fail("nothing to edit here");
        } else {
            self.mode = mode;
        }
    }

    /// Moves the selection by some rows of the list.
    pub(crate) fn move_selection(&mut self, rows: isize) {
        if let Some(node) = self.cursor.row_after(rows, self.source()) {
            self.select(node);
        }
    }

    /// Moves the cursor by some fields.
    pub(crate) fn move_field(&mut self, rows: isize) {
        let count = self.cursor.fields().len();
        self.focus_field(moved(self.cursor.field, rows, count), self.cursor.component);
    }

    /// Opens the command line with the beginning of a command.
    pub(crate) fn open_palette_with(&mut self, typed: &str) {
        // Files may have come and gone.
        self.palette.folder = None;
        self.overlays.open_prompt(PromptKind::Command, typed);
    }

    /// Selects a node; ends the current undo step.
    pub(crate) fn select(&mut self, node: Node) {
        self.document.end_step();
        self.pictures.outline_selection();
        self.cursor.select(node, self.document.source());
    }

    /// Moves the cursor to a component of a field.
    pub(crate) fn focus_field(&mut self, field: usize, component: usize) {
        self.document.end_step();
        self.cursor.focus(field, component);
    }

    /// Warns that the requested action needs the scene.
    pub(crate) fn warn_of_opening(&mut self) {
        self.warn(format!("still opening {}", self.disk.name()));
    }

    /// Ends EDIT mode if there is no field.
    pub(crate) fn keep_mode(&mut self) {
        if self.cursor.fields().is_empty() && self.mode == Mode::Edit {
            self.mode = Mode::Select;
        }
    }

    /// Says what ends the transformation, which other actions have to wait for.
    pub(crate) fn warn_of_transform(&mut self) {
        let (confirm, cancel) = (self.key_for("accept"), self.key_for("back"));
        let words = format!("{confirm} confirms the change first; {cancel} cancels it");
        self.warn(words);
    }

    /// Shows why something cannot be done with the picture. The message goes with the errors in the
    /// text if there are any.
    pub(crate) fn refuse_picture(&mut self, severity: Severity, reason: &str) {
        if 0 < self.error_count() {
            self.overlays.blame_errors(severity, reason);
        } else {
            self.overlays.show(Some(severity), reason);
        }
    }

    /// Whether the structure cannot change because the text has errors; says so.
    pub(crate) fn refuses_structure(&mut self) -> bool {
        let has_errors = 0 < self.error_count();
        if has_errors {
            self.fail("correct the text's errors before adding, moving or deleting items");
        }
        has_errors
    }

    /// Scrolls so that the cursors are visible.
    pub(crate) fn scroll(&mut self, areas: &Areas) {
        let wrong = self.wrong().findings.len();
        let errors = self.overlays.errors.filter(|_| 0 < wrong);
        self.overlays.errors = errors.map(|at| at.min(wrong - 1));
        self.cursor.scroll(areas, self.document.source());
    }
}
