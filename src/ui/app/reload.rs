//! Keeping the text and its file in step: taking or merging what was read, resolving conflicts,
//! starting or refusing saves, and the external editor.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::cursor::SavedCursor;
use super::disk::{Faulty, Requester, Settle};
use super::location_names::name_of;
use super::messages::About;
use super::{Dialog, MergeSource, OnDisk, PromptKind, Shared, Whose};
use crate::document::{Adopted, Difference, Numbers, StepName};
use crate::file;
use crate::file::ReadError;
use crate::language::{Before, Lowered};
use crate::text::{Findings, Position, Severity, counted};
use crate::ui::msg::{Effect, Guard};
use crate::ui::scene_reading::{Baseline, News, Reading};

/// Many programs empty a file before writing it: errors must persist for this long.
const QUIET: Duration = Duration::from_millis(100);
/// Others move the old file away before the new one exists.
const GONE: Duration = Duration::from_millis(500);

/// The parts of a message about a text read from the file.
struct Wording {
    came: &'static str,
    /// Used instead of the changed place if only comments and spacing have changed.
    same: &'static str,
    ends: Ends,
}

/// The end of a message about a text read from the file.
#[derive(Clone, Copy)]
enum Ends {
    /// Nothing.
    Plain,
    /// How to undo the merge.
    Merge,
}

const RELOADED: Wording = Wording {
    came: "reloaded",
    same: "the scene is unchanged",
    ends: Ends::Plain,
};
const MERGED: Wording = Wording {
    came: "merged the file's changes with your edits",
    same: "the picture is unchanged",
    ends: Ends::Merge,
};
const ADOPTED: Wording = Wording {
    came: "merged",
    same: "the picture is unchanged",
    ends: Ends::Merge,
};
const SAME_NOW: Wording = Wording {
    came: "the file now has the same changes",
    same: "nothing is unsaved",
    ends: Ends::Plain,
};

impl Shared {
    /// Reads a file that changed while there were unsaved edits, once there are none: nothing is left to
    /// be decided.
    pub(super) fn catch_up(&mut self) -> Vec<Effect> {
        if self.disk.state == OnDisk::Changed && !self.document.is_dirty() {
            self.read_again()
        } else {
            Vec::new()
        }
    }

    /// Reads the file, which may have to settle; not while it is being saved.
    pub(super) fn read_again(&mut self) -> Vec<Effect> {
        if self.is_being_saved() {
            return Vec::new();
        }
        self.revert_transient();
        let effects = self.disk.read_again(self.baseline());
        self.awaits_reading = !effects.is_empty();
        effects
    }

    /// Reads the file and accepts what it holds; not while it is being saved.
    pub(super) fn read_finally(&mut self) -> Vec<Effect> {
        if self.is_being_saved() {
            return Vec::new();
        }
        self.disk.read_finally(self.baseline())
    }

    /// Rereads the scene's file and the files that it names, for `:e`.
    pub(super) fn reread(&mut self) -> Vec<Effect> {
        let mut effects = if self.disk.path.is_some() {
            self.disk.answer_user();
            self.read_again()
        } else {
            self.overlays
                .fail("this scene has no file yet: use :w FILE to create one");
            Vec::new()
        };
        effects.extend(self.assets.read());
        effects
    }

    pub(super) fn read_effect(&self) -> Vec<Effect> {
        if self.is_being_saved() {
            return Vec::new();
        }
        self.disk.read(self.baseline())
    }

    /// The state that a reading of the file is compared with.
    pub(super) fn baseline(&self) -> Baseline {
        Baseline {
            scene: self.document.snapshot(),
            saves: self.jobs.count_saves(),
            meshes: self.assets.meshes.clone(),
            is_sound: self.sound_scene().is_some(),
        }
    }

