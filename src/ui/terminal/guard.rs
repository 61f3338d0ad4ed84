//! The terminal while the interface owns it.
//!
//! Borrowing and giving back are symmetrical and may be repeated. The terminal is given back on
//! every way out, including a panic of the interface's thread.

use std::io;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ratatui::backend::Backend;
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Rect};
use ratatui::terminal::Frame;

use super::abort;
use super::backend::AnsiBackend;
use super::base64;
use super::canvas::{Canvas, Removal, text_over};
use super::colour::ColourDepth;
use super::graphics::{Means, Pixmap};
use super::output::Output;
use super::ownership::{GuardState, Ownership};
use super::query::{self, Question};
use super::reply::ASK_STATUS;
use super::tty::{self, TtyWriter};

/// Alternate screen, hidden cursor, bracketed pastes, no wrapping at the last column.
const ENTER: &str = "\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[?7l";

/// Undoes [`ENTER`] and everything that a frame may leave behind; harmless if repeated.
const LEAVE: &str =
    "\x1b[?2026l\x1b[m\x1b[?1006l\x1b[?1002l\x1b[?1000l\x1b[?7h\x1b[?2004l\x1b[?1049l\x1b[?25h";

/// Presses and drags with unbounded coordinates. Mode 1003 would also report every motion, a flood
/// over a slow line.
const MOUSE_ON: &str = "\x1b[?1000h\x1b[?1002h\x1b[?1006h";
const MOUSE_OFF: &str = "\x1b[?1006l\x1b[?1002l\x1b[?1000l";

/// Reports keys that are ambiguous otherwise in kitty's way: the Esc key, and Alt or Ctrl with a key,
/// together with the character that Shift makes of it. The alternate screen has its own stack of such
/// settings, so that this comes after [`ENTER`] and is taken back before [`LEAVE`].
const KEYS_APART: &str = "\x1b[>5u";

/// Maximum time to give the terminal back; a terminal that is being read needs only a moment.
const PATIENCE: Duration = Duration::from_millis(500);

/// Whether the interface or the terminal handles the mouse; the terminal uses it to select text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mouse {
    /// Presses, drags and the wheel are reported.
    On,
    /// The terminal handles the mouse.
    Off,
}

/// Holds the terminal in raw mode on the alternate screen until dropped.
///
/// Belongs to the thread that created it: a panic there gives the terminal back; a panic elsewhere
/// is kept for [`Terminal::take_panics`].
#[derive(Debug)]
pub struct Terminal {
    screen: ratatui::terminal::Terminal<AnsiBackend>,
    canvas: Canvas,
    shared: Arc<GuardState>,
    mouse: Mouse,
}

impl Terminal {
    /// Takes over the terminal. `cleared` is called on another thread whenever the terminal has
    /// accepted output that was pending.
    pub fn enter(
        colours: ColourDepth,
        mouse: Mouse,
        cleared: impl Fn() + Send + 'static,
    ) -> io::Result<Self> {
        let output = Output::start(TtyWriter::open()?, cleared)?;
        let backend = AnsiBackend::new(colours, tty::size());
        let Ok(screen) = ratatui::terminal::Terminal::new(backend);
        let shared = GuardState::install(output, restore);
        abort::install(&shared, LEAVE)?;
        let mut terminal = Self {
            screen,
            canvas: Canvas::default(),
            shared,
            mouse,
        };
        terminal.reenter()?;
        Ok(terminal)
    }

    /// Whether the terminal is neither lent nor given back.
    pub fn is_ours(&self) -> bool {
        *self.shared.ownership() == Ownership::Ours
    }

    /// Whether the terminal has accepted everything drawn. A frame drawn earlier is only delayed,
    /// because no frame may be skipped.
    pub fn is_clear(&self) -> bool {
        self.shared.output.is_clear()
    }

