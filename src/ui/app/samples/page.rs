//! The page itself: its rows, and opening a copy.

use std::path::Path;

use crate::app::{CarriedScene, Page, Shared, files};
use crate::keymap::Context;
use crate::msg::Effect;
use assets::{SAMPLES, Sample};
use language::Language;

/// The samples on the page. Those that name pictures or meshes need files beside them, which a scene
/// without a file does not have.
pub(crate) fn shown_samples() -> impl Iterator<Item = &'static Sample> {
    SAMPLES.iter().filter(|sample| sample.files.is_empty())
}

/// Opens the page.
pub(crate) fn list_samples(shared: &mut Shared) {
    let rows = shown_samples().map(|sample| format!("{}: {}", sample.name, sample.words));
    let page = Page::of(Context::Samples, "Sample scenes", rows.collect());
    shared.overlays.open_page(page);
}

/// Opens a copy of the sample under the cursor, and closes the page.
pub(super) fn open_chosen(shared: &mut Shared) -> Vec<Effect> {
    let chosen = shared.overlays.take_chosen();
    let sample = chosen.and_then(|at| shown_samples().nth(at));
    match sample.and_then(carried) {
        Some(carried) => files::open_carried(shared, carried),
        None => Vec::new(),
    }
}

/// The sample as a scene to open.
pub(super) fn carried(sample: &Sample) -> Option<CarriedScene> {
    let language = Language::of_path(Path::new(sample.name)).ok()?;
    Some(CarriedScene {
        name: sample.name,
        language,
        text: sample.text,
    })
}
