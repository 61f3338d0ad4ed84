//! The step from one state to the next: dispatches messages.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tui_input::Input;

use super::cursor::Typing;
use super::history;
use super::journal::KEPT_AFTER;
use super::sequence;
use super::{App, Grid, PageFocus, PromptKind, Shared, Tool, line};
use crate::text::{Severity, alternatives};
use crate::ui::arrange::{Zoom, divided, resized};
use crate::ui::history_scene::NoPicture;
use crate::ui::keymap::{self, Context, Meaning, Mode};
use crate::ui::msg::{Effect, Msg, Target, Timer};
use crate::ui::terminal::Mouse;

/// Why a renderer has ended that was not stopped.
const STOPPED: &str = "the renderer stopped early";

impl App {
    /// Processes a message and returns the resulting effects.
    pub fn update(&mut self, msg: Msg) -> Vec<Effect> {
        self.shared.overlays.begin_step();
        let had_errors = 0 < self.shared.error_count();
        let mut effects = self.take(msg);
        if had_errors && self.shared.error_count() == 0 {
            self.shared.overlays.forgive_errors();
        }
        self.shared.overlays.end_step();
        self.shared.follow_input();
        self.settle();
        effects.extend(self.shared.follow_step());
        effects.extend(self.follow());
        effects
    }

    fn take(&mut self, msg: Msg) -> Vec<Effect> {
        let shared = &mut self.shared;
        let (sequence, thumbnails) = (&mut self.sequence, &mut self.thumbnails);
        match msg {
            Msg::Key(key) => self.key(key),
            Msg::Mouse(event) => self.pointer(event),
            Msg::Started(Target::Thumbnail, generation) => {
                thumbnails.started(generation);
                Vec::new()
            }
            Msg::Frame(Target::Thumbnail, frame) => {
                thumbnails.take(&frame);
                Vec::new()
            }
            Msg::Refused(Target::Thumbnail, reason) => {
                thumbnails.fail(NoPicture::Failed(reason));
                Vec::new()
            }
            Msg::Ended(Target::Thumbnail) => {
                thumbnails.fail(NoPicture::Failed(STOPPED.to_owned()));
                Vec::new()
            }
            Msg::Derived(ticket, derived) => history::derived(thumbnails, shared, ticket, derived),
            Msg::TrackRead(path, read) => sequence::track_read(sequence, shared, path, read),
            Msg::TrackChanged => sequence::reread(sequence).into_iter().collect(),
            Msg::TrackWritten(outcome) => sequence::written(sequence, shared, outcome),
            Msg::Elapsed(Timer::Frame) => sequence::play_on(sequence, shared),
            Msg::EditorClosed(outcome) => {
                let mut effects = shared.editor_closed(outcome);
                effects.extend(sequence::reread(sequence));
                effects
            }
            msg => shared.take(msg),
        }
    }

    fn key(&mut self, key: KeyEvent) -> Vec<Effect> {
        self.shared.overlays.clear_message();
        self.shared.end_slide();
        let context = self.shared.context();
        let before = self.shared.prefix.take();
        let meaning = self.shared.keymap.meaning(context, before, key);
        let is_line = self.shared.has_input();
        let controls = key.modifiers.contains(KeyModifiers::CONTROL);
        let reserved = matches!(meaning, Meaning::Does(row) if self.shared.keymap.is_reserved(row));
        // Only a dialog takes precedence over a line being typed.
        if is_line && self.shared.overlays.dialog.is_none() && !(reserved && controls) {
            return self.type_key(key);
        }
        if context == Context::In(Mode::Move) && self.shared.type_amount(key) {
            return Vec::new();
        }
        match meaning {
            Meaning::Does(row) => self.act(row),
            Meaning::Begins => {
                self.shared.prefix = Some(key);
                Vec::new()
            }
            Meaning::None if self.shared.overlays.dialog.is_some() => {
                // A user who types on without noticing the question learns why nothing happens.
                let keys = self.hints().into_iter().map(|(key, _)| key);
                self.shared
                    .overlays
                    .warn(format!("press {}", alternatives(keys)));
                Vec::new()
            }
            Meaning::None if context == Context::Opening => {
                self.shared.warn_of_opening();
                Vec::new()
            }
            Meaning::None
                if matches!(context, Context::Views | Context::Recent | Context::Steps) =>
            {
                self.shared.filter_with(key);
                Vec::new()
            }
            Meaning::None => self.shared.start_typing_with(context, key),
        }
    }

