//! Unsaved edits of earlier runs: offering, taking and merging them.

use std::sync::Arc;

use super::model::Outside;
use super::{App, Dialog};
use crate::document::{Adopted, Merge};
use crate::ui::msg::Effect;
use crate::ui::recovery::{Claim, Found, Offer, Since, Sought, Way};

impl App {
    /// Looks for edits that earlier runs kept and that are still undecided.
    pub(super) fn look_for_kept(&self) -> Effect {
        Effect::LookForKept(Sought {
            scene: self.path.clone(),
            language: self.document.language(),
            text: self.document.shared_text(),
            put_off: self.pending.put_off.clone(),
        })
    }

    pub(super) fn found_kept(&mut self, found: Found) {
        let said = &mut self.pending.complaints;
        let mut complaints = found.complaints;
        complaints.retain(|complaint| !said.contains(complaint));
        said.extend_from_slice(&complaints);
        match (complaints.pop(), complaints.len()) {
            (None, _) => {}
            (Some(last), 0) => self.warn(last),
            (Some(last), more) => self.warn(format!("{last}; and {more} more")),
        }
        if let Some(offer) = found.offer {
            self.pending.offer = Some(offer);
        }
    }

    /// Asks about kept edits once nothing else is asked; examines them again where the text that they
    /// would be taken into has changed.
    pub(super) fn follow_kept(&mut self) -> Option<Effect> {
        let text = self.document.shared_text();
        let is_other = match &self.dialog {
            Some(Dialog::Recover(offer)) => !Arc::ptr_eq(&offer.text, &text),
            Some(Dialog::Conflict { merge, from, .. }) => {
                matches!(from, Outside::Kept(..)) && !merge.is_of(&self.document)
            }
            Some(Dialog::Quit) => false,
            None => {
                let offer = self.pending.offer.take()?;
                self.dialog = Some(Dialog::Recover(offer));
                return self.follow_kept();
            }
        };
        is_other.then(|| {
            self.dialog = None;
            self.look_for_kept()
        })
    }

    /// Takes the edits of an earlier run, as an edit like any other; asks first where the text has
    /// changed in the same places since.
    pub(super) fn restore(&mut self) -> Vec<Effect> {
        let Some(Dialog::Recover(offer)) = self.dialog.take() else {
            return Vec::new();
        };
        let Offer {
            claim, way, since, ..
        } = *offer;
        match way {
            Way::Edit(edit) => {
                self.document.edit(&[edit]);
                self.restored(claim, since)
            }
            Way::Merge(merge) if merge.conflicts.is_empty() => {
                self.restore_merged(&merge, claim, since)
            }
            Way::Merge(merge) => {
                let from = Outside::Kept(claim, since);
                self.dialog = Some(Dialog::Conflict { merge, at: 0, from });
                Vec::new()
            }
        }
    }

    /// Takes kept edits once it is decided what becomes of those that the text contradicts.
    pub(super) fn restore_merged(
        &mut self,
        merge: &Merge,
        claim: Arc<Claim>,
        since: Since,
    ) -> Vec<Effect> {
        match self.document.restore(merge) {
            Adopted::Taken => self.restored(claim, since),
            // The text is another one: they are examined again.
            Adopted::Conflict(_) | Adopted::OutOfDate => vec![self.look_for_kept()],
        }
    }

    fn restored(&mut self, claim: Arc<Claim>, since: Since) -> Vec<Effect> {
        self.relower();
        self.say(match since {
            Since::Same => "restored; u undoes",
            Since::Changed => "restored and merged with what has changed since; u undoes",
        });
        // Only once they are in this run's journal is the other one removed.
        let mut effects = if self.document.is_dirty() {
            vec![Effect::AdoptKept(claim)]
        } else {
            vec![Effect::DropKept(claim)]
        };
        effects.extend(self.keep_edits());
        effects.push(self.look_for_kept());
        effects
    }

    /// Throws the edits of an earlier run away.
    pub(super) fn decline(&mut self) -> Vec<Effect> {
        match self.dialog.take() {
            Some(Dialog::Recover(offer)) => {
                vec![Effect::DropKept(offer.claim), self.look_for_kept()]
            }
            _ => Vec::new(),
        }
    }

    /// Closes a question that may come again: one about kept edits does with the next run.
    pub(super) fn put_off(&mut self) -> Vec<Effect> {
        self.pending.quit = false;
        let claim = match self.dialog.take() {
            Some(Dialog::Recover(offer)) => offer.claim,
            Some(Dialog::Conflict {
                from: Outside::Kept(claim, _),
                ..
            }) => claim,
            _ => return Vec::new(),
        };
        self.pending.put_off.push(claim.name().to_owned());
        vec![self.look_for_kept()]
    }
}
