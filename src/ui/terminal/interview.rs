//! Asks the terminal and waits for its answers: for commands that print a text and end. The
//! interface never waits.

use std::io;
#[cfg(unix)]
use std::time::Duration;

use super::Reply;

/// What a terminal answered.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Answers {
    /// The answers, in their order.
    pub(crate) replies: Vec<Reply>,
}

impl Answers {
    /// Whether it said anything at all.
    pub(crate) fn is_silent(&self) -> bool {
        self.replies.is_empty()
    }

    /// Whether it shows 24-bit colours, as it says.
    pub(crate) fn has_true_colour(&self) -> bool {
        self.replies.contains(&Reply::TrueColour)
    }

    /// How a DEC private mode stands, if the terminal knows it.
    pub(crate) fn mode(&self, wanted: u16) -> Option<u16> {
        self.replies.iter().find_map(|reply| match *reply {
            Reply::Mode { number, state } if number == wanted && state != 0 => Some(state),
            _ => None,
        })
    }
}

/// How long the last answer is waited for, that it is not left to the shell.
#[cfg(unix)]
const LATEST: Duration = Duration::from_secs(1);

/// Asks the terminal at both ends of this process. Answers count for
/// [`PATIENCE`](super::query::PATIENCE).
#[cfg(unix)]
pub(crate) fn ask() -> io::Result<Answers> {
    use std::time::Instant;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::io::Errno;

    use super::decode::Decoder;
    use super::{Event, query, tty};

    let keyboard = tty::keyboard()?;
    let _raw = Raw::enter()?;
    let line = tty::Line::open()?;
    // A terminal that takes nothing answers nothing.
    let _ = line.write_at_once(&[query::COLOURS, query::MODES].concat())?;
    let asked = Instant::now();
    // Late answers don't count, but must not be left to the shell.
    let until = asked + LATEST;
    let mut decoder = Decoder::default();
    let mut answers = Answers::default();
    let mut is_ended = false;
    while !is_ended {
        let left = until.saturating_duration_since(Instant::now());
        let mut sources = [PollFd::new(&keyboard, PollFlags::IN)];
        match poll(&mut sources, Timespec::try_from(left).ok().as_ref()) {
            Ok(0) => break,
            Ok(_) => {}
            Err(Errno::INTR) => continue,
            Err(error) => return Err(error.into()),
        }
        let mut bytes = [0; 1024];
        let count = rustix::io::read(&keyboard, &mut bytes)?;
        if count == 0 {
            break;
        }
        let in_time = asked.elapsed() < query::PATIENCE;
        decoder.feed(&bytes[..count], Instant::now(), |event| match event {
            Event::Reply(Reply::Attributes) => {
                is_ended = true;
                answers.replies.extend(in_time.then_some(Reply::Attributes));
            }
            Event::Reply(reply) if in_time => {
                answers.replies.push(reply);
            }
            _ => {}
        });
    }
    // What the terminal may have made of the questions.
    let _ = line.write_at_once(b"\r\x1b[K")?;
    Ok(answers)
}

/// Asks nothing.
#[cfg(not(unix))]
pub(crate) fn ask() -> io::Result<Answers> {
    Ok(Answers::default())
}

/// Raw mode, until it is dropped.
#[cfg(unix)]
struct Raw;

#[cfg(unix)]
impl Raw {
    fn enter() -> io::Result<Self> {
        crossterm::terminal::enable_raw_mode()?;
        Ok(Self)
    }
}

#[cfg(unix)]
impl Drop for Raw {
    fn drop(&mut self) {
        // A terminal that is gone has no modes.
        let _ = crossterm::terminal::disable_raw_mode();
    }
}
