//! The wireframe on screen, which is computed again when the scene, the camera or its size changes.

use std::sync::Arc;

use render::{Wireframe, wireframe};
use scene::{Camera, Scene, Size};

/// The wireframe of the newest scene.
#[derive(Debug, Default)]
pub struct ShownWireframe {
    lines: Wireframe,
    of: Option<(Arc<Scene>, Camera, Size)>,
}

impl ShownWireframe {
    /// The lines, if they are of this size.
    pub fn lines(&self, size: Size) -> Option<&Wireframe> {
        let (.., of) = self.of.as_ref()?;
        (*of == size).then_some(&self.lines)
    }

    /// Computes the lines again if anything that they depend on has changed.
    pub(crate) fn follow(&mut self, scene: &Arc<Scene>, camera: Camera, size: Size) {
        let is_same = |(of, seen, at): &(Arc<Scene>, Camera, Size)| {
            Arc::ptr_eq(of, scene) && *seen == camera && *at == size
        };
        if !self.of.as_ref().is_some_and(is_same) {
            self.lines = wireframe(&scene.objects, &camera, size);
            self.of = Some((Arc::clone(scene), camera, size));
        }
    }
}
