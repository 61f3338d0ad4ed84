//! Comparing pictures: traces what corresponds to the reference, and looks at both.

use std::sync::Arc;

use super::asking::ask_for_reference;
use super::contrast::{Contrast, fitting_gain};
use super::grading::{graded_aov, graded_job};
use super::state::{Compare, Origin, Reference, Wipe, Work, shown};
use crate::app::pictures::picture::Picture;
use crate::app::refusing::Refusable;
use crate::app::{Cross, Shared, display, inspect};
use crate::keymap::Mode;
use crate::msg::{Effect, Target};
use image_file::ImageFormat;
use render::{Frame, Job, Settings};
use scene::{Camera, Images, Rendering, Scene, Size};

/// Starts to compare, or stops.
pub(crate) fn start(compare: &mut Compare, shared: &mut Shared) -> Vec<Effect> {
    if shared.mode == Mode::Compare {
        end(shared);
        return Vec::new();
    }
    if compare.reference.is_none() {
        ask_for_reference(shared);
        return Vec::new();
    }
    shared.document.end_step();
    let jobs = comparison(compare, shared);
    if jobs.or_refuse_picture(shared).is_none() {
        return Vec::new();
    }
    shared.pictures.before_comparison = Some(shared.mode);
    shared.mode = Mode::Compare;
    compare.due = true;
    let own = shared.output();
    let pinned = compare.pinned_size();
    if let Some(size) = pinned.filter(|size| *size != own) {
        let [theirs, own] = [size, own].map(|Size { width, height }| format!("{width}×{height}"));
        shared.say(format!(
            "traced at {theirs}, the size of the pinned picture; the scene's own is {own}"
        ));
    }
    Vec::new()
}

/// Returns to the mode before the comparison.
pub(crate) fn end(shared: &mut Shared) {
    let before = shared.pictures.before_comparison.take();
    shared.mode = before.unwrap_or(Mode::Select);
}

/// Traces what is compared if it is not up to date, while a comparison is seen, and otherwise nothing.
pub(super) fn follow(compare: &mut Compare, shared: &mut Shared) -> Vec<Effect> {
    if shared.assets.are_awaited() {
        return Vec::new();
    }
    if shared.seen() != Target::Compared {
        if !compare.end() {
            return Vec::new();
        }
        shared.pictures.compared = Picture::default();
        return [Target::Compared, Target::Reference]
            .map(Effect::Stop)
            .into();
    }
    if !std::mem::take(&mut compare.due) && !shared.pictures.has_changed {
        let pair = compare.next_to_measure();
        return pair.map(Effect::Compare).into_iter().collect();
    }
    let jobs = comparison(compare, shared);
    let Some((live, reference)) = jobs.or_refuse_picture(shared) else {
        end(shared);
        return follow(compare, shared);
    };
    compare.begin();
    let other = match reference {
        Some(job) => Effect::Trace(Target::Reference, job),
        None => Effect::Stop(Target::Reference),
    };
    vec![Effect::Trace(Target::Compared, live), other]
}

/// What to trace of the present scene, and of its reference if that is a scene.
fn comparison(compare: &Compare, shared: &Shared) -> Result<(Job, Option<Job>), String> {
    let reference = compare.reference.as_ref().ok_or_else(|| {
        let pin = shared.key_for("pin");
        format!("nothing to compare with: {pin} pins the picture, :compare FILE loads one")
    })?;
    comparison_jobs(shared, reference)
}

