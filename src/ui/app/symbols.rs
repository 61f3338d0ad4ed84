//! Symbols of what has no surface in the picture: lights, the camera and groups.

use super::Shared;
use super::pictures::{Outline, Symbols};
use crate::language::Node;
use crate::render::pixel_of;
use crate::scene::Emitter;
use crate::ui::keymap::Mode;

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

impl Shared {
    /// The symbols over the picture: of the kind of the selected node once the user has selected
    /// something; all of them while picking or on request.
    pub fn symbols(&self) -> Vec<Symbol> {
        let asked = match (self.mode, self.pictures.symbols) {
            (Mode::Inspect, _) | (Mode::Select | Mode::Move, Symbols::All) => None,
            (Mode::Select | Mode::Move, Symbols::Selected) => match self.selected_kind() {
                Some(kind) if self.pictures.outline == Outline::Shown => Some(kind),
                _ => return Vec::new(),
            },
            _ => return Vec::new(),
        };
        if 0 < self.error_count() {
            return Vec::new();
        }
        [SymbolKind::Light, SymbolKind::Camera, SymbolKind::Group]
            .into_iter()
            .filter(|kind| asked.is_none_or(|asked| asked == *kind))
            .flat_map(|kind| self.symbols_of(kind))
            .collect()
    }

    /// The node whose symbol is in a cell of the picture or beside it.
    pub fn symbol_at(&self, cell: (u16, u16)) -> Option<Node> {
        let distance = |symbol: &Symbol| {
            let (column, row) = symbol.cell;
            column.abs_diff(cell.0).max(row.abs_diff(cell.1))
        };
        let symbols = self.symbols().into_iter();
        let nearest = symbols.min_by_key(distance)?;
        (distance(&nearest) <= NEAR).then_some(nearest.node)
    }

    pub(super) fn toggle_symbols(&mut self) {
        let (shown, words) = match self.pictures.symbols {
            Symbols::Selected => (Symbols::All, "symbols of all lights, cameras and groups"),
            Symbols::All => (Symbols::Selected, "symbols of the selected kind only"),
        };
        self.pictures.symbols = shown;
        self.overlays.say(words);
    }

    fn selected_kind(&self) -> Option<SymbolKind> {
        match self.cursor.selected() {
            Node::Light(_) => Some(SymbolKind::Light),
            Node::View => Some(SymbolKind::Camera),
            Node::Object(object) if self.source().is_group(object) => Some(SymbolKind::Group),
            _ => None,
        }
    }

    fn symbols_of(&self, kind: SymbolKind) -> Vec<Symbol> {
        let (Some(scene), Some(camera)) = (&self.scene, self.camera()) else {
            return Vec::new();
        };
        let Some(((cells, size), frame_window)) = self.raster().zip(self.frame_window()) else {
            return Vec::new();
        };
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
                let nodes = self.nodes();
                let objects = 0..nodes.len() - nodes.before(Node::Object(0));
                let groups = objects.filter(|&object| self.source().is_group(object));
                let placed = groups.filter_map(|object| {
                    let node = Node::Object(object);
                    Some((node, self.source().pose(node)?.centre))
                });
                placed.take(MOST).collect()
            }
        };
        let symbol = |(node, place)| {
            let [x, y] = frame_window.on_screen(pixel_of(place, &camera, size)?, size);
            let is_inside =
                0.0 <= x && 0.0 <= y && x < f64::from(size.width) && y < f64::from(size.height);
            let cell = (x as u16, y as u16 / 2);
            (is_inside && cell.0 < cells.width).then_some(Symbol { node, kind, cell })
        };
        places.into_iter().filter_map(symbol).collect()
    }
}
