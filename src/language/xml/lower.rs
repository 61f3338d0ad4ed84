//! The grammar of `.xml`: elements with attributes as the table of fields lists them. What makes no
//! sense costs itself only, and what the table does not know is skipped.
//!
//! All walks are loops over the flat tree: elements may be nested as deep as a text is long.

mod camera;
mod meshes;
mod objects;
mod roles;
mod surfaces;
mod textures;
mod values;

use std::collections::{HashMap, HashSet};

use super::origins::Origins;
use super::tree::Tree;
use crate::language::Lowered;
use crate::scene::{Light, Material, Meshes, Object, Rgb, Scene, Setting, Source};
use crate::text::{Diagnostic, Findings, Span};

/// Reads a scene.
pub(super) fn lower(text: &str, tree: &Tree, meshes: &Meshes) -> (Origins, Lowered) {
    let mut reader = Reader {
        text,
        tree,
        meshes,
        report: Findings::default(),
        origins: Origins::default(),
        lights: Vec::new(),
        materials: Vec::new(),
        named: HashMap::new(),
        white: None,
        met: HashSet::new(),
        slots: HashMap::new(),
        objects: Vec::new(),
        setting: Setting::default(),
    };
    if let Some(fault) = &tree.fault {
        reader.report.error(|| fault.clone());
    }
    let scene = reader.read();
    let lowered = Lowered {
        scene: scene.filter(|_| reader.report.errors() == 0),
        diagnostics: reader.report.sorted(),
    };
    (reader.origins, lowered)
}

/// What was read so far.
struct Reader<'a> {
    text: &'a str,
    tree: &'a Tree,
    meshes: &'a Meshes,
    report: Findings,
    origins: Origins,
    lights: Vec<Light>,
    materials: Vec<Material>,
    /// The index of each material by its name.
    named: HashMap<&'a str, usize>,
    /// The index of the material of what has none.
    white: Option<usize>,
    /// The meshes that were met, by name.
    met: HashSet<&'a str>,
    /// The indices of the materials that meshes bring along, by name and slot.
    slots: HashMap<&'a str, Vec<u32>>,
    objects: Vec<Object>,
    setting: Setting,
}

impl Reader<'_> {
    /// Reads everything; `None` where there is nothing to read.
    fn read(&mut self) -> Option<Scene> {
        self.find_roles();
        self.origins.root?;
        let camera = self.camera();
        self.surroundings();
        for index in 0..self.origins.lights.len() {
            self.light(index);
        }
        for index in 0..self.origins.materials.len() {
            self.material(index);
        }
        self.place_objects();
        let ambient = |light: &Light| match light.source {
            Source::Everywhere => light.colour,
            Source::Point { .. } | Source::Distant(_) => Rgb::ZERO,
        };
        Some(Scene {
            camera,
            ambient: self.lights.iter().map(ambient).sum(),
            lights: std::mem::take(&mut self.lights),
            materials: std::mem::take(&mut self.materials),
            textures: Vec::new(),
            objects: std::mem::take(&mut self.objects).into_iter().collect(),
            setting: std::mem::take(&mut self.setting),
        })
    }

    fn warn(&mut self, span: Span, message: impl FnOnce() -> String, expected: &str, hint: &str) {
        self.report.warning(|| {
            let warning = Diagnostic::warning(span, message(), expected);
            if hint.is_empty() {
                warning
            } else {
                warning.with_hint(hint)
            }
        });
    }

    fn error(&mut self, span: Span, message: impl FnOnce() -> String, expected: &str) {
        self.report
            .error(|| Diagnostic::error(span, message(), expected));
    }
}
