//! Adding things and changing their kind, chosen from menus.

use std::path::Path;

use glam::DVec3;

use super::inspection::Cross;
use super::menu::{Entry, Menu, Purpose};
use super::transform::{decimals_of, round_up};
use super::{Shared, Tool};
use crate::language::{Node, Wish};
use crate::render::{clearance, pixel_width, surface_under};
use crate::ui::keymap::Mode;

/// The fraction of the picture's height that a new thing takes up.
const SHARE: f64 = 0.2;

impl Shared {
    /// Opens the menu of what can be added.
    pub(super) fn open_additions(&mut self) {
        if !self.source().is_blank() && self.refuses_structure() {
            return;
        }
        let additions = self.source().additions();
        let entries = additions
            .iter()
            .map(|addition| Entry::new(addition.name, addition.words));
        self.overlays.menu = Some(Menu::new(Purpose::Add, entries.collect(), None));
    }

    /// Opens the menu of kinds that the selected node can be changed to.
    pub(super) fn open_kinds(&mut self) {
        if self.refuses_structure() {
            return;
        }
        let node = self.cursor.selected();
        let name = self.source().name(node);
        let kinds = self.source().kinds(node);
        if kinds.is_empty() {
            self.overlays.fail(format!("{name} has only one type"));
            return;
        }
        let own = self.own_kind(node);
        let own = own.and_then(|own| kinds.iter().position(|kind| *kind == own));
        let entries = kinds.into_iter().map(|kind| Entry::new(kind, "")).collect();
        self.overlays.menu = Some(Menu::new(Purpose::Retype, entries, own));
    }

    /// The kind that a node has, of those that it can be changed to.
    pub(super) fn own_kind(&self, node: Node) -> Option<&'static str> {
        let source = self.source();
        let name = source.name(node);
        let fields = source.fields(node);
        let written = fields.iter().filter_map(|placed| placed.spans.first());
        let written: Vec<_> = written.map(|&span| source.leaf_text(span)).collect();
        let mut kinds = source.kinds(node).into_iter();
        kinds.find(|kind| name.ends_with(&format!("({kind})")) || written.contains(kind))
    }

    /// Adds a thing on the surface looked at, otherwise at the camera's target; in an empty text, a
    /// minimal scene with it.
    pub(super) fn add(&mut self, name: &str) {
        let mut additions = self.source().additions().iter();
        if additions.any(|addition| addition.name == name && addition.needs_file()) {
            self.open_palette_with(&format!("{name} "));
            return;
        }
        self.add_with(name, None);
    }

    /// Adds the mesh of a file.
    pub(super) fn add_mesh(&mut self, file: Option<&Path>) {
        let mut additions = self.source().additions().iter();
        let mesh = additions.find(|addition| addition.needs_file());
        match (mesh, file) {
            (None, _) => self.overlays.fail("there are no meshes in this language"),
            (_, None) => self.overlays.fail("name the mesh: mesh FILE.obj"),
            (Some(mesh), Some(file)) => {
                let before = std::mem::replace(&mut self.mode, Mode::Select);
                if !self.add_with(mesh.name, Some(&file.to_string_lossy())) {
                    self.mode = before;
                }
            }
        }
    }

    /// Adds something of this name; returns whether that could be done.
    fn add_with(&mut self, name: &str, file: Option<&str>) -> bool {
        let done = format!("added: {name}");
        if self.source().is_blank() {
            let first = self.source().first(name);
            let node = first.as_ref().ok().map(|&(_, node)| node);
            let is_done = self.restructure(first.map(|(edit, _)| vec![edit]), None, &done);
            if let Some(node) = node.filter(|_| self.error_count() == 0) {
                self.select(node);
            }
            if is_done {
                self.say_added(&done);
            }
            return is_done;
        }
        let marked: Vec<_> = self.cursor.marks.iter().copied().collect();
        let (centre, half, decimals) = self.place_for_new();
        let wish = Wish {
            centre,
            half,
            decimals,
            after: self.cursor.selected(),
            marked: &marked,
            file,
        };
        let placed = self.source().addition(name, &wish);
        let at = placed.as_ref().ok().map(|placed| placed.at);
        let edits = placed.map(|placed| placed.edits);
        let is_done = self.restructure(edits, at, &done);
        if is_done {
            self.say_added(&done);
        }
        is_done
    }

    /// Says what was added, which is selected, and the keys that transform it.
    fn say_added(&mut self, done: &str) {
        let node = self.cursor.selected();
        let tools = [
            (Tool::Move, "moves"),
            (Tool::Rotate, "rotates"),
            (Tool::Scale, "scales"),
        ];
        let suited = tools
            .into_iter()
            .filter(|&(tool, _)| self.pose_for(tool, node, &[node]).is_ok())
            .map(|(tool, does)| format!("{} {does} it", self.key_for(tool.name())));
        let suited: Vec<_> = suited.collect();
        let words = match suited.as_slice() {
            [] => done.to_owned(),
            suited => format!("{done}; {}", suited.join(", ")),
        };
        self.overlays.say(words);
    }

    /// The centre and half the size of a new thing, and the decimals that its place needs.
    fn place_for_new(&self) -> (DVec3, f64, usize) {
        let Some(camera) = self.camera() else {
            return (DVec3::ZERO, 1.0, 2);
        };
        let Some((_, size)) = self.raster() else {
            return (camera.target, 1.0, 2);
        };
        let size_at = |point: DVec3| {
            let half = 0.5 * SHARE * f64::from(size.height) * pixel_width(point, &camera, size);
            round_up(half)
        };
        let (centre, half) = match self.surface_looked_at() {
            Some((point, normal)) => {
                let half = size_at(point);
                (self.lifted(point + half * normal, half), half)
            }
            None => (camera.target, size_at(camera.target)),
        };
        let decimals = decimals_of(0.2 * half);
        (centre, half, decimals)
    }

    /// A centre raised so that a thing of this half size does not sink into what is below it, in the
    /// direction that the camera takes for down.
    fn lifted(&self, centre: DVec3, half: f64) -> DVec3 {
        let Some((scene, camera)) = self.scene.as_ref().zip(self.camera()) else {
            return centre;
        };
        let up = camera.up.normalize_or_zero();
        match clearance(scene.objects.iter(), [centre, -up], half) {
            Some(below) => centre + (half - below) * up,
            None => centre,
        }
    }

    /// The point and the normal of the surface under the cross, or without a cross under the middle
    /// of the picture, if there is one.
    fn surface_looked_at(&self) -> Option<(DVec3, DVec3)> {
        let Cross { pixel, size } = self.cross()?;
        let Ok(Some(Node::Object(index))) = self.node_at(pixel) else {
            return None;
        };
        let scene = self.scene.as_ref()?;
        let object = scene.objects.get(self.source().drawn(index)? as usize)?;
        let found = surface_under(object, &self.camera()?, size, pixel)?;
        Some((found.point, found.normal))
    }
}
