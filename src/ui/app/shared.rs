//! What all modes share.

use std::collections::BTreeMap;
use std::sync::Arc;

use crossterm::event::KeyEvent;

use super::assets::Assets;
use super::compared::Compared;
use super::cursor::Cursor;
use super::disk::Disk;
use super::inspection::Inspection;
use super::jobs::Jobs;
use super::live_edit::TransientEdit;
use super::overlays::Overlays;
use super::palette::Palette;
use super::pictures::Pictures;
use super::suggestions::Suggestions;
use crate::document::Document;
use crate::scene::Scene;
use crate::text::Findings;
use crate::ui::arrange::{PanelSizes, Zoom};
use crate::ui::keymap::{Keymap, Mode};
use crate::ui::msg::Polled;
use crate::ui::pixels::Pixels;
use crate::ui::terminal::Mouse;
use crate::ui::theme::Theme;

/// A border that can be dragged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Border {
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
    /// Those of them that were found in reading the text and its files.
    pub(super) reported: Findings,
    /// The render settings suggested for the picture.
    pub suggestions: Suggestions,
    /// The scene of the last text without errors, which the pictures show.
    pub scene: Option<Arc<Scene>>,
    /// The files that the scene names.
    pub assets: Assets,
    /// The scene's own file, and what is kept beside it.
    pub disk: Disk,
    /// The selection, the field and the value being typed.
    pub cursor: Cursor,
    /// The preview, the full-size trace and the working view.
    pub pictures: Pictures,
    /// What pictures are compared with, and the comparison.
    pub compared: Compared,
    /// The pixel that is inspected.
    pub inspection: Inspection,
    /// The edit of the text that will be reverted: the frame that SEQUENCE shows.
    pub(super) transient: Option<TransientEdit>,
    /// Whether the scene's file is being read; what it holds is compared with the text without a
    /// transient edit.
    pub(super) awaits_reading: bool,
    /// Whether another scene was opened in this step.
    pub(super) is_replaced: bool,
    /// Dialogs, help, errors, the line being typed, and messages.
    pub overlays: Overlays,
    /// Why files are polled that the system was to watch.
    pub(super) polled: BTreeMap<Polled, String>,
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
    pub(super) prefix: Option<KeyEvent>,
    /// How much of the screen the picture takes, except in the full-size trace.
    pub zoom: Zoom,
    /// The sizes of the panels that the user chose.
    pub panels: PanelSizes,
    /// The sizes that were last kept for other sessions.
    pub(super) kept_panels: PanelSizes,
    /// The border that is being dragged.
    pub(super) resizing: Option<Border>,
    /// Who receives mouse events.
    pub mouse: Mouse,
    /// Whether the terminal shows pictures in colours.
    pub has_colours: bool,
    /// Size of the terminal in cells.
    pub terminal: (u16, u16),
}
