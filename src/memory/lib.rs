//! The memory available to the process, whether work fits into it, the allocator and the heaps of the
//! program, and the threads that share it. Does not know what either is used for.
//!
//! Most failing allocations abort the process, and most systems grant more memory than exists. So
//! large work states its need before it begins, and is refused if that exceeds what the tightest
//! limit leaves.

mod available;
#[cfg(target_os = "linux")]
mod cgroup;
pub mod malloc;
mod pages;
#[cfg(target_os = "linux")]
mod proc;
mod threads;

use std::fmt;

pub use available::{available, installed, limits, peak, used};
pub use pages::Allocator;
pub use threads::{NoThreads, start_threads, start_threads_or_none, threads};

/// Work that needs fewer bytes is not checked: asking the system takes longer, and any other
/// allocation is as likely to fail.
const SMALL: u64 = 4 << 20;

/// Memory available to the process within a limit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Available {
    /// Bytes that can still be allocated.
    pub bytes: u64,
    /// The limit.
    pub limit: Limit,
}

/// A limit on memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// The address space of the process (`ulimit -v`).
    AddressSpace,
    /// The private memory of the process (`ulimit -d`).
    Data,
    /// The hard limit of a control group.
    Group,
    /// The limit beyond which a control group is throttled.
    GroupHigh,
    /// Free memory and swap space of the machine.
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
    /// What needs it, as a plural subject: `2000000 objects`.
    pub what: String,
    /// Approximate upper bound of the additional memory, in bytes.
    pub bytes: u64,
}

/// The error that work needs more memory than is available.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "out of memory: {} need about {}, of {} available ({})",
    need.what, megabytes(need.bytes), megabytes(available.bytes), available.limit
)]
pub struct OutOfMemory {
    /// The memory needed.
    pub need: Need,
    /// The memory available.
    pub available: Available,
}

/// Refuses work that does not fit. `most` is an upper bound that is quick to compute; `need` is
/// called only if that does not fit.
pub fn check(most: u64, need: impl FnOnce() -> Need) -> Result<(), OutOfMemory> {
    if most < SMALL {
        return Ok(());
    }
    match available() {
        Some(available) if available.bytes < most => fits(need(), available),
        _ => Ok(()),
    }
}

/// Refuses work that does not fit into what a limit of address space leaves, if there is one.
pub fn check_address_space(need: Need) -> Result<(), OutOfMemory> {
    let mut limits = limits().into_iter();
    match limits.find(|available| available.limit == Limit::AddressSpace) {
        Some(available) => fits(need, available),
        None => Ok(()),
    }
}

fn fits(need: Need, available: Available) -> Result<(), OutOfMemory> {
    if need.bytes <= available.bytes {
        return Ok(());
    }
    Err(OutOfMemory { need, available })
}

/// Formats a number of bytes for messages, rounded up: `340 MB`.
pub fn megabytes(bytes: u64) -> String {
    format!("{} MB", bytes.div_ceil(1_000_000))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_message_states_need_and_available_memory() {
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
    fn small_work_is_never_refused_and_impossible_work_always_is() {
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
