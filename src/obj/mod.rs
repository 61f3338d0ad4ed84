//! Wavefront `.obj` meshes and their `.mtl` materials: bytes in, a mesh out. Knows no files; whoever
//! asks for a mesh hands in the bytes of the libraries it names.
//!
//! Of a material there is what its statements say; what a surface is to look like for it is for
//! the scene's format to decide.

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

/// The most triangles of a mesh: with its structure it takes less than 2 GB.
pub const MOST_TRIANGLES: usize = 1 << 24;

/// The most libraries that a mesh may name.
pub const MOST_LIBRARIES: usize = 64;

/// The most errors and the most warnings that are told of; reading ends at the last error.
const MOST_FINDINGS: usize = 10;

/// A mesh with its materials.
#[derive(Debug)]
pub struct Model {
    /// Its triangles.
    pub mesh: Arc<Mesh>,
    /// The material of each slot; none for triangles without one, or with one that no library
    /// defines.
    pub materials: Vec<Option<Material>>,
    /// What is doubtful about the text, at most ten of it.
    pub warnings: Vec<Finding>,
    /// What is wrong with the libraries, at most ten of it.
    pub library_warnings: Vec<Finding>,
}

/// Something wrong with a line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The library it is in, as the mesh names it; none if it is in the mesh itself.
    pub library: Option<String>,
    /// The line, from 1; the last one if something is missing at the end.
    pub line: usize,
    /// The column of the offending word, in bytes from 1.
    pub column: usize,
    /// What is wrong. May hold foreign text, which is safe to print.
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

/// Reads a mesh. `library` gives the bytes of a library by the name that the mesh gives it, or says
/// why it can't be read. A library with errors defines nothing. Polygons become fans around their
/// first corner, in file order.
///
/// The errors of up to ten lines are told of at once.
pub fn read<B: AsRef<[u8]>>(
    bytes: &[u8],
    library: impl FnMut(&str) -> Result<B, String>,
) -> Result<Model, Vec<Finding>> {
    mesh::read(bytes, MOST_TRIANGLES, library)
}
