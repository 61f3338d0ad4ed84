//! How pictures are made, as far as the user says so: the scene's text is left alone.

use super::App;
use crate::render::Aov;
use crate::scene::Integrator;

impl App {
    /// How light is gathered: as the user says, or else the scene.
    pub fn integrator(&self) -> Integrator {
        self.quality
            .integrator
            .unwrap_or_else(|| self.said_integrator())
    }

    /// Whether light is gathered in another way than the scene says.
    pub fn is_integrator_changed(&self) -> bool {
        self.integrator() != self.said_integrator()
    }

    fn said_integrator(&self) -> Integrator {
        let scene = self.scene.as_ref();
        scene.map_or_else(Integrator::default, |scene| scene.setting.integrator)
    }

    /// Gathers light in the other way, in all pictures. One that is the scene's own follows it
    /// again.
    pub(super) fn toggle_integrator(&mut self) {
        let (other, words) = match self.integrator() {
            Integrator::Whitted => (Integrator::Path, "path tracing"),
            Integrator::Path => (Integrator::Whitted, "Whitted's rays"),
        };
        self.quality.integrator = (other != self.said_integrator()).then_some(other);
        self.pending.scene = true;
        self.say(words);
    }

    /// Shows this of the first surfaces, or light, in all pictures.
    pub(super) fn show(&mut self, aov: Option<Aov>) {
        if self.aov != aov {
            self.aov = aov;
            self.pending.scene = true;
        }
        self.say(match aov {
            None => "light",
            Some(Aov::Depth) => "depth: the nearest white, the farthest black",
            Some(Aov::Normal) => "normals: -1 to 1 as 0 to 255",
            Some(Aov::Object) => "objects: a colour each",
            Some(Aov::Albedo) => "albedo: colours without light",
        });
    }

    /// Samples a pixel that are taken of what is shown, where so many are asked for.
    pub(super) fn samples(&self, asked: u32) -> u32 {
        self.aov.map_or(asked, |aov| aov.samples(asked))
    }
}
