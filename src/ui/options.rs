//! Options of the interface.

use std::path::PathBuf;
use std::time::Duration;

use super::keymap::Keymap;
use super::pixels::Pixels;
use super::terminal::{Choice, ColourDepth, Mouse};
use super::theme::Theme;
use assets::Up;
use link::Follow;
use scene::Rendering;
use watch::Method;

/// Options of the interface, from the command line and a configuration; `None` selects the default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The scene to open. Default: `default.ray` in the current folder, otherwise the embedded
    /// scene.
    pub scene: Option<PathBuf>,
    /// The axis that points up in meshes opened as scenes. Default: that of their formats' custom.
    pub up: Option<Up>,
    /// Compares file contents at this interval instead of relying on the system's notifications.
    pub poll: Option<Duration>,
    /// Limit of terminal output, in bytes per second; 0 means no limit.
    pub bandwidth: Option<u32>,
    /// The colour depth, or how to detect it.
    pub colour: Option<Choice>,
    /// The colours of everything but pictures.
    pub theme: Option<Theme>,
    /// What pixels of pictures are drawn with.
    pub pixels: Option<Pixels>,
    /// Whether the interface takes the mouse or leaves it to the terminal.
    pub mouse: Option<Mouse>,
    /// The command line of the editor, before that of the environment.
    pub editor: Option<String>,
    /// When the buffers of editors are followed.
    pub follow: Option<Follow>,
    /// What takes precedence over the scene's render settings.
    pub rendering: Rendering,
    /// Number of rendering threads.
    pub threads: Option<usize>,
    /// Folders from which pictures and meshes may be read in addition to the scene's own.
    pub assets: Vec<PathBuf>,
    /// What keys do.
    pub keymap: Keymap,
    /// The lesson to begin or to continue instead of opening a scene.
    pub lesson: Option<LessonChoice>,
    /// Plays keys on a page in memory instead of reading them from a terminal.
    pub rehearsal: Option<Rehearsal>,
}

/// A lesson to begin or to continue.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LessonChoice {
    /// The one that was left last, otherwise the first.
    Continued,
    /// The beginning of the one of this name.
    Begun(String),
}

/// A session without a terminal, whose keys come from a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rehearsal {
    /// The script; `None` presses no key.
    pub keys: Option<PathBuf>,
    /// The size of the screen: columns, rows.
    pub screen: (u16, u16),
    /// Files that the last screen is written to, each in the format of its extension.
    pub frames: Vec<PathBuf>,
}

impl Options {
    /// These options, completed by those of a configuration.
    #[must_use]
    pub fn or(self, configured: Self) -> Self {
        Self {
            scene: self.scene.or(configured.scene),
            up: self.up.or(configured.up),
            poll: self.poll.or(configured.poll),
            bandwidth: self.bandwidth.or(configured.bandwidth),
            colour: self.colour.or(configured.colour),
            theme: self.theme.or(configured.theme),
            pixels: self.pixels.or(configured.pixels),
            mouse: self.mouse.or(configured.mouse),
            editor: self.editor.or(configured.editor),
            follow: self.follow.or(configured.follow),
            rendering: self.rendering.or(configured.rendering),
            threads: self.threads.or(configured.threads),
            assets: [self.assets, configured.assets].concat(),
            // There are no keys on the command line.
            keymap: configured.keymap,
            lesson: self.lesson,
            rehearsal: self.rehearsal.or(configured.rehearsal),
        }
    }

    pub(super) fn colour(&self) -> Choice {
        self.colour.unwrap_or_default()
    }

    pub(super) fn mouse(&self) -> Mouse {
        self.mouse.unwrap_or(Mouse::On)
    }

    pub(super) fn colours(&self) -> ColourDepth {
        match (self.colour(), &self.rehearsal) {
            // A page does not depend on the environment.
            (Choice::Auto, Some(_)) => ColourDepth::TrueColour,
            (choice, _) => ColourDepth::detect(choice),
        }
    }

    pub(super) fn watching(&self) -> Method {
        self.poll.map_or(Method::Native, Method::Poll)
    }
}
