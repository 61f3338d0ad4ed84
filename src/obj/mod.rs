//! Parses Wavefront `.obj` meshes and their `.mtl` materials from bytes. Accesses no files; the
//! caller supplies the bytes of the libraries that a mesh names.
//!
//! A material is just what its statements specify; the scene's language decides how it looks.

mod lines;
mod mesh;
mod mtl;
mod plain;

#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::Arc;

use crate::geometry::Mesh;

pub use mtl::Material;

/// The maximum number of triangles of a mesh, which with its tree takes less than 2 GB.
pub const MAX_TRIANGLES: usize = 1 << 24;

/// The maximum number of libraries that a mesh may name.
pub const MAX_LIBRARIES: usize = 64;

/// The maximum number of errors, and of warnings, to report. Reading stops at the last error.
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

/// An error or a warning at a place in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The library as named by the mesh; `None` for the mesh itself.
    pub library: Option<String>,
    /// The line, from 1; the last one if something is missing at the end.
    pub line: usize,
    /// The column of the offending word, in bytes from 1.
    pub column: usize,
    /// The message. May quote the file, escaped for safe printing.
    pub message: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(library) = &self.library {
            write!(f, "{}: ", crate::text::visible(library))?;
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
/// cannot be read. A library with errors defines nothing. Polygons become triangle fans around
/// their first corner, in file order.
///
/// Fails with the errors of up to ten lines.
pub fn read<B: AsRef<[u8]>>(
    bytes: &[u8],
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    mesh::read(bytes, MAX_TRIANGLES, library)
}
