//! Drives the real binary on a pseudo-terminal: sends keys and reads screens.

pub(crate) mod terminal;

use std::ffi::OsStr;
use std::fs::File;
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use rustix::fs::{Mode, OFlags};
use rustix::io::Errno;

use terminal::Terminal;

/// Nothing takes this long; a test that waits longer has failed.
const WATCHDOG: Duration = Duration::from_secs(30);

/// Interval between checks of whether the program has ended.
const POLL: Duration = Duration::from_millis(2);

/// Begins a frame that the terminal shows only once it is complete (synchronized output).
pub(crate) const BEGIN_FRAME: &[u8] = b"\x1b[?2026h";
const END_FRAME: &[u8] = b"\x1b[?2026l";

/// Makes the program redraw the whole screen.
pub(crate) const CTRL_L: &str = "\x0c";

/// A program on its own pseudo-terminal.
pub(crate) struct Session {
    child: Child,
    terminal: Option<Terminal>,
    keys: Option<File>,
    output: Receiver<(Instant, Vec<u8>)>,
    screen: vt100::Parser,
    /// Whether the output so far ends within a frame.
    is_in_frame: bool,
    /// Everything that the program has written.
    pub(crate) written: Vec<u8>,
    settings_before: String,
    /// Tells the reading thread to stop.
    stop: Arc<AtomicBool>,
    has_ended: bool,
}

impl Session {
    /// Starts the binary with arguments, in a folder, on a terminal of this size (columns, rows).
    /// `environment` is added to the clean environment of a local truecolour terminal.
    pub(crate) fn start<A: AsRef<OsStr>>(
        folder: &Path,
        arguments: &[A],
        size: (u16, u16),
        environment: &[(&str, &str)],
    ) -> Self {
        let mut command = Command::new(env!("CARGO_BIN_EXE_halflight"));
        command.args(arguments);
        Self::run(command, folder, size, environment)
    }

    /// Runs a command like [`Session::start`] runs the binary.
    pub(crate) fn run(
        mut command: Command,
        folder: &Path,
        (columns, rows): (u16, u16),
        environment: &[(&str, &str)],
    ) -> Self {
        command.current_dir(folder);
        command.env_clear();
        command.env("TERM", "xterm-256color");
        command.env("COLORTERM", "truecolor");
        command.env("HOME", folder);
        for (name, value) in environment {
            command.env(name, value);
        }
        let (terminal, line) = Terminal::open(columns, rows).expect("a pseudo-terminal");
        let settings_before = settings(&terminal);
        let handle = || terminal.handle().expect("a handle of the terminal");
        let stop = Arc::new(AtomicBool::new(false));
        Self {
            child: terminal::start(command, line).expect("the command starts"),
            output: listen(handle(), Arc::clone(&stop)),
            keys: Some(handle()),
            terminal: Some(terminal),
            screen: vt100::Parser::new(size_of(rows), size_of(columns), 0),
            is_in_frame: false,
            written: Vec::new(),
            settings_before,
            stop,
            has_ended: false,
        }
    }

    /// Sends bytes as if typed.
    pub(crate) fn send(&mut self, keys: impl AsRef<[u8]>) {
        let writer = self.keys.as_mut().expect("the terminal exists");
        writer
            .write_all(keys.as_ref())
            .expect("the terminal takes keys");
    }

    /// Types these bytes over and over on another thread, as fast as the program takes them, until
    /// it ends. Nothing else can be sent.
    #[allow(dead_code, reason = "not every test needs it")]
    pub(crate) fn flood(&mut self, keys: &'static [u8]) {
        let mut writer = self.keys.take().expect("the terminal exists");
        std::thread::spawn(move || while writer.write_all(keys).is_ok() {});
    }

    /// Resizes the terminal.
    pub(crate) fn resize(&mut self, columns: u16, rows: u16) {
        let resized = self.terminal().resize(columns, rows);
        resized.expect("the terminal can be resized");
        self.screen
            .screen_mut()
            .set_size(size_of(rows), size_of(columns));
    }

    /// Reads until a condition on the screen holds; returns when the bytes that made it hold
    /// arrived. Panics with the screen on timeout.
    pub(crate) fn wait(&mut self, what: &str, holds: impl Fn(&vt100::Screen) -> bool) -> Instant {
        let mut at = Instant::now();
        let deadline = at + WATCHDOG;
        // Half a frame is neither the old screen nor the new one.
        while self.is_in_frame || !holds(self.screen.screen()) {
            match self.read(deadline.saturating_duration_since(Instant::now())) {
                Some(arrival) => at = arrival,
                None => panic!(
                    "{what}: not within {WATCHDOG:?}; the screen:\n{}",
                    self.text()
                ),
            }
        }
        at
    }

