//! Playing a track: its frames are tried in the text of the scene, one after the other, so that each is
//! a scene like any other.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::App;
use super::after_leaving::name_of;
use super::messages::About;
use super::sequence::{OpenTrack, ShownFrame, complaint};
use crate::document::StepName;
use crate::file::ReadError;
use crate::text::Severity;
use crate::track::{self, Bound, Track};
use crate::ui::dope_sheet::DopeSheet;
use crate::ui::keymap::Mode;
use crate::ui::msg::{Effect, Timer};

impl App {
    /// Reads a track to play: this one, the open one, or that beside the scene.
    pub(super) fn open_track(&mut self, file: Option<PathBuf>) -> Vec<Effect> {
        let open = self.sequence.open.as_ref().map(|open| open.path.clone());
        let beside = || {
            let scene = self.disk.path.as_ref()?;
            Some(scene.with_extension("toml"))
        };
        let Some(path) = file.or(open).or_else(beside) else {
            self.overlays
                .fail("this scene has no file: name a track, as in :track FILE");
            return Vec::new();
        };
        if path.extension().is_none_or(|extension| extension != "toml") {
            let name = path.display();
            self.overlays
                .fail(format!("{name}: the name of a track ends in .toml"));
            return Vec::new();
        }
        if !self.has_sound_scene() {
            return Vec::new();
        }
        self.sequence.asked = Some(path.clone());
        vec![Effect::ReadTrack(path)]
    }

    /// Whether there is a scene without errors; says so if there is not.
    pub(super) fn has_sound_scene(&mut self) -> bool {
        let is_sound = self.scene.is_some() && self.error_count() == 0;
        if !is_sound {
            self.refuse_picture(Severity::Error, &self.no_picture());
        }
        is_sound
    }

    /// Takes the text of a track file, `None` if there is no such file, and plays it if asked.
    pub(super) fn track_read(
        &mut self,
        path: PathBuf,
        read: Result<Option<String>, ReadError>,
    ) -> Vec<Effect> {
        let open = self.sequence.open.as_ref();
        let is_open = open.is_some_and(|open| open.path == path);
        if is_open && self.sequence.writing.is_some() {
            // It may be half of what is being written, after which the file is read again.
            return Vec::new();
        }
        let asked = self.sequence.asked.take_if(|asked| *asked == path);
        let is_asked = asked.is_some();
        let open = self.sequence.open.as_ref();
        let open = open.filter(|open| open.path == path);
        let text = match read {
            Ok(text) if is_asked || open.is_some() => {
                self.overlays.end_complaint(About::Track);
                if text.is_none() && !is_asked {
                    // Many programs move the old file away before the new one exists.
                    return Vec::new();
                }
                text
            }
            Ok(_) => return Vec::new(),
            Err(error) => {
                self.complain_of_track(&error.to_string());
                return self.refuse_track(&path);
            }
        };
        let open = self.sequence.open.as_mut();
        if let Some(open) =
            open.filter(|open| open.path == path && open.held.as_deref() == text.as_ref())
        {
            open.is_refused = false;
            return if is_asked {
                self.enter_sequence()
            } else {
                Vec::new()
            };
        }
        let (track, findings) = track::read(text.as_deref().unwrap_or(track::BEGUN));
        if 0 < findings.errors() {
            let text = text.unwrap_or_default();
            self.complain_of_track(&complaint(&name_of(&path), &text, &findings));
            return self.refuse_track(&path);
        }
        if is_asked && !self.has_sound_scene() {
            return self.follow_open_track(&path);
        }
        self.suspend_frame();
        let text_of = text.as_deref().unwrap_or_default();
        if self.error_count() == 0 && self.bound_track(&track, &name_of(&path), text_of).is_none() {
            self.resume_frame();
            return self.refuse_track(&path);
        }
        let before = self.sequence.open.take_if(|open| open.path == path);
        let is_known = before.is_some();
        self.sequence.open = Some(OpenTrack {
            path,
            held: text.map(Arc::new),
            is_refused: false,
            frame: before
                .as_ref()
                .map_or(0, |open| open.frame.min(track.frames.saturating_sub(1))),
            is_playing: before.is_some_and(|open| open.is_playing),
            track,
            shown: None,
            before: Vec::new(),
        });
        if is_asked {
            return self.enter_sequence();
        }
        self.resume_frame();
        if is_known && self.mode == Mode::Sequence {
            self.overlays.say("track reloaded");
        }
        Vec::new()
    }

