//! The render settings suggested for a picture.

use crate::language::RenderKey;
use crate::render::Trials;
use crate::scene::Rendering;

/// A render setting and its value.
pub(super) type Cure = (RenderKey, String);

/// The suggested cures.
#[derive(Debug, Default)]
pub struct Cures {
    /// For what the text shows.
    pub(super) of_text: Vec<Cure>,
    /// For what the preview shows.
    pub(super) of_picture: Vec<Cure>,
    /// What was said of a preview that is black or too bright, while it is so.
    pub(super) said: Option<String>,
    /// The trials under way, before the preview is said to be too bright.
    pub(super) trials: Option<RunningTrials>,
}

/// Trials of what darkens a preview that is too bright.
#[derive(Debug)]
pub(super) struct RunningTrials {
    pub(super) next: Trials,
    /// The generation of the picture under way, once it is traced.
    pub(super) generation: Option<u64>,
    /// By how many stops the 99th percentile of the preview is above 1.
    pub(super) over: f64,
    /// What the preview is of: the text's revision, and the render settings.
    pub(super) of: (u64, Rendering),
}

impl Cures {
    /// Notes the generation of the picture by which a cure is tried.
    pub(super) fn started(&mut self, generation: u64) {
        if let Some(trials) = &mut self.trials {
            trials.generation = Some(generation);
        }
    }

    /// Whether a cure is being tried.
    pub fn are_awaited(&self) -> bool {
        self.trials.is_some()
    }
}
