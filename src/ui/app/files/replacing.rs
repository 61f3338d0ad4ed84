//! Replacing the scene with one from a file or a new one, once nothing would be lost.

use std::path::PathBuf;
use std::sync::Arc;

use super::first_scene::begin;
use super::reading::watch;
use crate::app::shared::assets::Assets;
use crate::app::shared::inspection::Inspection;
use crate::app::{CarriedScene, Cursor, OnDisk, Overlays, Shared, text};
use crate::keymap::Mode;
use crate::msg::{Effect, Target};
use crate::scene_reading::language_of;
use document::{Document, Past};
use language::{Language, Lowered};

/// Requests the scene of a file. The present one stays until the other has been read.
pub(super) fn request_scene(shared: &mut Shared, path: PathBuf) -> Vec<Effect> {
    let Ok(language) = language_of(&path) else {
        return Vec::new();
    };
    // It may be this very file, under another name.
    if let Some(saved) = shared.jobs.file_being_saved() {
        let saved = saved.display();
        shared.warn(format!(
            "{saved} is still being written: open another scene after that"
        ));
        return Vec::new();
    }
    let now = (shared.document.revision(), shared.pictures.view);
    vec![shared.disk.request(path, language, now)]
}

/// Starts a new scene without a file.
pub(super) fn start_scene(shared: &mut Shared, language: Language) -> Vec<Effect> {
    let document = Document::new(language, language.template().to_owned());
    replace_scene(shared, None, document, OnDisk::New, None)
}

/// Opens a copy of a scene that the program carries, which has no file until it is saved.
pub(super) fn start_carried(shared: &mut Shared, carried: CarriedScene) -> Vec<Effect> {
    let document = Document::new(carried.language, carried.text.to_owned());
    replace_scene(shared, None, document, OnDisk::Known, None)
}

/// Replaces the scene, with everything that belongs to it: selection, history, view, pictures
/// and journal. Exports go on; the outcomes of saves are only reported.
pub(super) fn replace_scene(
    shared: &mut Shared,
    path: Option<PathBuf>,
    document: Document,
    state: OnDisk,
    lowered: Option<Lowered>,
) -> Vec<Effect> {
    let forgotten = shared.disk.journal.forget();
    let mut effects: Vec<_> = forgotten.into_iter().collect();
    if shared.pictures.is_tracing() {
        effects.push(Effect::Stop(Target::Trace));
    }
    let former = (
        shared.document.load(document, Past::Cleared),
        shared.scene.take(),
    );
    effects.push(Effect::Free(Arc::new(former)));
    shared.disk.replace(path, state);
    shared.buffer = None;
    shared.assets = Assets::default();
    shared.pictures.renew();
    if std::mem::take(&mut shared.suggestions).are_awaited() {
        effects.push(Effect::Stop(Target::Trial));
    }
    shared.inspection = Inspection::default();
    shared.motion = None;
    shared.transient = None;
    shared.awaits_reading = false;
    shared.is_replaced = true;
    shared.cursor = Cursor::default();
    shared.overlays = Overlays::default();
    shared.jobs.abandon_saves();
    shared.mode = Mode::Select;
    shared.prefix = None;
    effects.extend(watch(shared));
    let lowered = lowered.unwrap_or_else(|| text::lowered(shared));
    effects.extend(begin(shared, lowered));
    effects
}
