//! The render setting suggested for a picture.

use language::Prospect;
use render::{Frame, Progress, SettingSearch};
use scene::{RenderKey, Rendering};

/// A render setting and its value.
pub(crate) type Suggestion = (RenderKey, String);

/// What is wrong with the picture, and the setting that helps.
#[derive(Debug, Default)]
pub struct Suggestions {
    /// What the text shows of its picture.
    pub(crate) prospects: Vec<Prospect>,
    /// What helps, as trials of the preview have shown.
    pub(crate) cure: Option<Suggestion>,
    /// What was said of a preview with which something is wrong, while it is so.
    pub(crate) said: Option<String>,
    /// The trials under way, before that is said.
    pub(crate) trials: Option<RunningTrials>,
    /// The generation of the preview that was judged before it was complete.
    judged: Option<u64>,
}

/// Trials of what fixes the preview.
#[derive(Debug)]
pub(crate) struct RunningTrials {
    pub(crate) next: SettingSearch,
    /// The generation of the picture under way, once it is traced.
    pub(crate) generation: Option<u64>,
    /// What the preview is of: the text's revision, and the render settings.
    pub(crate) of: (u64, Rendering),
}

/// Samples per pixel that tell what is wrong with a picture as a whole: those of a trial.
const ENOUGH: u32 = 16;

/// Whether a picture is traced far enough to tell what is wrong with it as a whole.
pub(crate) fn is_judgeable(progress: &Progress) -> bool {
    progress.complete || ENOUGH <= progress.spp
}

impl Suggestions {
    /// Whether a frame of the preview is the first that tells what is wrong with it, or a whole one of
    /// which no earlier frame did.
    pub(crate) fn is_to_judge(&mut self, frame: &Frame) -> bool {
        let generation = Some(frame.generation);
        if !is_judgeable(&frame.progress) || self.judged == generation {
            return false;
        }
        self.judged = generation.filter(|_| !frame.progress.complete);
        true
    }

    /// Notes the generation of the picture by which a cure is tried.
    pub(crate) fn started(&mut self, generation: u64) {
        if let Some(trials) = &mut self.trials {
            trials.generation = Some(generation);
        }
    }

    /// Whether a cure is being tried.
    pub fn are_awaited(&self) -> bool {
        self.trials.is_some()
    }
}
