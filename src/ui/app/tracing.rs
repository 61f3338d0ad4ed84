//! Starting and stopping traces: the preview, the full-size trace, exports.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::command::Force;
use super::{App, Export, Picture, Stage};
use crate::image_file::{ImageFormat, known_extensions};
use crate::render::{Filter, Frame, Frames, Job, Settings, default_depth};
use crate::scene::{Camera, Integrator, Size};
use crate::text::Severity;
use crate::ui::keymap::Mode;
use crate::ui::msg::{Destination, Effect, Existing, ExportId, Exported, Target};

/// Samples per pixel at which the preview stops: by then edges are smooth and the noise of paths is
/// invisible.
fn preview_samples(integrator: Integrator) -> u32 {
    match integrator {
        Integrator::Whitted => 64,
        Integrator::Path => 1024,
    }
}

impl App {
    /// Restarts pictures that no longer show the scene.
    pub(super) fn follow(&mut self) -> Vec<Effect> {
        let mut effects = self.assets.follow();
        if self.assets.are_awaited() {
            // A picture without these files would be seen only for a moment.
            return effects;
        }
        let changed = std::mem::take(&mut self.pictures.due);
        if changed {
            self.pictures.preview.asked = None;
            effects.extend(self.follow_trace());
        }
        let size = self.preview_size();
        if self.mode != Mode::Trace && self.pictures.preview.asked != size {
            self.pictures.preview.asked = size;
            let spp = preview_samples(self.integrator());
            let job = size.and_then(|size| self.job(size, spp, Filter::Box));
            effects.extend(job.map(|job| Effect::Trace(Target::Preview, job)));
        }
        effects
    }

    fn follow_trace(&mut self) -> Option<Effect> {
        self.pictures.trace.as_ref()?;
        if self.mode == Mode::Trace {
            return self
                .trace_job()
                .map(|job| Effect::Trace(Target::Trace, job));
        }
        self.pictures.trace = None;
        Some(Effect::Stop(Target::Trace))
    }

    fn job(&self, size: Size, spp: u32, filter: Filter) -> Option<Job> {
        let scene = self.scene.as_ref()?;
        let integrator = self.integrator();
        Some(Job {
            scene: Arc::clone(scene),
            images: self.assets.images.clone(),
            camera: self.camera()?,
            settings: Settings {
                size,
                spp: self.pictures.samples(spp),
                depth: self
                    .pictures
                    .quality
                    .depth
                    .unwrap_or_else(|| default_depth(integrator)),
                seed: 0,
                aov: self.pictures.aov,
                integrator,
                filter,
                transfer: scene.setting.transfer,
            },
            frames: Frames::Live,
        })
    }

