//! Continues the full-size trace across runs: recalls what an earlier run left of it, and keeps it
//! at the end.

use std::io;
use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::sync::{Arc, Weak};

use std::time::{Duration, Instant};

use crate::msg::{Origin, Recalled};
use crate::queue::spawn;
use assets::FileDigests;
use render::{Checkpoint, Job, Provenance, Renderer};
use scene::Scene;
use shards::{Contents, Shard, Traces};

/// The least time spent on a trace that is kept.
const LEAST: Duration = Duration::from_secs(10);

/// What the full-size trace is made from.
pub(super) struct Traced {
    scene: Weak<Scene>,
    /// What all pictures are made from that its film shows, but for the digest of the scene.
    picture: Provenance,
    /// The samples that each pixel is to have, unless another limit ends the trace.
    goal: Option<u32>,
    /// The digests of its text and files, taken when it began, unless it was restarted since.
    digests: Option<Receiver<Digests>>,
}

/// The digests of the files that a scene names, and of all that it is made of.
struct Digests {
    files: FileDigests,
    scene: String,
}

/// What became of the full-size trace at the end.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum TraceEnd {
    /// There was nothing worth keeping.
    Nothing,
    /// The next run continues it.
    Kept {
        /// The mean samples per pixel.
        spp: u32,
        /// The samples that each pixel is to have, unless another limit ends the trace.
        goal: Option<u32>,
    },
    /// It is not kept, for this reason.
    Lost(String),
}

impl Traced {
    /// What a job is traced from.
    pub(super) fn of(job: &Job) -> Self {
        Self {
            scene: Arc::downgrade(&job.scene),
            picture: Provenance::of(job, String::new()).of_film(),
            goal: job.limit.is_none().then_some(job.settings.spp),
            digests: None,
        }
    }

    /// Whether it was looked for among those of earlier runs.
    #[cfg(test)]
    pub(super) fn was_looked_for(&self) -> bool {
        self.digests.is_some()
    }

    /// Looks on another thread for what an earlier run left of a job among some traces, or a render in
    /// the part beside a picture. `report` is called if that is something; the receiver brings it to the
    /// renderer.
    pub(super) fn recall(
        job: &Job,
        origin: Origin,
        (traces, beside): (Option<Traces>, PathBuf),
        report: impl Fn(Recalled) + Send + 'static,
    ) -> io::Result<(Self, Receiver<Checkpoint>)> {
        let traced = Self::of(job);
        let (send, recalled) = mpsc::channel();
        let (tell, digests) = mpsc::channel();
        let mut picture = traced.picture.clone();
        let (text, found, job) = (origin.text, origin.found, job.clone());
        let look = move || {
            // The picture is traced anyway, and its files may be gone.
            let Ok(files) = FileDigests::of(&found) else {
                return;
            };
            picture.scene = files.fingerprint(&text);
            drop(text);
            let scene = picture.scene.clone();
            // Fails only after the trace.
            let _ = tell.send(Digests { files, scene });
            let trace = traces.map_or(Ok(None), |traces| traces.find(&picture));
            let trace = trace.unwrap_or_else(|error| {
                report(Recalled::Unreadable(error.to_string()));
                None
            });
            let part = shards::find_part(&shards::path_beside(&beside, Shard::WHOLE), &picture);
            // The trace of equals.
            let found = part.into_iter().chain(trace);
            let Some(found) = found.max_by_key(Contents::all_taken) else {
                return;
            };
            let (spp, goal) = (found.mean_samples(), found.goal());
            if job.settings.spp < spp {
                report(Recalled::More(goal.spp.min(spp.next_power_of_two())));
                return;
            }
            match Checkpoint::of(found.written(), goal.time, &job) {
                Ok(kept) => {
                    let spp = kept.spp();
                    if send.send(kept).is_ok() {
                        report(Recalled::Continued(spp));
                    }
                }
                Err(error) => report(Recalled::Unreadable(error.to_string())),
            }
        };
        spawn("recall", look)?;
        let traced = Self {
            digests: Some(digests),
            ..traced
        };
        Ok((traced, recalled))
    }

    /// Keeps the trace, on another thread, for the next run, in which the text of `now` is likely to
    /// be opened; `now` is the present scene with its origin, unless the text has errors. Stops at
    /// the deadline.
    pub(super) fn keep(
        self,
        renderer: Renderer,
        now: Option<(Arc<Scene>, Origin)>,
        deadline: Instant,
    ) -> Keeping {
        let (tell, end) = mpsc::channel();
        let work = move || {
            let kept = renderer
                .into_checkpoint()
                .filter(|kept| LEAST <= kept.time());
            let end = kept.map_or(TraceEnd::Nothing, |kept| {
                let traces = Traces::of_user().map_err(|error| error.to_string());
                let stored = traces.and_then(|traces| self.store(&traces, &kept, now, deadline));
                stored.unwrap_or_else(TraceEnd::Lost)
            });
            // Fails only if the program has stopped waiting.
            let _ = tell.send(end);
        };
        // Without a thread the trace is lost.
        let _ = spawn("keep", work);
        Keeping { end, deadline }
    }

    fn store(
        self,
        traces: &Traces,
        kept: &Checkpoint,
        now: Option<(Arc<Scene>, Origin)>,
        deadline: Instant,
    ) -> Result<TraceEnd, String> {
        let goal = self.goal;
        let picture = self.provenance(now, deadline)?;
        let written = traces.write(&picture, kept, deadline);
        written.map_err(|error| error.to_string())?;
        Ok(TraceEnd::Kept {
            spp: kept.spp(),
            goal,
        })
    }

    /// What the picture is made from, or the reason why that is unknown.
    fn provenance(
        self,
        now: Option<(Arc<Scene>, Origin)>,
        deadline: Instant,
    ) -> Result<Provenance, String> {
        let patience = deadline.saturating_duration_since(Instant::now());
        let digests = self.digests;
        let digests = digests.and_then(|digests| digests.recv_timeout(patience).ok());
        let is_traced = |scene: &Arc<Scene>| Arc::as_ptr(scene) == self.scene.as_ptr();
        let now = now.filter(|(scene, _)| is_traced(scene));
        let scene = match (now, digests) {
            (Some((_, origin)), Some(digests)) => digests.files.fingerprint(&origin.text),
            (Some((_, origin)), None) => {
                let files = FileDigests::of(&origin.found);
                let files = files.map_err(|error| error.to_string())?;
                files.fingerprint(&origin.text)
            }
            (None, Some(digests)) => digests.scene,
            (None, None) => return Err("the text has errors".to_owned()),
        };
        Ok(Provenance {
            scene,
            ..self.picture
        })
    }
}

/// A trace that is being kept.
pub(super) struct Keeping {
    end: Receiver<TraceEnd>,
    deadline: Instant,
}

impl Keeping {
    /// Waits until the trace is kept, at most until the deadline.
    pub(super) fn finish(self) -> TraceEnd {
        let patience = self.deadline.saturating_duration_since(Instant::now());
        let lost = |reason: &str| TraceEnd::Lost(reason.to_owned());
        match self.end.recv_timeout(patience) {
            Ok(end) => end,
            Err(RecvTimeoutError::Timeout) => lost("writing it takes too long"),
            Err(RecvTimeoutError::Disconnected) => lost("the thread that keeps it has ended"),
        }
    }
}

#[cfg(test)]
pub(super) mod tests;
