//! Mesh files as scenes: a new one around each.

use std::path::{Path, PathBuf};

use super::{Assets, Wanted};
use image_file::ImageFormat;
use language::xml::{ShownMesh, Up, around_mesh};
use language::{FileKind, NamedFile};
use obj::Format;
use text::{Span, counted};

/// How many scenes beside a mesh may have names like its own.
const MOST: u32 = 100;

/// A new scene around a mesh, not written yet.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MeshScene {
    /// The path for it: beside the mesh, and of no file yet.
    pub path: PathBuf,
    /// Its text, in [`language::Language::Xml`].
    pub text: String,
    /// What it shows, in words.
    pub summary: String,
    /// Whether the mesh could be read; if not, lowering the text says why.
    pub is_readable: bool,
}

/// Whether a path has the extension of a mesh, which can be opened like a scene.
pub fn is_mesh(path: &Path) -> bool {
    Format::of_path(path).is_some()
}

/// Whether a path has the extension of a picture, which textures can be read from.
pub fn is_picture(path: &Path) -> bool {
    ImageFormat::of_path(path).is_some()
}

/// Whether a path is that of a mesh which only Halflight reads in scenes.
pub fn is_own_mesh(path: &Path) -> bool {
    Format::of_path(path).is_some_and(|format| format != Format::Obj)
}

impl Assets {
    /// Makes a scene around a mesh: its axis `up` points up, by default that of its format's custom. Does
    /// not fail if the mesh cannot be read, so that it can still be corrected.
    pub fn scene_of_mesh(&mut self, mesh: &Path, up: Option<Up>) -> MeshScene {
        let path = free_path(mesh);
        let name = mesh.file_name().unwrap_or_default().to_string_lossy();
        let custom = match Format::of_path(mesh) {
            Some(Format::Stl) => Up::Z,
            _ => Up::Y,
        };
        let up = up.unwrap_or(custom);
        let named = NamedFile {
            path: name.to_string(),
            kind: FileKind::Mesh,
            what: String::new(),
            span: Span::at(0),
        };
        let loaded = self.read(&Wanted::new(&path, &[named]));
        let model = loaded.meshes.get(&name).and_then(Result::ok);
        let text = around_mesh(&ShownMesh {
            name: &name,
            bounds: model.map(|model| model.mesh.bounds()),
            has_materials: model.is_some_and(|model| model.materials.iter().any(Option::is_some)),
            up,
        });
        let up = match up {
            Up::Y => "y",
            Up::Z => "z",
        };
        let summary = match model {
            Some(model) => {
                let triangles = counted(model.mesh.len(), "triangle");
                format!("{triangles}, {up} up, on a ground with two lights")
            }
            None => "it cannot be read".to_owned(),
        };
        MeshScene {
            path,
            text,
            summary,
            is_readable: model.is_some(),
        }
    }
}

/// The path of a new scene beside a mesh: `bunny.xml` for `bunny.ply`, or the first free one of
/// `bunny-2.xml` and so on.
fn free_path(mesh: &Path) -> PathBuf {
    let first = mesh.with_extension("xml");
    let stem = mesh.file_stem().unwrap_or_default();
    let numbered = (2..=MOST).map(|number| {
        let mut name = stem.to_owned();
        name.push(format!("-{number}.xml"));
        mesh.with_file_name(name)
    });
    let mut paths = std::iter::once(first).chain(numbered);
    let free = paths.find(|path| path.symlink_metadata().is_err());
    free.unwrap_or_else(|| mesh.with_extension("new.xml"))
}
