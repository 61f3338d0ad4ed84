//! Parses Wavefront `.obj` meshes and their `.mtl` materials from bytes. Accesses no files; the
//! caller supplies the bytes of the libraries that a mesh names.
//!
//! What one line has wrong costs only that line, with a warning. A material is just what its
//! statements specify; the scene's language decides how it looks.

mod ears;
mod faces;
mod findings;
mod libraries;
mod lines;
mod maps;
mod mesh;
mod mtl;
mod plain;
mod polygons;

#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::Arc;

use geometry::Mesh;
use text::Span;

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
    /// The line, from 1; the last one if something is missing at the end.
    pub line: usize,
    /// The column of the offending word, in characters from 1.
    pub column: usize,
    /// The message. May quote the file, escaped for safe printing.
    pub message: String,
    /// What was expected there.
    pub expected: String,
    /// What it costs, and how many further problems are not reported.
    pub hint: Option<String>,
    /// The line, or the part of a long one around the word.
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

/// Reads a mesh. `library` returns the bytes of a library, given its name in the mesh, or why it
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
