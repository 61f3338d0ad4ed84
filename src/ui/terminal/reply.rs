//! What the terminal answers when it is asked.

/// An answer of the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reply {
    /// It shows 24-bit colours.
    TrueColour,
    /// How a DEC private mode stands, as DECRPM says it: 1 set, 2 reset, 0 unknown to it.
    Mode {
        /// The mode's number.
        number: u16,
        /// How it stands.
        state: u16,
    },
    /// What it is (DA1). Every terminal answers this, and answers in order: no other is to come.
    Attributes,
}
