//! Which files may be read, and their bytes.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use rayon::prelude::*;

use super::trouble::Failure;
use crate::file::{self, directory_of};

/// Whether and from where a scene's files are read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate<'a> {
    /// Folders that may be read besides the scene's surroundings.
    pub(super) folders: &'a [PathBuf],
    /// The scene file; names are relative to its folder.
    pub(super) scene: &'a Path,
}

/// The bytes of a file.
#[derive(Clone, Debug)]
pub(super) struct Content {
    pub(super) bytes: Vec<u8>,
    /// What stands for them.
    pub(super) print: u64,
}

impl Gate<'_> {
    /// Where a file of this name stands.
    pub(super) fn place(&self, name: &str) -> PathBuf {
        directory_of(self.scene).join(name)
    }

    /// Reads a file, and takes its length from the `room` there is.
    pub(super) fn read(&self, name: &str, room: &mut u64) -> Result<Content, Failure> {
        let place = self.place(name);
        let real = fs::canonicalize(&place);
        if Path::new(name).is_absolute() && !self.may_come(&place) {
            return Err(Failure::Absolute(real.unwrap_or(place)));
        }
        let real = real?;
        if !self.may_read(name, &real) {
            return Err(Failure::Outside(real));
        }
        let bytes = file::read_bytes(&real, *room)?;
        *room -= bytes.len() as u64;
        Ok(Content {
            print: print(&bytes),
            bytes,
        })
    }

    /// Where a file stands whose changes matter: one that may be read, there or not.
    pub(super) fn watched(&self, name: &str) -> Option<PathBuf> {
        let place = self.place(name);
        let may = match fs::canonicalize(&place) {
            // A link that leads elsewhere may give way to a file.
            Ok(real) => {
                let own = fs::canonicalize(directory_of(&place));
                self.may_read(name, &real) || own.is_ok_and(|own| self.may_read(name, &own))
            }
            Err(_) => !Path::new(name).is_absolute() || self.may_come(&place),
        };
        may.then_some(place)
    }

    /// Whether a file without links on its way may be read for a name.
    fn may_read(&self, name: &str, real: &Path) -> bool {
        let surroundings = || {
            let folder = fs::canonicalize(directory_of(self.scene)).ok()?;
            Some(folder.parent().unwrap_or(&folder).to_owned())
        };
        let is_near = || surroundings().is_some_and(|folder| real.starts_with(folder));
        self.is_allowed(real) || !Path::new(name).is_absolute() && is_near()
    }

    /// Whether the user has named a folder above a file that is there or may come.
    fn may_come(&self, place: &Path) -> bool {
        let mut there = place.ancestors().filter_map(|at| fs::canonicalize(at).ok());
        there.next().is_some_and(|real| self.is_allowed(&real))
    }

    /// Whether the user has named a folder above it.
    fn is_allowed(&self, real: &Path) -> bool {
        let folders = self.folders.iter();
        let mut real_folders = folders.filter_map(|folder| fs::canonicalize(folder).ok());
        real_folders.any(|folder| real.starts_with(folder))
    }
}

/// What stands for bytes. Those of large files are taken in by parts, side by side.
fn print(bytes: &[u8]) -> u64 {
    const PART: usize = 1 << 20;
    fn of(value: impl Hash) -> u64 {
        let mut hasher = DefaultHasher::new();
        value.hash(&mut hasher);
        hasher.finish()
    }
    if bytes.len() <= PART {
        return of(bytes);
    }
    let parts: Vec<u64> = bytes.par_chunks(PART).map(of).collect();
    of(parts)
}