    /// Whether a reading was compared with the current state: no save since then and, if it brings
    /// changes, neither an edit nor a mesh. With a million objects, changes arrive about a second
    /// after the last edit.
    fn is_known(&self, reading: &Reading) -> bool {
        let baseline = &reading.baseline;
        if baseline.saves != self.jobs.count_saves() {
            return false;
        }
        if reading.news.is_none() {
            return Arc::ptr_eq(&baseline.scene.saved, self.document.saved());
        }
        baseline.scene.is_of(&self.document) && baseline.meshes == self.assets.meshes
    }

    pub(super) fn settled(&mut self) -> Vec<Effect> {
        if self.disk.is_waiting() {
            self.read_finally()
        } else {
            Vec::new()
        }
    }

    pub(super) fn was_read(&mut self, read: Result<Reading, ReadError>) -> Vec<Effect> {
        if self.is_being_saved() {
            return vec![Effect::Free(Arc::new(read))];
        }
        if let Ok(reading) = &read
            && !self.is_known(reading)
        {
            let mut effects = self.read_effect();
            effects.push(Effect::Free(Arc::new(read)));
            return effects;
        }
        let effects = self.take_read(read);
        let reads = |effect: &Effect| matches!(effect, Effect::Read(..));
        self.awaits_reading = effects.iter().any(reads);
        effects
    }

    /// Takes the outcome of reading the file, which was compared with the present state.
    fn take_read(&mut self, read: Result<Reading, ReadError>) -> Vec<Effect> {
        let settle = self.disk.take_settle();
        let is_missing = matches!(
            read,
            Err(ReadError::NotFound { .. } | ReadError::NoFolder { .. })
        );
        if self.disk.state == OnDisk::New && is_missing {
            if self.disk.take_requester() == Requester::User {
                self.announce_new();
            }
            return Vec::new();
        }
        match read {
            Ok(reading) => {
                self.overlays.end_complaint(About::Scene);
                self.take_reading(reading, settle)
            }
            Err(_) if settle != Settle::Final => {
                self.disk.wait(if is_missing { GONE } else { QUIET })
            }
            Err(error) => {
                let (state, hint) = match error {
                    ReadError::NotFound { .. } => {
                        let save = self.key_for("save");
                        (OnDisk::Missing, format!("; press {save} to write it again"))
                    }
                    ReadError::NoFolder { .. } => {
                        let elsewhere = "; save the scene elsewhere with :w FILE";
                        (OnDisk::Missing, elsewhere.to_owned())
                    }
                    _ => (OnDisk::Unreadable, String::new()),
                };
                self.disk.state = state;
                self.overlays.errors = None;
                self.jobs.next = None;
                self.overlays
                    .complain(About::Scene, Severity::Error, &format!("{error}{hint}"));
                Vec::new()
            }
        }
    }

    /// Takes a reading; reports if the scene's folder was moved or replaced by another one.
    fn take_reading(&mut self, mut reading: Reading, settle: Settle) -> Vec<Effect> {
        let Some(place) = reading.place.take() else {
            return self.take_text(reading, settle);
        };
        let before = self.disk.move_to(place.clone());
        let before = before.unwrap_or_else(|| place.clone());
        let is_moved = before.id != place.id || before.folder != place.folder;
        let earlier = self.overlays.message.take_if(|_| is_moved);
        let effects = self.take_text(reading, settle);
        let folder = place.folder.display();
        let news = if before.id != place.id {
            format!("{folder} is now a different folder")
        } else if before.folder != place.folder {
            format!("the scene's folder was moved to {folder}")
        } else {
            return effects;
        };
        let message = std::mem::replace(&mut self.overlays.message, earlier);
        let message = message.map_or_else(String::new, |message| format!("; {}", message.text));
        self.overlays.warn(format!("{news}{message}"));
        effects
    }

