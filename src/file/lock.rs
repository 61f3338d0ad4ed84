//! Locks that mark files in use. They end with the process at the latest.

use std::fs::{File, TryLockError};

use super::calls::call;

/// The result of an attempt to lock a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lock {
    /// Locked until the file is closed.
    Taken,
    /// Locked through another open file, in this process or another.
    Busy,
    /// Not known: the file system has no locks, or no more of them.
    Unknown,
}

/// Tries to take the advisory lock of a file, without waiting.
pub fn lock(file: &File) -> Lock {
    let locked = call("flock", || match file.try_lock() {
        Ok(()) => Ok(Lock::Taken),
        Err(TryLockError::WouldBlock) => Ok(Lock::Busy),
        Err(TryLockError::Error(error)) => Err(error),
    });
    locked.unwrap_or(Lock::Unknown)
}
