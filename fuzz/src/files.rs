//! The files that scenes name: meshes, material libraries, pictures.

use halflight::image_file;
use halflight::obj::{self, Format};

/// The maximum number of pixels of a picture, so that hostile ones do not take long.
const ROOM: u64 = 1 << 18;

/// A mesh that uses a material from its library.
const MESH: &[u8] = b"mtllib a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";

/// Reads a mesh with the library that follows a zero byte.
pub fn obj(input: &[u8]) {
    let [mesh, library] = super::parts(input);
    read(Format::Obj, mesh, library);
}

/// Reads a `.ply` mesh.
pub fn ply(input: &[u8]) {
    read(Format::Ply, input, b"");
}

/// Reads an `.stl` mesh.
pub fn stl(input: &[u8]) {
    read(Format::Stl, input, b"");
}

/// Reads a material library.
pub fn mtl(input: &[u8]) {
    read(Format::Obj, MESH, input);
}

fn read(format: Format, mesh: &[u8], library: &[u8]) {
    let is_end = |&byte: &u8| byte == b'\n' || byte == b'\r';
    let lines = |bytes: &[u8]| bytes.split(is_end).count();
    let last = lines(mesh).max(lines(library));
    let findings = match obj::read_as(format, mesh, |_| Ok(library)) {
        Ok(model) => [model.warnings, model.library_warnings].concat(),
        Err(errors) => {
            assert!(!errors.is_empty());
            errors
        }
    };
    for finding in findings {
        assert!((1..=last).contains(&finding.line), "{finding:?}");
        assert!(0 < finding.column && !finding.to_string().is_empty());
        assert!(finding.excerpt.get(finding.marked.range()).is_some());
    }
}

/// Decodes a picture of any format.
pub fn picture(input: &[u8]) {
    if let Ok(image) = image_file::decode(&mut std::io::Cursor::new(input), ROOM) {
        let size = image.size();
        let pixels = u64::from(size.width) * u64::from(size.height);
        assert!((1..=ROOM).contains(&pixels));
    }
}