    /// Shows the present frame of the track.
    fn enter_sequence(&mut self) -> Vec<Effect> {
        if !self.has_sound_scene() {
            return Vec::new();
        }
        // Frames are never kept for recovery; edits before them are.
        let kept = self.keep_edits();
        let before = std::mem::replace(&mut self.mode, Mode::Sequence);
        self.resume_frame();
        let Some(open) = self
            .sequence
            .open
            .as_ref()
            .filter(|open| open.shown.is_some())
        else {
            self.mode = before;
            return kept.into_iter().collect();
        };
        let how_to_key = open.held.is_none().then(|| self.how_to_key(open));
        let moves = open
            .shown
            .as_ref()
            .is_some_and(|shown| shown.bound.moves_camera());
        if moves && self.pictures.view.is_some() {
            self.pictures.reset_view();
        }
        if let Some(words) = how_to_key {
            self.overlays.say(words);
        }
        kept.into_iter().collect()
    }

    /// How the first value is keyed.
    pub(super) fn how_to_key(&self, open: &OpenTrack) -> String {
        let edit = self.key_for("edit");
        let key = self.key_for("key");
        let name = open.name();
        format!("{name} is new: {edit} edits at this frame, then {key} keys the value")
    }

    /// Relates the open track to the present text; reports errors in it.
    pub(super) fn bound_track(&mut self, track: &Track, name: &str, text: &str) -> Option<Bound> {
        let camera = self.scene.as_ref()?.camera;
        let (bound, findings) = track::bind(track, self.source(), &camera);
        if 0 < findings.errors() {
            self.complain_of_track(&complaint(name, text, &findings));
            return None;
        }
        Some(bound)
    }

    fn complain_of_track(&mut self, words: &str) {
        self.overlays.complain(About::Track, Severity::Error, words);
    }

    /// Puts the present frame into the text, in SEQUENCE mode.
    pub(super) fn resume_frame(&mut self) {
        if self.mode == Mode::Sequence && self.overlays.dialog.is_none() {
            let frame = self.sequence.open.as_ref().map_or(0, |open| open.frame);
            self.show_frame(frame);
        }
    }

    /// Puts the text back as it was before the frame.
    pub(super) fn suspend_frame(&mut self) {
        let open = self.sequence.open.as_mut();
        if let Some(shown) = open.and_then(|open| open.shown.take()) {
            self.end_live_edit(shown.live_edit);
        }
    }

    /// Puts a frame into the text in place of the one before.
    fn show_frame(&mut self, frame: u32) {
        let Some(mut open) = self.sequence.open.take() else {
            return;
        };
        open.frame = frame.min(open.last());
        let shown = if let Some(shown) = open.shown.take() {
            (!self.leaves_live_edit(&shown.live_edit, "frame")).then_some(shown)
        } else {
            let text = open.held.clone().unwrap_or_default();
            let bound = self.bound_track(&open.track, &open.name(), &text);
            bound.map(|bound| ShownFrame {
                bound,
                live_edit: self.begin_live_edit(),
                was_dirty: self.document.is_dirty(),
            })
        };
        if let Some(ShownFrame {
            bound,
            mut live_edit,
            was_dirty,
        }) = shown
        {
            let frame = open.frame;
            let edits = |app: &Self| Ok(bound.edits(app.source(), frame));
            match self.try_instead(&mut live_edit, edits) {
                Ok(()) if live_edit.is_applied => {
                    let name = format!("frame {frame} of {}", open.name());
                    self.document.name_step(StepName::done(name));
                }
                Ok(()) => {}
                Err(reason) => self.overlays.fail(format!("frame {frame}: {reason}")),
            }
            open.shown = Some(ShownFrame {
                bound,
                live_edit,
                was_dirty,
            });
        } else {
            open.is_playing = false;
            self.mode = Mode::Select;
        }
        self.sequence.open = Some(open);
    }

    /// Goes some frames on.
    pub(super) fn step_frames(&mut self, frames: i32) {
        if let Some(open) = &self.sequence.open {
            self.show_frame(open.frame_after(frames));
        }
    }

    /// Goes to the next or previous frame with a key.
    pub(super) fn step_keys(&mut self, is_next: bool) {
        match self
            .sequence
            .open
            .as_ref()
            .and_then(|open| open.key_after(is_next))
        {
            Some(frame) => self.show_frame(frame),
            None if is_next => self.overlays.say("there are no later keys"),
            None => self.overlays.say("there are no earlier keys"),
        }
    }

    /// Goes to the frame that is pointed at on the sheet; returns whether there is one.
    pub(super) fn scrub_to(&mut self, at: (u16, u16)) -> bool {
        let area = self.areas().fields;
        let Some(open) = &mut self.sequence.open else {
            return false;
        };
        let sheet = DopeSheet::new(area, open.last());
        let frame = sheet.frame(at.0);
        let is_there = sheet.frames.contains(at.into());
        if is_there {
            open.is_playing = false;
            self.show_frame(frame);
        }
        is_there
    }

