//! The heaps of the GNU C library: how many there are, and what they return to the system.
//!
//! Each of the first threads has a heap of its own, which reserves 64 MB of address space, and twice as
//! much while it is begun. Under a limit of address space these few heaps would take what the stacks of
//! further threads need, though more of it is used by nobody.
//!
//! glibc keeps freed memory in one arena per thread, each retaining everything below a threshold
//! that follows the largest buffer ever freed. Frames are allocated by one thread and freed by
//! another, in other sizes after each resize, so that within minutes four fifths of the heap are
//! holes. Therefore large buffers get their own mappings, and the rest is trimmed when idle: after
//! a quarter of an hour of edits the process held 16 MB instead of 33.
//!
//! Reading a large scene allocates buffers of many megabytes. If each were mapped, all their pages
//! would be cleared and faulted in again each time, a fifth of the time from a save to its picture;
//! for large scenes, the heap keeps these buffers.

use std::thread;

/// Lets threads share heaps under a limit of address space. To be called before any thread is started.
pub fn share() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    if let Some(limit) = super::threads::address_space_limit() {
        let most = 1 + super::threads::more_heaps(limit);
        let most = std::ffi::c_int::try_from(most).unwrap_or(std::ffi::c_int::MAX);
        glibc::mallopt(glibc::M_ARENA_MAX, most);
    }
}

/// Maps buffers of the size of frames individually, so that they return to the system as soon as
/// they are freed.
pub fn map_large() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    glibc::mallopt(glibc::M_MMAP_THRESHOLD, MAPPED);
}

/// Makes the heap keep the buffers of a large scene from now on.
pub fn keep_large() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    {
        glibc::mallopt(glibc::M_MMAP_THRESHOLD, KEPT);
        glibc::mallopt(glibc::M_TRIM_THRESHOLD, 2 * KEPT);
    }
}

/// Returns free memory on another thread, as this takes about as long as a frame.
pub fn trim() {
    // Without the thread it is returned later.
    let _ = thread::Builder::new()
        .name("trim".to_owned())
        .spawn(trim_now);
}

/// Size in bytes from which a buffer gets its own mapping: glibc's initial threshold, which no
/// longer adapts once set.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const MAPPED: std::ffi::c_int = 128 << 10;

/// The same with a large scene: the maximum of glibc's adaptive threshold.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const KEPT: std::ffi::c_int = 32 << 20;

#[cfg(all(target_os = "linux", target_env = "gnu"))]
#[expect(unsafe_code, reason = "no crate offers these calls")]
mod glibc {
    use std::ffi::c_int;

    pub(super) const M_ARENA_MAX: c_int = -8;
    pub(super) const M_TRIM_THRESHOLD: c_int = -1;
    pub(super) const M_MMAP_THRESHOLD: c_int = -3;

    unsafe extern "C" {
        // SAFETY: the signatures are those of malloc.h. Both functions may be called on any thread
        // at any time: they access only free memory and parameters, under the locks of the arenas.
        pub(super) safe fn malloc_trim(pad: usize) -> c_int;
        pub(super) safe fn mallopt(parameter: c_int, value: c_int) -> c_int;
    }
}

#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn trim_now() {
    glibc::malloc_trim(0);
}

/// Other allocators return memory by themselves.
#[cfg(not(all(target_os = "linux", target_env = "gnu")))]
fn trim_now() {}

#[cfg(all(test, target_os = "linux", target_env = "gnu"))]
mod tests {
    use super::*;

    /// Resident memory of the process, in kB.
    fn resident() -> usize {
        let status = std::fs::read_to_string("/proc/self/status").expect("Linux has it");
        let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
        let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse().ok());
        kilobytes.expect("a number")
    }

    /// The memory returned by trimming 32 MiB of holes below a buffer in use, in kB.
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
    fn holes_in_the_heap_are_returned_to_the_system() {
        // Other tests allocate concurrently, but not every time.
        let most = (0..5).map(|_| trimmed()).max();
        assert!(Some(16_000) < most, "{most:?} kB");
    }
}
