//! What steps of lessons are noticed by.

use std::sync::Arc;

use crate::app::{OnDisk, Shared};
use crate::keymap::Context;
use language::Node;
use render::Frame;

/// Whether a step is done, given how things were when it began.
pub(crate) type Goal = fn(&Shared, &Before) -> bool;

/// How things were when a step began.
#[derive(Debug)]
pub(crate) struct Before {
    text: Arc<String>,
    saved: Arc<String>,
    /// The number of undo steps that had been taken.
    present: usize,
    things: usize,
    lights: usize,
}

impl Before {
    pub(super) fn of(shared: &Shared) -> Self {
        Self {
            text: shared.document.shared_text(),
            saved: Arc::clone(shared.document.saved()),
            present: shared.document.present(),
            things: shared.nodes().iter().count(),
            lights: lights(shared),
        }
    }
}

fn lights(shared: &Shared) -> usize {
    shared.scene.as_ref().map_or(0, |scene| scene.lights.len())
}

/// Whether this object, counted from 0, is selected.
pub(super) fn has_selected<const OBJECT: usize>(shared: &Shared, _: &Before) -> bool {
    shared.cursor.selected() == Node::Object(OBJECT)
}

pub(super) fn edits(shared: &Shared, _: &Before) -> bool {
    shared.mode.name() == "EDIT"
}

pub(super) fn moves(shared: &Shared, _: &Before) -> bool {
    shared.mode.name() == "MOVE"
}

pub(super) fn looks(shared: &Shared, _: &Before) -> bool {
    shared.mode.name() == "VIEW"
}

pub(super) fn inspects(shared: &Shared, _: &Before) -> bool {
    shared.mode.name() == "INSPECT"
}

pub(super) fn is_in_the_list(shared: &Shared, _: &Before) -> bool {
    shared.mode.name() == "SELECT" && shared.context() != Context::Rays
}

pub(super) fn picks_a_colour(shared: &Shared, _: &Before) -> bool {
    shared.context() == Context::Colour
}

pub(super) fn explains(shared: &Shared, _: &Before) -> bool {
    shared.context() == Context::Rays
}

/// Whether the text has another value, and nothing is typed or tried out any more.
pub(super) fn has_changed(shared: &Shared, before: &Before) -> bool {
    let is_open = shared.cursor.typing.is_some() || picks_a_colour(shared, before);
    !is_open && !moves(shared, before) && shared.document.text() != before.text.as_str()
}

pub(super) fn has_undone(shared: &Shared, before: &Before) -> bool {
    shared.document.present() < before.present
}

pub(super) fn has_started_anew(shared: &Shared, _: &Before) -> bool {
    shared.disk.state == OnDisk::New
}

pub(super) fn has_added(shared: &Shared, before: &Before) -> bool {
    before.things < shared.nodes().iter().count()
}

pub(super) fn has_added_a_light(shared: &Shared, before: &Before) -> bool {
    before.lights < lights(shared)
}

pub(super) fn has_saved(shared: &Shared, _: &Before) -> bool {
    shared.disk.path.is_some() && !shared.document.is_dirty()
}

/// Whether the file holds another text than before, and so does the program.
pub(super) fn has_read(shared: &Shared, before: &Before) -> bool {
    has_saved(shared, before) && shared.document.saved() != &before.saved
}

pub(super) fn exports(shared: &Shared, _: &Before) -> bool {
    shared.jobs.export().is_some()
}

pub(super) fn has_no_errors(shared: &Shared, _: &Before) -> bool {
    shared.error_count() == 0 && finished(shared).is_some()
}

/// Whether the picture has become bright: its mean is over a sixth of white.
pub(super) fn is_lit(shared: &Shared, _: &Before) -> bool {
    let mean = finished(shared).map(|frame| mean_of(frame.pixels.iter()));
    mean.is_some_and(|[red, green, blue]| 3.0 * 42.0 < red + green + blue)
}

/// Whether more red than blue is seen in the pixels of the first object, which stands in front of something
/// red while what is behind the camera is blue.
pub(super) fn is_seen_through(shared: &Shared, _: &Before) -> bool {
    let Some(frame) = finished(shared) else {
        return false;
    };
    let pixels = frame.pixels.iter().zip(&frame.objects);
    let pixels = pixels.filter(|(_, object)| **object == 0);
    let [red, _, blue] = mean_of(pixels.map(|(pixel, _)| pixel));
    1.5 * blue < red
}

/// The finished preview of all of the scene, as light and in the scene's own view.
fn finished(shared: &Shared) -> Option<&Frame> {
    let pictures = &shared.pictures;
    let is_plain = pictures.aov.is_none() && pictures.solo.is_none() && pictures.view.is_none();
    let is_known = is_plain && shared.error_count() == 0 && pictures.preview.is_complete();
    pictures.preview.latest.as_deref().filter(|_| is_known)
}

/// The mean of pixels; black if there are none.
fn mean_of<'p>(pixels: impl Iterator<Item = &'p [u8; 3]>) -> [f64; 3] {
    let (mut sum, mut count) = ([0.0; 3], 0.0_f64);
    for pixel in pixels {
        for (sum, channel) in sum.iter_mut().zip(pixel) {
            *sum += f64::from(*channel);
        }
        count += 1.0;
    }
    sum.map(|sum| sum / count.max(1.0))
}
