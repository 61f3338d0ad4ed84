//! Plays a script of keys: each step follows once everything before it is done, so that the outcome
//! does not depend on time.

use std::io;
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::{Session, Urgency};
use crate::msg::{Effect, Msg, Timer};
use crate::options::Rehearsal;
use crate::shell::ending::Error;
use crate::shell::script::{PaneStep, Script, Step};
use crate::shell::snapshot;
use assets::Assets;
use language::Source;

impl Session {
    /// Handles what has arrived or, if nothing more will, plays the next step of the script.
    ///
    /// A key waits for files, and for one sample of each pixel of the preview, below which it may
    /// pick an object. Waits and dumps also wait for complete pictures, exports and timers. A
    /// sequence that plays has no end: a wait shows its next frame.
    pub(super) fn play(&mut self) -> Urgency {
        if let Ok(event) = self.inbox.try_recv() {
            return self.take(event);
        }
        let next = self.script.as_ref().and_then(Script::peek);
        let is_last = matches!(
            next,
            None | Some(Step::Wait | Step::Dump(..) | Step::Record(_))
        );
        let pictures = &self.app.shared.pictures;
        let is_busy = if is_last {
            pictures.are_awaited()
                || self.app.compare.is_awaited()
                || self.app.thumbnails.are_awaited()
                || self.app.gallery.pictures.are_awaited()
                || self.app.shared.suggestions.are_awaited()
                || self.app.shared.jobs.export().is_some()
        } else {
            pictures.preview.is_coarse()
        };
        if is_busy || 0 < self.at_work {
            return match self.inbox.recv() {
                Ok(event) => self.take(event),
                Err(_) => Urgency::Never,
            };
        }
        let is_played = self.is_played || next != Some(&Step::Wait);
        let is_awaited = |timer| timer != Timer::Frame || !is_played;
        if is_last && let Some(elapsed) = self.runtime.next_elapsed(is_awaited) {
            self.is_played |= matches!(elapsed, Msg::Elapsed(Timer::Frame));
            self.step(elapsed);
            return Urgency::Now;
        }
        self.is_played = false;
        // A page is always written to.
        let _ = self.draw(Urgency::Now);
        match self.script.as_mut().and_then(Script::next) {
            Some(step) => self.act(step),
            None => self.perform(vec![Effect::Quit]),
        }
        Urgency::Never
    }

    /// Writes the last screen; fails if a step could not be played.
    pub(super) fn finish(&mut self, rehearsal: Option<&Rehearsal>) -> Result<(), Error> {
        if let Some(error) = self.failed.take() {
            return Err(error);
        }
        if let Some(script) = &self.script
            && let Some(unplayed) = script.unplayed()
        {
            return Err(Error::Faulty {
                name: script.name.clone(),
                text: script.text.clone(),
                errors: vec![unplayed],
            });
        }
        let recorder = mem::take(&mut self.recorder);
        let recorded = recorder.finish();
        recorded.map_err(|(path, source)| Error::Frame { path, source })?;
        for path in rehearsal.iter().flat_map(|rehearsal| &rehearsal.frames) {
            let format = snapshot::Format::of_path(path).unwrap_or(snapshot::Format::Text);
            self.dump(path, format)?;
        }
        Ok(())
    }

    fn act(&mut self, step: Step) {
        match step {
            Step::Key(key) => self.step(Msg::Key(key)),
            Step::Paste(text) => self.step(Msg::Paste(text)),
            Step::Click(column, row) => {
                let left = MouseButton::Left;
                for kind in [MouseEventKind::Down(left), MouseEventKind::Up(left)] {
                    self.step(Msg::Mouse(MouseEvent {
                        kind,
                        column,
                        row,
                        modifiers: KeyModifiers::NONE,
                    }));
                }
            }
            Step::Resize(columns, rows) => {
                self.runtime.screen().resize((columns, rows));
                self.step(Msg::Resize(columns, rows));
            }
            Step::Wait => {}
            Step::Dump(path, format) => {
                let dumped = self.dump(&path, format);
                self.end_if_failed(dumped);
            }
            Step::Record(path) => {
                let recorded = self.record(&path);
                self.end_if_failed(recorded);
            }
            Step::Pane(step) => {
                let edited = self.edit_beside(&step);
                self.end_if_failed(edited);
            }
        }
    }

    fn end_if_failed(&mut self, step: Result<(), Error>) {
        if let Err(error) = step {
            self.failed = Some(error);
            self.perform(vec![Effect::Quit]);
        }
    }

    fn record(&mut self, path: &Path) -> Result<(), Error> {
        if self.uses(path) {
            return Err(used(path));
        }
        if let Some(cells) = self.runtime.screen().cells() {
            self.recorder.add(path, cells, self.app.shared.theme);
        }
        Ok(())
    }

    /// Edits in the editor's pane. What it saves has changed on disk.
    fn edit_beside(&mut self, step: &PaneStep) -> Result<(), Error> {
        let edited = self.recorder.edit(step);
        edited.map_err(|source| Error::Frame {
            path: "the editor's pane".into(),
            source,
        })?;
        if *step == PaneStep::Save {
            self.step(Msg::FileChanged);
        }
        Ok(())
    }

    /// Whether a file is one that the scene uses. That of a text with errors is not known to the
    /// interface, which does not read its files.
    fn uses(&self, path: &Path) -> bool {
        let shared = &self.app.shared;
        if shared.files().any(|used| file::is_same(path, used)) {
            return true;
        }
        let (Some(scene), 1.., true) = (&shared.disk.path, shared.error_count(), path.exists())
        else {
            return false;
        };
        let text = shared.source().text();
        let name = path.file_name().unwrap_or_default();
        let is_named = name.to_str().is_some_and(|name| text.contains(name));
        let mut source = Source::new(shared.source().language(), Arc::clone(text));
        let read = Assets::new(&self.assets).lower(scene, &mut source);
        let is_same = |used: &PathBuf| file::is_same(path, used);
        is_named || read.map_or(true, |(_, read)| read.files.iter().any(is_same))
    }

    fn dump(&mut self, path: &Path, format: snapshot::Format) -> Result<(), Error> {
        let theme = self.app.shared.theme;
        if self.uses(path) {
            return Err(used(path));
        }
        let Some(cells) = self.runtime.screen().cells() else {
            return Ok(());
        };
        let written = snapshot::write(cells.clone(), path, format, (theme, self.depth));
        written.map_err(|source| Error::Frame {
            path: path.to_owned(),
            source,
        })
    }
}

/// The error that a screen would replace a file of the scene.
fn used(path: &Path) -> Error {
    Error::Frame {
        path: path.to_owned(),
        source: io::Error::other("the scene uses it; name another file"),
    }
}
