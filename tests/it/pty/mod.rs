//! The interface on a terminal, from the first key to the restored screen.

mod buffers;
mod editing;
mod endings;
mod journals;
mod looks;
mod opening;
mod pixels;
mod traces;
mod typed;

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::os::unix::process::ExitStatusExt;
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use tempfile::TempDir;
use vt100::{Color, MouseProtocolMode, Screen};

use crate::harness::{BEGIN_FRAME, CTRL_L, Pixels, Session, last, picture};

/// Two balls lit only by ambient light, so that their pixels have their own colours. Comments that begin
/// with backslashes keep no column, so that an edit changes nothing but its number.
const BALLS: &str = "\
1 1 1
1 0 9 0 0 0 0
2
sphere -1 0 0 .80  1 0 0  0 0 0  0 0 0  1 0 0 1  \\\\ the red one
sphere  1 0 0 0.8  0 1 0  0 0 0  0 0 0  1 0 0 1  \\\\ the green one
// view: eye 0 0 8 target 0 0 0 up 0 1 0 fov 40 size 80 60
";

const RED: Color = Color::Rgb(255, 0, 0);
const GREEN: Color = Color::Rgb(0, 255, 0);
const BLUE: Color = Color::Rgb(0, 0, 255);

/// Keys that set the first ball's radius to 2, from the initial state.
const RADIUS_TO_2: &str = "\rj2\r";

const DEFAULT: &str = include_str!("../../../scenes/default.ray");

const ENTER: &str = "\r";
const ESC: &str = "\x1b";
const CTRL_C: &str = "\x03";
const CTRL_Z: &str = "\x1a";

/// Enters the alternate screen, which only the program uses.
const ENTER_SCREEN: &[u8] = b"\x1b[?1049h";

/// A directory with a scene in `balls.ray`.
struct Place {
    directory: TempDir,
}

impl Place {
    fn new() -> Self {
        let directory = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
        let place = Self { directory };
        place.write("balls.ray", BALLS);
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.directory.path().join(name)
    }

    fn write(&self, name: &str, content: &str) {
        fs::write(self.at(name), content).expect("written");
    }

    /// Replaces a file atomically, like most editors.
    fn replace(&self, name: &str, content: &str) {
        self.write("new~", content);
        fs::rename(self.at("new~"), self.at(name)).expect("renamed");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.at(name)).expect("a text")
    }

    fn start(&self, arguments: &[&str], size: (u16, u16)) -> Session {
        let arguments = [&["--color", "24"], arguments].concat();
        Session::start(self.directory.path(), &arguments, size, &[])
    }

    /// Opens `balls.ray` and waits for its finished picture.
    fn open(&self) -> Session {
        let mut session = self.start(&["balls.ray"], WIDE);
        wait_for_rest(&mut session);
        session
    }

    /// Opens `balls.ray` and changes a number.
    fn open_edited(&self) -> Session {
        let mut session = self.open();
        session.send(RADIUS_TO_2);
        session.wait_for("balls.ray [+]");
        session
    }

    /// The recovery files.
    fn recovery_files(&self) -> Vec<PathBuf> {
        let folder = self.at(".local/state/halflight/recovery");
        let entries = fs::read_dir(folder).into_iter().flatten();
        entries
            .map(|entry| entry.expect("an entry").path())
            .filter(|path| path.extension().is_some_and(|extension| extension == "ray"))
            .collect()
    }
}

impl Place {
    /// The text after the last edit of each journal.
    fn kept_texts(&self) -> Vec<String> {
        let journals = self.recovery_files().into_iter();
        let texts = journals.filter_map(|journal| {
            let content = fs::read_to_string(journal).ok()?;
            let edits = content.match_indices("\nedit ");
            // An incomplete edit at the end does not count.
            let whole = edits.filter_map(|(at, _)| {
                let (line, below) = content[at + 1..].split_once('\n')?;
                let length: usize = line.split(' ').nth(3)?.parse().ok()?;
                let text = below.get(..length)?;
                below[length..].starts_with('\n').then(|| text.to_owned())
            });
            whole.last()
        });
        texts.collect()
    }
}

/// Printed at the end if unsaved edits are stored for recovery.
const KEPT: &str = "unsaved edits are kept; run halflight balls.ray to restore them";

/// Wide enough for long messages beside the file name.
const WIDE: (u16, u16) = (150, 40);

/// The scene after [`RADIUS_TO_2`].
fn edited() -> String {
    BALLS.replacen(".80", "2", 1)
}

fn is_at_rest(screen: &Screen) -> bool {
    !picture(screen).is_empty()
        && screen.contents().contains("64 spp")
        && !screen.contents().contains("pass ")
}

/// Waits until the picture is finished.
fn wait_for_rest(session: &mut Session) {
    session.wait("waiting for the finished picture", is_at_rest);
}

/// Waits until a finished picture contains a colour; returns a cell with it.
fn wait_for_colour(session: &mut Session, colour: Color) -> Pixels {
    let find = |screen: &Screen| picture(screen).into_iter().find(|p| p.upper == colour);
    session.wait(&format!("waiting for {colour:?}"), |screen| {
        is_at_rest(screen) && find(screen).is_some()
    });
    find(session.screen()).expect("it was just there")
}

/// Waits until a finished picture differs from another one.
fn wait_for_change(session: &mut Session, from: &[Pixels]) {
    session.wait("waiting for another picture", |screen| {
        is_at_rest(screen) && picture(screen) != from
    });
}

fn wait_until_gone(session: &mut Session, text: &str) {
    session.wait(&format!("waiting for {text:?} to go"), |screen| {
        !screen.contents().contains(text)
    });
}

fn kill(process: u32, signal: Signal) {
    let process = Pid::from_raw(process.cast_signed()).expect("a process");
    kill_process(process, signal).expect("it can be sent signals");
}

/// Quits and asserts that the terminal is restored.
fn quit(mut session: Session) {
    session.send("q");
    assert_end(session, 0);
}

fn assert_end(session: Session, code: i32) {
    assert_end_with(session, code, "");
}

/// Asserts the exit code, and that the screen contains only these words.
fn assert_end_with(mut session: Session, code: i32, words: &str) {
    let status = session.end();
    session.assert_restored();
    assert_eq!(session.text().trim_end(), words);
    assert_eq!((status.code(), status.signal()), (Some(code), None));
}
