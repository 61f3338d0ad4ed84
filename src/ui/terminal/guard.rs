//! The terminal while it is ours.
//!
//! Borrowing and giving back are symmetrical and may be repeated; giving back happens on every
//! way out, a panic of the interface's thread included.

use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ratatui::Frame;
use ratatui::layout::{Position, Rect};

#[cfg(unix)]
use super::abort;
use super::backend::AnsiBackend;
use super::colour::ColourDepth;
use super::output::Output;
use super::panics::{Shared, Tenure};
use super::query;
use super::reply::ASK_STATUS;
use super::tty::{self, Line};

/// Alternate screen, no cursor, pastes in brackets, no wrapping at the last column.
const ENTER: &str = "\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[?7l";

/// Undoes [`ENTER`] and everything a frame may have left behind, and is harmless when repeated.
const LEAVE: &str =
    "\x1b[?2026l\x1b[m\x1b[?1006l\x1b[?1002l\x1b[?1000l\x1b[?7h\x1b[?2004l\x1b[?1049l\x1b[?25h";

/// Presses and drags in coordinates without bounds. Mode 1003 would report every motion too, a
/// flood over a slow line.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1002h\x1b[?1006h";
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1002l\x1b[?1000l";

/// How long a terminal may take to be given back. One that is read takes a moment.
const PATIENCE: Duration = Duration::from_millis(500);

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
    /// Takes the terminal over. `cleared` is called on another thread whenever the terminal has
    /// taken what it did not take at once.
    pub fn enter(
        colours: ColourDepth,
        mouse: Mouse,
        cleared: impl Fn() + Send + 'static,
    ) -> io::Result<Self> {
        let output = Output::start(Line::open()?, cleared)?;
        let backend = AnsiBackend::new(colours, tty::size());
        let Ok(screen) = ratatui::Terminal::new(backend);
        let shared = Shared::install(output, restore);
        #[cfg(unix)]
        abort::install(&shared, LEAVE)?;
        let mut terminal = Self {
            screen,
            shared,
            mouse,
        };
        terminal.reenter()?;
        Ok(terminal)
    }

    /// Whether the terminal is neither lent nor given back.
    pub fn is_ours(&self) -> bool {
        *self.shared.tenure() == Tenure::Ours
    }

    /// Whether the terminal has taken all that was drawn. A frame that is drawn before is the
    /// later, as none may be left out.
    pub fn is_clear(&self) -> bool {
        self.shared.output().is_clear()
    }

    /// Draws a frame and sends what differs from the last one, without waiting for the terminal.
    ///
    /// Returns the number of bytes sent: none at all when nothing differs or while the terminal
    /// is lent.
    pub fn draw(&mut self, paint: impl FnOnce(&mut Frame)) -> io::Result<usize> {
        if !self.is_ours() {
            return Ok(0);
        }
        self.screen.backend_mut().fit(tty::size());
        let Ok(_) = self.screen.draw(paint);
        let output = self.shared.output();
        self.screen.backend_mut().finish(|frame| output.send(frame))
    }

    /// Asks for the colours that the terminal has, and for [`Reply::Attributes`](super::Reply) behind
    /// them. Meant for before the first frame, which covers
    /// what a terminal that does not understand makes of the question.
    pub fn ask_for_colours(&self) -> io::Result<()> {
        let output = self.shared.output();
        output.send(query::COLOURS)?;
        output.send(query::ATTRIBUTES)
    }

    /// Draws with so many colours from here on; the next frame is a whole one.
    pub fn recolour(&mut self, colours: ColourDepth) {
        self.screen.backend_mut().recolour(colours);
        self.repaint();
    }

    /// Makes the next frame a whole one, whatever the screen shows now.
    pub fn repaint(&mut self) {
        let size = tty::size();
        self.screen.backend_mut().fit(size);
        self.screen.backend_mut().forget();
        // ratatui's own way asks the terminal where its cursor is; resizing clears without.
        let Ok(()) = self.screen.resize(Rect::from((Position::ORIGIN, size)));
    }

    /// Lends the terminal to another program; does nothing if it is not ours. Fails where the
    /// terminal takes no output.
    pub fn leave(&mut self) -> io::Result<()> {
        give_back(&self.shared, Tenure::Lent, Instant::now() + PATIENCE)
    }

    /// Gives the terminal back for good, until `deadline` at most.
    pub fn close(self, deadline: Instant) {
        // A terminal that takes nothing is gone, or shows nothing to anybody.
        let _ = give_back(&self.shared, Tenure::GivenBack, deadline);
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
            let output = self.shared.output();
            output.send(ENTER.as_bytes())?;
            output.send(mouse_sequence(self.mouse).as_bytes())?;
        }
        self.repaint();
        Ok(())
    }

    /// Asks for [`Reply::Status`](super::Reply), behind all that was sent.
    pub fn ask_status(&self) -> io::Result<()> {
        self.shared.output().send(ASK_STATUS.as_bytes())
    }

    /// Takes the mouse or leaves it to the terminal.
    pub fn set_mouse(&mut self, mouse: Mouse) -> io::Result<()> {
        self.mouse = mouse;
        if !self.is_ours() {
            return Ok(());
        }
        self.shared.output().send(mouse_sequence(mouse).as_bytes())
    }

    /// Notes whether unsaved edits as they are now would outlive the process, to be said if it is
    /// aborted.
    pub fn note_kept_edits(&self, are_kept: bool) {
        self.shared.note_kept_edits(are_kept);
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
            tty::complain(panic);
        }
    }
}

/// Gives the terminal back for good. A terminal that cannot be written to is gone, and nothing is
/// left to restore.
fn restore(shared: &Shared) {
    let _ = give_back(shared, Tenure::GivenBack, Instant::now() + PATIENCE);
}

/// Restores the screen and the modes. What was drawn last is dropped if it still waits: the sequence
/// that restores the screen ends any that is left incomplete.
fn give_back(shared: &Shared, to: Tenure, deadline: Instant) -> io::Result<()> {
    let mut tenure = shared.tenure();
    let before = std::mem::replace(&mut *tenure, to);
    if before != Tenure::Ours {
        return Ok(());
    }
    let written = shared.output().send_last(LEAVE.as_bytes(), deadline);
    crossterm::terminal::disable_raw_mode()?;
    written
}

const fn mouse_sequence(mouse: Mouse) -> &'static str {
    match mouse {
        Mouse::On => MOUSE_ON,
        Mouse::Off => MOUSE_OFF,
    }
}
