//! Digests that tell scenes and files apart: SHA-256, in hexadecimal.

use std::fmt::Write;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use crate::file::ReadError;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// The digest of a scene's text and of the files it references, in the order of their names in it: of
/// each the length as u64 in little-endian order, then the bytes. Where the files are does not matter.
pub(super) fn fingerprint(text: &str, files: &[PathBuf]) -> Result<String, ReadError> {
    let mut hasher = Sha256::new();
    add(&mut hasher, text.as_bytes());
    for path in files {
        add_file(&mut hasher, path).map_err(|source| ReadError::Io {
            path: path.clone(),
            source,
        })?;
    }
    Ok(hexadecimal(hasher))
}

/// The digest of texts or bytes, told apart by their lengths.
pub(super) fn digest<'b>(parts: impl IntoIterator<Item = &'b [u8]>) -> String {
    let mut hasher = Sha256::new();
    for part in parts {
        add(&mut hasher, part);
    }
    hexadecimal(hasher)
}

/// The [`digest`] of the bytes of a file.
pub(super) fn digest_of_file(path: &Path) -> io::Result<String> {
    let mut hasher = Sha256::new();
    add_file(&mut hasher, path)?;
    Ok(hexadecimal(hasher))
}

fn add(hasher: &mut Sha256, bytes: &[u8]) {
    hasher.update((bytes.len() as u64).to_le_bytes());
    hasher.update(bytes);
}

fn add_file(hasher: &mut Sha256, path: &Path) -> io::Result<()> {
    let mut file = File::open(path)?;
    hasher.update(file.metadata()?.len().to_le_bytes());
    let mut chunk = vec![0; CHUNK];
    loop {
        let read = file.read(&mut chunk)?;
        if read == 0 {
            return Ok(());
        }
        hasher.update(&chunk[..read]);
    }
}

fn hexadecimal(hasher: Sha256) -> String {
    let mut text = String::new();
    for byte in hasher.finalize() {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}
