//! Keys: typed into the line that is open, otherwise what they are bound to in the present context.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tui_input::Input;

use super::shared::cursor::Typing;
use super::shared::line;
use super::{App, PageFocus, PromptKind, Shared, command, edit, select, transform};
use crate::keymap::{self, Context, Line, Meaning, Mode};
use crate::msg::Effect;
use text::alternatives;

impl App {
    /// Handles a key: as part of the line that is typed, or by what it is bound to.
    pub(crate) fn key(&mut self, key: KeyEvent) -> Vec<Effect> {
        self.shared.overlays.clear_message();
        edit::end_slide(&mut self.shared);
        let context = self.shared.context();
        let before = self.shared.prefix.take();
        let meaning = self.shared.keymap.meaning(context, before, key);
        let controls = key.modifiers.contains(KeyModifiers::CONTROL);
        let reserved = matches!(meaning, Meaning::Does(row) if self.shared.keymap.is_reserved(row));
        if let Some(line) = self.shared.typed_line()
            && !(reserved && controls)
        {
            return self.type_key(line, key);
        }
        if context == Context::In(Mode::Move)
            && transform::type_amount(&mut self.moving, &mut self.shared, key)
        {
            return Vec::new();
        }
        match meaning {
            Meaning::Does(row) => return self.act(row),
            Meaning::Begins => self.shared.prefix = Some(key),
            Meaning::None if self.shared.overlays.dialog.is_some() => {
                // A user who types on without noticing the question learns why nothing happens.
                let keys = self.hints().into_iter().map(|(key, _)| key);
                self.shared.warn(format!("press {}", alternatives(keys)));
            }
            Meaning::None if context == Context::Opening => self.shared.warn_of_opening(),
            Meaning::None if filters_with(&mut self.shared, key) => {}
            Meaning::None => start_typing_with(&mut self.shared, context, key),
        }
        Vec::new()
    }

    fn type_key(&mut self, line: Line, key: KeyEvent) -> Vec<Effect> {
        if line::types(key) && !edit::has_room(&mut self.shared, 1) {
            return Vec::new();
        }
        match line {
            Line::Command | Line::List | Line::Name => return self.prompt_key(key),
            Line::Rows | Line::Search => return self.filter_key(key),
            Line::Menu => edit::menu_key(&mut self.shared, key),
            Line::Value => edit::typing_key(&mut self.shared, key),
        }
        Vec::new()
    }

    /// Types into the filter of the open page. Enter chooses, on a page that is only read it ends the
    /// search.
    fn filter_key(&mut self, key: KeyEvent) -> Vec<Effect> {
        let context = self.shared.context();
        let Some(page) = &mut self.shared.overlays.page else {
            return Vec::new();
        };
        match key.code {
            KeyCode::Enter if !page.is_read() => {
                let accept = self.shared.keymap.row(context, "accept");
                return accept.map_or_else(Vec::new, |row| self.act(row));
            }
            KeyCode::Enter | KeyCode::Esc => page.focus = PageFocus::Lines,
            _ => {
                let count = page.shown().len();
                page.filter.key(key, count);
            }
        }
        Vec::new()
    }

    fn prompt_key(&mut self, key: KeyEvent) -> Vec<Effect> {
        let Some(prompt) = &mut self.shared.overlays.prompt else {
            return Vec::new();
        };
        match key.code {
            KeyCode::Esc => close_prompt(&mut self.shared),
            // As in other programs, Backspace in an empty line closes it.
            KeyCode::Backspace if prompt.input.value().is_empty() => {
                close_prompt(&mut self.shared);
            }
            KeyCode::Enter => {
                let (kind, typed) = (prompt.kind, prompt.input.value().to_owned());
                let is_untouched = typed.trim() == prompt.opened.trim();
                match kind {
                    PromptKind::Command => return self.run_line(&typed),
                    PromptKind::Name if is_untouched => close_prompt(&mut self.shared),
                    PromptKind::Name => {
                        self.shared.overlays.prompt = None;
                        select::rename(&mut self.shared, &typed);
                    }
                    PromptKind::Filter(from) => select::keep_filter(&mut self.shared, from),
                }
            }
            _ => match prompt.kind {
                PromptKind::Command => return command::palette_key(&mut self.shared, key),
                PromptKind::Filter(from) => select::filter_key(&mut self.shared, key, from),
                PromptKind::Name => {
                    line::edit_over(&mut prompt.input, &mut prompt.is_selected, key);
                }
            },
        }
        Vec::new()
    }
}

/// Starts typing a value on a digit, sign, operator, `.` or `(`. Other keys without a meaning are
/// answered.
fn start_typing_with(shared: &mut Shared, context: Context, key: KeyEvent) {
    if let (Context::In(Mode::Edit), KeyCode::Char(first)) = (context, key.code)
        && keymap::begins_value(first)
    {
        shared.cursor.typing = Some(Typing {
            input: Input::from(first.to_string()),
            ..Typing::default()
        });
    } else {
        answer_unknown(shared, context, key);
    }
}

/// Starts filtering the rows of the open page with a character that is no key of it; returns whether it
/// has rows to choose from.
fn filters_with(shared: &mut Shared, key: KeyEvent) -> bool {
    let page = shared.overlays.page.as_mut();
    let Some(page) = page.filter(|page| !page.is_read()) else {
        return false;
    };
    if let KeyCode::Char(_) = key.code {
        page.focus = PageFocus::Search;
        page.filter.key(key, 0);
    }
    true
}

/// Says where a key has a meaning that has none here.
fn answer_unknown(shared: &mut Shared, context: Context, key: KeyEvent) {
    let Some(name) = keymap::name(key) else {
        return;
    };
    let selects = shared.keymap.meaning(Context::In(Mode::Select), None, key);
    if context == Context::In(Mode::Move) && selects != Meaning::None {
        shared.warn_of_transform();
        return;
    }
    let words = match shared.keymap.elsewhere(context, key) {
        Some((mode, way, words)) => {
            let way = way.map_or_else(String::new, |way| format!(" ({way})"));
            format!("{name} in {}{way}: {words}", mode.name())
        }
        None => format!("{name} is not bound here"),
    };
    let help = match shared.keymap.key(context, "help") {
        Some(key) if context != Context::Help => format!(" ({key} for keys)"),
        _ => String::new(),
    };
    shared.overlays.answer(format!("{words}{help}"));
}

/// Closes a line without accepting it, and gives up leaving, which waited for a file name.
fn close_prompt(shared: &mut Shared) {
    let prompt = shared.overlays.prompt.take();
    if let Some(PromptKind::Filter(from)) = prompt.map(|prompt| prompt.kind) {
        select::drop_filter(shared, from);
    }
    shared.palette.reset();
    shared.jobs.next = None;
}
