//! Entering values: nudging, typing, pasting.

use crossterm::event::{KeyCode, KeyEvent};
use tui_input::Input;

use super::cursor::Typing;
use super::typed::Values;
use super::{PageFocus, PromptKind, Shared, Stride, line, literals, typed};
use crate::language::table::{Field, Kind};
use crate::text::{Diagnostic, Span, parse_number};
use crate::ui::keymap::{Context, Mode};
use crate::ui::msg::Effect;

impl Shared {
    /// The current component's field and its literal as shown.
    fn current(&self) -> Option<(&'static Field, String)> {
        let row = self.field_row(self.cursor.field)?;
        let literal = row.literals.get(self.cursor.component)?.clone();
        Some((row.field, literal))
    }

    pub(super) fn nudge(&mut self, steps: i8, stride: Stride) {
        let Some((field, literal)) = self.current() else {
            return;
        };
        let step = self.cursor.stride_with(stride).of(field.step);
        let nudged = match field.kind {
            Kind::Choice(words) => {
                let word = field
                    .chosen(&literal)
                    .map_or(&literal[..], |(_, word)| word);
                literals::next(words, word, steps)
            }
            Kind::Reference(category) | Kind::Name(category) => {
                let known = self.source().references(self.cursor.selected(), category);
                let known: Vec<_> = known.into_iter().map(|(literal, _)| literal).collect();
                literals::next(&known, &literal, steps)
            }
            _ => literals::nudged(&literal, f64::from(steps) * step, step)
                .map(|nudged| literals::kept_in(field.usual, &literal, nudged)),
        };
        let Some(nudged) = nudged else {
            let expected = field.expected();
            self.overlays
                .fail(format!("{literal} has no next value; type {expected}"));
            return;
        };
        if nudged == literal {
            let is_end = |end: &f64| parse_number(literals::plain(&literal)) == Ok(*end);
            self.overlays.warn(if !field.kind.is_numeric() {
                "there are no other choices"
            } else if literals::slider_ends(field.usual).is_some_and(|ends| ends.iter().any(is_end))
            {
                "end of the slider; type a value to go on"
            } else {
                "the step is too small to change this number"
            });
        } else if let Err(refused) = self.assign(&[vec![(self.cursor.component, nudged)]]) {
            self.overlays.fail(refused.message);
        }
    }

    pub(super) fn next_component(&mut self, step: isize) {
        self.document.end_step();
        self.cursor.next_component(step);
    }

    pub(super) fn type_current(&mut self) {
        if let Some((field, literal)) = self.current() {
            self.cursor.typing = Some(Typing {
                opened: Some(literal.clone()),
                input: Input::from(literal),
                is_selected: !field.kind.is_numeric(),
                refused: None,
            });
        }
    }

    pub(super) fn typing_key(&mut self, key: KeyEvent) {
        let Some(typing) = &mut self.cursor.typing else {
            return;
        };
        match key.code {
            KeyCode::Esc => self.cursor.typing = None,
            KeyCode::Enter => {
                self.commit();
            }
            KeyCode::Tab | KeyCode::BackTab => {
                let step = if key.code == KeyCode::Tab { 1 } else { -1 };
                if self.commit() {
                    self.next_component(step);
                }
            }
            KeyCode::Down | KeyCode::Up => {
                let step = if key.code == KeyCode::Down { 1 } else { -1 };
                if self.commit() {
                    self.move_cursor_in(Context::In(Mode::Edit), step);
                }
            }
            _ => {
                typing.refused = None;
                let deletes = matches!(key.code, KeyCode::Backspace | KeyCode::Delete);
                let replaces = deletes || line::types(key);
                if std::mem::take(&mut typing.is_selected) && replaces {
                    typing.input.reset();
                }
                line::edit(&mut typing.input, key);
            }
        }
    }

    /// Accepts the typed value, or drops one that is as it was opened: another program may have changed
    /// the field since. Returns whether it was valid.
    fn commit(&mut self) -> bool {
        let Some(typing) = &self.cursor.typing else {
            return true;
        };
        let typed = typing.input.value().trim().to_owned();
        let opened = typing.opened.as_deref().map(str::trim);
        if opened == Some(&*typed) {
            self.cursor.typing = None;
            return true;
        }
        let outcome = match self.literals_of(&typed) {
            Ok(values) => self.assign_whole(&values),
            Err(reason) => Err(Diagnostic::error(Span::at(0), reason, "")),
        };
        match outcome {
            Ok(()) => self.cursor.typing = None,
            Err(mut refused) => {
                refused.message = refused.message_with_hint();
                if let Some(typing) = &mut self.cursor.typing {
                    typing.refused = Some(refused);
                }
            }
        }
        self.cursor.typing.is_none()
    }

