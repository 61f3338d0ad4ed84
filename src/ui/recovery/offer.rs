//! The edits that earlier runs kept of a scene, and what restoring them would change.

use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::claim::Claim;
use super::identity::Identity;
use super::record::{self, Content};
use crate::queue::spawn;
use document::{Merge, Side, differences};
use file::state_folder::{self, Folder, Store};
use language::Language;
use memory::megabytes;
use text::{Edit, smallest_edit};

/// The size, in bytes, that a journal may have regardless of the scene's length.
const ALWAYS: u64 = 64 << 20;

/// The maximum length of a journal as a multiple of the scene's: it holds the base, edits as long
/// as the text, and one that makes them longer. Texts grow and shrink.
const TIMES: u64 = 8;

/// The scene whose kept edits are looked for.
#[derive(Clone, Debug)]
pub struct Sought {
    /// The scene's path; `None` for the scene without a file.
    pub scene: Option<PathBuf>,
    /// Its language.
    pub language: Language,
    /// The text that the edits would be restored into.
    pub text: Arc<String>,
    /// The names of journals that must not be offered again.
    pub put_off: Vec<String>,
}

/// The result of a search.
#[derive(Debug, Default)]
pub struct Found {
    /// The newest edits that the text does not contain.
    pub offer: Option<Box<Offer>>,
    /// Problems with the folder, and the locations of unreadable journals.
    pub complaints: Vec<String>,
}

/// Edits that an earlier run kept.
#[derive(Clone, Debug)]
pub struct Offer {
    /// Their journal, which no other run is offered meanwhile.
    pub claim: Arc<Claim>,
    /// The text that they would be restored into.
    pub text: Arc<String>,
    /// How they are restored.
    pub way: Way,
    /// The number of places in the text that change.
    pub places: usize,
    /// Whether the text has changed since the edits were made.
    pub since: Since,
}

/// How kept edits are restored.
#[derive(Clone, Debug)]
pub enum Way {
    /// By an edit.
    Edit(Edit),
    /// By a merge: the text is [`Side::Mine`], the kept edits are [`Side::Theirs`].
    Merge(Merge),
}

/// Whether a text has changed since edits of it were kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Since {
    /// Unchanged.
    Same,
    /// Changed.
    Changed,
}

/// Looks for kept edits on a new thread, which reports any that it finds.
pub(crate) fn look_for(sought: Sought, report: impl Fn(Found) + Send + 'static) -> io::Result<()> {
    let look = move || {
        let found = match state_folder::path() {
            Ok(state) => look_in(&state, &sought),
            // Reported once there is something to keep.
            Err(_) => Found::default(),
        };
        if found.offer.is_some() || !found.complaints.is_empty() {
            report(found);
        }
    };
    spawn("recovery", look).map(drop)
}

/// Finds the newest edits kept below a state folder.
pub(super) fn look_in(state: &Path, sought: &Sought) -> Found {
    let mut found = Found::default();
    let folder = match Folder::find(state, Store::Edits) {
        Ok(Some(folder)) => Arc::new(folder),
        Ok(None) => return found,
        Err(error) => {
            // Without a folder nothing is lost: that is reported once there is something to keep.
            if error.kind() == io::ErrorKind::PermissionDenied {
                found.complain(error);
            }
            return found;
        }
    };
    let scene = Identity::of(sought.scene.as_deref(), sought.language);
    let names = scene.names().filter(|name| !sought.put_off.contains(name));
    let mut claims = left_behind(&folder, names, |error| found.complain(error));
    let limit = limit(sought.text.len());
    while let Some(claim) = claims.pop() {
        let content = match read(&claim, limit) {
            Ok(bytes) => record::read(&bytes, &scene, &sought.text),
            Err(reason) => {
                found.complain(reason);
                continue;
            }
        };
        found.take(claim, content, sought);
        if found.offer.is_some() {
            break;
        }
    }
    found
}

