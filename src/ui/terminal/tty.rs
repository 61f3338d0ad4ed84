//! The terminal as a file: its size, its modes, and writes that know how to wait.

#[cfg(unix)]
use std::fs::File;
use std::io::{self, Write};
#[cfg(unix)]
use std::os::fd::{AsFd, OwnedFd};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use ratatui::layout::Size;

/// What a terminal that does not know its size is taken for.
const USUAL: Size = Size {
    width: 80,
    height: 24,
};

/// The most cells that are drawn in a row: beyond any screen.
const MAX_COLUMNS: u16 = 2000;

/// The most cells that are drawn. A terminal may report 65535×65535: drawing such a screen would take
/// gigabytes and minutes.
const MAX_CELLS: u32 = 500_000;

/// How long a line on standard error may take.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// Returns the size of the window in cells, never zero; of a window beyond any screen, the size of
/// the part at its top left that is drawn on.
///
/// A terminal that reports 0×0 does not know; then `LINES` and `COLUMNS` count, or else 80×24.
pub(crate) fn size() -> Size {
    let (width, height) = crossterm::terminal::size().unwrap_or((0, 0));
    let variable = |name: &str| std::env::var(name).ok()?.trim().parse().ok();
    drawn_part(known_size(Size { width, height }, variable))
}

/// What a write that does not wait came to.
#[derive(Debug)]
pub(super) enum Taken {
    /// The terminal took so many bytes, at least one.
    Bytes(usize),
    /// It takes nothing now.
    Nothing,
}

/// The terminal's side that is written to.
#[cfg(unix)]
#[derive(Debug)]
pub(super) struct Line {
    file: OwnedFd,
    mode: LineMode,
}

#[cfg(unix)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum LineMode {
    /// Writes return at once.
    NonBlocking,
    /// Writes may block: the open file is shared with other programs, whose mode it keeps.
    Shared,
}

#[cfg(unix)]
impl Line {
    /// The most that is written to a shared file at once, as such a write blocks until the
    /// terminal has taken all of it.
    const SHARED_PIECE: usize = 1 << 12;

    /// Opens the terminal that standard output is once more by its name, to have a mode of its
    /// own; shares standard output where that fails, as for another user's terminal.
    pub(super) fn open() -> io::Result<Self> {
        let output = io::stdout();
        match open_anew(&output) {
            Ok(file) => Ok(Self::own(file)),
            Err(_) => Ok(Self {
                file: output.as_fd().try_clone_to_owned()?,
                mode: LineMode::Shared,
            }),
        }
    }

    /// Takes an open file in non-blocking mode.
    pub(super) fn own(file: OwnedFd) -> Self {
        Self {
            file,
            mode: LineMode::NonBlocking,
        }
    }

