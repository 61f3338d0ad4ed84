//! The rays recorded so far.

use super::record::{LightTerm, RayEnd, Shading, TracedRay};
use scene::Rgb;

/// Lights listed per sample: a scene may have 100,000 lights, a sample 4096 rays.
const MOST_TERMS: usize = 1 << 14;

/// Collects the rays of a sample, in the order in which they are traced.
#[derive(Debug)]
pub(super) struct Recorder {
    pub(super) rays: Vec<TracedRay>,
    /// Lights that may still be listed.
    room: usize,
}

impl Recorder {
    /// Creates one without rays.
    pub(super) fn new() -> Self {
        Self {
            rays: Vec::new(),
            room: MOST_TERMS,
        }
    }

    /// The index of the current ray, the last one begun.
    pub(super) fn current(&self) -> Option<usize> {
        self.rays.len().checked_sub(1)
    }

    /// Begins a ray.
    pub(super) fn begin(&mut self, ray: TracedRay) {
        self.rays.push(ray);
    }

    /// Ends the current ray.
    pub(super) fn end(&mut self, end: RayEnd, contribution: Rgb) {
        if let Some(ray) = self.rays.last_mut() {
            ray.end = end;
            ray.contribution = contribution;
        }
    }

    /// Lists a light at the end of the current ray, which `term` describes, as long as there is room;
    /// otherwise only sums what it `added`.
    pub(super) fn list(
        &mut self,
        shading: &mut Shading,
        added: Rgb,
        term: impl FnOnce(&Shading) -> Option<LightTerm>,
    ) {
        if self.room == 0 {
            shading.unlisted.lights += 1;
            shading.unlisted.radiance += added;
            return;
        }
        let term = term(shading);
        self.room -= usize::from(term.is_some());
        shading.lights.extend(term);
    }
}
