//! Scripts of keys: a text that says what to press, as the help names the keys.
//!
//! ```text
//! # comment to the end of the line
//! j Enter "0.5" Enter Ctrl-R     keys, and text in quotes, which is typed
//! click 10,3  paste "1 2 3"      the mouse, and a paste
//! resize 100x30                  another size of the screen
//! wait  dump FILE                awaits complete pictures; writes the screen, or adds it to a .gif
//! editor-open FILE               shows a file in an editor's pane of the .gif
//! editor-find "a"  editor-type "b"  editor-save
//! ```

mod editor_pane;
mod recorder;
mod token;

use std::collections::VecDeque;
use std::path::PathBuf;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::snapshot::Format;
use crate::keymap::{self, Keymap};
pub(crate) use recorder::{PaneStep, Recorder};
use text::{Diagnostic, Span, alternatives, nearest_word};
use token::{Token, Tokens};

/// The steps of a script that are still to be played.
#[derive(Debug, Default)]
pub(crate) struct Script {
    /// The name and the text of the script, for messages.
    pub(crate) name: String,
    pub(crate) text: String,
    steps: VecDeque<(Step, Span)>,
}

/// A step of a script.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Presses a key.
    Key(KeyEvent),
    /// Pastes a text.
    Paste(String),
    /// Presses and releases the left button over this cell: column, row.
    Click(u16, u16),
    /// Gives the screen another size: columns, rows.
    Resize(u16, u16),
    /// Awaits complete pictures.
    Wait,
    /// Awaits complete pictures and writes the screen to a file.
    Dump(PathBuf, Format),
    /// Awaits complete pictures and adds the screen to an animation.
    Record(PathBuf),
    /// Does this in the editor's pane of animations.
    Pane(PaneStep),
}

/// After this many errors no more is read: they tell the user nothing new, and a long script could have
/// many thousands.
const MOST_ERRORS: usize = 100;

/// The largest number of columns or rows.
const MAX_SIDE: u16 = 1000;

/// Reads a size of the screen such as `100x30`.
pub fn parse_screen(text: &str) -> Option<(u16, u16)> {
    let (columns, rows) = text.split_once('x')?;
    let side = |side: &str| {
        let side = side.parse().ok()?;
        (1..=MAX_SIDE).contains(&side).then_some(side)
    };
    Some((side(columns)?, side(rows)?))
}

impl Script {
    /// Reads a script, which may name sequences of keys that `keymap` has; fails with an error for
    /// each word that means nothing, at most a hundred.
    pub(crate) fn parse(
        name: String,
        text: String,
        keymap: &Keymap,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut steps = VecDeque::new();
        let mut errors = Vec::new();
        let mut tokens = Tokens::of(&text);
        while let Some(token) = tokens.next() {
            let span = token.span();
            // Where a text has no end, what follows may be text or keys.
            let is_open = matches!(token, Token::Open(_));
            match token.and_then_step(&mut tokens, keymap) {
                Ok(found) => steps.extend(found.into_iter().map(|step| (step, span))),
                Err(error) => errors.push(error),
            }
            if is_open || MOST_ERRORS <= errors.len() {
                break;
            }
        }
        if errors.is_empty() {
            Ok(Self { name, text, steps })
        } else {
            Err(errors)
        }
    }

    /// The step to play next.
    pub(crate) fn peek(&self) -> Option<&Step> {
        self.steps.front().map(|(step, _)| step)
    }

    /// Takes the step to play next.
    pub(crate) fn next(&mut self) -> Option<Step> {
        self.steps.pop_front().map(|(step, _)| step)
    }

    /// The error that the interface has ended before the next step, if there is one.
    pub(crate) fn unplayed(&self) -> Option<Diagnostic> {
        let (_, span) = self.steps.front()?;
        let expected = "nothing here, or no key that quits above";
        let message = "the interface has ended before this step";
        Some(Diagnostic::error(*span, message, expected))
    }
}

impl Token {
    /// The steps of a word or text, with its argument, if any, from `tokens`.
    fn and_then_step(
        self,
        tokens: &mut Tokens<'_>,
        keymap: &Keymap,
    ) -> Result<Vec<Step>, Diagnostic> {
        let (word, span) = match self {
            Self::Text(text, _) => return Ok(text.chars().map(typed).collect()),
            Self::Open(span) => {
                return Err(Diagnostic::error(
                    span,
                    "this text has no end",
                    "a quotation mark at the end of the text",
                ));
            }
            Self::Word(word, span) => (word, span),
        };
        if let Some((name, takes)) = COMMANDS.iter().find(|(name, _)| *name == word) {
            let step = match takes {
                Takes::Nothing(step) => step.clone(),
                Takes::Argument(expected, read) => tokens.argument(span, name, expected, read)?,
            };
            return Ok(vec![step]);
        }
        let keys = match keymap::key_named(&word) {
            Some(key) => Some(vec![key]),
            None => keymap.sequence_named(&word).map(Vec::from),
        };
        let keys = keys.ok_or_else(|| unknown(&word, span))?;
        Ok(keys.into_iter().map(Step::Key).collect())
    }
}

