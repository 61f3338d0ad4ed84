//! Saving the text and handling the outcomes.

use std::path::Path;
use std::sync::Arc;

use super::{App, OnDisk};
use crate::ui::msg::{Effect, Guard, SaveId, SaveOutcome};

impl App {
    /// The text that is being written to the scene's file.
    pub(super) fn text_being_saved(&self) -> Option<&Arc<String>> {
        self.jobs.text_being_saved(self.disk.path.as_deref())
    }

    /// Saves the text. If a save of the same file is running, the new one waits for it.
    pub(super) fn save_to(&mut self, path: &Path, guard: Guard) -> Vec<Effect> {
        self.document.end_step();
        let text = self.document.shared_text();
        let effects = self.jobs.save(path, text, guard);
        if effects.is_empty() {
            let path = path.display();
            self.overlays.say(format!("{path} is still being written"));
        }
        effects
    }

    /// Counts another second of running saves and exports.
    pub(super) fn tick(&mut self) -> Vec<Effect> {
        if !self.jobs.tick() {
            return Vec::new();
        }
        if self.jobs.quit && self.jobs.still_writing().is_some() {
            let words = "will quit once the save finishes; use Ctrl-C or :q! to quit now";
            self.overlays.suggest(words);
        }
        self.jobs.count_seconds()
    }

    /// Takes the outcome of a save, and starts the one that waited for it.
    pub(super) fn was_saved(&mut self, id: SaveId, outcome: SaveOutcome) -> Vec<Effect> {
        let ended = self.jobs.end_save(id);
        // What the file holds from now on.
        let written = match &outcome {
            SaveOutcome::Saved { text, .. } => Some(Arc::clone(text)),
            SaveOutcome::ChangedOnDisk | SaveOutcome::Failed(_) => None,
        };
        // A quit waits for the newest save.
        let quit = ended.is_newest && std::mem::take(&mut self.jobs.quit);
        let mut effects = self.take_outcome(outcome, ended.is_late, quit);
        effects.extend(self.jobs.go_on(ended, written));
        effects
    }

    fn take_outcome(&mut self, outcome: SaveOutcome, is_late: bool, quit: bool) -> Vec<Effect> {
        match outcome {
            SaveOutcome::Saved { path, .. } if is_late => {
                self.overlays.say(format!("wrote {}", path.display()));
                Vec::new()
            }
            SaveOutcome::Saved { path, text } => {
                self.document.mark_saved(text);
                self.disk.stands(OnDisk::Known);
                self.overlays.say(format!("wrote {}", path.display()));
                let mut effects = Vec::new();
                if !self.disk.is_own(&path) {
                    self.disk.rename(path);
                    effects.extend(self.watch());
                    // The scene's files are now looked for in another folder.
                    self.relower();
                }
                effects.extend(self.keep_the_rest());
                if quit {
                    self.jobs.quit = true;
                    effects.extend(self.quit_when_done());
                }
                effects
            }
            SaveOutcome::ChangedOnDisk => {
                let words = "the file has changed: nothing was written yet";
                self.overlays.warn(words);
                self.disk.read_finally(self.baseline())
            }
            SaveOutcome::Failed(reason) => {
                self.overlays.fail(reason);
                Vec::new()
            }
        }
    }
}
