//! The digest of all that a scene is made of.

use std::collections::BTreeMap;
use std::path::PathBuf;

use file::{Digest, ReadError};

/// The digest of a scene's text and of the files that were read for it, by their names in the text.
/// Where they are does not matter.
///
/// # Errors
///
/// Fails if a file cannot be read.
pub fn fingerprint(text: &str, found: &BTreeMap<String, PathBuf>) -> Result<String, ReadError> {
    Ok(FileDigests::of(found)?.fingerprint(text))
}

/// The digests of files, to be used for several texts.
#[derive(Clone, Debug, Default)]
pub struct FileDigests(Vec<[String; 2]>);

impl FileDigests {
    /// The digests of files by their names.
    ///
    /// # Errors
    ///
    /// Fails if a file cannot be read.
    pub fn of(found: &BTreeMap<String, PathBuf>) -> Result<Self, ReadError> {
        let digests = found.iter().map(|(name, path)| {
            let digest = Digest::of_file(path).map_err(|source| ReadError::Io {
                path: path.clone(),
                source,
            });
            Ok([name.clone(), digest?])
        });
        digests.collect::<Result<_, _>>().map(Self)
    }

    /// As [`fingerprint()`] of a text that uses these files.
    pub fn fingerprint(&self, text: &str) -> String {
        let files = self.0.as_flattened().iter().map(String::as_bytes);
        Digest::of([text.as_bytes()].into_iter().chain(files))
    }
}
