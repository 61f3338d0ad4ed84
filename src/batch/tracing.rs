//! Traces pictures without an interface.

use std::num::NonZero;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use super::progress::{Place, ProgressStyle, Reporter};
use super::reading::Over;
use super::signals::Signals;
use super::{Error, Messages};
use image_file::layer_bytes;
use render::{
    Advice, Aov, Frame, Frames, Job, Limit, Provenance, Region, Renderer, SettingSearch, Settings,
    Threads,
};
use scene::{Images, MAX_SPP, Rendering, Scene, Size, Viewpoint};

/// How long a signal may go unnoticed.
const PATIENCE: Duration = Duration::from_millis(50);

/// How a scene is traced.
#[derive(Clone, Debug, PartialEq)]
pub struct Tracing {
    /// The size of the picture; the scene's if `None`.
    pub size: Option<Size>,
    /// What replaces parts of the scene's own camera.
    pub view: Viewpoint,
    /// The only part of the picture to render, if not all of it.
    pub region: Option<Region>,
    /// What takes precedence over the scene's render settings.
    pub rendering: Rendering,
    /// The time after which no pass begins; without a number of samples, as many are taken as it
    /// permits.
    pub time: Option<Duration>,
    /// The random seed; 0 if `None`.
    pub seed: Option<u32>,
    /// What to render instead of light.
    pub aov: Option<Aov>,
    /// What to render beside light.
    pub layers: Vec<Aov>,
    /// Whether to reduce the noise of light.
    pub denoise: bool,
    /// How the work is run.
    pub execution: Execution,
}

/// How work is run: its threads, and how progress is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Execution {
    /// The number of tracing threads.
    pub threads: usize,
    /// How the progress is shown.
    pub progress: ProgressStyle,
}

impl Execution {
    /// How messages beside the progress are written.
    pub(super) fn messages(self) -> Messages {
        Messages::beside(self.progress)
    }
}

/// A picture to trace, with layers.
#[derive(Clone)]
pub(super) struct Still {
    pub(super) job: Job,
    /// What to trace beside its light.
    pub(super) layers: Vec<Aov>,
}

impl Still {
    /// What the picture is made from, whose scene has this digest.
    pub(super) fn provenance(&self, scene: String) -> Provenance {
        Provenance {
            layers: self.layers.clone(),
            ..Provenance::of(&self.job, scene)
        }
    }

    /// About how many bytes of memory the layers take until the picture is written.
    pub(super) fn memory_for_layers(&self) -> u64 {
        let size = self.job.settings.traced().size();
        let layers = self.layers.iter().map(|&aov| layer_bytes(aov, size));
        layers.fold(0, u64::saturating_add)
    }
}

/// A renderer that traces one job after the other, and keeps the structures of objects that stay as
/// they are.
pub(super) struct Tracer {
    renderer: Renderer,
    woken: Receiver<()>,
    style: ProgressStyle,
    /// What stops it.
    signals: Signals,
}

impl Tracer {
    pub(super) fn new(execution: Execution) -> Self {
        let (wake, woken) = mpsc::channel();
        // Starting its threads before reading the scene was no faster.
        let renderer = Renderer::new(Threads::Exactly(execution.threads), move || {
            // This fails only while the renderer is being dropped.
            let _ = wake.send(());
        });
        Self {
            renderer,
            woken,
            style: execution.progress,
            signals: Signals::default(),
        }
    }

    /// Fails with [`Error::Stopped`] soon after one of these signals has arrived.
    pub(super) fn stopped_by(self, signals: Signals) -> Self {
        Self { signals, ..self }
    }

    /// Traces a job, at a place in a sequence, and shows the progress. `started` is called while the
    /// renderer works.
    pub(super) fn trace(
        &mut self,
        job: Job,
        place: Option<Place>,
        started: impl FnOnce(),
    ) -> Result<Arc<Frame>, Error> {
        self.renderer.restart(job)?;
        started();
        let reporter = Reporter::new(self.style).at(place);
        self.wait(reporter)
    }

