//! Performs effects: owns the terminal, the renderers, the timers, and the handles of the threads
//! that read, write, watch and store files. Nothing here waits for a file.

mod others;

use std::any::Any;
use std::collections::BTreeMap;
use std::convert::Infallible;
use std::io;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::{Duration, Instant};

use super::continuing::{Keeping, TraceEnd, Traced};
use super::editor;
use super::ending::ShutdownDeadlines;
use super::screen::Screen;
use super::tty_session::TtySession;
use crate::event::{Event, Work, sending};
use crate::history_scene::{HistoryText, NoPicture};
use crate::located::Search;
use crate::msg::{
    Destination, Effect, ExportId, Msg, Origin, Question, SaveOutcome, Target, Timer,
};
use crate::options::Options;
use crate::queue::{Ended, Service};
use crate::recovery::{self, Edits, End, Keeper, Outcome, Request};
use crate::reel::Reel;
use crate::reference::{Pair, ReferenceId, ReferenceSource};
use crate::service::remembering::{self, Request as Remember};
use crate::service::scene_loader::SceneLoader;
use crate::service::writing::Writers;
use crate::service::{self, Answering};
use assets::Wanted;
use others::{reaches_others, without_others};
use render::{Checkpoint, Frame, Job, Refusal, Renderer, Threads};
use scene::Scene;
use shards::Traces;

/// Time in which the socket that editors connect to is removed; one that is left is replaced by the next run.
const SOCKET_TIME: Duration = Duration::from_millis(50);

/// Time for which memory freed by pictures is kept for the next ones.
const TRIM_TIME: Duration = Duration::from_secs(30);

/// State that outlives a step: the terminal, the renderers, the timers, and the threads that read
/// and watch scenes and assets, write scenes and pictures, and store unsaved edits.
pub(crate) struct Runtime {
    // First, because fields are dropped in order: the terminal is restored before renderers and the
    // watcher end, which may take a moment.
    screen: Screen,
    sender: Sender<Event>,
    reader: SceneLoader,
    /// Frees unneeded values: for a large scene this takes longer than a key may wait.
    freeing: Service<Arc<dyn Any + Send + Sync>>,
    writers: Writers,
    keeper: Keeper,
    recent: Service<Remember>,
    assets: Answering<Wanted>,
    tracks: Answering<PathBuf>,
    references: Answering<(ReferenceId, ReferenceSource)>,
    figures: Answering<Pair>,
    explanations: Answering<(Question, Arc<Frame>)>,
    whereabouts: Answering<Box<Search>>,
    history_scenes: Answering<HistoryText>,
    threads: Option<usize>,
    /// The command line of the editor that is configured.
    editor: Option<String>,
    /// A renderer for each picture that is traced.
    renderers: BTreeMap<Target, Numbered>,
    /// Number of renderers started so far.
    started: u64,
    /// What the full-size trace is made from.
    traced: Option<Traced>,
    /// Dropping it cancels the sequence that is exported.
    filming: Option<Sender<Infallible>>,
    /// The folders that files of scenes may be read from besides those around the scene.
    folders: Vec<PathBuf>,
    timers: Vec<(Instant, Timer)>,
    /// When memory freed by pictures is returned to the system.
    trim_at: Option<Instant>,
    ended: bool,
}

