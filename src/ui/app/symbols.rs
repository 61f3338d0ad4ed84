//! Marks of what has no surface in the picture: lights, the camera and groups.

use super::App;
use super::pictures::{Marking, Outline};
use crate::language::Node;
use crate::render::pixel_of;
use crate::scene::Emitter;
use crate::ui::keymap::Mode;

/// The most marks of groups, and the most of lights: more would hide the picture.
const MOST: usize = 256;

/// How near to a cell a mark is picked, in cells.
const NEAR: u16 = 1;

/// The mark of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    /// What it marks.
    pub node: Node,
    /// The kind of that.
    pub kind: MarkKind,
    /// Its column and row, relative to the picture's upper left cell.
    pub cell: (u16, u16),
}

/// What is marked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MarkKind {
    /// A light with a position.
    Light,
    /// The scene's own camera, where the picture is not seen through it.
    Camera,
    /// A group of objects, at its origin.
    Group,
}

impl App {
    /// The marks over the picture: of the kind of the selected node once the user has selected
    /// something; all of them while picking or on request.
    pub fn marks(&self) -> Vec<Mark> {
        let asked = match (self.mode, self.pictures.marks) {
            (Mode::Pick, _) | (Mode::Select | Mode::Move, Marking::All) => None,
            (Mode::Select | Mode::Move, Marking::Selected) => match self.selected_kind() {
                Some(kind) if self.pictures.outline == Outline::Marked => Some(kind),
                _ => return Vec::new(),
            },
            _ => return Vec::new(),
        };
        if 0 < self.error_count() {
            return Vec::new();
        }
        [MarkKind::Light, MarkKind::Camera, MarkKind::Group]
            .into_iter()
            .filter(|kind| asked.is_none_or(|asked| asked == *kind))
            .flat_map(|kind| self.marks_of(kind))
            .collect()
    }

    /// The node whose mark is in a cell of the picture or beside it.
    pub fn mark_at(&self, cell: (u16, u16)) -> Option<Node> {
        let distance = |mark: &Mark| {
            let (column, row) = mark.cell;
            column.abs_diff(cell.0).max(row.abs_diff(cell.1))
        };
        let marks = self.marks().into_iter();
        let nearest = marks.min_by_key(distance)?;
        (distance(&nearest) <= NEAR).then_some(nearest.node)
    }

    pub(super) fn toggle_marks(&mut self) {
        let (shown, words) = match self.pictures.marks {
            Marking::Selected => (Marking::All, "lights, cameras and groups are marked"),
            Marking::All => (Marking::Selected, "only what is selected is marked"),
        };
        self.pictures.marks = shown;
        self.overlays.say(words);
    }

    fn selected_kind(&self) -> Option<MarkKind> {
        match self.cursor.selected() {
            Node::Light(_) => Some(MarkKind::Light),
            Node::View => Some(MarkKind::Camera),
            Node::Object(object) if self.source().is_group(object) => Some(MarkKind::Group),
            _ => None,
        }
    }

    fn marks_of(&self, kind: MarkKind) -> Vec<Mark> {
        let (Some(scene), Some(camera)) = (&self.scene, self.camera()) else {
            return Vec::new();
        };
        let Some((cells, size)) = self.raster() else {
            return Vec::new();
        };
        let places: Vec<_> = match kind {
            MarkKind::Light => {
                let lights = scene.lights.iter().enumerate();
                let placed = lights.filter_map(|(index, light)| match light.emitter {
                    Emitter::Point { position, .. } => Some((Node::Light(index), position)),
                    Emitter::Distant(_) | Emitter::Ambient => None,
                });
                placed.take(MOST).collect()
            }
            MarkKind::Camera => vec![(Node::View, scene.camera.eye)],
            MarkKind::Group => {
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
        let mark = |(node, place)| {
            let [x, y] = pixel_of(place, &camera, size)?;
            let is_inside =
                0.0 <= x && 0.0 <= y && x < f64::from(size.width) && y < f64::from(size.height);
            let cell = (x as u16, y as u16 / 2);
            (is_inside && cell.0 < cells.width).then_some(Mark { node, kind, cell })
        };
        places.into_iter().filter_map(mark).collect()
    }
}
