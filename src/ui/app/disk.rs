//! How the text follows its file: what was read is taken, merged or asked about; a save is begun
//! or refused; the external editor has the file in between. What becomes of saves under way is in
//! `saving`, what is kept of unsaved edits in `keeping`.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::cursor::Held;
use super::model::{Outside, Reader, Settle};
use super::{App, Broken, Dialog, Disk, PromptKind};
use crate::document::Adopted;
use crate::file;
use crate::file::ReadError;
use crate::language::Lowered;
use crate::text::{Edit, Findings, Position, smallest_edit};
use crate::ui::keymap::Action;
use crate::ui::msg::{Effect, Guard, Timer};
use crate::ui::reading::{Known, News, Reading};

/// Many programs empty a file before they write it: what is wrong with it must last so long.
const QUIET: Duration = Duration::from_millis(100);
/// Others move the old file away before the new one is there.
const GONE: Duration = Duration::from_millis(500);

/// The message about a text read from the file, in parts.
struct Words {
    came: &'static str,
    /// Stands for what has changed where only comments and spacing have.
    same: &'static str,
    end: &'static str,
}

const RELOADED: Words = Words {
    came: "reloaded",
    same: "the scene is unchanged",
    end: "",
};
const MERGED: Words = Words {
    came: "the file's changes are merged with your edits",
    same: "the picture stays the same",
    end: "; u undoes the merge",
};
const ADOPTED: Words = Words {
    came: "merged",
    same: "the picture stays the same",
    end: "; u undoes the merge",
};
const SAME_NOW: Words = Words {
    came: "the file has the same changes now",
    same: "nothing is unsaved",
    end: "",
};

impl App {
    pub(super) fn read_again(&mut self) -> Vec<Effect> {
        // The file is not quiet yet.
        self.pending.settle = Settle::Idle;
        self.read_effect()
    }

    /// `:e`.
    pub(super) fn reread(&mut self) -> Vec<Effect> {
        if self.path.is_none() {
            self.fail("this scene has no file to read: :w FILE creates one");
        }
        self.pending.reader = Reader::User;
        let mut effects = self.read_again();
        effects.extend(self.read_assets());
        effects
    }

    pub(super) fn read_effect(&self) -> Vec<Effect> {
        let read = |path| Effect::Read(path, self.known());
        self.path.iter().cloned().map(read).collect()
    }

    /// What the scene's file is read with.
    pub(super) fn known(&self) -> Known {
        Known {
            scene: self.document.snapshot(),
            saving: self.text_being_saved().cloned(),
            meshes: self.meshes.clone(),
        }
    }

    /// Whether what was read was compared with what is still current: there was no save meanwhile,
    /// and for changes neither an edit nor a mesh. Of a million objects, changes arrive about a
    /// second after the last edit.
    fn is_known(&self, reading: &Reading) -> bool {
        let known = &reading.known;
        let saving = |text: Option<&Arc<String>>| text.map(Arc::as_ptr);
        if saving(known.saving.as_ref()) != saving(self.text_being_saved()) {
            return false;
        }
        if reading.news.is_none() {
            return Arc::ptr_eq(&known.scene.saved, self.document.saved());
        }
        known.scene.is_of(&self.document) && known.meshes == self.meshes
    }

    pub(super) fn settled(&mut self) -> Vec<Effect> {
        if self.pending.settle != Settle::Waiting {
            return Vec::new();
        }
        self.pending.settle = Settle::Final;
        self.read_effect()
    }

    pub(super) fn was_read(&mut self, read: Result<Reading, ReadError>) -> Vec<Effect> {
        if let Ok(reading) = &read
            && !self.is_known(reading)
        {
            let mut effects = self.read_effect();
            effects.push(Effect::Free(Arc::new(read)));
            return effects;
        }
        let is_final = std::mem::take(&mut self.pending.settle) == Settle::Final;
        match read {
            Ok(reading) => self.take_reading(reading, is_final),
            Err(error) if !is_final => self.wait(match error {
                ReadError::NotFound { .. } => GONE,
                _ => QUIET,
            }),
            Err(error) => {
                self.disk = match error {
                    ReadError::NotFound { .. } => Disk::Missing,
                    _ => Disk::Broken,
                };
                // What was wrong before is no longer in the file.
                self.broken = None;
                self.errors = None;
                self.pending.quit = false;
                self.fail(error.to_string());
                Vec::new()
            }
        }
    }

    fn wait(&mut self, time: Duration) -> Vec<Effect> {
        self.pending.settle = Settle::Waiting;
        vec![Effect::Later(time, Timer::Settled)]
    }

