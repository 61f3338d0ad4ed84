//! Digests that tell texts and files apart: SHA-256, in hexadecimal.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

use hmac_sha256::Hash;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// A digest of parts, told apart by their lengths: of each the length as u64 in little-endian
/// order, then the bytes.
#[derive(Clone, Default)]
pub struct Digest(Hash);

impl Digest {
    /// The digest of texts or bytes.
    pub fn of<'b>(parts: impl IntoIterator<Item = &'b [u8]>) -> String {
        let mut digest = Self::default();
        for part in parts {
            digest.add(part);
        }
        digest.finish()
    }

    /// The digest of the bytes of a file.
    pub fn of_file(path: &Path) -> io::Result<String> {
        let mut digest = Self::default();
        digest.add_file(path)?;
        Ok(digest.finish())
    }

    /// Adds a part.
    fn add(&mut self, bytes: &[u8]) {
        self.begin(bytes.len() as u64);
        self.append(bytes);
    }

    /// Adds the bytes of a file as a part, without holding all of them.
    fn add_file(&mut self, path: &Path) -> io::Result<()> {
        let mut file = File::open(path)?;
        self.begin(file.metadata()?.len());
        let mut chunk = vec![0; CHUNK];
        loop {
            let read = file.read(&mut chunk)?;
            if read == 0 {
                return Ok(());
            }
            self.append(&chunk[..read]);
        }
    }

    /// The digest, 64 hexadecimal digits.
    fn finish(self) -> String {
        let mut text = String::new();
        for byte in self.0.finalize() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{byte:02x}");
        }
        text
    }

    fn begin(&mut self, length: u64) {
        self.append(&length.to_le_bytes());
    }

    fn append(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against `sha256sum`.
    #[test]
    fn digests_are_sha_256_of_lengths_and_bytes() {
        for (parts, expected) in [
            (
                &[][..],
                "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855",
            ),
            (
                &[&b"abc"[..], b""],
                "3e2f8940c3a0e0fd6f6e07bbf07f015dd7c147431e5fa14bf3f225d782641540",
            ),
            // With its length, the first part whose padding needs a second block; and many blocks.
            (
                &[&[7; 48]],
                "a69ae3466ac9b4d43f44f280b7bbd564930fd2ccb0ffc9a111a8ba1d6d9c800f",
            ),
            (
                &[&[7; 1000]],
                "e22c3e59ceb0e58608acea2a49c8dd2009f08d11c985befaba81d4ecd8934bd9",
            ),
        ] {
            assert_eq!(Digest::of(parts.iter().copied()), expected);
        }
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("a");
        let bytes = vec![7; 3 * CHUNK / 2];
        std::fs::write(&path, &bytes).expect("it is written");
        let of_file = Digest::of_file(&path).expect("it is read");
        assert_eq!(of_file, Digest::of([&bytes[..]]));
    }
}