    /// Traces the layers of a picture whose light was traced with `spp` samples.
    pub(super) fn layers(
        &mut self,
        still: &Still,
        spp: u32,
    ) -> Result<Vec<(Aov, Arc<Frame>)>, Error> {
        let Still { job, layers } = still;
        let layers = layers.iter().map(|&aov| {
            let settings = Settings {
                aov: Some(aov),
                spp: aov.samples(spp),
                ..job.settings
            };
            self.renderer.restart(Job {
                settings,
                limit: None,
                ..job.clone()
            })?;
            let reporter = Reporter::new(ProgressStyle::Off);
            let frame = self.wait(reporter)?;
            Ok((aov, frame))
        });
        layers.collect()
    }

    /// Traces the small pictures of trials for a job, and returns what they show. Returns `None`
    /// if they cannot be traced.
    pub(super) fn try_out(&mut self, job: &Job, mut trials: SettingSearch) -> Option<Advice> {
        loop {
            let job = Job {
                settings: trials.settings(),
                limit: None,
                frames: Frames::Live,
                denoise: false,
                ..job.clone()
            };
            self.renderer.restart(job).ok()?;
            let picture = self.wait(Reporter::new(ProgressStyle::Off)).ok()?;
            match trials.after(&picture) {
                ControlFlow::Continue(next) => trials = next,
                ControlFlow::Break(advice) => return advice,
            }
        }
    }

    /// Waits for the last frame of the present job.
    fn wait(&self, mut reporter: Reporter) -> Result<Arc<Frame>, Error> {
        while !self.signals.arrived() {
            match self.woken.recv_timeout(PATIENCE) {
                Ok(()) => {}
                Err(RecvTimeoutError::Timeout) => continue,
                Err(RecvTimeoutError::Disconnected) => break,
            }
            let Some(frame) = self.renderer.latest() else {
                continue;
            };
            if frame.progress.complete {
                reporter.finish(&frame.progress);
                return Ok(frame);
            }
            reporter.show(&frame.progress);
        }
        Err(Error::Stopped)
    }
}

impl Tracing {
    /// How a scene's own picture is traced.
    pub(super) fn of_scene() -> Self {
        Self {
            size: None,
            view: Viewpoint::default(),
            region: None,
            rendering: Rendering::default(),
            time: None,
            seed: None,
            aov: None,
            layers: Vec::new(),
            denoise: false,
            execution: Execution {
                threads: thread::available_parallelism().map_or(1, NonZero::get),
                progress: ProgressStyle::Off,
            },
        }
    }

    /// What takes precedence over what a text says of its picture.
    pub(super) fn over(&self) -> Over {
        Over {
            rendering: self.over_text(),
            view: self.view.clone(),
            size: self.size,
        }
    }

    /// The render settings that take precedence over those of a text.
    pub(super) fn over_text(&self) -> Rendering {
        // A time to spend means more than the samples that a text asks for.
        let spp = self.time.map(|_| MAX_SPP);
        Rendering {
            spp: self.rendering.spp.or(spp),
            ..self.rendering
        }
    }

    /// The picture of a scene, with its layers.
    pub(super) fn still(
        &self,
        scene: Scene,
        images: Images,
        frames: Frames,
    ) -> Result<Still, Error> {
        Ok(Still {
            job: self.job(scene, images, frames)?,
            layers: self.layers.clone(),
        })
    }

    /// The job that traces a scene.
    pub(super) fn job(&self, scene: Scene, images: Images, frames: Frames) -> Result<Job, Error> {
        let camera = self.over().camera(&scene.camera);
        let camera = camera.map_err(|reason| Error::Refused(format!("--view: {reason}")))?;
        let size = camera.size;
        if let Some(Err(reason)) = self.region.map(|region| region.within(size)) {
            return Err(Error::Refused(format!("--region: {reason}")));
        }
        let asked = self.over_text().or(scene.setting.rendering);
        let settings = Settings::new(size, &asked);
        Ok(Job {
            images,
            camera,
            scene: Arc::new(scene),
            settings: Settings {
                region: self.region,
                spp: self
                    .aov
                    .map_or(settings.spp, |aov| aov.samples(settings.spp)),
                seed: self.seed.unwrap_or_default(),
                aov: self.aov,
                ..settings
            },
            limit: self.time.map(Limit::Time),
            frames,
            denoise: self.denoise,
            numbers: None,
        })
    }
}
