//! Pipes and devices as targets of a write.

use std::fs::{File, OpenOptions};
use std::io;
use std::path::Path;

/// Opens a pipe or a device for writing. Waits up to a second for a pipe's reader, which may have
/// been started at the same time. Fails if there is none.
pub(super) fn open(path: &Path) -> io::Result<File> {
    use std::thread;
    use std::time::{Duration, Instant};

    use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
    use rustix::io::Errno;

    const PATIENCE: Duration = Duration::from_secs(1);
    const PAUSE: Duration = Duration::from_millis(10);
    let deadline = Instant::now() + PATIENCE;
    let stream = loop {
        match super::without_waiting(OpenOptions::new().write(true)).open(path) {
            Err(error) if Errno::from_io_error(&error) == Some(Errno::NXIO) => {
                if deadline <= Instant::now() {
                    return Err(io::Error::new(
                        error.kind(),
                        "no process is reading this pipe",
                    ));
                }
                thread::sleep(PAUSE);
            }
            opened => break opened?,
        }
    };
    if stream.metadata()?.is_file() {
        return Err(io::Error::other("has been replaced by a file"));
    }
    // From here on, writes wait for a slow reader.
    let flags = fcntl_getfl(&stream)?;
    fcntl_setfl(&stream, flags - OFlags::NONBLOCK)?;
    Ok(stream)
}
