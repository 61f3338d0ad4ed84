//! What is wrong with a picture as a whole, and the render setting suggested for it.

use std::ops::ControlFlow;

use super::display::is_light;
use super::shared::suggestions::{RunningTrials, Suggestion, is_judgeable};
use super::{Shared, display, text};
use crate::msg::{Effect, Target};
use explain::fault;
use language::Prospect;
use render::{Advice, Fault, Frame, Frames, Histogram, Job, Overexposure, SettingSearch, Settings};
use scene::RenderKey;

/// Says what is wrong with a preview of light as a whole, and what helps, once trials have
/// shown it; once, until nothing is wrong.
pub(crate) fn judge_picture(shared: &mut Shared, target: Target, frame: &Frame) -> Vec<Effect> {
    if target != Target::Preview || !is_light(frame) || !shared.suggestions.is_to_judge(frame) {
        return Vec::new();
    }
    let under_way = shared.suggestions.trials.take().is_some();
    let trial = match suspected(shared, frame) {
        // A scene of this size would keep all else waiting.
        Some(trials) if shared.is_large() => {
            let is_overexposed = 0.5 < Overexposure::of(&frame.values).share;
            let overexposed = is_overexposed.then_some(Fault::Overexposed);
            say_untried(shared, trials.fault().or(overexposed));
            None
        }
        Some(trials) => try_out(shared, trials),
        None => {
            withdraw_fault(shared);
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
fn suspected(shared: &Shared, frame: &Frame) -> Option<SettingSearch> {
    let settings = frame.settings().filter(|settings| settings.aov.is_none())?;
    let scene = shared.scene.as_ref()?;
    let stops = shared.pictures.display.stops();
    let is_darkened = stops < 0.0 && Histogram::of(&frame.values, stops).clipped <= 0.5;
    let settings = Settings {
        // The advice is that on the whole picture.
        size: scene.camera.size,
        ..*settings
    };
    let of_text = fault(&shared.suggestions.prospects);
    let trials = SettingSearch::of_picture(frame, scene, &settings, of_text)?;
    let is_known = trials.fault().is_some() || of_text.is_some();
    (is_known || !is_darkened).then_some(trials)
}

/// Traces the next trial picture.
fn try_out(shared: &mut Shared, next: SettingSearch) -> Option<Effect> {
    let settings = next.settings();
    let job = display::shown_job(shared, settings.size, settings.spp)?;
    shared.suggestions.trials = Some(RunningTrials {
        next,
        generation: None,
        of: (shared.document.revision(), shared.rendering()),
    });
    let job = Job {
        settings,
        frames: Frames::Live,
        ..job
    };
    Some(Effect::Trace(Target::Trial, job))
}

/// Takes a frame of a small picture.
pub(crate) fn tried(shared: &mut Shared, frame: &Frame) -> Vec<Effect> {
    let is_traced = |trials: &mut RunningTrials| {
        frame.progress.complete && trials.generation == Some(frame.generation)
    };
    let Some(trials) = shared.suggestions.trials.take_if(is_traced) else {
        return Vec::new();
    };
    let advice = match trials.next.after(frame) {
        // The preview of what came since is judged anew.
        _ if trials.of != (shared.document.revision(), shared.rendering()) => None,
        ControlFlow::Continue(next) => {
            return try_out(shared, next).into_iter().collect();
        }
        ControlFlow::Break(advice) => {
            if advice.is_none() {
                withdraw_fault(shared);
            }
            advice
        }
    };
    if let Some(Advice { fault, cure }) = advice {
        shared.suggestions.cure = cure.and_then(|cure| RenderKey::stated(&cure).next());
        say_fault(shared, fault, Some("no single render setting fixes that"));
    }
    vec![Effect::Stop(Target::Trial)]
}

/// Ends trials that cannot be traced.
pub(crate) fn end_trials(shared: &mut Shared) -> Vec<Effect> {
    let Some(trials) = shared.suggestions.trials.take() else {
        return Vec::new();
    };
    say_untried(shared, trials.next.fault());
    vec![Effect::Stop(Target::Trial)]
}

/// Says what is wrong with the preview and what helps, unless that was said. Of an overexposed one without
/// a cure, says `uncured`.
fn say_fault(shared: &mut Shared, fault: Fault, uncured: Option<&str>) {
    let cure = suggested_cure(shared).map(|cure| cure_in_words(shared, cure));
    let helps = match fault {
        Fault::Black(_) => cure.unwrap_or_else(|| reason_of_black(shared)),
        Fault::Overexposed => {
            let darker = format!("{} darkens only the screen", shared.key_for("darker"));
            let cure = cure.or_else(|| uncured.map(str::to_owned));
            cure.into_iter()
                .chain([darker])
                .collect::<Vec<_>>()
                .join("; ")
        }
        // The text's warning says it all.
        Fault::Unlit | Fault::WithoutPhotons => {
            let Some(cure) = cure else {
                withdraw_fault(shared);
                return;
            };
            cure
        }
    };
    say_once(shared, format!("{fault}: {helps}"));
}

/// Says what is wrong with the preview where nothing that may help was tried.
fn say_untried(shared: &mut Shared, fault: Option<Fault>) {
    shared.suggestions.cure = None;
    match fault {
        Some(fault) => say_fault(shared, fault, None),
        None => withdraw_fault(shared),
    }
}

/// Says what is wrong with the preview, unless something was said of it. Words that nobody has
/// dismissed yet are replaced.
fn say_once(shared: &mut Shared, words: String) {
    let is_due = match &shared.suggestions.said {
        None => true,
        Some(said) => *said != words && shared.overlays.withdraw(said),
    };
    if is_due {
        shared.say(words.clone());
    }
    shared.suggestions.said = Some(words);
}

/// Where to look for the reason why a picture is black.
fn reason_of_black(shared: &Shared) -> String {
    if shared.suggestions.prospects.contains(&Prospect::Black) {
        format!("{} says why", shared.key_for("errors"))
    } else {
        let inspect = shared.key_for("inspect");
        format!("{inspect} explains a pixel")
    }
}

/// Takes back what was said of a preview with which nothing is wrong any more.
fn withdraw_fault(shared: &mut Shared) {
    shared.suggestions.cure = None;
    if let Some(said) = shared.suggestions.said.take() {
        shared.overlays.withdraw(&said);
    }
}

/// Writes the suggested setting into the text.
pub(crate) fn cure(shared: &mut Shared) {
    if let Some((key, value)) = suggested_cure(shared).cloned() {
        text::write_setting(shared, key, Some(value));
        // What is still wrong is said again.
        shared.suggestions.said = None;
        return;
    }
    let progress = shared.pictures.preview.progress();
    let is_early = progress.is_some_and(|progress| !is_judgeable(progress));
    shared.say(if is_early || shared.suggestions.are_awaited() {
        "no suggestion yet: too little is traced"
    } else {
        "no suggestion for this scene"
    });
}

/// The cure, if it is not in use yet.
fn suggested_cure(shared: &Shared) -> Option<&Suggestion> {
    let asked = shared.rendering();
    let cure = shared.suggestions.cure.as_ref();
    cure.filter(|(key, value)| key.value(&asked) != *value)
}

fn cure_in_words(shared: &Shared, (key, value): &Suggestion) -> String {
    format!("{} sets {} {value}", shared.key_for("cure"), key.name())
}
