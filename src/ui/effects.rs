//! What touches the world: the terminal, the renderers, timers, and the handles of the threads that
//! read, write, watch and keep files. Nothing here waits for a file.

use std::io;
use std::num::NonZero;
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;
use std::thread;
use std::time::{Duration, Instant};

use super::Options;
use super::assets::AssetReader;
use super::editor;
use super::freeing::Freeing;
use super::heap;
use super::msg::{Effect, Msg, SaveOutcome, Target, Timer};
use super::reading::Reader;
use super::recovery::{self, Edits, End, Keeper, Order};
use super::terminal::tmux;
use super::terminal::{self, Input, Replies, Reply, Terminal};
#[cfg(unix)]
use super::terminal::{Signals, suspend_process};
use super::writing::Writers;
use crate::render::{Job, Refusal, Renderer, Threads};

/// How long replies of the terminal are waited for before it is handed over: longer than nearly all
/// round trips.
const REPLY_PATIENCE: Duration = Duration::from_secs(1);

/// How long memory that pictures have left behind is kept for the next ones.
const TRIM_TIME: Duration = Duration::from_secs(30);

/// Something that came in.
#[derive(Debug)]
pub(crate) enum Event {
    /// A message.
    Msg(Msg),
    /// A renderer has a newer frame.
    Ready(Target),
    /// The renderer of this number traces no more.
    Ended(Target, u64),
    /// The terminal has taken all that was drawn.
    Cleared,
    /// The terminal replied, at this moment.
    Replied(Reply, Instant),
}

/// What outlives a step: the terminal, the renderers, the timers, and the threads that work on
/// files: scenes and assets read and watched, scenes and pictures written, unsaved edits kept.
pub(crate) struct World {
    // First, because fields are dropped in order: the terminal is given back before renderers and
    // the watcher end, which may take a moment.
    terminal: Terminal,
    /// Those that the terminal still owes.
    replies: Arc<Replies>,
    input: Input,
    #[cfg(unix)]
    signals: Signals,
    sender: Sender<Event>,
    reader: Reader,
    freeing: Freeing,
    writers: Writers,
    keeper: Keeper,
    assets: AssetReader,
    threads: Option<usize>,
    preview: Option<Numbered>,
    trace: Option<Numbered>,
    export: Option<Numbered>,
    /// How many renderers there were.
    renderers: u64,
    timers: Vec<(Instant, Timer)>,
    /// When memory that pictures have left behind is given back to the system.
    trim_at: Option<Instant>,
    ended: bool,
}

impl World {
    /// Takes the terminal over and starts everything that sends messages.
    pub(crate) fn new(
        options: &Options,
        reader: Reader,
        sender: Sender<Event>,
    ) -> io::Result<Self> {
        let terminal = {
            let sender = sender.clone();
            let cleared = move || {
                let _ = sender.send(Event::Cleared);
            };
            Terminal::enter(options.colours(), options.mouse, cleared)?
        };
        let replies = Arc::new(Replies::default());
        let sink = |sender: &Sender<Event>| {
            let (sender, replies) = (sender.clone(), Arc::clone(&replies));
            move |event| {
                if let terminal::Event::Reply(reply) = event {
                    replies.came(reply);
                }
                // An inbox that is gone belongs to a program that ends.
                let _ = sender.send(Event::from(event));
            }
        };
        Ok(Self {
            terminal,
            replies: Arc::clone(&replies),
            input: Input::start(sink(&sender))?,
            #[cfg(unix)]
            signals: Signals::start(sink(&sender))?,
            reader,
            freeing: Freeing::start()?,
            writers: Writers::new(sender.clone()),
            keeper: Keeper::start(sending(&sender))?,
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

    /// The terminal, to draw on.
    pub(crate) fn terminal(&mut self) -> &mut Terminal {
        &mut self.terminal
    }

    /// Whether the terminal is not lent to another program.
    pub(crate) fn has_terminal(&self) -> bool {
        self.terminal.is_ours()
    }

    /// Asks the terminal for its colours, and tmux for those of the terminal behind it: answers
    /// come as [`Event::Replied`], if they come.
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

    /// Whether the program is to end.
    pub(crate) fn is_over(&self) -> bool {
        self.ended
    }

    /// The message of an event; none where its frame was taken before.
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
                // One that was stopped, or replaced, has ended as it should.
                let ended = self.numbered(target)?.number == number;
                ended.then_some(Msg::Ended(target))
            }
            Event::Cleared | Event::Replied(..) => None,
        }
    }

    /// Restores the terminal and waits for files being written, each for so long at most; returns
    /// what became of unsaved edits.
    pub(crate) fn close(self, terminal: Duration, files: Duration) -> End {
        let begun = Instant::now();
        self.await_replies(begun + terminal);
        self.terminal.close(begun + terminal);
        let end = self.keeper.finish(begun + files);
        self.writers.finish(begun + files);
        end
    }

    /// Has the terminal reply when all that was sent has arrived.
    pub(crate) fn ask_status(&self) -> io::Result<()> {
        self.replies.expect(Reply::Status);
        self.terminal.ask_status()
    }

    /// Stops expecting an answer about colours.
    pub(crate) fn give_up_colours(&self) {
        self.replies.came(Reply::Attributes);
    }

    /// Stops expecting status reports.
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

    /// The timers that are due, as messages.
    pub(crate) fn due(&mut self, now: Instant) -> Vec<Msg> {
        if self.trim_at.take_if(|at| *at <= now).is_some() {
            heap::trim();
        }
        self.timers
            .extract_if(.., |&mut (at, _)| at <= now)
            .map(|(_, timer)| Msg::Elapsed(timer))
            .collect()
    }

