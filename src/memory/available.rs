//! The memory limits reported by the system.

use super::{Available, Limit};

/// Bytes reserved for allocations that are not checked beforehand: buffers, stacks, messages.
const SPARE: u64 = 16 << 20;

/// The memory available within the tightest hard limit, minus a reserve; `None` if none is known.
pub fn available() -> Option<Available> {
    // Beyond `memory.high` a group is slowed down, not stopped.
    let hard = limits()
        .into_iter()
        .filter(|available| available.limit != Limit::GroupHigh);
    let tightest = hard.min_by_key(|limit| limit.bytes)?;
    Some(Available {
        bytes: tightest.bytes.saturating_sub(SPARE),
        ..tightest
    })
}

/// The most bytes of memory that the process has had at once; `None` where that is not known.
pub fn peak() -> Option<u64> {
    #[cfg(target_os = "linux")]
    return resident("VmHWM:");
    #[cfg(not(target_os = "linux"))]
    None
}

/// The bytes of memory that the process has now; `None` where that is not known.
pub fn used() -> Option<u64> {
    #[cfg(target_os = "linux")]
    return resident("VmRSS:");
    #[cfg(not(target_os = "linux"))]
    None
}

/// The bytes of memory that the machine has; `None` where that is not known.
pub fn installed() -> Option<u64> {
    #[cfg(target_os = "linux")]
    {
        use super::proc;
        proc::kilobytes(&proc::read("/proc/meminfo"), "MemTotal:")
    }
    #[cfg(not(target_os = "linux"))]
    None
}

#[cfg(target_os = "linux")]
fn resident(key: &str) -> Option<u64> {
    let status = super::proc::read("/proc/self/status");
    super::proc::kilobytes(&status, key)
}

/// The memory available within each known limit.
#[cfg(target_os = "linux")]
pub fn limits() -> Vec<Available> {
    use super::{cgroup, proc};
    use rustix::process::{Resource, getrlimit};

    let mut limits = Vec::new();
    let mut add = |limit, bytes| limits.push(Available { bytes, limit });
    let status = proc::read("/proc/self/status");
    let used = |key| proc::kilobytes(&status, key).unwrap_or(0);
    if let Some(limit) = getrlimit(Resource::As).current {
        let threads = super::threads::address_space();
        let used = used("VmSize:").saturating_add(threads);
        add(Limit::AddressSpace, limit.saturating_sub(used));
    }
    if let Some(limit) = getrlimit(Resource::Data).current {
        add(Limit::Data, limit.saturating_sub(used("VmData:")));
    }
    for (limit, bytes) in cgroup::available() {
        add(limit, bytes);
    }
    let machine = proc::read("/proc/meminfo");
    if let Some(free) = proc::kilobytes(&machine, "MemAvailable:") {
        let swap = proc::kilobytes(&machine, "SwapFree:").unwrap_or(0);
        add(Limit::Machine, free.saturating_add(swap));
    }
    limits
}

/// The known limits. This system does not report how much of them is used.
#[cfg(not(target_os = "linux"))]
pub fn limits() -> Vec<Available> {
    use rustix::process::{Resource, getrlimit};
    let limit = getrlimit(Resource::As).current;
    limit
        .map(|bytes| Available {
            bytes,
            limit: Limit::AddressSpace,
        })
        .into_iter()
        .collect()
}
