//! Replacing the scene by another one: opened from a file, or new.

use std::path::PathBuf;
use std::sync::Arc;

use super::after_leaving::name_of;
use super::assets::Assets;
use super::inspection::Inspection;
use super::{AfterLeaving, Cursor, List, OnDisk, Overlays, Page, Shared};
use crate::document::Document;
use crate::file::ReadError;
use crate::language::{Language, Lowered};
use crate::ui::keymap::Mode;
use crate::ui::msg::{Effect, Target};
use crate::ui::scene_reading::{News, Opened};

impl Shared {
    /// Starts a new scene, in the language of the present one if none is given.
    pub(super) fn start_new(&mut self, language: Option<Language>) -> Vec<Effect> {
        let language = language.unwrap_or_else(|| self.document.language());
        self.leave_for(AfterLeaving::New(language))
    }

    /// Opens a file, or reads the scene's own again.
    pub(super) fn edit_file(&mut self, file: Option<PathBuf>) -> Vec<Effect> {
        match file {
            Some(path) => self.open_scene(path),
            None => self.reread(),
        }
    }

    /// Opens the scene of a file, for `:e FILE`; the scene's own file is read again.
    pub(super) fn open_scene(&mut self, path: PathBuf) -> Vec<Effect> {
        if self.disk.is_own(&path) {
            return self.reread();
        }
        if let Err(unknown) = Language::of_path(&path) {
            self.overlays.fail(unknown.to_string());
            return Vec::new();
        }
        self.leave_for(AfterLeaving::Open(path))
    }

    /// Requests the scene of a file. The present one stays until the other has been read.
    pub(super) fn request_scene(&mut self, path: PathBuf) -> Vec<Effect> {
        let Ok(language) = Language::of_path(&path) else {
            return Vec::new();
        };
        // It may be this very file, under another name.
        if let Some(saved) = self.jobs.file_being_saved() {
            let saved = saved.display();
            let words = format!("{saved} is still being written: open another scene after that");
            self.overlays.warn(words);
            return Vec::new();
        }
        let now = (self.document.revision(), self.pictures.view);
        self.disk.request(path.clone(), now);
        vec![Effect::Open(path, language)]
    }

    /// Takes a scene that was requested; if it cannot be read, the present one stays. Asks again if
    /// this one has been changed meanwhile.
    pub(super) fn scene_read(
        &mut self,
        path: PathBuf,
        opened: Result<Opened, ReadError>,
    ) -> Vec<Effect> {
        let Some(before) = self.disk.take_request(&path) else {
            return vec![Effect::Free(Arc::new(opened))];
        };
        let opened = match opened {
            Ok(opened) => opened,
            Err(error) => {
                self.overlays.fail(error.to_string());
                // Its changes were not read meanwhile.
                return self.read_again();
            }
        };
        if before != (self.document.revision(), self.pictures.view) {
            return self.leave_for(AfterLeaving::Open(path));
        }
        let Ok(language) = Language::of_path(&path) else {
            return Vec::new();
        };
        let (text, state) = match opened {
            Opened::Read(reading) => {
                let (document, lowered) = match reading.news.map(|news| *news) {
                    Some(News::Text(document, meaning)) => (document, Some(meaning.lowered)),
                    // Only an empty file changes nothing.
                    _ => (Document::new(language, String::new()), None),
                };
                let effects = self.replace_scene(Some(path), document, OnDisk::Known, lowered);
                if let Some(place) = reading.place {
                    self.disk.move_to(place);
                }
                return effects;
            }
            Opened::Kept(text) => (text, OnDisk::Missing),
            Opened::New => (language.template().to_owned(), OnDisk::New),
        };
        let document = Document::new(language, text);
        self.replace_scene(Some(path), document, state, None)
    }

    /// Shows recently used scenes.
    pub(super) fn show_recent(&mut self, scenes: Vec<PathBuf>) {
        self.overlays.page = Page::recent(scenes);
        if self.overlays.page.is_none() {
            self.overlays.say("no recently used scenes");
        }
    }

    /// Remembers the scene as the one used last, if its file exists.
    pub(super) fn note_recent(&self) -> Option<Effect> {
        let path = self.disk.path.clone();
        let path = path.filter(|_| self.disk.state == OnDisk::Known);
        path.map(Effect::NoteRecent)
    }

    /// Uses the row under the cursor of the open page, and closes it.
    pub(super) fn choose(&mut self) -> Vec<Effect> {
        let Some(page) = self.overlays.page.take() else {
            return Vec::new();
        };
        let Some(at) = page.chosen() else {
            return Vec::new();
        };
        match page.list {
            List::Views(views, _) => self.go_to_view(&views[at]),
            List::Steps(_) => self.go_to_state(at),
            List::Recent(paths) => return self.open_scene(paths[at].clone()),
        }
        Vec::new()
    }

    /// Starts a new scene without a file.
    pub(super) fn start_scene(&mut self, language: Language) -> Vec<Effect> {
        let document = Document::new(language, language.template().to_owned());
        self.replace_scene(None, document, OnDisk::New, None)
    }

    /// Replaces the scene, with everything that belongs to it: selection, history, view, pictures
    /// and journal. Exports go on; the outcomes of saves are only reported.
    fn replace_scene(
        &mut self,
        path: Option<PathBuf>,
        document: Document,
        state: OnDisk,
        lowered: Option<Lowered>,
    ) -> Vec<Effect> {
        let forgotten = self.disk.journal.forget();
        let mut effects: Vec<_> = forgotten.into_iter().collect();
        if self.pictures.is_tracing() {
            effects.push(Effect::Stop(Target::Trace));
        }
        let former = (self.document.load(document), self.scene.take());
        effects.push(Effect::Free(Arc::new(former)));
        self.disk.replace(path, state);
        self.assets = Assets::default();
        self.pictures.renew();
        if std::mem::take(&mut self.suggestions).are_awaited() {
            effects.push(Effect::Stop(Target::Trial));
        }
        self.inspection = Inspection::default();
        self.transient = None;
        self.awaits_reading = false;
        self.is_replaced = true;
        self.cursor = Cursor::default();
        self.overlays = Overlays::default();
        self.jobs.abandon_saves();
        self.mode = Mode::Select;
        self.prefix = None;
        effects.extend(self.watch());
        let lowered = lowered.unwrap_or_else(|| self.lowered());
        effects.extend(self.begin(lowered));
        effects
    }

    /// Says that the scene is new and how to write it.
    pub(super) fn announce_new(&mut self) {
        let save = self.key_for("save");
        self.overlays.say(match self.disk.path.as_deref() {
            Some(path) => format!("{} is new: {save} writes it", name_of(path)),
            None => "a new scene: :w FILE writes it".to_owned(),
        });
    }
}
