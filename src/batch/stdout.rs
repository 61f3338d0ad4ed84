//! Standard output.

use std::io::{self, BufWriter, IsTerminal, Write};

use super::Error;
use file::Content;

/// Bytes written at once. `Stdout` flushes at every byte that looks like a line break, but passes
/// on writes longer than its own buffer in one or two pieces.
const CHUNK: usize = 1 << 20;

/// Whether standard output is a terminal, which cannot show a picture file.
pub(super) fn is_terminal() -> bool {
    io::stdout().is_terminal()
}

/// Fails if standard output is closed, as far as that can be detected without writing.
pub(super) fn check() -> io::Result<()> {
    if is_placeholder() {
        Err(io::Error::other(
            "closed (or the null device, opened for reading too)",
        ))
    } else {
        Ok(())
    }
}

/// Writes to standard output in long pieces.
pub(super) fn write(write: &mut Content<'_>) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(CHUNK, io::stdout().lock());
    write(&mut out)?;
    out.flush()
}

/// Prints a text to standard output. A reader that closes the pipe early has what it wanted.
pub(super) fn print(text: &str) -> io::Result<()> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(error),
        _ => Ok(()),
    }
}

/// The error of writing to standard output.
pub(super) fn error(source: io::Error) -> Error {
    Error::Write {
        to: "standard output".to_owned(),
        source,
    }
}

/// Whether standard output is what the standard library opens before `main` in place of a closed
/// stream: the null device, for reading and writing. A shell's `>/dev/null` opens it for writing
/// only.
fn is_placeholder() -> bool {
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