impl Runtime {
    /// Takes over the terminal and starts everything that sends messages.
    pub(crate) fn new(
        options: &Options,
        reader: SceneLoader,
        sender: Sender<Event>,
    ) -> io::Result<Self> {
        Ok(Self {
            screen: Screen::new(options, &sender)?,
            reader,
            freeing: Service::start("freeing", "frees memory", |inbox| {
                inbox.iter().for_each(drop);
            })?,
            writers: Writers::new(sender.clone()),
            keeper: Keeper::start(keeping(&sender))?,
            recent: remembering::start(sending(&sender))?,
            assets: service::assets(&options.assets, options.watching(), sending(&sender))?,
            tracks: service::tracks(options.watching(), sending(&sender))?,
            references: service::references(&options.assets, options.up, sending(&sender))?,
            figures: service::figures(sending(&sender))?,
            history_scenes: service::history_scenes(&options.assets, sending(&sender))?,
            explanations: service::explanations(sending(&sender))?,
            whereabouts: service::whereabouts(sending(&sender))?,
            threads: options.threads,
            editor: options.editor.clone(),
            renderers: BTreeMap::new(),
            started: 0,
            traced: None,
            filming: None,
            folders: options.assets.clone(),
            timers: Vec::new(),
            trim_at: None,
            ended: false,
            sender,
        })
    }

    /// The screen to draw on.
    pub(crate) fn screen(&mut self) -> &mut Screen {
        &mut self.screen
    }

    /// Whether the program should end.
    pub(crate) fn is_over(&self) -> bool {
        self.ended
    }

    /// Converts an event to a message; `None` if its frame was already taken.
    pub(crate) fn message(&mut self, event: Event) -> Option<Msg> {
        match event {
            Event::Msg(msg) => Some(msg),
            Event::Ready(target) => {
                self.trim_at
                    .get_or_insert_with(|| Instant::now() + TRIM_TIME);
                let mut frame = self.renderers.get(&target)?.renderer.latest()?;
                if !self.screen.is_terminal() {
                    // A page shows the same on every machine.
                    Arc::make_mut(&mut frame).progress.elapsed = Duration::ZERO;
                }
                Some(Msg::Frame(target, frame))
            }
            Event::Ended(target, number) => {
                // A renderer that was stopped or replaced has ended as expected.
                let ended = self.renderers.get(&target)?.number == number;
                ended.then_some(Msg::Ended(target))
            }
            // The session has handled the others, or they only wake it.
            _ => None,
        }
    }

    /// Restores the terminal and waits for files being written, each within its time limit; returns
    /// the state of unsaved edits, and that of the full-size trace. `now` is the present scene with
    /// its origin, unless the text has errors.
    pub(crate) fn close(
        mut self,
        deadlines: ShutdownDeadlines,
        now: Option<(Arc<Scene>, Origin)>,
    ) -> (End, TraceEnd) {
        let begun = Instant::now();
        let files = begun + deadlines.files;
        let is_kept = self.screen.is_terminal();
        let traced = self.traced.filter(|_| is_kept);
        let keeping = traced.zip(self.renderers.remove(&Target::Trace));
        let keeping = keeping
            .map(|(traced, running)| traced.keep(running.renderer, now, begun + deadlines.trace));
        self.screen.close(begun + deadlines.terminal);
        drop(self.filming);
        let end = self.keeper.finish(files);
        self.writers.finish(files);
        self.recent.finish(files);
        self.reader.finish(Instant::now() + SOCKET_TIME);
        (end, keeping.map_or(TraceEnd::Nothing, Keeping::finish))
    }

    /// When the next timer is due.
    pub(crate) fn next_timer(&self) -> Option<Instant> {
        let timers = self.timers.iter().map(|&(at, _)| at);
        timers.chain(self.trim_at).min()
    }

    /// Removes the earliest timer that `of` accepts, whether or not it is due. Returns its message.
    pub(crate) fn next_elapsed(&mut self, of: impl Fn(Timer) -> bool) -> Option<Msg> {
        let first = self.timers.iter().enumerate();
        let first = first.filter(|&(_, &(_, timer))| of(timer));
        let (first, _) = first.min_by_key(|&(_, &(at, _))| at)?;
        Some(Msg::Elapsed(self.timers.remove(first).1))
    }

    /// Takes the timers that are due, as messages.
    pub(crate) fn due(&mut self, now: Instant) -> Vec<Msg> {
        if self.trim_at.take_if(|at| *at <= now).is_some() {
            memory::malloc::trim();
        }
        let due = self.timers.extract_if(.., |&mut (at, _)| at <= now);
        due.map(|(_, timer)| Msg::Elapsed(timer)).collect()
    }

