//! The grammar of `.xml`: elements with attributes, according to the table of fields. Invalid parts
//! do not affect others, and unknown ones are skipped.
//!
//! The flat tree is traversed without recursion: elements may be nested as deep as the text is
//! long.

mod camera;
mod meshes;
mod objects;
mod roles;
mod surfaces;
mod tag;
mod textures;
mod values;

use std::collections::{HashMap, HashSet};

pub use tag::{Tag, tag_at};

use super::origins::Origins;
use super::tree::Tree;
use crate::Lowered;
use crate::schema::Category;
use scene::{Light, Material, Meshes, Object, Rgb, Scene, Setting, Texture};
use text::{Diagnostic, Findings, Span};

/// Lowers a text.
pub(super) fn lower(text: &str, tree: &Tree, meshes: &Meshes) -> (Origins, Lowered) {
    let mut lowering = Lowering::new(text, tree, meshes);
    if let Some(fault) = &tree.fault {
        lowering.report.error(|| fault.clone());
    }
    let scene = lowering.read();
    let lowered = Lowered {
        scene: scene.filter(|_| lowering.report.errors() == 0),
        diagnostics: lowering.report.sorted(),
    };
    (lowering.origins, lowered)
}

/// A lowering in progress.
struct Lowering<'a> {
    text: &'a str,
    tree: &'a Tree,
    meshes: &'a Meshes,
    report: Findings,
    origins: Origins,
    lights: Vec<Light>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    /// The index of each material by its name.
    named: HashMap<&'a str, usize>,
    /// Index of the default material.
    white: Option<usize>,
    /// The meshes seen so far, by name.
    reported_meshes: HashSet<&'a str>,
    /// Indices of the materials that meshes define, by mesh name and slot.
    slots: HashMap<&'a str, Vec<u32>>,
    objects: Vec<Object>,
    setting: Setting,
}

impl<'a> Lowering<'a> {
    fn new(text: &'a str, tree: &'a Tree, meshes: &'a Meshes) -> Self {
        Self {
            text,
            tree,
            meshes,
            report: Findings::default(),
            origins: Origins::default(),
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            named: HashMap::new(),
            white: None,
            reported_meshes: HashSet::new(),
            slots: HashMap::new(),
            objects: Vec::new(),
            setting: Setting::default(),
        }
    }

    /// Reads everything; `None` if there is nothing to read.
    fn read(&mut self) -> Option<Scene> {
        self.find_roles();
        let root = self.place(self.origins.root?);
        let camera = self.camera(root);
        self.rendering();
        self.surroundings(root);
        for index in 0..self.origins.of(Category::Light).len() {
            self.light(index);
        }
        for index in 0..self.origins.of(Category::Material).len() {
            self.material(index);
        }
        self.place_objects();
        Some(Scene {
            camera,
            ambient: Rgb::ZERO,
            lights: std::mem::take(&mut self.lights),
            materials: std::mem::take(&mut self.materials).into(),
            textures: std::mem::take(&mut self.textures),
            objects: std::mem::take(&mut self.objects).into_iter().collect(),
            setting: std::mem::take(&mut self.setting),
        })
    }

    fn warn(&mut self, span: Span, message: impl FnOnce() -> String, expected: &str, hint: &str) {
        self.report
            .warning(|| Diagnostic::warning(span, message(), expected).with_hint(hint));
    }

    fn error(&mut self, span: Span, message: impl FnOnce() -> String, expected: &str) {
        self.report
            .error(|| Diagnostic::error(span, message(), expected));
    }
}
