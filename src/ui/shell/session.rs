//! The main loop: waits for events, performs steps, draws.

mod pixels;
mod play;
mod terminal_queries;

use std::collections::VecDeque;
use std::path::PathBuf;
use std::sync::mpsc::{self, Receiver};
use std::time::{Duration, Instant};
use std::{io, mem};

use pixels::{Known, Manner};

use super::beginning::Beginning;
use super::continuing::TraceEnd;
use super::effects::Runtime;
use super::ending::{Ending, Error};
use super::script::{Recorder, Script};
use crate::app::{App, display, exports, files};
use crate::event::{Event, sending};
use crate::msg::{Effect, Msg, Target};
use crate::options::Options;
use crate::recovery::End;
use crate::service::scene_loader::SceneLoader;
use crate::terminal::{Budget, Choice, ColourDepth, Link, Reply};
use crate::view::Inks;
use crate::{terminal, view};
use text::shell_path;

/// Minimum time between two drawings that only refine the picture.
const FRAME_TIME: Duration = Duration::from_millis(33);

/// Runs the interface until it ends.
///
/// With a script, the keys come from it instead of the terminal.
pub(crate) fn run(
    options: &Options,
    app: App,
    mut effects: Vec<Effect>,
    script: Option<Script>,
) -> Result<Ending, Error> {
    let (sender, inbox) = mpsc::channel();
    let reader = SceneLoader::start(options, sending(&sender))?;
    if script.is_some() {
        // Nothing else changes the files of a script.
        effects.retain(|effect| !matches!(effect, Effect::Watch(_)));
    }
    let beginning = Beginning::new(app, effects, reader, (sender.clone(), &inbox))?;
    let budget = match (options.bandwidth, &script) {
        (_, Some(_)) => Budget::Fixed(0),
        (Some(bandwidth), None) => Budget::Fixed(bandwidth),
        (None, None) => Budget::of_environment(|name| std::env::var(name).ok()),
    };
    let mut session = Session {
        app: beginning.app,
        runtime: Runtime::new(options, beginning.reader, sender)?,
        link: Link::new(budget),
        waiting: None,
        inks: Inks::for_depth(options.colours()),
        asked_until: None,
        choice: options.colour(),
        depth: options.colours(),
        known: Known::asked_nothing(),
        manner: Manner::Half,
        inbox,
        script,
        recorder: Recorder::default(),
        is_played: false,
        assets: options.assets.clone(),
        failed: None,
        at_work: beginning.at_work,
        refined: None,
        ending: Ending::Quit,
    };
    session.ask_at_start()?;
    session.perform(beginning.effects);
    session.run();
    let finished = session.finish(options.rehearsal.as_ref());
    let ending = session.close()?;
    finished.map(|()| ending)
}

struct Session {
    app: App,
    runtime: Runtime,
    link: Link,
    /// When the frame that the terminal has not fully taken yet was sent, and its size in bytes.
    waiting: Option<(Instant, usize)>,
    inks: Inks,
    /// The deadline for an answer of the terminal that it has more colours than those in use.
    asked_until: Option<Instant>,
    /// The user's choice of colours.
    choice: Choice,
    /// The colour depth in use.
    depth: ColourDepth,
    /// What the terminal has answered about pictures.
    known: Known,
    /// What pixels are drawn with.
    manner: Manner,
    inbox: Receiver<Event>,
    /// Where the keys come from, if not from the terminal.
    script: Option<Script>,
    /// What the script records.
    recorder: Recorder,
    /// Whether the step to play next has shown a frame of a sequence that plays.
    is_played: bool,
    /// Folders that the scene's files may be in, besides those around it.
    assets: Vec<PathBuf>,
    /// Why the script was not played to its end.
    failed: Option<Error>,
    /// The number of pieces of work under way whose results arrive in the inbox.
    at_work: usize,
    /// When a refined frame was last awaited and drawn.
    refined: Option<Instant>,
    /// Why the program ends.
    ending: Ending,
}

/// How soon the screen must be drawn.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Urgency {
    /// Nothing changed: no drawing is due.
    Never,
    /// The picture was refined.
    Soon,
    /// The user is waiting; includes the first frame of a picture.
    Now,
}

impl Session {
    /// Handles a reply of the terminal. A report of 24-bit colour counts only within the deadline.
    fn replied(&mut self, reply: Reply, at: Instant) -> Urgency {
        if reply == Reply::Status {
            self.link.replied(at);
        }
        if reply == Reply::KeysApart
            && let Some(tty) = self.runtime.screen().tty()
        {
            // A terminal that is gone is noticed by the next frame.
            let _ = tty.terminal.keep_keys_apart();
        }
        self.known.take(reply);
        let changed = match self.wanted_manner() {
            manner if manner == self.manner => Urgency::Never,
            _ => Urgency::Now,
        };
        let is_in_time = |until: &mut Instant| at < *until;
        if reply != Reply::TrueColour || self.asked_until.take_if(is_in_time).is_none() {
            return changed;
        }
        self.depth = ColourDepth::TrueColour;
        self.inks = Inks::for_depth(self.depth);
        self.inks.drawing = self.manner.drawing();
        if let Some(tty) = self.runtime.screen().tty() {
            tty.terminal.recolour(self.depth);
        }
        Urgency::Now
    }

