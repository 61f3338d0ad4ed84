//! The digest that tells scenes apart.

use std::fmt::Write;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

use super::Error;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// The SHA-256, in hexadecimal, of a scene's text and of the files it references, in the order of
/// their names in it: of each the length as u64 in little-endian order, then the bytes. Where the
/// files are does not matter.
pub(super) fn fingerprint(text: &str, files: &[PathBuf]) -> Result<String, Error> {
    let mut digest = Sha256::new();
    digest.update((text.len() as u64).to_le_bytes());
    digest.update(text);
    for path in files {
        add_file(&mut digest, path).map_err(|source| Error::Asset {
            path: path.clone(),
            source,
        })?;
    }
    let mut hexadecimal = String::new();
    for byte in digest.finalize() {
        // Writing to a string cannot fail.
        let _ = write!(hexadecimal, "{byte:02x}");
    }
    Ok(hexadecimal)
}

fn add_file(digest: &mut Sha256, path: &Path) -> io::Result<()> {
    let mut file = File::open(path)?;
    digest.update(file.metadata()?.len().to_le_bytes());
    let mut chunk = vec![0; CHUNK];
    loop {
        let read = file.read(&mut chunk)?;
        if read == 0 {
            return Ok(());
        }
        digest.update(&chunk[..read]);
    }
}
