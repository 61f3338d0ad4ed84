//! The work of the thread that exports a sequence: traces the frames of a track one after the other, and
//! writes them.

use std::convert::Infallible;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, TryRecvError};
use std::time::Duration;

use super::destination::{
    NotWritten, Refused, check_spared, check_target, check_target_of, numbered,
};
use crate::msg::{Destination, Existing, ExportId, Exported, Msg};
use crate::reel::{Reel, ReelForm, ReelProgress, Shot};
use assets::{Assets, Edited};
use image_file::{DEFAULT_RATE, ImageFormat, MovieFormat, MovieWriter, Pattern, Picture};
use language::{Lowered, Source};
use render::{Frame, Frames, Job, Provenance, Renderer, Settings, Threads};
use scene::{Camera, Images, Scene};
use text::Findings;
use track::Bound;

/// How long a cancelled export may go on.
const PATIENCE: Duration = Duration::from_millis(50);

/// Nothing is ever sent: the export is cancelled once the sender is gone.
pub(crate) type Cancelled = Receiver<Infallible>;

/// Exports a sequence; returns the outcome, or nothing if it was cancelled. Files of the scene may be
/// read from `folders` too. Progress goes to `send`.
pub(crate) fn film(
    (id, reel): (ExportId, Reel),
    to: Destination,
    (folders, threads): (&[PathBuf], usize),
    cancelled: &Cancelled,
    send: impl Fn(Msg),
) -> Option<Msg> {
    let (wake, woken) = mpsc::channel();
    let renderer = Renderer::new(Threads::Background(threads), move || {
        // This fails only while the renderer is being dropped.
        let _ = wake.send(());
    });
    let camera = Filming {
        id,
        to: numbered(to),
        renderer,
        woken,
        cancelled,
        send,
    };
    match camera.run(&reel, folders) {
        Ok(exported) => Some(Msg::Exported(id, Ok(exported))),
        Err(Unfinished::Cancelled) => None,
        Err(Unfinished::Refused(refused)) => Some(refused.report(id)),
    }
}

/// Why a sequence was not exported.
enum Unfinished {
    Cancelled,
    Refused(Refused),
}

impl From<String> for Unfinished {
    fn from(reason: String) -> Self {
        Self::Refused(reason.into())
    }
}

impl From<Refused> for Unfinished {
    fn from(refused: Refused) -> Self {
        Self::Refused(refused)
    }
}

/// An export of a sequence under way.
struct Filming<'c, S> {
    id: ExportId,
    to: Destination,
    renderer: Renderer,
    /// Told of new frames of the renderer.
    woken: Receiver<()>,
    cancelled: &'c Cancelled,
    send: S,
}

/// The frames of a track over a text.
struct Takes<'r> {
    shot: &'r Shot,
    /// The number of frames.
    count: u32,
    track: Bound,
    text: Edited,
}

/// A frame, ready to trace.
struct Take {
    job: Job,
    /// The digest of its scene.
    scene: String,
    /// The files that its scene names.
    files: Vec<PathBuf>,
}

impl<S: Fn(Msg)> Filming<'_, S> {
    fn run(mut self, reel: &Reel, folders: &[PathBuf]) -> Result<Exported, Unfinished> {
        match &reel.form {
            ReelForm::Movie(format) => {
                check_target(&self.to)?;
                let takes = Takes::new(reel, folders)?;
                self.movie(takes, *format, reel.track.rate.unwrap_or(DEFAULT_RATE))
            }
            ReelForm::Pictures(pattern, format) => {
                for number in 0..reel.track.frames {
                    self.check_cancelled()?;
                    check_target_of(&self.to.path, &self.frame_of(reel, pattern, number))?;
                }
                let takes = Takes::new(reel, folders)?;
                self.pictures(reel, takes, (pattern, *format))
            }
        }
    }

    /// Writes all frames to one file.
    fn movie(
        &mut self,
        mut takes: Takes<'_>,
        format: MovieFormat,
        rate: u32,
    ) -> Result<Exported, Unfinished> {
        let to = self.to.clone();
        let count = takes.count;
        let mut unfinished = None;
        let written = deliver(&to, &to.path, &mut |out| {
            let mut next = |number| {
                let traced = takes.take(number, Frames::Last).and_then(|take| {
                    check_spared(&to, &take.files)?;
                    self.trace(number, count, take.job)
                });
                traced.map_err(|reason| {
                    unfinished = Some(reason);
                    io::Error::other("a frame is missing")
                })
            };
            let first = next(0)?;
            let mut movie = MovieWriter::new(format, first.size, rate, out)?;
            movie.add(&first)?;
            for number in 1..count {
                let frame = next(number)?;
                movie.add(&frame)?;
            }
            movie.finish()
        });
        unfinished.map_or(written, Err)
    }

    /// Writes a picture file for each frame. Those that are finished stay, whatever happens.
    fn pictures(
        &mut self,
        reel: &Reel,
        mut takes: Takes<'_>,
        (pattern, format): (&Pattern, ImageFormat),
    ) -> Result<Exported, Unfinished> {
        for number in 0..takes.count {
            let take = takes.take(number, format.frames())?;
            let to = self.frame_of(reel, pattern, number);
            check_spared(&to, &take.files)?;
            let provenance = Provenance::of(&take.job, take.scene);
            let frame = self.trace(number, takes.count, take.job)?;
            let provenance = provenance.in_frame(&frame);
            let picture = Picture {
                provenance: Some(&provenance),
                ..Picture::of(&frame)
            };
            let written = deliver(&to, &self.to.path, &mut |out| format.write(picture, out))?;
            (self.send)(Msg::FrameExported(written));
        }
        Ok(Exported {
            path: self.to.path.clone(),
            version: None,
        })
    }

    /// Where a frame goes that has a file of its own.
    fn frame_of(&self, reel: &Reel, pattern: &Pattern, number: u32) -> Destination {
        let path = pattern.path(number);
        let own = reel.written.get(&path).copied().map(Existing::Own);
        Destination {
            existing: match self.to.existing {
                Existing::Overwritten => Existing::Overwritten,
                _ => own.unwrap_or(Existing::Kept),
            },
            path,
            ..self.to.clone()
        }
    }

    fn check_cancelled(&self) -> Result<(), Unfinished> {
        match self.cancelled.try_recv() {
            Err(TryRecvError::Disconnected) => Err(Unfinished::Cancelled),
            _ => Ok(()),
        }
    }

    /// Traces a frame, and reports how far it is.
    fn trace(&mut self, frame: u32, count: u32, job: Job) -> Result<Arc<Frame>, Unfinished> {
        let started = self.renderer.restart(job);
        started.map_err(|refusal| format!("frame {frame}: {refusal}"))?;
        let mut told = None;
        loop {
            self.check_cancelled()?;
            match self.woken.recv_timeout(PATIENCE) {
                Ok(()) => {}
                Err(RecvTimeoutError::Timeout) => continue,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(format!("frame {frame}: the renderer stopped early").into());
                }
            }
            let Some(latest) = self.renderer.latest() else {
                continue;
            };
            let progress = ReelProgress {
                frame,
                count,
                traced: latest.progress,
            };
            // More often than the percentage changes, nothing is seen of it.
            let percent = (100.0 * progress.done()) as u32;
            if told.replace(percent) != Some(percent) {
                (self.send)(Msg::Filmed(self.id, progress));
            }
            if latest.progress.complete {
                return Ok(latest);
            }
        }
    }
}

