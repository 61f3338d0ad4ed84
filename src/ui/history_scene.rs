//! Earlier and later texts of the history, and the scenes that they describe.

use std::path::PathBuf;
use std::sync::Arc;

use assets::Wanted;
use document::Timeline;
use scene::{Images, Meshes, Scene};

/// A text of the history whose scene is wanted.
#[derive(Clone, Debug)]
pub struct HistoryText {
    /// Repeated with the scene.
    pub ticket: u64,
    /// The texts of the history.
    pub timeline: Timeline,
    /// Which of them is meant.
    pub at: usize,
    /// The path of the scene, which names of files are relative to.
    pub scene: Option<PathBuf>,
    /// The files of the present text as far as they were read.
    pub files: KnownFiles,
}

/// Files that were read for a text; others are read again.
#[derive(Clone, Debug, Default)]
pub struct KnownFiles {
    /// Their names.
    pub names: Option<Wanted>,
    /// The pictures among them.
    pub images: Images,
    /// The meshes among them.
    pub meshes: Meshes,
}

/// The scene of a text, with the pictures that it names.
#[derive(Clone, Debug)]
pub struct HistoryScene {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The pictures of its textures.
    pub images: Images,
}

/// Why a text has no scene.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum NoPicture {
    /// It has errors.
    Errors,
    /// Something else failed; the reason.
    Failed(String),
}
