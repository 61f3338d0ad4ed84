//! The current folder, in which relative paths begin. It may be removed and made again while the program
//! runs, as by `git switch`: then the new one takes its place.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::target::directory_of;

/// Where the current folder was last.
static LAST: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Enters the folder that has taken the place of the current one, if that was removed: relative paths
/// lead nowhere until then. Meant to be called before files are opened, also to learn where the folder
/// is as long as it exists. Returns whether there is a current folder.
pub fn regain_folder() -> bool {
    let mut last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
    match env::current_dir() {
        Ok(now) => {
            *last = Some(now);
            true
        }
        Err(_) => last
            .as_ref()
            .is_some_and(|last| env::set_current_dir(last).is_ok()),
    }
}

/// An absolute path, which for a relative one may begin in a current folder that was removed.
pub fn absolute(path: &Path) -> PathBuf {
    regain_folder();
    std::path::absolute(path).unwrap_or_else(|_| {
        let last = LAST.lock().unwrap_or_else(PoisonError::into_inner);
        last.clone().unwrap_or_default().join(path)
    })
}

/// Whether the folder of a path exists, also if that cannot be determined.
pub fn has_folder(path: &Path) -> bool {
    let has_start = regain_folder() || path.is_absolute();
    has_start && !matches!(directory_of(path).try_exists(), Ok(false))
}
