//! Work that quitting would interrupt: the export, and saves, which are tracked until their outcome
//! arrives (possibly never). Saves of the same file run one after the other.

use std::collections::{HashMap, VecDeque};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::after_leaving::AfterLeaving;
use crate::msg::{Destination, Effect, Existing, ExportId, Exported, Guard, SaveId, Target, Timer};
use crate::reel::{Reel, ReelForm, ReelProgress};
use file::Version;
use render::{Aov, Frame, Job, Progress};
use scene::Size;
use text::counted;

/// Interval between checks of unfinished writes.
const TICK: Duration = Duration::from_secs(1);

/// The number of checks after which the user is notified.
const PATIENCE: u32 = 2;

/// Saves and exports under way.
#[derive(Debug, Default)]
pub struct Jobs {
    /// The running export; there is at most one.
    running: Option<Pending>,
    /// The exports that wait for it, the next one first.
    pending: VecDeque<Pending>,
    /// The ID of the latest export.
    last_export: ExportId,
    /// The versions of the pictures written so far, by path. They may be overwritten as long as
    /// they are unchanged.
    written: HashMap<PathBuf, Version>,
    /// The saves without an outcome so far.
    saves: Vec<Save>,
    /// The ID of the newest save, running or waiting.
    newest: SaveId,
    /// The ID of the newest save that has ended.
    ended: SaveId,
    /// Whether [`Timer::Writing`] is set.
    ticking: bool,
    /// What follows once everything is done.
    pub(crate) next: Option<AfterLeaving>,
    /// Whether Ctrl-C was pressed a moment ago.
    pub(crate) interrupt: bool,
}

/// A running export.
#[derive(Debug)]
pub struct Export {
    /// Distinguishes its outcome from that of a cancelled export.
    pub id: ExportId,
    /// Whether it is traced or written.
    pub stage: Stage,
    /// The file to write.
    pub destination: Destination,
    /// Size of its picture in pixels.
    pub size: Size,
    /// Samples per pixel of its picture.
    pub spp: u32,
    /// What it shows instead of light.
    pub aov: Option<Aov>,
    /// The number of frames of a sequence.
    pub frames: Option<u32>,
    /// How far a sequence is; `None` before the first frame.
    pub reel: Option<ReelProgress>,
    /// Progress of tracing; `None` before the first frame, and for a sequence.
    pub progress: Option<Progress>,
    /// Seconds since its file began to be written.
    pub written_for: u32,
}

/// An export with what it is made from: while it runs, or waits for others or for an answer.
#[derive(Debug)]
pub struct Pending {
    /// The export; one that waits is as if it were running.
    pub export: Export,
    pub(crate) making: ExportWork,
    pub(crate) asking: Asking,
}

/// How a picture is made.
#[derive(Clone, Debug)]
pub(crate) enum ExportWork {
    /// It is traced first.
    Trace(Box<Job>),
    /// It is already traced.
    Write(Arc<Frame>),
    /// It is a sequence, traced and written on a thread of its own.
    Film(Box<Reel>),
}

/// What an export does about a file that another program has written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Asking {
    /// It asks whether to overwrite the file.
    Yes,
    /// It keeps the file.
    No,
    /// It overwrites the file.
    Forced,
}

impl Asking {
    /// What it does about a file that exists.
    pub(crate) fn existing(self) -> Existing {
        match self {
            Self::Forced => Existing::Overwritten,
            Self::Yes | Self::No => Existing::Kept,
        }
    }
}

/// A stage of an export.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Its picture is being traced.
    Tracing,
    /// Its file is being written, which cannot be stopped.
    Writing,
}

#[derive(Debug)]
struct Save {
    id: SaveId,
    path: PathBuf,
    seconds: u32,
    /// The save of this file that waits for this one.
    next: Option<(SaveId, Arc<String>, Guard)>,
}

/// Information about a save that has ended.
pub(crate) struct Ended {
    /// Whether a later save ended before it.
    pub(crate) is_late: bool,
    /// Whether it is the newest save.
    pub(crate) is_newest: bool,
    save: Option<Save>,
}

impl Ended {
    /// The file that was written; `None` for a save that is not known.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.save.as_ref().map(|save| &*save.path)
    }
}

impl Jobs {
    /// The running export.
    pub fn export(&self) -> Option<&Export> {
        self.running.as_ref().map(|running| &running.export)
    }

