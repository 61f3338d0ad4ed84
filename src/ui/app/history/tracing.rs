//! Pictures of the texts on the page of the undo history: what is wanted, derived and traced.

use ratatui::layout::Rect;

use super::page::{body, history_layout, step_names};
use super::thumbnails::{Look, Rank, Slot, Thumbnails};
use crate::app::room::Room;
use crate::app::shared::Shared;
use crate::history_scene::{HistoryScene, HistoryText, NoPicture};
use crate::keymap::Context;
use crate::layout::raster;
use crate::msg::{Effect, Target};
use render::{Frames, Job, Settings};
use scene::{Camera, Filter, Integrator, Rendering};

/// Samples per pixel of the pictures in rows and of the large one.
const WHITTED_SAMPLES: [u32; 2] = [4, 16];
const PATH_SAMPLES: [u32; 2] = [64, 128];

impl Room for Thumbnails {
    /// A ticket is never given twice, whatever scene it was for.
    fn renew(&mut self) {
        self.forget();
    }

    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        follow(self, shared)
    }
}

/// Brings the page of the history up to date, and requests the next picture on it. Stops tracing
/// if the page is closed.
fn follow(thumbnails: &mut Thumbnails, shared: &mut Shared) -> Vec<Effect> {
    let (document, overlays) = (&shared.document, &mut shared.overlays);
    let Some(page) = overlays.page_mut(Context::History) else {
        thumbnails.listed = None;
        let is_under_way = thumbnails.cancel();
        let stop = is_under_way.then_some(Effect::Stop(Target::Thumbnail));
        return stop.into_iter().collect();
    };
    let (revision, present) = (document.revision(), document.present());
    let before = thumbnails.listed.replace((revision, present));
    if before.is_none_or(|(listed, _)| listed != revision) {
        let was_present = page.chosen() == before.map(|(_, present)| present);
        page.list(step_names(document));
        if was_present {
            page.choose(present);
        }
    }
    if shared.assets.are_awaited() {
        return Vec::new();
    }
    thumbnails.look(Look {
        view: shared.pictures.view,
        integrator: shared.pictures.rendering.integrator,
        files: shared.assets.changes,
    });
    let wanted = wanted_slots(shared);
    match thumbnails.next(&wanted) {
        Some((slot, ticket)) => derive(shared, slot, ticket).into_iter().collect(),
        None => Vec::new(),
    }
}

/// The pictures on the page, the most urgent first: those in rows from the selected one outwards,
/// which take less time, then the large one.
fn wanted_slots(shared: &Shared) -> Vec<Slot> {
    let Some(page) = shared.overlays.page(Context::History) else {
        return Vec::new();
    };
    let strip = history_layout(shared, body(shared));
    let shown = page.shown();
    let ids: Vec<_> = shared.document.states().map(|state| state.id).collect();
    let id = |row: usize| {
        let (index, _) = shown.get(row)?;
        ids.get(*index).copied()
    };
    let at = page.filter.at;
    let large = strip.large.and_then(|large| {
        Some(Slot {
            id: id(at)?,
            rank: Rank::Large,
            room: (large.width, large.height),
        })
    });
    let thumbnail = strip.thumbnail.filter(|_| !shared.is_large());
    let mut rows: Vec<_> = strip.rows(at, shown.len()).map(|(row, _)| row).collect();
    rows.sort_by_key(|row| row.abs_diff(at));
    let rows = rows.into_iter().filter_map(|row| {
        Some(Slot {
            id: id(row)?,
            rank: Rank::Row,
            room: thumbnail?,
        })
    });
    rows.chain(large).collect()
}

/// Requests the scene of a text, which takes too long to be derived here.
fn derive(shared: &Shared, slot: Slot, ticket: u64) -> Option<Effect> {
    let mut states = shared.document.states();
    let at = states.position(|state| state.id == slot.id)?;
    Some(Effect::Derive(Box::new(HistoryText {
        ticket,
        timeline: shared.document.timeline(),
        at,
        scene: shared.disk.path.clone(),
        files: shared.assets.known(),
    })))
}

/// Traces a scene that was derived for a picture of the history.
pub(crate) fn derived(
    thumbnails: &mut Thumbnails,
    shared: &Shared,
    ticket: u64,
    derived: Result<HistoryScene, NoPicture>,
) -> Vec<Effect> {
    match (thumbnails.asked(ticket), derived) {
        (Some(slot), Ok(past)) => {
            let job = thumbnail_job(thumbnails, shared, slot, past).into_iter();
            job.map(|job| Effect::Trace(Target::Thumbnail, job))
                .collect()
        }
        (Some(_), Err(reason)) => {
            thumbnails.fail(reason);
            Vec::new()
        }
        (None, Ok(past)) => vec![Effect::Free(past.scene)],
        (None, Err(_)) => Vec::new(),
    }
}

/// The job of a picture: as the preview would show the text, from the working view if there is
/// one, so that pictures differ only by their texts; but always light, as files hold it.
fn thumbnail_job(
    thumbnails: &mut Thumbnails,
    shared: &Shared,
    slot: Slot,
    past: HistoryScene,
) -> Option<Job> {
    let own = past.scene.camera;
    let view = shared.pictures.view.map(|view| Camera {
        size: own.size,
        ..view
    });
    let camera = view.unwrap_or(own);
    let room = Rect::new(0, 0, slot.room.0, slot.room.1);
    let Some((_, size)) = raster(room, camera.size) else {
        thumbnails.fail(NoPicture::Failed("there is no room".to_owned()));
        return None;
    };
    let rendering = shared.pictures.rendering(Some(&past.scene));
    let rendering = Rendering {
        spp: Some(samples(rendering.integrator(), slot.rank)),
        filter: Some(Filter::Box),
        ..rendering
    };
    Some(Job {
        settings: Settings::new(size, &rendering),
        scene: past.scene,
        images: past.images,
        camera,
        limit: None,
        frames: Frames::Live,
        denoise: false,
        numbers: None,
    })
}

fn samples(integrator: Integrator, rank: Rank) -> u32 {
    let [row, large] = match integrator {
        Integrator::Whitted => WHITTED_SAMPLES,
        Integrator::Path | Integrator::Photon => PATH_SAMPLES,
    };
    match rank {
        Rank::Row => row,
        Rank::Large => large,
    }
}
