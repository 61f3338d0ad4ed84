//! What runs that are over have kept of a scene, and what taking it would make of the text.

use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::thread;

use super::claim::Claim;
use super::folder::{self, Folder};
use super::identity::Identity;
use super::record::{self, Content};
use crate::document::{Merge, Side, differences};
use crate::format::Format;
use crate::text::{Edit, smallest_edit};
use crate::ui::msg::Msg;

/// Whose edits are looked for.
#[derive(Clone, Debug)]
pub struct Sought {
    /// The scene; `None` is the one without a file.
    pub scene: Option<PathBuf>,
    /// Its language.
    pub format: Format,
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
                let complaint = format!("edits kept before are not offered: {error}");
                found.complaints.push(complaint);
            }
            return found;
        }
    };
    let scene = Identity::of(sought.scene.as_deref(), sought.format);
    let names = scene.names().filter(|name| !sought.put_off.contains(name));
    let claims = names.filter_map(|name| Claim::take(&folder, name));
    let dated = claims.map(|claim| {
        (
            claim.file().metadata().and_then(|m| m.modified()).ok(),
            claim,
        )
    });
    let mut dated: Vec<_> = dated.collect();
    dated.sort_by_key(|&(at, _)| at);
    while let Some((_, claim)) = dated.pop() {
        let mut bytes = Vec::new();
        let content = match claim.file().read_to_end(&mut bytes) {
            Ok(_) => record::read(bytes, &scene),
            Err(_) => Content::Foreign,
        };
        match content {
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
                let place = place.map(|place| format!("{} is damaged", place.display()));
                found
                    .complaints
                    .extend(place.map(|it| format!("kept edits are not offered: {it}")));
            }
        }
    }
    found
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
        let (format, text) = (sought.format, &sought.text);
        let (way, since, taken) = match base {
            Some(base) if base != **text => {
                let merge = Merge::new(format, &Arc::new(base), text, &Arc::new(kept));
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
            places: differences(format, text, &taken),
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
