//! The step from one state to the next: who takes a message.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tui_input::Input;

use super::assets::STILL_READING;
use super::{App, Help, HelpFocus, Message, Mode, Outline, Prompt, PromptKind, line};
use crate::text::{Severity, without_codes};
use crate::ui::keymap::{self, Action, Context};
use crate::ui::msg::{Effect, Msg, Timer};
use crate::ui::terminal::Mouse;
use crate::ui::view::layout::Zoom;

impl App {
    /// Takes a message; returns what is to be done about it.
    pub fn update(&mut self, msg: Msg) -> Vec<Effect> {
        let mut effects = self.take(msg);
        self.scroll();
        effects.extend(self.follow());
        effects.extend(self.follow_edits());
        effects.extend(self.follow_kept());
        effects
    }

    fn take(&mut self, msg: Msg) -> Vec<Effect> {
        match msg {
            Msg::Key(key) => return self.key(key),
            Msg::Paste(text) => self.paste(&text),
            Msg::Mouse(event) => return self.pointer(event),
            Msg::Resize(columns, rows) => self.terminal = (columns, rows),
            Msg::Started(target, generation) => self.started(target, generation),
            Msg::Frame(target, frame) => return self.frame(target, frame),
            Msg::Refused(target, reason) => self.ended(target, reason),
            Msg::Ended(target) => self.ended(target, "the picture can't be traced to its end"),
            Msg::FileChanged => return self.read_again(),
            // The answer may come after the scene got another name.
            Msg::Read(path, read) if !self.is_own_path(&path) => drop(read),
            Msg::Read(_, read) if self.is_opening() => return self.opened(read),
            Msg::Read(_, read) => return self.was_read(read),
            Msg::AssetsRead(wanted, loaded) => self.assets_read(&wanted, loaded),
            Msg::AssetsChanged => return self.read_assets(),
            Msg::Elapsed(Timer::Settled) => return self.settled(),
            Msg::Elapsed(Timer::Interrupt) => self.pending.interrupt = false,
            Msg::Elapsed(Timer::Click) => self.pending.click = None,
            Msg::Elapsed(Timer::Keep) => return self.keep_edits(),
            Msg::Elapsed(Timer::Writing) => return self.tick(),
            Msg::Saved(id, outcome) => return self.was_saved(id, outcome),
            Msg::BackupsFound(copies) => self.backups_found(&copies),
            Msg::Exported(id, outcome) => return self.exported(id, outcome),
            Msg::EditorClosed(outcome) => return self.editor_closed(outcome),
            Msg::Recovered(found) => self.found_kept(found),
            Msg::Kept(revision, outcome) => return self.kept(revision, outcome),
            Msg::Suspend => return vec![Effect::Suspend],
            Msg::Continued => return vec![Effect::TakeTerminal],
            Msg::Interrupt => return self.interrupt(),
            Msg::Terminate { .. } | Msg::HangUp => return self.quit_keeping_edits(),
            Msg::FewColours(depth) => self.suggest(depth.cure()),
            Msg::Failed(reason) => self.fail_too(&reason),
        }
        Vec::new()
    }

    fn key(&mut self, key: KeyEvent) -> Vec<Effect> {
        self.clear_message();
        let context = keymap::context(self);
        let action = keymap::action(context, key);
        let is_line = self.typing.is_some()
            || self.prompt.is_some()
            || self
                .help
                .as_ref()
                .is_some_and(|h| h.focus == HelpFocus::Search);
        let controls = key.modifiers.contains(KeyModifiers::CONTROL);
        let reserved = matches!(
            action,
            Some(Action::Interrupt | Action::Suspend | Action::Repaint)
        );
        // Only a dialog comes before a line that is being typed.
        if is_line && self.dialog.is_none() && !(reserved && controls) {
            return self.type_key(key);
        }
        let second_g = self.pending.prefix.take() == Some(Action::G);
        match action {
            Some(Action::G) if second_g => self.act(Action::First, context),
            Some(action) => self.act(action, context),
            None if self.dialog.is_some() => {
                // A user who types on without having seen the question learns why nothing happens.
                let keys: Vec<_> = keymap::hints(context)
                    .into_iter()
                    .map(|(key, _)| key)
                    .collect();
                self.warn(format!("the question comes first: {}", keys.join(", ")));
                Vec::new()
            }
            None if context == Context::Opening => {
                self.warn_of_opening();
                Vec::new()
            }
            None => self.start_typing_with(context, key),
        }
    }

