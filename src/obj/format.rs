//! The formats of mesh files.

use std::path::Path;

/// The format of a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront: polygons as text, with materials in libraries.
    Obj,
    /// Stanford: elements with properties, as text or as numbers of either byte order.
    Ply,
    /// Stereolithography: triangles, as text or as numbers.
    Stl,
}

impl Format {
    /// All formats.
    pub const ALL: [Self; 3] = [Self::Obj, Self::Ply, Self::Stl];

    /// The file extension, without the dot.
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Stl => "stl",
        }
    }

    /// The format with the extension of a file's name, ignoring case.
    pub fn of_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?;
        let is = |format: &Self| extension.eq_ignore_ascii_case(format.extension());
        Self::ALL.into_iter().find(is)
    }
}
