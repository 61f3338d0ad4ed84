//! What is traced: the preview, the full-size trace, exports.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::assets::STILL_READING;
use super::{App, Export, Mode, Picture, Stage};
use crate::image_file::{ImageFormat, known_extensions};
use crate::render::{Filter, Frame, Frames, Job, Settings, default_depth};
use crate::scene::{Camera, Integrator, Size};
use crate::ui::msg::{Destination, Effect, Existing, ExportId, Exported, Target};

/// Samples a pixel at which the preview comes to rest: edges are smooth by then, noise of paths is
/// gone to the eye.
fn preview_samples(integrator: Integrator) -> u32 {
    match integrator {
        Integrator::Whitted => 64,
        Integrator::Path => 1024,
    }
}

impl App {
    /// Restarts pictures that no longer show the scene.
    pub(super) fn follow(&mut self) -> Vec<Effect> {
        let mut effects = self.follow_assets();
        if self.awaits_assets() {
            // A picture without them would only be seen for a moment.
            return effects;
        }
        let changed = std::mem::take(&mut self.pending.scene);
        if changed {
            self.preview.asked = None;
            effects.extend(self.follow_trace());
        }
        let size = self.preview_size();
        if self.mode != Mode::Trace && self.preview.asked != size {
            self.preview.asked = size;
            let spp = preview_samples(self.integrator());
            let job = size.and_then(|size| self.job(size, spp, Filter::Box));
            effects.extend(job.map(|job| Effect::Trace(Target::Preview, job)));
        }
        effects
    }

    fn follow_trace(&mut self) -> Option<Effect> {
        self.trace.as_ref()?;
        if self.mode == Mode::Trace {
            return self
                .trace_job()
                .map(|job| Effect::Trace(Target::Trace, job));
        }
        self.trace = None;
        Some(Effect::Stop(Target::Trace))
    }

    fn job(&self, size: Size, spp: u32, filter: Filter) -> Option<Job> {
        let scene = self.scene.as_ref()?;
        let integrator = self.integrator();
        Some(Job {
            scene: Arc::clone(scene),
            images: self.images.clone(),
            camera: self.camera()?,
            settings: Settings {
                size,
                spp: self.samples(spp),
                depth: self
                    .quality
                    .depth
                    .unwrap_or_else(|| default_depth(integrator)),
                seed: 0,
                aov: self.aov,
                integrator,
                filter,
                transfer: scene.setting.transfer,
            },
            frames: Frames::Live,
        })
    }

    fn trace_job(&self) -> Option<Job> {
        self.job(self.output(), self.quality.spp, self.quality.filter)
    }

    pub(super) fn start_trace(&mut self) -> Vec<Effect> {
        let trace = self.trace.as_ref();
        let is_begun = trace.is_some_and(|trace| trace.wanted.is_some());
        if self.mode == Mode::Trace && is_begun {
            return Vec::new();
        }
        if self.awaits_assets() {
            self.fail(STILL_READING);
            return Vec::new();
        }
        let Some(job) = self.trace_job() else {
            self.fail("there is no picture: the scene has errors");
            return Vec::new();
        };
        // What a picture file can't hold is too large to be looked at, too.
        if let Some(reason) = ImageFormat::Bmp.refuses(job.settings.size) {
            self.fail(reason);
            return Vec::new();
        }
        if self.mode != Mode::Trace {
            self.pending.before_trace = Some(self.mode);
            self.mode = Mode::Trace;
        }
        if 0 < self.error_count() {
            self.warn("the text has errors: this is the last scene without");
        }
        if is_begun {
            return Vec::new();
        }
        self.trace = Some(Picture::default());
        vec![Effect::Trace(Target::Trace, job)]
    }

    pub(super) fn started(&mut self, target: Target, generation: u64) {
        match (target, &mut self.trace) {
            (Target::Preview, _) => self.preview.wanted = Some(generation),
            (Target::Trace, Some(trace)) => trace.wanted = Some(generation),
            (Target::Trace | Target::Export, _) => {}
        }
    }

