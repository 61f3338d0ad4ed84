//! Locks that tell who is at work on a file: they end with the process at the latest.

use std::fs::{File, TryLockError};

use super::calls::call;

/// What came of an attempt to lock a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Lock {
    /// It is locked until it is closed.
    Taken,
    /// It is locked by whoever opened it another time, in this process or another one.
    Busy,
    /// Whether it is locked can't be known: its file system has no locks, or no more of them.
    Unknown,
}

/// Locks a file, without waiting, against others who lock it.
pub(crate) fn lock(file: &File) -> Lock {
    let locked = call("flock", || match file.try_lock() {
        Ok(()) => Ok(Lock::Taken),
        Err(TryLockError::WouldBlock) => Ok(Lock::Busy),
        Err(TryLockError::Error(error)) => Err(error),
    });
    locked.unwrap_or(Lock::Unknown)
}
