//! Memory that is free in this process, given back to the system.
//!
//! glibc keeps what is freed: for each thread an arena of its own, and in each of them all below a
//! threshold that follows the largest buffer ever freed. Frames are made by one thread and freed by
//! another, in other sizes after each resize, so that within minutes four fifths of the heap are
//! holes. Large buffers therefore get mappings of their own, and the rest is trimmed when idle: after
//! a quarter of an hour of edits the process held 16 MB instead of 33.
//!
//! A large scene is read anew in buffers of many megabytes. Mapped each time, every page of them is
//! cleared and faulted in again, which takes a fifth of the time from a save to its picture; there the
//! heap keeps them.

use std::thread;

/// Makes buffers as large as frames go back to the system as soon as they are freed.
pub(crate) fn map_large() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    glibc::mallopt(glibc::M_MMAP_THRESHOLD, MAPPED);
}

/// Makes the heap keep the buffers of a large scene from here on.
pub(crate) fn keep_large() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        glibc::mallopt(glibc::M_MMAP_THRESHOLD, KEPT);
        glibc::mallopt(glibc::M_TRIM_THRESHOLD, 2 * KEPT);
    }
}

/// Gives free memory back, on a thread of its own: it takes about as long as a frame.
pub(crate) fn trim() {
    // Without the thread it is given back later.
    let _ = thread::Builder::new()
        .name("trim".to_owned())
        .spawn(trim_now);
}

/// The size in bytes from which a buffer is mapped by itself: glibc's initial threshold, which no
/// longer adapts once it is set.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED: std::ffi::c_int = 128 << 10;

/// The same with a large scene: as far as glibc's own threshold goes.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: std::ffi::c_int = 32 << 20;

#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[expect(unsafe_code, reason = "no crate offers it otherwise")]
mod glibc {
    use std::ffi::c_int;

    pub(super) const M_TRIM_THRESHOLD: c_int = -1;
    pub(super) const M_MMAP_THRESHOLD: c_int = -3;

    unsafe extern "C" {
        // SAFETY: the signatures are those of malloc.h. Both may be called on any thread at any
        // time: they touch free memory and parameters only, under the locks of the arenas.
        pub(super) safe fn malloc_trim(pad: usize) -> c_int;
        pub(super) safe fn mallopt(parameter: c_int, value: c_int) -> c_int;
    }
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn trim_now() {
    glibc::malloc_trim(0);
}

/// Other allocators give memory back by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn trim_now() {}

#[cfg(all(test, target_os = "linux", target_env = "gnu"))]
mod tests {
    use super::*;

    /// The process's resident memory, in kB.
    fn resident() -> usize {
        let status = std::fs::read_to_string("/proc/self/status").expect("Linux has it");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
        kilobytes.expect("a number")
    }

    /// What trimming 32 MiB of holes below a buffer in use gives back, in kB.
    fn trimmed() -> usize {
        let holes: Vec<_> = (0..512).map(|_| vec![1_u8; 1 << 16]).collect();
        let last = vec![1_u8; 1 << 16];
        drop(holes);
        let before = resident();
        trim_now();
        let after = resident();
        drop(last);
        before.saturating_sub(after)
    }

    #[test]
    fn holes_in_the_heap_go_back_to_the_system() {
        // Other tests allocate meanwhile, but not each time.
        let most = (0..5).map(|_| trimmed()).max();
        assert!(Some(16_000) < most, "{most:?} kB");
    }
}
