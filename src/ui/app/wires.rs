//! The wireframe on screen, which is computed again when the scene, the camera or its size changes.

use std::sync::Arc;

use super::App;
use crate::render::{Wireframe, wireframe};
use crate::scene::{Camera, Scene, Size};
use crate::ui::keymap::Mode;

/// The wireframe of the newest scene.
#[derive(Debug, Default)]
pub struct Wires {
    lines: Wireframe,
    of: Option<(Arc<Scene>, Camera, Size)>,
}

impl Wires {
    /// The lines, if they are of this size.
    pub fn lines(&self, size: Size) -> Option<&Wireframe> {
        let (.., of) = self.of.as_ref()?;
        (*of == size).then_some(&self.lines)
    }

    fn follow(&mut self, scene: &Arc<Scene>, camera: Camera, size: Size) {
        let is_same = |(of, seen, at): &(Arc<Scene>, Camera, Size)| {
            Arc::ptr_eq(of, scene) && *seen == camera && *at == size
        };
        if !self.of.as_ref().is_some_and(is_same) {
            self.lines = wireframe(&scene.objects, &camera, size);
            self.of = Some((Arc::clone(scene), camera, size));
        }
    }
}

impl App {
    /// The wireframe if it is on screen instead of a traced picture.
    pub fn wires(&self) -> Option<&Wires> {
        let wires = self.pictures.wires.as_ref();
        wires.filter(|_| self.mode != Mode::Trace)
    }

    /// Brings the wireframe up to date, if it is on screen.
    pub fn follow_wires(&mut self) {
        if self.mode == Mode::Trace {
            return;
        }
        let (camera, raster) = (self.camera(), self.raster());
        if let (Some(wires), Some(scene)) = (&mut self.pictures.wires, &self.scene)
            && let (Some(camera), Some((_, size))) = (camera, raster)
        {
            wires.follow(scene, camera, size);
        }
    }
}