    /// A digit or a sign begins to type a value; `.` makes the steps larger.
    fn start_typing_with(&mut self, context: Context, key: KeyEvent) -> Vec<Effect> {
        if let (Context::In(Mode::Edit), KeyCode::Char(first)) = (context, key.code)
            && (first.is_ascii_digit() || matches!(first, '-' | '+'))
        {
            self.type_value(Input::from(first.to_string()));
        }
        Vec::new()
    }

    fn type_key(&mut self, key: KeyEvent) -> Vec<Effect> {
        if self.prompt.is_some() {
            return self.prompt_key(key);
        }
        if self.typing.is_some() {
            self.typing_key(key);
        } else if let Some(help) = &mut self.help {
            match key.code {
                KeyCode::Enter | KeyCode::Esc => help.focus = HelpFocus::Lines,
                _ => line::edit(&mut help.search, key),
            }
            help.top = 0;
        }
        Vec::new()
    }

    fn prompt_key(&mut self, key: KeyEvent) -> Vec<Effect> {
        let Some(prompt) = &mut self.prompt else {
            return Vec::new();
        };
        match key.code {
            KeyCode::Esc => self.close_prompt(),
            // As in other programs: rubbing out nothing closes the line.
            KeyCode::Backspace if prompt.input.value().is_empty() => self.close_prompt(),
            KeyCode::Enter => {
                let (kind, said) = (prompt.kind, prompt.input.value().to_owned());
                self.prompt = None;
                match kind {
                    PromptKind::Command => return self.command(&said),
                    PromptKind::Search => {
                        self.searched = said;
                        self.search(1);
                    }
                }
            }
            _ => line::edit(&mut prompt.input, key),
        }
        Vec::new()
    }

    fn act(&mut self, action: Action, context: Context) -> Vec<Effect> {
        match action {
            Action::Move(rows) => self.move_cursor(context, rows),
            Action::Page(pages) => self.move_cursor(context, pages * self.page(context)),
            Action::First => self.move_cursor(context, isize::MIN),
            Action::Last => self.move_cursor(context, isize::MAX),
            Action::G => self.pending.prefix = Some(action),
            Action::Cycle(step) => self.cycle(step),
            Action::Go(mode) => return self.go(mode),
            Action::Back => return self.back(context),
            Action::Accept => return self.accept(context),
            Action::No => return self.decline(),
            Action::Search => self.open_search(),
            Action::SearchAgain(step) => self.search(step),
            Action::Command => self.open_prompt(PromptKind::Command, ""),
            Action::Outline => self.toggle_outline(),
            Action::Visibility => self.toggle_visibility(),
            Action::Type => self.type_current(),
            Action::Nudge(steps, stride) => self.nudge(steps, stride),
            Action::Stride(step) => self.change_stride(step),
            Action::Component(step) => self.next_component(step),
            Action::Orbit(left, up) => self.orbit_steps(left, up),
            Action::Pan(left, up) => self.pan(left, up),
            Action::Dolly(steps) => self.dolly(steps),
            Action::Widen(steps) => self.widen(steps),
            Action::ResetView => self.reset_view(),
            Action::FrameSelected => self.frame_selected(),
            Action::SaveView => self.save_view(),
            Action::Cross(right, down) => self.move_cross(right, down),
            Action::Mine | Action::Theirs | Action::AllMine | Action::AllTheirs => {
                self.decide(action);
            }
            Action::Undo => self.undo(),
            Action::Redo => self.redo(),
            Action::Errors => self.toggle_errors(),
            Action::Message => self.show_past_message(),
            Action::Help => self.help = Some(Help::default()),
            Action::Zoom => self.toggle_zoom(),
            Action::Show(aov) => self.show(aov),
            Action::Integrator => self.toggle_integrator(),
            Action::Stop => return self.stop(),
            Action::Export => return self.export_default(),
            Action::Save => return self.save_key(),
            Action::Editor => return self.open_editor(),
            Action::Mouse => return self.toggle_mouse(),
            Action::Repaint => return vec![Effect::Repaint],
            Action::Suspend => return vec![Effect::Suspend],
            Action::Quit => return self.quit(),
            Action::Interrupt => return self.interrupt(),
        }
        Vec::new()
    }