/// What to trace of the present scene, and of a reference if that is a scene; the error says why
/// they cannot be compared.
pub(super) fn comparison_jobs(
    shared: &Shared,
    reference: &Reference,
) -> Result<(Job, Option<Job>), String> {
    let (size, spp) = match (&reference.origin, &reference.frame) {
        (&Origin::Preview(halves, grid, spp, size), _) => {
            let job = display::shown_job(shared, grid.size(halves), spp);
            let mut job = job.ok_or_else(|| shared.no_picture())?;
            job.camera.size = size;
            return Ok((job, None));
        }
        (Origin::File(made), Some(frame)) => {
            return Ok((graded_job(shared, made, frame.size)?, None));
        }
        (Origin::Traced(spp), Some(frame)) => (frame.size, *spp),
        _ => (shared.output(), shared.rendering().spp()),
    };
    if let Some(reason) = ImageFormat::Bmp.refuses(size) {
        return Err(reason);
    }
    let mut live = display::final_job(shared, size, spp)?;
    // As exports of this size are framed.
    live.camera.size = size;
    let other = match &reference.origin {
        Origin::Scene(scene, images, _) => Some(reference_job(shared, scene, images, &live)),
        Origin::Preview(..) | Origin::Traced(_) | Origin::File(_) => None,
    };
    Ok((live, other))
}

/// What to trace of a scene that is compared with the present one: the same, except for what the
/// scene itself says.
fn reference_job(shared: &Shared, scene: &Arc<Scene>, images: &Images, live: &Job) -> Job {
    let rendering = Rendering {
        spp: Some(live.settings.spp),
        ..shared.pictures.rendering(Some(scene))
    };
    let camera = shared.pictures.view.unwrap_or(scene.camera);
    Job {
        scene: Arc::clone(scene),
        images: images.clone(),
        camera: Camera {
            size: live.settings.size,
            ..camera
        },
        settings: Settings {
            aov: live.settings.aov,
            ..Settings::new(live.settings.size, &rendering)
        },
        ..live.clone()
    }
}

/// What is unlike about the two pictures, if they show different things: `light against depth`.
pub(crate) fn unlike(compare: &Compare, shared: &Shared) -> Option<String> {
    let reference = compare.reference.as_ref()?;
    let shows = reference.shows?;
    let aov = match &reference.origin {
        Origin::File(made) => graded_aov(shared, made),
        _ => shared.pictures.aov,
    };
    let live = shown(aov);
    (live != shows).then(|| format!("{live} against {shows}"))
}

/// Lends the present picture to what all modes share: seen alone in INSPECT, otherwise compared.
pub(super) fn lend(compare: &mut Compare, shared: &mut Shared) {
    let work = match shared.mode {
        Mode::Inspect => Work::Inspected,
        _ => Work::Compared,
    };
    lend_for(compare, shared, work);
    shared.pictures.compared.wanted = compare.wanted;
}

fn lend_for(compare: &mut Compare, shared: &mut Shared, work: Work) {
    let changes = compare.go_over_to(work);
    shared.pictures.compared_size = compare.framed();
    if changes && shared.seen() == Target::Compared {
        show(compare, shared);
    }
}

/// Takes a frame of either picture.
pub(crate) fn take_frame(
    compare: &mut Compare,
    shared: &mut Shared,
    target: Target,
    frame: Arc<Frame>,
) {
    if compare.take(target, frame) {
        show(compare, shared);
    }
}

/// Selects what of both pictures is seen.
fn look(compare: &mut Compare, shared: &mut Shared, view: Contrast, wipe: Wipe) {
    if (compare.view, compare.wipe) != (view, wipe) {
        (compare.view, compare.wipe) = (view, wipe);
        show(compare, shared);
    }
}

/// Puts what is seen of both pictures on screen.
fn show(compare: &Compare, shared: &mut Shared) {
    if let Some(seen) = compare.seen() {
        shared.pictures.compared.take(seen);
    }
}

/// Zooms by doublings about the pixel that is pointed at, otherwise about the middle.
pub(super) fn magnify(compare: &Compare, shared: &mut Shared, steps: i8) {
    let pointed = cross_on_screen(compare, shared);
    display::magnify_about(shared, steps, pointed);
}

