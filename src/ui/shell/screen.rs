//! What the interface is drawn on: a terminal, or a page in memory for scripts of keys.

use std::io;
use std::sync::mpsc::Sender;
use std::time::Instant;

use ratatui::Frame;
use ratatui::backend::TestBackend;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::tty_session::TtySession;
use crate::ui::event::Event;
use crate::ui::msg::Msg;
use crate::ui::options::Options;
use crate::ui::terminal::query::Question;
use crate::ui::terminal::{ColourDepth, Means, Mouse, Pixmap};

/// The screen of a session.
pub(super) enum Screen {
    /// The terminal of the process.
    TtySession(Box<TtySession>),
    /// Cells in memory, which nobody watches: everything drawn is taken at once.
    Page(ratatui::Terminal<TestBackend>),
}

impl Screen {
    /// The screen that the options ask for.
    pub(super) fn new(options: &Options, sender: &Sender<Event>) -> io::Result<Self> {
        if let Some(rehearsal) = &options.rehearsal {
            let (columns, rows) = rehearsal.screen;
            let Ok(page) = ratatui::Terminal::new(TestBackend::new(columns, rows));
            return Ok(Self::Page(page));
        }
        let console = TtySession::enter(options, sender)?;
        Ok(Self::TtySession(Box::new(console)))
    }

    /// Whether everything drawn was taken, so that the next frame may be drawn.
    pub(super) fn is_clear(&self) -> bool {
        match self {
            Self::TtySession(console) => console.is_clear(),
            Self::Page(_) => true,
        }
    }

    /// Whether it is a terminal, lent or not.
    pub(super) fn is_terminal(&self) -> bool {
        matches!(self, Self::TtySession(_))
    }

    /// Whether there is a terminal that is not lent to another program.
    pub(super) fn has_terminal(&self) -> bool {
        matches!(self, Self::TtySession(console) if console.is_ours())
    }

    /// Draws a frame; returns the number of bytes sent to the terminal. `paint` returns the cells
    /// that it has left to `pixmap`, and may be called twice. On a page nothing is left to one.
    pub(super) fn draw(
        &mut self,
        pixmap: Option<&Pixmap>,
        mut paint: impl FnMut(&mut Frame) -> Option<Rect>,
    ) -> io::Result<usize> {
        match self {
            Self::TtySession(console) => console.terminal().draw(pixmap, paint),
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

    /// The next signal that has arrived.
    pub(super) fn next_signal(&self) -> Option<Msg> {
        self.console().and_then(TtySession::next_signal)
    }

    /// Lets the terminal keep keys apart from the beginnings of sequences.
    pub(super) fn keep_keys_apart(&mut self) -> io::Result<()> {
        match self {
            Self::TtySession(console) => console.terminal().keep_keys_apart(),
            Self::Page(_) => Ok(()),
        }
    }

    /// Queries the terminal. Any answers arrive as [`Event::Replied`].
    pub(super) fn ask(&self, questions: &[Question]) -> io::Result<()> {
        let console = self.console();
        console.map_or(Ok(()), |console| console.ask(questions))
    }

    /// Sets how pictures are sent from now on; `None` sends none.
    pub(super) fn set_means(&mut self, means: Option<Means>) {
        if let Self::TtySession(console) = self {
            console.terminal().set_means(means);
        }
    }

    /// Requests a status reply, which arrives after everything sent so far.
    pub(super) fn ask_status(&self) -> io::Result<()> {
        self.console().map_or(Ok(()), TtySession::ask_status)
    }

    /// Stops expecting answers to queries.
    pub(super) fn give_up_answers(&self) {
        if let Some(console) = self.console() {
            console.give_up_answers();
        }
    }

    /// Stops expecting status replies.
    pub(super) fn give_up_replies(&self) {
        if let Some(console) = self.console() {
            console.give_up_replies();
        }
    }

    /// Uses this colour depth from now on.
    pub(super) fn recolour(&mut self, depth: ColourDepth) {
        if let Self::TtySession(console) = self {
            console.terminal().recolour(depth);
        }
    }

    /// Draws the next frame in full.
    pub(super) fn repaint(&mut self) {
        if let Self::TtySession(console) = self {
            console.terminal().repaint();
        }
    }

    /// Takes the mouse or leaves it to the terminal.
    pub(super) fn set_mouse(&mut self, mouse: Mouse) -> io::Result<()> {
        match self {
            Self::TtySession(console) => console.terminal().set_mouse(mouse),
            Self::Page(_) => Ok(()),
        }
    }

    /// Offers text to the terminal's clipboard.
    pub(super) fn copy(&mut self, text: &str) -> io::Result<()> {
        match self {
            Self::TtySession(console) => console.terminal().copy(text),
            Self::Page(_) => Ok(()),
        }
    }

    /// Records whether the current unsaved edits are stored for recovery.
    pub(super) fn note_kept_edits(&mut self, are_kept: bool) {
        if let Self::TtySession(console) = self {
            console.terminal().note_kept_edits(are_kept);
        }
    }

    /// Returns the panics of other threads since the last call.
    pub(super) fn take_panics(&mut self) -> Vec<String> {
        match self {
            Self::TtySession(console) => console.terminal().take_panics(),
            Self::Page(_) => Vec::new(),
        }
    }

    /// Runs another program on the terminal; the inner result is the program's.
    pub(super) fn lend<T>(&mut self, run: impl FnOnce() -> T) -> io::Result<T> {
        match self {
            Self::TtySession(console) => console.lend(run),
            Self::Page(_) => Err(no_terminal()),
        }
    }

    /// Takes the terminal back from another program.
    pub(super) fn take(&mut self) -> io::Result<()> {
        match self {
            Self::TtySession(console) => console.take(),
            Self::Page(_) => Ok(()),
        }
    }

    /// Stops the process until it is continued.
    pub(super) fn suspend(&mut self) -> io::Result<()> {
        match self {
            Self::TtySession(console) => console.suspend(),
            Self::Page(_) => Err(no_terminal()),
        }
    }

    /// Restores the terminal, waiting until `deadline` at most.
    pub(super) fn close(self, deadline: Instant) {
        if let Self::TtySession(console) = self {
            console.close(deadline);
        }
    }

    fn console(&self) -> Option<&TtySession> {
        match self {
            Self::TtySession(console) => Some(console),
            Self::Page(_) => None,
        }
    }
}

fn no_terminal() -> io::Error {
    io::Error::other("there is none while keys come from a script")
}
