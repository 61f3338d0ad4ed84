//! The interface before its scene: the file is read beside it, and the first screen waits for none.

use std::path::PathBuf;

use super::assets::Assets;
use super::model::Pending;
use super::saving::Saves;
use super::{App, Disk, Mode, Outline, Picture, Quality, Stride};
use crate::document::Document;
use crate::file::ReadError;
use crate::language::Language;
use crate::language::Lowered;
use crate::language::Node;
use crate::scene::{Images, Meshes};
use crate::text::{Findings, Severity};
use crate::ui::msg::Effect;
use crate::ui::reading::{News, Reading};
use crate::ui::terminal::Mouse;
use crate::ui::view::layout::Zoom;

/// What the interface starts from.
#[derive(Clone, Debug)]
pub struct Opening {
    /// Where the scene is read from; `None` for the embedded one.
    pub path: Option<PathBuf>,
    /// Its language.
    pub language: Language,
    /// Its text.
    pub text: OpeningText,
    /// How pictures are traced.
    pub quality: Quality,
    /// Who has the mouse.
    pub mouse: Mouse,
    /// Size of the terminal in cells.
    pub terminal: (u16, u16),
}

/// The text that the interface starts with.
#[derive(Clone, Debug)]
pub enum OpeningText {
    /// It is known.
    Known(String),
    /// It is yet to be read from a file of so many bytes.
    Unread(u64),
    /// It is what the file held that is missing now, as edits of it that are kept tell.
    Kept(String),
}

/// A scene that is being read for the first time.
#[derive(Debug)]
pub struct Unread {
    /// How long its file is.
    pub bytes: u64,
}

impl App {
    /// The interface as it opens, and what is to be done first.
    pub fn open(opening: Opening) -> (Self, Vec<Effect>) {
        let disk = match opening.text {
            OpeningText::Kept(_) => Disk::Missing,
            OpeningText::Known(_) | OpeningText::Unread(_) => Disk::Known,
        };
        let (document, unread) = match opening.text {
            OpeningText::Known(text) | OpeningText::Kept(text) => {
                (Document::new(opening.language, text), None)
            }
            OpeningText::Unread(bytes) => {
                let unread = Unread { bytes };
                (Document::new(opening.language, String::new()), Some(unread))
            }
        };
        let meshes = Meshes::default();
        let mut app = Self {
            path: opening.path,
            document,
            unread,
            unreadable: None,
            diagnostics: Findings::default(),
            scene: None,
            images: Images::default(),
            meshes,
            view: None,
            quality: opening.quality,
            aov: None,
            mode: Mode::Select,
            zoom: Zoom::default(),
            selected: Node::View,
            list_top: 0,
            field: 0,
            field_top: 0,
            component: 0,
            stride: Stride::default(),
            typing: None,
            prompt: None,
            searched: String::new(),
            dialog: None,
            help: None,
            errors: None,
            message: None,
            past_message: None,
            disk,
            broken: None,
            outline: Outline::default(),
            cross: (0, 0),
            preview: Picture::default(),
            trace: None,
            export: None,
            net: None,
            mouse: opening.mouse,
            terminal: opening.terminal,
            assets: Assets::default(),
            saves: Saves::default(),
            pending: Pending::default(),
        };
        let mut effects = app.watch();
        let lowered = app.lowered();
        if !app.is_opening() {
            effects.push(app.begin(lowered));
            effects.extend(app.follow());
        }
        (app, effects)
    }

    /// Whether the scene is yet to be read: there is nothing to see, and nothing to edit.
    pub fn is_opening(&self) -> bool {
        self.unread.is_some()
    }

    /// Takes the first text of the scene; without one the interface ends.
    pub(super) fn opened(&mut self, read: Result<Reading, ReadError>) -> Vec<Effect> {
        let reading = match read {
            Ok(reading) => reading,
            Err(error) => {
                self.unreadable = Some(error);
                return vec![Effect::Quit];
            }
        };
        self.unread = None;
        self.pending.place = reading.place;
        let lowered = match reading.news.map(|news| *news) {
            Some(News::Text(document, meaning)) => {
                // What it was before is empty.
                drop(self.document.load(document));
                meaning.lowered
            }
            // Nothing is edited yet: nothing is merged, and only an empty file changes nothing.
            Some(News::Merged(..) | News::Conflict(_) | News::Broken(..)) | None => self.lowered(),
        };
        vec![self.begin(lowered)]
    }

    /// Shows what the first text means, and has edits looked for that earlier runs kept of it.
    fn begin(&mut self, lowered: Lowered) -> Effect {
        // That the scene is still being opened; what has failed is still to be read.
        self.message
            .take_if(|message| message.severity != Some(Severity::Error));
        self.install(lowered);
        // What is changed first is rather an object than the camera.
        self.select(Node::Object(0));
        self.keep_selection();
        self.scroll();
        self.look_for_kept()
    }

    /// Says that what was asked for needs the scene.
    pub(super) fn warn_of_opening(&mut self) {
        self.warn(format!("{} is still being opened", self.file_name()));
    }
}
