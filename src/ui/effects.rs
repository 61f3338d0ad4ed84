//! Performs effects: owns the terminal, the renderers, the timers, and the handles of the threads
//! that read, write, watch and store files. Nothing here waits for a file.

use std::any::Any;
use std::io;
use std::num::NonZero;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::thread;
use std::time::{Duration, Instant};

use super::assets::AssetReader;
use super::editor;
use super::event::{Event, sending};
use super::heap;
use super::msg::{Effect, Msg, SaveOutcome, Target, Timer};
use super::options::Options;
use super::reader::Reader;
use super::recent::Recent;
use super::recovery::{self, Edits, End, Keeper, Outcome, Request};
use super::service::{Ended, Service};
use super::terminal::tmux;
use super::terminal::{self, Input, Replies, Reply, Terminal};
#[cfg(unix)]
use super::terminal::{Signals, suspend_process};
use super::writing::Writers;
use crate::render::{Job, Refusal, Renderer, Threads};

/// Maximum time to wait for replies of the terminal before handing it over; longer than nearly all
/// round trips.
const REPLY_PATIENCE: Duration = Duration::from_secs(1);

/// Time for which memory freed by pictures is kept for the next ones.
const TRIM_TIME: Duration = Duration::from_secs(30);

/// State that outlives a step: the terminal, the renderers, the timers, and the threads that read
/// and watch scenes and assets, write scenes and pictures, and store unsaved edits.
pub(crate) struct Runtime {
    // First, because fields are dropped in order: the terminal is restored before renderers and the
    // watcher end, which may take a moment.
    terminal: Terminal,
    /// Replies still expected from the terminal.
    replies: Arc<Replies>,
    input: Input,
    #[cfg(unix)]
    signals: Signals,
    sender: Sender<Event>,
    reader: Reader,
    /// Frees unneeded values: for a large scene this takes longer than a key may wait.
    freeing: Service<Arc<dyn Any + Send + Sync>>,
    writers: Writers,
    keeper: Keeper,
    recent: Recent,
    assets: AssetReader,
    threads: Option<usize>,
    preview: Option<Numbered>,
    trace: Option<Numbered>,
    export: Option<Numbered>,
    /// Number of renderers started so far.
    renderers: u64,
    timers: Vec<(Instant, Timer)>,
    /// When memory freed by pictures is returned to the system.
    trim_at: Option<Instant>,
    ended: bool,
}

impl Runtime {
    /// Takes over the terminal and starts everything that sends messages.
    pub(crate) fn new(
        options: &Options,
        reader: Reader,
        sender: Sender<Event>,
    ) -> io::Result<Self> {
        let replies = Arc::new(Replies::default());
        let sink = |sender: &Sender<Event>| {
            let (sender, replies) = (sender.clone(), Arc::clone(&replies));
            move |event| {
                if let terminal::Event::Reply(reply) = event {
                    replies.came(reply);
                }
                // The inbox is gone only when the program ends.
                let _ = sender.send(Event::from(event));
            }
        };
        // Before the terminal is changed: until then the default actions of signals do no harm.
        #[cfg(unix)]
        let signals = Signals::start(sink(&sender))?;
        let terminal = {
            let sender = sender.clone();
            let cleared = move || {
                let _ = sender.send(Event::Cleared);
            };
            Terminal::enter(options.colours(), options.mouse, cleared)?
        };
        Ok(Self {
            terminal,
            replies: Arc::clone(&replies),
            input: Input::start(sink(&sender))?,
            #[cfg(unix)]
            signals,
            reader,
            freeing: Service::start("freeing", "frees memory", |inbox| {
                inbox.iter().for_each(drop);
            })?,
            writers: Writers::new(sender.clone()),
            keeper: Keeper::start(keeping(&sender))?,
            recent: remembering(&sender)?,
            assets: AssetReader::start(&options.assets, options.watching(), sending(&sender))?,
            threads: options.threads,
            preview: None,
            trace: None,
            export: None,
            renderers: 0,
            timers: Vec::new(),
            trim_at: None,
            ended: false,
            sender,
        })
    }

    /// The terminal to draw on.
    pub(crate) fn terminal(&mut self) -> &mut Terminal {
        &mut self.terminal
    }

    /// Whether the terminal is not lent to another program.
    pub(crate) fn has_terminal(&self) -> bool {
        self.terminal.is_ours()
    }

