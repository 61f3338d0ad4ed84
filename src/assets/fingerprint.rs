//! The digest of all that a scene is made of.

use std::path::PathBuf;

use crate::file::{Digest, ReadError};

/// The digest of a scene's text and of the files it references, in the order of their names in it.
/// Where the files are does not matter.
///
/// # Errors
///
/// Fails if a file cannot be read.
pub fn fingerprint(text: &str, files: &[PathBuf]) -> Result<String, ReadError> {
    let mut digest = Digest::default();
    digest.add(text.as_bytes());
    for path in files {
        let added = digest.add_file(path);
        added.map_err(|source| ReadError::Io {
            path: path.clone(),
            source,
        })?;
    }
    Ok(digest.finish())
}
