//! Which submission is compared with which reference.

use std::collections::{HashMap, HashSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::slice;

use super::Compare;
use crate::Error;
use crate::folders::Listing;
use file::ReadError;
use image_file::ImageFormat;
use language::Language;

/// Submissions in the order in which they were named, and the references.
pub(super) struct Matching {
    pub(super) references: Vec<PathBuf>,
    pub(super) pairs: Vec<Pair>,
    /// What else the arguments name; its files are among the pairs.
    pub(super) listing: Listing,
}

/// A submission.
pub(super) struct Pair {
    pub(super) submission: PathBuf,
    /// The index of its reference, if there is one for it.
    pub(super) reference: Option<usize>,
}

/// Finds the submissions and their references. In folders, files with the extension of a picture or a scene
/// are looked at. One reference is that of all; of a folder, each submission has the one with its own path
/// inside its folder or the longest end of that, and else the same but for the extension.
pub(super) fn of(work: &Compare) -> Result<Matching, Error> {
    let references = references(&work.reference)?;
    let own: HashSet<_> = references
        .files
        .iter()
        .filter_map(|found| fs::canonicalize(&found.path).ok())
        .collect();
    // The references may be in a folder of submissions.
    let is_submission = |path: &Path| {
        is_wanted(path) && fs::canonicalize(path).is_ok_and(|path| !own.contains(&path))
    };
    let mut listing = Listing::of(&work.submissions, is_submission);
    if listing.files.is_empty() && listing.unreadable.is_empty() {
        return Err(nothing(&work.submissions[0]));
    }
    let by_path = references
        .files
        .iter()
        .enumerate()
        .map(|(at, found)| (found.inside.clone(), at));
    let by_path: HashMap<_, _> = by_path.collect();
    let by_stem = by_path
        .iter()
        .map(|(path, at)| (path.with_extension(""), *at));
    let by_stem: HashMap<_, _> = by_stem.collect();
    let is_of_folder = work.reference.is_dir();
    let find = |inside: &Path| {
        if !is_of_folder {
            return Some(0);
        }
        let exact = ends(inside).find_map(|end| by_path.get(end));
        let stem = || {
            let stem = inside.with_extension("");
            ends(&stem).find_map(|end| by_stem.get(end).copied())
        };
        exact.copied().or_else(stem)
    };
    let pairs = listing.files.drain(..).map(|found| Pair {
        reference: find(&found.inside),
        submission: found.path,
    });
    Ok(Matching {
        pairs: pairs.collect(),
        references: references
            .files
            .into_iter()
            .map(|found| found.path)
            .collect(),
        listing,
    })
}

/// The reference, or those in a folder.
fn references(reference: &PathBuf) -> Result<Listing, Error> {
    let mut listing = Listing::of(slice::from_ref(reference), is_wanted);
    if let Some((path, source)) = listing.unreadable.pop() {
        return Err(ReadError::Io { path, source }.into());
    }
    if listing.files.is_empty() {
        return Err(nothing(reference));
    }
    Ok(listing)
}

fn is_wanted(path: &Path) -> bool {
    ImageFormat::of_path(path).is_some() || Language::of_path(path).is_ok()
}

fn nothing(folder: &Path) -> Error {
    Error::Refused(format!(
        "{} holds no picture and no scene",
        folder.display()
    ))
}

/// A path, and what remains of it without its first folders.
fn ends(path: &Path) -> impl Iterator<Item = &Path> {
    let mut parts = path.components();
    std::iter::from_fn(move || {
        let end = parts.as_path();
        parts.next()?;
        Some(end)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_path_ends_in_the_paths_below_its_folders() {
        let ends: Vec<_> = ends(Path::new("a/b/c.ppm")).collect();
        assert_eq!(ends, ["a/b/c.ppm", "b/c.ppm", "c.ppm"].map(Path::new));
    }
}
