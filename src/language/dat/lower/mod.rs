//! What the records of a `.dat` text mean.

mod camera;
mod objects;
mod surfaces;

use super::{Dat, Film};
use crate::Lowered;
use crate::engine::lines::Lines;
use crate::engine::places::Places;
use crate::engine::reader::Reader;
use crate::schema::{Category, Makes};
use geometry::{Operation, Solid};
use scene::{Light, Material, Rgb, Scene, Setting, Texture};
use text::Findings;

/// Returns the errors of every text that begins with these records.
pub(super) fn errors_of_beginning(text: &str, lines: &Lines<Dat>) -> Findings {
    let mut lowering = Lowering::new(text, lines);
    // The last record may be incomplete.
    for record in 0..lines.records.len().saturating_sub(1) {
        lowering.record(record);
    }
    lowering.reader.report
}

/// Lowers a text.
pub(super) fn lower(text: &str, lines: &Lines<Dat>) -> (Places<Film>, Lowered) {
    let mut lowering = Lowering::new(text, lines);
    for record in 0..lines.records.len() {
        lowering.record(record);
    }
    lowering.reader.settings();
    let objects = lowering.drawn();
    let camera = lowering.camera(&objects);
    let Lowering {
        reader: Reader { report, places, .. },
        lights,
        materials,
        textures,
        ..
    } = lowering;
    let rendering = places.settings.map(|place| place.rendering);
    let scene = (report.errors() == 0).then(|| Scene {
        camera,
        ambient: Rgb::ZERO,
        lights,
        materials: materials.into(),
        textures,
        objects: objects.into_iter().collect(),
        setting: Setting {
            rendering: rendering.unwrap_or_default(),
            ..Setting::default()
        },
    });
    let lowered = Lowered {
        scene,
        diagnostics: report.sorted(),
    };
    (places, lowered)
}

/// An object of the text.
enum Definition {
    /// A single solid, and the index of its material.
    Solid(Solid, u32),
    /// A combination; its operands are in its place.
    Combined(Operation),
    /// An object with errors; it still has an ID.
    Faulty,
}

/// A lowering in progress. Nodes with errors are included, so that indices are those of the places.
struct Lowering<'a> {
    reader: Reader<'a, Dat>,
    camera: camera::Records,
    lights: Vec<Light>,
    materials: Vec<Material>,
    textures: Vec<Texture>,
    parts: Vec<Definition>,
    /// The objects drawn according to the last `render`.
    drawn: objects::Drawn,
}

impl<'a> Lowering<'a> {
    fn new(text: &'a str, lines: &'a Lines<Dat>) -> Self {
        Self {
            reader: Reader::new(text, lines),
            camera: camera::Records::default(),
            lights: Vec::new(),
            materials: Vec::new(),
            textures: Vec::new(),
            parts: Vec::new(),
            drawn: objects::Drawn::Results,
        }
    }

    fn record(&mut self, at: usize) {
        let Some(read) = self.reader.read(at) else {
            return;
        };
        match read.record.makes {
            Makes::View => self.view(&read),
            Makes::Node(Category::Light) => self.light(&read),
            Makes::Node(Category::Material) => self.material(&read),
            Makes::Node(Category::Texture) => self.texture(&read),
            Makes::Node(Category::Object) | Makes::Solid(_) => self.object(&read),
            Makes::Use(_) => self.texture_use(&read),
            Makes::List => self.list(at, &read),
            Makes::State => {}
        }
    }
}