    /// Shows how to force 24-bit colour once no answer can arrive any more.
    fn give_up_on_colours(&mut self) -> Urgency {
        let now = Instant::now();
        if self.known.until.take_if(|until| *until <= now).is_some()
            && let Some(tty) = self.runtime.screen().tty()
        {
            tty.replies.came(Reply::Attributes);
        }
        if self.asked_until.take_if(|until| *until <= now).is_none() {
            return Urgency::Never;
        }
        self.step(Msg::FewColours(self.depth));
        Urgency::Now
    }

    fn run(&mut self) {
        let mut urgency = Urgency::Now;
        while !self.runtime.is_over() {
            let now = Instant::now();
            let draw_at = match urgency {
                Urgency::Now => Some(now),
                Urgency::Soon => {
                    let next = self.refined.map_or(now, |refined| refined + FRAME_TIME);
                    self.link.ready_at(now).max(Some(next))
                }
                Urgency::Never => self.rest_at(now),
            };
            // One frame is in flight at a time; the next one waits.
            let is_clear = self.runtime.screen().is_clear();
            let draw_at = draw_at.filter(|_| is_clear);
            if is_clear && let Some((sent, bytes)) = self.waiting.take() {
                self.link.waited(bytes, now - sent, now);
            }
            let is_due = draw_at.is_some_and(|at| at <= now);
            if is_due && urgency == Urgency::Soon {
                self.refined = Some(now);
            }
            if is_clear && self.ask(now).is_err() || is_due && self.draw(urgency).is_err() {
                // A terminal that cannot be written to is gone; what must survive is saved.
                self.step(Msg::HangUp);
                return;
            }
            urgency = if is_due {
                Urgency::Never
            } else {
                let may_ask = is_clear && self.runtime.screen().has_terminal();
                let asks_at = self.link.asks_at().filter(|_| may_ask);
                urgency.max(self.wait(draw_at.into_iter().chain(asks_at).min()))
            };
        }
    }

    /// Restores the terminal and prints there what became of unsaved edits and of the full-size
    /// trace.
    fn close(mut self) -> Result<Ending, Error> {
        let unreadable = self.app.shared.disk.take_failure();
        let path = self.app.shared.disk.path.as_deref();
        let path = path.map_or_else(String::new, |path| {
            format!(" {}", shell_path(&path.to_string_lossy()))
        });
        let key = self.app.shared.key_for("trace");
        let scene = self.app.shared.scene.clone();
        let now = scene.zip(exports::origin(&self.app.shared));
        // The end of the process frees a large scene immediately.
        mem::forget(self.app);
        let (edits, trace) = self.runtime.close(self.ending.deadlines(), now);
        let edits = match edits {
            End::Nothing => None,
            End::Kept => Some(format!(
                "unsaved edits are kept; run halflight{path} to restore them"
            )),
            End::Lost(reason) => Some(format!("not all unsaved edits are kept: {reason}")),
        };
        let trace = match trace {
            TraceEnd::Nothing => None,
            TraceEnd::Kept { spp, goal } => {
                let of = goal.map_or_else(String::new, |goal| format!(" of {goal}"));
                Some(format!(
                    "the full-size trace is kept ({spp}{of} spp); {key} continues it"
                ))
            }
            TraceEnd::Lost(reason) => Some(format!("the full-size trace is not kept: {reason}")),
        };
        for words in edits.into_iter().chain(trace) {
            terminal::complain(text::visible(&text::without_codes(&words)).into_owned());
        }
        unreadable.map_or(Ok(self.ending), |error| Err(error.into()))
    }

    /// When the rest of a picture may be sent, if there is one and room for it.
    fn rest_at(&self, now: Instant) -> Option<Instant> {
        if !self.app.shared.picture().is_pending()
            || display::frame_window(&self.app.shared).is_none()
        {
            return None;
        }
        Some(self.link.ready_at(now).unwrap_or(now))
    }

    /// Waits for input until `deadline` and handles everything that has arrived.
    fn wait(&mut self, deadline: Option<Instant>) -> Urgency {
        if self.script.is_some() {
            return self.play();
        }
        let others = [
            self.runtime.next_timer(),
            self.link.gives_up_at(),
            self.asked_until,
            self.known.until,
        ];
        let deadline = others.into_iter().chain([deadline]).flatten().min();
        let first = match deadline {
            None => self.inbox.recv().ok(),
            Some(deadline) => {
                let time = deadline.saturating_duration_since(Instant::now());
                self.inbox.recv_timeout(time).ok()
            }
        };
        let mut urgency = Urgency::Never;
        let events: Vec<_> = first.into_iter().chain(self.inbox.try_iter()).collect();
        for event in events {
            while let Some(msg) = self.next_signal() {
                urgency = Urgency::Now;
                self.step(msg);
            }
            if self.runtime.is_over() {
                break;
            }
            urgency = urgency.max(self.take(event));
        }
        let now = Instant::now();
        if self.link.give_up(now)
            && let Some(tty) = self.runtime.screen().tty()
        {
            tty.replies.forget_statuses();
        }
        for msg in self.runtime.due(now) {
            urgency = Urgency::Now;
            self.step(msg);
        }
        urgency = urgency.max(self.give_up_on_colours());
        let panics = self.runtime.screen().tty();
        for panic in panics.map_or_else(Vec::new, |tty| tty.terminal.take_panics()) {
            urgency = Urgency::Now;
            self.step(Msg::Failed(panic));
        }
        urgency
    }

