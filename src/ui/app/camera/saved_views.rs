//! The views saved in the text: their page, going to them, saving and deleting them.

use super::state::View;
use super::working_view::save_view;
use crate::app::{Page, Shared, text};
use crate::keymap::Context;
use language::{SavedView, view_name};
use scene::Camera;

/// Lists the saved views.
pub(super) fn list_views(shared: &mut Shared) {
    let names: Vec<_> = names(&shared.source().saved_views()).collect();
    if names.is_empty() {
        shared.say("no saved views: :view save NAME saves this one");
    } else {
        let page = Page::of(Context::Views, "Saved views", names);
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
    let step = format!("deleted the view {name}");
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
    let camera = shared.camera().filter(|_| shared.error_count() == 0);
    match (view_name(name), camera) {
        (Err(reason), _) => shared.fail(reason),
        (Ok(_), None) => shared.fail("cannot save the view while the scene has errors"),
        (Ok(name), Some(camera)) => {
            let done = format!("saved view {name} to the scene");
            let step = format!("saved the view {name}");
            edit_saved_view(shared, &name, Some(&camera), (step, done));
        }
    }
}

fn edit_saved_view(
    shared: &mut Shared,
    name: &str,
    camera: Option<&Camera>,
    (step, done): (String, String),
) {
    let edits = shared.source().saved_view_edits(name, camera);
    if text::make_step(shared, &edits, step) {
        shared.say(done);
    }
}