    /// The job of a picture in the quality of exports, or the reason why there is none.
    fn final_job(&self, size: Size, spp: u32) -> Result<Job, &'static str> {
        let job = self.job(size, spp, self.pictures.quality.filter);
        job.filter(|_| !self.assets.are_awaited())
            .ok_or_else(|| self.no_picture())
    }

    /// The reason why there is no picture.
    pub(super) fn no_picture(&self) -> &'static str {
        if self.assets.are_awaited() {
            "still reading the scene's files"
        } else {
            "no picture: the scene has errors; press ! to list them"
        }
    }

    /// Shows why something cannot be done with the picture. The message goes with the errors in the
    /// text if there are any.
    pub(super) fn refuse_picture(&mut self, severity: Severity, reason: &str) {
        if 0 < self.error_count() {
            self.overlays.blame_errors(severity, reason);
        } else {
            self.overlays.show(Some(severity), reason);
        }
    }

    fn trace_job(&self) -> Option<Job> {
        self.job(
            self.output(),
            self.pictures.quality.spp,
            self.pictures.quality.filter,
        )
    }

    pub(super) fn start_trace(&mut self) -> Vec<Effect> {
        let is_begun = self.pictures.is_tracing();
        if self.mode == Mode::Trace && is_begun {
            return Vec::new();
        }
        let job = match self.final_job(self.output(), self.pictures.quality.spp) {
            Ok(job) => job,
            Err(reason) => {
                self.refuse_picture(Severity::Error, reason);
                return Vec::new();
            }
        };
        // A picture too large for a picture file is also too large to look at.
        if let Some(reason) = ImageFormat::Bmp.refuses(job.settings.size) {
            self.overlays.fail(reason);
            return Vec::new();
        }
        if self.mode != Mode::Trace {
            self.pictures.leave_mode(self.mode);
            self.mode = Mode::Trace;
        }
        if 0 < self.error_count() {
            let words = "the text has errors: this is the last valid scene";
            self.overlays.blame_errors(Severity::Warning, words);
        }
        if is_begun {
            return Vec::new();
        }
        self.pictures.trace = Some(Picture::default());
        vec![Effect::Trace(Target::Trace, job)]
    }

    pub(super) fn frame(&mut self, target: Target, frame: Arc<Frame>) -> Vec<Effect> {
        if target == Target::Export {
            return self.export_frame(frame);
        }
        self.pictures.take(target, frame);
        Vec::new()
    }

    /// Records that a picture will not be finished, and shows the reason.
    pub(super) fn ended(&mut self, target: Target, reason: impl Into<String>) {
        if target == Target::Export {
            let traced = |export: &mut Export| export.stage == Stage::Tracing;
            if self.jobs.export.take_if(traced).is_none() {
                return;
            }
            self.jobs.quit = false;
        }
        self.pictures.want(target, None);
        self.overlays.fail(reason);
    }

    fn export_frame(&mut self, frame: Arc<Frame>) -> Vec<Effect> {
        let Some(export) = &mut self.jobs.export else {
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
        effects.extend(self.jobs.count_seconds());
        effects
    }

    pub(super) fn exported(
        &mut self,
        id: ExportId,
        outcome: Result<Exported, String>,
    ) -> Vec<Effect> {
        let Some(export) = self.jobs.export.take_if(|export| export.id == id) else {
            // A cancelled export: nobody waits for it, but its file exists now.
            if let Ok(exported) = outcome {
                self.overlays
                    .report(format!("wrote {} anyway", exported.path.display()));
                self.jobs.note_export(exported);
            }
            return Vec::new();
        };
        match outcome {
            Ok(exported) => {
                let path = exported.path.display();
                self.overlays
                    .report(format!("wrote {path}{}", export.summary()));
                self.jobs.note_export(exported);
                self.quit_when_done()
            }
            Err(reason) => {
                self.jobs.quit = false;
                self.overlays.fail(reason);
                export.stop()
            }
        }
    }

    /// Exports to the scene's folder under the scene's name.
    pub(super) fn export_default(&mut self) -> Vec<Effect> {
        self.start_export(&self.export_path(), None, None, Force::No)
    }

    /// The scene's path with a picture's extension, distinct for each AOV so that they don't
    /// overwrite each other.
    pub(super) fn export_path(&self) -> PathBuf {
        let extension = self
            .pictures
            .aov
            .map_or_else(|| "bmp".to_owned(), |aov| format!("{}.bmp", aov.name()));
        let scene = self
            .disk
            .path
            .as_deref()
            .unwrap_or_else(|| Path::new("halflight"));
        scene.with_extension(extension)
    }

    /// The job whose picture an export to `path` writes, or the reason why there is none.
    fn export_job(&self, path: &Path, size: Size, spp: u32) -> Result<Job, String> {
        if self.jobs.export.is_some() {
            return Err("an export is already running: press x to cancel it".to_owned());
        }
        let format = ImageFormat::of_path(path).ok_or_else(|| {
            let (name, known) = (path.display(), known_extensions());
            format!("{name}: picture files end in {known}")
        })?;
        let job = self.final_job(size, spp)?;
        let frames = format.frames();
        format.refuses(size).map_or(Ok(Job { frames, ..job }), Err)
    }

    /// Exports the scene as currently seen. Unless forced, files written by others are kept.
    pub(super) fn start_export(
        &mut self,
        path: &Path,
        size: Option<Size>,
        spp: Option<u32>,
        force: Force,
    ) -> Vec<Effect> {
        let size = size.unwrap_or_else(|| self.output());
        let spp = self
            .pictures
            .samples(spp.unwrap_or(self.pictures.quality.spp));
        let job = match self.export_job(path, size, spp) {
            Ok(job) => job,
            Err(reason) => {
                self.overlays.fail(reason);
                return Vec::new();
            }
        };
        let destination = Destination {
            path: path.to_owned(),
            existing: match force {
                Force::No => self.jobs.existing(path),
                Force::Yes => Existing::Overwritten,
            },
            scene: self.disk.path.clone(),
            named: self.assets.files().to_vec(),
        };
        let traced = self
            .traced(size, spp)
            .filter(|_| job.frames == Frames::Last);
        let id = self.jobs.next_export();
        self.jobs.export = Some(Export {
            id,
            stage: match traced {
                Some(_) => Stage::Writing,
                None => Stage::Tracing,
            },
            destination: destination.clone(),
            size,
            spp,
            aov: self.pictures.aov,
            progress: traced.as_ref().map(|frame| frame.progress),
            written_for: 0,
        });
        let what = self
            .pictures
            .aov
            .map_or_else(String::new, |aov| format!("{} ", aov.name()));
        let to = path.display();
        if self.error_count() == 0 {
            self.overlays.say(format!("exporting {what}to {to}"));
        } else {
            let why = "the text has errors: this is the last valid scene";
            self.overlays
                .warn(format!("exporting {what}to {to}; {why}"));
        }
        if let Some(frame) = traced {
            let mut effects = vec![Effect::WriteImage(id, frame, destination)];
            effects.extend(self.jobs.count_seconds());
            return effects;
        }
        // Frames the view for the size that is written.
        let camera = Camera { size, ..job.camera };
        vec![
            Effect::CheckTarget(id, destination),
            Effect::Trace(Target::Export, Job { camera, ..job }),
        ]
    }

    /// The full-size trace, if it is complete and exactly what is to be exported.
    fn traced(&self, size: Size, spp: u32) -> Option<Arc<Frame>> {
        let trace = self.pictures.trace.as_ref()?;
        let frame = trace.latest.as_ref().filter(|_| trace.is_complete())?;
        let same = frame.size == size
            && size == self.output()
            && spp == self.pictures.samples(self.pictures.quality.spp);
        same.then(|| Arc::clone(frame))
    }

    /// Stops the full-size trace if it is running, otherwise the export.
    pub(super) fn stop(&mut self) -> Vec<Effect> {
        let seen = self
            .pictures
            .trace
            .as_mut()
            .filter(|_| self.mode == Mode::Trace);
        if let Some(trace) = seen.filter(|trace| trace.wanted.is_some() && !trace.is_complete()) {
            trace.wanted = None;
            self.overlays.say("stopped; press F5 to restart");
            return vec![Effect::Stop(Target::Trace)];
        }
        self.cancel_export()
    }

    pub(super) fn cancel_export(&mut self) -> Vec<Effect> {
        let Some(export) = self.jobs.export.take() else {
            self.overlays.say("nothing is running");
            return Vec::new();
        };
        self.jobs.quit = false;
        match export.stage {
            Stage::Tracing => self.overlays.say("export cancelled"),
            Stage::Writing => {
                let path = export.destination.path.display();
                self.overlays
                    .warn(format!("too late to cancel: {path} is being written"));
            }
        }
        export.stop()
    }
}