    /// Plays the track, or stops.
    pub(super) fn toggle_playing(&mut self) -> Vec<Effect> {
        let Some(open) = &mut self.sequence.open else {
            return Vec::new();
        };
        open.is_playing = !open.is_playing;
        let timer = Effect::Later(open.period(), Timer::Frame);
        if open.is_playing {
            vec![timer]
        } else {
            Vec::new()
        }
    }

    /// Shows the next frame once something of the one before was seen: a scene that takes longer to
    /// trace plays more slowly.
    pub(super) fn play_on(&mut self) -> Vec<Effect> {
        let open = self.sequence.open.as_ref();
        let Some(open) = open.filter(|open| open.is_playing && self.mode == Mode::Sequence) else {
            return Vec::new();
        };
        let timer = Effect::Later(open.period(), Timer::Frame);
        if open.shown.is_some() && self.pictures.preview.shows_wanted() {
            self.step_frames(1);
        }
        vec![timer]
    }

    /// Leaves SEQUENCE mode with the text as it was before; returns whether it played, if that was the
    /// mode.
    pub(super) fn leave_sequence(&mut self) -> Option<bool> {
        let open = self.sequence.open.as_mut();
        let was_playing = open.is_some_and(|open| std::mem::take(&mut open.is_playing));
        self.suspend_frame();
        let left = (self.mode == Mode::Sequence).then_some(was_playing);
        if left.is_some() {
            self.mode = Mode::Select;
        }
        left
    }

    /// Does something outside of SEQUENCE mode, and returns there if it fails.
    pub(super) fn outside_sequence(
        &mut self,
        act: impl FnOnce(&mut Self) -> Vec<Effect>,
    ) -> Vec<Effect> {
        let left = self.leave_sequence();
        let effects = act(self);
        if self.overlays.has_failed() {
            self.return_to_sequence(left);
        }
        effects
    }

    /// Returns to SEQUENCE mode as it was left.
    fn return_to_sequence(&mut self, left: Option<bool>) {
        let Some(was_playing) = left else {
            return;
        };
        if let Some(open) = &mut self.sequence.open {
            open.is_playing = was_playing;
        }
        self.mode = Mode::Sequence;
        self.resume_frame();
    }

    /// Leaves SEQUENCE mode with the values of the frame in the text, as one undo step.
    pub(super) fn keep_frame(&mut self) {
        let Some(open) = &mut self.sequence.open else {
            return;
        };
        open.is_playing = false;
        let shown = open.shown.take();
        if shown.is_some_and(|shown| shown.live_edit.is_applied) {
            let words = format!("the scene now has the values of frame {}", open.frame);
            let undo = self.key_for("undo");
            self.overlays.say(format!("{words}; {undo} undoes that"));
        }
        self.keep_live_edit();
        self.mode = Mode::Select;
    }

    /// Takes the frame out of the text if SEQUENCE mode was left in another way.
    pub(super) fn follow_sequence(&mut self) {
        let open = self.sequence.open.as_ref();
        if self.mode != Mode::Sequence && open.is_some_and(|open| open.shown.is_some()) {
            self.leave_sequence();
        }
    }

    /// Whether there are unsaved edits, apart from a frame that is shown.
    pub fn has_edits(&self) -> bool {
        let was_dirty = self.sequence.was_dirty();
        was_dirty.unwrap_or_else(|| self.document.is_dirty())
    }

    /// Goes on with the open track after a file was read that cannot be played, its own or another.
    fn refuse_track(&mut self, read: &Path) -> Vec<Effect> {
        let open = self.sequence.open.as_mut();
        if let Some(open) = open.filter(|open| open.path == read) {
            open.is_refused = true;
        }
        self.follow_open_track(read)
    }

    /// Watches the open track again after another one was read in vain.
    fn follow_open_track(&self, read: &Path) -> Vec<Effect> {
        let again = self.reread_track();
        let is_other = |effect: &Effect| !matches!(effect, Effect::ReadTrack(path) if path == read);
        again.filter(is_other).into_iter().collect()
    }

    /// Reads the open track again, if there is one and it is not being written.
    pub(super) fn reread_track(&self) -> Option<Effect> {
        let open = self.sequence.open.as_ref()?;
        if self.sequence.writing.is_some() {
            return None;
        }
        Some(Effect::ReadTrack(open.path.clone()))
    }
}
