//! The current folder, in which relative paths begin. It may be removed and made again while the program
//! runs, as by `git switch`: then the new one takes its place.

use std::env;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use super::target::directory_of;

/// Where the current folder has been, the last place last.
static PLACES: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The most places that are remembered: the first, and the last ones.
const MOST: usize = 16;

/// Enters the folder that has taken the place of the current one, if that was removed: relative paths
/// lead nowhere until then. Of several places it has had, the last counts that there is a folder at.
/// Meant to be called before files are opened, also to learn where the folder is as long as it exists.
/// Returns whether there is a current folder.
pub fn regain_folder() -> bool {
    let mut places = PLACES.lock().unwrap_or_else(PoisonError::into_inner);
    let Ok(now) = env::current_dir() else {
        let mut places = places.iter().rev();
        return places.any(|place| env::set_current_dir(place).is_ok());
    };
    if places.last() != Some(&now) {
        places.retain(|place| *place != now);
        if MOST <= places.len() {
            places.remove(1);
        }
        places.push(now);
    }
    true
}

/// An absolute path, which for a relative one may begin in a current folder that was removed.
pub fn absolute(path: &Path) -> PathBuf {
    regain_folder();
    std::path::absolute(path).unwrap_or_else(|_| {
        let places = PLACES.lock().unwrap_or_else(PoisonError::into_inner);
        places.last().cloned().unwrap_or_default().join(path)
    })
}

/// Whether the folder of a path exists, also if that cannot be determined.
pub fn has_folder(path: &Path) -> bool {
    let has_start = regain_folder() || path.is_absolute();
    has_start && !matches!(directory_of(path).try_exists(), Ok(false))
}
