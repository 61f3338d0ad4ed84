//! An allocator that counts and fails on purpose.
#![allow(unsafe_code, reason = "implementing an allocator requires unsafe code")]

use std::alloc::{GlobalAlloc, Layout, System};
use std::ptr;
use std::sync::atomic::{AtomicU64, Ordering};

#[global_allocator]
static ALLOCATOR: Failing = Failing;

/// The number of allocations, on all threads.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// The numbers of the first and last allocations that fail.
static FIRST: AtomicU64 = AtomicU64::new(u64::MAX);
static LAST: AtomicU64 = AtomicU64::new(u64::MAX);

/// The bytes currently allocated, and their maximum so far.
static BYTES: AtomicU64 = AtomicU64::new(0);
static MOST: AtomicU64 = AtomicU64::new(0);

/// The system's allocator, except for some allocations.
struct Failing;

/// Makes the allocations from `first` to `last` fail, counted from 1 at this call.
pub(crate) fn fail(first: u64, last: u64) {
    COUNT.store(0, Ordering::SeqCst);
    LAST.store(last, Ordering::SeqCst);
    FIRST.store(first, Ordering::SeqCst);
}

/// The number of allocations since [`fail`].
pub(crate) fn count() -> u64 {
    COUNT.load(Ordering::SeqCst)
}

/// The maximum number of bytes allocated at once.
pub(crate) fn most_bytes() -> u64 {
    MOST.load(Ordering::SeqCst)
}

fn grow(by: usize) {
    let bytes = by as u64 + BYTES.fetch_add(by as u64, Ordering::Relaxed);
    MOST.fetch_max(bytes, Ordering::Relaxed);
}

fn shrink(by: usize) {
    BYTES.fetch_sub(by as u64, Ordering::Relaxed);
}

fn fails() -> bool {
    let number = 1 + COUNT.fetch_add(1, Ordering::Relaxed);
    FIRST.load(Ordering::Relaxed) <= number && number <= LAST.load(Ordering::Relaxed)
}

// SAFETY: all calls go to the system's allocator; a null pointer reports that memory is exhausted.
unsafe impl GlobalAlloc for Failing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if fails() {
            return ptr::null_mut();
        }
        grow(layout.size());
        // SAFETY: the caller upholds the contract, which is the same.
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        if fails() {
            return ptr::null_mut();
        }
        grow(layout.size());
        // SAFETY: the caller upholds the contract, which is the same.
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        shrink(layout.size());
        // SAFETY: the caller upholds the contract, which is the same.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if fails() {
            return ptr::null_mut();
        }
        // Both blocks exist during the copy.
        grow(size);
        shrink(layout.size());
        // SAFETY: the caller upholds the contract, which is the same.
        unsafe { System.realloc(pointer, layout, size) }
    }
}
