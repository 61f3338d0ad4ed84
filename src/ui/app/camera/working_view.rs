//! The working view: moving it, and writing it into the text.

use super::moves::{framed, settled};
use crate::app::{Shared, text};
use ::text::Severity;
use language::Node;
use scene::{Camera, Emitter};

/// Applies a move, unless the resulting camera would see nothing.
pub(crate) fn move_camera(shared: &mut Shared, change: impl FnOnce(Camera) -> Camera) {
    let Some(camera) = shared.camera() else {
        return;
    };
    match settled(change(camera), &camera) {
        Some(moved) => shared.pictures.set_view(moved, shared.own_camera()),
        None => shared.fail("the camera cannot move any further"),
    }
}

/// Frames the selected object, or the whole scene, from the same direction.
pub(super) fn frame_selected(shared: &mut Shared) {
    let Some(scene) = shared.scene.clone() else {
        return;
    };
    let selected = shared.cursor.selected();
    let (bounds, unframed) = match selected {
        Node::Object(object) => {
            let drawn = shared.source().drawn(object);
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
        shared.say("nothing to frame");
        return;
    }
    if let Some(reason) = unframed {
        let name = shared.source().name(selected);
        let message = format!("{name} {reason}: this is the whole scene");
        shared.say(message);
    }
    let (centre, radius) = (bounds.centre(), bounds.half_diagonal());
    move_camera(shared, |camera| framed(camera, centre, radius));
}

/// Looks from the selected light to the camera's target; from a distant light, at the whole
/// scene.
pub(crate) fn look_from_light(shared: &mut Shared) {
    let Node::Light(index) = shared.cursor.selected() else {
        shared.fail("select a light to look from");
        return;
    };
    let scene = shared.sound_scene();
    let light = scene.as_ref().and_then(|scene| scene.lights.get(index));
    let (Some(scene), Some(light)) = (&scene, light) else {
        shared.fail("cannot look from a light while the scene has errors");
        return;
    };
    let bounds = scene.bounds();
    let centre = bounds.centre();
    match light.emitter {
        Emitter::Point { position, .. } => move_camera(shared, |camera| Camera {
            eye: position,
            ..camera
        }),
        Emitter::Distant(_) if bounds.is_empty() => {
            shared.say("nothing to look at");
            return;
        }
        Emitter::Distant(toward) => move_camera(shared, |camera| {
            let camera = Camera {
                eye: centre + toward,
                target: centre,
                ..camera
            };
            framed(camera, centre, bounds.half_diagonal())
        }),
        Emitter::Ambient => {
            shared.fail("ambient light comes from all sides: there is no view from it");
            return;
        }
    }
    let name = shared.source().name(Node::Light(index));
    shared.overlays.suggest(format!("the view from {name}"));
}

/// Writes the working view into the text as an ordinary edit.
pub(crate) fn save_view(shared: &mut Shared) {
    let (Some(view), Some(scene)) = (shared.pictures.view, shared.scene.clone()) else {
        shared.say("the view is unchanged");
        return;
    };
    if 0 < shared.error_count() {
        let words = "cannot save the view while the scene has errors";
        shared.overlays.blame_errors(Severity::Error, words);
        return;
    }
    let edits = shared.source().view_edits(&scene.camera, &view);
    if text::make_step(shared, &edits, "wrote the view") {
        shared.pictures.view = None;
        shared.say("saved the view to the scene");
    }
}
