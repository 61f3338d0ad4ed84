//! The terminal: the only room that knows ratatui and crossterm.
//!
//! ```text
//! input, signals, watcher, renderers ──Msg──▶ inbox ──▶ App::update ──Effect──▶ World::perform
//!                                                          │                        │
//!                                                          ▼                        └──Msg──▶ inbox
//!                                                      view::draw ──▶ cells
//! ```
//!
//! One inbox. [`App::update`] is a pure step; effects do what touches the world; drawing reads the
//! app and nothing else.

pub mod app;
mod assets;
mod beginning;
pub mod doctor;
mod editor;
mod effects;
mod freeing;
mod heap;
pub mod keymap;
pub mod msg;
pub mod reading;
pub mod recovery;
mod session;
pub mod terminal;
pub mod view;
mod writing;

use std::env;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::assets::{NoFolder, check_folders};
use crate::file::{self, ReadError};
use crate::language::{self, Language, UnknownLanguage};
use crate::render::{DEFAULT_SPP, Filter};
use crate::scene::Integrator;
use crate::watch::Method;
use app::{App, Opening, OpeningText, Quality};
use terminal::{Choice, ColourDepth, Mouse};

/// The scene that is opened without a name, if the current folder has one.
const DEFAULT_SCENE: &str = "default.ray";

/// The scene that is opened where there is no other: a copy of [`DEFAULT_SCENE`].
const EMBEDDED_SCENE: &str = include_str!("../../scenes/default.ray");

/// What the user asked of the interface; `None` leaves the choice to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The scene to open; without one `default.ray` of the current folder, or else a built-in one.
    pub scene: Option<PathBuf>,
    /// Compare the file's content at this interval instead of waiting for the system's notices.
    pub poll: Option<Duration>,
    /// Bytes a second that may be sent to the terminal; 0 means no limit.
    pub bandwidth: Option<u32>,
    /// The colours to use.
    pub colour: Choice,
    /// Whether the mouse is taken from the terminal.
    pub mouse: Mouse,
    /// Samples a pixel.
    pub spp: Option<u32>,
    /// Bounces.
    pub depth: Option<u32>,
    /// How light is gathered at first.
    pub integrator: Option<Integrator>,
    /// What pixels of full-size traces and of exports are filtered by.
    pub filter: Filter,
    /// Threads that trace.
    pub threads: Option<usize>,
    /// Folders that pictures and meshes may be read from besides the scene's surroundings.
    pub assets: Vec<PathBuf>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            scene: None,
            poll: None,
            bandwidth: None,
            colour: Choice::Auto,
            mouse: Mouse::On,
            spp: None,
            depth: None,
            integrator: None,
            filter: Filter::Box,
            threads: None,
            assets: Vec::new(),
        }
    }
}

impl Options {
    fn colours(&self) -> ColourDepth {
        ColourDepth::detect(self.colour)
    }

    fn watching(&self) -> Method {
        self.poll.map_or(Method::Native, Method::Poll)
    }
}

/// How the interface ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// The user left it.
    Quit,
    /// It was interrupted from outside.
    Interrupted,
    /// Another signal asked it to end.
    Terminated {
        /// The signal's number.
        signal: u8,
    },
    /// The terminal is gone.
    HungUp,
}

/// Why the interface could not be opened, or ended.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The scene can't be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A file that is not a scene by its name.
    #[error(transparent)]
    UnknownLanguage(#[from] UnknownLanguage),
    /// A folder to read from can't be read.
    #[error(transparent)]
    Assets(#[from] NoFolder),
    /// A folder.
    #[error("{path}: is a folder, not a scene", path = path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
    },
    /// Neither a file nor, by its name, a scene.
    #[error(
        "no such file or command `{path}`; the commands are render, check and doctor, scenes end in .ray, .dat or .xml",
        path = path.display()
    )]
    NoSuch {
        /// The argument.
        path: PathBuf,
    },
    /// Standard output goes elsewhere.
    #[error("the interface needs a terminal; to make a picture: halflight render SCENE -o FILE")]
    NoTerminal,
    /// A terminal that cannot place text.
    #[error(
        "TERM=dumb: the interface needs a terminal that can move its cursor; if this one can, set \
         TERM, such as to xterm; to make a picture: halflight render SCENE -o FILE"
    )]
    DumbTerminal,
    /// The terminal can't be used.
    #[error("terminal: {0}")]
    Terminal(#[from] io::Error),
}

/// Opens the interface and stays until the user leaves it. Errors that show without reading the
/// scene's file are returned before the terminal is touched; the file is read beside the interface.
pub fn run(options: &Options) -> Result<Ending, Error> {
    heap::map_large();
    let (path, language, text) = find_scene(options.scene.as_deref())?;
    check_folders(&options.assets)?;
    if !io::stdout().is_terminal() {
        return Err(Error::NoTerminal);
    }
    if env::var_os("TERM").is_some_and(|term| term == "dumb") {
        return Err(Error::DumbTerminal);
    }
    let size = terminal::size();
    let opening = Opening {
        path,
        language,
        text,
        quality: Quality {
            spp: options.spp.unwrap_or(DEFAULT_SPP),
            depth: options.depth,
            integrator: options.integrator,
            filter: options.filter,
        },
        mouse: options.mouse,
        terminal: (size.width, size.height),
    };
    let (app, effects) = App::open(opening);
    session::run(options, app, effects)
}

/// The scene to open: its path, unless it is the built-in one, its language and its text.
fn find_scene(named: Option<&Path>) -> Result<(Option<PathBuf>, Language, OpeningText), Error> {
    let path = named.unwrap_or_else(|| Path::new(DEFAULT_SCENE));
    if path.is_dir() {
        return Err(Error::Folder {
            path: path.to_owned(),
        });
    }
    let language = Language::of_path(path).map_err(|unknown| {
        if path.exists() {
            return unknown.into();
        }
        Error::NoSuch {
            path: path.to_owned(),
        }
    })?;
    let error = match file::scene_length(path) {
        Ok(bytes) => return Ok((Some(path.to_owned()), language, OpeningText::Unread(bytes))),
        Err(error) => error,
    };
    let is_missing = matches!(error, ReadError::NotFound { .. });
    let kept = || recovery::base_of(path, language).filter(|text| fits(language, text));
    if let Some(text) = is_missing.then(kept).flatten() {
        return Ok((Some(path.to_owned()), language, OpeningText::Kept(text)));
    }
    if is_missing && named.is_none() {
        let text = EMBEDDED_SCENE.to_owned();
        return Ok((None, language, OpeningText::Known(text)));
    }
    Err(error.into())
}

fn fits(language: Language, text: &str) -> bool {
    language::fits(language, text, text.len()).is_ok()
}

/// What is to be said besides an error: that edits are kept of the scene that can't be opened.
pub fn note(options: &Options, error: &Error) -> Option<String> {
    let path = options.scene.as_deref();
    let path = path.unwrap_or_else(|| Path::new(DEFAULT_SCENE));
    match error {
        Error::Read(error) => recovery::note(path, matches!(error, ReadError::NotFound { .. })),
        Error::Folder { .. } => recovery::note(path, false),
        _ => None,
    }
}
