//! Editing a line of input.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use tui_input::{Input, InputRequest};

/// The longest line that typing and pasting make, in characters: longer than any path, and so short
/// that each key takes the same moment, however much is typed.
pub(crate) const LONGEST: usize = 4096;

/// Applies a key to a line; keys without a meaning there are ignored.
pub(crate) fn edit(input: &mut Input, key: KeyEvent) {
    use InputRequest as R;
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    let request = match key.code {
        KeyCode::Char('a') if control => R::GoToStart,
        KeyCode::Char('e') if control => R::GoToEnd,
        KeyCode::Char('k') if control => R::DeleteTillEnd,
        KeyCode::Char('u') if control => R::DeleteLine,
        KeyCode::Char('w') if control => R::DeletePrevWord,
        KeyCode::Char(_) if control || key.modifiers.contains(KeyModifiers::ALT) => return,
        KeyCode::Char(character) => R::InsertChar(character),
        KeyCode::Backspace => R::DeletePrevChar,
        KeyCode::Delete => R::DeleteNextChar,
        KeyCode::Left if control => R::GoToPrevWord,
        KeyCode::Right if control => R::GoToNextWord,
        KeyCode::Left => R::GoToPrevChar,
        KeyCode::Right => R::GoToNextChar,
        KeyCode::Home => R::GoToStart,
        KeyCode::End => R::GoToEnd,
        _ => return,
    };
    input.handle(request);
}

/// The rows by which a key moves in a list that typing filters; `None` for other keys.
pub(crate) fn rows(key: KeyEvent) -> Option<isize> {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    match key.code {
        KeyCode::Down | KeyCode::Tab => Some(1),
        KeyCode::Up | KeyCode::BackTab => Some(-1),
        KeyCode::Char('n') if control => Some(1),
        KeyCode::Char('p') if control => Some(-1),
        _ => None,
    }
}

/// Whether a key types a character.
pub(crate) fn types(key: KeyEvent) -> bool {
    let held = KeyModifiers::CONTROL | KeyModifiers::ALT;
    matches!(key.code, KeyCode::Char(_)) && !key.modifiers.intersects(held)
}

/// Applies a key to a line that is selected as a whole at first: a character replaces it, any other
/// key edits it. Returns whether the text has changed.
pub(crate) fn edit_over(input: &mut Input, is_selected: &mut bool, key: KeyEvent) -> bool {
    let before = input.value().to_owned();
    if std::mem::take(is_selected) && types(key) {
        input.reset();
    }
    edit(input, key);
    input.value() != before
}

/// Inserts pasted text into a line, which it replaces if that is selected as a whole.
pub(crate) fn insert_over(input: &mut Input, is_selected: &mut bool, text: &str) {
    if std::mem::take(is_selected) {
        input.reset();
    }
    insert(input, text);
}

/// Inserts pasted text, replacing line breaks with blanks.
pub(crate) fn insert(input: &mut Input, text: &str) {
    let at = input.cursor();
    let shown = text.trim_end().replace(char::is_control, " ");
    let before = input.value().chars().take(at);
    let after = input.value().chars().skip(at);
    let line: String = before.chain(shown.chars()).chain(after).collect();
    *input = Input::new(line).with_cursor(at + shown.chars().count());
}