    fn take_text(&mut self, reading: Reading, settle: Settle) -> Vec<Effect> {
        let requester = self.disk.take_requester();
        // An undecided merge is obsolete, regardless of what the file holds now.
        if let Some(Dialog::Conflict {
            from: MergeSource::File,
            ..
        }) = self.overlays.dialog
        {
            self.overlays.dialog = None;
        }
        let Some(news) = reading.news else {
            if self.disk.state != OnDisk::Known {
                self.disk.state = OnDisk::Known;
                self.overlays.say("the file matches the saved text again");
            } else if requester == Requester::User {
                self.overlays
                    .say(format!("{} has not changed", self.disk.name()));
            }
            return Vec::new();
        };
        if news.is_broken() && settle != Settle::Final {
            let mut effects = self.disk.wait(QUIET);
            effects.push(Effect::Free(Arc::new(news)));
            return effects;
        }
        let held = self.cursor.hold(self.document.shared_text());
        let saved = Arc::clone(self.document.saved());
        let state = std::mem::replace(&mut self.disk.state, OnDisk::Known);
        let (document, meaning, words) = match *news {
            News::Numbers(numbers) => {
                let Some(effects) = self.take_numbers(numbers, &held) else {
                    self.disk.state = state;
                    let baseline = self.baseline();
                    return self.disk.read(Baseline {
                        is_sound: false,
                        ..baseline
                    });
                };
                self.note_before_input(saved);
                return effects;
            }
            News::Text(document, meaning) => (self.document.load(document), meaning, RELOADED),
            News::Merged(merged, meaning) => {
                let words = if merged.document.is_dirty() {
                    MERGED
                } else {
                    SAME_NOW
                };
                (self.take_merged(merged), meaning, words)
            }
            News::Conflict(merge) => {
                self.disk.state = OnDisk::Changed;
                self.overlays.ask_conflict(merge, MergeSource::File);
                return Vec::new();
            }
            News::Broken(text, diagnostics) => {
                self.keep_apart(text, diagnostics);
                return Vec::new();
            }
        };
        self.note_before_input(saved);
        let former = (document, self.scene.clone());
        self.show_reload(&held, meaning.difference.as_ref(), meaning.lowered, &words);
        vec![Effect::Free(Arc::new(former))]
    }

    /// Takes a text in which numbers differ; `None` if it has to be read as a whole.
    fn take_numbers(&mut self, numbers: Numbers, held: &SavedCursor) -> Option<Vec<Effect>> {
        let difference = numbers.difference();
        let scene = self.sound_scene()?;
        let before = Before {
            scene: &scene,
            diagnostics: &self.reported,
        };
        let (texts, lowered) = self.document.take_numbers(numbers, before)?;
        self.show_reload(held, Some(&difference), lowered, &RELOADED);
        Some(vec![Effect::Free(Arc::new((texts, scene)))])
    }

    /// Keeps a text with errors apart from unsaved edits.
    fn keep_apart(&mut self, text: Arc<String>, diagnostics: Findings) {
        let first = diagnostics.first_error();
        let line = first.map_or(1, |d| Position::of(&text, d.span.start()).line);
        self.jobs.next = None;
        self.disk.state = OnDisk::Faulty(Faulty { text, diagnostics });
        let editor = self.key_for("editor");
        let words = format!(
            "line {line} of the file on disk has an error: press {editor} to edit it, or use :w! to overwrite it"
        );
        self.overlays
            .complain(About::Scene, Severity::Error, &words);
    }