    /// Queries the colours of the terminal and, through tmux, of the terminal behind it. Any
    /// answers arrive as [`Event::Replied`].
    pub(crate) fn ask_for_colours(&self) -> io::Result<()> {
        self.replies.expect(Reply::Attributes);
        self.terminal.ask_for_colours()?;
        let sender = self.sender.clone();
        // Without a thread there is no answer.
        let _ = thread::Builder::new()
            .name("colours".to_owned())
            .spawn(move || {
                if tmux::shows_true_colour() == Some(true) {
                    let _ = sender.send(Event::Replied(Reply::TrueColour, Instant::now()));
                }
            });
        Ok(())
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
                let frame = self.numbered(target)?.renderer.latest()?;
                Some(Msg::Frame(target, frame))
            }
            Event::Ended(target, number) => {
                // A renderer that was stopped or replaced has ended as expected.
                let ended = self.numbered(target)?.number == number;
                ended.then_some(Msg::Ended(target))
            }
            Event::Cleared | Event::Replied(..) => None,
        }
    }

    /// Restores the terminal and waits for files being written, each within its time limit; returns
    /// the state of unsaved edits.
    pub(crate) fn close(self, terminal: Duration, files: Duration) -> End {
        let begun = Instant::now();
        self.await_replies(begun + terminal);
        self.terminal.close(begun + terminal);
        let end = self.keeper.finish(begun + files);
        self.writers.finish(begun + files);
        self.recent.finish(begun + files);
        end
    }

    /// Requests a status reply, which arrives after everything sent so far.
    pub(crate) fn ask_status(&self) -> io::Result<()> {
        self.replies.expect(Reply::Status);
        self.terminal.ask_status()
    }

    /// Stops expecting an answer about colours.
    pub(crate) fn give_up_colours(&self) {
        self.replies.came(Reply::Attributes);
    }

    /// Stops expecting status replies.
    pub(crate) fn give_up_replies(&self) {
        self.replies.forget_statuses();
    }

    /// Waits for replies that the next program on the terminal would take for keys.
    fn await_replies(&self, deadline: Instant) {
        if self.terminal.is_clear() {
            self.replies
                .wait(deadline.min(Instant::now() + REPLY_PATIENCE));
        }
    }

    /// When the next timer is due.
    pub(crate) fn next_timer(&self) -> Option<Instant> {
        let timers = self.timers.iter().map(|&(at, _)| at);
        timers.chain(self.trim_at).min()
    }

    /// Takes the timers that are due, as messages.
    pub(crate) fn due(&mut self, now: Instant) -> Vec<Msg> {
        if self.trim_at.take_if(|at| *at <= now).is_some() {
            heap::trim();
        }
        self.timers
            .extract_if(.., |&mut (at, _)| at <= now)
            .map(|(_, timer)| Msg::Elapsed(timer))
            .collect()
    }

    /// Performs an effect and returns its immediate result, if any.
    pub(crate) fn perform(&mut self, effect: Effect) -> Option<Msg> {
        let performed = self.try_perform(effect);
        performed.unwrap_or_else(|failure| Some(Msg::Failed(failure.to_string())))
    }

    fn try_perform(&mut self, effect: Effect) -> Result<Option<Msg>, Failure> {
        match effect {
            Effect::Trace(target, job) => return Ok(Some(self.trace(target, job))),
            Effect::Stop(target) => self.stop(target),
            Effect::WriteImage(id, frame, to) => {
                let started = self.writers.export(id, frame, to);
                let refused = started.err().map(|error| Err(error.to_string()));
                return Ok(refused.map(|refused| Msg::Exported(id, refused)));
            }
            Effect::CheckTarget(id, to) => self.writers.check(id, to)?,
            Effect::CheckPlace(path) => self.writers.check_place(path)?,
            Effect::ListFolder(folder) => self.writers.list_folder(folder)?,
            Effect::FindBackups(scene) => self.writers.find_backups(scene)?,
            Effect::Read(path, baseline) => self.reader.read(path, baseline)?,
            Effect::Open(path, language) => self.reader.open(path, language)?,
            Effect::Free(unneeded) => self.freeing.request(unneeded)?,
            Effect::Save {
                id,
                path,
                text,
                guard,
            } => {
                let started = self.writers.save(id, path, text, guard);
                let refused = started.err().map(|error| error.to_string());
                return Ok(refused.map(|reason| Msg::Saved(id, SaveOutcome::Failed(reason))));
            }
            Effect::NoteRecent(scene) => self.recent.note(scene)?,
            Effect::ListRecent => self.recent.list()?,
            Effect::Watch(path) => self.reader.watch(path)?,
            Effect::ReadAssets(wanted) => self.assets.request(wanted)?,
            Effect::Later(time, timer) => {
                self.timers.retain(|&(_, set)| set != timer);
                self.timers.push((Instant::now() + time, timer));
            }
            Effect::WriteRecovery {
                scene,
                known,
                revision,
            } => self
                .keeper
                .request(Request::Keep(revision, Edits { scene, known }))?,
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
            Effect::CopyText(text) => {
                let copied = self.terminal.copy(&text);
                copied.map_err(Failure::Terminal)?;
            }
            Effect::SetMouse(mouse) => {
                let set = self.terminal.set_mouse(mouse);
                set.map_err(Failure::Terminal)?;
            }
            Effect::Repaint => self.terminal.repaint(),
            Effect::TakeTerminal => self.take_terminal()?,
            Effect::Suspend => self.suspend()?,
            Effect::Quit => self.ended = true,
        }
        Ok(None)
    }

    fn numbered(&self, target: Target) -> Option<&Numbered> {
        match target {
            Target::Preview => self.preview.as_ref(),
            Target::Trace => self.trace.as_ref(),
            Target::Export => self.export.as_ref(),
        }
    }

    fn trace(&mut self, target: Target, job: Job) -> Msg {
        let cores = || thread::available_parallelism().map_or(1, NonZero::get);
        let threads = match (target, self.threads) {
            (Target::Preview, None) => Threads::Preview,
            (Target::Preview, Some(count)) => Threads::Exactly(count),
            (Target::Trace | Target::Export, count) => {
                Threads::Background(count.unwrap_or_else(cores))
            }
        };
        let (sender, renderers) = (&self.sender, &mut self.renderers);
        let mut start = || {
            *renderers += 1;
            let waker = Waker {
                sender: sender.clone(),
                target,
                number: *renderers,
            };
            Numbered {
                number: *renderers,
                renderer: Renderer::new(threads, move || waker.wake()),
            }
        };
        let slot = match target {
            Target::Preview => &mut self.preview,
            Target::Trace => &mut self.trace,
            Target::Export => &mut self.export,
        };
        let running = slot.get_or_insert_with(&mut start);
        let started = match running.renderer.restart(job.clone()) {
            // A worker ended by a panic is replaced: the panic costs only one picture.
            Err(Refusal::Ended) => slot.insert(start()).renderer.restart(job),
            started => started,
        };
        if let Err(Refusal::Threads { .. }) = started {
            // The next job tries again.
            *slot = None;
        }
        match started {
            Ok(generation) => Msg::Started(target, generation),
            Err(refusal) => Msg::Refused(target, refusal.to_string()),
        }
    }

    fn stop(&mut self, target: Target) {
        match target {
            // It stops by itself.
            Target::Preview => {}
            Target::Trace => self.trace = None,
            Target::Export => self.export = None,
        }
    }

    fn open_editor(&mut self, path: &Path, line: usize) -> Result<(), Failure> {
        self.await_replies(Instant::now() + REPLY_PATIENCE);
        self.input.park();
        #[cfg(unix)]
        self.signals.lend();
        let left = self.terminal.leave().map_err(Failure::Terminal);
        let ran = left.and_then(|()| editor::run(path, line).map_err(Failure::Editor));
        #[cfg(unix)]
        self.signals.take_back();
        self.take_terminal()?;
        ran
    }

    fn take_terminal(&mut self) -> Result<(), Failure> {
        let taken = self.terminal.reenter();
        self.input.resume();
        taken.map_err(Failure::Terminal)
    }

    #[cfg(unix)]
    fn suspend(&mut self) -> Result<(), Failure> {
        self.await_replies(Instant::now() + REPLY_PATIENCE);
        self.input.park();
        let stopped = self.terminal.leave().and_then(|()| suspend_process());
        match stopped {
            // The continue event takes the terminal back, which must not happen twice.
            Ok(true) => Ok(()),
            Ok(false) => self.take_terminal(),
            Err(error) => {
                self.take_terminal()?;
                Err(Failure::Terminal(error))
            }
        }
    }

    #[cfg(not(unix))]
    fn suspend(&mut self) -> Result<(), Failure> {
        Err(Failure::Terminal(io::ErrorKind::Unsupported.into()))
    }
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

/// Remembers scenes, and announces lists of them.
fn remembering(sender: &Sender<Event>) -> io::Result<Recent> {
    let (report, complain) = (sending(sender), sending(sender));
    Recent::start(
        move |scenes| report(Msg::RecentListed(scenes)),
        move |reason| complain(Msg::Failed(reason)),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_worker_that_panics_announces_its_end() {
        let (sender, inbox) = std::sync::mpsc::channel();
        let waker = Waker {
            sender,
            target: Target::Export,
            number: 7,
        };
        let worker = thread::spawn(move || {
            waker.wake();
            panic!("on purpose");
        });
        assert!(worker.join().is_err());
        let events: Vec<_> = inbox.iter().collect();
        assert!(matches!(
            events[..],
            [Event::Ready(_), Event::Ended(Target::Export, 7)]
        ));
    }
}
