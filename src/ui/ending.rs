//! How the interface ends, and errors that prevent it from starting.

use std::io;
use std::path::PathBuf;

use crate::assets::NoFolder;
use crate::file::ReadError;
use crate::language::{UnknownLanguage, extensions};
use crate::memory::NoThreads;
use crate::text::Diagnostic;

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
    #[error("{path}: {source}", path = path.display())]
    Frame {
        /// Path of the file.
        path: PathBuf,
        /// Reason.
        source: io::Error,
    },
    /// No thread can be started.
    #[error(transparent)]
    NoThreads(#[from] NoThreads),
    /// Reading from or writing to the terminal failed.
    #[error("terminal: {0}")]
    Terminal(#[from] io::Error),
}
