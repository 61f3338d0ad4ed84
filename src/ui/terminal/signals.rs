//! Signals and hang-ups, handled by one thread that waits for all of them in `poll`.
//!
//! The terminal itself is watched in addition to `SIGHUP`: the signal may be ignored by
//! inheritance, as under `nohup`, and then only the terminal reports the hang-up.

use std::convert::Infallible;
use std::io::{self, Read, Write};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::sync::mpsc::{self, RecvTimeoutError, Sender};
use std::thread::JoinHandle;
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::Errno;
use rustix::process::{
    Pid, Signal, getpgrp, getpid, getppid, getsid, kill_current_process_group, kill_process,
};
use signal_hook::SigId;
use signal_hook::consts::{
    SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGIO, SIGPROF, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1, SIGUSR2,
    SIGVTALRM, SIGWINCH, SIGXCPU,
};
use signal_hook::low_level::{self, pipe};

use super::ownership::Ownership;
use super::{Event, tty};
use crate::queue::spawn;

/// Time for the interface to give the terminal back after that is gone.
const GRACE: Duration = Duration::from_millis(500);

/// Exit status that represents death by `SIGHUP`.
const HUNG_UP: i32 = 128 + SIGHUP;

/// Orders to the watching thread: the new owner of the terminal.
const LENT: u8 = b'l';
const OURS: u8 = b'o';

/// Signals with a specific meaning, and all others of POSIX that would end the process without restoring
/// the terminal.
const WATCHED: [i32; 14] = [
    SIGHUP, SIGTERM, SIGQUIT, SIGINT, SIGTSTP, SIGCONT, SIGWINCH, SIGALRM, SIGIO, SIGPROF, SIGUSR1,
    SIGUSR2, SIGVTALRM, SIGXCPU,
];

/// Reports signals and hang-ups to the interface until dropped.
///
/// After [`Event::HangUp`] it must be dropped within 500 ms; otherwise, as a write to the terminal may
/// block for ever, the process is ended with status 129.
#[derive(Debug)]
pub struct Signals {
    registered: Vec<SigId>,
    /// Sends [`LENT`] and [`OURS`]. Dropping it causes a hang-up at its other end, which ends the
    /// thread.
    requests: Option<UnixStream>,
    thread: Option<JoinHandle<()>>,
}

impl Signals {
    /// Starts watching; `send` is called on the watching thread.
    pub fn start(send: impl Fn(Event) + Send + 'static) -> io::Result<Self> {
        let (requests, inbox) = UnixStream::pair()?;
        inbox.set_nonblocking(true)?;
        let mut signals = Self {
            registered: Vec::new(),
            requests: Some(requests),
            thread: None,
        };
        let mut arrivals = Vec::new();
        for signal in WATCHED {
            let (arrival, raised) = UnixStream::pair()?;
            arrival.set_nonblocking(true)?;
            signals.registered.push(pipe::register(signal, raised)?);
            arrivals.push((signal, arrival));
        }
        let watch = Watch {
            inbox,
            ownership: Ownership::Ours,
            tty: Some(tty::keyboard()?),
            arrivals,
        };
        signals.thread = Some(spawn("signals", move || watch.run(&send))?);
        Ok(signals)
    }

    /// Leaves keyboard signals to a program in our process group that borrows the terminal and
    /// receives them as well. Only a stop also applies to us, so that the shell sees its job
    /// stopped.
    pub fn lend(&self) {
        self.request(LENT);
    }

    /// Reports all signals again, except those that arrived before.
    pub fn take_back(&self) {
        self.request(OURS);
    }

    fn request(&self, request: u8) {
        if let Some(mut requests) = self.requests.as_ref() {
            // A thread that has ended needs no requests.
            let _ = requests.write(&[request]);
        }
    }
}

impl Drop for Signals {
    fn drop(&mut self) {
        self.requests = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
        // Last, because it closes the other ends of what the thread would take for arrivals.
        for &registered in &self.registered {
            low_level::unregister(registered);
        }
    }
}

/// Stops the whole job, as Ctrl-Z does outside raw mode, and returns `true` once it is continued,
/// which is also reported as an [`Event::Continue`].
///
/// Returns `false` at once if no shell could continue it: in the process group of a session leader,
/// or after the shell has ended. The terminal must be given back first.
pub fn suspend_process() -> io::Result<bool> {
    let is_job = is_job()?;
    if is_job {
        // SIGTSTP would only return as an event, because its default action is replaced.
        kill_current_process_group(Signal::STOP)?;
    }
    Ok(is_job)
}

