//! Edits kept of a scene that cannot be opened any more.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::claim::Claim;
use super::identity::Identity;
use super::offer::{left_behind, limit, read};
use super::record::{self, Content};
use file::state_folder::{self, Folder, Store};
use language::Language;

/// The base of the newest edits kept of a scene, or of the one without a file: what is left of it if
/// its file is missing.
pub(crate) fn base_of(path: Option<&Path>, language: Language) -> Option<String> {
    base_in(&state_folder::path().ok()?, path, language)
}

pub(super) fn base_in(state: &Path, path: Option<&Path>, language: Language) -> Option<String> {
    let scene = Identity::of(path, language);
    let claims = claims(state, &scene);
    claims.into_iter().rev().find_map(|claim| {
        let bytes = read(&claim, limit(0)).ok()?;
        match record::read(&bytes, &scene, "") {
            Content::Edits { base, .. } => Some(base),
            _ => None,
        }
    })
}

/// The addition to the message that a scene is missing, if edits of it may be kept below a state
/// folder.
pub(crate) fn note_for_missing(state: &Path, path: &Path) -> Option<String> {
    let place = newest_place(state, path)?;
    let place = place.display();
    Some(format!(
        "{place} may hold unsaved edits of it, but cannot be used without the file"
    ))
}

/// The addition to the message that a scene cannot be read, if edits of it are kept below a state
/// folder.
pub(crate) fn note_for_unreadable(state: &Path, path: &Path) -> Option<String> {
    let place = newest_place(state, path)?;
    let (path, place) = (path.display(), place.display());
    Some(format!(
        "unsaved edits of it are kept in {place}; halflight {path} offers them once it can read \
         {path}, or there is nothing of that name"
    ))
}

/// The path of a scene's newest journal.
fn newest_place(state: &Path, path: &Path) -> Option<PathBuf> {
    let scene = Identity::of(Some(path), Language::of_path(path).ok()?);
    Some(claims(state, &scene).pop()?.place())
}

/// Claims the non-empty journals of a scene whose runs have ended, oldest first.
fn claims(state: &Path, scene: &Identity) -> Vec<Claim> {
    let Ok(Some(folder)) = Folder::find(state, Store::Edits) else {
        return Vec::new();
    };
    let mut claims = left_behind(&Arc::new(folder), scene.names(), drop);
    claims.retain(|claim| claim.file().metadata().is_ok_and(|found| 0 < found.len()));
    claims
}
