//! Signals and the end of the line, on one thread that sleeps in `poll` for all of them.
//!
//! The terminal is watched as well as `SIGHUP` awaited: the signal may be ignored by inheritance,
//! as under `nohup`, and then only the terminal's end of the line tells.

use std::io::{self, Read};
use std::os::fd::OwnedFd;
use std::os::unix::net::UnixStream;
use std::thread::{self, JoinHandle};
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, poll};
use rustix::io::Errno;
use signal_hook::SigId;
use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGTSTP, SIGWINCH};
use signal_hook::low_level::{self, pipe};

use super::{Event, tty};

/// How long the interface may take to end after its terminal is gone.
const GRACE: Duration = Duration::from_millis(500);

/// What the system reports for a process that `SIGHUP` ended.
const HUNG_UP: i32 = 128 + SIGHUP;

const WATCHED: [i32; 7] = [SIGHUP, SIGTERM, SIGQUIT, SIGINT, SIGTSTP, SIGCONT, SIGWINCH];

/// Tells the interface of signals and of a terminal that is gone, until it is dropped.
///
/// After [`Event::HangUp`] the process has 500 ms to end; then it is ended with status 129.
#[derive(Debug)]
pub struct Signals {
    registered: Vec<SigId>,
    /// Its other end reports a hang-up when this one is dropped, which ends the thread.
    stop: Option<UnixStream>,
    thread: Option<JoinHandle<()>>,
}

impl Signals {
    /// Starts watching; `send` is called on the watching thread.
    pub fn start(send: impl Fn(Event) + Send + 'static) -> io::Result<Self> {
        let (stop, stopped) = UnixStream::pair()?;
        let mut signals = Self {
            registered: Vec::new(),
            stop: Some(stop),
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
            stopped,
            tty: Some(tty::keyboard()?),
            arrivals,
        };
        let thread = thread::Builder::new().name("signals".to_owned());
        signals.thread = Some(thread.spawn(move || watch.run(&send))?);
        Ok(signals)
    }
}

impl Drop for Signals {
    fn drop(&mut self) {
        for &registered in &self.registered {
            low_level::unregister(registered);
        }
        self.stop = None;
        if let Some(thread) = self.thread.take() {
            let _ = thread.join();
        }
    }
}

/// Stops the whole job, as Ctrl-Z does outside raw mode, and returns when it is continued.
///
/// Returns at once where no shell could continue it: in the process group of a session's leader,
/// or when the shell has ended. The terminal must have been given back before.
pub fn suspend_process() -> io::Result<()> {
    let group = rustix::process::getpgrp();
    let leads = rustix::process::getsid(None)? == group;
    let is_orphan = rustix::process::getppid().is_none_or(rustix::process::Pid::is_init);
    if leads || is_orphan {
        return Ok(());
    }
    // SIGTSTP would only come back as an event, because its default action is replaced.
    rustix::process::kill_current_process_group(rustix::process::Signal::STOP)?;
    Ok(())
}

struct Watch {
    stopped: UnixStream,
    /// `None` once it is gone.
    tty: Option<OwnedFd>,
    arrivals: Vec<(i32, UnixStream)>,
}

impl Watch {
    fn run(mut self, send: &impl Fn(Event)) {
        let mut line = Line::Up;
        loop {
            let mut sources = vec![PollFd::new(&self.stopped, PollFlags::IN)];
            sources.extend(
                self.arrivals
                    .iter()
                    .map(|(_, arrival)| PollFd::new(arrival, PollFlags::IN)),
            );
            // Nothing is asked for, so only the end of the line is reported.
            sources.extend(
                self.tty
                    .iter()
                    .map(|tty| PollFd::new(tty, PollFlags::empty())),
            );
            match poll(&mut sources, None) {
                Ok(_) => {}
                Err(Errno::INTR) => continue,
                Err(_) => return,
            }
            let reported: Vec<_> = sources.iter().map(PollFd::revents).collect();
            if !reported[0].is_empty() {
                return;
            }
            let tty = reported
                .get(self.arrivals.len() + 1)
                .copied()
                .unwrap_or(PollFlags::empty());
            if !tty.is_empty() {
                // Where terminals cannot be polled, NVAL says so, and SIGHUP must do.
                self.tty = None;
            }
            // First, because a line that breaks sends SIGCONT as well.
            if tty.intersects(PollFlags::HUP | PollFlags::ERR) {
                tell(SIGHUP, &mut line, send);
            }
            for ((signal, arrival), revents) in self.arrivals.iter().zip(&reported[1..]) {
                if revents.contains(PollFlags::IN) {
                    while (&mut &*arrival)
                        .read(&mut [0; 64])
                        .is_ok_and(|bytes| bytes != 0)
                    {}
                    tell(*signal, &mut line, send);
                }
            }
        }
    }
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Line {
    Up,
    Down,
}

fn tell(signal: i32, line: &mut Line, send: &impl Fn(Event)) {
    match signal {
        // Without a terminal nothing is left to tell but the end.
        SIGHUP | SIGWINCH | SIGTSTP | SIGCONT if *line == Line::Down => {}
        SIGHUP => {
            *line = Line::Down;
            // Before the interface hears of it: it may be stuck in a write to the terminal.
            end_after_grace();
            send(Event::HangUp);
        }
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
        _ => send(Event::Terminate),
    }
}

fn end_after_grace() {
    let watchdog = thread::Builder::new().name("watchdog".to_owned());
    let started = watchdog.spawn(|| {
        thread::sleep(GRACE);
        // Nothing is left to restore, and exit handlers might wait for the terminal.
        low_level::exit(HUNG_UP);
    });
    if started.is_err() {
        low_level::exit(HUNG_UP);
    }
}
