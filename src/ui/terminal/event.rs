//! Events from the terminal and the system.

use crossterm::event::{KeyEvent, MouseEvent};

use super::reply::Reply;

/// An event from the terminal or the system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A key was pressed or repeated; releases are not reported.
    Key(KeyEvent),
    /// Text was pasted; its line ends are `\n`.
    Paste(String),
    /// Text was pasted that is longer than 1 MiB; it is not kept.
    LongPaste,
    /// A button, a drag or the wheel; motion without a button is not reported.
    Mouse(MouseEvent),
    /// The terminal replied to a query.
    Reply(Reply),
    /// The window has a new size, in cells.
    Resize {
        /// Width in cells.
        columns: u16,
        /// Height in cells.
        rows: u16,
    },
    /// The process received a request to stop until continued.
    Suspend,
    /// The process was continued; another program may have changed the terminal's modes meanwhile.
    Continue,
    /// The terminal is gone: 500 ms remain to save what must survive.
    HangUp,
    /// The process received a signal that requests its end, for example from `kill`.
    Terminate {
        /// The signal's number, such as 15 for SIGTERM.
        signal: u8,
    },
    /// The process was interrupted by a signal; Ctrl-C on the keyboard is a key.
    Interrupt,
}