    /// Writes what can be written without waiting.
    pub(super) fn write_at_once(&self, bytes: &[u8]) -> io::Result<Taken> {
        use rustix::io::Errno;

        if self.mode == LineMode::Shared {
            return Ok(Taken::Nothing);
        }
        loop {
            match rustix::io::write(&self.file, bytes) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(count) => return Ok(Taken::Bytes(count)),
                Err(Errno::AGAIN) => return Ok(Taken::Nothing),
                Err(Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Waits until some of the bytes can be written, and writes those if they are still wanted;
    /// returns their number.
    pub(super) fn write(&self, bytes: &[u8], is_wanted: impl Fn() -> bool) -> io::Result<usize> {
        use rustix::event::{PollFd, PollFlags, poll};
        use rustix::io::Errno;

        let bytes = match self.mode {
            LineMode::NonBlocking => bytes,
            LineMode::Shared => &bytes[..bytes.len().min(Self::SHARED_PIECE)],
        };
        loop {
            match poll(&mut [PollFd::new(&self.file, PollFlags::OUT)], None) {
                Ok(_) | Err(Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
            if !is_wanted() {
                return Ok(0);
            }
            match rustix::io::write(&self.file, bytes) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(count) => return Ok(count),
                Err(Errno::AGAIN | Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Drops what was written and not yet read, as far as the system still holds it.
    pub(super) fn discard(&self) {
        use rustix::termios::{QueueSelector, tcflush};

        // What is not a terminal keeps what it has.
        let _ = tcflush(&self.file, QueueSelector::OFlush);
    }
}

#[cfg(unix)]
fn open_anew(terminal: &io::Stdout) -> rustix::io::Result<OwnedFd> {
    use rustix::fs::{Mode, OFlags, open};

    let name = rustix::termios::ttyname(terminal, Vec::new())?;
    let flags = OFlags::WRONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    open(name, flags, Mode::empty())
}

/// The console, which is written to by the thread that may wait for it.
#[cfg(not(unix))]
#[derive(Debug)]
pub(super) struct Line;

#[cfg(not(unix))]
impl Line {
    pub(super) fn open() -> io::Result<Self> {
        Ok(Self)
    }

    pub(super) fn write_at_once(&self, _bytes: &[u8]) -> io::Result<Taken> {
        Ok(Taken::Nothing)
    }

    pub(super) fn discard(&self) {}

    pub(super) fn write(&self, bytes: &[u8], _: impl Fn() -> bool) -> io::Result<usize> {
        let mut output = io::stdout().lock();
        output.write_all(bytes)?;
        output.flush()?;
        Ok(bytes.len())
    }
}

/// Prints a line to standard error, which may be the terminal; does not wait for one that takes no
/// output.
pub(crate) fn complain(line: String) {
    let (done, printed) = mpsc::channel();
    let print = move || {
        // There is nowhere to report it if that fails.
        let _ = writeln!(io::stderr(), "{line}");
        let _ = done.send(());
    };
    let thread = thread::Builder::new().name("last words".to_owned());
    if thread.spawn(print).is_ok() {
        let _ = printed.recv_timeout(LAST_WORDS);
    }
}

/// Opens the terminal's side that keys come from: standard input, or the controlling terminal
/// where a scene is piped in.
#[cfg(unix)]
pub(super) fn keyboard() -> io::Result<OwnedFd> {
    let input = io::stdin();
    if rustix::termios::isatty(&input) {
        input.as_fd().try_clone_to_owned()
    } else {
        File::open("/dev/tty").map(OwnedFd::from)
    }
}

/// Makes the terminal raw, whatever has changed its modes; one that is raw stays so throughout.
#[cfg(unix)]
pub(super) fn make_raw() -> io::Result<()> {
    use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

    let terminal = keyboard()?;
    let mut modes = tcgetattr(&terminal)?;
    modes.make_raw();
    tcsetattr(&terminal, OptionalActions::Now, &modes)?;
    Ok(())
}

fn known_size(reported: Size, variable: impl Fn(&str) -> Option<u16>) -> Size {
    let known = |reported: u16, name: &str, usual: u16| {
        let reported = Some(reported).filter(|&cells| cells != 0);
        reported
            .or_else(|| variable(name).filter(|&cells| cells != 0))
            .unwrap_or(usual)
    };
    Size {
        width: known(reported.width, "COLUMNS", USUAL.width),
        height: known(reported.height, "LINES", USUAL.height),
    }
}

fn drawn_part(window: Size) -> Size {
    let width = window.width.min(MAX_COLUMNS);
    let rows = MAX_CELLS / u32::from(width);
    Size {
        width,
        height: u32::from(window.height).min(rows) as u16,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_beyond_any_screen_is_drawn_on_in_part() {
        for (window, drawn) in [
            ((1, 1), (1, 1)),
            ((120, 40), (120, 40)),
            ((1, 65_535), (1, 65_535)),
            ((65_535, 1), (2000, 1)),
            ((1000, 1000), (1000, 500)),
            ((65_535, 65_535), (2000, 250)),
        ] {
            assert_eq!(drawn_part(Size::from(window)), Size::from(drawn));
        }
    }

    #[test]
    fn an_unknown_size_comes_from_the_environment_or_is_the_usual_one() {
        for (reported, lines, expected) in [
            ((100, 30), Some(50), (100, 30)),
            ((0, 0), None, (80, 24)),
            ((0, 0), Some(50), (80, 50)),
            ((0, 0), Some(0), (80, 24)),
            ((12, 2), Some(50), (12, 2)),
        ] {
            let variable = |name: &str| if name == "LINES" { lines } else { None };
            let size = known_size(Size::from(reported), variable);
            assert_eq!(
                size,
                Size::from(expected),
                "{reported:?} with LINES {lines:?}"
            );
        }
    }
}
