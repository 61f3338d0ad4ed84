//! The sizes, the number of runs and the folder of temporary files.

use std::time::Duration;

use halflight::scene::Size;

/// The number of timed runs; the median is printed.
pub(crate) const RUNS: usize = 5;

/// A program that takes longer than this is run only three times.
pub(crate) const LONG: Duration = Duration::from_secs(6);

/// The number of threads of each program.
pub(crate) const THREADS: usize = 2;

/// The size of the pictures.
pub(crate) const WHOLE: Size = Size {
    width: 1280,
    height: 720,
};

/// The folder of temporary files, below the target folder.
pub(crate) const SCRATCH: &str = concat!(env!("CARGO_TARGET_TMPDIR"), "/peers");