    /// The running export, mutable.
    pub(crate) fn export_mut(&mut self) -> Option<&mut Export> {
        self.running.as_mut().map(|running| &mut running.export)
    }

    /// Ends the running export and returns it, if it satisfies the predicate.
    pub(crate) fn end_export(&mut self, is_meant: impl FnOnce(&Export) -> bool) -> Option<Export> {
        let ended = self.running.take_if(|running| is_meant(&running.export));
        ended.map(|ended| ended.export)
    }

    /// The file that has taken longest to write, if it takes long, and the seconds so far.
    pub fn still_writing(&self) -> Option<(&Path, u32)> {
        let saves = self.saves.iter();
        let saves = saves.map(|save| (save.path.as_path(), save.seconds));
        let export = self.export();
        let export = export.map(|export| (export.destination.path.as_path(), export.written_for));
        let all = saves.chain(export);
        let late = all.filter(|&(_, seconds)| PATIENCE <= seconds);
        late.max_by_key(|&(_, seconds)| seconds)
    }

    /// The file of a running save.
    pub(crate) fn file_being_saved(&self) -> Option<&Path> {
        self.saves.first().map(|save| save.path.as_path())
    }

    /// The number of saves so far, running, waiting or ended.
    pub(crate) fn count_saves(&self) -> u32 {
        self.newest.0
    }

    /// Saves a text. If a save of the same file is running, the new one waits for it and no effect
    /// is returned.
    pub(crate) fn save(&mut self, path: &Path, text: Arc<String>, guard: Guard) -> Vec<Effect> {
        self.newest.0 += 1;
        let id = self.newest;
        match self.saves.iter_mut().find(|save| save.path == path) {
            Some(save) => {
                save.next = Some((id, text, guard));
                Vec::new()
            }
            None => self.start_save(id, path.to_owned(), text, guard),
        }
    }

    fn start_save(
        &mut self,
        id: SaveId,
        path: PathBuf,
        text: Arc<String>,
        guard: Guard,
    ) -> Vec<Effect> {
        self.saves.push(Save {
            id,
            path: path.clone(),
            seconds: 0,
            next: None,
        });
        let mut effects = self.count_seconds();
        effects.push(Effect::Save {
            id,
            path,
            text,
            guard,
        });
        effects
    }

    /// Records that a save has ended.
    pub(crate) fn end_save(&mut self, id: SaveId) -> Ended {
        let is_late = id < self.ended;
        self.ended = self.ended.max(id);
        let at = self.saves.iter().position(|save| save.id == id);
        Ended {
            is_late,
            is_newest: id == self.newest,
            save: at.map(|at| self.saves.remove(at)),
        }
    }

    /// Makes all saves so far late: their outcomes no longer concern the scene.
    pub(crate) fn abandon_saves(&mut self) {
        self.newest.0 += 1;
        self.ended = self.newest;
        self.next = None;
    }

    /// Starts the save that waited for this one; `written` is what the file holds now.
    pub(crate) fn go_on(&mut self, ended: Ended, written: Option<Arc<String>>) -> Vec<Effect> {
        let next = ended.save.and_then(|save| Some((save.path, save.next?)));
        let Some((path, (id, text, guard))) = next else {
            return Vec::new();
        };
        let guard = match (guard, written) {
            (Guard::Holding(_) | Guard::Absent, Some(text)) => Guard::Holding(text),
            (guard, _) => guard,
        };
        self.start_save(id, path, text, guard)
    }

    /// Starts counting the seconds that files take to write.
    pub(crate) fn count_seconds(&mut self) -> Vec<Effect> {
        if std::mem::replace(&mut self.ticking, true) {
            return Vec::new();
        }
        vec![Effect::Later(TICK, Timer::Writing)]
    }

    /// Counts a second; returns whether something is still being written.
    pub(crate) fn tick(&mut self) -> bool {
        self.ticking = false;
        for save in &mut self.saves {
            save.seconds += 1;
        }
        let export = self.export_mut();
        let export = export.filter(|export| export.stage == Stage::Writing);
        let is_exporting = export.map(|export| export.written_for += 1).is_some();
        is_exporting || !self.saves.is_empty()
    }

    /// Returns the ID of a new export.
    pub(crate) fn next_export(&mut self) -> ExportId {
        self.last_export.0 += 1;
        self.last_export
    }