    /// Performs an effect and returns its immediate result, if any.
    pub(crate) fn perform(&mut self, effect: Effect) -> Option<Msg> {
        let performed = self.try_perform(effect);
        performed.unwrap_or_else(|failure| Some(Msg::Failed(failure.to_string())))
    }

    fn try_perform(&mut self, effect: Effect) -> Result<Option<Msg>, Failure> {
        if !self.screen.is_terminal() && reaches_others(&effect) {
            return Ok(without_others(&effect));
        }
        match effect {
            Effect::Trace(target, job) => {
                if target == Target::Trace {
                    self.traced = Some(Traced::of(&job));
                }
                return Ok(Some(self.trace(target, job, None)));
            }
            Effect::Recall(job, origin, beside) => {
                return Ok(Some(self.trace_on(job, origin, beside)));
            }
            Effect::Stop(target) => self.stop(target),
            Effect::Explain(question, frame) => {
                self.explanations.ask((question, frame), self.work())?;
            }
            Effect::Locate(search) => self.whereabouts.ask(search, self.work())?,
            Effect::Read(path, baseline) => self.reader.read(path, baseline, self.work())?,
            Effect::Open(path, language) => self.reader.open(path, language, self.work())?,
            Effect::ReadAssets(wanted) => self.assets.ask(wanted, self.work())?,
            Effect::ReadReference(id, source) => self.references.ask((id, source), self.work())?,
            Effect::Compare(pair) => self.figures.ask(pair, self.work())?,
            Effect::ReadTrack(path) => self.tracks.ask(path, self.work())?,
            Effect::Halt(target) => self.with_renderer(target, Renderer::stop),
            Effect::Pause(target) => self.with_renderer(target, Renderer::pause),
            Effect::Resume(target) => self.with_renderer(target, Renderer::resume),
            Effect::Derive(past) => return Ok(self.derive(*past)),
            Effect::WriteImage(id, frame, to) => {
                return Ok(not_exported(id, self.writers.export(id, frame, to)));
            }
            Effect::Film(id, reel, to) => return Ok(not_exported(id, self.film((id, *reel), to))),
            Effect::CheckTarget(id, to) => self.writers.check(id, to)?,
            Effect::CheckPlace(path) => self.writers.check_place(path)?,
            Effect::ListFolder(folder) => self.writers.list_folder(folder)?,
            Effect::FindBackups(scene) => self.writers.find_backups(scene)?,
            Effect::Free(unneeded) => self.freeing.request(unneeded)?,
            Effect::Save {
                id,
                path,
                text,
                guard,
            } => {
                let refused = not_saved(self.writers.save(id, path, text, guard));
                return Ok(refused.map(|outcome| Msg::Saved(id, outcome)));
            }
            Effect::NoteRecent(scene) => self.recent.request(Remember::Note(scene))?,
            Effect::ListRecent => self.recent.request(Remember::List)?,
            Effect::KeepLesson(place) => self.recent.request(Remember::Lesson(place))?,
            Effect::KeepPanels(sizes) => self.recent.request(Remember::Panels(sizes))?,
            Effect::Watch(path) => self.reader.watch(path)?,
            Effect::Tell(message) => self.reader.tell(message)?,
            Effect::ForgetBuffer => self.reader.forget_buffer()?,
            Effect::FollowBuffers(follow) => self.reader.follow_buffers(follow)?,
            Effect::WriteTrack { path, text, guard } => {
                let refused = not_saved(self.writers.write_track(path, text, guard));
                return Ok(refused.map(Msg::TrackWritten));
            }
            Effect::Later(time, timer) => {
                self.timers.retain(|&(_, set)| set != timer);
                self.timers.push((Instant::now() + time, timer));
            }
            Effect::WriteRecovery {
                scene,
                known,
                revision,
            } => {
                let edits = Edits { scene, known };
                self.keeper.request(Request::Keep(revision, edits))?;
            }
            Effect::DropRecovery => self.keeper.request(Request::Forget)?,
            Effect::LookForKept(sought) => {
                let send = sending(&self.sender);
                let looking = recovery::look_for(sought, move |found| send(Msg::Recovered(found)));
                looking.map_err(Failure::Recovery)?;
            }
            Effect::AdoptKept(claim) => self.keeper.request(Request::Adopt(claim))?,
            Effect::DropKept(claim) => self.keeper.request(Request::Discard(claim))?,
            Effect::OpenEditor { path, line } => {
                let outcome = self.open_editor(&path, line);
                let outcome = outcome.map_err(|failure| failure.to_string());
                return Ok(Some(Msg::EditorClosed(outcome)));
            }
            Effect::CopyText(text) => self.on_tty(|tty| tty.terminal.copy(&text))?,
            Effect::SetMouse(mouse) => self.on_tty(|tty| tty.terminal.set_mouse(mouse))?,
            Effect::Repaint => self.on_tty(|tty| {
                tty.terminal.repaint();
                Ok(())
            })?,
            Effect::TakeTerminal => self.on_tty(TtySession::take)?,
            Effect::Suspend => {
                let suspended = self.screen.lendable().and_then(TtySession::suspend);
                suspended.map_err(Failure::Terminal)?;
            }
            Effect::Quit => self.ended = true,
        }
        Ok(None)
    }

