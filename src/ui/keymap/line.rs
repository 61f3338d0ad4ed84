//! The keys with a meaning of their own while a line is typed.

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
            ("Esc", "back"),
            ("↑ ↓", "move"),
            ("Ctrl-U", "clear"),
        ],
        Line::Search => &[("Enter", "find"), ("Esc", "cancel"), ("Ctrl-U", "clear")],
    }
}
