//! The terminal as a file: its size and whole writes.

#[cfg(unix)]
use std::fs::File;
use std::io;
#[cfg(unix)]
use std::os::fd::{AsFd, OwnedFd};

use ratatui::layout::Size;

/// What a terminal that does not know its size is taken for.
const USUAL: Size = Size {
    width: 80,
    height: 24,
};

/// The most cells that are drawn in a row: beyond any screen.
const MAX_COLUMNS: u16 = 2000;

/// The most cells that are drawn. A terminal may say 65535×65535: drawing such a screen would take
/// gigabytes and minutes.
const MAX_CELLS: u32 = 500_000;

/// Returns the size of the window in cells, never zero; of a window beyond any screen, the size of
/// the part at its top left that is drawn on.
///
/// A terminal that says 0×0 does not know; `LINES` and `COLUMNS` do then, or 80×24 it is.
pub(crate) fn size() -> Size {
    let (width, height) = crossterm::terminal::size().unwrap_or((0, 0));
    let variable = |name: &str| std::env::var(name).ok()?.trim().parse().ok();
    drawn_part(known_size(Size { width, height }, variable))
}

/// Writes all of the bytes, in one call to the system if it takes them.
///
/// Waits where another program has left the shared terminal in non-blocking mode, because half a
/// frame is worse than a late one.
#[cfg(unix)]
pub(super) fn write_whole(mut bytes: &[u8]) -> io::Result<()> {
    use rustix::event::{PollFd, PollFlags};
    use rustix::io::Errno;

    let output = io::stdout();
    while !bytes.is_empty() {
        match rustix::io::write(&output, bytes) {
            Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
            Ok(written) => bytes = &bytes[written..],
            Err(Errno::INTR) => {}
            Err(Errno::AGAIN) => {
                match rustix::event::poll(&mut [PollFd::new(&output, PollFlags::OUT)], None) {
                    Ok(_) | Err(Errno::INTR) => {}
                    Err(error) => return Err(error.into()),
                }
            }
            Err(error) => return Err(error.into()),
        }
    }
    Ok(())
}

/// Writes all of the bytes.
#[cfg(not(unix))]
pub(super) fn write_whole(bytes: &[u8]) -> io::Result<()> {
    use std::io::Write;

    let mut output = io::stdout().lock();
    output.write_all(bytes)?;
    output.flush()
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

/// Makes the terminal raw, whoever has changed its modes; one that is raw stays so throughout.
#[cfg(unix)]
pub(super) fn make_raw() -> io::Result<()> {
    use rustix::termios::{OptionalActions, tcgetattr, tcsetattr};

    let terminal = keyboard()?;
    let mut modes = tcgetattr(&terminal)?;
    modes.make_raw();
    tcsetattr(&terminal, OptionalActions::Now, &modes)?;
    Ok(())
}

fn known_size(told: Size, variable: impl Fn(&str) -> Option<u16>) -> Size {
    let known = |told: u16, name: &str, usual: u16| {
        let told = Some(told).filter(|&cells| cells != 0);
        told.or_else(|| variable(name).filter(|&cells| cells != 0))
            .unwrap_or(usual)
    };
    Size {
        width: known(told.width, "COLUMNS", USUAL.width),
        height: known(told.height, "LINES", USUAL.height),
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
        for (told, lines, expected) in [
            ((100, 30), Some(50), (100, 30)),
            ((0, 0), None, (80, 24)),
            ((0, 0), Some(50), (80, 50)),
            ((0, 0), Some(0), (80, 24)),
            ((12, 2), Some(50), (12, 2)),
        ] {
            let variable = |name: &str| if name == "LINES" { lines } else { None };
            let size = known_size(Size::from(told), variable);
            assert_eq!(size, Size::from(expected), "{told:?} with LINES {lines:?}");
        }
    }
}
