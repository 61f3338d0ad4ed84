//! The picture that is compared with a reference, and how they differ.

use std::sync::Arc;

use super::contrast::Contrast;
use crate::app::pictures::frame_window::Grid;
use crate::msg::Target;
use crate::reference::{Made, Pair, ReferenceId, ReferenceRead};
use compare::{Comparison, Difference};
use image_file::in_8_bits;
use render::{Aov, Frame, NO_OBJECT, Progress};
use scene::{Images, Scene, Size};

/// What pictures are compared with, and in COMPARE the comparison.
#[derive(Debug, Default)]
pub struct Compare {
    /// What pictures are compared with; `None` before anything is pinned or loaded.
    pub reference: Option<Reference>,
    /// The generation of the present picture; `None` if it will not be finished.
    pub(super) wanted: Option<u64>,
    /// What of both pictures is seen.
    pub view: Contrast,
    /// Where the line of [`Contrast::Wipe`] is.
    pub wipe: Wipe,
    /// The pixel that is pointed at, if any: column and row.
    pub cross: Option<(u32, u32)>,
    /// Whether the pictures must be traced again.
    pub(crate) due: bool,
    /// What the pictures are used for.
    work: Work,
    /// The newest frame of the present picture.
    live: Option<Arc<Frame>>,
    /// The figures found last, and of which frames.
    figures: Option<(Pair, Arc<Comparison>)>,
    /// Whether figures are on their way.
    is_measuring: bool,
    /// The reference requested last and what to call it, until it arrives.
    asked: Option<(ReferenceId, String)>,
    /// The number of references requested.
    requests: u32,
}

/// What pictures are compared with.
#[derive(Debug)]
pub struct Reference {
    /// What it is called: `theirs.ppm`.
    pub name: String,
    /// What it shows, such as `light`; `None` if that is unknown or follows the present picture.
    pub shows: Option<&'static str>,
    /// How it was made.
    pub(crate) origin: Origin,
    /// Its picture; of a scene the newest frame.
    pub frame: Option<Arc<Frame>>,
}

/// How a reference was made, which says how to trace what is compared with it.
#[derive(Clone, Debug)]
pub(crate) enum Origin {
    /// As a preview of this size in half blocks on this grid, with so many samples per pixel, of an
    /// output picture of the last size.
    Preview(Size, Grid, u32, Size),
    /// At full size, with so many samples per pixel.
    Traced(u32),
    /// It was read from a file.
    File(Made),
    /// It is a scene, traced with the present settings, with the images of its textures; the
    /// generation requested last.
    Scene(Arc<Scene>, Images, Option<u64>),
}

/// What the compared pictures are used for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Work {
    /// Nothing: they are not traced.
    #[default]
    None,
    /// They are compared: both are seen.
    Compared,
    /// The present one is seen alone, to be inspected with all that is known of its pixels.
    Inspected,
}

/// What a picture shows, in a word.
pub(super) fn shown(aov: Option<Aov>) -> &'static str {
    aov.map_or("light", Aov::name)
}

/// A place between the left edge of a picture, 0, and the right one, 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wipe(pub f64);

impl Default for Wipe {
    fn default() -> Self {
        Self(0.5)
    }
}

impl Compare {
    /// Begins to wait for a reference, instead of one that is still being read.
    pub(crate) fn ask(&mut self, name: String) -> ReferenceId {
        self.requests += 1;
        let id = ReferenceId(self.requests);
        self.asked = Some((id, name));
        id
    }

    /// The reference requested last.
    #[cfg(test)]
    pub(crate) fn requested(&self) -> ReferenceId {
        ReferenceId(self.requests)
    }

    /// What to call a reference that was read, unless another was requested since.
    pub(crate) fn answered(&mut self, id: ReferenceId) -> Option<String> {
        let asked = self.asked.take_if(|(asked, _)| *asked == id);
        asked.map(|(_, name)| name)
    }

    /// Replaces the reference, and returns the former one.
    pub(crate) fn refer(&mut self, reference: Reference) -> Option<Reference> {
        self.due = true;
        self.figures = None;
        self.cross = None;
        self.reference.replace(reference)
    }

    /// Records that the pictures are traced from now on, to be compared unless one is inspected.
    pub(crate) fn begin(&mut self) {
        if self.work == Work::None {
            self.work = Work::Compared;
        }
    }

