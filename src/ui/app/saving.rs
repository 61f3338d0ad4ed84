//! Saving the text and handling the outcomes.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::messages::About;
use super::{OnDisk, PromptKind, Shared};
use crate::language::Language;
use crate::ui::msg::{Effect, Guard, SaveId, SaveOutcome};

/// Whether the file is written even if it has changed meanwhile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Force {
    No,
    Yes,
}

impl Shared {
    /// Saves the text, to its own file if none is given.
    pub(super) fn write(&mut self, file: Option<PathBuf>, force: Force) -> Vec<Effect> {
        let own = self.document.language();
        if let Some(path) = &file
            && Language::of_path(path) != Ok(own)
        {
            let extension = own.extension();
            let name = path.with_extension(extension);
            self.overlays
                .open_prompt_over(PromptKind::Command, &format!("w {}", name.display()));
            let shown = path.display();
            self.overlays
                .fail(format!("{shown}: the name must end in .{extension}"));
            // The path may not even name a file.
            return vec![Effect::CheckPlace(path.clone())];
        }
        match (file.or_else(|| self.disk.path.clone()), force) {
            (Some(path), Force::Yes) => self.save_to(&path, Guard::Anything),
            (Some(path), Force::No) if !self.disk.is_own(&path) => {
                if self.refuses_errors(&path) {
                    return Vec::new();
                }
                self.save_to(&path, Guard::Absent)
            }
            (_, Force::No | Force::Yes) => self.save(),
        }
    }

    /// Whether the scene's file may be being written: any save may do so, since a file has many names.
    /// What is read of it meanwhile may be half of that, and is not taken: the end of the last save
    /// requests another reading.
    pub(super) fn is_being_saved(&self) -> bool {
        self.jobs.file_being_saved().is_some()
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

    /// The addition to a message about a save that the text lacks the moved view, if it does.
    pub(super) fn unwritten_view(&self) -> String {
        if !self.is_view_unwritten() {
            return String::new();
        }
        let key = self.key_for("write-view");
        let place = if self.mode.moves_camera() {
            ""
        } else {
            " in VIEW"
        };
        format!("; the moved view is not in the text: {key}{place} writes it")
    }

    /// Counts another second of running saves and exports.
    pub(super) fn tick(&mut self) -> Vec<Effect> {
        if !self.jobs.tick() {
            return Vec::new();
        }
        if let Some(next) = &self.jobs.next
            && self.jobs.still_writing().is_some()
        {
            let words = next.announcement();
            self.overlays.suggest(format!(
                "{words} once the save finishes; use Ctrl-C or :q! to quit now"
            ));
        }
        self.jobs.count_seconds()
    }

    /// Takes the outcome of a save, and starts the one that waited for it. Reads the file if it is no
    /// longer being written.
    pub(super) fn was_saved(&mut self, id: SaveId, outcome: SaveOutcome) -> Vec<Effect> {
        let ended = self.jobs.end_save(id);
        // Leaving waits for the newest save.
        let next = self.jobs.next.take_if(|_| ended.is_newest);
        let is_own = ended.path().is_some_and(|path| self.disk.is_own(path));
        let is_changed = matches!(outcome, SaveOutcome::ChangedOnDisk);
        // What the file holds from now on.
        let mut written = None;
        let mut effects = match outcome {
            SaveOutcome::Saved { path, text } => {
                // Leaving asks about the view itself.
                let view = if next.is_some() {
                    String::new()
                } else {
                    self.unwritten_view()
                };
                self.overlays.end_complaint(About::Scene);
                self.overlays.say(format!("wrote {}{view}", path.display()));
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
                Vec::new()
            }
            SaveOutcome::NoFolder(reason) => {
                self.overlays
                    .fail(format!("{reason}; save elsewhere with :w FILE"));
                Vec::new()
            }
            SaveOutcome::Failed(reason) => {
                self.overlays.fail(reason);
                Vec::new()
            }
        };
        let is_written = written.is_some();
        effects.extend(self.jobs.go_on(ended, written));
        if self.disk.path.is_some() && !self.is_being_saved() {
            effects.extend(if is_own && is_changed {
                self.read_finally()
            } else {
                self.read_again()
            });
        }
        if next.is_some() && is_written {
            self.jobs.next = next;
            effects.extend(self.leave_when_done());
        }
        effects
    }

    /// Makes a file that now holds `text` the scene's file.
    fn take_saved(&mut self, path: PathBuf, text: Arc<String>) -> Vec<Effect> {
        self.document.mark_saved(text);
        let is_new = self.disk.state == OnDisk::New || !self.disk.is_own(&path);
        self.disk.state = OnDisk::Known;
        let mut effects = Vec::new();
        if !self.disk.is_own(&path) {
            self.disk.rename(path);
            effects.extend(self.watch());
            // The scene's files are now looked for in another folder.
            self.relower();
        }
        effects.extend(self.note_recent().filter(|_| is_new));
        effects.extend(self.keep_the_rest());
        effects
    }
}