    fn next_signal(&mut self) -> Option<Msg> {
        self.runtime.screen().tty()?.next_signal()
    }

    /// Handles an event.
    fn take(&mut self, event: Event) -> Urgency {
        match event {
            // Counts as unread until it is handled.
            Event::Typed(event, _unread) => return self.take(*event),
            Event::Replied(reply, at) => return self.replied(reply, at),
            Event::Begun => self.at_work += 1,
            Event::Done => self.at_work -= 1,
            event => {
                if let Some(msg) = self.runtime.message(event) {
                    let urgency = self.urgency_of(&msg);
                    self.step(msg);
                    return urgency;
                }
            }
        }
        Urgency::Never
    }

    fn urgency_of(&self, msg: &Msg) -> Urgency {
        match msg {
            Msg::Frame(Target::Preview, frame)
                if self.app.shared.pictures.preview.is_first(frame) =>
            {
                Urgency::Now
            }
            Msg::Frame(..) => Urgency::Soon,
            _ => Urgency::Now,
        }
    }

    fn step(&mut self, msg: Msg) {
        if !self.runtime.is_over() {
            self.ending = ending(&msg);
        }
        let effects = self.app.update(msg);
        self.perform(effects);
        let are_kept = files::has_kept_edits(&self.app.shared);
        if let Some(tty) = self.runtime.screen().tty() {
            tty.terminal.note_kept_edits(are_kept);
        }
    }

    fn perform(&mut self, effects: Vec<Effect>) {
        let mut left = VecDeque::from(effects);
        while let Some(effect) = left.pop_front() {
            if matches!(
                effect,
                Effect::OpenEditor { .. } | Effect::Suspend | Effect::TakeTerminal
            ) {
                // The time another program had the terminal is no measure of the link.
                self.waiting = None;
            }
            if let Some(msg) = self.runtime.perform(effect) {
                left.extend(self.app.update(msg));
            }
        }
    }

    /// Requests a reply of the terminal if the link should be measured.
    fn ask(&mut self, now: Instant) -> io::Result<()> {
        if self.link.has_question(now)
            && let Some(tty) = self.runtime.screen().tty()
            && tty.terminal.is_ours()
        {
            tty.ask_status()?;
            self.link.asked(now);
        }
        Ok(())
    }

    fn draw(&mut self, urgency: Urgency) -> io::Result<()> {
        let now = Instant::now();
        self.fit_pixels()?;
        let is_limited = self.link.is_limited();
        display::follow_wires(&mut self.app.shared);
        self.app.shared.has_colours = self.inks.have_colours();
        if let Some(frame_window) = display::frame_window(&self.app.shared) {
            let allowance = match urgency {
                // Nothing of the picture is sent.
                _ if self.app.shared.wireframe().is_some() => usize::MAX,
                // The part that the user is waiting for is sent first, without the picture.
                Urgency::Now if is_limited => 0,
                _ => self.link.allowance(now),
            };
            let allowance = match (self.manner, allowance) {
                // A picture is sent as a whole, and later ones wait until its bytes are paid.
                (Manner::Picture(_), 1..) => usize::MAX,
                (_, allowance) => allowance,
            };
            let marked = display::outlined_objects(&self.app.shared);
            let picture = self.app.shared.picture_mut();
            picture.advance(&frame_window, &marked, allowance);
            let rests = !picture.is_pending() && picture.is_complete();
            self.app.shared.pictures.net = (is_limited && !rests).then(|| self.link.rate(now));
        }
        let (app, inks) = (&self.app, &mut self.inks);
        let mut area = app.shared.terminal;
        let pixmap = self.manner.means().map(|_| view::pixmap(app));
        let bytes = self.runtime.screen().draw(pixmap.as_ref(), |frame| {
            area = (frame.area().width, frame.area().height);
            view::draw(app, inks, frame)
        })?;
        self.link.spent(bytes, now);
        if !self.runtime.screen().is_clear() {
            self.waiting = Some((now, bytes));
        }
        if area != self.app.shared.terminal {
            self.step(Msg::Resize(area.0, area.1));
            return self.draw(urgency);
        }
        Ok(())
    }
}

/// The ending that results if this message ends the program.
fn ending(msg: &Msg) -> Ending {
    match msg {
        Msg::Interrupt => Ending::Interrupted,
        Msg::Terminate { signal } => Ending::Terminated { signal: *signal },
        Msg::HangUp => Ending::HungUp,
        _ => Ending::Quit,
    }
}
