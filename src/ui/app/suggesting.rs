//! What is wrong with a picture as a whole, and the render setting suggested for it.

use std::ops::ControlFlow;

use super::Shared;
use super::display::is_light;
use super::suggestions::{RunningTrials, Suggestion, is_judgeable};
use crate::explain::fault;
use crate::language::{Outlook, Prospect, outlook};
use crate::render::{Advice, Fault, Frame, Frames, Histogram, Job, Overexposure, Settings, Trials};
use crate::scene::RenderKey;
use crate::ui::msg::{Effect, Target};

impl Shared {
    /// Adds what the text shows of its picture to what was found in reading it.
    pub(super) fn judge_text(&mut self) {
        let mut found = self.reported.clone();
        self.suggestions.prospects.clear();
        let scene = self.scene.clone().filter(|_| found.errors() == 0);
        let Some(scene) = scene else {
            self.diagnostics = found;
            return;
        };
        let asked = self.rendering();
        for Outlook { warning, prospect } in outlook(self.source(), &scene, &scene.camera, &asked) {
            found.warning(|| warning);
            self.suggestions.prospects.push(prospect);
        }
        self.diagnostics = found.sorted();
    }

    /// Says what is wrong with a preview of light as a whole, and what helps, once trials have
    /// shown it; once, until nothing is wrong.
    pub(super) fn judge_picture(&mut self, target: Target, frame: &Frame) -> Vec<Effect> {
        if target != Target::Preview || !is_light(frame) || !self.suggestions.is_to_judge(frame) {
            return Vec::new();
        }
        let under_way = self.suggestions.trials.take().is_some();
        let suspected = self.suspected(frame);
        let trial = match suspected {
            // A scene of this size would keep all else waiting.
            Some(trials) if self.is_large() => {
                let is_overexposed = 0.5 < Overexposure::of(&frame.values).share;
                let overexposed = is_overexposed.then_some(Fault::Overexposed);
                self.say_untried(trials.fault().or(overexposed));
                None
            }
            Some(trials) => self.try_out(trials),
            None => {
                self.withdraw_fault();
                None
            }
        };
        match trial {
            Some(trial) => vec![trial],
            None if under_way => vec![Effect::Stop(Target::Trial)],
            None => Vec::new(),
        }
    }

    /// The trials for a preview, if something may be wrong with it as displayed.
    fn suspected(&self, frame: &Frame) -> Option<Trials> {
        let settings = frame.settings().filter(|settings| settings.aov.is_none())?;
        let scene = self.scene.as_ref()?;
        let stops = self.pictures.display.stops();
        let is_darkened = stops < 0.0 && Histogram::of(&frame.values, stops).clipped <= 0.5;
        let settings = Settings {
            // The advice is that on the whole picture.
            size: scene.camera.size,
            ..*settings
        };
        let of_text = fault(&self.suggestions.prospects);
        let trials = Trials::of_picture(frame, scene, &settings, of_text)?;
        let is_known = trials.fault().is_some() || of_text.is_some();
        (is_known || !is_darkened).then_some(trials)
    }

    /// Traces the next trial picture.
    fn try_out(&mut self, next: Trials) -> Option<Effect> {
        let settings = next.settings();
        let job = self.shown_job(settings.size, settings.spp)?;
        self.suggestions.trials = Some(RunningTrials {
            next,
            generation: None,
            of: (self.document.revision(), self.rendering()),
        });
        let job = Job {
            settings,
            frames: Frames::Live,
            ..job
        };
        Some(Effect::Trace(Target::Trial, job))
    }

    /// Takes a frame of a small picture.
    pub(super) fn tried(&mut self, frame: &Frame) -> Vec<Effect> {
        let is_it = |trials: &mut RunningTrials| trials.generation == Some(frame.generation);
        let Some(trials) = self
            .suggestions
            .trials
            .take_if(|trials| frame.progress.complete && is_it(trials))
        else {
            return Vec::new();
        };
        let advice = match trials.next.after(frame) {
            // The preview of what came since is judged anew.
            _ if trials.of != (self.document.revision(), self.rendering()) => None,
            ControlFlow::Continue(next) => {
                return self.try_out(next).into_iter().collect();
            }
            ControlFlow::Break(advice) => {
                if advice.is_none() {
                    self.withdraw_fault();
                }
                advice
            }
        };
        if let Some(Advice { fault, cure }) = advice {
            self.suggestions.cure = cure.and_then(|cure| RenderKey::stated(&cure).next());
            self.say_fault(fault);
        }
        vec![Effect::Stop(Target::Trial)]
    }