    /// Takes what was read; says so if its folder was moved, or if another one stands in its place.
    fn take_reading(&mut self, mut reading: Reading, is_final: bool) -> Vec<Effect> {
        let Some(place) = reading.place.take() else {
            return self.take_text(reading, is_final);
        };
        let before = self.pending.place.replace(place.clone());
        let before = before.unwrap_or_else(|| place.clone());
        self.message.take_if(|_| before.id != place.id);
        let effects = self.take_text(reading, is_final);
        let folder = place.folder.display();
        if before.id != place.id {
            let said = self.message.take().map(|said| format!("; {}", said.text));
            let said = said.unwrap_or_default();
            self.warn(format!("another folder is at {folder} now{said}"));
        } else if before.folder != place.folder {
            self.warn(format!("the scene's folder was moved to {folder}"));
        }
        effects
    }

    fn take_text(&mut self, reading: Reading, is_final: bool) -> Vec<Effect> {
        let reader = std::mem::take(&mut self.pending.reader);
        // A merge that was being decided is out of date, whatever the file holds now.
        if let Some(Dialog::Conflict {
            from: Outside::File,
            ..
        }) = self.dialog
        {
            self.dialog = None;
        }
        let Some(news) = reading.news else {
            // Of a file that is being saved, the outcome tells how it stands.
            if self.disk != Disk::Known && self.text_being_saved().is_none() {
                self.disk = Disk::Known;
                self.broken = None;
                self.say("the file is back to its saved text");
            } else if reader == Reader::User {
                self.say(format!("{} has not changed", self.file_name()));
            }
            return Vec::new();
        };
        if news.is_broken() && !is_final {
            let mut effects = self.wait(QUIET);
            effects.push(Effect::Free(Arc::new(news)));
            return effects;
        }
        let held = self.hold();
        self.disk = Disk::Known;
        self.broken = None;
        let (document, meaning, words) = match *news {
            News::Text(document, meaning) => (self.document.load(document), meaning, RELOADED),
            News::Merged(merged, meaning) => {
                let words = if merged.document.is_dirty() {
                    MERGED
                } else {
                    SAME_NOW
                };
                (self.document.take(merged), meaning, words)
            }
            News::Conflict(merge) => {
                self.disk = Disk::Changed;
                let from = Outside::File;
                self.dialog = Some(Dialog::Conflict { merge, at: 0, from });
                return Vec::new();
            }
            News::Broken(text, diagnostics) => {
                self.keep_apart(text, diagnostics);
                return Vec::new();
            }
        };
        let former = (document, self.scene.clone());
        self.show_reload(&held, meaning.edit.as_ref(), meaning.lowered, &words);
        vec![Effect::Free(Arc::new(former))]
    }

    /// Keeps a text with errors apart from unsaved edits.
    fn keep_apart(&mut self, text: Arc<String>, diagnostics: Findings) {
        let first = diagnostics.first_error();
        let line = first.map_or(1, |d| Position::of(&text, d.span.start()).line);
        self.pending.quit = false;
        self.disk = Disk::Broken;
        self.broken = Some(Broken { text, diagnostics });
        self.fail(format!(
            "line {line} of the file on disk has an error: E opens it, :w! overwrites it"
        ));
    }

    /// Takes what the text means now, keeps the cursor where it was and says what changed; `edit`
    /// leads to it from the text before.
    fn show_reload(&mut self, held: &Held, edit: Option<&Edit>, lowered: Lowered, words: &Words) {
        let (scene, sound) = (self.scene.clone(), self.error_count() == 0);
        self.install(lowered);
        let lost = self.follow_cursor(held, edit);
        if 0 < self.error_count() {
            if sound {
                self.pending.sound = Some(Arc::clone(&held.text));
            }
            self.fail(format!("the scene has errors: {}", self.error_count()));
        } else {
            let sound = self.pending.sound.take();
            let from_sound = sound.map(|sound| smallest_edit(&sound, self.document.text()));
            let place = from_sound
                .as_ref()
                .map_or(edit, Option::as_ref)
                .and_then(|edit| self.place_name(edit.placed()));
            let is_same = match (&scene, &self.scene) {
                (Some(before), Some(after)) => Arc::ptr_eq(before, after),
                _ => false,
            };
            let Words { came, same, end } = words;
            self.say(match place {
                _ if is_same && !self.lacks_meshes() => format!("{came}: {same}{end}"),
                Some(place) => format!("{came}: {place}{end}"),
                None => format!("{came}{end}"),
            });
        }
        if lost {
            self.warn("the value being typed is dropped: its field is gone");
        }
    }