    fn type_key(&mut self, key: KeyEvent) -> Vec<Effect> {
        if line::types(key) && !self.shared.has_room(1) {
            return Vec::new();
        }
        if self.shared.overlays.prompt.is_some() {
            return self.prompt_key(key);
        }
        if self.shared.overlays.menu.is_some() {
            self.shared.menu_key(key);
            return Vec::new();
        }
        if self.shared.cursor.typing.is_some() {
            self.shared.typing_key(key);
        } else if let Some(help) = &mut self.shared.overlays.help {
            match key.code {
                KeyCode::Enter | KeyCode::Esc => help.focus = PageFocus::Lines,
                _ => line::edit(&mut help.search, key),
            }
            help.top = 0;
        } else if let Some(page) = &mut self.shared.overlays.page {
            match key.code {
                KeyCode::Enter => return self.shared.choose(),
                KeyCode::Esc => page.focus = PageFocus::Lines,
                _ => {
                    let count = page.rows().len();
                    page.filter.key(key, count);
                }
            }
        }
        Vec::new()
    }

    fn prompt_key(&mut self, key: KeyEvent) -> Vec<Effect> {
        let Some(prompt) = &mut self.shared.overlays.prompt else {
            return Vec::new();
        };
        match key.code {
            KeyCode::Esc => self.shared.close_prompt(),
            // As in other programs, Backspace in an empty line closes it.
            KeyCode::Backspace if prompt.input.value().is_empty() => self.shared.close_prompt(),
            KeyCode::Enter => {
                let (kind, typed) = (prompt.kind, prompt.input.value().to_owned());
                let is_untouched = typed.trim() == prompt.opened.trim();
                match kind {
                    PromptKind::Command => return self.run_line(&typed),
                    PromptKind::Name if is_untouched => self.shared.close_prompt(),
                    PromptKind::Name => {
                        self.shared.overlays.prompt = None;
                        self.shared.rename(&typed);
                    }
                    PromptKind::Filter(from) => self.shared.keep_filter(from),
                }
            }
            _ => match prompt.kind {
                PromptKind::Command => return self.shared.palette_key(key),
                PromptKind::Filter(from) => self.shared.filter_key(key, from),
                PromptKind::Name => {
                    line::edit_over(&mut prompt.input, &mut prompt.is_selected, key);
                }
            },
        }
        Vec::new()
    }

    /// Does something outside of SEQUENCE, and returns there if it fails.
    pub(super) fn outside(&mut self, act: impl FnOnce(&mut Self) -> Vec<Effect>) -> Vec<Effect> {
        let mode = self.shared.step_outside();
        let effects = act(self);
        self.shared.return_if_failed(mode);
        effects
    }

    /// Goes to a mode, if it can be entered now.
    pub(super) fn go(&mut self, mode: Mode) -> Vec<Effect> {
        match mode {
            Mode::Sequence => sequence::open_track(&mut self.sequence, &mut self.shared, None),
            mode => self.shared.go(mode),
        }
    }
}

impl Shared {
    /// Updates what depends on the whole state after a step: scrolling, pictures, the journal, the
    /// panels.
    pub(super) fn follow_step(&mut self) -> Vec<Effect> {
        let areas = self.areas();
        self.scroll(&areas);
        self.follow_views();
        let mut effects = self.follow();
        self.follow_histogram();
        effects.extend(self.follow_explained());
        if self.transient.is_none() {
            effects.extend(self.disk.journal.follow(&self.document));
        }
        effects.extend(self.follow_kept());
        let time = self.overlays.time_to_read();
        effects.extend(time.map(|time| Effect::Later(time, Timer::Message)));
        effects.extend(self.keep_panels());
        effects
    }