    /// Ends trials that cannot be traced.
    pub(super) fn end_trials(&mut self) -> Vec<Effect> {
        let Some(trials) = self.suggestions.trials.take() else {
            return Vec::new();
        };
        self.say_untried(trials.next.fault());
        vec![Effect::Stop(Target::Trial)]
    }

    /// Says what is wrong with the preview and what helps, unless that was said.
    fn say_fault(&mut self, fault: Fault) {
        let cure = self.suggested_cure().map(|cure| self.cure_in_words(cure));
        let helps = match fault {
            Fault::Black(_) => cure.unwrap_or_else(|| self.reason_of_black()),
            Fault::Overexposed => {
                let cure = cure.unwrap_or_else(|| "no single render setting fixes that".to_owned());
                let darker = self.key_for("darker");
                format!("{cure}; {darker} darkens only the screen")
            }
            // The text's warning says it all.
            Fault::Unlit | Fault::WithoutPhotons => {
                let Some(cure) = cure else {
                    self.withdraw_fault();
                    return;
                };
                cure
            }
        };
        self.say_once(format!("{fault}: {helps}"));
    }

    /// Says what is wrong with the preview where nothing that may help was tried.
    fn say_untried(&mut self, fault: Option<Fault>) {
        self.suggestions.cure = None;
        let helps = match fault {
            Some(Fault::Black(_)) => self.reason_of_black(),
            Some(Fault::Overexposed) => {
                let darker = self.key_for("darker");
                format!("{darker} darkens only the screen")
            }
            // The text's warning says it all.
            Some(Fault::Unlit | Fault::WithoutPhotons) | None => {
                self.withdraw_fault();
                return;
            }
        };
        if let Some(fault) = fault {
            self.say_once(format!("{fault}: {helps}"));
        }
    }

    /// Says what is wrong with the preview, unless something was said of it. Words that nobody has
    /// dismissed yet are replaced.
    fn say_once(&mut self, words: String) {
        let is_due = match &self.suggestions.said {
            None => true,
            Some(said) => *said != words && self.overlays.withdraw(said),
        };
        if is_due {
            self.overlays.say(words.clone());
        }
        self.suggestions.said = Some(words);
    }

    /// Where to look for the reason why a picture is black.
    fn reason_of_black(&self) -> String {
        if self.suggestions.prospects.contains(&Prospect::Black) {
            format!("{} says why", self.key_for("errors"))
        } else {
            let inspect = self.key_for("inspect");
            format!("{inspect} explains a pixel")
        }
    }

    /// Takes back what was said of a preview with which nothing is wrong any more.
    fn withdraw_fault(&mut self) {
        self.suggestions.cure = None;
        if let Some(said) = self.suggestions.said.take() {
            self.overlays.withdraw(&said);
        }
    }

    /// Writes the suggested setting into the text.
    pub(super) fn cure(&mut self) {
        if let Some((key, value)) = self.suggested_cure().cloned() {
            self.write_setting(key, Some(value));
            // What is still wrong is said again.
            self.suggestions.said = None;
            return;
        }
        let progress = self.pictures.preview.progress();
        let is_early = progress.is_some_and(|progress| !is_judgeable(progress));
        self.overlays
            .say(if is_early || self.suggestions.are_awaited() {
                "no suggestion yet: too little is traced"
            } else {
                "there is no render setting to suggest"
            });
    }

    /// Switches the integrator.
    pub(super) fn next_integrator(&mut self) {
        let words = self.pictures.next_integrator(self.scene.as_deref());
        // It may lack other lights.
        self.judge_text();
        self.overlays.say(words);
    }

    /// The cure, if it is not in use yet.
    fn suggested_cure(&self) -> Option<&Suggestion> {
        let asked = self.rendering();
        let cure = self.suggestions.cure.as_ref();
        cure.filter(|(key, value)| key.value(&asked) != *value)
    }

    fn cure_in_words(&self, (key, value): &Suggestion) -> String {
        format!("{} sets {} {value}", self.key_for("cure"), key.name())
    }
}
