//! Icons of what has no surface in the picture: lights, the camera and groups.

use super::App;
use super::pictures::{Outline, ShownIcons};
use crate::language::Node;
use crate::render::pixel_of;
use crate::scene::Emitter;
use crate::ui::keymap::Mode;

/// The most icons of groups, and the most of lights: more would hide the picture.
const MOST: usize = 256;

/// How near to a cell an icon is picked, in cells.
const NEAR: u16 = 1;

/// The icon of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Icon {
    /// The node.
    pub node: Node,
    /// The kind of that.
    pub kind: IconKind,
    /// Its column and row, relative to the picture's upper left cell.
    pub cell: (u16, u16),
}

/// What an icon stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IconKind {
    /// A light with a position.
    Light,
    /// The scene's own camera, where the picture is not seen through it.
    Camera,
    /// A group of objects, at its origin.
    Group,
}

impl App {
    /// The icons over the picture: of the kind of the selected node once the user has selected
    /// something; all of them while picking or on request.
    pub fn icons(&self) -> Vec<Icon> {
        let asked = match (self.mode, self.pictures.icons) {
            (Mode::Pick, _) | (Mode::Select | Mode::Move, ShownIcons::All) => None,
            (Mode::Select | Mode::Move, ShownIcons::Selected) => match self.selected_kind() {
                Some(kind) if self.pictures.outline == Outline::Marked => Some(kind),
                _ => return Vec::new(),
            },
            _ => return Vec::new(),
        };
        if 0 < self.error_count() {
            return Vec::new();
        }
        [IconKind::Light, IconKind::Camera, IconKind::Group]
            .into_iter()
            .filter(|kind| asked.is_none_or(|asked| asked == *kind))
            .flat_map(|kind| self.icons_of(kind))
            .collect()
    }

    /// The node whose icon is in a cell of the picture or beside it.
    pub fn icon_at(&self, cell: (u16, u16)) -> Option<Node> {
        let distance = |icon: &Icon| {
            let (column, row) = icon.cell;
            column.abs_diff(cell.0).max(row.abs_diff(cell.1))
        };
        let icons = self.icons().into_iter();
        let nearest = icons.min_by_key(distance)?;
        (distance(&nearest) <= NEAR).then_some(nearest.node)
    }

    pub(super) fn toggle_icons(&mut self) {
        let (shown, words) = match self.pictures.icons {
            ShownIcons::Selected => (
                ShownIcons::All,
                "showing icons of all lights, cameras and groups",
            ),
            ShownIcons::All => (
                ShownIcons::Selected,
                "showing icons of the selected kind only",
            ),
        };
        self.pictures.icons = shown;
        self.overlays.say(words);
    }

    fn selected_kind(&self) -> Option<IconKind> {
        match self.cursor.selected() {
            Node::Light(_) => Some(IconKind::Light),
            Node::View => Some(IconKind::Camera),
            Node::Object(object) if self.source().is_group(object) => Some(IconKind::Group),
            _ => None,
        }
    }

    fn icons_of(&self, kind: IconKind) -> Vec<Icon> {
        let (Some(scene), Some(camera)) = (&self.scene, self.camera()) else {
            return Vec::new();
        };
        let Some((cells, size)) = self.raster() else {
            return Vec::new();
        };
        let places: Vec<_> = match kind {
            IconKind::Light => {
                let lights = scene.lights.iter().enumerate();
                let placed = lights.filter_map(|(index, light)| match light.emitter {
                    Emitter::Point { position, .. } => Some((Node::Light(index), position)),
                    Emitter::Distant(_) | Emitter::Ambient => None,
                });
                placed.take(MOST).collect()
            }
            IconKind::Camera => vec![(Node::View, scene.camera.eye)],
            IconKind::Group => {
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
        let icon = |(node, place)| {
            let [x, y] = pixel_of(place, &camera, size)?;
            let is_inside =
                0.0 <= x && 0.0 <= y && x < f64::from(size.width) && y < f64::from(size.height);
            let cell = (x as u16, y as u16 / 2);
            (is_inside && cell.0 < cells.width).then_some(Icon { node, kind, cell })
        };
        places.into_iter().filter_map(icon).collect()
    }
}
