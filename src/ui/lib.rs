//! The terminal: the only room that knows ratatui and crossterm.
//!
//! ```text
//! input, signals, watcher, renderers ──Msg──▶ inbox ──▶ App::update ──Effect──▶ Runtime::perform
//!                                                          │                        │
//!                                                          ▼                        └──Msg──▶ inbox
//!                                                      view::draw ──▶ cells
//! ```
//!
//! There is a single inbox. [`App::update`] is a pure step; effects perform all I/O; drawing only
//! reads the app.
//!
//! | room | what it is for |
//! |---|---|
//! | [`app`] | the state and its steps: what all modes share, and a folder for each mode or page that is a room |
//! | [`keymap`] | what rows of keys say: bindings, help, hints, configuration |
//! | [`view`] | drawing the state |
//! | `shell` | the event loop: inbox, effects, the screen, scripts of keys |
//! | [`service`] | work in the background: reading, writing, comparing, explaining, locating, deriving |
//! | [`recovery`] | unsaved edits, kept for a later run |
//! | [`terminal`] | bytes from and to the terminal |
//! | [`msg`], `event`, [`queue`] | messages and effects; what arrives in the inbox; threads that carry out requests |
//! | [`arrange`], [`layout`], [`listing`], `error_panel`, [`history_layout`] | where things are on screen, for drawing and for the mouse alike |
//! | [`scene_reading`], [`reference`](mod@reference), [`revision`], [`history_scene`], [`located`], [`reel`] | what background work is asked for, and what it answers |
//! | [`doctor`], `options`, `pixels`, `theme`, `text_width` | what was detected and chosen, and text made to fit |

/// A table of cases: in each row, what is given and what is expected of it, as one tuple.
#[cfg(test)]
macro_rules! table {
    ($($($given:expr),+ => $($expected:expr),+;)*) => {
        [$(($($given,)+ $($expected),+)),*]
    };
}

pub mod app;
pub mod arrange;
pub mod doctor;
mod error_panel;
mod event;
mod framing;
pub mod history_layout;
pub mod history_scene;
pub mod keymap;
pub mod layout;
pub mod listing;
pub mod located;
mod matching;
pub mod msg;
mod options;
mod pixels;
pub mod queue;
pub mod recovery;
pub mod reel;
pub mod reference;
pub mod revision;
pub mod scene_reading;
pub mod service;
mod shell;
pub mod terminal;
mod text_width;
mod theme;
pub mod view;

use std::env;
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

use app::tutor::{self, Begun};
use app::{App, Opening, OpeningText, Preferences};
use arrange::PanelSizes;
use assets::{check_folders, is_mesh};
use file::{ReadError, state_folder};
use keymap::Keymap;
use language::Language;
use memory::Need;
pub use options::{LessonChoice, Options, Rehearsal};
pub use pixels::Pixels;
use scene_reading::{Opened, language_of};
use service::{remembering, scene_loader};
pub use shell::ending::{Ending, Error};
use shell::script::Script;
pub use shell::script::parse_screen;
use shell::session;
pub use shell::snapshot::Format as FrameFormat;
pub use theme::Theme;

/// Name of the scene in the current folder that is opened by default.
const DEFAULT_SCENE: &str = "default.ray";

/// A copy of [`DEFAULT_SCENE`], opened if the current folder has none.
const EMBEDDED_SCENE: &str = include_str!("../../scenes/default.ray");

/// Bytes of address space that the interface takes with a small scene, most of them for stacks: with less,
/// threads would not start, or memory run out at any moment.
const NEEDED: u64 = 40 << 20;

/// Runs the interface until the user leaves it. Errors that can be detected without reading the
/// scene file are returned before the terminal is touched; the file is read on another thread.
pub fn run(options: &Options) -> Result<Ending, Error> {
    memory::malloc::map_large();
    memory::check_address_space(Need {
        what: "the interface and a small picture".to_owned(),
        bytes: NEEDED,
    })?;
    memory::start_threads()?;
    let (begun, complaint) = match &options.lesson {
        Some(choice) => begun_lesson(choice),
        None => (None, None),
    };
    let (path, language, text) = match &begun {
        Some(begun) => lesson_scene(begun)?,
        None => find_scene(options.scene.as_deref())?,
    };
    check_folders(&options.assets)?;
    let (screen, script) = match &options.rehearsal {
        Some(rehearsal) => (
            rehearsal.screen,
            Some(read_script(rehearsal, &options.keymap)?),
        ),
        None => (terminal_size()?, None),
    };
    let recent = match (&options.scene, &path) {
        (None, None) if script.is_none() && begun.is_none() => remembering::list(),
        _ => Vec::new(),
    };
    let opening = Opening {
        path,
        language,
        text,
        rendering: options.rendering,
        mouse: options.mouse(),
        preferences: Preferences {
            keymap: options.keymap.clone(),
            theme: options.theme.unwrap_or_default(),
            pixels: options.pixels.unwrap_or_default(),
            panels: match script {
                None => remembering::panels(),
                Some(_) => PanelSizes::default(),
            },
        },
        recent,
        terminal: screen,
    };
    let (mut app, mut effects) = App::open(opening);
    if let Some(begun) = begun {
        effects.extend(tutor::begin(&mut app.tutor, &mut app.shared, &begun));
    }
    if let Some(complaint) = complaint {
        app.shared.overlays.suggest(complaint);
    }
    session::run(options, app, effects, script)
}