    /// Draws a frame and sends the differences from the previous one, without waiting for the
    /// terminal. `paint` returns the cells that it has left to `pixmap`, and may be called twice.
    ///
    /// Returns the number of bytes sent: zero if nothing differs or while the terminal is lent.
    pub fn draw(
        &mut self,
        pixmap: Option<&Pixmap>,
        mut paint: impl FnMut(&mut Frame) -> Option<Rect>,
    ) -> io::Result<usize> {
        if !self.is_ours() {
            return Ok(0);
        }
        self.fit();
        let mut painted = self.painted(pixmap, &mut paint);
        let place = painted.as_ref().map(|(place, _)| *place);
        match self.canvas.removal(place.filter(|_| pixmap.is_some())) {
            Removal::None => {}
            Removal::Bytes(bytes) => self.screen.backend_mut().append(bytes.as_bytes()),
            Removal::Repaint => {
                self.screen.backend_mut().discard();
                self.repaint();
                painted = self.painted(pixmap, &mut paint);
            }
        }
        if let (Some((place, over)), Some(pixmap)) = (painted, pixmap)
            && let Some(sending) = self.canvas.sending(place, pixmap, over)?
        {
            let backend = self.screen.backend_mut();
            match sending.at {
                Some(at) => backend.picture(at, &sending.bytes),
                None => backend.precede(&sending.bytes),
            }
            let over = sending.over.iter();
            let Ok(()) = backend.draw(over.map(|(at, cell)| (at.x, at.y, cell)));
        }
        let output = &self.shared.output;
        self.screen.backend_mut().finish(|frame| output.send(frame))
    }

    /// Sends queries, followed by one that ends the answers with
    /// [`Reply::Attributes`](super::Reply). Intended before the first frame, which covers anything
    /// that a terminal without support displays for them.
    pub fn ask(&self, questions: &[Question]) -> io::Result<()> {
        for question in questions {
            self.shared.output.send(question.query())?;
        }
        self.shared.output.send(query::ATTRIBUTES)
    }

    /// Sets how pictures are sent from now on; `None` sends none. The next frame is drawn in full.
    pub fn set_means(&mut self, means: Option<Means>) {
        if let Removal::Bytes(bytes) = self.canvas.removal(None) {
            self.screen.backend_mut().append(bytes.as_bytes());
        }
        self.canvas.means = means;
        self.shared.note_means(means);
        self.repaint();
    }

    /// Uses this colour depth from now on; the next frame is drawn in full.
    pub fn recolour(&mut self, colours: ColourDepth) {
        self.screen.backend_mut().recolour(colours);
        self.repaint();
    }

    /// Draws the next frame in full, regardless of what the screen shows.
    pub fn repaint(&mut self) {
        let size = tty::size();
        self.screen.backend_mut().fit(size);
        self.screen.backend_mut().forget();
        self.canvas.forget();
        // ratatui's own method queries the cursor position; resizing clears without a query.
        let Ok(()) = self.screen.resize(Rect::from((Position::ORIGIN, size)));
    }

    /// Draws a frame into the bytes to send. Returns the cells left to a picture, and those of them
    /// that have text; the others name `pixmap` if it is shown so.
    fn painted(
        &mut self,
        pixmap: Option<&Pixmap>,
        paint: &mut impl FnMut(&mut Frame) -> Option<Rect>,
    ) -> Option<(Rect, Vec<(Position, Cell)>)> {
        let mut painted = None;
        let canvas = &self.canvas;
        let Ok(_) = self.screen.draw(|frame| {
            painted = paint(frame).map(|place| (place, text_over(place, frame.buffer_mut())));
            if let (Some((place, _)), Some(pixmap)) = (&painted, pixmap) {
                canvas.fill(*place, pixmap, frame.buffer_mut());
            }
        });
        painted
    }

    /// Follows the size of the window. A frame of another size begins by erasing the screen.
    fn fit(&mut self) {
        let (size, backend) = (tty::size(), self.screen.backend_mut());
        if backend.size() != Ok(size) {
            backend.fit(size);
            self.canvas.forget();
        }
    }

