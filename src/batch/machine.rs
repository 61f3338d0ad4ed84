//! The machine, as benchmarks name it.

use std::num::NonZero;
use std::thread;

/// What the speed of tracing depends on.
pub(super) struct Machine {
    /// The name of the processor.
    pub(super) processor: String,
    /// The cores that the process may use.
    pub(super) cores: usize,
    /// The vector instructions that are used.
    pub(super) vectors: &'static str,
    /// Bytes of memory.
    pub(super) memory: u64,
}

impl Machine {
    pub(super) fn found() -> Self {
        Self {
            processor: processor().unwrap_or_else(|| std::env::consts::ARCH.to_owned()),
            cores: thread::available_parallelism().map_or(1, NonZero::get),
            vectors: render::simd_level_name(),
            memory: memory::installed().unwrap_or(0),
        }
    }
}

/// The processor's own name for itself, where the system tells it.
fn processor() -> Option<String> {
    let table = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = table.lines().find(|line| line.starts_with("model name"))?;
    Some(line.split_once(':')?.1.trim().to_owned())
}