    pub(super) fn frame(&mut self, target: Target, frame: Arc<Frame>) -> Vec<Effect> {
        match target {
            Target::Preview => self.preview.take(frame),
            Target::Trace => {
                if let Some(trace) = &mut self.trace {
                    trace.take(frame);
                }
            }
            Target::Export => return self.export_frame(frame),
        }
        Vec::new()
    }

    /// Notes that a picture will not be finished, and why.
    pub(super) fn ended(&mut self, target: Target, reason: impl Into<String>) {
        match target {
            Target::Preview => self.preview.wanted = None,
            Target::Trace => {
                if let Some(trace) = &mut self.trace {
                    trace.wanted = None;
                }
            }
            Target::Export => {
                let traced = |export: &mut Export| export.stage == Stage::Tracing;
                if self.export.take_if(traced).is_none() {
                    return;
                }
                self.pending.quit = false;
            }
        }
        self.fail(reason);
    }

    fn export_frame(&mut self, frame: Arc<Frame>) -> Vec<Effect> {
        let Some(export) = &mut self.export else {
            return Vec::new();
        };
        export.progress = Some(frame.progress);
        if !frame.progress.complete {
            return Vec::new();
        }
        export.stage = Stage::Writing;
        let mut effects = vec![
            Effect::WriteImage(export.id, frame, export.destination.clone()),
            Effect::Stop(Target::Export),
        ];
        effects.extend(self.count_seconds());
        effects
    }

    pub(super) fn exported(
        &mut self,
        id: ExportId,
        outcome: Result<Exported, String>,
    ) -> Vec<Effect> {
        let Some(export) = self.export.take_if(|export| export.id == id) else {
            // One that was cancelled; nobody waits for it, but its file is there now.
            if let Ok(exported) = outcome {
                self.say(format!("wrote {} anyway", exported.path.display()));
                self.note_export(exported);
            }
            return Vec::new();
        };
        match outcome {
            Ok(exported) => {
                let path = exported.path.display();
                self.say(format!("wrote {path}{}", summary(&export)));
                self.note_export(exported);
                self.quit_when_done()
            }
            Err(reason) => {
                self.pending.quit = false;
                self.fail(reason);
                stop_tracing(&export)
            }
        }
    }

    fn note_export(&mut self, Exported { path, version }: Exported) {
        match version {
            Some(version) => self.pending.written.insert(path, version),
            None => self.pending.written.remove(&path),
        };
    }

    /// What may become of a file where a picture is to be written: this session's own pictures are
    /// overwritten unless others have changed them.
    fn existing(&self, path: &Path) -> Existing {
        let own = self.pending.written.get(path);
        own.map_or(Existing::Kept, |&version| Existing::Own(version))
    }

    /// Exports under the scene's name, in its folder.
    pub(super) fn export_default(&mut self) -> Vec<Effect> {
        self.start_export(&self.export_path(), None, None, Existing::Kept)
    }

    /// The scene's name with a picture's ending: pictures of light and of other things don't
    /// overwrite each other.
    pub(super) fn export_path(&self) -> PathBuf {
        let extension = self
            .aov
            .map_or_else(|| "bmp".to_owned(), |aov| format!("{}.bmp", aov.name()));
        let scene = self
            .path
            .as_deref()
            .unwrap_or_else(|| Path::new("halflight"));
        scene.with_extension(extension)
    }

