//! What runs that are over have kept of a scene, and what taking it would make of the text.

use std::fmt::Display;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;

use super::claim::Claim;
use super::folder::{self, Folder};
use super::identity::Identity;
use super::record::{self, Content};
use crate::document::{Merge, Side, differences};
use crate::file;
use crate::language::Language;
use crate::memory::megabytes;
use crate::text::{Edit, smallest_edit};
use crate::ui::msg::Msg;

/// A journal may be as long as this, whatever the scene's length.
const ALWAYS: u64 = 64 << 20;

/// How many times as long as the scene's text a journal may be: it holds the text that the edits
/// started from, edits as long as the text, and one that makes them longer. Texts grow and shrink.
const TIMES: u64 = 8;

/// Whose edits are looked for.
#[derive(Clone, Debug)]
pub struct Sought {
    /// The scene; `None` is the one without a file.
    pub scene: Option<PathBuf>,
    /// Its language.
    pub language: Language,
    /// The text that they would be taken into.
    pub text: Arc<String>,
    /// The names of journals that are not to be offered again.
    pub put_off: Vec<String>,
}

/// What was found.
#[derive(Debug, Default)]
pub struct Found {
    /// The newest edits that the text does not have.
    pub offer: Option<Box<Offer>>,
    /// What is wrong with the folder, or where journals are that can't be read.
    pub complaints: Vec<String>,
}

/// Edits that an earlier run kept.
#[derive(Clone, Debug)]
pub struct Offer {
    /// Their journal, which no other run is offered meanwhile.
    pub claim: Arc<Claim>,
    /// The text that they would be taken into.
    pub text: Arc<String>,
    /// How they are taken.
    pub way: Way,
    /// How many places of the text that changes.
    pub places: usize,
    /// What became of the text since they were made.
    pub since: Since,
}

/// How kept edits are taken.
#[derive(Clone, Debug)]
pub enum Way {
    /// By an edit.
    Edit(Edit),
    /// By a merge: the text's side is [`Side::Mine`], that of the kept edits [`Side::Theirs`].
    Merge(Merge),
}

/// What became of a text since edits of it were kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Since {
    /// It is the same.
    Same,
    /// It has changed.
    Changed,
    /// The journal does not hold what it was.
    Unknown,
}

/// Looks for kept edits on a thread of its own, which sends [`Msg::Recovered`] if there are any.
pub(crate) fn look_for(sought: Sought, send: impl Fn(Msg) + Send + 'static) -> Result<(), String> {
    let look = move || {
        let found = match folder::state() {
            Ok(state) => look_in(&state, &sought),
            // Said once there is something to keep.
            Err(_) => Found::default(),
        };
        if found.offer.is_some() || !found.complaints.is_empty() {
            send(Msg::Recovered(found));
        }
    };
    let spawned = thread::Builder::new()
        .name("recovery".to_owned())
        .spawn(look);
    let words = |error: io::Error| format!("kept edits can't be looked for: {error}");
    spawned.map(drop).map_err(words)
}

/// Finds the newest edits kept below a state folder.
pub(super) fn look_in(state: &Path, sought: &Sought) -> Found {
    let mut found = Found::default();
    let folder = match Folder::find(state) {
        Ok(Some(folder)) => Arc::new(folder),
        Ok(None) => return found,
        Err(error) => {
            // Without a folder nothing is missed: that is reported once there is something to keep.
            if error.kind() == io::ErrorKind::PermissionDenied {
                found.complain(error);
            }
            return found;
        }
    };
    let scene = Identity::of(sought.scene.as_deref(), sought.language);
    let mut dated = Vec::new();
    for name in scene.names().filter(|name| !sought.put_off.contains(name)) {
        match Claim::take(&folder, name) {
            Ok(Some(claim)) => {
                let modified = claim.file().metadata().and_then(|found| found.modified());
                dated.push((modified.ok(), claim));
            }
            Ok(None) => {}
            Err(error) => found.complain(error),
        }
    }
    dated.sort_by_key(|&(at, _)| at);
    let limit = ALWAYS.max(TIMES * sought.text.len() as u64);
    while let Some((_, claim)) = dated.pop() {
        let bytes = match read(&claim, limit) {
            Ok(bytes) => bytes,
            Err(reason) => {
                found.complain(reason);
                continue;
            }
        };
        match record::read(bytes, &scene) {
            Content::Edits { base, text } => {
                if let Some(offer) = Offer::new(&Arc::new(claim), sought, base, text) {
                    found.offer = Some(Box::new(offer));
                    return found;
                }
            }
            Content::Empty => {
                let _ = claim.remove();
            }
            Content::Foreign => {}
            Content::Damaged => {
                let place = claim.set_aside();
                if let Ok(place) = place {
                    found.complain(format!("{} is damaged", place.display()));
                }
            }
        }
    }
    found
}

/// All bytes of a journal, unless they are more than any journal of the scene has; then why not.
fn read(claim: &Claim, limit: u64) -> Result<Vec<u8>, String> {
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
    fn complain(&mut self, reason: impl Display) {
        let complaint = format!("unsaved edits of an earlier run are not offered: {reason}");
        self.complaints.push(complaint);
    }
}

impl Offer {
    /// What taking edits would make of the text; `None`, and they are forgotten, if it has them
    /// already.
    pub(crate) fn new(
        claim: &Arc<Claim>,
        sought: &Sought,
        base: Option<String>,
        kept: String,
    ) -> Option<Self> {
        let (language, text) = (sought.language, &sought.text);
        let (way, since, taken) = match base {
            Some(base) if base != **text => {
                let merge = Merge::new(language, &Arc::new(base), text, &Arc::new(kept));
                let mut decided = merge.clone();
                for conflict in &mut decided.conflicts {
                    conflict.decision = Some(Side::Theirs);
                }
                (Some(Way::Merge(merge)), Since::Changed, decided.text())
            }
            base => {
                let since = base.map_or(Since::Unknown, |_| Since::Same);
                (smallest_edit(text, &kept).map(Way::Edit), since, kept)
            }
        };
        let way = way.filter(|_| taken != **text);
        let Some(way) = way else {
            let _ = claim.remove();
            return None;
        };
        Some(Self {
            claim: Arc::clone(claim),
            text: Arc::clone(text),
            way,
            places: differences(language, text, &taken),
            since,
        })
    }

    /// How many places both the text and the kept edits have changed.
    pub fn conflicts(&self) -> usize {
        match &self.way {
            Way::Edit(_) => 0,
            Way::Merge(merge) => merge.conflicts.len(),
        }
    }
}
