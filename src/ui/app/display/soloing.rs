//! Soloing: the preview shows some lights or objects alone, without a change of the text.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::app::Shared;
use crate::app::pictures::solo::Solo;
use language::Node;
use scene::{Rgb, Scene};

/// A scene to show, and what its objects are called if it lacks some.
type Part = (Arc<Scene>, Option<Arc<[u32]>>);

/// Shows the targets alone in the preview, or everything again.
pub(crate) fn toggle_solo(shared: &mut Shared) {
    toggle_solo_of(shared, &shared.targets());
}

/// Shows these nodes alone in the preview, or everything again.
pub(crate) fn toggle_solo_of(shared: &mut Shared, targets: &[Node]) {
    let mut solo = Solo {
        lights: BTreeSet::new(),
        objects: BTreeSet::new(),
        nodes: shared.nodes(),
    };
    for &node in targets {
        match node {
            Node::Light(light) => solo.lights.insert(light),
            Node::Object(object) => solo.objects.insert(object),
            _ => false,
        };
    }
    let is_nothing = solo.lights.is_empty() && solo.objects.is_empty();
    let before = shared.pictures.solo.take();
    if before.as_ref() == Some(&solo) || before.is_some() && is_nothing {
        shared.say("everything is shown again");
    } else if is_nothing {
        shared.fail("only lights, objects and groups can be shown alone");
    } else if !solo.objects.is_empty() && drawn_in(shared, &solo.objects).is_empty() {
        shared.pictures.solo = before;
        let name = shared.targets_name(targets);
        let show = shared.key_for("visibility");
        shared.fail(format!("{name} is not drawn: {show} shows it"));
    } else {
        shared.pictures.solo = Some(solo);
        let name = shared.targets_name(targets);
        let solo = shared.key_for("solo");
        let words = format!("solo: {name} ({solo} to show all)");
        shared.say(words);
    }
    shared.pictures.due = true;
}

/// Ends soloing if its indices belong to others now.
pub(crate) fn keep_solo(shared: &mut Shared) {
    let nodes = shared.nodes();
    let solo = &mut shared.pictures.solo;
    shared.pictures.due |= solo.take_if(|solo| solo.nodes != nodes).is_some();
}

/// The scene of the preview: only what is soloed.
pub(super) fn preview_scene(shared: &Shared) -> Option<Part> {
    let scene = shared.scene.as_ref()?;
    let Some(solo) = &shared.pictures.solo else {
        return Some((Arc::clone(scene), None));
    };
    let mut alone = (**scene).clone();
    if !solo.lights.is_empty() {
        alone.ambient = Rgb::ZERO;
        let lights = alone.lights.iter_mut().enumerate();
        for (_, other) in lights.filter(|(at, _)| !solo.lights.contains(at)) {
            other.colour = Rgb::ZERO;
        }
    }
    let mut numbers = None;
    if !solo.objects.is_empty() {
        let drawn = drawn_in(shared, &solo.objects);
        let objects = drawn.iter().map(|&number| number as usize);
        let objects = objects.filter_map(|number| scene.objects.get(number));
        alone.objects = objects.cloned().collect();
        numbers = Some(drawn.into());
    }
    Some((Arc::new(alone), numbers))
}

/// The objects of the scene that these of the text draw, ascending.
pub(crate) fn drawn_in(shared: &Shared, objects: &BTreeSet<usize>) -> Vec<u32> {
    let source = shared.source();
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
