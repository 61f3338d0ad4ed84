//! Exporting the track that is played, all frames of it.

use std::collections::HashMap;
use std::path::Path;

use super::playing::how_to_key;
use super::state::Sequence;
use crate::app::exports::ExportOrder;
use crate::app::refusing::Refusable;
use crate::app::shared::Shared;
use crate::app::shared::jobs::{Asking, ExportWork};
use crate::app::{exports, text};
use crate::keymap::{Context, Mode};
use crate::msg::{Destination, Effect, ExportId};
use crate::reel::{Reel, ReelForm, ReelProgress, Shot};
use image_file::{DEFAULT_RATE, ImageFormat};
use scene::Size;

/// Exports to the scene's folder under the scene's name; asks if another program has written that file.
pub(super) fn export_default(sequence: &mut Sequence, shared: &mut Shared) -> Vec<Effect> {
    export(sequence, shared, ExportOrder::default(), Asking::Yes)
}

/// Exports the sequence that is played, after the exports that were started before.
pub(crate) fn export(
    sequence: &Sequence,
    shared: &mut Shared,
    order: ExportOrder,
    asking: Asking,
) -> Vec<Effect> {
    let ExportOrder { path, size, spp } = order;
    let path = path.unwrap_or_else(|| exports::export_path(shared).with_extension("gif"));
    let wanted = size.unwrap_or_else(|| shared.output());
    let reel = form_of(sequence, shared, &path, wanted).and_then(|form| {
        let shot = Shot {
            rendering: shared.pictures.rendering,
            aov: shared.pictures.aov,
            view: shared.pictures.view,
            size,
            spp,
        };
        reel_of(sequence, shared, form, shot)
    });
    let Some(reel) = reel.or_fail(shared) else {
        return Vec::new();
    };
    let track = sequence.open.as_ref().map(|open| open.path.clone());
    let samples = spp.unwrap_or_else(|| shared.rendering().spp());
    let samples = shared.pictures.samples(samples);
    let destination = Destination {
        path,
        existing: asking.existing(),
        scene: shared.disk.path.clone(),
        named: shared.assets.files().iter().cloned().chain(track).collect(),
        origin: None,
    };
    let making = ExportWork::Film(Box::new(reel));
    exports::begin(shared, destination, (wanted, samples), making, asking)
}

/// What a sequence of pictures of this size is written as, or why it cannot be.
fn form_of(
    sequence: &Sequence,
    shared: &Shared,
    path: &Path,
    size: Size,
) -> Result<ReelForm, String> {
    let form = ReelForm::of_path(path).map_err(|reason| {
        let keep = shared.keymap.key(Context::In(Mode::Sequence), "accept");
        let keep = keep.map_or_else(String::new, |key| {
            format!("; to export this frame alone, press {key} first")
        });
        format!("{reason}{keep}")
    })?;
    let rate = sequence.open.as_ref().and_then(|open| open.track.rate);
    let refused = match &form {
        ReelForm::Movie(format) => format
            .refuses(rate.unwrap_or(DEFAULT_RATE))
            .or_else(|| ImageFormat::Gif.refuses(size)),
        ReelForm::Pictures(_, format) => format.refuses(size),
    };
    refused.map_or(Ok(form), Err)
}

/// The sequence that is played, with the text as it is without a frame.
fn reel_of(
    sequence: &Sequence,
    shared: &mut Shared,
    form: ReelForm,
    shot: Shot,
) -> Result<Reel, String> {
    if shared.assets.are_awaited() {
        return Err(shared.no_picture());
    }
    let open = sequence.open.as_ref().ok_or("no track is open")?;
    if open.is_refused {
        return Err(format!(
            "{} cannot be played as it is on disk: correct it first",
            open.name()
        ));
    }
    if open.held.is_none() {
        let how = how_to_key(open, shared);
        return Err(format!("nothing to export yet: {how}"));
    }
    text::revert_transient(shared);
    Ok(Reel {
        language: shared.document.language(),
        text: shared.document.shared_text(),
        scene: shared.disk.path.clone().unwrap_or_default(),
        track: open.track.clone(),
        form,
        shot,
        written: HashMap::new(),
    })
}

/// Takes how far the export of a sequence is.
pub(crate) fn filmed(shared: &mut Shared, id: ExportId, progress: ReelProgress) {
    let running = shared.jobs.export_mut();
    if let Some(export) = running.filter(|export| export.id == id) {
        export.reel = Some(progress);
    }
}
