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
    pub(super) fn colours(&self) -> ColourDepth {
        ColourDepth::detect(self.colour)
    }

    pub(super) fn watching(&self) -> Method {
        self.poll.map_or(Method::Native, Method::Poll)
    }
}