    /// Forgets the pictures; returns whether any were being traced, or had been.
    pub(crate) fn end(&mut self) -> bool {
        if std::mem::take(&mut self.work) == Work::None {
            return false;
        }
        self.wanted = None;
        self.live = None;
        self.figures = None;
        self.cross = None;
        if let Some(Reference { origin, frame, .. }) = &mut self.reference
            && let Origin::Scene(.., wanted) = origin
        {
            (*wanted, *frame) = (None, None);
        }
        true
    }

    /// Records the generation of a picture, or `None` if it will not be finished.
    pub(crate) fn want(&mut self, target: Target, generation: Option<u64>) {
        if target == Target::Compared {
            self.wanted = generation;
        } else if target == Target::Reference
            && let Some(reference) = &mut self.reference
            && let Origin::Scene(.., wanted) = &mut reference.origin
        {
            *wanted = generation;
        }
    }

    /// Takes a frame of either picture; returns whether that changes what is seen.
    pub(crate) fn take(&mut self, target: Target, frame: Arc<Frame>) -> bool {
        // Of a picture that is denoised, only the last frame has pixels.
        if self.work == Work::None || frame.pixels.is_empty() {
            return false;
        }
        if target == Target::Compared {
            let reference = self.reference.as_ref();
            let like = reference.and_then(|reference| reference.alike(&frame));
            self.live = Some(like.map_or(frame, Arc::new));
        } else if target == Target::Reference
            && let Some(reference) = &mut self.reference
            && let Origin::Scene(.., Some(_)) = reference.origin
        {
            reference.frame = Some(frame);
        }
        true
    }

    /// Uses the pictures for something else, if they are used; returns whether that changes what is seen.
    pub(super) fn go_over_to(&mut self, work: Work) -> bool {
        let changes = self.work != Work::None && self.work != work;
        if changes {
            self.work = work;
        }
        changes
    }

    /// Takes the figures of frames.
    pub(crate) fn measured(&mut self, pair: Pair, found: Option<Arc<Comparison>>) {
        self.is_measuring = false;
        if self.work != Work::None {
            self.figures = found.map(|found| (pair, found));
        }
    }

    /// The frames to measure next: complete ones, and those of at least twice as many samples as
    /// were measured before; FLIP takes longer than the next frame.
    pub(crate) fn next_to_measure(&mut self) -> Option<Pair> {
        let pair = self.pair().filter(|_| !self.is_measuring)?;
        let samples = |pair: &Pair| pair.live.progress.spp.min(pair.reference.progress.spp);
        let is_worthwhile = match &self.figures {
            Some((before, _)) if before.is(&pair) => false,
            _ if self.is_settled() => true,
            Some((before, _)) => 2 * samples(before) <= samples(&pair),
            None => 1 <= samples(&pair),
        };
        self.is_measuring = is_worthwhile;
        is_worthwhile.then_some(pair)
    }

    /// How the pictures differ, as far as that is known.
    pub fn figures(&self) -> Option<&Comparison> {
        self.figures.as_ref().map(|(_, found)| &**found)
    }

    /// Whether the figures are those of both pictures when complete.
    pub fn are_figures_final(&self) -> bool {
        let pair = self.pair();
        let figures = self.figures.as_ref().zip(pair);
        self.is_settled() && figures.is_some_and(|((of, _), pair)| of.is(&pair))
    }

    /// Whether a sample of either picture is still to be taken.
    pub fn is_awaited(&self) -> bool {
        let of_reference = self.reference.as_ref().is_some_and(Reference::is_awaited);
        let of_live = self.wanted.is_some() && !self.is_live_complete();
        self.work != Work::None && (of_reference || of_live)
    }

    /// Progress of the present picture.
    pub fn progress(&self) -> Option<&Progress> {
        self.live.as_ref().map(|live| &live.progress)
    }

    /// The newest frame of the present picture, if it shows the present scene.
    pub(crate) fn live(&self) -> Option<&Arc<Frame>> {
        let live = self.live.as_ref();
        live.filter(|live| self.wanted == Some(live.generation))
    }

    /// Both pictures, once they have the same size.
    pub fn pair(&self) -> Option<Pair> {
        let reference = self.reference.as_ref()?.frame.clone()?;
        let live = self.live.clone()?;
        let pair = Pair { live, reference };
        pair.size().is_some().then_some(pair)
    }

