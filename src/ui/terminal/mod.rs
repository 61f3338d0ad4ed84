//! Everything between the bytes of the terminal and the interface: the guard that borrows and
//! restores the screen, the encoder of cells, the reader of keys, signals, and the measurement of
//! the link.
//!
//! This module must not know what is drawn or what a key means. It sends only queries whose replies
//! cannot be mistaken for keys. Since a terminal may stay silent, replies are awaited for a second at
//! most, and only by reports and before another program gets the terminal.

mod abort;
mod backend;
mod base64;
mod canvas;
mod colour;
mod decode;
mod event;
mod graphics;
mod guard;
mod input;
pub(crate) mod interview;
mod keyboard;
mod link;
mod nearest;
mod output;
mod ownership;
mod pen;
mod print;
pub(crate) mod query;
mod reply;
mod signals;
pub(crate) mod tmux;
mod tty;

pub use backend::AnsiBackend;
#[cfg(test)]
pub(crate) use colour::tests::environment;
pub use colour::{Choice, ColourDepth};
pub(crate) use colour::{THEME, colour_on_screen};
pub use decode::Decoder;
pub use event::Event;
pub(crate) use graphics::MOST_PLACEHOLDERS;
pub use graphics::{Means, Pixmap, Protocol, Wrapping};
pub use guard::{Mouse, Terminal};
pub use input::{Input, Unread};
pub use link::{Budget, Link};
pub(crate) use print::printed;
pub use reply::{Replies, Reply};
pub use signals::{Signals, suspend_process};
pub(crate) use tty::{cell_size, complain, size};