    /// Does what a step asks for; what comes of it at once.
    pub(crate) fn perform(&mut self, effect: Effect) -> Option<Msg> {
        let outcome = match effect {
            Effect::Trace(target, job) => return Some(self.trace(target, job)),
            Effect::Stop(target) => {
                self.stop(target);
                Ok(())
            }
            Effect::WriteImage(id, frame, to) => {
                let refused = self.writers.export(id, frame, to).err()?;
                return Some(Msg::Exported(id, Err(refused)));
            }
            Effect::CheckTarget(id, to) => self.writers.check(id, to),
            Effect::CheckPlace(path) => self.writers.check_place(path),
            Effect::FindBackups(scene) => self.writers.find_backups(scene),
            Effect::Read(path, known) => self.reader.read(path, known),
            Effect::Free(unneeded) => self.freeing.order(unneeded),
            Effect::Save {
                id,
                path,
                text,
                guard,
            } => {
                let refused = self.writers.save(id, path, text, guard).err()?;
                return Some(Msg::Saved(id, SaveOutcome::Failed(refused)));
            }
            Effect::Watch(path) => self.reader.watch(path),
            Effect::ReadAssets(wanted) => self.assets.order(wanted),
            Effect::Later(time, timer) => {
                self.timers.retain(|&(_, set)| set != timer);
                self.timers.push((Instant::now() + time, timer));
                Ok(())
            }
            Effect::WriteRecovery {
                scene,
                known,
                revision,
            } => self
                .keeper
                .order(Order::Keep(revision, Edits { scene, known })),
            Effect::DropRecovery => self.keeper.order(Order::Forget),
            Effect::LookForKept(sought) => recovery::look_for(sought, sending(&self.sender)),
            Effect::AdoptKept(claim) => self.keeper.order(Order::Adopt(claim)),
            Effect::DropKept(claim) => self.keeper.order(Order::Discard(claim)),
            Effect::OpenEditor { path, line } => {
                return Some(Msg::EditorClosed(self.open_editor(&path, line)));
            }
            Effect::SetMouse(mouse) => terminal_outcome(self.terminal.set_mouse(mouse)),
            Effect::Repaint => {
                self.terminal.repaint();
                Ok(())
            }
            Effect::TakeTerminal => self.take_terminal(),
            Effect::Suspend => self.suspend(),
            Effect::Quit => {
                self.ended = true;
                Ok(())
            }
        };
        outcome.err().map(Msg::Failed)
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
            // A worker that a panic has ended is replaced: the panic has cost one picture only.
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
            // It comes to rest by itself.
            Target::Preview => {}
            Target::Trace => self.trace = None,
            Target::Export => self.export = None,
        }
    }

    fn open_editor(&mut self, path: &Path, line: usize) -> Result<(), String> {
        self.await_replies(Instant::now() + REPLY_PATIENCE);
        self.input.park();
        #[cfg(unix)]
        self.signals.lend();
        let left = terminal_outcome(self.terminal.leave());
        let ran = left.and_then(|()| editor::run(path, line));
        #[cfg(unix)]
        self.signals.take_back();
        self.take_terminal()?;
        ran
    }

    fn take_terminal(&mut self) -> Result<(), String> {
        let taken = self.terminal.reenter();
        self.input.resume();
        terminal_outcome(taken)
    }

    #[cfg(unix)]
    fn suspend(&mut self) -> Result<(), String> {
        self.await_replies(Instant::now() + REPLY_PATIENCE);
        self.input.park();
        let stopped = self.terminal.leave().and_then(|()| suspend_process());
        match stopped {
            // The event of being continued takes the terminal back, which must not happen twice.
            Ok(true) => Ok(()),
            Ok(false) => self.take_terminal(),
            Err(error) => {
                self.take_terminal()?;
                terminal_outcome(Err(error))
            }
        }
    }

    #[cfg(not(unix))]
    fn suspend(&mut self) -> Result<(), String> {
        Err("this system can't stop a program until it is continued".to_owned())
    }
}

/// Puts messages into the inbox.
pub(crate) fn sending(sender: &Sender<Event>) -> impl Fn(Msg) + Clone + Send + Sync + 'static {
    let sender = sender.clone();
    move |msg| {
        // An inbox that is gone belongs to a program that ends.
        let _ = sender.send(Event::Msg(msg));
    }
}
/// A renderer, and which of all it is.
struct Numbered {
    number: u64,
    renderer: Renderer,
}

/// Announces a renderer's frames, and its worker's end, which drops this.
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

fn terminal_outcome(outcome: io::Result<()>) -> Result<(), String> {
    outcome.map_err(|error| format!("terminal: {error}"))
}

impl From<terminal::Event> for Event {
    fn from(event: terminal::Event) -> Self {
        use terminal::Event as E;
        Self::Msg(match event {
            E::Reply(reply) => return Self::Replied(reply, Instant::now()),
            E::Key(key) => Msg::Key(key),
            E::Paste(text) => Msg::Paste(text),
            E::Mouse(event) => Msg::Mouse(event),
            E::Resize { columns, rows } => Msg::Resize(columns, rows),
            E::Suspend => Msg::Suspend,
            E::Continue => Msg::Continued,
            E::HangUp => Msg::HangUp,
            E::Terminate { signal } => Msg::Terminate { signal },
            E::Interrupt => Msg::Interrupt,
        })
    }
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