    /// Installs the new meaning of the text, keeps the cursor in place and reports the change;
    /// `difference` is from the previous text to this one.
    fn show_reload(
        &mut self,
        held: &SavedCursor,
        difference: Option<&Difference>,
        lowered: Lowered,
        words: &Wording,
    ) {
        if let Ends::Merge = words.ends {
            self.document.name_step(StepName::done("merged the file"));
        }
        let (scene, sound) = (self.scene.clone(), self.error_count() == 0);
        self.install(lowered);
        let edit = difference.map(|difference| &difference.edit);
        let lost = self.cursor.follow(held, edit, self.document.source());
        self.keep_mode();
        if 0 < self.error_count() {
            if sound {
                self.disk.sound = Some(Arc::clone(&held.text));
            }
            self.overlays.fail(format!(
                "the scene has {}",
                counted(self.error_count(), "error")
            ));
        } else {
            let sound = self.disk.sound.take();
            let from_sound = sound.map(|sound| Difference::of(&sound, self.document.text()));
            let place = from_sound
                .as_ref()
                .map_or(difference, Option::as_ref)
                .and_then(|difference| name_of(self.source(), &difference.places));
            let is_same = match (&scene, &self.scene) {
                (Some(before), Some(after)) => Arc::ptr_eq(before, after),
                _ => false,
            };
            let Wording { came, same, ends } = words;
            if let (Ends::Merge, Some(place)) = (ends, &place) {
                let step = StepName::done(format!("merged the file: {place}"));
                self.document.name_step(step);
            }
            let end = match ends {
                Ends::Plain => String::new(),
                Ends::Merge => {
                    let undo = self.key_for("undo");
                    format!("; press {undo} to undo the merge")
                }
            };
            self.overlays.say(match place {
                _ if is_same && !self.assets.lack_meshes() => format!("{came}: {same}{end}"),
                Some(place) => format!("{came}: {place}{end}"),
                None => format!("{came}{end}"),
            });
        }
        if lost {
            self.overlays
                .warn("typed value discarded: its field no longer exists");
        }
    }

    /// Saves to the scene's file, for `w` and `:w`.
    pub(super) fn save(&mut self) -> Vec<Effect> {
        let Some(path) = self.disk.path.clone() else {
            self.overlays.open_prompt(PromptKind::Command, "w ");
            self.overlays
                .say("this scene has no file yet: enter a name");
            return Vec::new();
        };
        if !self.document.is_dirty() && self.disk.state == OnDisk::Known {
            let view = self.unwritten_view();
            self.overlays.say(format!("nothing to save{view}"));
            // In case a notification was missed.
            return self.read_effect();
        }
        if let OnDisk::Changed | OnDisk::Faulty(_) | OnDisk::Unreadable = self.disk.state {
            // The question is asked again with what the file holds now; nothing is saved.
            self.jobs.next = None;
            return self.read_effect();
        }
        if self.refuses_errors(&path) {
            return Vec::new();
        }
        let guard = match self.disk.state {
            OnDisk::New => Guard::Absent,
            _ => Guard::Holding(Arc::clone(self.document.saved())),
        };
        self.save_to(&path, guard)
    }

    /// Refuses to write a text with errors unless forced; returns whether it has any.
    pub(super) fn refuses_errors(&mut self, path: &Path) -> bool {
        let Some(errors) = self.error_place() else {
            return false;
        };
        self.jobs.next = None;
        let force = if self.disk.is_own(path) {
            ":w!".to_owned()
        } else {
            format!(":w! {}", path.display())
        };
        self.overlays
            .fail(format!("{errors}: use {force} to save anyway"));
        true
    }

    /// Resolves the conflict under the cursor and goes on to the next.
    pub(super) fn decide(&mut self, whose: Whose) {
        if let Some((merge, at, from)) = self.overlays.conflict()
            && let Some(conflict) = merge.conflicts.get_mut(*at)
        {
            conflict.decision = Some(from.side(whose));
            *at = (*at + 1).min(merge.conflicts.len() - 1);
        }
    }

    /// Resolves all conflicts.
    pub(super) fn decide_all(&mut self, whose: Whose) {
        if let Some((merge, _, from)) = self.overlays.conflict() {
            for conflict in &mut merge.conflicts {
                conflict.decision = Some(from.side(whose));
            }
        }
    }

