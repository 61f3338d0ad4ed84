//! The terminal while it is ours.
//!
//! Borrowing and giving back are symmetrical and may be repeated; giving back happens on every
//! way out, a panic of the interface's thread included.

use std::io;
use std::sync::Arc;

use ratatui::Frame;
use ratatui::layout::{Position, Rect};

use super::backend::AnsiBackend;
use super::colour::ColourDepth;
use super::panics::{self, Shared, Tenure};
use super::tty;

/// Alternate screen, no cursor, pastes in brackets, no wrapping at the last column.
const ENTER: &str = "\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[?7l";

/// Undoes [`ENTER`] and everything a frame may have left behind, and is harmless when repeated.
const LEAVE: &str =
    "\x1b[?2026l\x1b[m\x1b[?1006l\x1b[?1002l\x1b[?1000l\x1b[?7h\x1b[?2004l\x1b[?1049l\x1b[?25h";

/// Presses and drags in coordinates without bounds. Mode 1003 would report every motion too, a
/// flood over a slow line.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1002h\x1b[?1006h";
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1002l\x1b[?1000l";

/// Whether the mouse is ours or the terminal's own, as for selecting text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mouse {
    /// Presses, drags and the wheel are reported.
    On,
    /// The terminal keeps the mouse.
    Off,
}

/// Holds the terminal in raw mode on the alternate screen until it is dropped.
///
/// Belongs to the thread that made it: a panic there gives the terminal back, a panic elsewhere
/// is kept for [`Terminal::take_panics`].
#[derive(Debug)]
pub struct Terminal {
    screen: ratatui::Terminal<AnsiBackend>,
    shared: Arc<Shared>,
    mouse: Mouse,
}

impl Terminal {
    /// Takes the terminal over.
    pub fn enter(colours: ColourDepth, mouse: Mouse) -> io::Result<Self> {
        let backend = AnsiBackend::new(colours, tty::size());
        let Ok(screen) = ratatui::Terminal::new(backend);
        let mut terminal = Self {
            screen,
            shared: Shared::install(restore),
            mouse,
        };
        terminal.reenter()?;
        Ok(terminal)
    }

    /// Draws a frame and writes what differs from the last one, in one piece.
    ///
    /// Returns the number of bytes written: none at all when nothing differs or while the
    /// terminal is lent.
    pub fn draw(&mut self, paint: impl FnOnce(&mut Frame)) -> io::Result<usize> {
        if *self.shared.tenure() != Tenure::Ours {
            return Ok(0);
        }
        self.screen.backend_mut().fit(tty::size());
        let Ok(_) = self.screen.draw(paint);
        self.screen.backend_mut().finish(tty::write_whole)
    }

    /// Makes the next frame a whole one, whatever the screen shows now.
    pub fn repaint(&mut self) {
        let size = tty::size();
        self.screen.backend_mut().fit(size);
        self.screen.backend_mut().forget();
        // ratatui's own way asks the terminal where its cursor is; resizing clears without.
        let Ok(()) = self.screen.resize(Rect::from((Position::ORIGIN, size)));
    }

    /// Lends the terminal to another program; does nothing if it is not ours.
    pub fn leave(&mut self) -> io::Result<()> {
        give_back(&self.shared, Tenure::Lent)
    }

    /// Takes the terminal back, from another program or from a shell that changed its modes while
    /// we were stopped. The next frame is a whole one.
    pub fn reenter(&mut self) -> io::Result<()> {
        {
            let mut tenure = self.shared.tenure();
            if *tenure == Tenure::Ours {
                // crossterm takes raw mode for granted once it has set it, and giving it up to set
                // it again would echo what is typed meanwhile.
                #[cfg(unix)]
                tty::make_raw()?;
            } else {
                crossterm::terminal::enable_raw_mode()?;
            }
            // Asking is what turns escape sequences on in a Windows console.
            #[cfg(windows)]
            let _ = crossterm::ansi_support::supports_ansi();
            *tenure = Tenure::Ours;
            tty::write_whole(ENTER.as_bytes())?;
            tty::write_whole(mouse_sequence(self.mouse).as_bytes())?;
        }
        self.repaint();
        Ok(())
    }

    /// Takes the mouse or leaves it to the terminal.
    pub fn set_mouse(&mut self, mouse: Mouse) -> io::Result<()> {
        self.mouse = mouse;
        if *self.shared.tenure() != Tenure::Ours {
            return Ok(());
        }
        tty::write_whole(mouse_sequence(mouse).as_bytes())
    }

    /// Returns the panics of other threads since the last call, fit to be shown.
    pub fn take_panics(&self) -> Vec<String> {
        self.shared.take_panics()
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        restore(&self.shared);
        for panic in self.take_panics() {
            panics::tell(&panic);
        }
    }
}

/// Gives the terminal back for good. A terminal that cannot be written to is gone, and nothing is
/// left to restore.
fn restore(shared: &Shared) {
    let _ = give_back(shared, Tenure::GivenBack);
}

fn give_back(shared: &Shared, to: Tenure) -> io::Result<()> {
    let mut tenure = shared.tenure();
    let before = std::mem::replace(&mut *tenure, to);
    if before != Tenure::Ours {
        return Ok(());
    }
    let written = tty::write_whole(LEAVE.as_bytes());
    crossterm::terminal::disable_raw_mode()?;
    written
}

const fn mouse_sequence(mouse: Mouse) -> &'static str {
    match mouse {
        Mouse::On => MOUSE_ON,
        Mouse::Off => MOUSE_OFF,
    }
}
