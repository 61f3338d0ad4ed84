//! Soloing: the preview shows some lights or objects alone, without a change of the text.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::Shared;
use super::solo::Solo;
use crate::language::Node;
use crate::scene::{Light, Rgb, Scene};

/// A scene to show, and what its objects are called if it lacks some.
pub(super) type Part = (Arc<Scene>, Option<Arc<[u32]>>);

impl Shared {
    /// Shows the targets alone in the preview, or everything again.
    pub(super) fn toggle_solo(&mut self) {
        self.toggle_solo_of(&self.targets());
    }

    /// Shows these nodes alone in the preview, or everything again.
    pub(super) fn toggle_solo_of(&mut self, targets: &[Node]) {
        let mut solo = Solo {
            lights: BTreeSet::new(),
            objects: BTreeSet::new(),
            nodes: self.nodes(),
        };
        for &node in targets {
            match node {
                Node::Light(light) => solo.lights.insert(light),
                Node::Object(object) => solo.objects.insert(object),
                _ => false,
            };
        }
        let is_nothing = solo.lights.is_empty() && solo.objects.is_empty();
        let before = self.pictures.solo.take();
        if before.as_ref() == Some(&solo) || before.is_some() && is_nothing {
            self.overlays.say("everything is shown again");
        } else if is_nothing {
            self.overlays
                .fail("only lights, objects and groups can be shown alone");
        } else if !solo.objects.is_empty() && self.drawn_in(&solo.objects).is_empty() {
            self.pictures.solo = before;
            let name = self.targets_name(targets);
            let show = self.key_for("visibility");
            self.overlays
                .fail(format!("{name} is not drawn: {show} shows it"));
        } else {
            self.pictures.solo = Some(solo);
            let name = self.targets_name(targets);
            let solo = self.key_for("solo");
            let words = format!("the preview shows only {name}; {solo} shows everything");
            self.overlays.say(words);
        }
        self.pictures.due = true;
    }

    /// Ends soloing if its indices belong to others now.
    pub(super) fn keep_solo(&mut self) {
        let nodes = self.nodes();
        let solo = &mut self.pictures.solo;
        self.pictures.due |= solo.take_if(|solo| solo.nodes != nodes).is_some();
    }

    /// The scene of the preview: only what is soloed.
    pub(super) fn preview_scene(&self) -> Option<Part> {
        let scene = self.scene.as_ref()?;
        let Some(solo) = &self.pictures.solo else {
            return Some((Arc::clone(scene), None));
        };
        let mut alone = (**scene).clone();
        if !solo.lights.is_empty() {
            alone.ambient = Rgb::ZERO;
            let others = alone.lights.iter_mut().enumerate();
            let others = others.filter(|(at, _)| !solo.lights.contains(at));
            others.for_each(|(_, light)| *light = unlit(*light));
        }
        let mut numbers = None;
        if !solo.objects.is_empty() {
            let drawn = self.drawn_in(&solo.objects);
            let objects = drawn.iter().map(|&number| number as usize);
            let objects = objects.filter_map(|number| scene.objects.get(number));
            alone.objects = objects.cloned().collect();
            numbers = Some(drawn.into());
        }
        Some((Arc::new(alone), numbers))
    }

    /// The objects of the scene that these of the text draw, ascending.
    fn drawn_in(&self, objects: &BTreeSet<usize>) -> Vec<u32> {
        let source = self.source();
        let depth = |object: usize| source.depth(Node::Object(object));
        let count = source.nodes().objects();
        let inside = |&object: &usize| {
            let inner = (object + 1..count).take_while(move |&at| depth(object) < depth(at));
            std::iter::once(object).chain(inner)
        };
        let drawn = objects.iter().flat_map(inside);
        let drawn: BTreeSet<_> = drawn.filter_map(|object| source.drawn(object)).collect();
        drawn.into_iter().collect()
    }
}

/// A light that gives none.
fn unlit(light: Light) -> Light {
    Light {
        colour: Rgb::ZERO,
        ..light
    }
}
