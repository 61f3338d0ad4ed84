//! A sequence to export: the frames of a track over a text.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use file::Version;
use image_file::{ImageFormat, MovieFormat, Pattern, known_extensions};
use language::Language;
use render::{Aov, Progress};
use scene::{Camera, Rendering, Size};
use track::Track;

/// A sequence to export.
#[derive(Clone, Debug)]
pub struct Reel {
    /// The language of the text.
    pub language: Language,
    /// The text of the scene, without a frame of the track.
    pub text: Arc<String>,
    /// The path of the scene, which names of files are relative to; empty without one.
    pub scene: PathBuf,
    /// The track.
    pub track: Track,
    /// What the frames are written as.
    pub form: ReelForm,
    /// How they are traced.
    pub shot: Shot,
    /// The versions of the pictures that this session wrote, by path.
    pub written: HashMap<PathBuf, Version>,
}

/// What frames are written as.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ReelForm {
    /// One file.
    Movie(MovieFormat),
    /// A picture file each.
    Pictures(Pattern, ImageFormat),
}

/// How the frames of a sequence are traced.
#[derive(Clone, Debug, PartialEq)]
pub struct Shot {
    /// What takes precedence over the scene's render settings.
    pub rendering: Rendering,
    /// What they show instead of light.
    pub aov: Option<Aov>,
    /// The working view, if it differs from the scene's.
    pub view: Option<Camera>,
    /// The size; the scene's if `None`.
    pub size: Option<Size>,
    /// The samples per pixel; those of the settings if `None`.
    pub spp: Option<u32>,
}

/// How far an export of a sequence is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReelProgress {
    /// The number of the frame that is traced.
    pub frame: u32,
    /// The number of frames.
    pub count: u32,
    /// Progress of the frame.
    pub traced: Progress,
}

impl ReelForm {
    /// What a sequence is written as by the name of its file; the error says how to name one.
    pub fn of_path(path: &Path) -> Result<Self, String> {
        let name = path.display();
        match (Pattern::of(path), MovieFormat::of_path(path)) {
            (Ok(pattern), _) => match ImageFormat::of_path(path) {
                Some(format) => Ok(Self::Pictures(pattern, format)),
                None => Err(format!(
                    "{name}: picture files end in {}",
                    known_extensions()
                )),
            },
            (Err(_), Some(format)) => Ok(Self::Movie(format)),
            (Err(reason), None) => Err(format!("{name} {reason}")),
        }
    }
}

impl ReelProgress {
    /// The frame that is traced, counted from 1, of how many: `2/48`.
    pub fn place(&self) -> String {
        format!("{}/{}", self.frame.saturating_add(1), self.count)
    }

    /// The share of all frames that is done, 0 to 1.
    pub fn done(&self) -> f64 {
        (f64::from(self.frame) + self.traced.done) / f64::from(self.count.max(1))
    }
}

/// Why a picture of this name cannot be exported outside of SEQUENCE mode, if it names a sequence.
pub(super) fn names_sequence(path: &Path, play: &str) -> Option<String> {
    let extension = path.extension();
    let is_gif = extension.is_some_and(|extension| extension.eq_ignore_ascii_case("gif"));
    let form = ReelForm::of_path(path).ok()?;
    let is_pattern = matches!(form, ReelForm::Pictures(..));
    let name = path.display();
    (is_pattern || !is_gif).then(|| format!("{name} names a sequence: press {play}, then :export"))
}
