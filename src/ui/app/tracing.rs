//! Starting and stopping traces: the preview and the full-size trace.

use std::sync::Arc;

use super::until::Until;
use super::viewport::{Detail, Screen};
use super::{Grid, Picture, Shared, ShownWireframe};
use crate::image_file::ImageFormat;
use crate::render::{Frame, Frames, Job, Region, Settings};
use crate::scene::{Filter, Integrator, Rendering, Scene, Size};
use crate::text::Severity;
use crate::ui::keymap::Mode;
use crate::ui::msg::{Effect, Recalled, Target};

/// Samples per pixel at which the preview stops: by then edges are smooth and the noise of paths is
/// invisible. Where cells hold more pixels, each needs fewer samples.
fn preview_samples(integrator: Integrator, grid: Grid) -> u32 {
    let density = u32::from(grid.across) * u32::from(grid.down) / 2;
    let samples = match integrator {
        Integrator::Whitted => 64,
        Integrator::Path | Integrator::Photon => 1024,
    };
    samples / density.clamp(1, 4)
}

impl Shared {
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
        effects.extend(self.follow_comparison(changed));
        let screen = self.preview_screen();
        let asked = screen.map(|screen| self.preview_asked(screen));
        if self.seen() == Target::Preview && self.pictures.preview.asked != asked {
            self.pictures.preview.asked = asked;
            let job = screen.zip(asked);
            let job = job.and_then(|(screen, asked)| self.preview_job(screen, asked));
            effects.extend(job.map(|job| Effect::Trace(Target::Preview, job)));
        }
        effects
    }

    /// The size of the preview, and the part of it that is on screen.
    fn preview_asked(&self, screen: Screen) -> (Size, Option<Region>) {
        let preview = &self.pictures.preview;
        let viewport = preview.viewport;
        let window = viewport.window(screen, Detail::OnScreen);
        match window.filter(|_| self.pictures.wireframe.is_none()) {
            Some(window) => (window.whole, Some(window.part)),
            None => (screen.grid.size(screen.halves), None),
        }
    }

    fn preview_job(&self, screen: Screen, (size, region): (Size, Option<Region>)) -> Option<Job> {
        let spp = preview_samples(self.rendering().integrator(), screen.grid);
        let mut job = self.shown_job(size, spp)?;
        job.settings.region = region;
        job.denoise = self.pictures.display.denoised;
        job.settings.aov = self.pictures.preview_aov();
        if let Some(aov) = job.settings.aov {
            job.settings.spp = aov.samples(spp);
        }
        Some(job)
    }

    /// The job of what the preview shows of the scene.
    pub(super) fn shown_job(&self, size: Size, spp: u32) -> Option<Job> {
        let (scene, numbers) = self.preview_scene()?;
        let job = self.job_of(scene, size, spp, Some(Filter::Box))?;
        Some(Job { numbers, ..job })
    }

    /// The wireframe if it is on screen instead of a traced picture.
    pub fn wireframe(&self) -> Option<&ShownWireframe> {
        let wireframe = self.pictures.wireframe.as_ref();
        wireframe.filter(|_| self.seen() == Target::Preview)
    }

    /// Brings the wireframe up to date, if it is on screen.
    pub fn follow_wires(&mut self) {
        if self.seen() != Target::Preview {
            return;
        }
        let (camera, raster) = (self.camera(), self.raster());
        if let (Some(wireframe), Some(scene)) = (&mut self.pictures.wireframe, &self.scene)
            && let (Some(camera), Some((_, size))) = (camera, raster)
        {
            wireframe.follow(scene, camera, size);
        }
    }

    fn follow_trace(&mut self) -> Vec<Effect> {
        match self.pictures.trace {
            None => Vec::new(),
            Some(_) if self.seen() == Target::Trace => self.restart_trace(),
            Some(_) => {
                self.pictures.trace = None;
                vec![Effect::Stop(Target::Trace)]
            }
        }
    }

    /// Restarts the full-size trace if it is running; it continues from the pixels that stay valid.
    pub(super) fn retrace(&mut self) -> Vec<Effect> {
        if self.pictures.is_tracing() {
            self.restart_trace()
        } else {
            Vec::new()
        }
    }

    fn restart_trace(&mut self) -> Vec<Effect> {
        let Ok(job) = self.trace_job() else {
            return Vec::new();
        };
        if let Some(trace) = &mut self.pictures.trace {
            trace.paused = false;
        }
        vec![Effect::Trace(Target::Trace, job)]
    }

    /// The job that traces a scene, with this pixel filter if another than that asked for.
    fn job_of(
        &self,
        scene: Arc<Scene>,
        size: Size,
        spp: u32,
        filter: Option<Filter>,
    ) -> Option<Job> {
        let asked = self.pictures.rendering(Some(&scene));
        let rendering = Rendering {
            spp: Some(self.pictures.samples(spp)),
            filter: filter.or(asked.filter),
            ..asked
        };
        Some(Job {
            scene,
            images: self.assets.images.clone(),
            camera: self.camera()?,
            settings: Settings {
                aov: self.pictures.aov,
                ..Settings::new(size, &rendering)
            },
            limit: None,
            frames: Frames::Live,
            denoise: false,
            numbers: None,
        })
    }

    /// The job of a picture in the quality of exports, or the reason why there is none.
    pub(super) fn final_job(&self, size: Size, spp: u32) -> Result<Job, String> {
        let scene = self.scene.as_ref().map(Arc::clone);
        let job = scene.and_then(|scene| self.job_of(scene, size, spp, None));
        job.filter(|_| !self.assets.are_awaited())
            .ok_or_else(|| self.no_picture())
    }

    /// The reason why there is no picture.
    pub(super) fn no_picture(&self) -> String {
        if self.assets.are_awaited() {
            "still reading the scene's files".to_owned()
        } else {
            let errors = self.key_for("errors");
            format!("no picture: the scene has errors; press {errors} to list them")
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

    pub(super) fn trace_job(&self) -> Result<Job, String> {
        let (spp, limit) = self.until().limits();
        let mut job = self.final_job(self.output(), spp)?;
        job.limit = limit;
        job.denoise = self.pictures.display.denoised;
        job.settings.region = self.region();
        Ok(job)
    }

    /// Starts the full-size trace, or continues it after a stop or a pause.
    pub(super) fn start_trace(&mut self) -> Vec<Effect> {
        let is_begun = self.pictures.is_tracing();
        if self.mode == Mode::Trace && is_begun {
            return self.resume();
        }
        let job = match self.trace_job() {
            Ok(job) => job,
            Err(reason) => {
                self.refuse_picture(Severity::Error, &reason);
                return Vec::new();
            }
        };
        // A picture too large for a picture file is also too large to look at.
        if let Some(reason) = ImageFormat::Bmp.refuses(job.settings.traced().size()) {
            self.overlays.fail(reason);
            return Vec::new();
        }
        self.enter_trace();
        if 0 < self.error_count() {
            let words = "the text has errors: this is the last valid scene";
            self.overlays.blame_errors(Severity::Warning, words);
        }
        if is_begun {
            return Vec::new();
        }
        let under = self.pictures.preview.whole();
        let under = under.filter(|_| job.settings.region.is_some());
        if self.pictures.trace.is_some() {
            return vec![Effect::Trace(Target::Trace, job)];
        }
        self.pictures.trace = Some(Picture::over(under));
        vec![self.trace_from_kept(job)]
    }

    /// Starts the full-size trace from what an earlier run left of it, if that can be known: a text
    /// with errors is not that of its scene.
    fn trace_from_kept(&self, job: Job) -> Effect {
        match self.origin() {
            Some(origin) => Effect::Recall(job, origin),
            None => Effect::Trace(Target::Trace, job),
        }
    }

    /// Says what an earlier run left of the full-size trace.
    pub(super) fn recalled(&mut self, recalled: Recalled) {
        match recalled {
            Recalled::Continued(spp) => self.overlays.say(format!(
                "continuing the full-size trace that an earlier run left with {spp} spp"
            )),
            Recalled::More(spp) => {
                self.pictures.more_kept = true;
                self.overlays.say(format!(
                    "an earlier run left more samples: :until {spp} spp continues from them"
                ));
            }
            Recalled::Unreadable(reason) => self.overlays.warn(reason),
        }
    }

    pub(super) fn enter_trace(&mut self) {
        match (self.mode, self.compared.before) {
            // The mode to return to is that before the comparison.
            (Mode::Trace, _) | (Mode::Compare, Some(Mode::Trace)) => {}
            _ if self.seen() == Target::Trace => {}
            (Mode::Compare, before) => self.pictures.leave_mode(before.unwrap_or(Mode::Select)),
            (mode, _) => self.pictures.leave_mode(mode),
        }
        self.mode = Mode::Trace;
    }

    /// Pauses the full-size trace, or goes on.
    pub(super) fn toggle_pause(&mut self) -> Vec<Effect> {
        match &mut self.pictures.trace {
            Some(trace) if trace.paused => self.resume(),
            Some(trace) if trace.is_awaited() => {
                trace.paused = true;
                vec![Effect::Pause(Target::Trace)]
            }
            Some(trace) if trace.is_complete() => {
                self.overlays
                    .say("the picture is complete: there is nothing to pause");
                Vec::new()
            }
            _ => self.start_trace(),
        }
    }

    /// Ends the pause of the full-size trace, if it is paused.
    fn resume(&mut self) -> Vec<Effect> {
        let trace = self.pictures.trace.as_mut();
        match trace.filter(|trace| trace.paused) {
            Some(trace) => {
                trace.paused = false;
                vec![Effect::Resume(Target::Trace)]
            }
            None => Vec::new(),
        }
    }

    pub(super) fn frame(&mut self, target: Target, frame: Arc<Frame>) -> Vec<Effect> {
        match target {
            Target::Export => return self.export_frame(frame),
            Target::Trial => return self.tried(&frame),
            Target::Compared | Target::Reference => {
                self.compared.take(target, frame);
                return Vec::new();
            }
            Target::Preview | Target::Trace | Target::Thumbnail => {}
        }
        // Without a scene, it is of one that was left.
        if self.scene.is_some() {
            let effects = self.judge_picture(target, &frame);
            self.pictures.take(target, frame);
            return effects;
        }
        Vec::new()
    }

    /// Records that a picture will not be finished, and shows the reason.
    pub(super) fn ended(&mut self, target: Target, reason: impl Into<String>) -> Vec<Effect> {
        match target {
            Target::Export => return self.export_ended(reason.into()),
            Target::Trial => return self.end_trials(),
            Target::Preview
            | Target::Trace
            | Target::Compared
            | Target::Reference
            | Target::Thumbnail => {}
        }
        self.pictures.want(target, None);
        self.compared.want(target, None);
        self.overlays.fail(reason);
        Vec::new()
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
            trace.paused = false;
            let trace = self.key_for("trace");
            self.overlays
                .say(format!("stopped; press {trace} to continue"));
            return vec![Effect::Halt(Target::Trace)];
        }
        self.cancel_export()
    }

    /// Sets when the full-size trace is complete, or says when it is. A trace in progress continues
    /// from the samples it has.
    pub(super) fn trace_until(&mut self, until: Option<Until>) -> Vec<Effect> {
        if until.is_some() {
            self.pictures.until = until;
        }
        let until = self.until();
        self.overlays
            .say(format!("the full-size trace ends {until}"));
        match self.trace_job() {
            Ok(job) if self.pictures.is_tracing() && self.pictures.more_kept => {
                self.pictures.more_kept = false;
                // Otherwise it would continue from the samples of this run.
                vec![Effect::Stop(Target::Trace), self.trace_from_kept(job)]
            }
            _ => self.retrace(),
        }
    }
}
