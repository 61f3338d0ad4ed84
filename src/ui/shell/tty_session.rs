//! The terminal together with its keyboard and the signals of its user, lent to other programs and
//! taken back as one.

use std::io;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, Sender};
use std::time::{Duration, Instant};

use crate::event::Event;
use crate::msg::Msg;
use crate::options::Options;
use crate::queue::spawn;
use crate::terminal::query::Question;
use crate::terminal::{
    self, Input, Replies, Reply, Signals, Terminal, Unread, suspend_process, tmux,
};

/// Maximum time to wait for replies of the terminal before handing it over; longer than nearly all
/// round trips.
const REPLY_PATIENCE: Duration = Duration::from_secs(1);

/// The terminal that the interface runs on.
pub(super) struct TtySession {
    // First, because fields are dropped in order: the terminal is restored before its threads end.
    /// The terminal to draw on.
    pub(super) terminal: Terminal,
    /// Replies still expected from the terminal.
    pub(super) replies: Arc<Replies>,
    input: Input,
    signals: Signals,
    /// Signals that have arrived, each announced by [`Event::Signalled`].
    arrived: Receiver<Msg>,
    sender: Sender<Event>,
}

impl TtySession {
    /// Takes over the terminal and starts reading keys and signals.
    pub(super) fn enter(options: &Options, sender: &Sender<Event>) -> io::Result<Self> {
        // Before the terminal is changed: until then the default actions of signals do no harm.
        let (signals, arrived) = watch(sender)?;
        let terminal = {
            let sender = sender.clone();
            let cleared = move || {
                let _ = sender.send(Event::Cleared);
            };
            Terminal::enter(options.colours(), options.mouse(), cleared)?
        };
        let replies = Arc::new(Replies::default());
        Ok(Self {
            terminal,
            input: Input::start(typing(sender, &replies))?,
            replies,
            signals,
            arrived,
            sender: sender.clone(),
        })
    }

    /// The next signal that has arrived.
    pub(super) fn next_signal(&self) -> Option<Msg> {
        self.arrived.try_recv().ok()
    }

    /// Queries the terminal and, through tmux, the terminal behind it. Any answers arrive as
    /// [`Event::Replied`].
    pub(super) fn ask(&self, questions: &[Question]) -> io::Result<()> {
        self.replies.expect(Reply::Attributes);
        self.terminal.ask(questions)?;
        if questions == [Question::Keys] {
            return Ok(());
        }
        let sender = self.sender.clone();
        // Without a thread there is no answer.
        let _ = spawn("tmux", move || {
            let Some(client) = tmux::client() else { return };
            let colours = client.has_true_colour.then_some(Reply::TrueColour);
            for reply in [Some(Reply::Tmux(client)), colours].into_iter().flatten() {
                let _ = sender.send(Event::Replied(reply, Instant::now()));
            }
        });
        Ok(())
    }

    /// Requests a status reply, which arrives after everything sent so far.
    pub(super) fn ask_status(&self) -> io::Result<()> {
        self.replies.expect(Reply::Status);
        self.terminal.ask_status()
    }

    /// Runs another program on the terminal; the inner result is the program's.
    pub(super) fn lend<T>(&mut self, run: impl FnOnce() -> T) -> io::Result<T> {
        self.await_replies(Instant::now() + REPLY_PATIENCE);
        self.input.park();
        self.signals.lend();
        let ran = self.terminal.leave().map(|()| run());
        self.signals.take_back();
        self.take()?;
        ran
    }

    /// Takes the terminal back from another program.
    pub(super) fn take(&mut self) -> io::Result<()> {
        let taken = self.terminal.reenter();
        self.input.resume();
        taken
    }

    /// Stops the process until it is continued.
    pub(super) fn suspend(&mut self) -> io::Result<()> {
        self.await_replies(Instant::now() + REPLY_PATIENCE);
        self.input.park();
        let stopped = self.terminal.leave().and_then(|()| suspend_process());
        match stopped {
            // The continue event takes the terminal back, which must not happen twice.
            Ok(true) => Ok(()),
            Ok(false) => self.take(),
            Err(error) => {
                self.take()?;
                Err(error)
            }
        }
    }

    /// Restores the terminal, waiting until `deadline` at most.
    pub(super) fn close(self, deadline: Instant) {
        self.await_replies(deadline);
        self.terminal.close(deadline);
    }

    /// Waits for replies that the next program on the terminal would take for keys.
    fn await_replies(&self, deadline: Instant) {
        if self.terminal.is_clear() {
            self.replies
                .wait(deadline.min(Instant::now() + REPLY_PATIENCE));
        }
    }
}

/// Puts what the keyboard sends into the inbox.
fn typing(
    sender: &Sender<Event>,
    replies: &Arc<Replies>,
) -> impl Fn(terminal::Event, Unread) + Send + 'static {
    let (sender, replies) = (sender.clone(), Arc::clone(replies));
    move |event, unread| {
        if let terminal::Event::Reply(reply) = event {
            replies.came(reply);
        }
        // The inbox is gone only when the program ends.
        let _ = sender.send(Event::Typed(Box::new(Event::from(event)), unread));
    }
}

/// Starts watching signals, which do not wait for what is in the inbox.
fn watch(sender: &Sender<Event>) -> io::Result<(Signals, Receiver<Msg>)> {
    let (arrive, arrived) = mpsc::channel();
    let sender = sender.clone();
    let signals = Signals::start(move |event| {
        if let Event::Msg(msg) = Event::from(event) {
            // Both are gone only when the program ends.
            let _ = arrive.send(msg);
            let _ = sender.send(Event::Signalled);
        }
    })?;
    Ok((signals, arrived))
}
