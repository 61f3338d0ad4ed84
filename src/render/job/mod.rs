//! What a renderer is asked to trace.

mod aov;
mod region;
mod settings;
pub(crate) mod settings_text;

#[cfg(test)]
pub(crate) use aov::AOVS;
pub use aov::Aov;
pub use region::{NoRegion, Region};
pub use settings::Settings;
pub(crate) use settings_text::{SAMPLES, aov_name, aov_of, is_added};

use std::sync::Arc;
use std::time::Duration;

use scene::{Camera, Images, Scene};

/// Marks a pixel without an object in [`Frame::objects`](super::Frame::objects).
pub const NO_OBJECT: u32 = u32::MAX;

/// When a job is complete with fewer samples than its settings ask for: always after a whole pass,
/// so that the picture is the one with that many samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The time for the job: a pass that would exceed it, judging by those before, is not begun.
    Time(Duration),
    /// The [`Progress::noise`](crate::Progress::noise) below which the picture is good enough.
    Noise(f64),
}

/// Which frames of a job contain pixels. All contain the progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Frames {
    /// Every frame, with [`Frame::values`](crate::Frame::values), for a picture watched while it is traced.
    Live,
    /// Only the last, complete frame.
    Last,
    /// Only the last frame, with [`Frame::values`](crate::Frame::values).
    LastWithValues,
}

/// A picture to trace.
#[derive(Clone, Debug)]
pub struct Job {
    /// The scene.
    pub scene: Arc<Scene>,
    /// The images of its textures.
    pub images: Images,
    /// The scene's own camera, or the working view.
    pub camera: Camera,
    /// Render settings.
    pub settings: Settings,
    /// When to stop earlier, if ever.
    pub limit: Option<Limit>,
    /// Which frames contain pixels.
    pub frames: Frames,
    /// Whether to reduce noise of light: in [`Frame::denoised`](crate::Frame::denoised) of live frames, and otherwise in
    /// the pixels and values of the last frame themselves.
    pub denoise: bool,
    /// What frames call the objects of the scene, by index; `None` calls them by their indices. A
    /// scene with a part of another's objects is shown as that one.
    pub numbers: Option<Arc<[u32]>>,
}

/// Whether the noise of pictures of this can be reduced.
pub fn can_denoise(aov: Option<Aov>) -> bool {
    aov.is_none_or(Aov::is_share)
}

impl Job {
    /// Whether its pixels are denoised: AOVs of surfaces have no noise to tell from detail.
    pub(crate) fn denoises(&self) -> bool {
        self.denoise && can_denoise(self.settings.aov)
    }
}
