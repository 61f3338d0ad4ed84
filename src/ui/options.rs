//! Options of the interface.

use std::path::PathBuf;
use std::time::Duration;

use super::terminal::{Choice, ColourDepth, Mouse};
use crate::render::Filter;
use crate::scene::Integrator;
use crate::watch::Method;

/// Command-line options of the interface; `None` selects the default.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Options {
    /// The scene to open. Default: `default.ray` in the current folder, otherwise the embedded
    /// scene.
    pub scene: Option<PathBuf>,
    /// Compares file contents at this interval instead of relying on the system's notifications.
    pub poll: Option<Duration>,
    /// Limit of terminal output, in bytes per second; 0 means no limit.
    pub bandwidth: Option<u32>,
    /// The colour depth, or how to detect it.
    pub colour: Choice,
    /// Whether the mouse is taken from the terminal.
    pub mouse: Mouse,
    /// Samples per pixel of full-size traces and exports.
    pub spp: Option<u32>,
    /// Maximum number of bounces.
    pub depth: Option<u32>,
    /// The integrator to start with; `None` leaves the choice to the scene.
    pub integrator: Option<Integrator>,
    /// Reconstruction filter of full-size traces and exports.
    pub filter: Filter,
    /// Number of rendering threads.
    pub threads: Option<usize>,
    /// Folders from which pictures and meshes may be read in addition to the scene's own.
    pub assets: Vec<PathBuf>,
    /// Plays keys on a page in memory instead of reading them from a terminal.
    pub rehearsal: Option<Rehearsal>,
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
            rehearsal: None,
        }
    }
}

impl Options {
    pub(super) fn colours(&self) -> ColourDepth {
        match (self.colour, &self.rehearsal) {
            // A page does not depend on the environment.
            (Choice::Auto, Some(_)) => ColourDepth::TrueColour,
            (choice, _) => ColourDepth::detect(choice),
        }
    }

    pub(super) fn watching(&self) -> Method {
        self.poll.map_or(Method::Native, Method::Poll)
    }
}
