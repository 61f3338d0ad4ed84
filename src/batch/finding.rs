//! What is wrong with a picture as a whole, and the option that helps.

use std::ops::ControlFlow;
use std::path::Path;

use super::tracing::Tracer;
use super::{Loaded, Messages, Tracing};
use crate::explain::{Place, Subject, cause, fault};
use crate::language::{Prospect, RenderKey, Source};
use crate::render::{
    Advice, Fault, Frame, Frames, Job, Limit, PreparedScene, Settings, Trials, Tried,
};
use crate::scene::{LEAST_ADAPTIVE_SPP, Rendering};

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

/// A picture with which something may be wrong.
pub(super) struct Suspect {
    job: Job,
    /// What is to be traced to find out, or the advice if that is too much work.
    trials: ControlFlow<Advice, Trials>,
}

/// What was found out of a picture.
#[derive(Default)]
pub(super) struct Found {
    /// What is wrong, and what helps.
    pub(super) advice: Option<Advice>,
    /// The same in words, unless the text's warnings say it all.
    pub(super) words: Option<String>,
}

impl Suspect {
    /// A complete picture that was traced, if it is one of light as a whole. `prospects` are those of its
    /// text.
    pub(super) fn of_picture(frame: &Frame, job: Job, prospects: &[Prospect]) -> Option<Self> {
        if job.settings.aov.is_some() || job.settings.region.is_some() {
            return None;
        }
        let of_text = fault(prospects);
        let tried = Trials::of_picture(frame, &job.scene, &job.settings, of_text);
        Self::of(job, tried)
    }

    /// A picture that was not traced; `None` if its scene is large.
    pub(super) fn of_scene(job: Job, prospects: &[Prospect]) -> Option<Self> {
        let tried = Trials::of_scene(&job.scene, &job.settings, fault(prospects));
        Self::of(job, tried)
    }

    fn of(job: Job, tried: Tried) -> Option<Self> {
        let trials = match tried {
            ControlFlow::Continue(trials) => ControlFlow::Continue(trials),
            ControlFlow::Break(advice) => ControlFlow::Break(advice?),
        };
        Some(Self { job, trials })
    }

    /// Prints what is wrong with the picture, if anything is, and the option that helps.
    pub(super) fn print(
        self,
        text: &Text<'_>,
        try_out: impl FnOnce(&Job, Trials) -> Option<Advice>,
    ) {
        if let Some(words) = self.find_out(text, try_out).words {
            text.print(&words);
        }
    }

    /// Finds out what is wrong with the picture, if anything is, and the option that helps. Traces small
    /// pictures for that.
    pub(super) fn find_out(
        self,
        text: &Text<'_>,
        try_out: impl FnOnce(&Job, Trials) -> Option<Advice>,
    ) -> Found {
        let Self { job, trials } = self;
        let advice = match trials {
            // No time is left for small pictures.
            ControlFlow::Continue(trials) if matches!(job.limit, Some(Limit::Time(_))) => {
                return Found {
                    advice: None,
                    words: trials.apparent().map(|fault| text.untimed(fault)),
                };
            }
            ControlFlow::Continue(trials) => try_out(&job, trials),
            ControlFlow::Break(advice) => Some(advice),
        };
        Found {
            advice,
            words: advice.and_then(|advice| text.words(advice, &job)),
        }
    }
}

/// The text of a picture.
pub(super) struct Text<'t> {
    /// How what is found is told.
    pub(super) messages: Messages,
    /// The name of its file.
    pub(super) path: &'t Path,
    /// Whether the name belongs into the message.
    pub(super) naming: Naming,
    /// The text, lowered; `None` if it is no longer in memory.
    pub(super) source: Option<&'t Source>,
    /// What it shows of its picture.
    pub(super) prospects: &'t [Prospect],
}

/// How messages say what they are about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Naming {
    /// They name the file: there may be several, none of which is rendered.
    File,
    /// They name the frame of a sequence.
    Frame(u32),
    /// There is only one.
    Implied,
}

impl Text<'_> {
    pub(super) fn print(&self, finding: &str) {
        let name = match self.naming {
            Naming::File => format!("{}: ", self.path.display()),
            Naming::Frame(number) => format!("frame {number}: "),
            Naming::Implied => String::new(),
        };
        self.messages.note(&format!("{name}{finding}"));
    }

    /// What is said of a picture for which there was no time to try what helps.
    fn untimed(&self, fault: Fault) -> String {
        if self.shows_black(fault) {
            format!("{fault}; the warnings above say why")
        } else {
            format!("{fault}; run it without `--time` to find what helps")
        }
    }

    /// Whether the text shows that its picture is black.
    fn shows_black(&self, fault: Fault) -> bool {
        matches!(fault, Fault::Black(_)) && self.prospects.contains(&Prospect::Black)
    }

    /// What is wrong, and what helps.
    fn words(&self, advice: Advice, job: &Job) -> Option<String> {
        let Advice {
            fault,
            cure,
            is_tried,
        } = advice;
        let setting = cure.and_then(|cure| RenderKey::stated(&cure).next());
        let helps = match self.naming {
            Naming::File => "render it with",
            Naming::Frame(_) | Naming::Implied => "try",
        };
        Some(match (setting, fault) {
            (Some((key, value)), _) => format!("{fault}; {helps} `--{} {value}`", key.name()),
            (None, Fault::Black(_)) if self.shows_black(fault) => {
                format!("{fault}; the warnings above say why")
            }
            (None, Fault::Black(_)) => self.cause(advice, job),
            (None, Fault::Burnt) if is_tried => {
                format!("{fault}; no single render setting fixes that")
            }
            (None, Fault::Burnt) => fault.to_string(),
            // The warning of the text says it all.
            (None, Fault::Unlit | Fault::WithoutPhotons | Fault::FewerPhotons) => return None,
        })
    }

    /// That a picture is black, and why most of it is.
    fn cause(&self, advice: Advice, job: &Job) -> String {
        let fault = advice.fault;
        let size = job.settings.size;
        let prepared = self.source.zip(PreparedScene::new(job, || false));
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
        match found {
            Some(mut cause) => {
                cause.heed(&advice);
                let help = cause
                    .help
                    .map_or_else(String::new, |help| format!("; {help}"));
                let place = place_after(&name, cause.place);
                format!("{fault}: {}{help}{place}", cause.text)
            }
            None => format!("{fault}; `halflight explain SCENE X Y` may show why"),
        }
    }
}

/// Prints what is wrong with a frame of a sequence, which was traced from this job.
pub(super) fn print_of_frame(
    number: u32,
    frame: &Frame,
    (job, prospects): (Job, &[Prospect]),
    tracer: &mut Tracer,
    messages: Messages,
) {
    let text = Text {
        messages,
        path: Path::new(""),
        naming: Naming::Frame(number),
        source: None,
        prospects,
    };
    if let Some(suspect) = Suspect::of_picture(frame, job, prospects) {
        suspect.print(&text, |job, trials| tracer.try_out(job, trials));
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
        suspect.print(&text, |job, trials| {
            Tracer::new(tracing).try_out(job, trials)
        });
    }
}

/// A place as the end of a line.
pub(super) fn place_after(name: &str, place: Option<Place>) -> String {
    place.map_or(String::new(), |Place { line, column, .. }| {
        format!("  [{name}:{line}:{column}]")
    })
}
