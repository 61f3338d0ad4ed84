//! The working view: moving it, and writing it into the text.

use super::camera::{framed, settled};
use super::{List, Page, Shared};
use crate::document::StepName;
use crate::language::{Node, SavedView, view_name};
use crate::scene::{Camera, Emitter};
use crate::text::Severity;

impl Shared {
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

    /// Looks from the selected light to the camera's target; from a distant light, at the whole
    /// scene.
    pub(super) fn look_from_light(&mut self) {
        let Node::Light(index) = self.cursor.selected() else {
            self.overlays.fail("select a light to look from");
            return;
        };
        let scene = self.scene.clone().filter(|_| self.error_count() == 0);
        let Some((scene, light)) = scene.and_then(|scene| {
            let light = *scene.lights.get(index)?;
            Some((scene, light))
        }) else {
            self.overlays
                .fail("cannot look from a light while the scene has errors");
            return;
        };
        let bounds = scene.bounds();
        let centre = bounds.centre();
        match light.emitter {
            Emitter::Point { position, .. } => self.move_camera(|camera| Camera {
                eye: position,
                ..camera
            }),
            Emitter::Distant(_) if bounds.is_empty() => {
                self.overlays.say("nothing to look at");
                return;
            }
            Emitter::Distant(toward) => self.move_camera(|camera| {
                let camera = Camera {
                    eye: centre + toward,
                    target: centre,
                    ..camera
                };
                framed(camera, centre, bounds.half_diagonal())
            }),
            Emitter::Ambient => {
                self.overlays
                    .fail("ambient light comes from all sides: there is no view from it");
                return;
            }
        }
        let name = self.source().name(Node::Light(index));
        self.overlays.suggest(format!("the view from {name}"));
    }

    /// Lists the saved views.
    pub(super) fn list_views(&mut self) {
        let views = self.source().saved_views();
        if views.is_empty() {
            self.overlays
                .say("no saved views: :view save NAME saves this one");
            return;
        }
        let list = List::Views(views, self.document.revision());
        self.overlays.page = Some(Page::new(list));
    }

    /// Lists the saved views again if the text has changed; closes their page with the last one.
    pub(super) fn follow_views(&mut self) {
        let now = self.document.revision();
        let Some(page) = &mut self.overlays.page else {
            return;
        };
        if let List::Views(views, revision) = &mut page.list
            && *revision != now
        {
            (*views, *revision) = (self.document.source().saved_views(), now);
            let is_empty = views.is_empty();
            page.go(0);
            self.overlays.page.take_if(|_| is_empty);
        }
    }

    /// Goes to a saved view.
    pub(super) fn go_to_view(&mut self, view: &SavedView) {
        let Some(base) = self.own_camera() else {
            self.overlays.fail(self.no_picture());
            return;
        };
        self.pictures.set_view(view.camera(&base), Some(base));
        self.overlays.say(format!("view {}", view.name));
    }

    /// Deletes the saved view under the cursor.
    pub(super) fn delete_view(&mut self) {
        let Some(page) = &self.overlays.page else {
            return;
        };
        let (List::Views(views, _), Some(at)) = (&page.list, page.chosen()) else {
            return;
        };
        let name = views[at].name.clone();
        let undo = self.key_for("undo");
        let done = format!("view {name} is deleted; {undo} undoes it");
        let step = StepName::done(format!("deleted the view {name}"));
        self.edit_saved_view(&name, None, (step, done));
    }

    /// Writes the working view into the text, as a saved view if a name is given.
    pub(super) fn save_view_named(&mut self, name: Option<String>) {
        match name {
            Some(name) => self.save_view_as(&name),
            None => self.save_view(),
        }
    }

    /// Saves the view under a name, as an ordinary edit.
    pub(super) fn save_view_as(&mut self, name: &str) {
        let name = match view_name(name) {
            Ok(name) => name,
            Err(reason) => {
                self.overlays.fail(reason);
                return;
            }
        };
        match self.camera().filter(|_| self.error_count() == 0) {
            Some(camera) => {
                let done = format!("view {name} is now in the scene's text");
                let step = StepName::done(format!("saved the view {name}"));
                self.edit_saved_view(&name, Some(&camera), (step, done));
            }
            None => self
                .overlays
                .fail("cannot save the view while the scene has errors"),
        }
    }

    fn edit_saved_view(
        &mut self,
        name: &str,
        camera: Option<&Camera>,
        (step, done): (StepName, String),
    ) {
        let edits = self.source().saved_view_edits(name, camera);
        self.document.end_step();
        match self.try_edits(&edits) {
            Ok(()) => {
                self.document.name_step(step);
                self.overlays.say(done);
            }
            Err(refused) => self.overlays.fail(refused.message),
        }
        self.document.end_step();
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
                self.document.name_step(StepName::done("wrote the view"));
                self.overlays.say("the view is now in the scene's text");
            }
            Err(refused) => self.overlays.fail(refused.message),
        }
        self.document.end_step();
    }
}