    /// The colours of a pixel in both pictures.
    pub fn at_cross(&self) -> Option<Difference> {
        let (x, y) = self.cross?;
        let pair = self.pair()?;
        let size = pair.size()?;
        if size.width <= x || size.height <= y {
            return None;
        }
        let at = y as usize * size.width as usize + x as usize;
        Some(Difference {
            x,
            y,
            colours: [pair.live.pixels[at], pair.reference.pixels[at]],
        })
    }

    /// The size of the picture on screen, whose aspect ratio it has there; `None` if that is the scene's
    /// own.
    pub(crate) fn framed(&self) -> Option<Size> {
        let reference = self.reference.as_ref()?;
        match (&reference.origin, self.work, &self.live) {
            (Origin::Scene(..), ..) => None,
            (Origin::Preview(.., output), ..) => Some(*output),
            (_, Work::Inspected, Some(live)) => Some(live.whole()),
            _ => reference.frame.as_ref().map(|frame| frame.size),
        }
    }

    /// The size of the output picture that a reference was pinned of.
    pub(crate) fn pinned_size(&self) -> Option<Size> {
        let reference = self.reference.as_ref()?;
        match reference.origin {
            Origin::Preview(.., output) => Some(output),
            Origin::Traced(_) => reference.frame.as_ref().map(|frame| frame.size),
            Origin::File(_) | Origin::Scene(..) => None,
        }
    }

    /// Points at the next or previous of the worst pixels; fails if there is none.
    pub(crate) fn go_to_worst(&mut self, step: isize) -> Result<(), &'static str> {
        let found = self
            .figures()
            .ok_or("the pictures are still being compared")?;
        let worst: Vec<_> = found.worst.iter().map(|worst| (worst.x, worst.y)).collect();
        let count = worst.len() as isize;
        if count == 0 {
            return Err("no pixel differs");
        }
        let at = match worst.iter().position(|place| Some(*place) == self.cross) {
            Some(at) => (at as isize + step).rem_euclid(count),
            None if step < 0 => count - 1,
            None => 0,
        };
        self.cross = worst.get(at as usize).copied();
        Ok(())
    }

    fn is_live_complete(&self) -> bool {
        self.live().is_some_and(|live| live.progress.complete)
    }

    /// Whether both pictures are complete.
    fn is_settled(&self) -> bool {
        self.is_live_complete() && self.reference.as_ref().is_some_and(Reference::is_settled)
    }

    /// The frame to see of both pictures; without a reference of the same size, the present one alone.
    pub(crate) fn seen(&self) -> Option<Arc<Frame>> {
        let live = self.live.as_ref()?;
        if self.work == Work::Inspected {
            return Some(Arc::clone(live));
        }
        let pixels = match self.pair() {
            Some(pair) => {
                let both = [&pair.live.pixels[..], &pair.reference.pixels];
                self.view.pixels(both, live.size, self.wipe.0)
            }
            None => live.pixels.clone(),
        };
        let progress = Progress {
            complete: self.is_settled(),
            ..live.progress
        };
        Some(Arc::new(Frame {
            generation: live.generation,
            objects: vec![NO_OBJECT; pixels.len()],
            progress,
            ..Frame::drawn(live.size, pixels)
        }))
    }
}

impl Reference {
    /// Whether its picture is complete.
    fn is_settled(&self) -> bool {
        match (&self.origin, &self.frame) {
            (Origin::Scene(.., wanted), Some(frame)) => {
                *wanted == Some(frame.generation) && frame.progress.complete
            }
            (_, frame) => frame.is_some(),
        }
    }

    /// The frame with the pixels that correspond to those of this, if they are others.
    fn alike(&self, frame: &Frame) -> Option<Frame> {
        let holds_light = matches!(&self.origin, Origin::File(made) if made.holds_light);
        let pixels = holds_light.then(|| in_8_bits(frame)).flatten()?;
        Some(Frame {
            pixels,
            ..frame.clone()
        })
    }

    /// Whether a sample of its picture is still to be taken.
    fn is_awaited(&self) -> bool {
        matches!(self.origin, Origin::Scene(.., Some(_))) && !self.is_settled()
    }

    /// One that was read.
    pub(crate) fn read(name: String, read: ReferenceRead) -> Self {
        let (shows, origin, frame) = match read {
            ReferenceRead::Picture(frame, made) => {
                let record = made.record.as_ref();
                let shows = record.map(|record| shown(record.aov));
                (shows, Origin::File(made), Some(frame))
            }
            ReferenceRead::Scene(scene, images) => (None, Origin::Scene(scene, images, None), None),
        };
        Self {
            name,
            shows,
            origin,
            frame,
        }
    }
}
