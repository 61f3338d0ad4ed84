//! The working view: moving it, writing it into the text, and going to views saved there.

use super::moves::{framed, settled};
use super::state::View;
use crate::document::StepName;
use crate::language::{Node, SavedView, view_name};
use crate::scene::{Camera, Emitter};
use crate::text::Severity;
use crate::ui::app::{Page, Shared, text};
use crate::ui::keymap::Context;

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
    let scene = shared.scene.clone().filter(|_| shared.error_count() == 0);
    let Some((scene, light)) = scene.and_then(|scene| {
        let light = *scene.lights.get(index)?;
        Some((scene, light))
    }) else {
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

/// Lists the saved views.
pub(super) fn list_views(shared: &mut Shared) {
    let names: Vec<_> = names(&shared.source().saved_views()).collect();
    if names.is_empty() {
        shared.say("no saved views: :view save NAME saves this one");
    } else {
        let page = Page::of(Context::Views, names);
        shared.overlays.open_page(page);
    }
}

fn names(views: &[SavedView]) -> impl Iterator<Item = String> {
    views.iter().map(|view| view.name.clone())
}

/// Lists the views of a text that has changed; closes their page with the last one.
pub(super) fn relist(view: &mut View, shared: &mut Shared) {
    let now = Some(shared.document.revision());
    if view.revision == now || shared.overlays.page(Context::Views).is_none() {
        return;
    }
    *view = View {
        saved: shared.source().saved_views(),
        revision: now,
    };
    if view.saved.is_empty() {
        shared.overlays.page = None;
    } else if let Some(page) = shared.overlays.page_mut(Context::Views) {
        page.list(names(&view.saved).collect());
    }
}

/// Goes to the saved view under the cursor of their page.
pub(super) fn go_to_view(view: &mut View, shared: &mut Shared) {
    let chosen = shared.overlays.take_chosen();
    let Some(view) = chosen.and_then(|at| view.saved.get(at)) else {
        return;
    };
    let Some(base) = shared.own_camera() else {
        shared.fail(shared.no_picture());
        return;
    };
    shared.pictures.set_view(view.camera(&base), Some(base));
    shared.say(format!("view {}", view.name));
}

/// Deletes the saved view under the cursor of their page.
pub(super) fn delete_view(view: &mut View, shared: &mut Shared) {
    let page = shared.overlays.page(Context::Views);
    let chosen = page.and_then(Page::chosen);
    let Some(view) = chosen.and_then(|at| view.saved.get(at)) else {
        return;
    };
    let name = view.name.clone();
    let undo = shared.key_for("undo");
    let done = format!("view {name} is deleted; {undo} undoes it");
    let step = StepName::done(format!("deleted the view {name}"));
    edit_saved_view(shared, &name, None, (step, done));
}

/// Writes the working view into the text, as a saved view if a name is given.
pub(crate) fn save_view_named(shared: &mut Shared, name: Option<String>) {
    match name {
        Some(name) => save_view_as(shared, &name),
        None => save_view(shared),
    }
}

/// Saves the view under a name, as an ordinary edit.
fn save_view_as(shared: &mut Shared, name: &str) {
    let name = match view_name(name) {
        Ok(name) => name,
        Err(reason) => {
            shared.fail(reason);
            return;
        }
    };
    match shared.camera().filter(|_| shared.error_count() == 0) {
        Some(camera) => {
            let done = format!("view {name} is now in the scene's text");
            let step = StepName::done(format!("saved the view {name}"));
            edit_saved_view(shared, &name, Some(&camera), (step, done));
        }
        None => shared.fail("cannot save the view while the scene has errors"),
    }
}

fn edit_saved_view(
    shared: &mut Shared,
    name: &str,
    camera: Option<&Camera>,
    (step, done): (StepName, String),
) {
    let edits = shared.source().saved_view_edits(name, camera);
    shared.document.end_step();
    match text::try_edits(shared, &edits) {
        Ok(()) => {
            shared.document.name_step(step);
            shared.say(done);
        }
        Err(refused) => shared.fail(refused.message),
    }
    shared.document.end_step();
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
    shared.document.end_step();
    match text::write_camera(shared, &view, &scene.camera) {
        Ok(()) => {
            shared.pictures.view = None;
            shared.document.name_step(StepName::done("wrote the view"));
            shared.say("the view is now in the scene's text");
        }
        Err(refused) => shared.fail(refused.message),
    }
    shared.document.end_step();
}
