//! Adding things and changing their kind, chosen from menus.

use std::path::Path;

use glam::DVec3;

use super::structure::{place, restructure};
use crate::app::shared::inspection::Cross;
use crate::app::shared::menu::{Entry, Menu, Purpose};
use crate::app::{Shared, Tool, inspect, transform};
use crate::keymap::Mode;
use language::{NewNode, Node};
use render::{distance_to_surface, pixel_width, surface_under};

/// The fraction of the picture's height that a new thing takes up.
const SHARE: f64 = 0.2;

/// Opens the menu of what can be added.
pub(super) fn open_additions(shared: &mut Shared) {
    if !shared.source().is_blank() && shared.refuses_structure() {
        return;
    }
    let additions = shared.source().additions();
    let entries = additions
        .iter()
        .map(|addition| Entry::new(addition.name, addition.words));
    shared.overlays.menu = Some(Menu::new(Purpose::Add, entries.collect(), None));
}

/// Opens the menu of kinds that the selected node can be changed to.
pub(super) fn open_kinds(shared: &mut Shared) {
    if shared.refuses_structure() {
        return;
    }
    let node = shared.cursor.selected();
    let name = shared.source().name(node);
    let kinds = shared.source().kinds(node);
    if kinds.is_empty() {
        shared.fail(format!("{name} has only one type"));
        return;
    }
    let own = own_kind(shared, node);
    let own = own.and_then(|own| kinds.iter().position(|kind| *kind == own));
    let entries = kinds.into_iter().map(|kind| Entry::new(kind, "")).collect();
    shared.overlays.menu = Some(Menu::new(Purpose::Retype, entries, own));
}

/// The kind that a node has, of those that it can be changed to.
pub(crate) fn own_kind(shared: &Shared, node: Node) -> Option<&'static str> {
    let source = shared.source();
    let name = source.name(node);
    let fields = source.fields(node);
    let written = fields.iter().filter_map(|placed| placed.spans.first());
    let written: Vec<_> = written.map(|&span| source.leaf_text(span)).collect();
    let mut kinds = source.kinds(node).into_iter();
    kinds.find(|kind| name.ends_with(&format!("({kind})")) || written.contains(kind))
}

/// Adds a thing on the surface looked at, otherwise at the camera's target; in an empty text, a
/// minimal scene with it.
pub(crate) fn add(shared: &mut Shared, name: &str) {
    let mut additions = shared.source().additions().iter();
    if additions.any(|addition| addition.name == name && addition.needs_file()) {
        shared.open_palette_with(&format!("{name} "));
        return;
    }
    add_with(shared, name, None);
}

/// Adds the mesh of a file.
pub(crate) fn add_mesh(shared: &mut Shared, file: Option<&Path>) {
    let mut additions = shared.source().additions().iter();
    let mesh = additions.find(|addition| addition.needs_file());
    match (mesh, file) {
        (None, _) => shared.fail("there are no meshes in this language"),
        (_, None) => shared.fail("name the mesh: :mesh FILE.obj"),
        (Some(mesh), Some(file)) => {
            let before = std::mem::replace(&mut shared.mode, Mode::Select);
            if !add_with(shared, mesh.name, Some(&file.to_string_lossy())) {
                shared.mode = before;
            }
        }
    }
}

/// Adds something of this name; returns whether that could be done.
fn add_with(shared: &mut Shared, name: &str, file: Option<&str>) -> bool {
    let done = format!("added: {name}");
    let is_done = if shared.source().is_blank() {
        let first = shared.source().first(name);
        let node = first.as_ref().ok().map(|&(_, node)| node);
        let is_done = restructure(shared, first.map(|(edit, _)| vec![edit]), None, &done);
        if let Some(node) = node.filter(|_| shared.error_count() == 0) {
            shared.select(node);
        }
        is_done
    } else {
        let marked: Vec<_> = shared.cursor.marks.iter().copied().collect();
        let (centre, half, decimals) = place_for_new(shared);
        let wish = NewNode {
            centre,
            half,
            decimals,
            after: shared.cursor.selected(),
            marked: &marked,
            file,
        };
        let placed = shared.source().addition(name, &wish);
        place(shared, placed, &done)
    };
    if is_done {
        say_added(shared, &done);
    }
    is_done
}

/// Says what was added, which is selected, and the keys that transform it.
fn say_added(shared: &mut Shared, done: &str) {
    let node = shared.cursor.selected();
    let tools = [
        (Tool::Move, "moves"),
        (Tool::Rotate, "rotates"),
        (Tool::Scale, "scales"),
    ];
    let suited = tools
        .into_iter()
        .filter(|&(tool, _)| transform::pose_for(shared, tool, node, &[node]).is_ok())
        .map(|(tool, does)| format!("{} {does} it", shared.key_for(tool.name())));
    let suited: Vec<_> = suited.collect();
    let words = match suited.as_slice() {
        [] => done.to_owned(),
        suited => format!("{done}; {}", suited.join(", ")),
    };
    shared.say(words);
}

/// The centre and half the size of a new thing, and the decimals that its place needs.
fn place_for_new(shared: &Shared) -> (DVec3, f64, usize) {
    let Some(camera) = shared.camera() else {
        return (DVec3::ZERO, 1.0, 2);
    };
    let Some((_, size)) = shared.raster() else {
        return (camera.target, 1.0, 2);
    };
    let size_at = |point: DVec3| {
        let half = 0.5 * SHARE * f64::from(size.height) * pixel_width(point, &camera, size);
        transform::round_up(half)
    };
    let (centre, half) = match surface_looked_at(shared) {
        Some((point, normal)) => {
            let half = size_at(point);
            (lifted(shared, point + half * normal, half), half)
        }
        None => (camera.target, size_at(camera.target)),
    };
    let decimals = transform::decimals_of(0.2 * half);
    (centre, half, decimals)
}

/// A centre raised so that a thing of this half size does not sink into what is below it, in the
/// direction that the camera takes for down.
fn lifted(shared: &Shared, centre: DVec3, half: f64) -> DVec3 {
    let Some((scene, camera)) = shared.scene.as_ref().zip(shared.camera()) else {
        return centre;
    };
    let up = camera.up.normalize_or_zero();
    match distance_to_surface(scene.objects.iter(), [centre, -up], half) {
        Some(below) => centre + (half - below) * up,
        None => centre,
    }
}

/// The point and the normal of the surface under the cross, or without a cross under the middle
/// of the picture, if there is one.
fn surface_looked_at(shared: &Shared) -> Option<(DVec3, DVec3)> {
    let Cross { pixel, size } = inspect::cross(shared)?;
    let Ok(Some(Node::Object(index))) = inspect::node_at(shared, pixel) else {
        return None;
    };
    let scene = shared.scene.as_ref()?;
    let object = scene.objects.get(shared.source().drawn(index)? as usize)?;
    let found = surface_under(object, &shared.camera()?, size, pixel)?;
    Some((found.point, found.normal))
}