    fn take(&mut self, msg: Msg) -> Vec<Effect> {
        match msg {
            Msg::Paste(text) => return self.paste(&text),
            Msg::Resize(columns, rows) => self.terminal = (columns, rows),
            Msg::Grid { across, down } => {
                self.pictures.grid = Grid { across, down };
                self.pictures.preview.asked = None;
            }
            Msg::Started(Target::Trial, generation) => self.suggestions.started(generation),
            Msg::Started(target, generation) => {
                self.pictures.want(target, Some(generation));
                self.compared.want(target, Some(generation));
            }
            Msg::Recalled(recalled) => self.recalled(recalled),
            Msg::Frame(target, frame) => return self.frame(target, frame),
            Msg::Refused(target, reason) => return self.ended(target, reason),
            Msg::Explained(question, answer) => self.explained(question, answer),
            Msg::Ended(target) => return self.ended(target, STOPPED),
            Msg::FileChanged => return self.read_again(),
            Msg::Polled(what, reason) => self.polled(what, reason),
            // The scene may have been given another name since the request.
            Msg::Read(path, read) if !self.disk.is_own(&path) => drop(read),
            Msg::Opened(path, opened) => return self.scene_read(path, opened),
            Msg::Read(_, read) if self.disk.is_opening() => return self.opened(read),
            Msg::Read(_, read) => return self.was_read(read),
            Msg::AssetsRead(wanted, loaded) => self.assets_read(&wanted, loaded),
            Msg::AssetsChanged => return self.assets.read(),
            Msg::Elapsed(Timer::Settled) => return self.settled(),
            Msg::Elapsed(Timer::Interrupt) => self.jobs.interrupt = false,
            Msg::Elapsed(Timer::Click) => self.cursor.forget_click(),
            Msg::Elapsed(Timer::Message) => self.overlays.turn_message(),
            // The transient edit would be stored as well.
            Msg::Elapsed(timer @ Timer::Keep) if self.transient.is_some() => {
                return vec![Effect::Later(KEPT_AFTER, timer)];
            }
            Msg::Elapsed(Timer::Keep) => return self.keep_edits().into_iter().collect(),
            Msg::Elapsed(Timer::Writing) => return self.tick(),
            Msg::Saved(id, outcome) => return self.was_saved(id, outcome),
            Msg::BackupsFound(copies) => self.backups_found(&copies),
            Msg::Exported(id, outcome) => return self.exported(id, outcome),
            Msg::Filmed(id, progress) => sequence::filmed(self, id, progress),
            Msg::FrameExported(exported) => self.jobs.note_export(exported),
            Msg::Listed(folder, names) => self.folder_listed(folder, names),
            Msg::Taken(id, reason) => return self.is_taken(id, reason),
            Msg::ReferenceRead(id, read) => return self.reference_read(id, read),
            Msg::Compared(pair, found) => self.compared.measured(pair, found),
            Msg::RecentListed(scenes) => self.show_recent(scenes),
            Msg::Recovered(found) => self.found_kept(found),
            Msg::Kept(revision, outcome) => {
                return self.kept(revision, outcome).into_iter().collect();
            }
            Msg::Suspend => return vec![Effect::Suspend],
            Msg::Continued => return vec![Effect::TakeTerminal],
            Msg::Interrupt => return self.interrupt(),
            Msg::Terminate { .. } | Msg::HangUp => return self.quit_keeping_edits(),
            Msg::FewColours(depth) => self.overlays.suggest(depth.cure()),
            Msg::Failed(reason) => self.overlays.fail_too(&reason),
            // Taken by [`App`] and the rooms.
            Msg::Key(_)
            | Msg::Mouse(_)
            | Msg::Derived(..)
            | Msg::TrackRead(..)
            | Msg::TrackChanged
            | Msg::TrackWritten(_)
            | Msg::EditorClosed(_)
            | Msg::Elapsed(Timer::Frame) => {}
        }
        Vec::new()
    }

    /// Starts typing a value on a digit, sign, operator, `.` or `(`. Other keys without a meaning are
    /// answered.
    fn start_typing_with(&mut self, context: Context, key: KeyEvent) -> Vec<Effect> {
        if let (Context::In(Mode::Edit), KeyCode::Char(first)) = (context, key.code)
            && keymap::begins_value(first)
        {
            self.cursor.typing = Some(Typing {
                input: Input::from(first.to_string()),
                ..Typing::default()
            });
        } else {
            self.answer_unknown(context, key);
        }
        Vec::new()
    }

    /// Starts filtering the open page with a character that is no key of it.
    fn filter_with(&mut self, key: KeyEvent) {
        if let (Some(page), KeyCode::Char(_)) = (&mut self.overlays.page, key.code) {
            page.focus = PageFocus::Search;
            page.filter.key(key, 0);
        }
    }

    /// Says where a key has a meaning that has none here.
    fn answer_unknown(&mut self, context: Context, key: KeyEvent) {
        let Some(name) = keymap::name(key) else {
            return;
        };
        let selects = self.keymap.meaning(Context::In(Mode::Select), None, key);
        if context == Context::In(Mode::Move) && selects != Meaning::None {
            self.warn_of_transform();
            return;
        }
        let words = match (self.keymap.elsewhere(context, key), context) {
            (Some((mode, way, words)), _) => {
                let way = way.map_or_else(String::new, |way| format!(" ({way})"));
                format!("`{name}` in {}{way}: {words}", mode.name())
            }
            (None, Context::In(mode)) => format!("`{name}` is not bound in {}", mode.name()),
            (None, _) => format!("`{name}` is not bound here"),
        };
        let help = match self.keymap.key(context, "help") {
            Some(key) if context != Context::Help => format!("; {key} lists keys"),
            _ => String::new(),
        };
        self.overlays.answer(format!("{words}{help}"));
    }

