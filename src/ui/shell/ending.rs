//! How the interface ends, and errors that prevent it from starting.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

use assets::NoFolder;
use file::ReadError;
use language::{UnknownLanguage, extensions};
use memory::{NoThreads, OutOfMemory};
use text::Diagnostic;

/// How the interface ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The user quit, by key or command.
    Quit,
    /// It was interrupted by a signal.
    Interrupted,
    /// Another signal requested its end.
    Terminated {
        /// The signal's number, such as 15 for SIGTERM.
        signal: u8,
    },
    /// The terminal is gone.
    HungUp,
}

/// The longest times to wait at the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShutdownDeadlines {
    /// For restoring the terminal.
    pub(super) terminal: Duration,
    /// For files being written.
    pub(super) files: Duration,
    /// For keeping the full-size trace.
    pub(super) trace: Duration,
}

impl Ending {
    /// The longest times to wait. A user who quits may be at the far end of a slow link, but should
    /// not wait a second for a terminal that takes no output; a file being saved gets longer. A
    /// terminal that hung up is not waited for. A trace took up to hours and has up to a gigabyte;
    /// whoever sends a signal may soon end the process in another way.
    pub(super) fn deadlines(self) -> ShutdownDeadlines {
        let (terminal, files, trace) = match self {
            Self::Quit | Self::Interrupted => (700, 2000, 8000),
            Self::Terminated { .. } => (400, 700, 3000),
            Self::HungUp => (100, 700, 8000),
        };
        ShutdownDeadlines {
            terminal: Duration::from_millis(terminal),
            files: Duration::from_millis(files),
            trace: Duration::from_millis(trace),
        }
    }
}

/// Error that ends the interface or prevents it from starting.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene cannot be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The file name extension is not that of a scene language.
    #[error(transparent)]
    UnknownLanguage(#[from] UnknownLanguage),
    /// A folder of assets cannot be read.
    #[error(transparent)]
    Assets(#[from] NoFolder),
    /// The path is a folder.
    #[error("cannot open {path}: it is a folder, not a scene", path = path.display())]
    Folder {
        /// Path of the folder.
        path: PathBuf,
    },
    /// The argument is neither a file nor the name of a scene.
    #[error(
        "no such file or command `{path}`; --help lists the commands, and scenes end in {}",
        extensions(),
        path = path.display()
    )]
    NoSuch {
        /// The argument as given.
        path: PathBuf,
    },
    /// Standard output is not a terminal.
    #[error(
        "the interface needs a terminal; to render a picture, run halflight render SCENE -o FILE"
    )]
    NoTerminal,
    /// The terminal cannot position text.
    #[error(
        "TERM=dumb: the interface needs a terminal with cursor control; if this one has it, set \
         TERM=xterm; to render a picture, run halflight render SCENE -o FILE"
    )]
    DumbTerminal,
    /// A text that the user wrote, such as a script of keys, has errors.
    #[error("{name} has errors")]
    Faulty {
        /// Name of the text's file.
        name: String,
        /// The text.
        text: String,
        /// The errors.
        errors: Vec<Diagnostic>,
    },
    /// A screen cannot be written to a file.
    #[error("cannot write the screen to {path}: {source}", path = path.display())]
    Frame {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        source: io::Error,
    },
    /// No thread can be started.
    #[error(transparent)]
    NoThreads(#[from] NoThreads),
    /// There is too little memory to begin.
    #[error(transparent)]
    NoMemory(#[from] OutOfMemory),
    /// Reading from or writing to the terminal failed.
    #[error("{}", without_terminal(.0))]
    Terminal(#[from] io::Error),
}

/// Why the terminal could not be used. A thread for it that does not start is no fault of the terminal.
fn without_terminal(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::WouldBlock => {
            format!("cannot start threads: {error}; see the limits that ulimit -a shows")
        }
        _ => format!("terminal: {error}"),
    }
}
