//! Asking for another scene: from a file, or a new one.

use std::path::PathBuf;
use std::sync::Arc;

use super::leaving::leave_for;
use super::reading::{read_again, reread};
use super::replacing::replace_scene;
use crate::app::{AfterLeaving, CarriedScene, FirstReading, OnDisk, Shared};
use crate::msg::Effect;
use crate::scene_reading::{News, Opened, language_of};
use crate::text_width::file_name;
use document::Document;
use file::ReadError;
use language::Language;

/// Starts a new scene, in the language of the present one if none is given.
pub(crate) fn start_new(shared: &mut Shared, language: Option<Language>) -> Vec<Effect> {
    let language = language.unwrap_or_else(|| shared.document.language());
    leave_for(shared, AfterLeaving::New(language))
}

/// Opens a copy of a scene that the program carries.
pub(crate) fn open_carried(shared: &mut Shared, carried: CarriedScene) -> Vec<Effect> {
    leave_for(shared, AfterLeaving::Carried(carried))
}

/// Opens a file, or reads the scene's own again.
pub(crate) fn edit_file(shared: &mut Shared, file: Option<PathBuf>) -> Vec<Effect> {
    match file {
        Some(path) => open_scene(shared, path),
        None => reread(shared),
    }
}

/// Opens the scene of a file, for `:e FILE`; the scene's own file is read again.
pub(crate) fn open_scene(shared: &mut Shared, path: PathBuf) -> Vec<Effect> {
    if shared.disk.is_own(&path) {
        return reread(shared);
    }
    if let Err(unknown) = language_of(&path) {
        shared.fail(unknown.to_string());
        return Vec::new();
    }
    leave_for(shared, AfterLeaving::Open(path))
}

/// Takes a scene that was requested; if it cannot be read, the present one stays. Asks again if
/// this one has been changed meanwhile.
pub(crate) fn other_scene_read(
    shared: &mut Shared,
    path: PathBuf,
    opened: Result<Opened, ReadError>,
) -> Vec<Effect> {
    let Some(before) = shared.disk.take_request(&path) else {
        return vec![Effect::Free(Arc::new(opened))];
    };
    let opened = match opened {
        Ok(opened) => opened,
        Err(error) if shared.disk.is_opening() => {
            shared.disk.first = FirstReading::Failed(error);
            return vec![Effect::Quit];
        }
        Err(error) => {
            shared.fail(error.to_string());
            // Its changes were not read meanwhile.
            return read_again(shared);
        }
    };
    if before != (shared.document.revision(), shared.pictures.view) {
        return leave_for(shared, AfterLeaving::Open(path));
    }
    let Ok(language) = language_of(&path) else {
        return Vec::new();
    };
    let (text, state) = match opened {
        Opened::Read(reading) => {
            let (document, lowered) = match reading.news.map(|news| *news) {
                Some(News::Text(document, meaning)) => (document, Some(meaning.lowered)),
                // Only an empty file changes nothing.
                _ => (Document::new(language, String::new()), None),
            };
            let effects = replace_scene(shared, Some(path), document, OnDisk::Known, lowered);
            if let Some(place) = reading.place {
                shared.disk.place = Some(place);
            }
            return effects;
        }
        Opened::Kept(text) => (text, OnDisk::Missing),
        Opened::New => (language.template().to_owned(), OnDisk::New),
        Opened::AroundMesh(made) => {
            let document = Document::new(language, made.text);
            let effects = replace_scene(shared, Some(made.path), document, OnDisk::New, None);
            let (mesh, name) = (file_name(&path), shared.disk.name());
            let save = shared.key_for("save");
            // That it is new is said with the rest.
            shared.overlays.message = None;
            shared.say(format!("{mesh}: {}; {save} writes {name}", made.summary));
            return effects;
        }
    };
    let document = Document::new(language, text);
    replace_scene(shared, Some(path), document, state, None)
}

/// Opens the scene under the cursor of the page of recently used ones.
pub(super) fn open_recent(shared: &mut Shared) -> Vec<Effect> {
    let chosen = shared.overlays.take_chosen();
    match chosen.and_then(|at| shared.disk.recent.get(at).cloned()) {
        Some(path) => open_scene(shared, path),
        None => Vec::new(),
    }
}