    pub(super) fn quit_key(&mut self) -> Vec<Effect> {
        if self.mode == Mode::Move {
            self.warn_of_transform();
            return Vec::new();
        }
        self.quit()
    }

    /// Leaves SEQUENCE, if that is the mode, with the text as it was before the frame.
    pub(super) fn leave_sequence(&mut self) {
        self.revert_transient();
        if self.mode == Mode::Sequence {
            self.mode = Mode::Select;
        }
    }

    /// Leaves SEQUENCE for something that is done outside of it; returns the mode before.
    pub(super) fn step_outside(&mut self) -> Mode {
        let mode = self.mode;
        self.leave_sequence();
        mode
    }

    /// Returns to SEQUENCE if that was the mode and what was done outside of it failed.
    pub(super) fn return_if_failed(&mut self, mode: Mode) {
        if mode == Mode::Sequence && self.overlays.has_failed() {
            self.mode = mode;
        }
    }

    pub(super) fn go(&mut self, mode: Mode) -> Vec<Effect> {
        self.document.end_step();
        match mode {
            Mode::Trace => return self.start_trace(),
            Mode::Compare => return self.start_comparison(),
            Mode::View | Mode::Fly | Mode::Inspect if self.scene.is_none() => {
                self.refuse_picture(Severity::Error, &self.no_picture());
            }
            Mode::Edit if self.cursor.fields().is_empty() => {
                self.overlays.fail("nothing to edit here");
            }
            Mode::Inspect => self.start_inspecting(),
            Mode::Move => self.start_transform(Tool::Move),
            // It is entered once its track is read.
            Mode::Sequence => {}
            Mode::Select | Mode::View | Mode::Fly | Mode::Edit => self.mode = mode,
        }
        Vec::new()
    }

    /// Closes a line without accepting it, and gives up leaving, which waited for a file name.
    fn close_prompt(&mut self) {
        let prompt = self.overlays.prompt.take();
        if let Some(PromptKind::Filter(from)) = prompt.map(|prompt| prompt.kind) {
            self.drop_filter(from);
        }
        self.palette.reset();
        self.jobs.next = None;
    }

    /// Goes back from what is open, or from the mode; never discards anything.
    pub(super) fn go_back(&mut self) {
        match self.context() {
            Context::Errors => self.overlays.errors = None,
            Context::Rays => self.inspection.explained = None,
            Context::In(Mode::Trace) => self.mode = self.pictures.mode_before(),
            Context::In(Mode::Compare) => self.end_comparison(),
            Context::In(Mode::Inspect) => self.stop_inspecting(),
            Context::In(Mode::Select) if self.end_filter() => {}
            Context::In(Mode::Select) => self.cursor.marks.clear(),
            Context::In(Mode::Edit | Mode::View | Mode::Fly) => {
                self.document.end_step();
                self.mode = Mode::Select;
            }
            // They have keys of their own for that.
            _ => {}
        }
    }

    pub(super) fn toggle_zoom(&mut self) {
        self.zoom = match self.zoom {
            Zoom::Panels => Zoom::Picture,
            Zoom::Picture => Zoom::Panels,
        };
    }

    /// Moves the border between picture and panels by some cells, towards the picture if positive.
    pub(super) fn resize_panels(&mut self, cells: i32) {
        let zoom = self.zoom_now();
        match resized(&self.areas(), &self.shape(zoom), cells) {
            Some(panels) => self.panels = panels,
            None => self.overlays.say("there are no panels to resize here"),
        }
    }

    /// Moves the border between list and fields by some cells, towards the fields if positive.
    pub(super) fn resize_list(&mut self, cells: i32) {
        let zoom = self.zoom_now();
        match divided(&self.areas(), &self.shape(zoom), cells) {
            Some(panels) => self.panels = panels,
            None => self.overlays.say("there are no panels to resize here"),
        }
    }

    /// Keeps new sizes of the panels for other sessions, once they are not being dragged.
    fn keep_panels(&mut self) -> Option<Effect> {
        let is_new = self.resizing.is_none() && self.panels != self.kept_panels;
        self.kept_panels = if is_new {
            self.panels
        } else {
            self.kept_panels
        };
        is_new.then_some(Effect::KeepPanels(self.panels))
    }

    pub(super) fn toggle_mouse(&mut self) -> Vec<Effect> {
        let (mouse, words) = match self.mouse {
            Mouse::On => (Mouse::Off, "mouse off: the terminal selects text again"),
            Mouse::Off => (Mouse::On, "mouse on: hold Shift to select text"),
        };
        self.mouse = mouse;
        self.overlays.say(words);
        vec![Effect::SetMouse(mouse)]
    }
}