/// Shows the two pictures in another way.
pub(super) fn view_as(compare: &mut Compare, shared: &mut Shared, view: Contrast) {
    look(compare, shared, view, compare.wipe);
}

/// Shows the difference, or the next way to show it.
pub(super) fn view_difference(compare: &mut Compare, shared: &mut Shared) {
    let pair = compare.pair();
    let gain = pair.map_or(1, |pair| {
        fitting_gain([&pair.live.pixels, &pair.reference.pixels])
    });
    view_as(compare, shared, compare.view.next_difference(gain));
}

/// Moves the line of the wipe by some cells to the right.
pub(super) fn slide_wipe(compare: &mut Compare, shared: &mut Shared, cells: i16) {
    let raster = shared.raster().zip(display::frame_window(shared));
    let Some(((area, halves), frame_window)) = raster else {
        return;
    };
    // The cells across the whole picture.
    let width = f64::from(area.width) * frame_window.magnification(halves);
    let column = (compare.wipe.0 * width).round() + f64::from(cells);
    let wipe = Wipe(column.clamp(0.0, width) / width);
    look(compare, shared, Contrast::Wipe, wipe);
}

/// Points at one of the worst pixels.
pub(super) fn go_to_worst(compare: &mut Compare, shared: &mut Shared, step: isize) {
    if let Err(reason) = compare.go_to_worst(step) {
        shared.say(reason);
    } else if let Some(place) = cross_on_screen(compare, shared) {
        display::centre_on(shared, place);
    }
}

/// Explains the pixel of the present picture that is pointed at, otherwise the worst one.
pub(super) fn explain(compare: &mut Compare, shared: &mut Shared) {
    if compare.cross.is_none() {
        go_to_worst(compare, shared, 1);
    }
    let place = compare.live().map(|live| (live.corner, live.whole()));
    if let Some(((x, y), ([left, top], size))) = compare.cross.zip(place) {
        lend_for(compare, shared, Work::Inspected);
        let pixel = [left + x, top + y];
        inspect::explain_at(shared, Cross { pixel, size });
    }
}

/// Where the pixel that is pointed at is on screen, in half blocks from the picture's upper left
/// corner.
pub(crate) fn cross_on_screen(compare: &Compare, shared: &Shared) -> Option<[f64; 2]> {
    let here = compare.at_cross()?;
    let size = compare.pair()?.size()?;
    let (_, halves) = shared.raster()?;
    let scaled = |at: u32, pixels: u32, shown: u32| {
        (f64::from(at) + 0.5) / f64::from(pixels) * f64::from(shown)
    };
    let place = [
        scaled(here.x, size.width, halves.width),
        scaled(here.y, size.height, halves.height),
    ];
    Some(display::frame_window(shared)?.on_screen(place, halves))
}

/// Where the line of the wipe is on screen, in half blocks from the picture's left edge, if it is
/// seen.
pub(crate) fn wipe_on_screen(compare: &Compare, shared: &Shared) -> Option<f64> {
    let (_, halves) = shared.raster()?;
    let at = compare.wipe.0 * f64::from(halves.width);
    let [column, _] = display::frame_window(shared)?.on_screen([at, 0.0], halves);
    (compare.view == Contrast::Wipe).then_some(column)
}

/// Moves the line of the wipe to a cell of the screen; in other views, points at the pixel there.
pub(super) fn press(compare: &mut Compare, shared: &mut Shared, at: (u16, u16)) {
    let cell = display::picture_cell(shared, at);
    let Some([x, y]) = cell.and_then(|cell| display::pixel_at(shared, cell)) else {
        return;
    };
    let seen = shared.pictures.compared.latest.as_ref();
    match (compare.view, seen) {
        (Contrast::Wipe, Some(seen)) => {
            let wipe = Wipe(f64::from(x) / f64::from(seen.size.width));
            look(compare, shared, Contrast::Wipe, wipe);
        }
        _ => compare.cross = Some((x, y)),
    }
}
