//! What the interface is drawn on: a terminal, or a page in memory for scripts of keys.

use std::io;
use std::sync::mpsc::Sender;
use std::time::Instant;

use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::terminal::Frame;

use super::tty_session::TtySession;
use crate::event::Event;
use crate::options::Options;
use crate::terminal::Pixmap;

/// The screen of a session.
pub(super) enum Screen {
    /// The terminal of the process.
    TtySession(Box<TtySession>),
    /// Cells in memory, which nobody watches: everything drawn is taken at once.
    Page(ratatui::terminal::Terminal<TestBackend>),
}

impl Screen {
    /// The screen that the options ask for.
    pub(super) fn new(options: &Options, sender: &Sender<Event>) -> io::Result<Self> {
        if let Some(rehearsal) = &options.rehearsal {
            let (columns, rows) = rehearsal.screen;
            let Ok(page) = ratatui::terminal::Terminal::new(TestBackend::new(columns, rows));
            return Ok(Self::Page(page));
        }
        let tty = TtySession::enter(options, sender)?;
        Ok(Self::TtySession(Box::new(tty)))
    }

    /// Whether everything drawn was taken, so that the next frame may be drawn.
    pub(super) fn is_clear(&self) -> bool {
        match self {
            Self::TtySession(tty) => tty.terminal.is_clear(),
            Self::Page(_) => true,
        }
    }

    /// Whether it is a terminal, lent or not.
    pub(super) fn is_terminal(&self) -> bool {
        matches!(self, Self::TtySession(_))
    }

    /// Whether there is a terminal that is not lent to another program.
    pub(super) fn has_terminal(&self) -> bool {
        matches!(self, Self::TtySession(tty) if tty.terminal.is_ours())
    }

    /// Draws a frame; returns the number of bytes sent to the terminal. `paint` returns the cells
    /// that it has left to `pixmap`, and may be called twice. On a page nothing is left to one.
    pub(super) fn draw(
        &mut self,
        pixmap: Option<&Pixmap>,
        mut paint: impl FnMut(&mut Frame) -> Option<Rect>,
    ) -> io::Result<usize> {
        match self {
            Self::TtySession(tty) => tty.terminal.draw(pixmap, paint),
            Self::Page(page) => {
                let Ok(_) = page.draw(|frame| {
                    paint(frame);
                });
                Ok(0)
            }
        }
    }

    /// The cells on a page; `None` on a terminal.
    pub(super) fn cells(&self) -> Option<&Buffer> {
        match self {
            Self::TtySession(_) => None,
            Self::Page(page) => Some(page.backend().buffer()),
        }
    }

    /// Gives a page another size. A terminal is resized by its user.
    pub(super) fn resize(&mut self, (columns, rows): (u16, u16)) {
        if let Self::Page(page) = self {
            page.backend_mut().resize(columns, rows);
        }
    }

    /// The terminal with its keyboard; `None` on a page.
    pub(super) fn tty(&mut self) -> Option<&mut TtySession> {
        match self {
            Self::TtySession(tty) => Some(tty),
            Self::Page(_) => None,
        }
    }

    /// The terminal with its keyboard, to be lent to others. Fails on a page.
    pub(super) fn lendable(&mut self) -> io::Result<&mut TtySession> {
        let reason = "there is none while keys come from a script";
        self.tty().ok_or_else(|| io::Error::other(reason))
    }

    /// Restores the terminal, waiting until `deadline` at most.
    pub(super) fn close(self, deadline: Instant) {
        if let Self::TtySession(tty) = self {
            tty.close(deadline);
        }
    }
}
