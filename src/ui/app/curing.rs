//! What is wrong with a picture as a whole, and the render settings suggested for it.

use std::ops::ControlFlow;

use super::App;
use super::cures::{Cure, RunningTrials};
use super::looking::is_light;
use crate::language::{Outlook, brightening, darkening, outlook};
use crate::render::{Frame, Frames, Histogram, Job, Overexposure, TrialResults, Trials};
use crate::ui::keymap::{Action, Mode};
use crate::ui::msg::{Effect, Target};

impl App {
    /// Adds what the text shows of its picture to what was found in reading it.
    pub(super) fn judge_text(&mut self) {
        let mut found = self.reported.clone();
        self.cures.of_text.clear();
        let scene = self.scene.clone().filter(|_| found.errors() == 0);
        let Some(scene) = scene else {
            self.diagnostics = found;
            return;
        };
        for Outlook { warning, cure } in outlook(self.source(), &scene, &self.rendering()) {
            let hint = cure.as_ref().map(|cure| self.cure_in_words(cure));
            found.warning(|| match hint {
                Some(hint) => warning.with_hint(hint),
                None => warning,
            });
            self.cures.of_text.extend(cure);
        }
        self.diagnostics = found.sorted();
    }

    /// Says what is wrong with a complete preview that is black, or of which more than half is above 1,
    /// and what helps; once, until one is not.
    pub(super) fn judge_picture(&mut self, target: Target, frame: &Frame) -> Vec<Effect> {
        if target != Target::Preview || !frame.progress.complete || !is_light(frame) {
            return Vec::new();
        }
        let settings = frame.settings().filter(|settings| settings.aov.is_none());
        let is_black = settings.is_some() && frame.is_black();
        let clipped = Histogram::of(&frame.values, self.pictures.display.stops()).clipped;
        self.cures.of_picture.clear();
        let under_way = self.cures.trials.take();
        let stop = || {
            under_way
                .map(|_| Effect::Stop(Target::Trial))
                .into_iter()
                .collect()
        };
        if is_black {
            let brightest = Overexposure::of(&frame.values).brightest;
            let cure = brightening(&self.rendering(), brightest);
            self.cures.of_picture.extend(cure);
            self.say_black();
        } else if 0.5 < clipped {
            let over = Overexposure::of(&frame.values).stops;
            let settings_and_scene = settings.zip(self.scene.as_ref());
            let trials = settings_and_scene
                .filter(|_| !self.is_large())
                .and_then(|(settings, scene)| Trials::new(settings, &scene.lights, over));
            if let Some(trial) = trials.and_then(|trials| self.try_darker(trials, over)) {
                return vec![trial];
            }
            if settings.is_some() {
                self.cures.of_picture = self.darkening(over, TrialResults::default());
            }
            self.say_burnt();
        } else if let Some(said) = self.cures.said.take() {
            self.overlays.withdraw(&said);
        }
        stop()
    }

    /// Traces the next trial picture.
    fn try_darker(&mut self, next: Trials, over: f64) -> Option<Effect> {
        let settings = next.settings();
        let job = self.shown_job(settings.size, settings.spp)?;
        self.cures.trials = Some(RunningTrials {
            next,
            generation: None,
            over,
            of: (self.document.revision(), self.rendering()),
        });
        let job = Job {
            settings,
            frames: Frames::LastWithValues,
            ..job
        };
        Some(Effect::Trace(Target::Trial, job))
    }

    /// Takes a frame of a small picture.
    pub(super) fn tried(&mut self, frame: &Frame) -> Vec<Effect> {
        let is_it = |trials: &mut RunningTrials| trials.generation == Some(frame.generation);
        let Some(trials) = self
            .cures
            .trials
            .take_if(|trials| frame.progress.complete && is_it(trials))
        else {
            return Vec::new();
        };
        match trials.next.after(frame) {
            _ if trials.of != (self.document.revision(), self.rendering()) => {
                // The preview of what came since is judged anew.
                vec![Effect::Stop(Target::Trial)]
            }
            ControlFlow::Continue(next) => self.try_darker(next, trials.over).into_iter().collect(),
            ControlFlow::Break(shown) => self.end_burnt(trials.over, shown),
        }
    }

    /// Ends the trials, and says that the preview is too bright.
    pub(super) fn end_trials(&mut self) -> Vec<Effect> {
        let trials = self.cures.trials.take();
        trials.map_or_else(Vec::new, |trials| {
            self.end_burnt(trials.over, trials.next.shown())
        })
    }

    /// Says that the preview is too bright, and what helps, as trials have shown.
    fn end_burnt(&mut self, over: f64, shown: TrialResults) -> Vec<Effect> {
        self.cures.of_picture = self.darkening(over, shown);
        self.say_burnt();
        vec![Effect::Stop(Target::Trial)]
    }

    fn darkening(&self, over: f64, shown: TrialResults) -> Vec<Cure> {
        darkening(&self.rendering(), over, shown.falloff, shown.depth)
    }

    fn say_black(&mut self) {
        let cure = self.suggested_cure().map(|cure| self.cure_in_words(cure));
        let nothing_known = self.cures.of_text.is_empty() && self.diagnostics.is_empty();
        let helps = match (cure, nothing_known) {
            (Some(cure), _) => cure,
            (None, false) => format!("{} may say why", self.key_for(Action::Errors)),
            (None, true) => {
                let inspect = self.key_for(Action::Go(Mode::Inspect));
                format!("{inspect} explains a pixel")
            }
        };
        self.say_once(format!("the picture is black: {helps}"));
    }

    fn say_burnt(&mut self) {
        let cure = self.suggested_cure().map(|cure| self.cure_in_words(cure));
        let darker = self.key_for(Action::Expose(-1));
        let darker = format!("{darker} darkens the screen only");
        let helps = cure.map_or_else(|| darker.clone(), |cure| format!("{cure}, {darker}"));
        self.say_once(format!("more than half of the picture is above 1: {helps}"));
    }

    /// Says what is wrong with the preview, unless that was said.
    fn say_once(&mut self, words: String) {
        if self.cures.said.is_none() {
            self.overlays.say(words.clone());
            self.cures.said = Some(words);
        }
    }

    /// Writes the suggested setting into the text.
    fn cure(&mut self) {
        match self.suggested_cure().cloned() {
            Some((key, value)) => {
                self.write_setting(key, Some(value));
                // What is still wrong is said again.
                self.cures.said = None;
            }
            None => self.overlays.say("there is no render setting to suggest"),
        }
    }

    /// Switches the integrator, or writes the suggested setting.
    pub(super) fn change_rendering(&mut self, action: Action) {
        if action == Action::Cure {
            self.cure();
            return;
        }
        let words = self.pictures.next_integrator(self.scene.as_deref());
        // It may lack other lights.
        self.judge_text();
        self.overlays.say(words);
    }

    /// The first cure that is not in use yet.
    fn suggested_cure(&self) -> Option<&Cure> {
        let asked = self.rendering();
        let cures = self.cures.of_text.iter().chain(&self.cures.of_picture);
        let mut new = cures.filter(|(key, value)| key.value(&asked) != *value);
        new.next()
    }

    fn cure_in_words(&self, (key, value): &Cure) -> String {
        format!("{} sets {} {value}", self.key_for(Action::Cure), key.name())
    }
}
