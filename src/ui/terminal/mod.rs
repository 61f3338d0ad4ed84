//! Everything between the bytes of the terminal and the interface: the guard that borrows the
//! screen and gives it back, the encoder of cells, the reader of keys, the signals, and the
//! measure of the link.
//!
//! It must not know what is drawn or what a key means. It asks the terminal only what no key looks
//! like the reply to, and nothing waits for replies: a terminal may stay silent.

#[cfg(unix)]
mod abort;
mod backend;
mod colour;
#[cfg(unix)]
mod decode;
mod guard;
mod input;
pub(crate) mod interview;
mod link;
mod output;
mod panics;
mod pen;
pub(crate) mod query;
mod reply;
#[cfg(unix)]
mod signals;
pub(crate) mod tmux;
mod tty;

pub use backend::AnsiBackend;
pub use colour::{Choice, ColourDepth};
#[cfg(unix)]
pub use decode::Decoder;
pub use guard::{Mouse, Terminal};
pub use input::Input;
pub use link::{Budget, Link};
pub use reply::{Replies, Reply};
#[cfg(unix)]
pub use signals::{Signals, suspend_process};
pub(crate) use tty::{complain, size};

use crossterm::event::{KeyEvent, MouseEvent};

/// An event from the terminal or the system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Event {
    /// A key was pressed or repeats; releases are not reported.
    Key(KeyEvent),
    /// Text arrived in one piece, its line ends as `\n`.
    Paste(String),
    /// A button, a drag or the wheel; bare motion is not reported.
    Mouse(MouseEvent),
    /// The terminal answered.
    Reply(Reply),
    /// The window has a new size, in cells.
    Resize {
        /// Cells in a row.
        columns: u16,
        /// Rows of cells.
        rows: u16,
    },
    /// The process is asked to stop until it is continued.
    Suspend,
    /// The process runs again; another program may have changed the terminal's modes in between.
    Continue,
    /// The terminal is gone: 500 ms remain to save what must survive.
    HangUp,
    /// The system asks the process to end, as by `kill`.
    Terminate {
        /// The number of the signal.
        signal: u8,
    },
    /// The process is interrupted from outside; Ctrl-C on the keyboard is a key.
    Interrupt,
}
