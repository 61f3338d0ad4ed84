//! The contents of the scene file, lowered and compared with the text under edit.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use assets::{MeshScene, is_mesh};
use document::{Conflict, Difference, Document, Merge, Merged, Numbers, Snapshot};
use file::FileId;
use language::{Language, Lowered, UnknownLanguage};
use memory::OutOfMemory;
use scene::Meshes;
use text::{Diagnostic, Findings};

/// State that a text read from disk is compared with.
#[derive(Clone, Debug)]
pub struct Baseline {
    /// The text under edit, and the text last saved or loaded.
    pub scene: Snapshot,
    /// The number of saves so far, of any file.
    pub saves: u32,
    /// The meshes read so far.
    pub meshes: Meshes,
    /// Whether the text under edit has no errors, so that numbers can be lowered alone.
    pub is_sound: bool,
    /// A text with edits that an editor may have made in its buffer.
    pub sent: Option<SentText>,
}

/// A text with edits that were sent to an editor.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SentText {
    /// The text with them.
    pub text: Arc<String>,
    /// Whether the editor says that it has made them: perhaps in its own way, such as in another format.
    pub is_made: bool,
}

impl SentText {
    /// Whether a conflict of these edits with the buffer is one with themselves.
    fn is_same(&self, conflict: &Conflict) -> bool {
        let Conflict {
            base, mine, theirs, ..
        } = conflict;
        let is_replaced = !base.is_empty() && !theirs.contains(base);
        self.is_made && (theirs.contains(mine) || is_replaced)
    }
}

/// The contents of a file.
#[derive(Debug)]
pub struct Reading {
    /// The state when the reading was requested.
    pub baseline: Baseline,
    /// The change found; `None` if the file holds the text last saved.
    pub news: Option<Box<News>>,
    /// The folder that the file was read from, if known.
    pub place: Option<SceneFolder>,
    /// What the text is of, if it is of an editor's buffer instead of the file.
    pub buffer: Option<ReadBuffer>,
    /// Whether it has the edits that the baseline says were sent: then it was compared as if the text with
    /// these had been saved last.
    pub has_sent: bool,
}

/// An editor's buffer that was read instead of the file.
#[derive(Clone, Debug)]
pub struct ReadBuffer {
    /// The version of its text.
    pub version: u64,
    /// What the file held when the buffer was opened or saved, if the editor has left without closing it.
    pub in_file: Option<Arc<String>>,
}

/// A scene that was opened while another one was shown.
#[derive(Debug)]
pub enum Opened {
    /// Its file was read, and compared with an empty text.
    Read(Reading),
    /// Its file is missing; this is the base of unsaved edits that were kept of it.
    Kept(String),
    /// Its file does not exist yet.
    New,
    /// It was made around a mesh, and its file does not exist yet.
    AroundMesh(MeshScene),
}

/// The language of a scene that is opened by a path, also by that of a mesh.
pub(crate) fn language_of(path: &Path) -> Result<Language, UnknownLanguage> {
    if is_mesh(path) {
        return Ok(Language::Xml);
    }
    Language::of_path(path)
}

/// The folder of a scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SceneFolder {
    /// Absolute path of the folder.
    pub folder: PathBuf,
    /// Identity of the folder.
    pub id: FileId,
}

impl SceneFolder {
    /// Returns the current folder of the file at this path.
    pub fn of(path: &Path) -> Option<Self> {
        let folder = file::directory_of(path);
        Some(Self {
            id: FileId::of(folder)?,
            // A relative path would lead elsewhere once the current folder is moved.
            folder: std::path::absolute(folder).ok()?.components().collect(),
        })
    }
}

/// A text that differs from the one last saved.
#[derive(Debug)]
pub enum News {
    /// There are no unsaved edits, and only numbers differ.
    Numbers(Numbers),
    /// There are no unsaved edits.
    Text(Document, Meaning),
    /// The text was merged with unsaved edits. It may have errors if it is that of an editor's buffer.
    Merged(Merged, Meaning),
    /// Unsaved edits changed the same places.
    Conflict(Merge),
    /// The text has errors, and there are unsaved edits.
    Broken(Arc<String>, Findings),
}