    /// Reads until the screen shows a text; returns when its bytes arrived.
    pub(crate) fn wait_for(&mut self, text: &str) -> Instant {
        self.wait(&format!("waiting for {text:?}"), |screen| {
            screen.contents().contains(text)
        })
    }

    /// Reads one chunk of output, if one arrives in time; returns its time of arrival.
    pub(crate) fn read(&mut self, patience: Duration) -> Option<Instant> {
        let (at, chunk) = self.take(patience).ok()?;
        self.screen.process(&chunk);
        Some(at)
    }

    /// Takes one chunk of output with its time of arrival, without updating the screen.
    pub(crate) fn take(
        &mut self,
        patience: Duration,
    ) -> Result<(Instant, Vec<u8>), RecvTimeoutError> {
        let (at, chunk) = self.output.recv_timeout(patience)?;
        let new = self.written.len().saturating_sub(BEGIN_FRAME.len() - 1);
        self.written.extend(&chunk);
        let new = &self.written[new..];
        self.is_in_frame = match (last(BEGIN_FRAME, new), last(END_FRAME, new)) {
            (None, None) => self.is_in_frame,
            (begin, end) => end < begin,
        };
        Ok((at, chunk))
    }

    /// Reads all output until there is none for `quiet`; returns the number of bytes.
    pub(crate) fn drain(&mut self, quiet: Duration) -> usize {
        let before = self.written.len();
        while self.read(quiet).is_some() {}
        self.written.len() - before
    }

    /// The screen.
    pub(crate) fn screen(&self) -> &vt100::Screen {
        self.screen.screen()
    }

    /// The characters on the screen.
    pub(crate) fn text(&self) -> String {
        self.screen.screen().contents()
    }

    /// The ID of the program's process.
    pub(crate) fn process_id(&self) -> u32 {
        self.child.id()
    }

    /// The leader of the foreground process group, which receives the stop and interrupt keys.
    pub(crate) fn process_in_front(&self) -> u32 {
        let leader = self.terminal().process_in_front();
        let leader = leader.expect("a foreground group");
        leader.as_raw_nonzero().get().cast_unsigned()
    }

    /// Closes the terminal, like a lost connection.
    pub(crate) fn hang_up(&mut self) {
        // The reader must be closed too.
        self.stop_reading();
        self.hang_up_at_once();
    }

    /// Closes a terminal that is no longer read.
    pub(crate) fn hang_up_at_once(&mut self) {
        self.keys = None;
        self.terminal = None;
    }

    /// Whether the terminal still exists.
    #[allow(dead_code, reason = "not every test needs it")]
    pub(crate) fn has_terminal(&self) -> bool {
        self.terminal.is_some()
    }

    /// Resumes reading after [`Session::hang`].
    #[allow(dead_code, reason = "not every test needs it")]
    pub(crate) fn read_again(&mut self) {
        let handle = self.terminal().handle();
        self.stop = Arc::default();
        self.output = listen(handle.expect("it can be read"), Arc::clone(&self.stop));
    }

    /// Reads the remaining output after [`Session::hang`] and the end of the program.
    #[allow(dead_code, reason = "not every test needs it")]
    pub(crate) fn read_the_rest(&mut self) {
        self.read_again();
        while self.read(WATCHDOG).is_some() {}
    }

    /// Stops reading, like a terminal that hangs, with a full output buffer.
    ///
    /// The program alone might leave room: a writer that waits is woken by the last read, possibly
    /// before the system has moved bytes to make room, and not again afterwards.
    #[allow(dead_code, reason = "not every test needs it")]
    pub(crate) fn hang(&mut self) {
        self.stop_reading();
        let name = self.terminal().name().expect("a name");
        let open = OFlags::WRONLY | OFlags::NONBLOCK | OFlags::NOCTTY | OFlags::CLOEXEC;
        let line = rustix::fs::open(name, open, Mode::empty()).expect("it can be opened");
        // Terminals ignore NULs.
        let full = loop {
            if let Err(error) = rustix::io::write(&line, &[0; 1 << 10]) {
                break error;
            }
        };
        assert_eq!(full, Errno::AGAIN);
        self.send(CTRL_L);
    }

    /// Stops the reading thread, which ends after one more chunk of output.
    fn stop_reading(&mut self) {
        self.stop.store(true, Ordering::SeqCst);
        self.send(CTRL_L);
        let deadline = Instant::now() + WATCHDOG;
        while self.take(WATCHDOG) != Err(RecvTimeoutError::Disconnected) {
            assert!(Instant::now() < deadline, "nothing was written");
        }
    }