/// What follows the name of a command.
enum Takes {
    /// Nothing: the name alone is this step.
    Nothing(Step),
    /// An argument: what is expected, and how it is read.
    Argument(&'static str, fn(&str) -> Option<Step>),
}

/// The commands, which are no keys, by their names.
const COMMANDS: [(&str, Takes); 9] = [
    ("wait", Takes::Nothing(Step::Wait)),
    (
        "dump",
        Takes::Argument("a file that ends in .txt, .ansi, .png or .gif", |file| {
            let file = PathBuf::from(file);
            if file.extension().is_some_and(|extension| extension == "gif") {
                return Some(Step::Record(file));
            }
            Format::of_path(&file).map(|format| Step::Dump(file, format))
        }),
    ),
    (
        "paste",
        Takes::Argument("a text in quotation marks", |text| {
            Some(Step::Paste(text.to_owned()))
        }),
    ),
    (
        "click",
        Takes::Argument("a cell COLUMN,ROW from 0", |cell| {
            let (column, row) = cell.split_once(',')?;
            Some(Step::Click(column.parse().ok()?, row.parse().ok()?))
        }),
    ),
    (
        "resize",
        Takes::Argument("a size such as 100x30", |size| {
            parse_screen(size).map(|(columns, rows)| Step::Resize(columns, rows))
        }),
    ),
    (
        "editor-open",
        Takes::Argument("a file", |file| {
            Some(Step::Pane(PaneStep::Open(file.into())))
        }),
    ),
    (
        "editor-find",
        Takes::Argument("a text of the file", |text| {
            Some(Step::Pane(PaneStep::Find(text.to_owned())))
        }),
    ),
    (
        "editor-type",
        Takes::Argument("a text in quotation marks", |text| {
            Some(Step::Pane(PaneStep::Type(text.to_owned())))
        }),
    ),
    ("editor-save", Takes::Nothing(Step::Pane(PaneStep::Save))),
];

fn typed(character: char) -> Step {
    let code = match character {
        '\n' => KeyCode::Enter,
        character => KeyCode::Char(character),
    };
    Step::Key(KeyEvent::new(code, KeyModifiers::NONE))
}

fn unknown(word: &str, span: Span) -> Diagnostic {
    let commands = COMMANDS.map(|(name, _)| name);
    let hint = match nearest_word(word, keymap::key_names().chain(commands)) {
        Some(known) => format!("did you mean {known}?"),
        None => format!("write \"{word}\" to type these characters"),
    };
    let commands = alternatives(commands);
    let expected = format!("a key such as j, Enter or Ctrl-R, a text in quotes, {commands}");
    Diagnostic::error(span, format!("unknown key {word}"), expected).with_hint(hint)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::keymap::bound;
    use text::Position;

    fn parse(text: &str) -> Result<Script, Vec<Diagnostic>> {
        Script::parse(String::new(), text.to_owned(), &Keymap::default())
    }

    fn steps(text: &str) -> Vec<Step> {
        let steps = parse(text).expect("a script").steps;
        steps.into_iter().map(|(step, _)| step).collect()
    }

    fn key(name: &str) -> Step {
        Step::Key(keymap::key_named(name).expect("a key"))
    }

    #[test]
    fn words_are_keys_and_quoted_text_is_typed() {
        let text = "j Ctrl-R # Enter\n\"0.5 \\\"#\"\tShift-Left";
        let names = "j Ctrl-R 0 . 5 Space \" # Shift-Left".split(' ');
        assert_eq!(steps(text), names.map(key).collect::<Vec<_>>());
    }

    #[test]
    fn sequences_are_named_as_in_the_help_and_in_the_configuration() {
        for text in ["gg", "g g"] {
            assert_eq!(steps(text), ["g", "g"].map(key));
        }
        let keymap = bound("anywhere Ctrl-X d=undo");
        assert_eq!(keymap.sequence_named("dg"), None);
        let ctrl = keymap.sequence_named("Ctrl-X d").expect("it is bound");
        assert_eq!(ctrl.map(Step::Key), ["Ctrl-X", "d"].map(key));
    }

    #[test]
    fn commands_take_their_arguments() {
        assert_eq!(
            steps("wait dump a.txt dump \"a b.png\" resize 100x30 paste \"1\\n2\" click 3,0"),
            [
                Step::Wait,
                Step::Dump("a.txt".into(), Format::Text),
                Step::Dump("a b.png".into(), Format::Picture),
                Step::Resize(100, 30),
                Step::Paste("1\n2".to_owned()),
                Step::Click(3, 0),
            ]
        );
    }

    #[test]
    fn a_long_text_of_unknown_words_has_a_hundred_errors() {
        let errors = parse(&"word ".repeat(10_000)).expect_err("no keys");
        assert_eq!(errors.len(), 100);
    }

    #[test]
    fn an_unknown_word_is_reported_at_its_place_with_a_hint() {
        for (text, place, message, hint) in table! {
            "j\n Entr", (2, 2) => "unknown key Entr", "did you mean Enter?";
            "jjj", (1, 1) => "unknown key jjj", "write \"jjj\" to type these characters";
            "wai", (1, 1) => "unknown key wai", "did you mean wait?";
            "resize 0x1", (1, 8) => "resize: 0x1 is not valid", "";
            "click", (1, 1) => "click: nothing follows", "";
            "dump a.jpg", (1, 6) => "dump: a.jpg is not valid", "";
            "j \"abc\nk", (1, 3) => "this text has no end", "";
        } {
            let errors = parse(text).expect_err(text);
            let error = &errors[0];
            assert_eq!(error.message, message);
            assert_eq!(error.hint.as_deref().unwrap_or_default(), hint);
            let at = Position::of(text, error.span.start());
            assert_eq!((at.line, at.column), place, "{text}");
            assert_eq!(errors.len(), 1, "{text}");
        }
    }
}
