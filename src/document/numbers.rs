//! Texts from outside that differ in numbers: they are taken without parsing the rest again.

use std::mem;
use std::sync::Arc;

use super::history::History;
use super::{Difference, Document, Past, Snapshot};
use language::{Before, Lowered};
use text::{Edit, Span, are_plain_numbers, difference};

/// Shorter texts are parsed in a few milliseconds.
const LONG: usize = 1 << 20;

/// The most bytes of changed numbers: more than those of any object.
const LONGEST: usize = 1024;

/// A text from outside that differs from the one last saved in plain numbers, for
/// [`Document::take_numbers`].
#[derive(Debug)]
pub struct Numbers {
    /// To be edited; never shared with the other, since a shared text would be copied then.
    text: Arc<String>,
    saved: Arc<String>,
    edit: Edit,
}

impl Snapshot {
    /// Takes a long text from outside if there are no unsaved edits and it differs in numbers that
    /// may belong to one object.
    ///
    /// # Errors
    ///
    /// The text, if it is to be parsed as a whole.
    pub fn numbers(&self, text: String) -> Result<Numbers, String> {
        if text.len() < LONG || self.edited.is_some() || !self.language.lowers_changes() {
            return Err(text);
        }
        let saved = &*self.saved;
        let Some(changed) = difference(saved, &text) else {
            return Err(text);
        };
        let [span, changed] = words([saved, &text], changed);
        let are_numbers = |span: Span, text: &str| {
            (1..=LONGEST).contains(&span.len()) && are_plain_numbers(span.of(text))
        };
        if !are_numbers(span, saved) || !are_numbers(changed, &text) {
            return Err(text);
        }
        Ok(Numbers {
            edit: Edit {
                span,
                text: changed.of(&text).to_owned(),
            },
            text: Arc::new(text.clone()),
            saved: Arc::new(text),
        })
    }
}

impl Numbers {
    /// How the text differs.
    pub fn difference(&self) -> Difference {
        Difference {
            places: vec![self.edit.placed()],
            edit: self.edit.clone(),
        }
    }
}

impl Document {
    /// As [`Document::load`] if all objects but the changed ones can be kept, given the result of lowering
    /// the present text; returns the previous texts, which may take long to free. `None` if not: then
    /// the document is as before.
    pub fn take_numbers(
        &mut self,
        numbers: Numbers,
        before: Before<'_>,
        past: Past,
    ) -> Option<([Arc<String>; 2], Lowered)> {
        let Numbers { text, saved, edit } = numbers;
        let inverse = Edit {
            text: edit.span.of(self.text()).to_owned(),
            span: edit.placed(),
        };
        let former = self.source.substitute(text, &edit);
        let Some(lowered) = self.source.lower_change(before) else {
            self.source.substitute(former, &inverse);
            return None;
        };
        self.history = match past {
            Past::Cleared => History::after(&self.history),
            Past::Rebased => self.history.rebased(&[edit]),
        };
        self.longest = Span::default();
        self.revision += 1;
        let former = [former, mem::replace(&mut self.saved, saved)];
        Some((former, lowered))
    }
}

/// Widens the differing spans of two texts to whole words.
fn words([old, new]: [&str; 2], [span, changed]: [Span; 2]) -> [Span; 2] {
    let is_gap = |byte: &u8| byte.is_ascii_whitespace();
    let before = &old.as_bytes()[..span.start()];
    let back = before.iter().rev().take_while(|byte| !is_gap(byte)).count();
    let behind = &old.as_bytes()[span.end()..];
    let on = behind.iter().take_while(|byte| !is_gap(byte)).count();
    let widened = |span: Span, text: &str| {
        let widened = Span::new(span.start() - back, span.end() + on);
        debug_assert!(widened.end() <= text.len(), "both end alike");
        widened
    };
    [widened(span, old), widened(changed, new)]
}
