//! What restarts when the scene, the view or the screen has changed, above all the preview.

use super::jobs::{follow_trace, shown_job};
use super::light::follow_histogram;
use super::zooming::preview_screen;
use crate::app::Shared;
use crate::app::pictures::frame_window::Grid;
use crate::app::pictures::viewport::{Detail, Screen};
use crate::msg::{Effect, Target};
use render::Region;
use scene::{Integrator, Size};

/// Samples per pixel at which the preview stops: by then edges are smooth and the noise of paths is
/// invisible. Where cells hold more pixels, each needs fewer samples.
fn preview_samples(integrator: Integrator, grid: Grid) -> u32 {
    let density = u32::from(grid.across) * u32::from(grid.down) / 2;
    let samples = match integrator {
        Integrator::Whitted => 64,
        Integrator::Path | Integrator::Photon => 1024,
    };
    samples / density.clamp(1, 4)
}

/// Requests the files that the scene needs, and restarts the full-size trace if it no longer shows the
/// scene.
pub(crate) fn follow_scene(shared: &mut Shared) -> Vec<Effect> {
    let mut effects = shared.assets.follow();
    // A picture without these files would be seen only for a moment.
    let is_due = !shared.assets.are_awaited() && std::mem::take(&mut shared.pictures.due);
    shared.pictures.has_changed = is_due;
    if is_due {
        shared.pictures.preview.asked = None;
        effects.extend(follow_trace(shared));
    }
    effects
}

/// Updates the preview and the histogram, once the modes have settled which picture is on screen. Any step
/// may have changed the camera, the display or the screen.
pub(crate) fn follow(shared: &mut Shared) -> Option<Effect> {
    let preview = follow_preview(shared);
    follow_histogram(shared);
    preview
}

/// Restarts the preview if it is on screen and no longer shows the scene.
fn follow_preview(shared: &mut Shared) -> Option<Effect> {
    if shared.assets.are_awaited() || shared.seen() != Target::Preview {
        return None;
    }
    let screen = preview_screen(shared);
    let asked = screen.map(|screen| preview_asked(shared, screen));
    if shared.pictures.preview.asked == asked {
        return None;
    }
    shared.pictures.preview.asked = asked;
    let (screen, (size, region)) = screen.zip(asked)?;
    let spp = preview_samples(shared.rendering().integrator(), screen.grid);
    let mut job = shown_job(shared, size, spp)?;
    job.settings.region = region;
    job.denoise = shared.pictures.display.denoised;
    job.settings.aov = shared.pictures.preview_aov();
    if let Some(aov) = job.settings.aov {
        job.settings.spp = aov.samples(spp);
    }
    Some(Effect::Trace(Target::Preview, job))
}

/// The size of the preview, and the part of it that is on screen.
fn preview_asked(shared: &Shared, screen: Screen) -> (Size, Option<Region>) {
    let viewport = shared.pictures.preview.viewport;
    let window = viewport.window(screen, Detail::OnScreen);
    match window.filter(|_| shared.pictures.wireframe.is_none()) {
        Some(window) => (window.whole, Some(window.part)),
        None => (screen.grid.size(screen.halves), None),
    }
}

/// Brings the wireframe up to date, if it is on screen.
pub(crate) fn follow_wires(shared: &mut Shared) {
    if shared.seen() != Target::Preview {
        return;
    }
    let (camera, raster) = (shared.camera(), shared.raster());
    if let (Some(wireframe), Some(scene)) = (&mut shared.pictures.wireframe, &shared.scene)
        && let (Some(camera), Some((_, size))) = (camera, raster)
    {
        wireframe.follow(scene, camera, size);
    }
}