/// Whether a shell exists that could continue the process.
fn is_job() -> io::Result<bool> {
    let leads = getsid(None)? == getpgrp();
    let is_orphan = getppid().is_none_or(Pid::is_init);
    Ok(!leads && !is_orphan)
}

/// Performs the default action of SIGTSTP. The program that borrows the terminal received the
/// signal too, and may have reasons not to stop.
fn stop_alone() {
    if is_job().unwrap_or(false) {
        // An error cannot be reported while the terminal is lent.
        let _ = kill_process(getpid(), Signal::STOP);
    }
}

struct Watch {
    inbox: UnixStream,
    ownership: Ownership,
    /// `None` once the terminal is gone.
    tty: Option<OwnedFd>,
    arrivals: Vec<(i32, UnixStream)>,
}

impl Watch {
    fn run(mut self, send: &impl Fn(Event)) {
        let mut watchdog = None;
        loop {
            let arrivals = self.arrivals.iter().map(|(_, arrival)| arrival);
            let inputs = [&self.inbox].into_iter().chain(arrivals);
            let mut sources: Vec<_> = inputs.map(|of| PollFd::new(of, PollFlags::IN)).collect();
            // No events are requested, so that only a hang-up is reported.
            let tty = self.tty.iter();
            sources.extend(tty.map(|tty| PollFd::new(tty, PollFlags::empty())));
            match poll(&mut sources, None) {
                Ok(_) => {}
                Err(Errno::INTR) => continue,
                Err(_) => return,
            }
            let reported: Vec<_> = sources.iter().map(PollFd::revents).collect();
            let mut ownership = self.ownership;
            if !reported[0].is_empty() {
                let mut requests = [0; 64];
                match (&self.inbox).read(&mut requests) {
                    Ok(count @ 1..) if requests[count - 1] == LENT => ownership = Ownership::Lent,
                    Ok(1..) => ownership = Ownership::Ours,
                    Ok(0) => return,
                    Err(_) => {}
                }
            }
            // Signals that arrived before the terminal was taken back were meant for the other
            // program.
            let theirs = [self.ownership, ownership].contains(&Ownership::Lent);
            let whose = if theirs { Ownership::Lent } else { ownership };
            self.ownership = ownership;
            let tty = reported.get(self.arrivals.len() + 1);
            let tty = tty.copied().unwrap_or(PollFlags::empty());
            if !tty.is_empty() {
                // NVAL means that the system cannot poll terminals; SIGHUP must suffice.
                self.tty = None;
            }
            // Handled first, because a broken connection sends SIGCONT as well.
            if tty.intersects(PollFlags::HUP | PollFlags::ERR) {
                report(SIGHUP, whose, &mut watchdog, send);
            }
            for ((signal, arrival), revents) in self.arrivals.iter().zip(&reported[1..]) {
                if revents.contains(PollFlags::IN) {
                    tty::drain(arrival);
                    report(*signal, whose, &mut watchdog, send);
                }
            }
        }
    }
}

/// What ends the process if the terminal is gone, unless it is dropped in time.
type Watchdog = Option<Sender<Infallible>>;

fn report(signal: i32, whose: Ownership, watchdog: &mut Watchdog, send: &impl Fn(Event)) {
    match signal {
        // Without a terminal, only requests to end are still reported.
        SIGHUP | SIGWINCH | SIGTSTP | SIGCONT if watchdog.is_some() => {}
        SIGHUP => {
            // Before sending the event: the interface may be blocked in a write to the terminal.
            *watchdog = Some(end_after_grace());
            send(Event::HangUp);
        }
        // The terminal is taken back when the other program ends in any case.
        SIGINT | SIGQUIT | SIGCONT if whose == Ownership::Lent => {}
        SIGTSTP if whose == Ownership::Lent => stop_alone(),
        SIGWINCH => {
            let size = tty::size();
            send(Event::Resize {
                columns: size.width,
                rows: size.height,
            });
        }
        SIGTSTP => send(Event::Suspend),
        SIGCONT => send(Event::Continue),
        SIGINT => send(Event::Interrupt),
        _ => send(Event::Terminate {
            signal: signal as u8,
        }),
    }
}

/// Ends the process after [`GRACE`] unless what is returned is dropped before.
fn end_after_grace() -> Sender<Infallible> {
    let (watched, end) = mpsc::channel::<Infallible>();
    let started = spawn("watchdog", move || {
        if end.recv_timeout(GRACE) == Err(RecvTimeoutError::Timeout) {
            // Nothing is left to restore, and exit handlers might wait for the terminal.
            low_level::exit(HUNG_UP);
        }
    });
    if started.is_err() {
        low_level::exit(HUNG_UP);
    }
    watched
}