    /// Sets fields as an undo step of its own.
    pub(super) fn assign_whole(&mut self, values: &[Values]) -> Result<(), Diagnostic> {
        self.document.end_step();
        let outcome = self.assign(values);
        self.document.end_step();
        if outcome.is_ok() {
            self.merge_input();
        }
        outcome
    }

    /// The values that a typed or pasted text gives to the current field and, if it is a list that
    /// is longer, to those below; or why it gives none.
    fn literals_of(&self, text: &str) -> Result<Vec<Values>, String> {
        let Some(row) = self.field_row(self.cursor.field) else {
            return Err("nothing to edit here".to_owned());
        };
        let values = typed::values(row.field, (self.cursor.component, &row.literals), text);
        values.map(|values| vec![values]).or_else(|reason| {
            let below = self.cursor.fields().iter().skip(self.cursor.field);
            let kinds = below.map(|placed| placed.field.kind);
            typed::spread(kinds, text).ok_or(reason)
        })
    }

    /// Whether the line being typed has room for more characters; says so if it has not.
    pub(super) fn has_room(&mut self, more: usize) -> bool {
        let typing = self.cursor.typing.as_ref();
        let typing = typing.map(|typing| (&typing.input, typing.is_selected));
        let has_room = match self.overlays.line().or(typing) {
            None | Some((_, true)) => more <= line::LONGEST,
            Some((input, false)) => input.value().chars().count() + more <= line::LONGEST,
        };
        if !has_room {
            let words = format!("a line is limited to {} characters", line::LONGEST);
            self.overlays.warn(words);
        }
        has_room
    }

    pub(super) fn paste(&mut self, text: &str) -> Vec<Effect> {
        let is_open = self.overlays.line().is_some() && self.overlays.dialog.is_none();
        if is_open && !self.has_room(text.trim_end().chars().count()) {
            return Vec::new();
        }
        if let Some(prompt) = &mut self.overlays.prompt
            && self.overlays.dialog.is_none()
        {
            line::insert_over(&mut prompt.input, &mut prompt.is_selected, text);
            if let PromptKind::Filter(from) = prompt.kind {
                self.filter_list(from);
            }
            return self.palette_pasted();
        }
        self.paste_value(text);
        Vec::new()
    }

    fn paste_value(&mut self, text: &str) {
        let pasted = text.trim();
        if self.overlays.dialog.is_some() {
            return;
        }
        if let Some(help) = &mut self.overlays.help {
            if help.focus == PageFocus::Search {
                line::insert(&mut help.search, text);
                help.top = 0;
            }
            return;
        }
        if let Some(page) = &mut self.overlays.page {
            page.filter.insert(text);
            return;
        }
        if let Some(menu) = &mut self.overlays.menu {
            menu.filter.insert(text);
            self.follow_menu();
            return;
        }
        if self.disk.is_opening() {
            self.warn_of_opening();
            return;
        }
        if self.overlays.picker.is_some() {
            self.paste_colour(pasted);
            return;
        }
        if self.mode == Mode::Select {
            self.insert(text);
            return;
        }
        if self.mode != Mode::Edit {
            self.overlays
                .say("items are pasted in SELECT, values in EDIT");
            return;
        }
        let values = self.literals_of(pasted);
        let count = |values: &Vec<Values>| values.iter().map(Vec::len).sum::<usize>();
        let is_whole = values.as_ref().is_ok_and(|values| 1 < count(values));
        let is_typed = self.cursor.typing.is_some() && !is_whole;
        if is_typed && !self.has_room(text.trim_end().chars().count()) {
            return;
        }
        if let (Some(typing), false) = (&mut self.cursor.typing, is_whole) {
            typing.refused = None;
            line::insert_over(&mut typing.input, &mut typing.is_selected, text);
            return;
        }
        let values = match values {
            Ok(values) => values,
            Err(reason) => {
                self.overlays.fail(format!("cannot paste this: {reason}"));
                return;
            }
        };
        self.cursor.typing = None;
        if let Err(refused) = self.assign_whole(&values) {
            self.overlays.fail(refused.message);
        }
    }
}
