//! Saving the text and handling the outcomes.

use std::path::{Path, PathBuf};
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
        // A quit waits for the newest save.
        let quit = ended.is_newest && std::mem::take(&mut self.jobs.quit);
        // What the file holds from now on.
        let mut written = None;
        let mut effects = match outcome {
            SaveOutcome::Saved { path, text } => {
                self.overlays.say(format!("wrote {}", path.display()));
                written = Some(Arc::clone(&text));
                if ended.is_late {
                    Vec::new()
                } else {
                    self.take_saved(path, text)
                }
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
        };
        if quit && written.is_some() {
            self.jobs.quit = true;
            effects.extend(self.quit_when_done());
        }
        effects.extend(self.jobs.go_on(ended, written));
        effects
    }

    /// Makes a file that now holds `text` the scene's file.
    fn take_saved(&mut self, path: PathBuf, text: Arc<String>) -> Vec<Effect> {
        self.document.mark_saved(text);
        self.disk.state = OnDisk::Known;
        let mut effects = Vec::new();
        if !self.disk.is_own(&path) {
            self.disk.rename(path);
            effects.extend(self.watch());
            // The scene's files are now looked for in another folder.
            self.relower();
        }
        effects.extend(self.keep_the_rest());
        effects
    }
}
