//! What is known of one submission.

use std::path::{Path, PathBuf};

use super::Verdict;
use super::thumbnail::Thumbnails;
use compare::{Comparison, Difference, SizesDiffer};
use scene::Size;
use text::{Findings, counted, visible, without_codes};

/// A submission, and what was found.
pub(super) struct Row {
    /// Its file.
    pub(super) submission: PathBuf,
    /// The file that it was compared with; `None` if there is none for it.
    pub(super) reference: Option<PathBuf>,
    pub(super) found: Found,
    /// The number of findings in a scene, by severity.
    pub(super) findings: Option<Counts>,
    /// Why the worst pixel differs, where a scene can be asked.
    pub(super) explained: Option<String>,
    /// Small pictures, if a document shows them.
    pub(super) thumbnails: Option<Thumbnails>,
}

/// What a comparison led to.
pub(super) enum Found {
    /// Figures; of pictures of different sizes, these.
    Compared {
        figures: Result<Comparison, SizesDiffer>,
        verdict: Verdict,
    },
    /// It cannot be compared, for this reason.
    Failed(String),
}

/// Numbers of findings.
#[derive(Clone, Copy)]
pub(super) struct Counts {
    pub(super) errors: usize,
    pub(super) warnings: usize,
    pub(super) notes: usize,
}

impl Counts {
    pub(super) fn of(findings: &Findings) -> Self {
        Self {
            errors: findings.errors(),
            warnings: findings.warnings(),
            notes: findings.notes(),
        }
    }

    /// In words, without what there is none of: `2 errors, 1 note`; empty if there is nothing.
    pub(super) fn words(self) -> String {
        let counts = [
            (self.errors, "error"),
            (self.warnings, "warning"),
            (self.notes, "note"),
        ];
        let there = counts.iter().filter(|(count, _)| 0 < *count);
        let words: Vec<_> = there.map(|(count, name)| counted(*count, name)).collect();
        words.join(", ")
    }
}

impl Row {
    pub(super) fn comparison(&self) -> Option<&Comparison> {
        match &self.found {
            Found::Compared { figures, .. } => figures.as_ref().ok(),
            Found::Failed(_) => None,
        }
    }

    pub(super) fn verdict(&self) -> Option<Verdict> {
        match &self.found {
            Found::Compared { verdict, .. } => Some(*verdict),
            Found::Failed(_) => None,
        }
    }

    /// The verdict in a word.
    pub(super) fn verdict_word(&self) -> &'static str {
        self.verdict().map_or("failed", Verdict::word)
    }

    /// The worst pixel, if any differs.
    pub(super) fn worst(&self) -> Option<&Difference> {
        self.comparison()?.worst.first()
    }

    /// Why it is not alike, or cannot be compared; safe to print.
    pub(super) fn reason(&self) -> Option<String> {
        let said = match &self.found {
            Found::Failed(reason) => reason.clone(),
            Found::Compared {
                figures: Err(SizesDiffer([reference, own])),
                ..
            } => format!("is {}, the reference {}", by(*own), by(*reference)),
            Found::Compared { .. } => self.explained.clone()?,
        };
        Some(visible(&without_codes(&said)).into_owned())
    }

    /// The numbers of findings in words; empty if there are none.
    pub(super) fn findings_words(&self) -> String {
        self.findings.map_or_else(String::new, Counts::words)
    }
}

/// How many submissions came out how.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Tally {
    pub(super) alike: usize,
    pub(super) different: usize,
    pub(super) failed: usize,
}

impl Tally {
    pub(super) fn of(rows: &[Row]) -> Self {
        let mut tally = Self::default();
        for row in rows {
            *match row.verdict() {
                Some(Verdict::Alike) => &mut tally.alike,
                Some(Verdict::Different) => &mut tally.different,
                None => &mut tally.failed,
            } += 1;
        }
        tally
    }

    /// In words: `60 compared: 12 alike, 40 different, 8 failed`.
    pub(super) fn words(self) -> String {
        let Self {
            alike,
            different,
            failed,
        } = self;
        let all = alike + different + failed;
        let submissions = counted(all, "submission");
        format!("{submissions}: {alike} alike, {different} different, {failed} failed")
    }
}

/// A path that is safe to print; bytes that are not UTF-8 are replaced.
pub(super) fn shown(path: &Path) -> String {
    visible(&path.to_string_lossy()).into_owned()
}

/// A size as it is written.
pub(super) fn by(Size { width, height }: Size) -> String {
    format!("{width}x{height}")
}