    /// Exports the scene as it is seen now. [`Existing::Kept`] keeps only what others wrote.
    pub(super) fn start_export(
        &mut self,
        path: &Path,
        size: Option<Size>,
        spp: Option<u32>,
        existing: Existing,
    ) -> Vec<Effect> {
        let size = size.unwrap_or_else(|| self.output());
        let spp = self.samples(spp.unwrap_or(self.quality.spp));
        let job = self.job(size, spp, self.quality.filter);
        let format = ImageFormat::of_path(path);
        let refused = match (format, &job) {
            _ if self.export.is_some() => Some("an export is under way: x cancels it".to_owned()),
            _ if self.awaits_assets() => Some(STILL_READING.to_owned()),
            (None, _) => Some(format!(
                "{}: pictures end in {}",
                path.display(),
                known_extensions()
            )),
            (_, None) => Some("there is no picture: the scene has errors".to_owned()),
            (Some(format), Some(_)) => format.refuses(size),
        };
        let job = match (refused, job) {
            (None, Some(job)) => job,
            (reason, _) => {
                self.fail(reason.unwrap_or_default());
                return Vec::new();
            }
        };
        let frames = format.map_or(Frames::Last, ImageFormat::frames);
        let existing = match existing {
            Existing::Kept => self.existing(path),
            Existing::Own(_) | Existing::Overwritten => existing,
        };
        let destination = Destination {
            path: path.to_owned(),
            existing,
            scene: self.path.clone(),
            named: self.named_files().to_vec(),
        };
        let traced = self.traced(size, spp).filter(|_| frames == Frames::Last);
        self.pending.export.0 += 1;
        let id = self.pending.export;
        self.export = Some(Export {
            id,
            stage: match traced {
                Some(_) => Stage::Writing,
                None => Stage::Tracing,
            },
            destination: destination.clone(),
            size,
            spp,
            aov: self.aov,
            progress: traced.as_ref().map(|frame| frame.progress),
            written_for: 0,
        });
        let what = self
            .aov
            .map_or_else(String::new, |aov| format!("{} ", aov.name()));
        let to = path.display();
        if self.error_count() == 0 {
            self.say(format!("exporting {what}to {to}"));
        } else {
            let why = "the text has errors: this is the last scene without";
            self.warn(format!("exporting {what}to {to}; {why}"));
        }
        if let Some(frame) = traced {
            let mut effects = vec![Effect::WriteImage(id, frame, destination)];
            effects.extend(self.count_seconds());
            return effects;
        }
        // The framing is that of the size that is written.
        let camera = Camera { size, ..job.camera };
        vec![
            Effect::CheckTarget(id, destination),
            Effect::Trace(
                Target::Export,
                Job {
                    camera,
                    frames,
                    ..job
                },
            ),
        ]
    }

    /// The full-size trace, if it is finished and just what is to be exported.
    fn traced(&self, size: Size, spp: u32) -> Option<Arc<Frame>> {
        let trace = self.trace.as_ref()?;
        let frame = trace.latest.as_ref().filter(|_| trace.is_complete())?;
        let same =
            frame.size == size && size == self.output() && spp == self.samples(self.quality.spp);
        same.then(|| Arc::clone(frame))
    }

    /// Stops the full-size trace, or else the export.
    pub(super) fn stop(&mut self) -> Vec<Effect> {
        let seen = self.trace.as_mut().filter(|_| self.mode == Mode::Trace);
        if let Some(trace) = seen.filter(|trace| trace.wanted.is_some() && !trace.is_complete()) {
            trace.wanted = None;
            self.say("stopped; F5 restarts");
            return vec![Effect::Stop(Target::Trace)];
        }
        self.cancel_export()
    }

    pub(super) fn cancel_export(&mut self) -> Vec<Effect> {
        let Some(export) = self.export.take() else {
            self.say("nothing is running");
            return Vec::new();
        };
        self.pending.quit = false;
        match export.stage {
            Stage::Tracing => self.say("export cancelled"),
            Stage::Writing => {
                let path = export.destination.path.display();
                self.warn(format!("too late to cancel: {path} is being written"));
            }
        }
        stop_tracing(&export)
    }
}

fn stop_tracing(export: &Export) -> Vec<Effect> {
    match export.stage {
        Stage::Tracing => vec![Effect::Stop(Target::Export)],
        Stage::Writing => Vec::new(),
    }
}

/// What an exported picture shows, how large and how fine it is, and how long it took.
fn summary(export: &Export) -> String {
    let Size { width, height } = export.size;
    let took = export.progress.map_or_else(String::new, |progress| {
        format!(", {:.1} s", progress.elapsed.as_secs_f64())
    });
    let what = export
        .aov
        .map_or_else(String::new, |aov| format!("{}, ", aov.name()));
    format!(": {what}{width}×{height}, {} spp{took}", export.spp)
}
