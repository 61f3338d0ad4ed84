//! Adding things and changing their kind, chosen from menus.

use std::path::Path;

use super::standing::place_for_new;
use super::structure::{place, restructure};
use crate::app::shared::menu::{Entry, Menu, Purpose};
use crate::app::{Shared, Tool, transform};
use crate::keymap::Mode;
use language::{NewNode, Node};

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

/// Adds a thing that stands on the surface looked at, otherwise below the camera's target or there; in an
/// empty text, a minimal scene with it.
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
    let mut on = None;
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
        let mut additions = shared.source().additions().iter();
        let is_flat = additions.any(|addition| addition.name == name && addition.is_flat());
        let found = place_for_new(shared, is_flat);
        on = found.on.map(|node| shared.source().name(node));
        let wish = NewNode {
            centre: found.centre,
            half: found.half,
            up: found.up,
            decimals: found.decimals,
            after: shared.cursor.selected(),
            marked: &marked,
            file,
        };
        let placed = shared.source().addition(name, &wish);
        place(shared, placed, &done)
    };
    if is_done {
        let done = match on.filter(|_| file.is_none() && is_solid(shared)) {
            Some(on) => format!("Added {name} on {on}"),
            None => format!("Added {name}"),
        };
        say_added(shared, &done);
    }
    is_done
}

/// Whether the selected node is an object with a shape of its own.
fn is_solid(shared: &Shared) -> bool {
    match shared.cursor.selected() {
        Node::Object(index) => {
            let source = shared.source();
            source.operation(index).is_none() && source.drawn(index).is_some()
        }
        _ => false,
    }
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