    /// Asks for the scene of a step of the history; returns the answer if it cannot be.
    fn derive(&self, past: HistoryText) -> Option<Msg> {
        let ticket = past.ticket;
        let begun = self.history_scenes.ask(past, self.work());
        let refused = |ended: Ended| Err(NoPicture::Failed(ended.to_string()));
        begun
            .err()
            .map(|ended| Msg::Derived(ticket, refused(ended)))
    }

    /// Counts a request as work until its answer is in the inbox.
    fn work(&self) -> Work {
        Work::begin(&self.sender)
    }

    /// Starts the full-size trace from what an earlier run left of it, or a render of this picture.
    fn trace_on(&mut self, job: Job, origin: Origin, beside: PathBuf) -> Msg {
        let send = sending(&self.sender);
        let report = move |recalled| send(Msg::Recalled(recalled));
        let kept = (Traces::of_user().ok(), beside);
        let is_terminal = self.screen.is_terminal();
        let recall = is_terminal.then(|| Traced::recall(&job, origin, kept, report));
        let (traced, recalled) = match recall {
            Some(Ok((traced, recalled))) => (traced, Some(recalled)),
            // Without a thread it is traced anew.
            Some(Err(_)) | None => (Traced::of(&job), None),
        };
        self.traced = Some(traced);
        self.trace(Target::Trace, job, recalled)
    }

    fn trace(&mut self, target: Target, job: Job, recalled: Option<Receiver<Checkpoint>>) -> Msg {
        let threads = match (target, self.threads) {
            (Target::Preview, None) => Threads::Preview,
            (Target::Preview, Some(count)) => Threads::Exactly(count),
            (Target::Thumbnail | Target::Trial, _) => Threads::Background(1),
            (_, count) => Threads::Background(count.unwrap_or_else(cores)),
        };
        let (sender, number) = (&self.sender, &mut self.started);
        let mut start = || {
            *number += 1;
            let waker = Waker {
                sender: sender.clone(),
                target,
                number: *number,
            };
            Numbered {
                number: *number,
                renderer: Renderer::new(threads, move || waker.wake()),
            }
        };
        let running = self.renderers.entry(target).or_insert_with(&mut start);
        let restarted = match recalled {
            Some(recalled) => running.renderer.restart_from(job.clone(), recalled),
            None => running.renderer.restart(job.clone()),
        };
        let started = match restarted {
            // A worker ended by a panic is replaced: the panic costs only one picture.
            Err(Refusal::Ended) => {
                *running = start();
                running.renderer.restart(job)
            }
            started => started,
        };
        if let Err(Refusal::Threads { .. }) = started {
            // The next job tries again.
            self.renderers.remove(&target);
        }
        match started {
            Ok(generation) => Msg::Started(target, generation),
            Err(refusal) => Msg::Refused(target, refusal.to_string()),
        }
    }