    /// Lends the terminal to another program; does nothing if the interface does not own it. Fails
    /// if the terminal accepts no output.
    pub fn leave(&mut self) -> io::Result<()> {
        give_back(&self.shared, Ownership::Lent, Instant::now() + PATIENCE)
    }

    /// Gives the terminal back for good, waiting until `deadline` at most.
    pub fn close(self, deadline: Instant) {
        // A terminal that accepts nothing is gone, or nobody sees what it shows.
        let _ = give_back(&self.shared, Ownership::GivenBack, deadline);
    }

    /// Takes the terminal back from another program, or from a shell that changed its modes while
    /// the process was stopped. The next frame is drawn in full.
    pub fn reenter(&mut self) -> io::Result<()> {
        {
            let mut ownership = self.shared.ownership();
            let mut before = "";
            if *ownership == Ownership::Ours {
                before = self.shared.keys_ending();
                // crossterm assumes that raw mode persists once set, and leaving it to set it again
                // would echo keys typed meanwhile.
                tty::make_raw()?;
            } else {
                crossterm::terminal::enable_raw_mode()?;
            }
            *ownership = Ownership::Ours;
            // Whoever had the terminal may have changed the setting of keys.
            for sequence in [ENTER, mouse_sequence(self.mouse), before] {
                self.shared.output.send(sequence.as_bytes())?;
            }
            if self.shared.has_keys_apart() {
                self.shared.output.send(KEYS_APART.as_bytes())?;
            }
        }
        self.repaint();
        Ok(())
    }

    /// Requests [`Reply::Status`](super::Reply), which follows everything sent so far.
    pub fn ask_status(&self) -> io::Result<()> {
        self.shared.output.send(ASK_STATUS.as_bytes())
    }

    /// Lets the terminal keep the Esc key apart from the beginnings of sequences, which it must have
    /// reported that it can.
    pub fn keep_keys_apart(&mut self) -> io::Result<()> {
        if self.shared.has_keys_apart() {
            return Ok(());
        }
        self.shared.note_keys_apart();
        self.send(KEYS_APART)
    }

    /// Takes the mouse or leaves it to the terminal.
    pub fn set_mouse(&mut self, mouse: Mouse) -> io::Result<()> {
        self.mouse = mouse;
        self.send(mouse_sequence(mouse))
    }

    /// Offers text to the terminal's clipboard.
    pub fn copy(&mut self, text: &str) -> io::Result<()> {
        let text = base64::encode(text.as_bytes());
        self.send(&format!("\x1b]52;c;{text}\x1b\\"))
    }

    /// Sends a sequence unless the terminal is lent or given back.
    fn send(&self, sequence: &str) -> io::Result<()> {
        if !self.is_ours() {
            return Ok(());
        }
        self.shared.output.send(sequence.as_bytes())
    }

    /// Records whether the current unsaved edits are stored for recovery, to be reported if the
    /// process aborts.
    pub fn note_kept_edits(&self, are_kept: bool) {
        self.shared.note_kept_edits(are_kept);
    }

    /// Returns the panics of other threads since the last call, escaped for display.
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

/// Gives the terminal back for good. A terminal that cannot be written to is gone and needs no
/// restoring.
fn restore(shared: &GuardState) {
    let _ = give_back(shared, Ownership::GivenBack, Instant::now() + PATIENCE);
}

/// Restores the screen and the modes. Output still pending is dropped: the sequence that restores
/// the screen ends any incomplete one.
fn give_back(shared: &GuardState, to: Ownership, deadline: Instant) -> io::Result<()> {
    let mut ownership = shared.ownership();
    let before = std::mem::replace(&mut *ownership, to);
    if before != Ownership::Ours {
        return Ok(());
    }
    let bytes = [shared.ending(), shared.keys_ending(), LEAVE].concat();
    let written = shared.output.send_last(bytes.as_bytes(), deadline);
    crossterm::terminal::disable_raw_mode()?;
    written
}

const fn mouse_sequence(mouse: Mouse) -> &'static str {
    match mouse {
        Mouse::On => MOUSE_ON,
        Mouse::Off => MOUSE_OFF,
    }
}
