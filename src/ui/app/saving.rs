//! Saves under way: each is known until its outcome comes, which may be never. Those of one file wait
//! for each other.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::model::Settle;
use super::{App, Disk, Stage};
use crate::ui::msg::{Effect, Guard, SaveId, SaveOutcome, Timer};

/// How often unfinished saves are checked.
const TICK: Duration = Duration::from_secs(1);

/// After how many checks the user is notified.
const PATIENCE: u32 = 2;

/// The saves that have no outcome yet.
#[derive(Debug, Default)]
pub(super) struct Saves {
    running: Vec<Running>,
    /// The newest save, begun or waiting.
    newest: SaveId,
    /// The newest save that came to an end.
    ended: SaveId,
    /// [`Timer::Writing`] is set.
    ticking: bool,
}

#[derive(Debug)]
struct Running {
    id: SaveId,
    path: PathBuf,
    text: Arc<String>,
    seconds: u32,
    /// What is to be written there next.
    next: Option<Next>,
}

#[derive(Debug)]
struct Next {
    id: SaveId,
    text: Arc<String>,
    guard: Guard,
}

impl App {
    /// What has been written to for a while, and for how many seconds.
    pub fn still_writing(&self) -> Option<(&Path, u32)> {
        let saves = self.saves.running.iter();
        let saves = saves.map(|save| (save.path.as_path(), save.seconds));
        let export = self.export.as_ref();
        let export = export.map(|export| (export.destination.path.as_path(), export.written_for));
        let all = saves.chain(export);
        let late = all.filter(|&(_, seconds)| PATIENCE <= seconds);
        late.max_by_key(|&(_, seconds)| seconds)
    }

    /// The file of a save under way, if there is one.
    pub(super) fn file_being_saved(&self) -> Option<&Path> {
        let save = self.saves.running.first();
        save.map(|save| save.path.as_path())
    }

    /// The text that is being written to the scene's file.
    pub(super) fn text_being_saved(&self) -> Option<&Arc<String>> {
        let mut saves = self.saves.running.iter();
        let save = saves.find(|save| self.is_own_path(&save.path));
        save.map(|save| &save.text)
    }

    /// Has the text saved; where a save of that file is under way, after it.
    pub(super) fn save_to(&mut self, path: PathBuf, guard: Guard) -> Vec<Effect> {
        self.document.end_step();
        self.saves.newest.0 += 1;
        let id = self.saves.newest;
        let text = self.document.shared_text();
        let running = self.saves.running.iter_mut();
        if let Some(save) = running.into_iter().find(|save| save.path == path) {
            save.next = Some(Next { id, text, guard });
            self.say(format!("{} is still being written", path.display()));
            return Vec::new();
        }
        self.start_save(id, path, text, guard)
    }

    fn start_save(
        &mut self,
        id: SaveId,
        path: PathBuf,
        text: Arc<String>,
        guard: Guard,
    ) -> Vec<Effect> {
        self.saves.running.push(Running {
            id,
            path: path.clone(),
            text: Arc::clone(&text),
            seconds: 0,
            next: None,
        });
        let mut effects = self.count_seconds();
        effects.push(Effect::Save {
            id,
            path,
            text,
            guard,
        });
        effects
    }

    /// Counts how long files are being written.
    pub(super) fn count_seconds(&mut self) -> Vec<Effect> {
        if std::mem::replace(&mut self.saves.ticking, true) {
            return Vec::new();
        }
        vec![Effect::Later(TICK, Timer::Writing)]
    }

    /// A second has passed.
    pub(super) fn tick(&mut self) -> Vec<Effect> {
        self.saves.ticking = false;
        for save in &mut self.saves.running {
            save.seconds += 1;
        }
        let export = self.export.as_mut();
        let export = export.filter(|export| export.stage == Stage::Writing);
        let is_exporting = export.map(|export| export.written_for += 1).is_some();
        if self.saves.running.is_empty() && !is_exporting {
            return Vec::new();
        }
        if self.pending.quit && self.message.is_none() && self.still_writing().is_some() {
            self.say("will quit once the save finishes; Ctrl-C or :q! quits now");
        }
        self.count_seconds()
    }

    /// Takes the outcome of a save, and begins the one that waits for it.
    pub(super) fn was_saved(&mut self, id: SaveId, outcome: SaveOutcome) -> Vec<Effect> {
        let place = self.saves.running.iter().position(|save| save.id == id);
        let ended = place.map(|place| self.saves.running.remove(place));
        // What the file holds from now on.
        let written = match &outcome {
            SaveOutcome::Saved { text, .. } => Some(Arc::clone(text)),
            SaveOutcome::ChangedOnDisk | SaveOutcome::Failed(_) => None,
        };
        let mut effects = self.take_outcome(id, outcome);
        if let Some(Running {
            path,
            next: Some(next),
            ..
        }) = ended
        {
            let guard = match (next.guard, written) {
                (Guard::Holding(_) | Guard::Absent, Some(text)) => Guard::Holding(text),
                (guard, _) => guard,
            };
            effects.extend(self.start_save(next.id, path, next.text, guard));
        }
        effects
    }

    fn take_outcome(&mut self, id: SaveId, outcome: SaveOutcome) -> Vec<Effect> {
        let is_late = id < self.saves.ended;
        self.saves.ended = self.saves.ended.max(id);
        // A quit waits for the newest save.
        let quit = id == self.saves.newest && std::mem::take(&mut self.pending.quit);
        match outcome {
            SaveOutcome::Saved { path, .. } if is_late => {
                self.say(format!("wrote {}", path.display()));
                Vec::new()
            }
            SaveOutcome::Saved { path, text } => {
                self.document.mark_saved(text);
                self.disk = Disk::Known;
                self.broken = None;
                self.say(format!("wrote {}", path.display()));
                let mut effects = Vec::new();
                if self.path.as_ref() != Some(&path) {
                    self.path = Some(path);
                    self.pending.place = None;
                    effects.extend(self.watch());
                    // Files are looked for from another folder now.
                    self.relower();
                }
                effects.extend(self.keep_the_rest());
                if quit {
                    self.pending.quit = true;
                    effects.extend(self.quit_when_done());
                }
                effects
            }
            SaveOutcome::ChangedOnDisk => {
                self.warn("the file has changed: nothing was written yet");
                self.pending.settle = Settle::Final;
                self.read_effect()
            }
            SaveOutcome::Failed(reason) => {
                self.fail(reason);
                Vec::new()
            }
        }
    }
}
