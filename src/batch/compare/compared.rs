//! A class that has been compared: what its reports tell.

use std::path::{Path, PathBuf};

use super::Compare;
use super::row::{Row, shown};
use super::thumbnail::Thumbnail;
use text::counted;

/// Everything that documents tell.
pub(super) struct Class<'c> {
    pub(super) work: &'c Compare,
    /// The references that were compared with, in order, and what they look like.
    pub(super) references: Vec<(PathBuf, Option<Thumbnail>)>,
    pub(super) rows: Vec<Row>,
}

impl Class<'_> {
    /// What is compared with, in words.
    pub(super) fn reference_words(&self) -> String {
        shown(&self.work.reference)
    }

    /// What counts as alike, in words.
    pub(super) fn rule_words(&self) -> String {
        let Compare {
            tolerance,
            max_differing,
            ..
        } = self.work;
        let pixels = counted(*max_differing, "pixel");
        format!("alike: at most {pixels} that differ by more than {tolerance} of 255")
    }

    /// The picture of a reference, and its number.
    pub(super) fn reference(&self, path: &Path) -> Option<(usize, &Thumbnail)> {
        let at = self.references.iter().position(|(of, _)| of == path)?;
        Some((at, self.references[at].1.as_ref()?))
    }
}