/// The names of the lessons.
pub fn lessons() -> impl Iterator<Item = &'static str> {
    tutor::LESSONS.iter().map(|lesson| lesson.name)
}

/// The lesson that was chosen, and a complaint if that is not where it was left.
fn begun_lesson(choice: &LessonChoice) -> (Option<Begun>, Option<&'static str>) {
    const LOST: &str = "Where your lesson was cannot be read: this is the first lesson";
    let named = match choice {
        LessonChoice::Begun(name) => tutor::LESSONS.iter().find(|lesson| lesson.name == name),
        LessonChoice::Continued => None,
    };
    if let Some(lesson) = named {
        return (Some(Begun::at_start(lesson)), None);
    }
    let kept = remembering::lesson();
    let begun = tutor::begun(&kept);
    let is_lost = begun.is_none() && !kept.is_empty();
    let begun = begun.or_else(|| tutor::LESSONS.first().map(Begun::at_start));
    (begun, is_lost.then_some(LOST))
}

/// The scene of a lesson: its file if it was saved and is still there, otherwise what the program carries.
fn lesson_scene(begun: &Begun) -> Result<(Option<PathBuf>, Language, OpeningText), Error> {
    let saved = begun.path.as_deref().filter(|path| path.is_file());
    if let Some(path) = saved.filter(|path| language_of(path) == Ok(begun.scene().language)) {
        return find_scene(Some(path));
    }
    let scene = begun.scene();
    let text = OpeningText::Known(scene.text.to_owned());
    Ok((None, scene.language, text))
}

/// The size of the terminal. Fails if there is none to draw on.
fn terminal_size() -> Result<(u16, u16), Error> {
    if !io::stdout().is_terminal() {
        return Err(Error::NoTerminal);
    }
    if env::var_os("TERM").is_some_and(|term| term == "dumb") {
        return Err(Error::DumbTerminal);
    }
    let size = terminal::size();
    Ok((size.width, size.height))
}

fn read_script(rehearsal: &Rehearsal, keymap: &Keymap) -> Result<Script, Error> {
    let Some(path) = &rehearsal.keys else {
        return Ok(Script::default());
    };
    let (name, text) = (path.display().to_string(), file::read_small_text(path)?);
    Script::parse(name.clone(), text.clone(), keymap).map_err(|errors| Error::Faulty {
        name,
        text,
        errors,
    })
}

/// Finds the scene to open: its path (`None` for the embedded scene), its language and its text.
fn find_scene(named: Option<&Path>) -> Result<(Option<PathBuf>, Language, OpeningText), Error> {
    let path = named.unwrap_or_else(|| Path::new(DEFAULT_SCENE));
    if path.is_dir() {
        return Err(Error::Folder {
            path: path.to_owned(),
        });
    }
    let language = language_of(path).map_err(|unknown| {
        if path.exists() {
            return unknown.into();
        }
        Error::NoSuch {
            path: path.to_owned(),
        }
    })?;
    let error = match file::scene_length(path) {
        Ok(bytes) if is_mesh(path) => {
            let text = OpeningText::AroundMesh(bytes);
            return Ok((Some(path.to_owned()), language, text));
        }
        Ok(bytes) => return Ok((Some(path.to_owned()), language, OpeningText::Unread(bytes))),
        Err(error) => error,
    };
    let is_missing = matches!(error, ReadError::NotFound { .. }) && !is_mesh(path);
    let missing = is_missing
        .then(|| scene_loader::missing(path, language))
        .flatten();
    let text = match (missing, named) {
        (Some(Opened::Kept(text)), _) => OpeningText::Kept(text),
        (Some(Opened::New), Some(_)) => OpeningText::New,
        (_, None) if is_missing => {
            // Edits of a new scene are restored into one.
            let text = match recovery::base_of(None, language) {
                Some(base) if base == language.template() => OpeningText::New,
                _ => OpeningText::Known(EMBEDDED_SCENE.to_owned()),
            };
            return Ok((None, language, text));
        }
        _ => return Err(error.into()),
    };
    Ok((Some(path.to_owned()), language, text))
}

/// A note to print with an error: unsaved edits exist for the scene that cannot be opened.
pub fn note(options: &Options, error: &Error) -> Option<String> {
    let path = options.scene.as_deref();
    let path = path.unwrap_or_else(|| Path::new(DEFAULT_SCENE));
    let state = state_folder::path().ok()?;
    match error {
        Error::Read(ReadError::NotFound { .. }) => recovery::note_for_missing(&state, path),
        Error::Read(_) | Error::Folder { .. } => recovery::note_for_unreadable(&state, path),
        _ => None,
    }
}
