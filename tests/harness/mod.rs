//! Drives the real binary on a pseudo-terminal: keys in, screens out.

use std::ffi::OsStr;
use std::io::{Read, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use portable_pty::{Child, CommandBuilder, ExitStatus, MasterPty, PtySize, native_pty_system};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{Mode, OFlags};

/// Nothing takes this long; a test that waits for more has failed.
const WATCHDOG: Duration = Duration::from_secs(30);

/// How often it is asked whether the program has ended.
const POLL: Duration = Duration::from_millis(2);

/// Begins a frame that the terminal is to show only when all of it is there.
pub(crate) const BEGIN_FRAME: &[u8] = b"\x1b[?2026h";
const END_FRAME: &[u8] = b"\x1b[?2026l";

/// Has the whole screen redrawn.
pub(crate) const CTRL_L: &str = "\x0c";

/// A program on a terminal of its own.
pub(crate) struct Session {
    child: Box<dyn Child + Send + Sync>,
    master: Option<Box<dyn MasterPty + Send>>,
    keys: Option<Box<dyn Write + Send>>,
    output: Receiver<(Instant, Vec<u8>)>,
    screen: vt100::Parser,
    /// Whether the terminal waits for the rest of a frame.
    is_amid_frame: bool,
    /// Everything that the program has written.
    pub(crate) written: Vec<u8>,
    termios_before: String,
    /// Whether the output is to be read no longer.
    deaf: Arc<AtomicBool>,
    has_ended: bool,
}

impl Session {
    /// Starts the binary with arguments, in a folder, on a terminal of this size. `environment` is
    /// added to a clean one of a local truecolour terminal.
    pub(crate) fn start<A: AsRef<OsStr>>(
        folder: &Path,
        arguments: &[A],
        size: (u16, u16),
        environment: &[(&str, &str)],
    ) -> Self {
        let mut command = CommandBuilder::new(env!("CARGO_BIN_EXE_halflight"));
        command.args(arguments);
        Self::run(command, folder, size, environment)
    }

    /// Runs a command as [`Session::start`] runs the binary.
    pub(crate) fn run(
        mut command: CommandBuilder,
        folder: &Path,
        (columns, rows): (u16, u16),
        environment: &[(&str, &str)],
    ) -> Self {
        command.cwd(folder);
        command.env_clear();
        command.env("TERM", "xterm-256color");
        command.env("COLORTERM", "truecolor");
        command.env("HOME", folder);
        for (name, value) in environment {
            command.env(name, value);
        }
        let pair = native_pty_system().openpty(size_in_cells(columns, rows));
        let pair = pair.expect("a pseudo-terminal");
        let termios_before = format!("{:?}", pair.master.get_termios());
        let reader = pair.master.try_clone_reader();
        let keys = pair.master.take_writer();
        let child = pair
            .slave
            .spawn_command(command)
            .expect("the command starts");
        let deaf = Arc::new(AtomicBool::new(false));
        Self {
            child,
            output: listen(reader.expect("the terminal can be read"), Arc::clone(&deaf)),
            keys: Some(keys.expect("the terminal can be written")),
            master: Some(pair.master),
            screen: vt100::Parser::new(size_of(rows), size_of(columns), 0),
            is_amid_frame: false,
            written: Vec::new(),
            termios_before,
            deaf,
            has_ended: false,
        }
    }

    /// Types bytes, as the terminal would send them.
    pub(crate) fn send(&mut self, keys: impl AsRef<[u8]>) {
        let writer = self.keys.as_mut().expect("the terminal is there");
        writer
            .write_all(keys.as_ref())
            .expect("the terminal takes keys");
        writer.flush().expect("the terminal takes keys");
    }

    /// Changes the terminal's size.
    pub(crate) fn resize(&mut self, columns: u16, rows: u16) {
        let resized = self.terminal().resize(size_in_cells(columns, rows));
        resized.expect("it takes a size");
        self.screen
            .screen_mut()
            .set_size(size_of(rows), size_of(columns));
    }

    /// Reads on until the screen is as asked; returns when the bytes came that made it so. Panics
    /// with the screen if that does not happen.
    pub(crate) fn wait(&mut self, what: &str, holds: impl Fn(&vt100::Screen) -> bool) -> Instant {
        let mut at = Instant::now();
        let deadline = at + WATCHDOG;
        // Half a frame shows neither what was nor what will be.
        while self.is_amid_frame || !holds(self.screen.screen()) {
            match self.read(deadline.saturating_duration_since(Instant::now())) {
                Some(came) => at = came,
                None => panic!(
                    "{what}: not within {WATCHDOG:?}; the screen:\n{}",
                    self.text()
                ),
            }
        }
        at
    }

    /// Reads on until the screen shows a text.
    pub(crate) fn wait_for(&mut self, text: &str) -> Instant {
        self.wait(&format!("waiting for {text:?}"), |screen| {
            screen.contents().contains(text)
        })
    }

    /// Takes one piece of output, if one comes in time; returns when it came.
    pub(crate) fn read(&mut self, patience: Duration) -> Option<Instant> {
        let (at, chunk) = self.take(patience).ok()?;
        self.screen.process(&chunk);
        Some(at)
    }

    /// Takes one piece of output past the screen, for those who look at it later, and when it came.
    pub(crate) fn take(
        &mut self,
        patience: Duration,
    ) -> Result<(Instant, Vec<u8>), RecvTimeoutError> {
        let (at, chunk) = self.output.recv_timeout(patience)?;
        let new = self.written.len().saturating_sub(BEGIN_FRAME.len() - 1);
        self.written.extend(&chunk);
        let new = &self.written[new..];
        self.is_amid_frame = match (last(BEGIN_FRAME, new), last(END_FRAME, new)) {
            (None, None) => self.is_amid_frame,
            (begin, end) => end < begin,
        };
        Ok((at, chunk))
    }

    /// Takes all output until there is none for a while; returns how many bytes that was.
    pub(crate) fn drain(&mut self, quiet: Duration) -> usize {
        let before = self.written.len();
        while self.read(quiet).is_some() {}
        self.written.len() - before
    }

    /// The screen.
    pub(crate) fn screen(&self) -> &vt100::Screen {
        self.screen.screen()
    }

    /// The screen's characters.
    pub(crate) fn text(&self) -> String {
        self.screen.screen().contents()
    }

    /// The process.
    pub(crate) fn process_id(&self) -> u32 {
        self.child.process_id().expect("it runs")
    }

    /// The process in front, to which keys that stop and interrupt go.
    pub(crate) fn process_in_front(&self) -> u32 {
        let leader = self.terminal().process_group_leader();
        leader.expect("somebody has the terminal").cast_unsigned()
    }

    /// Takes the terminal away, as a lost connection does.
    pub(crate) fn hang_up(&mut self) {
        // The end that is read from is closed too.
        self.stop_reading();
        self.hang_up_at_once();
    }

    /// Takes a terminal away that is not read any more.
    pub(crate) fn hang_up_at_once(&mut self) {
        self.keys = None;
        self.master = None;
    }

    /// Whether there is a terminal still.
    #[allow(dead_code, reason = "most leave it there")]
    pub(crate) fn has_terminal(&self) -> bool {
        self.master.is_some()
    }

    /// Reads on after [`Session::hang`].
    #[allow(dead_code, reason = "not everybody's terminal hangs")]
    pub(crate) fn read_again(&mut self) {
        let reader = self.terminal().try_clone_reader();
        self.deaf = Arc::default();
        self.output = listen(reader.expect("it can be read"), Arc::clone(&self.deaf));
    }

    /// Reads what is left after [`Session::hang`] and the program's end.
    #[allow(dead_code, reason = "not everybody's terminal hangs")]
    pub(crate) fn read_the_rest(&mut self) {
        self.read_again();
        while self.read(WATCHDOG).is_some() {}
    }

    /// Reads no more, as a terminal that hangs, until the program's output finds no room.
    #[allow(dead_code, reason = "not everybody's terminal hangs")]
    pub(crate) fn hang(&mut self) {
        self.stop_reading();
        let name = self.terminal().tty_name().expect("it has a name");
        let open = OFlags::WRONLY | OFlags::NOCTTY | OFlags::CLOEXEC;
        let line = rustix::fs::open(name, open, Mode::empty()).expect("it can be opened");
        let deadline = Instant::now() + WATCHDOG;
        let room = || {
            let at_once = Some(&Timespec::default());
            poll(&mut [PollFd::new(&line, PollFlags::OUT)], at_once) != Ok(0)
        };
        while room() {
            assert!(Instant::now() < deadline, "there is always room");
            self.send(CTRL_L);
            std::thread::sleep(POLL);
        }
    }

    /// Reads one more piece of output and no other.
    fn stop_reading(&mut self) {
        self.deaf.store(true, Ordering::SeqCst);
        self.send(CTRL_L);
        let deadline = Instant::now() + WATCHDOG;
        while self.take(WATCHDOG) != Err(RecvTimeoutError::Disconnected) {
            assert!(Instant::now() < deadline, "nothing was written");
        }
    }

    /// How the program has ended, if it has.
    pub(crate) fn ended(&mut self) -> Option<ExitStatus> {
        let ended = self.child.try_wait();
        ended.expect("a child can be waited for")
    }

    /// Waits for the program's end, and takes all that it wrote.
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
            assert!(now < deadline, "it runs on; the screen:\n{}", self.text());
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

    /// Whether the terminal's settings are those from before the program ran.
    pub(crate) fn has_settings_from_before(&self) -> bool {
        format!("{:?}", self.terminal().get_termios()) == self.termios_before
    }

    /// Asserts that the terminal is as it was before the program ran.
    pub(crate) fn assert_restored(&self) {
        let settings = format!("{:?}", self.terminal().get_termios());
        assert_eq!(settings, self.termios_before);
        let screen = self.screen();
        assert!(!screen.alternate_screen(), "the alternate screen is left");
        assert!(!screen.hide_cursor(), "the cursor is shown");
        assert!(!screen.bracketed_paste(), "bracketed paste is off");
        assert_eq!(screen.mouse_protocol_mode(), vt100::MouseProtocolMode::None);
    }

    fn terminal(&self) -> &dyn MasterPty {
        let master = self.master.as_deref();
        master.expect("the terminal is there")
    }
}

/// The cells of the picture: where each is, its upper pixel and its lower one. A cell whose halves
/// are alike may be drawn in several ways.
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
    /// From 0, at the top.
    pub(crate) row: u16,
    /// From 0, at the left.
    pub(crate) column: u16,
    /// The colour of the upper half.
    pub(crate) upper: vt100::Color,
    /// The colour of the lower half.
    pub(crate) lower: vt100::Color,
}

