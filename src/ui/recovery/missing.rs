//! Edits kept of a scene that cannot be opened any more.

use std::path::Path;
use std::sync::Arc;

use super::claim::Claim;
use super::folder::{self, Folder};
use super::identity::Identity;
use super::offer::{left_behind, limit, read};
use super::record::{self, Content};
use crate::language::Language;

/// The base of the newest edits kept of a scene: what is left of it if its file is missing.
pub(crate) fn base_of(path: &Path, language: Language) -> Option<String> {
    base_in(&folder::state().ok()?, path, language)
}

/// The addition to the message that a scene cannot be opened, if edits of it are kept.
pub(crate) fn note(path: &Path, is_missing: bool) -> Option<String> {
    note_in(&folder::state().ok()?, path, is_missing)
}

pub(super) fn base_in(state: &Path, path: &Path, language: Language) -> Option<String> {
    let scene = Identity::of(Some(path), language);
    let claims = claims(state, &scene);
    claims.into_iter().rev().find_map(|claim| {
        let bytes = read(&claim, limit(0)).ok()?;
        match record::read(&bytes, &scene, "") {
            Content::Edits { base, .. } => Some(base),
            _ => None,
        }
    })
}

pub(super) fn note_in(state: &Path, path: &Path, is_missing: bool) -> Option<String> {
    let scene = Identity::of(Some(path), Language::of_path(path).ok()?);
    let claim = claims(state, &scene).pop()?;
    let (path, place) = (path.display(), claim.place());
    let place = place.display();
    Some(if is_missing {
        format!("{place} may hold unsaved edits of it, but cannot be used without the file")
    } else {
        format!(
            "unsaved edits of it are kept in {place}; halflight {path} offers them once it can \
             read {path}, or there is nothing of that name"
        )
    })
}

/// Claims the non-empty journals of a scene whose runs have ended, oldest first.
fn claims(state: &Path, scene: &Identity) -> Vec<Claim> {
    let Ok(Some(folder)) = Folder::find(state) else {
        return Vec::new();
    };
    let mut claims = left_behind(&Arc::new(folder), scene.names(), drop);
    claims.retain(|claim| claim.file().metadata().is_ok_and(|found| 0 < found.len()));
    claims
}
