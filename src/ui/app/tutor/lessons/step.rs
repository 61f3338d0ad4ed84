//! What a lesson and its steps are.

use crate::app::CarriedScene;
use crate::app::tutor::goals::Goal;

/// A lesson.
#[derive(Debug)]
pub(crate) struct Lesson {
    /// Its name.
    pub(crate) name: &'static str,
    /// The scene that it begins with.
    pub(crate) scene: CarriedScene,
    /// Its steps, in order.
    pub(crate) steps: &'static [Step],
    /// What to try after it.
    pub(crate) after: &'static str,
}

/// A step of a lesson. In its words, names of actions in braces stand for the keys that are bound to them.
#[derive(Debug)]
pub(crate) struct Step {
    /// What to do, in at most two lines of 80 columns.
    pub(crate) words: &'static str,
    /// More of that, in a line.
    pub(crate) hint: &'static str,
    /// Whether it is done.
    pub(crate) is_done: Goal,
    /// The scene that it begins with, if that is another one than before.
    pub(crate) scene: Option<CarriedScene>,
    /// A script that does it.
    #[cfg(test)]
    pub(crate) script: &'static str,
}

impl Step {
    pub(super) const fn new(
        words: &'static str,
        hint: &'static str,
        is_done: Goal,
        script: &'static str,
    ) -> Self {
        #[cfg(not(test))]
        let _ = script;
        Self {
            words,
            hint,
            is_done,
            scene: None,
            #[cfg(test)]
            script,
        }
    }

    /// The step with a scene of its own, in the language of the lesson's.
    pub(super) const fn on(mut self, scene: CarriedScene) -> Self {
        self.scene = Some(scene);
        self
    }
}

impl Lesson {
    /// The scene that a step works on, unless others were opened.
    pub(crate) fn scene_at(&self, step: usize) -> CarriedScene {
        let steps = self.steps.iter().take(step + 1);
        let mut scenes = steps.filter_map(|step| step.scene);
        scenes.next_back().unwrap_or(self.scene)
    }
}
