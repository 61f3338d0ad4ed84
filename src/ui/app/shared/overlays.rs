//! What overlays the panels: dialogs, pages, the list of errors, a line being typed, and messages.

use std::sync::Arc;
use std::time::Duration;

use tui_input::Input;

use super::after_leaving::AfterLeaving;
use super::jobs::Pending;
use super::menu::Menu;
use super::messages::{About, Lasts, Message, Messages};
use super::page::{Page, PageFocus};
use super::picker::ColourPicker;
use crate::keymap::Context;
use crate::recovery::{Claim, Offer, Since};
use document::{Merge, Side};
use language::Node;
use text::{Severity, without_codes};

/// What overlays the panels.
#[derive(Debug, Default)]
pub struct Overlays {
    /// A line being typed at the bottom.
    pub prompt: Option<Prompt>,
    /// A menu over the list.
    pub menu: Option<Menu>,
    /// The colour picker over the list.
    pub picker: Option<ColourPicker>,
    /// A question that must be answered first.
    pub dialog: Option<Dialog>,
    /// A page over the screen, if open.
    pub page: Option<Page>,
    /// The selected diagnostic while the list of errors has the keys. Errors are always shown.
    pub errors: Option<usize>,
    /// The message in the status line. The next key dismisses it, or the next message once it could
    /// be read.
    pub message: Option<Message>,
    /// The messages that wait, and those so far.
    pub messages: Messages,
}

/// A line being typed at the bottom.
#[derive(Debug)]
pub struct Prompt {
    /// What happens with the line on Enter.
    pub kind: PromptKind,
    /// The text and its cursor.
    pub input: Input,
    /// The text that it was opened with.
    pub opened: String,
    /// Whether the next character replaces the text; other keys edit it.
    pub is_selected: bool,
}

/// The purpose of a prompt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PromptKind {
    /// A command, after `:`.
    Command,
    /// What the list is filtered by, after `/`, and the node selected before.
    Filter(Node),
    /// The new name of the selected node.
    Name,
}

/// A question that must be answered first.
#[derive(Debug)]
pub enum Dialog {
    /// Whether to leave the scene although something would be lost, and what follows then.
    Leave(AfterLeaving),
    /// How to resolve a merge in which both texts changed the same places.
    Conflict {
        /// The merge to decide.
        merge: Merge,
        /// The index of the conflict under the cursor.
        at: usize,
        /// The origin of the other text.
        from: MergeSource,
    },
    /// Whether to delete these nodes although others use them.
    Delete(Vec<Node>),
    /// Whether an export may overwrite a file that another program has written.
    Overwrite(Box<Pending>),
    /// Whether to restore unsaved edits of an earlier run.
    Recover(Box<Offer>),
}

/// A question as it is shown; the keys of its context are the answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Question {
    /// The title, with a blank on either side.
    pub title: &'static str,
    /// The question, with its consequences.
    pub text: String,
}

/// The origin of a text that is merged with the edited one.
#[derive(Clone, Debug)]
pub enum MergeSource {
    /// The scene's file, changed by another program.
    File,
    /// A recovery journal of an earlier run.
    Kept(Arc<Claim>, Since),
}

/// Whose text resolves a conflict.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Whose {
    /// The user's own unsaved edits, in the interface or kept by an earlier run.
    Mine,
    /// What they are merged with.
    Theirs,
}

impl MergeSource {
    /// The side of a merge with somebody's text.
    pub fn side(&self, whose: Whose) -> Side {
        match (self, whose) {
            (Self::File, Whose::Mine) | (Self::Kept(..), Whose::Theirs) => Side::Mine,
            (Self::File, Whose::Theirs) | (Self::Kept(..), Whose::Mine) => Side::Theirs,
        }
    }
}

impl Overlays {
    /// Opens a prompt containing `text`.
    pub(crate) fn open_prompt(&mut self, kind: PromptKind, text: &str) {
        self.prompt = Some(Prompt {
            kind,
            input: Input::from(text),
            opened: text.to_owned(),
            is_selected: false,
        });
    }

    /// Opens a prompt containing `text`, which the first typed character replaces.
    pub(crate) fn open_prompt_over(&mut self, kind: PromptKind, text: &str) {
        self.open_prompt(kind, text);
        if let Some(prompt) = &mut self.prompt {
            prompt.is_selected = !text.is_empty();
        }
    }

    /// Starts typing into the filter of the open page.
    pub(crate) fn open_search(&mut self) {
        if let Some(page) = &mut self.page {
            page.focus = PageFocus::Search;
        }
    }

    /// Opens a page.
    pub(crate) fn open_page(&mut self, page: Page) {
        self.page = Some(page);
    }

    /// Closes the page; returns the row under its cursor, by its index in the list.
    pub(crate) fn take_chosen(&mut self) -> Option<usize> {
        self.page.take()?.chosen()
    }

    /// The open page, if it is this one.
    pub fn page(&self, context: Context) -> Option<&Page> {
        self.page.as_ref().filter(|page| page.context == context)
    }

    /// The open page, if it is this one, mutable.
    pub(crate) fn page_mut(&mut self, context: Context) -> Option<&mut Page> {
        self.page.as_mut().filter(|page| page.context == context)
    }

    /// The line that keys or pastes are typed into, and whether the next character replaces it.
    pub(crate) fn line(&self) -> Option<(&Input, bool)> {
        let prompt = self.prompt.as_ref();
        let prompt = prompt.map(|prompt| (&prompt.input, prompt.is_selected));
        let menu = self.menu.as_ref().map(|menu| (&menu.filter.input, false));
        let page = self.page.as_ref();
        let page = page.filter(|page| !page.is_read() || page.focus == PageFocus::Search);
        let page = page.map(|page| (&page.filter.input, false));
        prompt.or(menu).or(page)
    }