    /// Exports a sequence in place of one that is being exported.
    fn film(&mut self, reel: (ExportId, Reel), to: Destination) -> io::Result<()> {
        let (alive, cancelled) = mpsc::channel();
        self.filming = Some(alive);
        let threads = self.threads.unwrap_or_else(cores);
        let folders = self.folders.clone();
        self.writers.film(reel, to, (folders, threads), cancelled)
    }

    fn stop(&mut self, target: Target) {
        if target == Target::Export {
            self.filming = None;
        }
        // The preview stops by itself.
        if target != Target::Preview {
            self.renderers.remove(&target);
        }
    }

    fn with_renderer(&mut self, target: Target, act: impl FnOnce(&mut Renderer)) {
        if let Some(running) = self.renderers.get_mut(&target) {
            act(&mut running.renderer);
        }
    }

    fn open_editor(&mut self, path: &Path, line: usize) -> Result<(), Failure> {
        let configured = self.editor.as_deref();
        let tty = self.screen.lendable();
        let ran = tty.and_then(|tty| tty.lend(|| editor::run(configured, path, line)));
        ran.map_err(Failure::Terminal)?.map_err(Failure::Editor)
    }

    /// Acts on the terminal; does nothing on a page.
    fn on_tty(
        &mut self,
        act: impl FnOnce(&mut TtySession) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let done = self.screen.tty().map_or(Ok(()), act);
        done.map_err(Failure::Terminal)
    }
}

fn cores() -> usize {
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// Reason why an effect cannot be performed.
#[derive(Debug, thiserror::Error)]
enum Failure {
    #[error(transparent)]
    Ended(#[from] Ended),
    /// A thread cannot be started.
    #[error(transparent)]
    Thread(#[from] io::Error),
    #[error("cannot look for unsaved edits of earlier runs: {0}")]
    Recovery(io::Error),
    #[error("terminal: {0}")]
    Terminal(io::Error),
    #[error("{0}")]
    Editor(String),
}

/// A renderer and its serial number.
struct Numbered {
    number: u64,
    renderer: Renderer,
}

/// Announces new frames of a renderer; dropping it announces that the worker has ended.
struct Waker {
    sender: Sender<Event>,
    target: Target,
    number: u64,
}

impl Waker {
    fn wake(&self) {
        let _ = self.sender.send(Event::Ready(self.target));
    }
}

impl Drop for Waker {
    fn drop(&mut self) {
        let _ = self.sender.send(Event::Ended(self.target, self.number));
    }
}

/// What becomes of a save that could not be started.
fn not_saved(started: io::Result<()>) -> Option<SaveOutcome> {
    let error = started.err()?;
    Some(SaveOutcome::Failed(error.to_string()))
}

/// What becomes of an export that could not be started.
fn not_exported(id: ExportId, started: io::Result<()>) -> Option<Msg> {
    let error = started.err()?;
    Some(Msg::Exported(id, Err(error.to_string())))
}

/// Announces the results of storing unsaved edits.
fn keeping(sender: &Sender<Event>) -> impl Fn(Outcome) + Send + 'static {
    let send = sending(sender);
    move |outcome| {
        send(match outcome {
            Outcome::Kept(revision, outcome) => Msg::Kept(revision, outcome),
            Outcome::Failed(reason) => Msg::Failed(reason),
        });
    }
}

#[cfg(test)]
mod tests;
