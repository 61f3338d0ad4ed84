//! Giving up work that takes long.

/// Whether work is to be given up: what was begun has no result then. Polled every few milliseconds by
/// all threads that work; what one thread does alone takes a plain `&dyn Fn() -> bool`.
pub type IsCancelled<'c> = &'c (dyn Fn() -> bool + Sync);
