//! The files that scenes name, in scripts: `@load skin.ppm: 9; a.obj: 1 newmtl a` is the reading of
//! a picture of this grey and of a triangle of this size with a material library. Pictures can be
//! `missing`, meshes `broken`, and both `at` another place.

use std::collections::BTreeSet;

use super::*;
use crate::assets::{Assets, Loaded, Wanted};
use crate::obj;
use crate::scene::{Image, NoMesh, Size};

impl Session {
    /// The reading of these files.
    pub(super) fn load(&self, files: &str) -> Result<Msg, String> {
        let files = files.split("; ").map(|file| file.split_once(": "));
        let files: Vec<_> = files.collect::<Option<_>>().ok_or("no file")?;
        let named = |is_mesh: bool| {
            let names = files.iter().map(|(name, _)| *name);
            let names = names.filter(move |name| is_of_mesh(name) == is_mesh);
            names.map(str::to_owned).collect()
        };
        let wanted = Wanted {
            scene: self.app.shared.disk.path.clone().ok_or("no path")?,
            pictures: named(false),
            meshes: named(true),
        };
        let missing = files.iter().filter(|(_, file)| *file == "missing");
        let missing = Wanted {
            pictures: missing.map(|(name, _)| (*name).to_owned()).collect(),
            meshes: BTreeSet::new(),
            ..wanted.clone()
        };
        let mut loaded = if missing.pictures.is_empty() {
            Loaded::default()
        } else {
            Assets::new(&[]).read(&missing)
        };
        let (mut images, mut meshes) = (Vec::new(), Vec::new());
        for (name, file) in files {
            let (file, place) = file.split_once(" at ").unwrap_or((file, ""));
            if !place.is_empty() {
                loaded.elsewhere.insert(name.to_owned(), place.into());
            }
            if is_of_mesh(name) {
                meshes.push((name.to_owned(), mesh(file)?));
            } else if let Ok(grey) = file.parse() {
                images.push((name.to_owned(), image(grey)));
            }
        }
        if !images.is_empty() {
            loaded.images = images.into_iter().collect();
        }
        loaded.meshes = meshes.into_iter().collect();
        Ok(Msg::AssetsRead(wanted, loaded))
    }
}

fn is_of_mesh(name: &str) -> bool {
    Path::new(name)
        .extension()
        .is_some_and(|extension| extension == "obj")
}

/// A picture of one pixel.
fn image(grey: u8) -> Arc<Image> {
    let size = Size {
        width: 1,
        height: 1,
    };
    Arc::new(Image::new(size, vec![[grey; 3]]).expect("as many pixels as it says"))
}

/// A triangle of a size with a material library, or why there is none.
fn mesh(file: &str) -> Result<Result<Arc<obj::Model>, NoMesh>, String> {
    if file == "broken" {
        let read = obj::read(b"v 0 0 0\nv x 0 0\n", |_| Ok::<_, String>(""));
        return Ok(Err(NoMesh::Malformed(
            read.expect_err("there are no faces"),
        )));
    }
    let (size, library) = file.split_once(' ').ok_or("no library")?;
    let library = unescaped(library);
    let text = format!("mtllib a.mtl\nv 0 0 0\nv {size} 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    let read = obj::read(text.as_bytes(), |_| Ok::<_, String>(library.as_str()));
    Ok(Ok(Arc::new(read.expect("the mesh is sound"))))
}
