//! Sequences on their way through a multiplexer.

use ratatui::layout::Rect;

/// What stands between this process and the terminal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrapping {
    /// Nothing: sequences are sent as they are.
    #[default]
    Plain,
    /// tmux, which passes on what is wrapped for it, but does not put the cursor where the pane has
    /// it: the pane is so many columns from the left of the terminal and rows from its top.
    Tmux {
        /// Columns to the left of the pane.
        left: u16,
        /// Rows above the pane.
        top: u16,
    },
}

/// Ends an incomplete sequence.
pub(in crate::terminal) const END: &str = "\x1b\\";

impl Wrapping {
    /// Appends a sequence that begins at a cell, wrapped if necessary.
    pub(super) fn append(
        self,
        place: Rect,
        out: &mut Vec<u8>,
        sequence: impl FnOnce(&mut Vec<u8>),
    ) {
        let Self::Tmux { left, top } = self else {
            sequence(out);
            return;
        };
        let (row, column) = (top + place.y + 1, left + place.x + 1);
        let mut inner = format!("\x1b[{row};{column}H").into_bytes();
        sequence(&mut inner);
        wrap(&inner, out);
    }
}

/// Appends bytes, wrapped for tmux.
pub(super) fn wrap(inner: &[u8], out: &mut Vec<u8>) {
    out.extend_from_slice(b"\x1bPtmux;");
    for &byte in inner {
        if byte == 0x1b {
            out.push(byte);
        }
        out.push(byte);
    }
    out.extend_from_slice(END.as_bytes());
}