/// What a text that was read means, and how it differs from the text under edit.
#[derive(Debug)]
pub struct Meaning {
    /// The result of lowering.
    pub lowered: Lowered,
    /// How the text differs from the one under edit, if it does.
    pub difference: Option<Difference>,
}

impl Reading {
    /// Parses and lowers the text of the file. Fails if that would take more memory than is available.
    pub fn new(text: String, baseline: Baseline) -> Result<Self, OutOfMemory> {
        Self::of(text, None, baseline)
    }

    /// Parses and lowers the text of an editor's buffer, or that of the file if there is none. Fails if that
    /// would take more memory than is available.
    pub(crate) fn of(
        text: String,
        buffer: Option<ReadBuffer>,
        baseline: Baseline,
    ) -> Result<Self, OutOfMemory> {
        let text = Arc::new(text);
        let has_sent = |sent: &&SentText| {
            let is_same = |conflict: &Conflict| sent.is_same(conflict);
            baseline.scene.has_edits(&sent.text, &text, is_same)
        };
        let sent = baseline.sent.as_ref().filter(|_| buffer.is_some());
        let sent = sent.filter(has_sent).map(|sent| Arc::clone(&sent.text));
        let has_sent = sent.is_some();
        let compared = match sent {
            None => baseline.clone(),
            Some(sent) => Baseline {
                scene: baseline.scene.with_saved(sent),
                ..baseline.clone()
            },
        };
        let news = if compared.scene.saved == text {
            None
        } else {
            let text = Arc::unwrap_or_clone(text);
            Some(Box::new(News::of(text, buffer.is_some(), &compared)?))
        };
        Ok(Self {
            baseline,
            news,
            place: None,
            buffer,
            has_sent,
        })
    }
}

impl News {
    fn of(text: String, is_buffer: bool, baseline: &Baseline) -> Result<Self, OutOfMemory> {
        if !baseline.is_sound {
            return Self::of_whole(text, is_buffer, baseline);
        }
        match baseline.scene.numbers(text) {
            Ok(numbers) => Ok(Self::Numbers(numbers)),
            Err(text) => Self::of_whole(text, is_buffer, baseline),
        }
    }

    /// Parses and lowers a text as a whole.
    fn of_whole(text: String, is_buffer: bool, baseline: &Baseline) -> Result<Self, OutOfMemory> {
        let before = &baseline.scene;
        // A document keeps the saved text beside the one under edit.
        language::fits(before.language, &text, text.len())?;
        let mut document = Document::new(before.language, text);
        let lowered = document.lower(&baseline.meshes)?;
        let meaning = |lowered: Lowered, text: &str| Meaning {
            lowered,
            difference: Difference::of(before.text(), text),
        };
        if before.edited.is_none() {
            let meaning = meaning(lowered, document.text());
            return Ok(Self::Text(document, meaning));
        }
        // In a buffer, a word that is being typed must not keep edits of the interface from it.
        if lowered.scene.is_none() && !is_buffer {
            return Ok(Self::Broken(document.shared_text(), lowered.diagnostics));
        }
        let (merged, lowered) = match before.merge(document, &baseline.meshes)? {
            Ok(merged) => merged,
            Err(merge) => return Ok(Self::Conflict(merge)),
        };
        let meaning = meaning(lowered, merged.document.text());
        Ok(Self::Merged(merged, meaning))
    }

    /// The errors of the text that was read, if it cannot be lowered.
    pub fn errors(&self) -> impl Iterator<Item = &Diagnostic> {
        let findings = match self {
            Self::Text(_, meaning) | Self::Merged(_, meaning) => Some(&meaning.lowered.diagnostics),
            Self::Broken(_, findings) => Some(findings),
            Self::Numbers(_) | Self::Conflict(_) => None,
        };
        let errors = findings.into_iter().flat_map(|findings| findings.iter());
        errors.filter(|found| found.is_error())
    }

    /// Whether the text that was read has errors.
    pub fn is_broken(&self) -> bool {
        match self {
            Self::Text(_, meaning) | Self::Merged(_, meaning) => meaning.lowered.scene.is_none(),
            Self::Broken(..) => true,
            Self::Numbers(_) | Self::Conflict(_) => false,
        }
    }
}