    fn go(&mut self, mode: Mode) -> Vec<Effect> {
        self.document.end_step();
        match mode {
            Mode::Trace => return self.start_trace(),
            Mode::View | Mode::Pick if self.scene.is_none() => {
                self.fail(if self.awaits_assets() {
                    STILL_READING
                } else {
                    "there is no picture: the scene has errors"
                });
            }
            Mode::Edit if self.placed().is_empty() => self.fail("nothing to edit here"),
            Mode::Pick => self.start_pick(),
            Mode::Select | Mode::View | Mode::Edit => self.mode = mode,
        }
        Vec::new()
    }

    /// Leaves a line without taking it; a quit that waited for the name in it is off.
    fn close_prompt(&mut self) {
        self.prompt = None;
        self.pending.quit = false;
    }

    fn back(&mut self, context: Context) -> Vec<Effect> {
        match context {
            Context::Help => self.help = None,
            Context::Errors => self.errors = None,
            Context::Conflict | Context::Quit | Context::Recover => return self.put_off(),
            Context::Opening => {}
            Context::In(Mode::Trace) => {
                self.mode = self.pending.before_trace.take().unwrap_or(Mode::Select);
            }
            Context::In(_) => {
                self.document.end_step();
                self.mode = Mode::Select;
            }
        }
        Vec::new()
    }

    fn accept(&mut self, context: Context) -> Vec<Effect> {
        match context {
            Context::Errors => self.go_to_error(),
            Context::Conflict => return self.adopt(),
            Context::Quit => return self.quit_anyway(),
            Context::Recover => return self.restore(),
            Context::In(Mode::Pick) => self.pick_cross(),
            Context::In(_) | Context::Help | Context::Opening => {}
        }
        Vec::new()
    }

    fn toggle_outline(&mut self) {
        self.outline = match self.outline {
            Outline::Marked => Outline::Hidden,
            Outline::Hidden => Outline::Marked,
        };
    }

    fn toggle_zoom(&mut self) {
        self.zoom = match self.zoom {
            Zoom::Panels => Zoom::Picture,
            Zoom::Picture => Zoom::Panels,
        };
    }

    fn toggle_mouse(&mut self) -> Vec<Effect> {
        let (mouse, words) = match self.mouse {
            Mouse::On => (Mouse::Off, "mouse off: the terminal selects text again"),
            Mouse::Off => (Mouse::On, "mouse on: hold Shift to select text"),
        };
        self.mouse = mouse;
        self.say(words);
        vec![Effect::SetMouse(mouse)]
    }

    pub(super) fn open_prompt(&mut self, kind: PromptKind, said: &str) {
        self.prompt = Some(Prompt {
            kind,
            input: Input::from(said),
        });
    }

    fn open_search(&mut self) {
        match &mut self.help {
            Some(help) => help.focus = HelpFocus::Search,
            None => self.open_prompt(PromptKind::Search, ""),
        }
    }

    /// Shows a message unless another one is shown already.
    fn suggest(&mut self, text: impl Into<String>) {
        if self.message.is_none() {
            self.say(text);
        }
    }

    pub(super) fn say(&mut self, text: impl Into<String>) {
        self.show_message(None, text);
    }

    pub(super) fn warn(&mut self, text: impl Into<String>) {
        self.show_message(Some(Severity::Warning), text);
    }

    /// Says that something failed beside what may have failed before: of two errors the first one is
    /// usually the other's cause.
    fn fail_too(&mut self, text: &str) {
        let text = &*without_codes(text);
        let before = self.message.as_ref();
        let before = before.filter(|before| before.severity == Some(Severity::Error));
        let both = before.map(|before| {
            if before.text.contains(text) {
                before.text.clone()
            } else {
                format!("{}; {text}", before.text)
            }
        });
        self.fail(both.unwrap_or_else(|| text.to_owned()));
    }

    pub(super) fn fail(&mut self, text: impl Into<String>) {
        self.show_message(Some(Severity::Error), text);
    }

    fn show_message(&mut self, severity: Option<Severity>, text: impl Into<String>) {
        let text = without_codes(&text.into()).into_owned();
        self.message = Some(Message { severity, text });
    }

    /// Takes the message off the screen; it can be asked for again.
    pub(super) fn clear_message(&mut self) {
        if let Some(message) = self.message.take() {
            self.past_message = Some(message);
        }
    }

    fn show_past_message(&mut self) {
        self.message = self.past_message.take();
        self.suggest("there was no message yet");
    }
}
