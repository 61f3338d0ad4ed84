//! Starting, pausing and stopping the full-size trace.

use crate::app::pictures::until::Until;
use crate::app::refusing::Refusable;
use crate::app::{Picture, Shared, display, exports};
use crate::keymap::Mode;
use crate::msg::{Effect, Recalled, Target};
use image_file::ImageFormat;
use render::Job;
use text::Severity;

/// Starts the full-size trace, or continues it after a stop or a pause.
pub(crate) fn start(shared: &mut Shared) -> Vec<Effect> {
    shared.document.end_step();
    let is_begun = shared.pictures.is_tracing();
    if shared.mode == Mode::Trace && is_begun {
        return resume(shared);
    }
    let Some(job) = display::trace_job(shared).or_refuse_picture(shared) else {
        return Vec::new();
    };
    // A picture too large for a picture file is also too large to look at.
    if let Some(reason) = ImageFormat::Bmp.refuses(job.settings.traced().size()) {
        shared.fail(reason);
        return Vec::new();
    }
    enter(shared);
    if 0 < shared.error_count() {
        let words = "the text has errors: this is the last valid scene";
        shared.overlays.blame_errors(Severity::Warning, words);
    }
    if is_begun {
        return Vec::new();
    }
    if shared.pictures.trace.is_some() {
        return vec![Effect::Trace(Target::Trace, job)];
    }
    let under = shared.pictures.preview.whole();
    let under = under.filter(|_| job.settings.region.is_some());
    shared.pictures.trace = Some(Picture::over(under));
    vec![trace_from_kept(shared, job)]
}

/// Starts the full-size trace from what an earlier run left of it, or a render, if that can be known: a text
/// with errors is not that of its scene.
fn trace_from_kept(shared: &Shared, job: Job) -> Effect {
    match exports::origin(shared) {
        Some(origin) => Effect::Recall(job, origin, exports::export_path(shared)),
        None => Effect::Trace(Target::Trace, job),
    }
}

/// Says what an earlier run left of the full-size trace.
pub(crate) fn recalled(shared: &mut Shared, recalled: Recalled) {
    match recalled {
        Recalled::Continued(spp) => shared.say(format!(
            "continuing the full-size trace that an earlier run left with {spp} spp"
        )),
        Recalled::More(spp) => {
            shared.pictures.more_kept = true;
            shared.say(format!(
                "an earlier run left more samples: :until {spp} spp continues from them"
            ));
        }
        Recalled::Unreadable(reason) => shared.warn(reason),
    }
}

/// Goes to TRACE, and remembers the mode to return to.
pub(super) fn enter(shared: &mut Shared) {
    match (shared.mode, shared.pictures.before_comparison) {
        // The mode to return to is that before the comparison.
        (Mode::Trace, _) | (Mode::Compare, Some(Mode::Trace)) => {}
        _ if shared.seen() == Target::Trace => {}
        (Mode::Compare, before) => shared.pictures.before_trace = before.or(Some(Mode::Select)),
        (mode, _) => shared.pictures.before_trace = Some(mode),
    }
    shared.mode = Mode::Trace;
}

/// The full-size trace, if it is not complete and another picture is on screen.
pub(crate) fn in_background(shared: &Shared) -> Option<&Picture> {
    let trace = shared.pictures.trace.as_ref();
    trace.filter(|trace| trace.is_awaited() && shared.seen() != Target::Trace)
}

/// Says that the full-size trace has become complete, if it is not on screen.
pub(crate) fn end_unseen(shared: &mut Shared, was_awaited: bool) {
    let is_over = was_awaited
        && shared
            .pictures
            .trace
            .as_ref()
            .is_some_and(Picture::is_complete);
    if is_over && shared.seen() != Target::Trace {
        let trace = shared.key_for("trace");
        shared.say(format!("the full-size trace is finished; {trace} shows it"));
    }
}

/// Pauses the full-size trace, or goes on.
pub(super) fn toggle_pause(shared: &mut Shared) -> Vec<Effect> {
    match &mut shared.pictures.trace {
        Some(trace) if trace.paused => resume(shared),
        Some(trace) if trace.is_awaited() => {
            trace.paused = true;
            vec![Effect::Pause(Target::Trace)]
        }
        Some(trace) if trace.is_complete() => {
            shared.say("the trace is already finished");
            Vec::new()
        }
        _ => start(shared),
    }
}

/// Ends the pause of the full-size trace, if it is paused.
fn resume(shared: &mut Shared) -> Vec<Effect> {
    match &mut shared.pictures.trace {
        Some(trace) if trace.paused => {
            trace.paused = false;
            vec![Effect::Resume(Target::Trace)]
        }
        _ => Vec::new(),
    }
}

/// Stops the full-size trace if it is running, otherwise the export.
pub(super) fn stop(shared: &mut Shared) -> Vec<Effect> {
    if let Some(trace) = &mut shared.pictures.trace
        && shared.mode == Mode::Trace
        && trace.is_awaited()
    {
        trace.wanted = None;
        trace.paused = false;
        let trace = shared.key_for("trace");
        shared.say(format!("stopped; press {trace} to continue"));
        return vec![Effect::Halt(Target::Trace)];
    }
    exports::cancel_export(shared)
}

/// Sets when the full-size trace is complete, or says when it is. A trace in progress continues
/// from the samples it has.
pub(crate) fn trace_until(shared: &mut Shared, until: Option<Until>) -> Vec<Effect> {
    if until.is_some() {
        shared.pictures.until = until;
    }
    let until = shared.until();
    shared.say(format!("the full-size trace ends {until}"));
    match display::trace_job(shared) {
        Ok(job) if shared.pictures.is_tracing() && shared.pictures.more_kept => {
            shared.pictures.more_kept = false;
            // Otherwise it would continue from the samples of this run.
            vec![Effect::Stop(Target::Trace), trace_from_kept(shared, job)]
        }
        _ => display::retrace(shared),
    }
}
