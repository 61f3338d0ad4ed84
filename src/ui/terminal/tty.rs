//! The terminal as a file: size, modes, and writes that wait for a limited time.

use std::fs::File;
use std::io::{self, Write};
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::net::UnixStream;
use std::sync::mpsc;
use std::time::Duration;

use ratatui::layout::Size;

use crate::queue::spawn;

/// Size assumed for a terminal that does not know its own.
const USUAL: Size = Size {
    width: 80,
    height: 24,
};

/// Maximum number of columns drawn, more than any screen has.
const MAX_COLUMNS: u16 = 2000;

/// Maximum number of cells drawn. A terminal may report 65535×65535: drawing such a screen would
/// take gigabytes and minutes.
const MAX_CELLS: u32 = 500_000;

/// Maximum time to write a line to standard error.
const LAST_WORDS: Duration = Duration::from_millis(200);

/// Returns the size of the window in cells, never zero. For a window larger than any screen, this
/// is the part at the top left that is drawn.
///
/// A terminal that reports 0×0 does not know its size; then `LINES` and `COLUMNS` count, otherwise
/// 80×24.
pub(crate) fn size() -> Size {
    let (width, height) = crossterm::terminal::size().unwrap_or((0, 0));
    let variable = |name: &str| std::env::var(name).ok()?.trim().parse().ok();
    drawn_part(known_size(Size { width, height }, variable))
}

/// The size of a cell in pixels, width and height, if the system knows it.
pub(crate) fn cell_size() -> Option<(u16, u16)> {
    let window = crossterm::terminal::window_size().ok()?;
    let width = window.width.checked_div(window.columns)?;
    let height = window.height.checked_div(window.rows)?;
    (0 < width && 0 < height).then_some((width, height))
}

/// The output side of the terminal.
#[derive(Debug)]
pub(super) struct TtyWriter {
    file: OwnedFd,
    /// Whether the open file is shared with other programs, so that its mode must not change and
    /// writes may block.
    is_shared: bool,
}

impl TtyWriter {
    /// Maximum size of a write to a shared file, which blocks until the terminal has accepted all
    /// of it.
    const SHARED_PIECE: usize = 1 << 12;

    /// Reopens the terminal of standard output by its name, to have a file mode of its own. Shares
    /// standard output if that fails, for example on another user's terminal.
    pub(super) fn open() -> io::Result<Self> {
        let output = io::stdout();
        match open_anew(&output) {
            Ok(file) => Ok(Self::own(file)),
            Err(_) => Ok(Self {
                file: output.as_fd().try_clone_to_owned()?,
                is_shared: true,
            }),
        }
    }

    /// Takes an open file in non-blocking mode.
    pub(super) fn own(file: OwnedFd) -> Self {
        Self {
            file,
            is_shared: false,
        }
    }

    /// Writes as much as possible without waiting; returns the number of bytes accepted, 0 if the
    /// terminal accepts nothing now.
    pub(super) fn write_at_once(&self, bytes: &[u8]) -> io::Result<usize> {
        use rustix::io::Errno;

        if self.is_shared {
            return Ok(0);
        }
        loop {
            match rustix::io::write(&self.file, bytes) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(count) => return Ok(count),
                Err(Errno::AGAIN) => return Ok(0),
                Err(Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Waits until some of the bytes can be written, and writes them if `permit` returns a permit
    /// then, which is held during the write; returns the number of bytes written.
    pub(super) fn write<P>(
        &self,
        bytes: &[u8],
        permit: impl Fn() -> Option<P>,
    ) -> io::Result<usize> {
        use rustix::event::{PollFd, PollFlags, poll};
        use rustix::io::Errno;

        let most = if self.is_shared {
            Self::SHARED_PIECE
        } else {
            bytes.len()
        };
        let bytes = &bytes[..bytes.len().min(most)];
        loop {
            match poll(&mut [PollFd::new(&self.file, PollFlags::OUT)], None) {
                Ok(_) | Err(Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
            let Some(_permit) = permit() else {
                return Ok(0);
            };
            match rustix::io::write(&self.file, bytes) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(count) => return Ok(count),
                Err(Errno::AGAIN | Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
        }
    }

    /// Discards bytes that are written but not yet read, as far as the system still buffers them.
    pub(super) fn discard(&self) {
        use rustix::termios::{QueueSelector, tcflush};

        // Anything other than a terminal keeps its contents.
        let _ = tcflush(&self.file, QueueSelector::OFlush);
    }
}

fn open_anew(terminal: &io::Stdout) -> rustix::io::Result<OwnedFd> {
    use rustix::fs::{Mode, OFlags, open};

    let name = rustix::termios::ttyname(terminal, Vec::new())?;
    let flags = OFlags::WRONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
    open(name, flags, Mode::empty())
}

/// Prints a line to standard error, which may be the terminal; does not wait for one that accepts
/// no output.
pub(crate) fn complain(line: String) {
    let (done, printed) = mpsc::channel();
    let print = move || {
        // A failure cannot be reported anywhere.
        let _ = writeln!(io::stderr(), "{line}");
        let _ = done.send(());
    };
    if spawn("last words", print).is_ok() {
        let _ = printed.recv_timeout(LAST_WORDS);
    }
}

/// Opens the input side of the terminal: standard input, or the controlling terminal if a scene is
/// piped in.
pub(super) fn keyboard() -> io::Result<OwnedFd> {
    let input = io::stdin();
    if rustix::termios::isatty(&input) {
        input.as_fd().try_clone_to_owned()
    } else {
        File::open("/dev/tty").map(OwnedFd::from)
    }
}

/// Reads what has arrived on a stream that does not block, and forgets it.
pub(super) fn drain(mut stream: &UnixStream) {
    use std::io::Read;

    while stream.read(&mut [0; 64]).is_ok_and(|bytes| bytes != 0) {}
}

/// Makes the terminal raw, regardless of how its modes were changed. A raw terminal stays raw
/// throughout.
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
        let mut known = [Some(reported), variable(name)].into_iter().flatten();
        known.find(|&cells| cells != 0).unwrap_or(usual)
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
    fn only_part_of_an_oversized_window_is_drawn() {
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
    fn an_unknown_size_comes_from_the_environment_or_defaults() {
        for (reported, lines, expected) in [
            ((100, 30), Some(50), (100, 30)),
            ((0, 0), None, (80, 24)),
            ((0, 0), Some(50), (80, 50)),
            ((0, 0), Some(0), (80, 24)),
            ((12, 2), Some(50), (12, 2)),
        ] {
            let variable = |name: &str| if name == "LINES" { lines } else { None };
            let size = known_size(Size::from(reported), variable);
            assert_eq!(size, Size::from(expected), "{reported:?} {lines:?}");
        }
    }
}
