//! Pictures of the sample scenes on their page: what is wanted, derived and traced.

use ratatui::layout::Rect;

use super::page::{carried, shown_samples};
use crate::app::history::{Rank, Slot, Thumbnails, body, history_layout};
use crate::app::room::Room;
use crate::app::shared::Shared;
use crate::history_scene::{HistoryScene, HistoryText, KnownFiles, NoPicture};
use crate::keymap::Context;
use crate::layout::raster;
use crate::msg::{Effect, Target};
use document::Document;
use render::{Frames, Job, Settings};
use scene::{Filter, Integrator, Rendering};

/// Samples per pixel of the pictures in rows and of the large one. What paths leave of noise is reduced.
const WHITTED_SAMPLES: [u32; 2] = [4, 16];
const PATH_SAMPLES: [u32; 2] = [128, 256];

/// Tickets of requests are after this one, which those of the undo history never reach.
const TICKETS: u64 = 1 << 32;

/// The pictures on the page of the sample scenes.
#[derive(Debug)]
pub struct Gallery {
    /// By the numbers of the samples on the page.
    pub(crate) pictures: Thumbnails<usize>,
}

impl Default for Gallery {
    fn default() -> Self {
        Self {
            pictures: Thumbnails::numbered_from(TICKETS),
        }
    }
}

impl Room for Gallery {
    /// The samples are the same whatever scene is open.
    fn renew(&mut self) {}

    /// Requests the next picture on the page. Stops tracing if the page is closed.
    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        if shared.overlays.page(Context::Samples).is_none() {
            let is_under_way = self.pictures.cancel();
            let stop = is_under_way.then_some(Effect::Stop(Target::Thumbnail));
            return stop.into_iter().collect();
        }
        let wanted = wanted_slots(shared);
        let next = self.pictures.next(&wanted);
        let derive = next.and_then(|(slot, ticket)| derive(slot.id, ticket));
        derive.into_iter().collect()
    }
}

/// The pictures on the page, the most urgent first: those in rows from the selected one outwards, which take
/// less time, then the large one.
fn wanted_slots(shared: &Shared) -> Vec<Slot<usize>> {
    let Some(page) = shared.overlays.page(Context::Samples) else {
        return Vec::new();
    };
    let strip = history_layout(shared, body(shared));
    let shown = page.shown();
    let at = page.filter.at;
    let id = |row: usize| shown.get(row).map(|(id, _)| *id);
    let large = strip.large.and_then(|large| {
        Some(Slot {
            id: id(at)?,
            rank: Rank::Large,
            room: (large.width, large.height),
        })
    });
    let mut rows: Vec<_> = strip.rows(at, shown.len()).map(|(row, _)| row).collect();
    rows.sort_by_key(|row| row.abs_diff(at));
    let rows = rows.into_iter().filter_map(|row| {
        Some(Slot {
            id: id(row)?,
            rank: Rank::Row,
            room: strip.thumbnail?,
        })
    });
    rows.chain(large).collect()
}

/// Requests the scene of a sample.
fn derive(at: usize, ticket: u64) -> Option<Effect> {
    let carried = carried(shown_samples().nth(at)?)?;
    let document = Document::new(carried.language, carried.text.to_owned());
    Some(Effect::Derive(Box::new(HistoryText {
        ticket,
        timeline: document.timeline(),
        at: 0,
        scene: None,
        files: KnownFiles::default(),
    })))
}

/// Traces a scene that was derived for a picture of the page.
pub(crate) fn derived(
    gallery: &mut Gallery,
    ticket: u64,
    derived: Result<HistoryScene, NoPicture>,
) -> Vec<Effect> {
    let Some(slot) = gallery.pictures.asked(ticket) else {
        return derived
            .map(|past| Effect::Free(past.scene))
            .into_iter()
            .collect();
    };
    let job = derived.and_then(|derived| picture_job(slot, derived));
    match job {
        Ok(job) => vec![Effect::Trace(Target::Thumbnail, job)],
        Err(reason) => {
            gallery.pictures.fail(reason);
            Vec::new()
        }
    }
}

/// Whether the tickets of requests are those of this page.
pub(crate) fn is_ticket(ticket: u64) -> bool {
    TICKETS < ticket
}

/// The job of a picture: what its scene says, without grain.
fn picture_job(slot: Slot<usize>, derived: HistoryScene) -> Result<Job, NoPicture> {
    let camera = derived.scene.camera;
    let room = Rect::new(0, 0, slot.room.0, slot.room.1);
    let Some((_, size)) = raster(room, camera.size) else {
        return Err(NoPicture::Failed("there is no room".to_owned()));
    };
    let own = derived.scene.setting.rendering;
    let is_noisy = own.integrator() != Integrator::Whitted;
    let [row, large] = if is_noisy {
        PATH_SAMPLES
    } else {
        WHITTED_SAMPLES
    };
    let spp = match slot.rank {
        Rank::Row => row,
        Rank::Large => large,
    };
    let rendering = Rendering {
        spp: Some(spp),
        filter: Some(Filter::Box),
        ..own
    };
    Ok(Job {
        settings: Settings::new(size, &rendering),
        scene: derived.scene,
        images: derived.images,
        camera,
        limit: None,
        // Noise is reduced in the pixels of the last frame only.
        frames: if is_noisy { Frames::Last } else { Frames::Live },
        denoise: is_noisy,
        numbers: None,
    })
}
