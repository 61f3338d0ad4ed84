//! The files that scenes name, in scripts: `@load skin.ppm: 9; a.obj: 1 newmtl a` is the reading of
//! a picture of this grey and of a triangle of this size with a material library. Pictures can be
//! `missing`, meshes `broken`, and both `at` another place.

use std::collections::BTreeSet;

use super::*;
use ::assets::{Assets, Wanted};
use scene::{Image, NoMesh, Size};

impl Session {
    /// The reading of these files.
    pub(super) fn load(&self, files: &str) -> Result<Msg, String> {
        let mut wanted = Wanted {
            scene: self.app.shared.disk.path.clone().ok_or("no path")?,
            pictures: BTreeSet::new(),
            meshes: BTreeSet::new(),
        };
        let (mut missing, mut images, mut meshes) = (wanted.clone(), Vec::new(), Vec::new());
        let mut elsewhere = Vec::new();
        for file in files.split("; ") {
            let (name, file) = file.split_once(": ").ok_or("no file")?;
            let (file, place) = file.split_once(" at ").unwrap_or((file, ""));
            let name = name.to_owned();
            if !place.is_empty() {
                elsewhere.push((name.clone(), place.into()));
            }
            if is_of_mesh(&name) {
                wanted.meshes.insert(name.clone());
                meshes.push((name, mesh(file)?));
                continue;
            }
            wanted.pictures.insert(name.clone());
            match file.parse() {
                Ok(grey) => images.push((name, image(grey))),
                Err(_) => drop(missing.pictures.insert(name)),
            }
        }
        let mut loaded = Assets::new(&[]).read(&missing);
        loaded.elsewhere.extend(elsewhere);
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
