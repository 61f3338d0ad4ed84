//! A picture on the output stream.

use std::io::{self, BufWriter, IsTerminal, Write};

use crate::image_file::ImageFormat;
use crate::render::Frame;

/// Bytes that go to the stream at once. It flushes at every byte that looks like a line break, but
/// what is longer than its own buffer passes in one or two pieces.
const CHUNK: usize = 1 << 20;

/// Whether it is a terminal, which can't show a picture file.
pub(super) fn is_terminal() -> bool {
    io::stdout().is_terminal()
}

/// Fails where the stream is closed, as far as that can be told without writing.
pub(super) fn check() -> io::Result<()> {
    if is_stand_in() {
        Err(io::Error::other(
            "closed (or the null device, open for reading too)",
        ))
    } else {
        Ok(())
    }
}

/// Encodes a frame to the stream.
pub(super) fn write(format: ImageFormat, frame: &Frame) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(CHUNK, io::stdout().lock());
    format.write(frame, &mut out)?;
    out.flush()
}

/// Whether the stream is what the standard library opens before `main` in place of a closed one:
/// the null device, for reading and writing. Whoever wants nothing of the picture opens it for
/// writing alone, as a shell does.
#[cfg(unix)]
fn is_stand_in() -> bool {
    use std::os::unix::fs::MetadataExt;

    use rustix::fs::{FileType, OFlags, fcntl_getfl, fstat};
    let stream = rustix::stdio::stdout();
    let (Ok(flags), Ok(found), Ok(null)) = (
        fcntl_getfl(stream),
        fstat(stream),
        std::fs::metadata("/dev/null"),
    ) else {
        return false;
    };
    flags & OFlags::RWMODE == OFlags::RDWR
        && FileType::from_raw_mode(found.st_mode) == FileType::CharacterDevice
        && found.st_rdev == null.rdev()
}

#[cfg(not(unix))]
fn is_stand_in() -> bool {
    false
}
