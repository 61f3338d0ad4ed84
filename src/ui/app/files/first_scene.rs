//! Opening the interface: the scene is read in the background, and the first screen does not wait.

use std::collections::BTreeMap;
use std::path::PathBuf;

use super::first_selected::first_selected;
use super::outside;
use super::polling::complain_of_polling;
use super::reading::{announce_new, note_recent, watch};
use super::recent::list_recent;
use super::recover::look_for_kept;
use crate::app::shared::assets::Assets;
use crate::app::shared::cursor::Names;
use crate::app::shared::inspection::Inspection;
use crate::app::shared::palette::Palette;
use crate::app::{
    Cursor, Disk, FirstReading, Jobs, OnDisk, Overlays, Pictures, Shared, Suggestions, display,
    text,
};
use crate::arrange::{Above, PanelSizes, Zoom};
use crate::keymap::{Keymap, Mode};
use crate::msg::Effect;
use crate::pixels::Pixels;
use crate::scene_reading::{News, Reading};
use crate::terminal::Mouse;
use crate::theme::Theme;
use ::text::{Findings, Severity};
use document::{Document, Past};
use file::ReadError;
use language::{Language, Lowered};
use scene::Rendering;

/// The initial settings of the interface.
#[derive(Clone, Debug)]
pub struct Opening {
    /// The path of the scene; `None` for the embedded one.
    pub path: Option<PathBuf>,
    /// The language of its text.
    pub language: Language,
    /// Its text, unless that is still to be read.
    pub text: OpeningText,
    /// What takes precedence over the scene's render settings.
    pub rendering: Rendering,
    /// Who receives mouse events.
    pub mouse: Mouse,
    /// What the user has configured.
    pub preferences: Preferences,
    /// Recently used scenes, offered first if there are any.
    pub recent: Vec<PathBuf>,
    /// Size of the terminal in cells.
    pub terminal: (u16, u16),
}

/// What a user configures once and for all.
#[derive(Clone, Debug, Default)]
pub struct Preferences {
    /// What keys do.
    pub keymap: Keymap,
    /// The colours of everything but pictures.
    pub theme: Theme,
    /// What pixels are drawn with.
    pub pixels: Pixels,
    /// The sizes of the panels, which an earlier session may have kept.
    pub panels: PanelSizes,
}

/// The text that the interface starts with.
#[derive(Clone, Debug)]
pub enum OpeningText {
    /// The text is known.
    Known(String),
    /// It is still to be read from a file of this many bytes.
    Unread(u64),
    /// The file is missing; this is the base of unsaved edits that were kept of it.
    Kept(String),
    /// The file does not exist yet: the text is the language's template.
    New,
    /// The path is that of a mesh of this many bytes: the text is still to be made around it.
    AroundMesh(u64),
}

/// Creates the interface, and the effects to start with.
pub(crate) fn open(opening: Opening) -> (Shared, Vec<Effect>) {
    let mesh = match opening.text {
        OpeningText::AroundMesh(_) => opening.path.clone(),
        _ => None,
    };
    let (text, state, first) = match opening.text {
        OpeningText::Known(text) => (text, OnDisk::Known, FirstReading::Done),
        OpeningText::Kept(text) => (text, OnDisk::Missing, FirstReading::Done),
        OpeningText::New => {
            let text = opening.language.template().to_owned();
            (text, OnDisk::New, FirstReading::Done)
        }
        OpeningText::Unread(bytes) | OpeningText::AroundMesh(bytes) => {
            (String::new(), OnDisk::Known, FirstReading::Pending(bytes))
        }
    };
    let mut shared = Shared {
        document: Document::new(opening.language, text),
        diagnostics: Findings::default(),
        reported: Findings::default(),
        suggestions: Suggestions::default(),
        scene: None,
        assets: Assets::default(),
        disk: Disk::new(opening.path, state, first),
        buffer: None,
        cursor: Cursor::default(),
        pictures: Pictures::new(opening.rendering),
        inspection: Inspection::default(),
        motion: None,
        transient: None,
        awaits_reading: false,
        is_replaced: false,
        overlays: Overlays::default(),
        polled: BTreeMap::new(),
        jobs: Jobs::default(),
        mode: Mode::Select,
        keymap: opening.preferences.keymap,
        theme: opening.preferences.theme,
        pixels: opening.preferences.pixels,
        prefix: None,
        palette: Palette::default(),
        zoom: Zoom::default(),
        panels: opening.preferences.panels,
        kept_panels: opening.preferences.panels,
        resizing: None,
        mouse: opening.mouse,
        above: Above::default(),
        has_colours: false,
        terminal: opening.terminal,
    };
    if !opening.recent.is_empty() {
        list_recent(&mut shared, opening.recent);
    }
    let mut effects = match mesh {
        Some(mesh) => {
            let now = (shared.document.revision(), shared.pictures.view);
            vec![shared.disk.request(mesh, opening.language, now)]
        }
        None => watch(&shared),
    };
    let lowered = text::lowered(&mut shared);
    if !shared.disk.is_opening() {
        effects.extend(begin(&mut shared, lowered));
        effects.extend(display::follow_scene(&mut shared));
        effects.extend(display::follow(&mut shared));
    }
    (shared, effects)
}

/// Takes the scene's first text; if it could not be read, the interface ends.
pub(crate) fn first_read(shared: &mut Shared, read: Result<Reading, ReadError>) -> Vec<Effect> {
    let reading = match read {
        Ok(reading) => reading,
        Err(error) => {
            shared.disk.first = FirstReading::Failed(error);
            return vec![Effect::Quit];
        }
    };
    shared.disk.first = FirstReading::Done;
    if let Some(place) = reading.place {
        shared.disk.place = Some(place);
    }
    let read = reading.buffer;
    let lowered = match reading.news.map(|news| *news) {
        Some(News::Text(document, meaning)) => {
            // The previous document is empty.
            drop(shared.document.load(document, Past::Cleared));
            meaning.lowered
        }
        // Without edits there is nothing to merge, and only an empty file changes nothing.
        _ => text::lowered(shared),
    };
    let mut effects = outside::took(shared, read);
    effects.extend(begin(shared, lowered));
    effects
}

/// Installs the meaning of the first text, and looks for edits of it that earlier runs kept.
pub(super) fn begin(shared: &mut Shared, lowered: Lowered) -> Vec<Effect> {
    // The message that the scene is still being opened; errors stay, to be read.
    shared
        .overlays
        .message
        .take_if(|message| message.severity != Some(Severity::Error));
    text::install(shared, lowered);
    complain_of_polling(shared);
    if shared.disk.state == OnDisk::New {
        announce_new(shared);
    }
    // The first change is more likely to be to an object than to the camera.
    let first = first_selected(shared);
    shared.cursor.select(first, shared.document.source());
    let source = shared.document.source();
    shared.cursor.renew(source, Names::Changed);
    shared.scroll(&shared.areas());
    let recent = note_recent(shared);
    [look_for_kept(shared)].into_iter().chain(recent).collect()
}
