//! The jobs of pictures, and restarting the full-size trace.

use std::sync::Arc;

use super::soloing::preview_scene;
use crate::app::Shared;
use crate::msg::{Effect, Target};
use render::{Frames, Job, Settings};
use scene::{Filter, Rendering, Scene, Size};

/// The job that traces a scene, with this pixel filter if another than that asked for.
fn job_of(
    shared: &Shared,
    scene: Arc<Scene>,
    size: Size,
    spp: u32,
    filter: Option<Filter>,
) -> Option<Job> {
    let asked = shared.pictures.rendering(Some(&scene));
    let rendering = Rendering {
        spp: Some(shared.pictures.samples(spp)),
        filter: filter.or(asked.filter),
        ..asked
    };
    Some(Job {
        scene,
        images: shared.assets.loaded.images.clone(),
        camera: shared.camera()?,
        settings: Settings {
            aov: shared.pictures.aov,
            ..Settings::new(size, &rendering)
        },
        limit: None,
        frames: Frames::Live,
        denoise: false,
        numbers: None,
    })
}

/// The job of what the preview shows of the scene.
pub(crate) fn shown_job(shared: &Shared, size: Size, spp: u32) -> Option<Job> {
    let (scene, numbers) = preview_scene(shared)?;
    let job = job_of(shared, scene, size, spp, Some(Filter::Box))?;
    Some(Job { numbers, ..job })
}

/// The job of a picture in the quality of exports, or the reason why there is none.
pub(crate) fn final_job(shared: &Shared, size: Size, spp: u32) -> Result<Job, String> {
    let scene = shared.scene.as_ref().map(Arc::clone);
    let job = scene.and_then(|scene| job_of(shared, scene, size, spp, None));
    job.filter(|_| !shared.assets.are_awaited())
        .ok_or_else(|| shared.no_picture())
}

/// The job of the full-size trace, or the reason why there is none.
pub(crate) fn trace_job(shared: &Shared) -> Result<Job, String> {
    let (spp, limit) = shared.until().limits();
    let mut job = final_job(shared, shared.output(), spp)?;
    job.limit = limit;
    job.denoise = shared.pictures.display.denoised;
    job.settings.region = shared.region();
    Ok(job)
}

/// Restarts the full-size trace if it is on screen, and otherwise drops it.
pub(super) fn follow_trace(shared: &mut Shared) -> Vec<Effect> {
    match shared.pictures.trace {
        None => Vec::new(),
        Some(_) if shared.seen() == Target::Trace => restart_trace(shared),
        Some(_) => {
            shared.pictures.trace = None;
            vec![Effect::Stop(Target::Trace)]
        }
    }
}

/// Restarts the full-size trace if it is running; it continues from the pixels that stay valid.
pub(crate) fn retrace(shared: &mut Shared) -> Vec<Effect> {
    if shared.pictures.is_tracing() {
        restart_trace(shared)
    } else {
        Vec::new()
    }
}

fn restart_trace(shared: &mut Shared) -> Vec<Effect> {
    let Ok(job) = trace_job(shared) else {
        return Vec::new();
    };
    if let Some(trace) = &mut shared.pictures.trace {
        trace.paused = false;
    }
    vec![Effect::Trace(Target::Trace, job)]
}
