//! The edits of this run, kept for the next one.

use std::io::{self, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::claim::Claim;
use super::identity::Identity;
use super::record;
use document::Snapshot;
use file::state_folder::{Folder, Store};
use language::Language;
use text::Edit;

/// Outdated edits may take this many bytes, or as many as the text if it is longer.
const WASTE: u64 = 1 << 20;

/// The unsaved edits of a text.
#[derive(Clone, Debug)]
pub(crate) struct Edits {
    /// The scene's path; `None` for the scene without a file.
    pub(crate) scene: Option<PathBuf>,
    /// The text that the edits are based on, and the edited text.
    pub(crate) known: Snapshot,
}

/// An edited text as one edit of the text that it is based on.
struct Change {
    scene: Option<PathBuf>,
    language: Language,
    saved: Arc<String>,
    edit: Edit,
}

impl From<Edits> for Change {
    /// Drops the edited text: while it is shared, the interface has to copy it for its next edit.
    fn from(Edits { scene, known }: Edits) -> Self {
        Self {
            scene,
            language: known.language,
            edit: record::difference(&known.saved, known.text()),
            saved: known.saved,
        }
    }
}

impl Change {
    /// The length of the edited text in bytes.
    fn len(&self) -> usize {
        self.saved.len() - self.edit.span.len() + self.edit.text.len()
    }
}

/// This run's journal, created once there is something to keep.
#[derive(Debug)]
pub(super) struct Journal {
    state: PathBuf,
    held: Option<OpenJournal>,
}

#[derive(Debug)]
struct OpenJournal {
    folder: Arc<Folder>,
    claim: Claim,
    scene: Option<PathBuf>,
    language: Language,
    identity: Identity,
    base: Arc<String>,
    head: Head,
    /// The offset of the end of the last edit; `None` if the content there is unknown.
    end: Option<u64>,
}

impl Journal {
    /// Creates the journal of a run with this state folder.
    pub(super) fn new(state: PathBuf) -> Self {
        Self { state, held: None }
    }

    /// Keeps a text instead of the last one. If that fails, the last one remains.
    pub(super) fn write(&mut self, edits: Edits) -> io::Result<()> {
        let change = Change::from(edits);
        let fits = |held: &&mut OpenJournal| {
            held.scene == change.scene && held.language == change.language && held.is_found()
        };
        if let Some(held) = self.held.as_mut().filter(fits) {
            return held.write(&change);
        }
        let held = OpenJournal::new(&self.state, &change)?;
        match self.held.replace(held) {
            Some(before) => before.claim.remove(),
            None => Ok(()),
        }
    }

    /// Forgets what is kept.
    pub(super) fn forget(&mut self) -> io::Result<()> {
        self.held.take().map_or(Ok(()), |held| held.claim.remove())
    }

    /// Whether anything is kept where the next run will look for it.
    pub(super) fn is_kept(&self) -> bool {
        self.held.as_ref().is_some_and(OpenJournal::is_kept)
    }
}

impl OpenJournal {
    fn new(state: &Path, change: &Change) -> io::Result<Self> {
        let folder = Arc::new(Folder::make(state, Store::Edits)?);
        let identity = Identity::of(change.scene.as_deref(), change.language);
        let (content, head) = beginning(&identity, change);
        let claim = Claim::new(&folder, &identity)?;
        if let Err(error) = claim.fill(&content) {
            let _ = claim.remove();
            return Err(error);
        }
        Ok(Self {
            folder,
            claim,
            scene: change.scene.clone(),
            language: change.language,
            identity,
            base: Arc::clone(&change.saved),
            head,
            end: Some(content.len() as u64),
        })
    }

    /// Whether the next run would find the journal, which may have been removed or moved away.
    fn is_found(&self) -> bool {
        self.folder.is_sound() && self.claim.is_there()
    }

    /// Whether the next run would find the last text in the journal.
    fn is_kept(&self) -> bool {
        let is_as_left = |end| self.claim.is_as_left(end);
        self.is_found() && self.end.is_some_and(is_as_left)
    }

    fn write(&mut self, change: &Change) -> io::Result<()> {
        let is_base = self.base == change.saved;
        let room = self.head.end + WASTE.max(change.len() as u64);
        let end = self.end.take();
        match end.filter(|&end| is_base && end < room && self.claim.is_as_left(end)) {
            Some(end) => self.append(end, &change.edit),
            None => self.replace(change),
        }
    }

    fn append(&mut self, end: u64, edit: &Edit) -> io::Result<()> {
        let edit = record::edit(self.head.seal, edit);
        let mut file = self.claim.file();
        file.seek(SeekFrom::Start(end))?;
        file.write_all(&edit)?;
        file.sync_data()?;
        self.end = Some(end + edit.len() as u64);
        Ok(())
    }

    fn replace(&mut self, change: &Change) -> io::Result<()> {
        let (content, head) = beginning(&self.identity, change);
        self.claim.replace(&content)?;
        self.base = Arc::clone(&change.saved);
        self.head = head;
        self.end = Some(content.len() as u64);
        Ok(())
    }
}

/// What is in a journal before its edits.
#[derive(Clone, Copy, Debug)]
struct Head {
    /// The offset of the first edit.
    end: u64,
    /// The checksum that seals the edits.
    seal: u64,
}

/// A journal with one edit.
fn beginning(scene: &Identity, change: &Change) -> (Vec<u8>, Head) {
    let (mut content, seal) = record::head(scene, &change.saved);
    let end = content.len() as u64;
    content.extend(record::edit(seal, &change.edit));
    (content, Head { end, seal })
}

#[cfg(test)]
mod tests {
    use super::*;
    use document::Document;
    use text::Span;

    #[test]
    fn a_text_is_not_held_while_its_edits_are_written() {
        let mut document = Document::new(Language::Ray, "1 ".repeat(1 << 18));
        let edit = Edit {
            span: Span::new(2, 3),
            text: "25".to_owned(),
        };
        document.edit(std::slice::from_ref(&edit));
        let known = document.snapshot();
        let change = Change::from(Edits { scene: None, known });
        assert_eq!(Arc::strong_count(document.source().text()), 1);
        assert_eq!((&change.edit, change.len()), (&edit, document.text().len()));
    }
}
