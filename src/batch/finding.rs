//! What is wrong with a picture as a whole, and the options that help.

use super::Messages;
use super::tracing::Tracer;
use crate::language::{brightening, darkening};
use crate::render::{Frame, Job, Limit, Provenance, Settings, TrialResults};
use crate::scene::{LEAST_ADAPTIVE_SPP, Rendering};
use crate::text::alternatives;

/// Whether more than half of a picture is above 1.
pub(super) fn is_burnt(frame: &Frame) -> bool {
    0.5 < frame.overexposure.share
}

/// Says that options over the text leave adaptive sampling no pixel to stop.
pub(super) fn print_without_effect(messages: Messages, over_text: &Rendering, settings: &Settings) {
    let Settings {
        noise, spp, aov, ..
    } = *settings;
    let is_asked = over_text.noise.is_some() || over_text.spp.is_some();
    if is_asked && noise.is_some() && aov.is_none() && spp <= LEAST_ADAPTIVE_SPP {
        let least = LEAST_ADAPTIVE_SPP;
        let note = format!(
            "`--noise` has no effect: it cannot stop a pixel before {least} samples, and `--spp` is {spp}"
        );
        messages.note(&note);
    }
}

/// Prints what is wrong with a whole picture of light: that it is black or, if `burnt` holds its job,
/// too bright; and the options that help. May trace small pictures to find them. `warned` says whether
/// there were warnings of the scene.
pub(super) fn print_finding(
    messages: Messages,
    frame: &Frame,
    picture: &Provenance,
    burnt: Option<Job>,
    warned: bool,
    tracer: impl FnOnce() -> Tracer,
) {
    if picture.settings.aov.is_some() || picture.settings.region.is_some() {
        return;
    }
    if frame.is_black() {
        let asked = Rendering {
            exposure: Some(picture.settings.exposure),
            ..Rendering::default()
        };
        let helps = match brightening(&asked, frame.overexposure.brightest) {
            Some((key, value)) => format!("try `--{} {value}`", key.name()),
            None if warned => "the warnings above may say why".to_owned(),
            None => "`halflight explain` may say why".to_owned(),
        };
        messages.note(&format!("the picture is black; {helps}"));
        return;
    }
    let Some(job) = burnt else {
        return;
    };
    let asked = Rendering {
        exposure: Some(job.settings.exposure),
        ..Rendering::default()
    };
    let over = frame.overexposure.stops;
    // No time is left for small pictures: only an exposure is known to help.
    let is_timed = matches!(job.limit, Some(Limit::Time(_)));
    let shown = if is_timed {
        TrialResults::default()
    } else {
        tracer().try_darker(&job, over)
    };
    let cures = darkening(&asked, over, shown.falloff, shown.depth);
    let options = cures.iter();
    let options = options.map(|(key, value)| format!("`--{} {value}`", key.name()));
    let options = alternatives(options);
    let finding = format!("more than half of the picture is above 1; try {options}");
    messages.note(&finding);
}
