//! The working view: moving it, and writing it into the text.

use super::App;
use super::camera::{framed, settled};
use crate::language::Node;
use crate::scene::Camera;
use crate::text::Severity;

impl App {
    /// Applies a move, unless the resulting camera would see nothing.
    pub(super) fn move_camera(&mut self, change: impl FnOnce(Camera) -> Camera) {
        let Some(camera) = self.camera() else {
            return;
        };
        match settled(change(camera), &camera) {
            Some(moved) => self.pictures.set_view(moved, self.own_camera()),
            None => self.overlays.fail("the camera cannot move any further"),
        }
    }

    /// Frames the selected object, or the whole scene, from the same direction.
    pub(super) fn frame_selected(&mut self) {
        let Some(scene) = self.scene.clone() else {
            return;
        };
        let selected = self.cursor.selected();
        let (bounds, unframed) = match selected {
            Node::Object(object) => {
                let drawn = self.source().drawn(object);
                let drawn = drawn.and_then(|index| scene.objects.get(index as usize));
                match drawn.map(|object| object.shape.bounds()) {
                    Some(bounds) if bounds.is_bounded() && !bounds.is_empty() => (bounds, None),
                    Some(_) => (scene.bounds(), Some("has no finite size")),
                    None => (scene.bounds(), Some("is not drawn")),
                }
            }
            _ => (scene.bounds(), None),
        };
        if bounds.is_empty() {
            self.overlays.say("nothing to frame");
            return;
        }
        if let Some(reason) = unframed {
            let name = self.source().name(selected);
            let message = format!("{name} {reason}: this is the whole scene");
            self.overlays.say(message);
        }
        let (centre, radius) = (bounds.centre(), bounds.half_diagonal());
        self.move_camera(|camera| framed(camera, centre, radius));
    }

    /// Writes the working view into the text as an ordinary edit.
    pub(super) fn save_view(&mut self) {
        let (Some(view), Some(scene)) = (self.pictures.view, self.scene.clone()) else {
            self.overlays.say("the view is unchanged");
            return;
        };
        if 0 < self.error_count() {
            let words = "cannot save the view while the scene has errors";
            self.overlays.blame_errors(Severity::Error, words);
            return;
        }
        self.document.end_step();
        match self.write_camera(&view, &scene.camera) {
            Ok(()) => {
                self.pictures.view = None;
                self.overlays.say("the view is now in the scene's text");
            }
            Err(refused) => self.overlays.fail(refused.message),
        }
        self.document.end_step();
    }
}
