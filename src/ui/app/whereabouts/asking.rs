//! Asking where the selected thing is, whenever it or the picture has changed.

use std::collections::BTreeSet;
use std::sync::{Arc, Weak};

use super::screen::locates;
use crate::app::room::Room;
use crate::app::{Shared, display};
use crate::located::{Located, Search, Sought};
use crate::msg::Effect;
use language::Node;
use scene::{Camera, Scene, Size};

/// Most pixels that are traced for an answer; of larger pictures, a smaller one is.
const MOST_PIXELS: usize = 12_000;

/// The panel that tells where the selected thing is.
#[derive(Debug, Default)]
pub struct Whereabouts {
    /// What was asked last.
    asked: Option<Asked>,
    /// The answer to that.
    pub(super) answer: Option<Box<Located>>,
    /// Whether an answer is on its way.
    pub(super) is_awaited: bool,
    /// How often something was asked.
    tickets: u64,
}

/// What an answer depends on.
#[derive(Debug)]
struct Asked {
    node: Node,
    scene: Weak<Scene>,
    camera: Camera,
    size: Size,
    files: u64,
}

impl Asked {
    fn is_same(&self, other: &Self) -> bool {
        self.node == other.node
            && Weak::ptr_eq(&self.scene, &other.scene)
            && self.camera == other.camera
            && (self.size, self.files) == (other.size, other.files)
    }
}

impl Room for Whereabouts {
    /// A ticket is never given twice, whatever scene it was for.
    fn renew(&mut self) {
        self.forget();
    }

    fn follow(&mut self, shared: &mut Shared) -> Vec<Effect> {
        follow(self, shared).into_iter().collect()
    }
}

impl Whereabouts {
    fn forget(&mut self) {
        (self.asked, self.answer, self.is_awaited) = (None, None, false);
    }
}

/// Asks anew if the answer would be another one.
fn follow(whereabouts: &mut Whereabouts, shared: &Shared) -> Option<Effect> {
    if !shared.inspection.locates {
        whereabouts.forget();
        return None;
    }
    if locates(shared).is_none() || 0 < shared.error_count() || shared.assets.are_awaited() {
        return None;
    }
    let node = shared.cursor.selected();
    let halves = display::preview_screen(shared)?.halves;
    let asked = Asked {
        node,
        scene: Arc::downgrade(shared.scene.as_ref()?),
        camera: shared.camera()?,
        size: at_most(halves),
        files: shared.assets.changes,
    };
    let before = whereabouts.asked.as_ref();
    if before.is_some_and(|before| before.is_same(&asked)) {
        return None;
    }
    // An answer about the same thing is shown until the next one.
    if before.is_none_or(|before| before.node != node) {
        whereabouts.answer = None;
    }
    let size = asked.size;
    whereabouts.asked = Some(asked);
    whereabouts.tickets += 1;
    let sought = sought(shared, node);
    whereabouts.is_awaited = sought.is_some();
    let mut job = display::shown_job(shared, size, 1)?;
    job.settings.aov = None;
    Some(Effect::Locate(Box::new(Search {
        ticket: whereabouts.tickets,
        job,
        sought: sought?,
    })))
}

/// Takes an answer, if it is that to what was asked last.
pub(crate) fn located(whereabouts: &mut Whereabouts, ticket: u64, found: Option<Box<Located>>) {
    if whereabouts.tickets == ticket {
        (whereabouts.answer, whereabouts.is_awaited) = (found, false);
    }
}

/// A size of about this aspect ratio with few enough pixels.
fn at_most(size: Size) -> Size {
    let excess = size.pixels() as f64 / MOST_PIXELS as f64;
    let shrink = libm::sqrt(excess.max(1.0));
    let length = |length: u32| ((f64::from(length) / shrink) as u32).max(1);
    Size {
        width: length(size.width),
        height: length(size.height),
    }
}

/// What of the scene is sought for a node; `None` if it has no place in the picture.
fn sought(shared: &Shared, node: Node) -> Option<Sought> {
    match node {
        Node::Light(light) => Some(Sought::Light(u32::try_from(light).ok()?)),
        _ => Some(Sought::Objects(objects_of(shared, node)))
            .filter(|sought| !matches!(sought, Sought::Objects(objects) if objects.is_empty())),
    }
}

/// The objects of the scene that a node stands for, ascending: those in a group, those of a material.
pub(super) fn objects_of(shared: &Shared, node: Node) -> Vec<u32> {
    let source = shared.source();
    match node {
        Node::Object(object) => display::drawn_in(shared, &BTreeSet::from([object])),
        Node::Material(material) => {
            let drawn = shared.scene.as_ref().map_or(0, |scene| scene.objects.len());
            let drawn = 0..u32::try_from(drawn).unwrap_or(u32::MAX);
            let uses = |object: &u32| source.material(source.object(*object)) == Some(material);
            drawn.filter(uses).collect()
        }
        _ => Vec::new(),
    }
}