    /// `w` and `:w`.
    pub(super) fn save(&mut self) -> Vec<Effect> {
        let Some(path) = self.path.clone() else {
            self.open_prompt(PromptKind::Command, "w ");
            self.say("this scene has no file yet: name one");
            return Vec::new();
        };
        if !self.document.is_dirty() && self.disk == Disk::Known {
            self.say("nothing to save");
            // Unless something was missed.
            return self.read_effect();
        }
        if let Disk::Changed | Disk::Broken = self.disk {
            // The question comes again with what the file holds now.
            return self.read_effect();
        }
        if self.refuses_errors(&path) {
            return Vec::new();
        }
        let guard = Guard::Holding(Arc::clone(self.document.saved()));
        self.save_to(path, guard)
    }

    /// Says that a text with errors is not written unless forced; whether it has any.
    pub(super) fn refuses_errors(&mut self, path: &Path) -> bool {
        let Some(errors) = self.error_place() else {
            return false;
        };
        self.pending.quit = false;
        let force = if self.is_own_path(path) {
            ":w!".to_owned()
        } else {
            format!(":w! {}", path.display())
        };
        self.fail(format!("{errors}: {force} writes it anyway"));
        true
    }

    pub(super) fn decide(&mut self, action: Action) {
        let Some(Dialog::Conflict { merge, at, from }) = &mut self.dialog else {
            return;
        };
        let side = match action {
            Action::Mine | Action::AllMine => from.mine(),
            _ => from.mine().other(),
        };
        if let Action::AllMine | Action::AllTheirs = action {
            for conflict in &mut merge.conflicts {
                conflict.decision = Some(side);
            }
        } else if let Some(conflict) = merge.conflicts.get_mut(*at) {
            conflict.decision = Some(side);
            *at = (*at + 1).min(merge.conflicts.len() - 1);
        }
    }

    /// Takes a merge once all is decided.
    pub(super) fn adopt(&mut self) -> Vec<Effect> {
        let Some(Dialog::Conflict { merge, .. }) = &mut self.dialog else {
            return Vec::new();
        };
        if let Some(open) = merge.conflicts.iter().position(|c| c.decision.is_none()) {
            if let Some(Dialog::Conflict { at, .. }) = &mut self.dialog {
                *at = open;
            }
            self.warn("decide every conflict first: m mine, t the file's");
            return Vec::new();
        }
        let Some(Dialog::Conflict { merge, from, .. }) = self.dialog.take() else {
            return Vec::new();
        };
        if let Outside::Kept(claim, since) = from {
            return self.restore_merged(&merge, claim, since);
        }
        let held = self.hold();
        match self.document.adopt(merge) {
            Adopted::Conflict(merge) => {
                self.dialog = Some(Dialog::Conflict { merge, at: 0, from });
            }
            Adopted::Taken => {
                self.disk = Disk::Known;
                let edit = smallest_edit(&held.text, self.document.text());
                let lowered = self.lowered();
                self.show_reload(&held, edit.as_ref(), lowered, &ADOPTED);
            }
            Adopted::OutOfDate => self.warn("the file was saved since: nothing is merged"),
        }
        Vec::new()
    }

    /// Opens the user's editor where the cursor is.
    pub(super) fn open_editor(&mut self) -> Vec<Effect> {
        let Some(path) = self.path.clone() else {
            self.fail("there is no file yet: :w FILE");
            return Vec::new();
        };
        // A file with errors that the edits are kept apart from must be mended first of all.
        if self.document.is_dirty() && self.disk != Disk::Broken {
            self.warn("there are unsaved edits: w saves them, then E");
            return Vec::new();
        }
        let (text, diagnostics) = self.wrong();
        let error = match self.errors {
            Some(at) => diagnostics.get(at),
            None if self.disk == Disk::Broken => diagnostics.iter().find(|d| d.is_error()),
            None => None,
        };
        let span = error.map_or_else(|| self.source().span(self.selected), |d| d.span);
        let line = Position::of(text, span.start()).line;
        vec![Effect::OpenEditor { path, line }]
    }

    pub(super) fn editor_closed(&mut self, outcome: Result<(), String>) -> Vec<Effect> {
        if let Err(reason) = outcome {
            self.fail(reason);
        }
        self.read_again()
    }

    /// Has the scene's file watched, and read once more: it may have changed before the watch began.
    pub(super) fn watch(&self) -> Vec<Effect> {
        let watch = self.path.iter().cloned().map(Effect::Watch);
        let backups = self.path.iter().cloned().map(Effect::FindBackups);
        watch.chain(self.read_effect()).chain(backups).collect()
    }

    /// Reports where an interrupted save left the scene's previous content.
    pub(super) fn backups_found(&mut self, copies: &[PathBuf]) {
        if let Some(copy) = copies.last() {
            self.warn(file::interruption(self.file_name(), copy));
        }
    }

    /// Whether a path is that of the scene.
    pub(super) fn is_own_path(&self, path: &Path) -> bool {
        self.path.as_deref() == Some(path)
    }
}