    /// The exit status of the program, if it has ended.
    pub(crate) fn ended(&mut self) -> Option<ExitStatus> {
        let ended = self.child.try_wait();
        ended.expect("a child can be waited for")
    }

    /// Waits for the end of the program and reads all its output.
    pub(crate) fn end(&mut self) -> ExitStatus {
        let deadline = Instant::now() + WATCHDOG;
        let mut is_open = true;
        loop {
            if let Some(status) = self.ended() {
                self.has_ended = true;
                while self.read(WATCHDOG).is_some() {}
                return status;
            }
            let now = Instant::now();
            assert!(now < deadline, "timeout; the screen:\n{}", self.text());
            if is_open {
                match self.take(POLL) {
                    Ok((_, chunk)) => self.screen.process(&chunk),
                    Err(RecvTimeoutError::Timeout) => {}
                    Err(RecvTimeoutError::Disconnected) => is_open = false,
                }
            } else {
                std::thread::sleep(POLL);
            }
        }
    }

    /// Whether the terminal's settings are the same as before the program ran.
    pub(crate) fn has_settings_from_before(&self) -> bool {
        settings(self.terminal()) == self.settings_before
    }

    /// Asserts that the terminal is in the same state as before the program ran.
    pub(crate) fn assert_restored(&self) {
        assert_eq!(settings(self.terminal()), self.settings_before);
        let screen = self.screen();
        assert!(!screen.alternate_screen(), "still on the alternate screen");
        assert!(!screen.hide_cursor(), "the cursor is hidden");
        assert!(!screen.bracketed_paste(), "bracketed paste is on");
        assert_eq!(screen.mouse_protocol_mode(), vt100::MouseProtocolMode::None);
    }

    fn terminal(&self) -> &Terminal {
        self.terminal.as_ref().expect("the terminal exists")
    }
}

/// The cells of the picture with their positions and pixels. A cell whose halves are equal may be
/// drawn in several ways.
pub(crate) fn picture(screen: &vt100::Screen) -> Vec<Pixels> {
    let (rows, columns) = screen.size();
    (0..rows.get())
        .flat_map(|row| (0..columns.get()).map(move |column| (row, column)))
        .filter_map(|(row, column)| {
            let cell = screen.cell(row, column)?;
            let (upper, lower) = match cell.contents() {
                "▀" => (cell.fgcolor(), cell.bgcolor()),
                "▄" => (cell.bgcolor(), cell.fgcolor()),
                "█" => (cell.fgcolor(), cell.fgcolor()),
                " " if cell.bgcolor() != vt100::Color::Default => (cell.bgcolor(), cell.bgcolor()),
                _ => return None,
            };
            Some(Pixels {
                row,
                column,
                upper,
                lower,
            })
        })
        .collect()
}

/// A cell with two pixels of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pixels {
    /// Row, from 0 at the top.
    pub(crate) row: u16,
    /// Column, from 0 at the left.
    pub(crate) column: u16,
    /// The colour of the upper half.
    pub(crate) upper: vt100::Color,
    /// The colour of the lower half.
    pub(crate) lower: vt100::Color,
}

impl Drop for Session {
    fn drop(&mut self) {
        if !self.has_ended {
            // It may already have ended.
            let _ = self.child.kill();
            let _ = self.child.wait();
        }
    }
}

/// Reads on a thread until the terminal is closed or `stop` is set.
fn listen(mut reader: File, stop: Arc<AtomicBool>) -> Receiver<(Instant, Vec<u8>)> {
    let (send, output) = mpsc::channel();
    std::thread::spawn(move || {
        let mut chunk = vec![0; 1 << 16];
        while let Ok(length @ 1..) = reader.read(&mut chunk) {
            let sent = send.send((Instant::now(), chunk[..length].to_vec()));
            if sent.is_err() || stop.load(Ordering::SeqCst) {
                return;
            }
        }
    });
    output
}

/// The start of the last occurrence of `text` in `all`.
pub(crate) fn last(text: &[u8], all: &[u8]) -> Option<usize> {
    all.windows(text.len()).rposition(|part| part == text)
}

/// The settings of a terminal, to be compared.
fn settings(terminal: &Terminal) -> String {
    format!(
        "{:?}",
        terminal.settings().expect("a terminal has settings")
    )
}

fn size_of(cells: u16) -> std::num::NonZeroU16 {
    std::num::NonZeroU16::new(cells).expect("a screen has cells")
}
