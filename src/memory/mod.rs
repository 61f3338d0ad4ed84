//! How much more memory the process may use, and whether work fits into it. Knows nothing of what
//! the memory is for.
//!
//! Most memory is allocated in ways that end the process where there is none, and on most systems
//! more is granted than exists. So large work states what it needs before it begins, and is refused
//! if that is more than the tightest limit leaves.

mod available;
#[cfg(target_os = "linux")]
mod cgroup;
#[cfg(target_os = "linux")]
mod proc;
mod threads;

use std::fmt;

pub use available::{available, limits};
pub use threads::{NoThreads, start_threads, threads};

/// Work that needs less is not checked: asking the system takes longer, and other allocations are as
/// likely to fail.
const SMALL: u64 = 4 << 20;

/// What a limit leaves to the process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Available {
    /// Bytes that can still be allocated.
    pub bytes: u64,
    /// What limits them.
    pub limit: Limit,
}

/// A limit on memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The process's address space: `ulimit -v`.
    AddressSpace,
    /// Its private memory: `ulimit -d`.
    Data,
    /// A control group's hard limit.
    Group,
    /// The limit beyond which a control group is throttled.
    GroupHigh,
    /// The machine's memory and swap space.
    Machine,
}

impl fmt::Display for Limit {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(match self {
            Self::AddressSpace => "RLIMIT_AS",
            Self::Data => "RLIMIT_DATA",
            Self::Group => "cgroup limit",
            Self::GroupHigh => "cgroup memory.high",
            Self::Machine => "free memory",
        })
    }
}

/// Work that needs memory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// What needs it, as the subject of a sentence in the plural: `2000000 objects`.
    pub what: String,
    /// About how much more memory the process will use at most.
    pub bytes: u64,
}

/// Work needs more memory than a limit leaves.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "out of memory: {} need about {}, of {} available ({})",
    need.what, megabytes(need.bytes), megabytes(available.bytes), available.limit
)]
pub struct OutOfMemory {
    /// What does not fit.
    pub need: Need,
    /// Where it does not fit.
    pub available: Available,
}

/// Refuses work that does not fit. `most` is a bound on what it needs that is quick to tell; only where
/// that does not fit the need itself is asked for.
pub fn check(most: u64, need: impl FnOnce() -> Need) -> Result<(), OutOfMemory> {
    if most < SMALL {
        return Ok(());
    }
    match available() {
        Some(available) if available.bytes < most => fits(need(), available),
        _ => Ok(()),
    }
}

fn fits(need: Need, available: Available) -> Result<(), OutOfMemory> {
    if need.bytes <= available.bytes {
        return Ok(());
    }
    Err(OutOfMemory { need, available })
}

/// A number of bytes as messages show it: `340 MB`.
pub fn megabytes(bytes: u64) -> String {
    format!("{} MB", bytes.div_ceil(1_000_000))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_fit_says_so() {
        let need = |bytes| Need {
            what: "2000000 objects".to_owned(),
            bytes,
        };
        let available = Available {
            bytes: 200_000_000,
            limit: Limit::AddressSpace,
        };
        assert_eq!(fits(need(200_000_000), available.clone()), Ok(()));
        let refused = fits(need(339_100_000), available).expect_err("it is too much");
        assert_eq!(
            refused.to_string(),
            "out of memory: 2000000 objects need about 340 MB, of 200 MB available (RLIMIT_AS)"
        );
    }

    #[test]
    fn small_work_is_never_refused_and_impossible_work_always() {
        let need = |bytes| Need {
            what: "things".to_owned(),
            bytes,
        };
        assert_eq!(check(SMALL - 1, || need(u64::MAX)), Ok(()));
        if available().is_some() {
            assert!(check(u64::MAX, || need(u64::MAX)).is_err());
            assert_eq!(check(u64::MAX, || need(0)), Ok(()));
        }
    }
}
