//! Cancellation of long work.

/// Whether to give up the work, which then has no result. Every thread that works polls it, every few
/// milliseconds; work on a single thread takes a plain `&dyn Fn() -> bool`.
pub type IsCancelled<'c> = &'c (dyn Fn() -> bool + Sync);
