//! Parses meshes from bytes: Wavefront `.obj` with `.mtl` materials, Stanford `.ply` and
//! stereolithography `.stl`. Accesses no files; the caller supplies the bytes of the libraries that a
//! mesh names.
//!
//! What one line, or one row of numbers, has wrong costs only that, with a warning. A material is just what
//! its statements specify; the scene's language decides how it looks. No reader allocates by a number that
//! the file merely declares, and each takes time linear in the file.

mod building;
mod ears;
mod faces;
mod findings;
mod format;
mod libraries;
mod lines;
mod maps;
mod mesh;
mod mtl;
mod plain;
mod ply;
mod polygons;
mod stl;

#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::Arc;

use geometry::Mesh;
use text::Span;

pub use format::Format;
pub use maps::{Edges, Map};
pub use mtl::Material;

/// The maximum number of triangles of a mesh, which with its tree takes less than 2 GB.
pub const MAX_TRIANGLES: usize = 1 << 24;

/// The maximum number of libraries that a mesh may name.
pub const MAX_LIBRARIES: usize = 64;

/// The maximum number of warnings to report of a mesh, and of its libraries.
const MAX_FINDINGS: usize = 10;

/// A mesh with its materials.
#[derive(Debug)]
pub struct Model {
    /// The triangles, with their slots of materials.
    pub mesh: Arc<Mesh>,
    /// The material of each slot; `None` for triangles without one, or with one that no library
    /// defines.
    pub materials: Vec<Option<Material>>,
    /// Warnings about the mesh, at most ten.
    pub warnings: Vec<Finding>,
    /// Warnings about the libraries, at most ten.
    pub library_warnings: Vec<Finding>,
}

/// A problem at a place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The library as named by the mesh; `None` for the mesh itself.
    pub library: Option<String>,
    /// The line, from 1; the last one if something is missing at the end. Numbers have no lines: there it is
    /// the last one before them, and the message says which byte of the file, from 0.
    pub line: usize,
    /// The column of the offending word, in characters from 1.
    pub column: usize,
    /// The message. May quote the file, escaped for safe printing.
    pub message: String,
    /// What was expected there.
    pub expected: String,
    /// What it costs, and how many further problems are not reported.
    pub hint: Option<String>,
    /// The line, or the part of a long one around the word; of a number its bytes.
    pub excerpt: String,
    /// The word in the excerpt.
    pub marked: Span,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(library) = &self.library {
            write!(f, "{}: ", text::visible(library))?;
        }
        let Self {
            line,
            column,
            message,
            ..
        } = self;
        write!(f, "line {line}, column {column}: {message}")
    }
}

/// Reads an `.obj` mesh. `library` returns the bytes of a library, given its name in the mesh, or why it
/// cannot be read. Polygons become triangles in file order: the fan around their first corner where
/// that covers nothing else, otherwise ears of their outline.
///
/// Fails if no face is left, or if there are more than [`MAX_TRIANGLES`] triangles, with up to ten
/// problems of lines and the reason.
pub fn read<B: AsRef<[u8]>>(
    bytes: &[u8],
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    mesh::read(bytes, MAX_TRIANGLES, library)
}

/// Reads a mesh of any format; see [`read`]. Meshes of other formats than `.obj` name no libraries.
pub fn read_as<B: AsRef<[u8]>>(
    format: Format,
    bytes: &[u8],
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    match format {
        Format::Obj => read(bytes, library),
        Format::Ply => ply::read(bytes, MAX_TRIANGLES),
        Format::Stl => stl::read(bytes, MAX_TRIANGLES),
    }
}
