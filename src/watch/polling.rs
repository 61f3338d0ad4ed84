//! Comparing files at intervals, where the system does not notify.

use std::hash::{DefaultHasher, Hasher};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use super::notice::{Notice, WatchMessage};
use file::Version;

/// How many bytes of a file polling compares. In longer files, which only meshes are, it detects
/// changes of the length or of this beginning.
const COMPARED: u64 = 1 << 28;

/// How long a file may be written to again without a new time.
const RESOLUTION: Duration = Duration::from_secs(3);

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

/// A file when it was looked at last, so that what nobody writes to is not read again.
#[derive(Clone, Copy, Debug)]
pub(super) struct Seen {
    version: Option<Version>,
    content: Option<u64>,
    /// When this version was found.
    since: Instant,
}

impl Seen {
    pub(super) fn all(paths: &[PathBuf]) -> Vec<Self> {
        file::regain_folder();
        let seen = |path: &PathBuf| Self {
            version: Version::of(path).ok(),
            content: fingerprint(path),
            since: Instant::now(),
        };
        paths.iter().map(seen).collect()
    }

    /// Looks at the files again; returns whether a content has changed.
    pub(super) fn have_changed(all: &mut [Self], paths: &[PathBuf]) -> bool {
        file::regain_folder();
        let pairs = all.iter_mut().zip(paths);
        pairs.fold(false, |is_changed, (seen, path)| {
            seen.has_changed(path) || is_changed
        })
    }

    fn has_changed(&mut self, path: &Path) -> bool {
        let version = Version::of(path).ok();
        if version != self.version {
            self.version = version;
            self.since = Instant::now();
        } else if RESOLUTION < self.since.elapsed() {
            return false;
        }
        let content = fingerprint(path);
        std::mem::replace(&mut self.content, content) != content
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
