//! Values from the keyboard: nudged, typed, pasted.

use crossterm::event::{KeyCode, KeyEvent};
use tui_input::Input;

use super::{App, Mode, Stride, Typing, line, literals};
use crate::language::table::{Field, Kind, place_of};
use crate::text::{Diagnostic, Span};

impl App {
    /// The literal of the current component as it is shown.
    fn current(&self) -> Option<(&'static Field, String)> {
        let row = self.fields().into_iter().nth(self.field)?;
        let literal = row.literals.get(self.component)?.clone();
        Some((row.field, literal))
    }

    pub(super) fn nudge(&mut self, steps: i8, stride: Stride) {
        let Some((field, literal)) = self.current() else {
            return;
        };
        // A key that is held down beside says more than the stride set before.
        let stride = match stride {
            Stride::Plain => self.stride,
            held => held,
        };
        let step = match stride {
            Stride::Fine => field.step / 10.0,
            Stride::Plain => field.step,
            Stride::Coarse => field.step * 10.0,
        };
        let nudged = match field.kind {
            Kind::Choice(words) => {
                let word = place_of(words, &literal).map_or(&literal[..], |at| words[at]);
                literals::next(words, word, steps)
            }
            Kind::Reference(category) => {
                let known = self.source().identities(self.selected, category);
                let known: Vec<_> = known.iter().map(i64::to_string).collect();
                literals::next(&known, &literal, steps)
            }
            Kind::Name(category) => {
                let known = self.source().names(category);
                literals::next(&known, &literal, steps)
            }
            _ => literals::nudged(&literal, f64::from(steps) * step, step),
        };
        let Some(nudged) = nudged else {
            let expected = field.expected();
            self.fail(format!(
                "{literal} has nothing next to it: {expected} is typed"
            ));
            return;
        };
        if nudged == literal {
            self.warn(match field.kind {
                Kind::Choice(_) | Kind::Reference(_) | Kind::Name(_) => "there is no other",
                _ => "the number is too large for this step",
            });
        } else if let Err(refused) = self.assign(&[(self.component, nudged)]) {
            self.fail(refused.message);
        }
    }

    pub(super) fn change_stride(&mut self, step: isize) {
        self.stride = match (self.stride, step < 0) {
            (Stride::Coarse, true) | (Stride::Fine, false) => Stride::Plain,
            (_, true) => Stride::Fine,
            (_, false) => Stride::Coarse,
        };
        self.say(match self.stride {
            Stride::Fine => "nudges are a tenth of a step",
            Stride::Plain => "nudges are one step",
            Stride::Coarse => "nudges are ten steps",
        });
    }

    pub(super) fn next_component(&mut self, step: isize) {
        self.document.end_step();
        let counts: Vec<_> = self
            .placed()
            .iter()
            .map(|placed| placed.field.kind.components())
            .collect();
        let count: usize = counts.iter().sum();
        if count == 0 {
            return;
        }
        let before: usize = counts[..self.field].iter().sum();
        let at = (before + self.component) as isize + step;
        let mut at = at.rem_euclid(count as isize) as usize;
        self.field = 0;
        while counts[self.field] <= at {
            at -= counts[self.field];
            self.field += 1;
        }
        self.component = at;
    }

    pub(super) fn type_current(&mut self) {
        if let Some((_, literal)) = self.current() {
            self.type_value(Input::from(literal));
        }
    }

    pub(super) fn type_value(&mut self, input: Input) {
        self.typing = Some(Typing {
            input,
            refused: None,
        });
    }

    pub(super) fn typing_key(&mut self, key: KeyEvent) {
        let Some(typing) = &mut self.typing else {
            return;
        };
        match key.code {
            KeyCode::Esc => self.typing = None,
            KeyCode::Enter => {
                self.commit();
            }
            KeyCode::Tab | KeyCode::BackTab => {
                let step = if key.code == KeyCode::Tab { 1 } else { -1 };
                if self.commit() {
                    self.next_component(step);
                }
            }
            _ => {
                typing.refused = None;
                line::edit(&mut typing.input, key);
            }
        }
    }

    /// Takes the typed value; whether it was not refused.
    fn commit(&mut self) -> bool {
        let Some(typing) = &self.typing else {
            return true;
        };
        let said = typing.input.value().trim().to_owned();
        let outcome = if let Some(values) = self.literals_of(&said) {
            self.assign_whole(&values)
        } else {
            let words = self.current().and_then(|(field, _)| match field.kind {
                Kind::Choice(_) | Kind::Reference(_) | Kind::Name(_) | Kind::Word => {
                    Some(field.expected())
                }
                _ => None,
            });
            let expected = words.unwrap_or_else(|| "one number".to_owned());
            let message = format!("{expected} is expected here");
            Err(Diagnostic::error(Span::at(0), message, expected))
        };
        match outcome {
            Ok(()) => self.typing = None,
            Err(mut refused) => {
                if let Some(hint) = refused.hint.take() {
                    refused.message = format!("{}; {hint}", refused.message);
                }
                if let Some(typing) = &mut self.typing {
                    typing.refused = Some(refused);
                }
            }
        }
        self.typing.is_none()
    }

    /// As [`App::assign`], as a step of its own.
    fn assign_whole(&mut self, values: &[(usize, String)]) -> Result<(), Diagnostic> {
        self.document.end_step();
        let outcome = self.assign(values);
        self.document.end_step();
        outcome
    }

    /// What a typed or pasted text sets: the current component, or all of the current field's.
    fn literals_of(&self, said: &str) -> Option<Vec<(usize, String)>> {
        let placed = self.placed();
        let kind = placed.get(self.field)?.field.kind;
        if let Some(all) = literals::all_of(kind, said) {
            return Some(all.into_iter().enumerate().collect());
        }
        if let Kind::Choice(words) = kind
            && place_of(words, said).is_none()
            && let Some(word) = literals::word_meant(words, said)
        {
            return Some(vec![(self.component, word.to_owned())]);
        }
        let is_number = !matches!(
            kind,
            Kind::Choice(_) | Kind::Reference(_) | Kind::Name(_) | Kind::Word
        );
        let said = if is_number && !kind.is_size() {
            literals::plain(said)
        } else {
            said
        };
        literals::is_one(said).then(|| vec![(self.component, said.to_owned())])
    }

    pub(super) fn paste(&mut self, text: &str) {
        let said = text.trim();
        if let Some(prompt) = &mut self.prompt {
            line::insert(&mut prompt.input, text);
            return;
        }
        if self.dialog.is_some() || self.help.is_some() {
            return;
        }
        if self.is_opening() {
            self.warn_of_opening();
            return;
        }
        if self.mode != Mode::Edit {
            self.say("values are pasted into fields: e edits the selected thing's");
            return;
        }
        let values = self.literals_of(said);
        let is_whole = values.as_ref().is_some_and(|values| 1 < values.len());
        if let (Some(typing), false) = (&mut self.typing, is_whole) {
            typing.refused = None;
            line::insert(&mut typing.input, text);
            return;
        }
        let Some(values) = values else {
            self.fail("what was pasted is not one number, nor one for each component");
            return;
        };
        self.typing = None;
        if let Err(refused) = self.assign_whole(&values) {
            self.fail(refused.message);
        }
    }
}
