//! The system calls of a write, each behind one function, so that tests can fail any of them.

use std::io::{self, Write};

/// Makes a system call, again where a signal interrupts it.
pub(super) fn call<T>(
    name: &'static str,
    mut perform: impl FnMut() -> io::Result<T>,
) -> io::Result<T> {
    loop {
        match injected(name).and_then(|()| perform()) {
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            outcome => return outcome,
        }
    }
}

/// The content of a file being written.
pub(super) struct Content<W>(pub(super) W);

impl<W: Write> Write for Content<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        call("write", || self.0.write(shortened(bytes)))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(not(test))]
#[expect(clippy::unnecessary_wraps, reason = "tests have another one")]
fn injected(_name: &'static str) -> io::Result<()> {
    Ok(())
}

#[cfg(not(test))]
fn shortened(bytes: &[u8]) -> &[u8] {
    bytes
}

#[cfg(test)]
use super::faults::{injected, shortened};
