//! A common entry point for the system calls of a write, so that tests can make any of them fail.

use std::io::{self, Write};

/// Makes a system call and repeats it if a signal interrupts it.
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

/// A writer whose system calls can be made to fail.
pub(super) struct CheckedWriter<W>(pub(super) W);

impl<W: Write> Write for CheckedWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        call("write", || self.0.write(shortened(bytes)))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(not(any(test, feature = "faults")))]
#[expect(clippy::unnecessary_wraps, reason = "fails in tests")]
fn injected(_name: &'static str) -> io::Result<()> {
    Ok(())
}

#[cfg(not(any(test, feature = "faults")))]
fn shortened(bytes: &[u8]) -> &[u8] {
    bytes
}

#[cfg(any(test, feature = "faults"))]
use super::faults::{injected, shortened};
