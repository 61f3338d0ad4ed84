//! Symbols of what has no surface in the picture: lights, the camera and groups.

use std::collections::BTreeSet;

use super::soloing::drawn_in;
use super::zooming::frame_window;
use crate::app::Shared;
use crate::app::pictures::{Outline, Symbols};
use crate::keymap::Mode;
use language::Node;
use render::project_point;
use scene::Emitter;

/// The most symbols of groups, and the most of lights: more would hide the picture.
const MOST: usize = 256;

/// How near to a cell a symbol is picked, in cells.
const NEAR: u16 = 1;

/// The symbol of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Symbol {
    /// What it stands for.
    pub node: Node,
    /// The kind of that.
    pub kind: SymbolKind,
    /// Its column and row, relative to the picture's upper left cell.
    pub cell: (u16, u16),
}

/// What a symbol stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SymbolKind {
    /// A light with a position.
    Light,
    /// The scene's own camera, where the picture is not seen through it.
    Camera,
    /// A group of objects, at its origin.
    Group,
}

/// The symbols over the picture: of the kind of the selected node once the user has selected
/// something; all of them while picking or on request.
pub(crate) fn symbols(shared: &Shared) -> Vec<Symbol> {
    let asked = match (shared.mode, shared.pictures.symbols) {
        (Mode::Inspect, _) | (Mode::Select | Mode::Move, Symbols::All) => None,
        (Mode::Select | Mode::Move, Symbols::Selected) => match selected_kind(shared) {
            Some(kind) if shared.pictures.outline == Outline::Shown => Some(kind),
            _ => return Vec::new(),
        },
        _ => return Vec::new(),
    };
    if 0 < shared.error_count() {
        return Vec::new();
    }
    [SymbolKind::Light, SymbolKind::Camera, SymbolKind::Group]
        .into_iter()
        .filter(|kind| asked.is_none_or(|asked| asked == *kind))
        .filter_map(|kind| symbols_of(shared, kind))
        .flatten()
        .collect()
}

/// The node whose symbol is in a cell of the picture or beside it.
pub(crate) fn symbol_at(shared: &Shared, cell: (u16, u16)) -> Option<Node> {
    let distance = |symbol: &Symbol| {
        let (column, row) = symbol.cell;
        column.abs_diff(cell.0).max(row.abs_diff(cell.1))
    };
    let symbols = symbols(shared).into_iter();
    let nearest = symbols.min_by_key(distance)?;
    (distance(&nearest) <= NEAR).then_some(nearest.node)
}

/// Shows the symbols of all lights, cameras and groups, or only those of the selected kind.
pub(crate) fn toggle_symbols(shared: &mut Shared) {
    let (shown, words) = match shared.pictures.symbols {
        Symbols::Selected => (Symbols::All, "symbols of all lights, cameras and groups"),
        Symbols::All => (Symbols::Selected, "symbols of the selected kind only"),
    };
    shared.pictures.symbols = shown;
    shared.say(words);
}

fn selected_kind(shared: &Shared) -> Option<SymbolKind> {
    match shared.cursor.selected() {
        Node::Light(_) => Some(SymbolKind::Light),
        Node::View => Some(SymbolKind::Camera),
        Node::Object(object) if shared.source().is_group(object) => Some(SymbolKind::Group),
        _ => None,
    }
}

/// The symbols of a kind; `None` without a picture.
fn symbols_of(shared: &Shared, kind: SymbolKind) -> Option<Vec<Symbol>> {
    let (scene, camera) = (shared.scene.as_ref()?, shared.camera()?);
    let (cells, size) = shared.raster()?;
    let frame_window = frame_window(shared)?;
    let places: Vec<_> = match kind {
        SymbolKind::Light => {
            let lights = scene.lights.iter().enumerate();
            let placed = lights.filter_map(|(index, light)| match light.emitter {
                Emitter::Point { position, .. } => Some((Node::Light(index), position)),
                Emitter::Distant(_) | Emitter::Ambient => None,
            });
            placed.take(MOST).collect()
        }
        SymbolKind::Camera => vec![(Node::View, scene.camera.eye)],
        SymbolKind::Group => {
            let nodes = shared.nodes();
            let objects = 0..nodes.len() - nodes.before(Node::Object(0));
            let groups = objects.filter(|&object| shared.source().is_group(object));
            let placed = groups.filter_map(|object| {
                let node = Node::Object(object);
                Some((node, shared.source().pose(node)?.centre))
            });
            placed.take(MOST).collect()
        }
    };
    let symbol = |(node, place)| {
        let [x, y] = frame_window.on_screen(project_point(place, &camera, size)?, size);
        let is_inside =
            0.0 <= x && 0.0 <= y && x < f64::from(size.width) && y < f64::from(size.height);
        let cell = (x as u16, y as u16 / 2);
        (is_inside && cell.0 < cells.width).then_some(Symbol { node, kind, cell })
    };
    Some(places.into_iter().filter_map(symbol).collect())
}

/// The objects of the scene to outline in the picture, ascending: the selected one, or those of
/// the selected material.
pub(crate) fn outlined_objects(shared: &Shared) -> Vec<u32> {
    let locates = shared.inspection.locates && matches!(shared.mode, Mode::Select | Mode::Edit);
    let outlines = matches!(shared.mode, Mode::Select | Mode::Move)
        && shared.pictures.outline == Outline::Shown;
    if !(locates || outlines) || 0 < shared.error_count() {
        return Vec::new();
    }
    let source = shared.source();
    match shared.cursor.selected() {
        Node::Object(index) if locates => drawn_in(shared, &BTreeSet::from([index])),
        Node::Object(index) => source.drawn(index).into_iter().collect(),
        Node::Material(material) => {
            let drawn = shared.scene.as_ref().map_or(0, |scene| scene.objects.len());
            let drawn = 0..u32::try_from(drawn).unwrap_or(u32::MAX);
            let uses = |object: &u32| source.material(source.object(*object)) == Some(material);
            drawn.filter(uses).collect()
        }
        _ => Vec::new(),
    }
}
