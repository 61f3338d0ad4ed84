//! Queries the terminal and waits up to a second for its answers, for commands that print a report and
//! exit. While the interface runs, answers arrive in its inbox instead.

use std::io;
use std::time::{Duration, Instant};

use super::{Protocol, Reply, query};

/// The answers of a terminal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Answers {
    /// The answers in order.
    pub(crate) replies: Vec<Reply>,
}

impl Answers {
    /// Whether the terminal shows pictures sent in this way.
    pub(crate) fn shows(&self, protocol: Protocol) -> bool {
        self.replies.contains(&Reply::Shows(protocol))
            || protocol == Protocol::Sixel && self.replies.contains(&Reply::AttributesWithSixel)
    }

    /// The size of a cell in pixels, if the terminal reports it.
    pub(crate) fn cell_size(&self) -> Option<(u16, u16)> {
        self.replies.iter().find_map(|reply| match *reply {
            Reply::CellSize { width, height } => Some((width, height)),
            _ => None,
        })
    }

    /// The state of a DEC private mode, if the terminal knows it.
    pub(crate) fn mode(&self, wanted: u16) -> Option<u16> {
        self.replies.iter().find_map(|reply| match *reply {
            Reply::Mode { number, state } if number == wanted && state != 0 => Some(state),
            _ => None,
        })
    }
}

/// Maximum time to wait for answers. Late ones don't count, but must not be left for the shell to
/// read.
const LATEST: Duration = Duration::from_secs(1);

/// The answers so far.
#[derive(Debug)]
struct Interview {
    asked: Instant,
    answers: Answers,
    /// Whether the last answer has arrived.
    is_over: bool,
}

impl Interview {
    fn take(&mut self, reply: Reply, at: Instant) {
        if at.duration_since(self.asked) < query::PATIENCE {
            self.answers.replies.push(reply);
        }
        self.is_over |= reply.is_last();
    }
}

/// Queries the terminal connected to standard input and output. Answers count for
/// [`PATIENCE`](super::query::PATIENCE).
pub(crate) fn ask() -> io::Result<Answers> {
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::io::Errno;

    use super::decode::Decoder;
    use super::{Event, tty};

    let keyboard = tty::keyboard()?;
    let _raw = Raw::enter()?;
    let line = tty::TtyWriter::open()?;
    // A terminal that accepts nothing answers nothing.
    let _ = line.write_at_once(
        &[
            query::COLOURS,
            query::MODES,
            query::pictures(),
            query::ATTRIBUTES,
        ]
        .concat(),
    )?;
    let mut interview = Interview {
        asked: Instant::now(),
        answers: Answers::default(),
        is_over: false,
    };
    let until = interview.asked + LATEST;
    let mut decoder = Decoder::default();
    while !interview.is_over {
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
        let now = Instant::now();
        decoder.feed(&bytes[..count], now, |event| {
            if let Event::Reply(reply) = event {
                interview.take(reply, now);
            }
        });
    }
    // Erases anything that the terminal displayed for the queries.
    let _ = line.write_at_once(b"\r\x1b[K")?;
    Ok(interview.answers)
}

/// Raw mode, until dropped.
struct Raw;

impl Raw {
    fn enter() -> io::Result<Self> {
        crossterm::terminal::enable_raw_mode()?;
        Ok(Self)
    }
}

impl Drop for Raw {
    fn drop(&mut self) {
        // A terminal that is gone has no modes.
        let _ = crossterm::terminal::disable_raw_mode();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn late_answers_do_not_count_and_the_last_answer_ends_the_wait() {
        use Reply::{Attributes, TrueColour};
        for (arrivals, counted, is_over) in table! {
            &[][..] => &[][..], false;
            &[(TrueColour, 199)] => &[TrueColour], false;
            &[(TrueColour, 200)] => &[], false;
            &[(TrueColour, 10), (Attributes, 20)] => &[TrueColour, Attributes], true;
            &[(TrueColour, 10), (Attributes, 300)] => &[TrueColour], true;
            &[(TrueColour, 500), (Attributes, 500)] => &[], true;
        } {
            let asked = Instant::now();
            let mut interview = Interview {
                asked,
                answers: Answers::default(),
                is_over: false,
            };
            for &(reply, milliseconds) in arrivals {
                interview.take(reply, asked + Duration::from_millis(milliseconds));
            }
            assert_eq!(interview.answers.replies, counted, "{arrivals:?}");
            assert_eq!(interview.is_over, is_over, "{arrivals:?}");
        }
    }
}