/// Claims the journals with these names whose runs have ended, oldest first.
pub(super) fn left_behind(
    folder: &Arc<Folder>,
    names: impl Iterator<Item = String>,
    mut complain: impl FnMut(io::Error),
) -> Vec<Claim> {
    let mut dated = Vec::new();
    for name in names {
        match Claim::take(folder, name) {
            Ok(Some(claim)) => {
                let modified = claim.file().metadata().and_then(|found| found.modified());
                dated.push((modified.ok(), claim));
            }
            Ok(None) => {}
            Err(error) => complain(error),
        }
    }
    dated.sort_by_key(|&(at, _)| at);
    dated.into_iter().map(|(_, claim)| claim).collect()
}

/// The maximum length of a journal, in bytes, for a scene of this length.
pub(super) fn limit(length: usize) -> u64 {
    ALWAYS.max(TIMES * length as u64)
}

/// Reads a whole journal. Fails if it is longer than any journal of the scene can be.
pub(super) fn read(claim: &Claim, limit: u64) -> Result<Vec<u8>, String> {
    let place = claim.place();
    let length = claim.file().metadata().map_or(0, |found| found.len());
    if limit < length {
        let (place, length, limit) = (place.display(), megabytes(length), megabytes(limit));
        return Err(format!(
            "{place} is {length} long, a journal of this scene at most {limit}"
        ));
    }
    file::read_opened(claim.file(), &place, limit).map_err(|error| error.to_string())
}

impl Found {
    /// Processes the content of a journal.
    fn take(&mut self, claim: Claim, content: Content, sought: &Sought) {
        let place = claim.place();
        let place = place.display();
        match content {
            Content::Edits {
                base,
                text,
                is_damaged,
            } => {
                let claim = if is_damaged { claim.damaged() } else { claim };
                match Offer::new(Arc::new(claim), sought, base, text) {
                    Ok(offer) => self.offer = Some(Box::new(offer)),
                    Err(claim) if is_damaged => self.set_aside(&claim),
                    Err(claim) => {
                        let _ = claim.remove();
                    }
                }
            }
            Content::Empty => {
                let _ = claim.remove();
            }
            Content::OfAnotherScene => self.complain(format!("{place} belongs to another scene")),
            Content::OfAnotherVersion => {
                self.complain(format!("{place} is of another version of halflight"));
            }
            Content::Damaged => self.set_aside(&claim),
        }
    }

    /// Renames a damaged journal and reports its new location.
    fn set_aside(&mut self, claim: &Claim) {
        let place = claim.set_aside().unwrap_or_else(|_| claim.place());
        self.complain(format!("{} is damaged", place.display()));
    }

    fn complain(&mut self, reason: impl Display) {
        let complaint = format!("unsaved edits of an earlier run are not offered: {reason}");
        self.complaints.push(complaint);
    }
}

impl Offer {
    /// Prepares an offer. Fails with the claim if the text already contains the edits.
    pub(crate) fn new(
        claim: Arc<Claim>,
        sought: &Sought,
        base: String,
        kept: String,
    ) -> Result<Self, Arc<Claim>> {
        let (language, text) = (sought.language, &sought.text);
        let (way, since, taken) = if base == **text {
            let edit = smallest_edit(text, &kept).map(Way::Edit);
            (edit, Since::Same, kept)
        } else {
            let merge = Merge::new(language, &Arc::new(base), text, &Arc::new(kept));
            let mut decided = merge.clone();
            for conflict in &mut decided.conflicts {
                conflict.decision = Some(Side::Theirs);
            }
            (Some(Way::Merge(merge)), Since::Changed, decided.text())
        };
        let Some(way) = way.filter(|_| taken != **text) else {
            return Err(claim);
        };
        Ok(Self {
            claim,
            text: Arc::clone(text),
            way,
            places: differences(language, text, &taken),
            since,
        })
    }

    /// Whether later edits may be lost because the journal is damaged.
    pub fn is_damaged(&self) -> bool {
        self.claim.is_damaged()
    }

    /// The number of places that both the text and the kept edits have changed.
    pub fn conflicts(&self) -> usize {
        match &self.way {
            Way::Edit(_) => 0,
            Way::Merge(merge) => merge.conflicts.len(),
        }
    }
}
