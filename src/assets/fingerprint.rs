//! The digest of all that a scene is made of.

use std::collections::BTreeMap;
use std::path::PathBuf;

use crate::file::{Digest, ReadError};

/// The digest of a scene's text and of the files that were read for it, by their names in the text.
/// Where they are does not matter.
///
/// # Errors
///
/// Fails if a file cannot be read.
pub fn fingerprint(text: &str, found: &BTreeMap<String, PathBuf>) -> Result<String, ReadError> {
    let mut digest = Digest::default();
    digest.add(text.as_bytes());
    for (name, path) in found {
        digest.add(name.as_bytes());
        let added = digest.add_file(path);
        added.map_err(|source| ReadError::Io {
            path: path.clone(),
            source,
        })?;
    }
    Ok(digest.finish())
}
