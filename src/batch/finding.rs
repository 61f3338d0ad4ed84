//! What is wrong with a picture as a whole, and the option that helps.

use std::path::Path;

use super::reading::Loaded;
use super::tracing::Tracer;
use super::{Messages, Tracing};
use explain::{Place, Subject, cause, fault};
use language::{Prospect, Source};
use render::{
    Advice, Display, Fault, Frame, Frames, Job, Limit, PreparedScene, Progress, Provenance,
    SettingSearch, Settings,
};
use scene::{LEAST_ADAPTIVE_SPP, RenderKey, Rendering};

/// Says that options over the text leave adaptive sampling no pixel to stop.
pub(super) fn print_without_effect(messages: Messages, over_text: &Rendering, settings: &Settings) {
    let Settings {
        noise, spp, aov, ..
    } = *settings;
    let is_asked = over_text.noise.is_some() || over_text.spp.is_some();
    if is_asked && 0.0 < noise && aov.is_none() && spp <= LEAST_ADAPTIVE_SPP {
        let least = LEAST_ADAPTIVE_SPP;
        let note = format!(
            "`--noise` has no effect: it cannot stop a pixel before {least} samples, and `--spp` is {spp}"
        );
        messages.note(&note);
    }
}

/// Says by what a picture is biased.
pub(super) fn print_biases(messages: Messages, frame: &Frame, picture: &Provenance) {
    let most = picture.settings.clamp;
    if 0.0 < most && Display::affects(picture.settings.aov) {
        messages.note(&format!(
            "samples are clamped to {most:?}; light above that is lost (biased)"
        ));
    }
    if frame.progress.is_adaptive() {
        let Progress { spp, mean_spp, .. } = frame.progress;
        messages.note(&format!(
            "adaptive sampling (slightly biased): up to {spp} samples per pixel, {mean_spp:.1} on \
                 average"
        ));
    }
}

/// A picture with which something may be wrong.
pub(super) struct Suspect {
    job: Job,
    trials: SettingSearch,
}

impl Suspect {
    /// A complete picture that was traced, if it is one of light as a whole. `prospects` are those of its
    /// text.
    pub(super) fn of_picture(frame: &Frame, job: Job, prospects: &[Prospect]) -> Option<Self> {
        if job.settings.aov.is_some() || job.settings.region.is_some() {
            return None;
        }
        let of_text = fault(prospects);
        let trials = SettingSearch::of_picture(frame, &job.scene, &job.settings, of_text)?;
        Some(Self { job, trials })
    }

    /// A picture that was not traced; `None` if its scene is large.
    pub(super) fn of_scene(job: Job, prospects: &[Prospect]) -> Option<Self> {
        let trials = SettingSearch::of_scene(&job.scene, &job.settings, fault(prospects))?;
        Some(Self { job, trials })
    }

    /// Prints what is wrong with the picture, if anything is, and the option that helps. Traces small
    /// pictures to find out.
    pub(super) fn print(self, text: &Text<'_>, tracer: impl FnOnce() -> Tracer) {
        let Self { job, trials } = self;
        // No time is left for small pictures.
        if let Some(Limit::Time(_)) = job.limit {
            if let Some(fault) = trials.fault() {
                let helps = "without `--time`, what helps is tried";
                text.print(&format!("{fault}; {helps}"));
            }
            return;
        }
        let Some(Advice { fault, cure }) = tracer().try_out(&job, trials) else {
            return;
        };
        let setting = cure.and_then(|cure| RenderKey::stated(&cure).next());
        match (setting, fault) {
            (Some((key, value)), _) => {
                text.print(&format!("{fault}; try `--{} {value}`", key.name()));
            }
            (None, Fault::Black(_)) if text.prospects.contains(&Prospect::Black) => {
                text.print(&format!("{fault}; the warnings above say why"));
            }
            (None, Fault::Black(_)) => text.print_cause(fault, &job),
            (None, Fault::Overexposed) => {
                text.print(&format!("{fault}; no single render setting fixes that"));
            }
            // The warning of the text says it all.
            (None, Fault::Unlit | Fault::WithoutPhotons) => {}
        }
    }
}

/// The text of a picture.
pub(super) struct Text<'t> {
    /// How what is found is told.
    pub(super) messages: Messages,
    /// The name of its file.
    pub(super) path: &'t Path,
    /// Whether the name belongs in the message.
    pub(super) naming: Naming,
    /// The text, lowered; `None` if it is no longer in memory.
    pub(super) source: Option<&'t Source>,
    /// What it shows of its picture.
    pub(super) prospects: &'t [Prospect],
}

/// Whether messages say which file they are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Naming {
    /// They do: there may be several.
    File,
    /// There is only one.
    Implied,
}

impl Text<'_> {
    fn print(&self, finding: &str) {
        let name = match self.naming {
            Naming::File => format!("{}: ", self.path.display()),
            Naming::Implied => String::new(),
        };
        self.messages.note(&format!("{name}{finding}"));
    }

    /// Prints that a picture is black, and why most of it is.
    fn print_cause(&self, fault: Fault, job: &Job) {
        let size = job.settings.size;
        let prepared = self.source.zip(PreparedScene::new(job, &|| false));
        let found = prepared.and_then(|(source, prepared)| {
            let subject = Subject {
                source,
                scene: &job.scene,
                camera: &job.camera,
                size,
            };
            cause(prepared.query(), &subject)
        });
        let name = self.path.to_string_lossy();
        self.print(&match found {
            Some(cause) => {
                let help = cause
                    .help
                    .map_or_else(String::new, |help| format!("; {help}"));
                let place = place_after(&name, cause.place);
                format!("{fault}: {}{help}{place}", cause.text)
            }
            None => format!("{fault}; `halflight explain SCENE X Y` may show why"),
        });
    }
}

/// Prints what is wrong with the picture of a scene that was read, which is not traced otherwise.
pub(super) fn print_of_scene(path: &Path, loaded: &mut Loaded, tracing: &Tracing, naming: Naming) {
    let Some(scene) = loaded.scene.take() else {
        return;
    };
    let images = std::mem::take(&mut loaded.read.images);
    let job = tracing.job(scene, images, Frames::Live);
    let suspect = job
        .ok()
        .and_then(|job| Suspect::of_scene(job, &loaded.prospects));
    if let Some(suspect) = suspect {
        let text = Text {
            messages: Messages::Text,
            path,
            naming,
            source: Some(&loaded.source),
            prospects: &loaded.prospects,
        };
        suspect.print(&text, || Tracer::new(tracing.execution));
    }
}

/// A place as the end of a line.
pub(super) fn place_after(name: &str, place: Option<Place>) -> String {
    place.map_or(String::new(), |Place { line, column, .. }| {
        format!("  [{name}:{line}:{column}]")
    })
}
