//! Digests that tell texts and files apart: SHA-256, in hexadecimal.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Read, Write};
use std::path::Path;

use sha2::Sha256;

/// Bytes read at once.
const CHUNK: usize = 1 << 18;

/// A digest of parts, told apart by their lengths: of each the length as u64 in little-endian
/// order, then the bytes.
#[derive(Clone, Default)]
pub struct Digest(Sha256);

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
        use sha2::Digest as _;
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
        use sha2::Digest as _;
        self.0.update(bytes);
    }
}

/// A reader or writer with the digest of all bytes that passed through it.
pub struct Digested<T> {
    inner: T,
    digest: Sha256,
}

impl<T> Digested<T> {
    /// Digests what passes from now on.
    pub fn new(inner: T) -> Self {
        Self {
            inner,
            digest: Sha256::default(),
        }
    }

    /// The reader or writer, and the digest so far.
    pub fn finish(self) -> (T, [u8; 32]) {
        use sha2::Digest as _;
        (self.inner, self.digest.finalize().into())
    }

    fn pass(&mut self, bytes: &[u8]) {
        use sha2::Digest as _;
        self.digest.update(bytes);
    }
}

impl<R: Read> Read for Digested<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.inner.read(bytes)?;
        self.pass(&bytes[..count]);
        Ok(count)
    }
}

impl<W: Write> Write for Digested<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.inner.write(bytes)?;
        self.pass(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against `sha256sum`, however the bytes are divided.
    #[test]
    fn bytes_that_pass_are_digested() {
        const ABC: &str = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        let hexadecimal = |digest: [u8; 32]| {
            let digits = digest.map(|byte| format!("{byte:02x}"));
            digits.concat()
        };
        let mut written = Digested::new(Vec::new());
        for part in [&b"a"[..], b"", b"bc"] {
            written.write_all(part).expect("memory is there");
        }
        let (bytes, digest) = written.finish();
        assert_eq!(
            (&bytes[..], hexadecimal(digest)),
            (&b"abc"[..], ABC.to_owned())
        );
        let mut read = Digested::new(&b"abcd"[..]);
        read.read_exact(&mut [0; 3]).expect("they are there");
        let (left, digest) = read.finish();
        assert_eq!((left, hexadecimal(digest)), (&b"d"[..], ABC.to_owned()));
    }

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