    /// The number of exports that wait.
    pub fn queued(&self) -> usize {
        self.pending.len()
    }

    /// Lets an export wait. It replaces a waiting one to the same file.
    pub(crate) fn queue(&mut self, pending: Pending) {
        let path = &pending.export.destination.path;
        self.pending
            .retain(|other| other.export.destination.path != *path);
        self.pending.push_back(pending);
    }

    /// Takes the next export that waits.
    pub(crate) fn next_pending(&mut self) -> Option<Pending> {
        self.pending.pop_front()
    }

    /// Whether the running export asks before it overwrites a file.
    pub(crate) fn is_asking(&self) -> bool {
        let running = self.running.as_ref();
        running.is_some_and(|running| running.asking == Asking::Yes)
    }

    /// Takes the running export back, to start it again later.
    pub(crate) fn take_back(&mut self) -> Option<Pending> {
        self.running.take()
    }

    /// Starts an export.
    pub(crate) fn begin_export(&mut self, mut pending: Pending) -> Vec<Effect> {
        let Pending { export, making, .. } = &mut pending;
        let destination = &mut export.destination;
        if destination.existing == Existing::Kept {
            destination.existing = self.existing(&destination.path);
        }
        let destination = destination.clone();
        let effects = match making {
            ExportWork::Write(frame) => {
                export.stage = Stage::Writing;
                let write = Effect::WriteImage(export.id, Arc::clone(frame), destination);
                [write].into_iter().chain(self.count_seconds()).collect()
            }
            ExportWork::Film(reel) => {
                export.stage = Stage::Tracing;
                let reel = Reel {
                    written: self.written.clone(),
                    ..(**reel).clone()
                };
                vec![Effect::Film(export.id, Box::new(reel), destination)]
            }
            ExportWork::Trace(job) => {
                export.stage = Stage::Tracing;
                vec![
                    Effect::CheckTarget(export.id, destination),
                    Effect::Trace(Target::Export, (**job).clone()),
                ]
            }
        };
        self.running = Some(pending);
        effects
    }

    /// Records that a picture was written.
    pub(crate) fn note_export(&mut self, Exported { path, version }: Exported) {
        match version {
            Some(version) => self.written.insert(path, version),
            None => self.written.remove(&path),
        };
    }

    /// What to do if the file of a picture exists: pictures of this session are overwritten unless
    /// others have changed them.
    pub(crate) fn existing(&self, path: &Path) -> Existing {
        let own = self.written.get(path);
        own.map_or(Existing::Kept, |&version| Existing::Own(version))
    }
}

impl Export {
    /// Stops tracing; writing cannot be stopped.
    pub(crate) fn stop(&self) -> Vec<Effect> {
        match self.stage {
            Stage::Tracing => vec![Effect::Stop(Target::Export)],
            Stage::Writing => Vec::new(),
        }
    }

    /// Whether frames of a sequence have been written to a file each.
    pub(crate) fn has_written_frames(&self) -> bool {
        let is_each = ReelForm::of_path(&self.destination.path)
            .is_ok_and(|form| matches!(form, ReelForm::Pictures(..)));
        is_each && self.reel.is_some_and(|reel| 0 < reel.frame)
    }

    /// The share that is done, 0 to 1.
    pub fn done(&self) -> f64 {
        let reel = self.reel.map(|reel| reel.done());
        let traced = self.progress.map(|progress| progress.done);
        reel.or(traced).unwrap_or(0.0)
    }

    /// Describes what it shows, its size and samples, and the time it took.
    pub(crate) fn summary(&self) -> String {
        let Size { width, height } = self.size;
        let elapsed = self.progress.map(|progress| progress.elapsed);
        let took = elapsed
            .filter(|elapsed| !elapsed.is_zero())
            .map_or_else(String::new, |elapsed| {
                format!(", {:.1} s", elapsed.as_secs_f64())
            });
        let what = self
            .aov
            .map_or_else(String::new, |aov| format!("{}, ", aov.name()));
        let progress = self.progress.filter(Progress::is_adaptive);
        let samples = progress.map_or_else(|| format!("{} spp", self.spp), |done| done.samples());
        let frames = self.frames.map_or_else(String::new, |frames| {
            format!("{}, ", counted(frames as usize, "frame"))
        });
        format!(": {frames}{what}{width}×{height}, {samples}{took}")
    }
}
