//! Typed lines: the characters that begin one, and the keys that have a meaning of their own there.

/// Characters that begin to type a value in EDIT.
const BEGINS_VALUE: &str = "0123456789+-*/.(#";
/// Characters that begin to type an amount in MOVE.
const BEGINS_AMOUNT: &str = "0123456789+-.(";
/// Those that go on typing one.
const CONTINUES_AMOUNT: &str = "*/^), ";

/// A line that keys are typed into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Line {
    /// A value of a field.
    Value,
    /// A command after `:`.
    Command,
    /// A search of a page after `/`.
    Search,
    /// The filter of the list after `/`.
    List,
    /// A new name.
    Name,
    /// The filter of a menu.
    Menu,
    /// The filter of a page with rows to choose from.
    Rows,
}

/// The keys with a meaning of their own while a line is typed, the most useful first.
pub fn line_hints(line: Line) -> &'static [(&'static str, &'static str)] {
    match line {
        Line::Value => &[
            ("Enter", "keep"),
            ("Esc", "cancel"),
            ("Tab", "keep, next number"),
            ("↓", "keep, next field"),
            ("Shift-Tab", "keep, previous number"),
            ("Ctrl-U", "clear"),
        ],
        Line::Command => &[
            ("Enter", "run"),
            ("Esc", "cancel"),
            ("Tab", "next completion"),
            ("↑ ↓", "completions; earlier lines if empty"),
            ("Ctrl-U", "clear"),
        ],
        Line::Name => &[("Enter", "rename"), ("Esc", "cancel"), ("Ctrl-U", "clear")],
        Line::Menu => &[
            ("Enter", "choose"),
            ("Esc", "cancel"),
            ("↑ ↓", "move"),
            ("Ctrl-N Ctrl-P", "move"),
            ("Ctrl-U", "clear"),
        ],
        Line::List => &[
            ("Enter", "keep"),
            ("Esc", "show all"),
            ("↑ ↓", "move"),
            ("Ctrl-U", "clear"),
        ],
        Line::Rows => &[
            ("Enter", "choose"),
            ("Esc", "keep the filter"),
            ("↑ ↓", "move"),
            ("Ctrl-U", "clear"),
        ],
        Line::Search => &[("Enter Esc", "keep the search"), ("Ctrl-U", "clear")],
    }
}

/// Whether a character begins to type a value in EDIT.
pub fn begins_value(character: char) -> bool {
    BEGINS_VALUE.contains(character)
}

/// Whether a character is typed in MOVE, after an amount or to begin one.
pub fn types_amount(character: char, typed: &str) -> bool {
    BEGINS_AMOUNT.contains(character) || !typed.is_empty() && CONTINUES_AMOUNT.contains(character)
}
