//! What a picture is made from, as text.

use super::frame::Frame;
use crate::job::{Aov, Frames, Job, Settings, aov_name};
use scene::Viewpoint;

/// What a picture is made from: enough to render the same bytes again.
#[derive(Clone, Debug, PartialEq)]
pub struct Provenance {
    /// The version of the program.
    pub version: String,
    /// The digest of the scene's text and all files it names, in hexadecimal.
    pub scene: String,
    /// What differs from the scene's own camera, apart from the size.
    pub view: Viewpoint,
    /// The AOVs that its file holds beside it.
    pub layers: Vec<Aov>,
    /// Whether its noise is reduced.
    pub denoise: bool,
    /// The settings, with the samples that were taken.
    pub settings: Settings,
}

impl Provenance {
    /// The provenance of a job's picture, whose scene has this digest, without layers.
    pub fn of(job: &Job, scene: String) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            scene,
            view: Viewpoint::between(&job.scene.camera, &job.camera),
            layers: Vec::new(),
            // Live frames hold denoised values beside their pixels.
            denoise: job.denoises() && job.frames != Frames::Live,
            settings: job.settings,
        }
    }

    /// The provenance of the film behind it, which other pictures may show: without the number of samples,
    /// and without what is made of the film afterwards.
    #[must_use]
    pub fn of_film(&self) -> Self {
        Self {
            layers: Vec::new(),
            denoise: false,
            settings: self.settings.of_film(),
            ..self.clone()
        }
    }

    /// Whether its pixels are those of [the film](Self::of_film), not what is known from tracing it.
    pub fn is_of_film(&self) -> bool {
        self.settings.aov == self.settings.of_film().aov
    }

    /// With the samples that the frame has, which a limit or a larger number asked for may change.
    #[must_use]
    pub fn in_frame(mut self, frame: &Frame) -> Self {
        self.settings.spp = frame.progress.spp;
        self
    }

    /// The name and value of each entry but the number of samples, in a fixed order; what is new since
    /// the first version only where it differs from that.
    pub fn written(&self) -> Vec<(&'static str, String)> {
        let or_word = |text: String, word: &str| {
            if text.is_empty() {
                word.to_owned()
            } else {
                text
            }
        };
        let layers: Vec<_> = self.layers.iter().copied().map(aov_name).collect();
        let entries = [
            ("version", self.version.clone()),
            ("scene", self.scene.clone()),
            ("view", or_word(self.view.to_string(), "own")),
            ("layers", or_word(layers.join(","), "none")),
        ];
        let denoise = self.denoise.then(|| ("denoise", "yes".to_owned()));
        let entries = entries.into_iter().chain(denoise);
        entries.chain(self.settings.written()).collect()
    }

    /// The entries as text, a line each.
    pub fn lines(&self) -> String {
        let entries = self.written().into_iter();
        let lines: Vec<_> = entries
            .map(|(name, value)| format!("{name} {value}\n"))
            .collect();
        lines.concat()
    }
}