impl<'r> Takes<'r> {
    fn new(reel: &'r Reel, folders: &[PathBuf]) -> Result<Self, String> {
        let name = reel.scene.display();
        let no_memory = |reason| format!("{name}: {reason}");
        language::fits(reel.language, &reel.text, 0).map_err(no_memory)?;
        let mut source = Source::new(reel.language, Arc::clone(&reel.text));
        let lowered = Assets::new(folders).lower(&reel.scene, &mut source);
        let (lowered, read) = lowered.map_err(no_memory)?;
        let Lowered { scene, diagnostics } = lowered;
        let scene = scene.ok_or_else(|| fault(source.text(), &diagnostics))?;
        let (track, findings) = track::bind(&reel.track, &source, &scene.camera);
        if 0 < findings.errors() {
            return Err("the track does not fit the scene".to_owned());
        }
        let place = (&*reel.scene, folders);
        let text = Edited::new(place, source, (scene, diagnostics), read);
        Ok(Self {
            shot: &reel.shot,
            count: reel.track.frames,
            track,
            text: text.map_err(|error| error.to_string())?,
        })
    }

    /// A frame, ready to trace.
    fn take(&mut self, number: u32, frames: Frames) -> Result<Take, Unfinished> {
        let wrong = |reason: String| format!("frame {number}: {reason}");
        let edits = self.track.edits(self.text.plain(), number);
        let lowered = self.text.lower(&edits);
        let lowered = lowered.map_err(|error| wrong(error.to_string()))?;
        let Lowered { scene, diagnostics } = lowered;
        let broken = || wrong(fault(self.text.text(), &diagnostics));
        let scene = scene.ok_or_else(broken)?;
        let read = self.text.read();
        if !read.is_whole() {
            return Err(wrong("a sequence needs every file of its scene".to_owned()).into());
        }
        Ok(Take {
            job: self.shot.job(scene, read.images.clone(), frames),
            scene: self.text.fingerprint(),
            files: read.files.clone(),
        })
    }
}

impl Shot {
    fn job(&self, scene: Scene, images: Images, frames: Frames) -> Job {
        let asked = self.rendering.or(scene.setting.rendering);
        let size = self.size.unwrap_or(scene.camera.size);
        let spp = self.spp.unwrap_or_else(|| asked.spp());
        let camera = self.view.unwrap_or(scene.camera);
        Job {
            images,
            camera: Camera { size, ..camera },
            scene: Arc::new(scene),
            settings: Settings {
                spp: self.aov.map_or(spp, |aov| aov.samples(spp)),
                aov: self.aov,
                ..Settings::new(size, &asked)
            },
            limit: None,
            frames,
            denoise: false,
            numbers: None,
        }
    }
}

/// Writes one file of an export whose pattern is `named`.
fn deliver(
    to: &Destination,
    named: &Path,
    write: &mut file::Content<'_>,
) -> Result<Exported, Unfinished> {
    let confirm = || check_target_of(named, to).map_err(NotWritten::Refused);
    match file::deliver(&to.path, write, &confirm) {
        Ok(version) => Ok(Exported {
            path: to.path.clone(),
            version,
        }),
        Err(NotWritten::Refused(refused)) => Err(refused.into()),
        Err(NotWritten::Failed(error)) => Err(format!("{}: {error}", to.path.display()).into()),
    }
}

fn fault(text: &str, findings: &Findings) -> String {
    format!("its scene has {}", findings.errors_in(text))
}