    /// Applies a merge once every conflict is decided.
    pub(super) fn adopt(&mut self) -> Vec<Effect> {
        let Some((merge, at, _)) = self.overlays.conflict() else {
            return Vec::new();
        };
        if let Some(open) = merge.conflicts.iter().position(|c| c.decision.is_none()) {
            *at = open;
            let (mine, theirs) = (self.key_for("mine"), self.key_for("theirs"));
            let words = format!(
                "resolve all conflicts first: press {mine} for mine, {theirs} for the file's"
            );
            self.overlays.warn(words);
            return Vec::new();
        }
        let Some(Dialog::Conflict { merge, from, .. }) = self.overlays.dialog.take() else {
            return Vec::new();
        };
        if let MergeSource::Kept(claim, since) = from {
            return self.restore_merged(&merge, claim, since);
        }
        let held = self.cursor.hold(self.document.shared_text());
        match self.document.adopt(merge) {
            Adopted::Conflict(merge) => {
                self.overlays.ask_conflict(merge, from);
            }
            Adopted::Taken => {
                self.disk.state = OnDisk::Known;
                let difference = Difference::of(&held.text, self.document.text());
                let lowered = self.lowered();
                self.show_reload(&held, difference.as_ref(), lowered, &ADOPTED);
            }
            Adopted::OutOfDate => self
                .overlays
                .warn("the file was saved meanwhile: nothing was merged"),
        }
        Vec::new()
    }

    /// Opens the user's editor at the cursor, or at what is inspected.
    pub(super) fn open_editor(&mut self) -> Vec<Effect> {
        let Some(path) = self.disk.path.clone() else {
            self.overlays
                .fail("this scene has no file yet: use :w FILE to create one");
            return Vec::new();
        };
        if self.disk.state == OnDisk::New {
            let name = self.disk.name();
            let (save, editor) = (self.key_for("save"), self.key_for("editor"));
            self.overlays.warn(format!(
                "{name} is new: press {save} to write it, then {editor}"
            ));
            return Vec::new();
        }
        // A file that was not taken must be corrected first.
        let is_refused = matches!(self.disk.state, OnDisk::Faulty(_) | OnDisk::Unreadable);
        if self.document.is_dirty() && !is_refused {
            let (save, editor) = (self.key_for("save"), self.key_for("editor"));
            self.overlays.warn(format!(
                "there are unsaved edits: press {save} to save them, then {editor}"
            ));
            return Vec::new();
        }
        let wrong = self.wrong();
        let error = match wrong.at {
            Some(at) => wrong.findings.get(at),
            None if self.is_disk_wrong() => wrong.findings.iter().find(|d| d.is_error()),
            None => None,
        };
        let cited = error.and_then(|error| error.cited.as_deref());
        let cited = cited.and_then(|cited| Some((self.assets.file(&cited.file)?, cited.line)));
        if let Some((path, line)) = cited {
            return vec![Effect::OpenEditor { path, line }];
        }
        let span = error.map_or_else(|| self.source().span(self.node_in_focus()), |d| d.span);
        let line = Position::of(wrong.text, span.start()).line;
        vec![Effect::OpenEditor { path, line }]
    }

    pub(super) fn editor_closed(&mut self, outcome: Result<(), String>) -> Vec<Effect> {
        if let Err(reason) = outcome {
            self.overlays.fail(reason);
        }
        self.read_again()
    }

    /// Watches the scene's file, and reads it once more in case it changed before the watch began.
    pub(super) fn watch(&self) -> Vec<Effect> {
        let watch = self.disk.path.iter().cloned().map(Effect::Watch);
        let backups = self.disk.path.iter().cloned().map(Effect::FindBackups);
        watch.chain(self.read_effect()).chain(backups).collect()
    }

    /// Reports where an interrupted save left the scene's previous content.
    pub(super) fn backups_found(&mut self, copies: &[PathBuf]) {
        if let Some(copy) = copies.last() {
            self.overlays
                .warn(file::interruption(self.disk.name(), copy));
        }
    }
}