impl Drop for Session {
    fn drop(&mut self) {
        if !self.has_ended {
            // It may have ended by itself.
            let _ = self.child.kill();
        }
    }
}

/// Reads on a thread, until the terminal is gone or the output is no longer wanted.
fn listen(mut reader: Box<dyn Read + Send>, deaf: Arc<AtomicBool>) -> Receiver<(Instant, Vec<u8>)> {
    let (send, output) = mpsc::channel();
    std::thread::spawn(move || {
        let mut chunk = vec![0; 1 << 16];
        while let Ok(length @ 1..) = reader.read(&mut chunk) {
            let sent = send.send((Instant::now(), chunk[..length].to_vec()));
            if sent.is_err() || deaf.load(Ordering::SeqCst) {
                return;
            }
        }
    });
    output
}

/// Where a text begins for the last time.
pub(crate) fn last(text: &[u8], all: &[u8]) -> Option<usize> {
    all.windows(text.len()).rposition(|part| part == text)
}

fn size_in_cells(columns: u16, rows: u16) -> PtySize {
    PtySize {
        rows,
        cols: columns,
        ..PtySize::default()
    }
}

fn size_of(cells: u16) -> std::num::NonZeroU16 {
    std::num::NonZeroU16::new(cells).expect("a screen has cells")
}
