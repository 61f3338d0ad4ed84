//! Merges a text from outside with unsaved edits, while the document can be edited.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::changes::{Change, LIMITS, Limits, changes};
use super::{Conflict, Document, Merge, Side};
use language::{Language, Lowered, Source};
use memory::OutOfMemory;
use scene::Meshes;
use text::{Edit, Findings, smallest_edit};

/// Each edit of a text costs as much as parsing a fraction of it.
const FEW: usize = 4;

/// What a merge with a text from outside needs of a document, at one moment.
#[derive(Clone, Debug)]
pub struct Snapshot {
    /// The language of the text.
    pub language: Language,
    /// The text last saved or loaded.
    pub saved: Arc<String>,
    /// The text being edited, if it differs.
    pub edited: Option<Arc<String>>,
}

/// A text from outside merged with unsaved edits, for [`Document::take`].
#[derive(Debug)]
pub struct Merged {
    /// The merged text and its tree; its saved text is the one from outside.
    pub document: Document,
    /// The edits that lead back to the text that was edited.
    pub(super) back: Vec<Edit>,
}

impl Snapshot {
    /// Whether a document is unchanged since the snapshot.
    pub fn is_of(&self, document: &Document) -> bool {
        let is_text = match &self.edited {
            Some(edited) => Arc::ptr_eq(edited, document.source.text()),
            None => !document.is_dirty,
        };
        is_text && Arc::ptr_eq(&self.saved, &document.saved)
    }

    /// The text being edited.
    pub fn text(&self) -> &Arc<String> {
        self.edited.as_ref().unwrap_or(&self.saved)
    }

    /// The snapshot as if another text had been saved last.
    #[must_use]
    pub fn with_saved(&self, saved: Arc<String>) -> Self {
        let edited = Some(self.text()).filter(|text| **text != saved);
        Self {
            language: self.language,
            edited: edited.cloned(),
            saved,
        }
    }

    /// Whether a text from outside has the edits that lead from the saved text to `edited`; in their places
    /// it may have something that `is_same` accepts.
    pub fn has_edits(
        &self,
        edited: &Arc<String>,
        outside: &Arc<String>,
        is_same: impl Fn(&Conflict) -> bool,
    ) -> bool {
        if edited == outside {
            return true;
        }
        let mut merge = Merge::new(self.language, &self.saved, edited, outside);
        let are_same = merge.conflicts.iter().all(is_same);
        for conflict in &mut merge.conflicts {
            conflict.decision = Some(Side::Theirs);
        }
        are_same && merge.text() == **outside
    }

    /// Merges a text from outside with the unsaved edits, and lowers the result. The inner error is
    /// a merge to decide: both changed the same places, or each of them is sound and both together
    /// are not, as where one deletes what the other begins to use.
    ///
    /// # Errors
    ///
    /// Fails if that would take more memory than is available.
    pub fn merge(
        &self,
        theirs: Document,
        meshes: &Meshes,
    ) -> Result<Result<(Merged, Lowered), Merge>, OutOfMemory> {
        let (base, mine, outside) = (&self.saved, self.text(), theirs.shared_text());
        let merge = Merge::new(self.language, base, mine, &outside);
        if !merge.conflicts.is_empty() {
            return Ok(Err(merge));
        }
        let is_exact = theirs.source.recount().is_empty();
        let (merged, lowered) = self.merged(theirs, &merge, is_exact, meshes)?;
        if self.agrees(&lowered.diagnostics, &outside, meshes)? {
            return Ok(Ok((merged, lowered)));
        }
        if let Some(apart) = self.set_apart(&outside) {
            let merge = Merge::new(self.language, base, &apart, &outside);
            if merge.conflicts.is_empty() {
                let (merged, lowered) = self.merged(merged.document, &merge, is_exact, meshes)?;
                if self.agrees(&lowered.diagnostics, &outside, meshes)? {
                    return Ok(Ok((merged, lowered)));
                }
            }
        }
        Ok(Err(Merge::undivided(base, mine, &outside)))
    }

    /// The result of a merge without conflicts, made from a document whose saved text is the one
    /// from outside; `is_exact` tells whether that has the right counts.
    fn merged(
        &self,
        mut document: Document,
        merge: &Merge,
        is_exact: bool,
        meshes: &Meshes,
    ) -> Result<(Merged, Lowered), OutOfMemory> {
        let mut text = String::clone(&merge.mine);
        let mut back = text::apply(&mut text, &merge.edits());
        lead_to(&mut document, &text);
        // As in `Merge::counted_edits`.
        let counts = document.source.recount();
        let is_recounted =
            !counts.is_empty() && is_exact && is_exact_as(&mut document, &merge.mine);
        if is_recounted {
            document.change(&counts);
        }
        if is_recounted || merge.mine != *self.text() {
            back = smallest_edit(document.text(), self.text())
                .into_iter()
                .collect();
        }
        let lowered = document.lower(meshes)?;
        Ok((Merged { document, back }, lowered))
    }

    /// Whether a merged text has only errors and warnings that the changes of both sides explain.
    fn agrees(
        &self,
        merged: &Findings,
        theirs: &Arc<String>,
        meshes: &Meshes,
    ) -> Result<bool, OutOfMemory> {
        if merged.is_empty() {
            return Ok(true);
        }
        let found = |text: &Arc<String>| {
            language::fits(self.language, text, 0)?;
            let lowered = Source::new(self.language, Arc::clone(text)).lower(meshes)?;
            Ok(kinds(&lowered.diagnostics))
        };
        let (base, mine, theirs) = (found(&self.saved)?, found(self.text())?, found(theirs)?);
        Ok(kinds(merged).into_iter().all(|(kind, count)| {
            let [base, mine, theirs] =
                [&base, &mine, &theirs].map(|found| found.get(&kind).copied().unwrap_or(0));
            // Both may have corrected the same.
            count <= (mine + theirs).saturating_sub(base).max(mine.min(theirs))
        }))
    }

    /// The text being edited with other names and IDs for what is new in it, where a text from
    /// outside gives the same to something new of its own.
    fn set_apart(&self, theirs: &str) -> Option<Arc<String>> {
        let mut source = Source::new(self.language, Arc::clone(self.text()));
        let edits = source.set_apart(&self.saved, theirs);
        source.change(&edits);
        (!edits.is_empty()).then(|| Arc::clone(source.text()))
    }
}

/// Gives a document another text, by several edits if they are few: what lies between them is then
/// not parsed again. Returns the edits that lead back, to be applied one after another.
fn lead_to(document: &mut Document, text: &str) -> Vec<Edit> {
    let few = Limits {
        most: FEW,
        ..LIMITS
    };
    let changes = changes(document.text(), text, few).into_iter().rev();
    let back = changes.flat_map(|Change { base, other }| {
        let text = other.of(text).to_owned();
        document.change(&[Edit { span: base, text }])
    });
    let mut back: Vec<_> = back.collect();
    back.reverse();
    back
}

/// Whether a document would have the right counts if it had another text.
fn is_exact_as(document: &mut Document, text: &str) -> bool {
    let back = lead_to(document, text);
    let is_exact = document.source.recount().is_empty();
    for edit in back {
        document.change(&[edit]);
    }
    is_exact
}

/// The number of findings of each kind: messages without their numbers, since nodes are counted.
fn kinds(findings: &Findings) -> BTreeMap<String, usize> {
    let mut kinds = BTreeMap::new();
    for finding in findings.iter() {
        let kind = finding.message.replace(|c: char| c.is_ascii_digit(), "");
        *kinds.entry(kind).or_insert(0) += 1;
    }
    kinds
}
