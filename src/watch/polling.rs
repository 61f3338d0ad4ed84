//! Comparing files at intervals, where the system does not notify.

use std::hash::{DefaultHasher, Hasher};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::Duration;

use super::notice::{Notice, WatchMessage};
use crate::file;

/// How many bytes of a file polling compares. In longer files, which only meshes are, it detects
/// changes of the length or of this beginning.
const COMPARED: u64 = 1 << 28;

/// Compares contents, not times: these may have a resolution of a second, and be set back.
pub(super) fn poll(
    paths: &[PathBuf],
    first: Vec<Option<u64>>,
    interval: Duration,
    notices: &Receiver<WatchMessage>,
    notify: impl Fn(Notice),
) {
    let mut last = first;
    while matches!(
        notices.recv_timeout(interval),
        Err(RecvTimeoutError::Timeout)
    ) {
        let now = fingerprints(paths);
        if now != last {
            last = now;
            notify(Notice::Changed);
        }
    }
}

/// Hashes of the files' contents; `None` for a file that cannot be read.
pub(super) fn fingerprints(paths: &[PathBuf]) -> Vec<Option<u64>> {
    file::regain_folder();
    paths.iter().map(|path| fingerprint(path)).collect()
}

fn fingerprint(path: &Path) -> Option<u64> {
    struct Hashing(DefaultHasher);

    impl Write for Hashing {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.write(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    let file = file::open(path).ok()?;
    let mut hashing = Hashing(DefaultHasher::new());
    hashing.0.write_u64(file.metadata().ok()?.len());
    io::copy(&mut file.take(COMPARED), &mut hashing).ok()?;
    Some(hashing.0.finish())
}
