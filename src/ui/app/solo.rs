//! Soloing: the preview shows one light alone, without a change of the text.

use std::sync::Arc;

use super::App;
use crate::language::Node;
use crate::scene::{Light, Rgb, Scene};

impl App {
    /// Shows the selected light alone in the preview, or all lights again.
    pub(super) fn toggle_solo(&mut self) {
        let Node::Light(light) = self.cursor.selected() else {
            self.overlays.fail("only a light can be shown on its own");
            return;
        };
        if self.pictures.solo.take() == Some(light) {
            self.overlays.say("all lights are on again");
        } else {
            self.pictures.solo = Some(light);
            let name = self.source().name(Node::Light(light));
            self.overlays
                .say(format!("the preview shows only {name}; l shows all lights"));
        }
        self.pictures.due = true;
    }

    /// The scene of the preview: with the soloed light alone, if there is one.
    pub(super) fn preview_scene(&self) -> Option<Arc<Scene>> {
        let scene = self.scene.as_ref()?;
        let Some(solo) = self.pictures.solo else {
            return Some(Arc::clone(scene));
        };
        let lit = |(at, light): (usize, &Light)| Light {
            colour: if at == solo { light.colour } else { Rgb::ZERO },
            ..*light
        };
        let alone = Scene {
            ambient: Rgb::ZERO,
            lights: scene.lights.iter().enumerate().map(lit).collect(),
            ..(**scene).clone()
        };
        Some(Arc::new(alone))
    }
}