    /// The open merge dialog, if any.
    pub(crate) fn conflict(&mut self) -> Option<(&mut Merge, &mut usize, &MergeSource)> {
        match &mut self.dialog {
            Some(Dialog::Conflict { merge, at, from }) => Some((merge, at, from)),
            _ => None,
        }
    }

    /// Asks how to resolve a merge.
    pub(crate) fn ask_conflict(&mut self, merge: Merge, from: MergeSource) {
        self.dialog = Some(Dialog::Conflict { merge, at: 0, from });
    }

    /// Shows a message unless there is one already.
    pub(crate) fn suggest(&mut self, text: impl Into<String>) {
        if self.message.is_none() {
            self.show(None, text);
        }
    }

    /// Appends a failure to an error that is already shown: the first of two errors usually caused
    /// the other.
    pub(crate) fn fail_too(&mut self, text: &str) {
        let text = &*without_codes(text);
        let before = self.message.as_mut();
        match before.filter(|before| before.severity == Some(Severity::Error)) {
            Some(before) => {
                if !before.text.contains(text) {
                    before.text = format!("{}; {text}", before.text);
                }
                self.messages.remember(before);
            }
            None => self.show(Some(Severity::Error), text),
        }
    }

    /// Shows a message. If another is shown, this one waits until that has been read.
    pub(crate) fn show(&mut self, severity: Option<Severity>, text: impl Into<String>) {
        self.put(Lasts::UntilRead, severity, &text.into());
    }

    /// Shows how something stands that goes on, in place of how it stood before, of which only the last
    /// is remembered.
    pub(crate) fn show_passing(&mut self, text: String) {
        let message = Message {
            severity: None,
            text,
        };
        self.messages.remember_passing(&message);
        self.message = Some(message);
        self.messages.is_unseen = true;
        self.messages.lasts = Lasts::UntilRead;
    }

    /// Answers a key that does nothing. This is not remembered.
    pub(crate) fn answer(&mut self, text: String) {
        self.message = Some(Message {
            severity: None,
            text,
        });
    }

    /// Shows that something cannot be done as expected because the text has errors. The message
    /// goes when they do.
    pub(crate) fn blame_errors(&mut self, severity: Severity, text: impl Into<String>) {
        self.put(Lasts::WhileErrors, Some(severity), &text.into());
    }

    fn put(&mut self, lasts: Lasts, severity: Option<Severity>, text: &str) {
        let text = without_codes(text).into_owned();
        let message = Message { severity, text };
        self.messages.remember(&message);
        if self.message.is_some() && self.message.as_ref() != Some(&message) {
            self.messages.queue(message, lasts);
            return;
        }
        self.message = Some(message);
        self.messages.is_unseen = true;
        self.messages.lasts = lasts;
    }

    /// Whether an error is shown.
    pub(crate) fn has_failed(&self) -> bool {
        let severity = self.message.as_ref().and_then(|message| message.severity);
        severity == Some(Severity::Error)
    }

    /// Begins a step: messages shown so far may have been seen.
    pub(crate) fn begin_step(&mut self) {
        self.messages.is_unseen = false;
    }

    /// Ends a step: shows the next message that waits if there is none.
    pub(crate) fn end_step(&mut self) {
        if self.message.is_none()
            && let Some((message, lasts)) = self.messages.next()
        {
            self.message = Some(message);
            self.messages.lasts = lasts;
        }
    }

    /// The time after which the next message takes the place of the one shown, if that time begins
    /// now: another waits.
    pub(crate) fn time_to_read(&mut self) -> Option<Duration> {
        self.messages.time_to_read(self.message.as_ref())
    }

    /// Dismisses the message for the next one, once it could be read.
    pub(crate) fn turn_message(&mut self) {
        if self.messages.is_timed(self.message.as_ref()) {
            self.message = None;
        }
    }

    /// Dismisses the message, which stays in the history.
    pub(crate) fn clear_message(&mut self) {
        self.message = None;
    }

    /// Dismisses a message whose cause is gone, also while it waits. Returns whether it was shown or
    /// waited.
    pub(crate) fn withdraw(&mut self, text: &str) -> bool {
        let text = &*without_codes(text);
        let waited = self.messages.withdraw(text);
        let is_stale = |message: &mut Message| message.text == text;
        let was_shown = self.message.take_if(is_stale).is_some();
        if was_shown {
            // Before messages that are yet to come in this step.
            self.end_step();
        }
        waited || was_shown
    }

    /// Shows what is wrong with files, in place of what was before.
    pub(crate) fn complain(&mut self, about: About, severity: Severity, text: &str) {
        self.end_complaint(about);
        self.messages.complaints.insert(about, text.to_owned());
        self.show(Some(severity), text);
    }

    /// Dismisses the message about files that nothing is wrong with any more.
    pub(crate) fn end_complaint(&mut self, about: About) {
        if let Some(text) = self.messages.complaints.remove(&about) {
            self.withdraw(&text);
        }
    }

    /// Dismisses messages about errors in the text, which has none any more.
    pub(crate) fn forgive_errors(&mut self) {
        if self.messages.lasts == Lasts::WhileErrors && !self.messages.is_unseen {
            self.message = None;
        }
        self.messages.forgive_errors();
    }
}
