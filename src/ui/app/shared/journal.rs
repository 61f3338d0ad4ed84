//! The recovery journals of this run and of earlier ones, as the interface sees them.

use std::path::PathBuf;
use std::time::Duration;

use crate::msg::{Effect, Timer};
use crate::recovery::{Claim, Found, Offer, Sought};
use document::Document;
use text::without_codes;

/// The time until an edit is kept, and the interval of writes while a key is held.
pub(crate) const KEPT_AFTER: Duration = Duration::from_secs(1);

/// The longest interval between attempts to keep the same edits.
const PATIENCE: Duration = Duration::from_secs(30);

/// What is kept for the next run, and what earlier runs have kept.
#[derive(Debug, Default)]
pub(crate) struct Journal {
    /// The revision of the document whose text is kept.
    revision: Option<u64>,
    /// The revision whose text is being written.
    ordered: Option<u64>,
    /// The purpose of the running timer.
    awaits: Await,
    /// Why the last try failed, and how long the next one was put off.
    trouble: Option<(Duration, String)>,
    /// Edits of an earlier run, to be offered once no other question is open.
    pub(crate) offer: Option<Box<Offer>>,
    /// The journals that the user wants to decide about later.
    put_off: Vec<String>,
    /// The problems with journals reported so far.
    complaints: Vec<String>,
}

/// The purpose of the timer for kept edits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Await {
    /// It is not running.
    #[default]
    Nothing,
    /// Edits are to be kept in a moment.
    Edits,
    /// This revision is to be tried again.
    Retry(u64),
}

/// The outcome of an attempt to keep edits.
pub(crate) enum Outcome {
    /// Obsolete: forgotten since, or another request is on its way.
    OutOfDate,
    /// They are kept; this message no longer applies.
    Kept(Option<String>),
    /// They are not kept: the message, unless the previous attempt showed it, and the next attempt.
    Failed(Option<String>, Box<Effect>),
}

impl Journal {
    /// Schedules keeping unsaved edits, or removing the journal if none are left.
    pub(crate) fn follow(&mut self, document: &Document) -> Option<Effect> {
        let waits = match self.awaits {
            Await::Nothing => false,
            Await::Edits => true,
            // New edits are tried at once.
            Await::Retry(failed) => failed == document.revision() && document.is_dirty(),
        };
        if waits || self.is_kept(document) {
            return None;
        }
        self.awaits = Await::Edits;
        Some(Effect::Later(KEPT_AFTER, Timer::Keep))
    }

    /// Whether the kept text, or the one about to be kept, is what would be lost.
    fn is_kept(&self, document: &Document) -> bool {
        match self.ordered.or(self.revision) {
            Some(kept) => kept == document.revision() && document.is_dirty(),
            None => !document.is_dirty(),
        }
    }

    /// Whether the journal holds the unsaved edits as they are.
    pub(crate) fn holds(&self, document: &Document) -> bool {
        self.revision == Some(document.revision()) && document.is_dirty()
    }

    /// Whether unsaved edits that should be kept by now would be lost with the program.
    pub(crate) fn fails(&self, document: &Document) -> bool {
        self.trouble.is_some() && document.is_dirty()
    }

    /// Keeps edits that are not kept yet.
    pub(crate) fn keep(&mut self, document: &Document, scene: Option<PathBuf>) -> Option<Effect> {
        if document.is_dirty() && self.is_kept(document) {
            self.awaits = Await::Nothing;
            return None;
        }
        self.keep_the_rest(document, scene)
    }

    /// Keeps edits that the journal lacks, or has for a base that the file no longer holds.
    pub(crate) fn keep_the_rest(
        &mut self,
        document: &Document,
        scene: Option<PathBuf>,
    ) -> Option<Effect> {
        self.awaits = Await::Nothing;
        if !document.is_dirty() {
            return self.forget();
        }
        let revision = document.revision();
        self.ordered = Some(revision);
        Some(Effect::WriteRecovery {
            scene,
            known: document.snapshot(),
            revision,
        })
    }

    /// Removes this run's journal, if there is one.
    pub(crate) fn forget(&mut self) -> Option<Effect> {
        let (kept, ordered) = (self.revision.take(), self.ordered.take());
        self.trouble = None;
        kept.or(ordered).map(|_| Effect::DropRecovery)
    }

    /// Records that a text is kept, or schedules another attempt at increasing intervals.
    pub(crate) fn kept(&mut self, revision: u64, outcome: Result<(), String>) -> Outcome {
        if self.ordered != Some(revision) {
            return Outcome::OutOfDate;
        }
        self.ordered = None;
        let before = self.trouble.take();
        let Err(reason) = outcome else {
            self.revision = Some(revision);
            return Outcome::Kept(before.map(|(_, reason)| words(&reason)));
        };
        let doubled = |(time, _): &(Duration, String)| (2 * *time).min(PATIENCE);
        let time = before.as_ref().map_or(KEPT_AFTER, doubled);
        self.awaits = Await::Retry(revision);
        let is_new = before.is_none_or(|(_, before)| before != reason);
        let message = is_new.then(|| words(&reason));
        self.trouble = Some((time, reason));
        Outcome::Failed(message, Box::new(Effect::Later(time, Timer::Keep)))
    }

    /// Looks for undecided edits that earlier runs kept.
    pub(crate) fn look(&self, document: &Document, scene: Option<PathBuf>) -> Effect {
        Effect::LookForKept(Sought {
            scene,
            language: document.language(),
            text: document.shared_text(),
            put_off: self.put_off.clone(),
        })
    }

    /// Takes the result of a search and returns any new complaints.
    pub(crate) fn found(&mut self, found: Found) -> Option<String> {
        let mut complaints = found.complaints;
        complaints.retain(|complaint| !self.complaints.contains(complaint));
        self.complaints.extend_from_slice(&complaints);
        if let Some(offer) = found.offer {
            self.offer = Some(offer);
        }
        let last = complaints.pop()?;
        Some(match complaints.len() {
            0 => last,
            more => format!("{last}; and {more} more"),
        })
    }

    /// The state for another scene, with nothing kept of it.
    pub(crate) fn renewed(self) -> Self {
        Self {
            put_off: self.put_off,
            complaints: self.complaints,
            ..Self::default()
        }
    }

    /// Leaves the decision about a journal for later.
    pub(crate) fn put_off(&mut self, claim: &Claim) {
        self.put_off.push(claim.name().to_owned());
    }
}

/// The message about edits that cannot be kept.
fn words(reason: &str) -> String {
    let words = format!("unsaved edits cannot be kept for recovery: {reason}");
    without_codes(&words).into_owned()
}
